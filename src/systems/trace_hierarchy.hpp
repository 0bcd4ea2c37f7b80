#pragma once

#include <functional>
#include <vector>

#include "geometry/bvh.hpp"
#include "shaders/gpu_data.h"

namespace speculum {

// Hierarchies of boxes as shaders follow them, without a stack: gpu_data.h says how nodes are linked.

// A hierarchy has its nodes once for each octant of directions; bit i of an octant: they are negative along axis i.
constexpr int traceOctants = 8;

// Axis-aligned grid that holds the boxes of a mesh.
struct TraceGrid {
  glm::vec3 low{0.0f};    // mesh space
  glm::vec3 scale{1.0f};  // steps of the grid per metre of mesh space
};
TraceGrid traceGrid(const Bounds& bounds);

// Calls `visit` with the nodes of a mesh for all octants in the order of the buffer, `hierarchy.nodes().size()` for
// each octant. The first one has index `firstNode` in the buffer. Boxes only grow by rounding.
void visitMeshNodes(const Bvh& hierarchy, const TraceGrid& grid, uint32_t firstTriangle, uint32_t firstNode,
                    const std::function<void(const gpu::TraceNode&)>& visit);
// Appends nodes likewise. `links` has one for each primitive, in the primitives' order before the hierarchy was built.
void appendTopNodes(const Bvh& hierarchy, std::span<const uint32_t> links, std::vector<gpu::TraceTopNode>& nodes);

}  // namespace speculum
