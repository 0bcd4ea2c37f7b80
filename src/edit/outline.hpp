#pragma once

#include "edit/mesh_outline.hpp"
#include "edit/picture_view.hpp"
#include "edit/selection.hpp"

namespace speculum {

// Outline of the selected node on the picture, or on its image in the mirrors that `picture` goes through; empty where
// it is not seen. A mirror shows its edges, a light a circle. An object shows the edges where its mesh turns away from
// the eye or ends; with none, or more than 4000, the convex hull of its points, or its box where that reaches behind
// the eye.
std::vector<PixelLine> outlineOf(const Scene& scene, const SceneState& state, const Selection& selection,
                                 const PictureView& picture, const MeshOutline& shape);

}  // namespace speculum
