#pragma once

#include <vector>

#include "geometry/bvh.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

// Appends a hierarchy's nodes. Its primitives stand in `order()` from `firstPrimitive` on. Boxes grow by a millionth of
// their coordinates, so that what they hold stays inside when it becomes float.
void appendNodes(const Bvh& hierarchy, uint32_t firstPrimitive, std::vector<gpu::TraceNode>& nodes);

}  // namespace speculum
