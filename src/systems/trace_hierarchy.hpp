#pragma once

#include <vector>

#include "core/uploader.hpp"
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

// Both functions give the nodes of all octants, `hierarchy.nodes().size()` for each. Boxes only grow by rounding.
// The first node of a mesh has index `firstNode` in the buffer.
void writeMeshNodes(const Bvh& hierarchy, const TraceGrid& grid, uint32_t firstTriangle, uint32_t firstNode,
                    BufferWriter& nodes);
// `links` has one for each primitive, in the primitives' order before the hierarchy was built.
void appendTopNodes(const Bvh& hierarchy, std::span<const uint32_t> links, std::vector<gpu::TraceTopNode>& nodes);

}  // namespace speculum
