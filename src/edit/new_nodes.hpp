#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "edit/transform.hpp"

namespace speculum {

// Nodes to add to a scene.

// Upright, facing the viewer; its size follows the distance.
Mirror newMirror(const glm::dvec3& position, const glm::dvec3& viewer);
// As bright at the viewer as a light of intensity 1 a metre away.
PointLight newLight(const glm::dvec3& position, const glm::dvec3& viewer);
// One of a mesh of the scene, at scale 1 and in its own colours. `position` (world) is under the middle of it.
Object newObject(const Scene& scene, int mesh, const glm::dvec3& position);

// A copy a little beside the node; an object with copies as a whole. Throws std::out_of_range for what does not exist.
SceneNode copyBeside(const Scene& scene, const Selection& selection);
// Copies of several nodes, moved by the same step so that they stay together beside the originals.
std::vector<SceneNode> copiesBeside(const Scene& scene, std::span<const Selection> nodes);

// "teapot", "teapot 2", "teapot 3": the first name that is not taken, counting on from the number that `wanted` ends
// in. No name stays none.
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
