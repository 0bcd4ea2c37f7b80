#include "scene/mesh_clusters.hpp"

#include <algorithm>
#include <limits>

namespace speculum {

namespace {

constexpr uint32_t clusterIndices = 3 * 64;
constexpr size_t fewestClusters = 8;

MeshCluster clusterOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices, uint32_t first,
                      uint32_t count) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (uint32_t i = first; i < first + count; ++i) {
    const glm::dvec3& p = vertices[indices[i]].position;
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return {first, count, 0.5 * (low + high), 0.5 * (high - low)};
}

}  // namespace

std::vector<MeshCluster> clustersOf(const Mesh& mesh) {
  std::vector<IndexRange> parts;
  for (const MeshPart& part : mesh.parts) {
    parts.push_back({part.firstIndex, part.indexCount});
  }
  return clustersOf(mesh.vertices, mesh.indices, parts);
}

std::vector<MeshCluster> clustersOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices,
                                    std::span<const IndexRange> parts) {
  std::vector<MeshCluster> clusters;
  uint32_t count = 0;
  for (const IndexRange& part : parts) {
    count += part.count;
  }
  if (count < fewestClusters * clusterIndices) {
    return clusters;
  }
  for (const IndexRange& part : parts) {
    for (uint32_t done = 0; done < part.count; done += clusterIndices) {
      clusters.push_back(clusterOf(vertices, indices, part.first + done, std::min(clusterIndices, part.count - done)));
    }
  }
  return clusters;
}

}  // namespace speculum
