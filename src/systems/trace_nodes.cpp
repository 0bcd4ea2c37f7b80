#include "systems/trace_nodes.hpp"

namespace speculum {

void appendNodes(const Bvh& hierarchy, uint32_t firstPrimitive, std::vector<gpu::TraceNode>& nodes) {
  const auto firstNode = static_cast<uint32_t>(nodes.size());
  for (const Bvh::Node& node : hierarchy.nodes()) {
    const glm::dvec3 reach = glm::max(glm::abs(node.box.low), glm::abs(node.box.high));
    const double margin = 1e-6 * std::max({reach.x, reach.y, reach.z});
    nodes.push_back({.low = glm::vec3(node.box.low - margin),
                     .first = node.first + (node.count > 0 ? firstPrimitive : firstNode),
                     .high = glm::vec3(node.box.high + margin),
                     .count = node.count});
  }
}

}  // namespace speculum
