#pragma once

#include "geometry/convex_faces.hpp"
#include "scene/scene.hpp"

namespace speculum::testing_support {

// A mirror that faces +z, turned by `yaw` degrees.
inline Mirror wall(const glm::dvec3& position, double yaw, const glm::dvec2& size = {2, 2}) {
  Mirror mirror;
  mirror.position = position;
  mirror.rotation = {0, yaw, 0};
  mirror.size = size;
  return mirror;
}

// With all that hides something found in it.
inline Mesh meshOf(const std::vector<glm::dvec3>& positions, const std::vector<uint32_t>& indices) {
  Mesh mesh{.indices = indices, .parts = {{.indexCount = static_cast<uint32_t>(indices.size())}}};
  for (const glm::dvec3& p : positions) {
    mesh.vertices.push_back({.position = p});
    mesh.halfExtent = glm::max(mesh.halfExtent, glm::abs(p));
    mesh.radius = std::max(mesh.radius, glm::length(p));
  }
  mesh.faces = convexFaces(positions, indices, 32, 4096);
  mesh.convex = convexMesh(positions, indices, 4096);
  return mesh;
}

}  // namespace speculum::testing_support
