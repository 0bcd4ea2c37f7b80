#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "scene/scene.hpp"

namespace speculum {

// The node of a scene that the user works on.
struct Selection {
  enum class Kind { none, object, light, mirror };

  Kind kind = Kind::none;
  int index = -1;  // into Scene::objects, lights or mirrors
  int copy = 0;    // of an object with copies

  explicit operator bool() const { return kind != Kind::none; }
  bool operator==(const Selection&) const = default;
};

// Describe nodes for users: "mirror 'floor'", "nothing" for none. Several nodes are "3 nodes".
std::string describe(const Scene& scene, const Selection& selection);
std::string describe(const Scene& scene, std::span<const Selection> nodes);
// Returns the node that has a mirror, by the index of Scene::mirror(): the mirror, or the object whose material makes
// it.
Selection mirrorNode(const Scene& scene, int mirror);
std::vector<Selection> allNodes(const Scene& scene);  // mirrors, lights, objects: the order of the lists
// Says whether both are one node, or copies of one object.
bool sameNode(const Selection& a, const Selection& b);

// The value of a node. The alternatives are in the order of Selection::Kind.
using SceneNode = std::variant<std::monostate, Object, PointLight, Mirror>;

inline Selection::Kind kindOf(const SceneNode& node) {
  return static_cast<Selection::Kind>(node.index());
}

// Returns the selected node; std::monostate if the scene has no such node.
SceneNode nodeOf(const Scene& scene, const Selection& selection);

// Calls visit(nodes, origins) with the scene's nodes of a kind; does not call it for Kind::none.
template <typename Content, typename Visitor>
void withNodes(Content& scene, Selection::Kind kind, const Visitor& visit) {
  switch (kind) {
    case Selection::Kind::none:
      return;
    case Selection::Kind::object:
      return visit(scene.objects, scene.origins.objects);
    case Selection::Kind::light:
      return visit(scene.lights, scene.origins.lights);
    case Selection::Kind::mirror:
      return visit(scene.mirrors, scene.origins.mirrors);
  }
}

}  // namespace speculum
