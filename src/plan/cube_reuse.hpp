#pragma once

#include "plan/cube_face.hpp"
#include "plan/image_reuse.hpp"

namespace speculum {

// Finds the faces of shadow maps that must be drawn: faces that are read and whose content differs from `before`, the
// maps of the frame before. Without reflection.skip_unchanged or `around.changes`, all faces that are read are drawn;
// and so they are if the faces together draw more than four million instances, which would take too much memory to
// compare. In a face that changes again, casters that stand still are drawn to a layer. Adds faces and layers to the
// plan, whose list of passes must be empty.
void addShadowMaps(FramePlan& plan, PlannedCubes maps, std::span<const Cube> before, const ImageSurroundings& around);

// Reuses environment maps of the frame before (`before`), by reflection.skip_unchanged and
// effects.environment_interval; maps that are not reused get a new serial. `around.maps` is empty, since an environment
// map shows no other. Adds the faces of all maps to the plan, behind the faces of the shadow maps.
void addEnvironmentMaps(FramePlan& plan, PlannedCubes maps, std::span<const Cube> before,
                        const ImageSurroundings& around, const View& main);

}  // namespace speculum
