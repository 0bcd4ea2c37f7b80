#pragma once

#include "edit/picture_view.hpp"
#include "edit/selection.hpp"

namespace speculum {

// Vertices of the mesh that its outline runs through, at most 512, relative to Mesh::center: all of a small mesh,
// of a large one those farthest in evenly spread directions.
std::vector<glm::dvec3> outlinePoints(const Mesh& mesh);

// What surrounds the selected thing on the picture, or in the mirrors that `picture` goes through: a mirror's edges,
// the convex hull of an object's `points` (of outlinePoints; the edges of its box where it reaches behind the eye), a
// circle about a light. Nothing where it is not seen.
std::vector<PixelLine> outlineOf(const Scene& scene, const SceneState& state, const Selection& selection,
                                 const PictureView& picture, std::span<const glm::dvec3> points);

}  // namespace speculum
