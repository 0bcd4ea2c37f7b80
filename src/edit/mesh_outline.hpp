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
  bool border = false;  // not exactly two triangles meet: seen from everywhere

  // Whether a surface turns away from `eye` there: both triangles lie on one side of the plane through eye and edge.
  bool outlines(const glm::dvec3& eye) const;
};

// What an object's outline is made of.
struct MeshOutline {
  std::vector<glm::dvec3> points;  // at most 512, for a convex hull: see outlinePoints
  std::vector<MeshEdge> edges;     // none of a mesh with too many triangles to look at each time
};
MeshOutline meshOutline(const Mesh& mesh);

// Vertices of the mesh that its convex hull runs through, at most 512, relative to Mesh::center: all of a small mesh,
// of a large one those farthest in evenly spread directions.
std::vector<glm::dvec3> outlinePoints(const Mesh& mesh);

}  // namespace speculum
