#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace speculum {

// The thing of a scene that the person works on.
struct Selection {
  enum class Kind { none, object, mirror, light };

  Kind kind = Kind::none;
  int index = -1;  // into Scene::objects, mirrors or lights
  int copy = 0;    // of an object with copies

  explicit operator bool() const { return kind != Kind::none; }
  bool operator==(const Selection&) const = default;
};

// "mirror 'floor'"; "nothing" for none.
std::string describe(const Scene& scene, const Selection& selection);
std::string describe(const Scene& scene, std::span<const Selection> things);  // "3 things"; of one as above
std::vector<Selection> allNodes(const Scene& scene);  // mirrors, lights, objects: the order of the lists
// Whatever copy of it.
bool sameThing(const Selection& a, const Selection& b);

}  // namespace speculum
