#pragma once

#include <vector>

#include "edit/picture_view.hpp"
#include "edit/selection.hpp"
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

// Returns the outline of the selected node, or of its image in the mirrors that `picture` looks through; empty where
// the node is not seen. The outline of a mirror is its polygon, that of a light a circle, that of an object the edges
// where its mesh turns away from the eye or ends. An object without edges in `shape`, or with more than 4000 such
// edges, has the convex hull of its points or, if one of them is behind the eye, the edges of its box.
std::vector<PixelLine> outlineOf(const Scene& scene, const SceneState& state, const Selection& selection,
                                 const PictureView& picture, const MeshOutline& shape);

}  // namespace speculum
