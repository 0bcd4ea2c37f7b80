#pragma once

#include "plan/cube_face.hpp"
#include "plan/image_reuse.hpp"

namespace speculum {

// Finds the faces that must be drawn: those that are read, and whose content differs from what the frame before left.
// Without reflection.skip_unchanged or `around.changes` these are all faces that are read; so they are if all faces
// together draw more than four million instances, which would take too much memory to compare. In a face that changes
// again, what stands still is drawn to a layer. Adds faces and layers to the plan, whose list must be empty.
void addShadowMaps(FramePlan& plan, PlannedCubes maps, std::span<const Cube> before, const ImageSurroundings& around);

// Reuses environment maps of the frame before, by reflection.skip_unchanged and effects.environment_interval; the
// others get a new serial. `around` is without maps, since a map shows none. Adds their faces to the plan behind those
// of the shadow maps.
void addEnvironmentMaps(FramePlan& plan, PlannedCubes maps, std::span<const Cube> before,
                        const ImageSurroundings& around, const View& main);

}  // namespace speculum
