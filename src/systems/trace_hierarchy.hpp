#pragma once

#include <vector>

#include "geometry/bvh.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

// Hierarchies of boxes as shaders follow them, without a stack: gpu_data.h says how nodes are linked.

// Axis-aligned grid that holds the boxes of a mesh.
struct TraceGrid {
  glm::vec3 low{0.0f};    // mesh space
  glm::vec3 scale{1.0f};  // steps of the grid per metre of mesh space
};
TraceGrid traceGrid(const Bounds& bounds);

// Append the nodes for all octants, `hierarchy.nodes().size()` for each. Boxes only grow by rounding.
void appendMeshNodes(const Bvh& hierarchy, const TraceGrid& grid, uint32_t firstTriangle,
                     std::vector<gpu::TraceNode>& nodes);
// `links` has one for each primitive, in the primitives' order before the hierarchy was built.
void appendTopNodes(const Bvh& hierarchy, std::span<const uint32_t> links, std::vector<gpu::TraceTopNode>& nodes);

}  // namespace speculum
