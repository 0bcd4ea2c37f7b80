#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "edit/transform.hpp"

namespace speculum {

// Makes an upright mirror that faces the viewer; its size is in proportion to the distance.
Mirror newMirror(const glm::dvec3& position, const glm::dvec3& viewer);
// Makes a light that is as bright at the viewer as one of intensity 1 a metre away.
PointLight newLight(const glm::dvec3& position, const glm::dvec3& viewer);
// Makes an object with a mesh of the scene, at scale 1 and with the mesh's own colors. `position` (world) is below its
// middle.
Object newObject(const Scene& scene, int mesh, const glm::dvec3& position);

// Says whether an object seems to lie on its back: its model stands on z = 0 but not on y = 0, as models do whose Z
// axis points up, and nobody has turned it.
bool liesOnBack(const Scene& scene, const Object& object);
// Returns the object with Z up. Its box stands on the same height, about the same vertical axis.
Object stoodUp(const Scene& scene, Object object);

// Returns the step (metres, world) by which nodes, objects with all their copies, move to a place a little beside them;
// to the other side if `side` is -1. Throws std::out_of_range if a node does not exist.
glm::dvec3 stepBeside(const Scene& scene, std::span<const Selection> nodes, double side = 1.0);
// Copies nodes beside the originals, all by the same step so that they stay together.
std::vector<SceneNode> copiesBeside(const Scene& scene, std::span<const Selection> nodes, double side = 1.0);

// Returns the first name that is not taken: "teapot", "teapot 2", "teapot 3", counting on from the number that `wanted`
// ends in. An empty name stays empty.
std::string freeName(const std::string& wanted, const std::set<std::string>& taken);
template <typename Node>
std::string freeName(const std::string& wanted, const std::vector<Node>& nodes) {
  std::set<std::string> taken;
  for (const Node& node : nodes) {
    taken.insert(node.name);
  }
  return freeName(wanted, taken);
}

}  // namespace speculum
