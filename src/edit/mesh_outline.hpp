#pragma once

#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// An edge of a mesh, relative to Mesh::center, with the third vertices of the triangles at it.
struct MeshEdge {
  glm::dvec3 a{0.0};
  glm::dvec3 b{0.0};
  glm::dvec3 left{0.0};
  glm::dvec3 right{0.0};
  bool border = false;  // not shared by exactly two triangles: part of every outline

  // Says whether the surface turns away from `eye` here: both triangles lie on one side of the plane through eye and
  // edge.
  bool outlines(const glm::dvec3& eye) const;
};

// Points and edges that an object's outline is drawn from.
struct MeshOutline {
  std::vector<glm::dvec3> points;  // at most 512, for a convex hull
  std::vector<MeshEdge> edges;     // empty for a mesh with too many triangles to test in every frame
};
MeshOutline meshOutline(const Mesh& mesh);

}  // namespace speculum
