#include "systems/trace_hierarchy.hpp"

#include <cmath>
#include <glm/gtx/component_wise.hpp>

namespace speculum {

namespace {

constexpr double steps = 65535.0;

// Says whether rays of the octant usually meet the first box later than the second.
bool isLater(const Bounds& first, const Bounds& second, int octant) {
  const glm::dvec3 apart = first.center() - second.center();
  const glm::dvec3 size = glm::abs(apart);
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  return (apart[axis] > 0.0) == ((octant >> axis & 1) == 0);
}

// Calls emit(node, next) depth first, the nearer child first. `next` is the index of the node after the subtree, among
// the nodes of the octant.
template <typename Emit>
void visitInOrder(const Bvh& hierarchy, int octant, Emit&& emit) {
  const std::span nodes = hierarchy.nodes();
  std::vector<uint32_t> sizes(nodes.size(), 1);
  for (size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].count == 0) {
      sizes[i] += sizes[nodes[i].first] + sizes[nodes[i].first + 1];
    }
  }
  std::vector<uint32_t> stack;
  if (!nodes.empty()) {
    stack.push_back(0);
  }
  for (uint32_t place = 0; !stack.empty(); ++place) {
    const uint32_t i = stack.back();
    stack.pop_back();
    emit(nodes[i], place + sizes[i]);
    if (nodes[i].count == 0) {
      const uint32_t left = nodes[i].first;
      const uint32_t later = isLater(nodes[left].box, nodes[left + 1].box, octant) ? left : left + 1;
      stack.push_back(later);
      stack.push_back(later == left ? left + 1 : left);
    }
  }
}

uint32_t sideOf(double low, double high, bool falls) {
  const auto near = static_cast<uint32_t>(std::clamp(std::floor(low), 0.0, steps));
  const auto far = static_cast<uint32_t>(std::clamp(std::ceil(high), 0.0, steps));
  return falls ? far | near << 16 : near | far << 16;
}

}  // namespace

TraceGrid traceGrid(const Bounds& bounds) {
  TraceGrid grid;
  const glm::dvec3 size = bounds.high - bounds.low;
  const double largest = std::max(glm::compMax(size), 1e-30);
  for (int axis = 0; axis < 3; ++axis) {
    // A margin for rounding to float; axes along which a mesh is flat get steps no finer than floats.
    const double width = std::max(size[axis], 1e-3 * largest);
    grid.low[axis] = static_cast<float>(bounds.low[axis] - 1e-3 * width);
    grid.scale[axis] = static_cast<float>(steps / (1.002 * width));
  }
  return grid;
}

void visitMeshNodes(const Bvh& hierarchy, const TraceGrid& grid, uint32_t firstTriangle, uint32_t firstNode,
                    const std::function<void(const gpu::TraceNode&)>& visit) {
  for (int octant = 0; octant < traceOctants; ++octant) {
    const uint32_t first = firstNode + static_cast<uint32_t>(static_cast<size_t>(octant) * hierarchy.nodes().size());
    visitInOrder(hierarchy, octant, [&](const Bvh::Node& node, uint32_t next) {
      const glm::dvec3 low = (node.box.low - glm::dvec3(grid.low)) * glm::dvec3(grid.scale);
      const glm::dvec3 high = (node.box.high - glm::dvec3(grid.low)) * glm::dvec3(grid.scale);
      gpu::TraceNode made;
      for (int axis = 0; axis < 3; ++axis) {
        made.sides[axis] = sideOf(low[axis], high[axis], (octant >> axis & 1) != 0);
      }
      made.link = node.count > 0 ? gpu::traceLeaf | (firstTriangle + node.first) << 3 | node.count : first + next;
      visit(made);
    });
  }
}

void appendTopNodes(const Bvh& hierarchy, std::span<const uint32_t> links, std::vector<gpu::TraceTopNode>& nodes) {
  for (int octant = 0; octant < traceOctants; ++octant) {
    const auto first = static_cast<uint32_t>(nodes.size());
    visitInOrder(hierarchy, octant, [&](const Bvh::Node& node, uint32_t next) {
      const Bounds box = node.box.widened(1e-6);
      const glm::vec3 low(box.low);
      const glm::vec3 high(box.high);
      gpu::TraceTopNode& added = nodes.emplace_back();
      for (int axis = 0; axis < 3; ++axis) {
        const bool falls = (octant >> axis & 1) != 0;
        added.near[axis] = falls ? high[axis] : low[axis];
        added.far[axis] = falls ? low[axis] : high[axis];
      }
      added.link = node.count > 0 ? gpu::traceLeaf | links[hierarchy.order()[node.first]] : first + next;
    });
  }
}

}  // namespace speculum
