#pragma once

#include "edit/mesh_outline.hpp"
#include "edit/picture_view.hpp"
#include "edit/selection.hpp"

namespace speculum {

// Returns the outline of the selected node, or of its image in the mirrors that `picture` looks through; empty where it
// is not seen. That of a mirror is its polygon, that of a light a circle, that of an object the edges where its mesh
// turns away from the eye or ends. An object without such edges, or with more than 4000, has the convex hull of its
// points or, if one of them is behind the eye, the edges of its box.
std::vector<PixelLine> outlineOf(const Scene& scene, const SceneState& state, const Selection& selection,
                                 const PictureView& picture, const MeshOutline& shape);

}  // namespace speculum
