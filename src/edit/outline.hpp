#pragma once

#include "edit/mesh_outline.hpp"
#include "edit/picture_view.hpp"
#include "edit/selection.hpp"

namespace speculum {

// What surrounds the selected thing on the picture, or in the mirrors that `picture` goes through: a mirror's edges; of
// an object the edges of its mesh where it turns away from the eye or ends, without them or with more than 4000 the
// convex hull of its points (the edges of its box where it reaches behind the eye); a circle about a light. Nothing
// where it is not seen.
std::vector<PixelLine> outlineOf(const Scene& scene, const SceneState& state, const Selection& selection,
                                 const PictureView& picture, const MeshOutline& shape);

}  // namespace speculum
