#include "scene/mesh_clusters.hpp"

#include <algorithm>
#include <limits>

namespace speculum {

namespace {

constexpr uint32_t clusterIndices = 3 * 64;
constexpr size_t fewestClusters = 8;

MeshCluster clusterOf(const Mesh& mesh, uint32_t first, uint32_t count) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (uint32_t i = first; i < first + count; ++i) {
    const glm::dvec3& p = mesh.vertices[mesh.indices[i]].position;
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return {first, count, 0.5 * (low + high), 0.5 * (high - low)};
}

}  // namespace

std::vector<MeshCluster> clustersOf(const Mesh& mesh) {
  std::vector<MeshCluster> clusters;
  if (mesh.indices.size() < fewestClusters * clusterIndices) {
    return clusters;
  }
  for (const MeshPart& part : mesh.parts) {
    for (uint32_t done = 0; done < part.indexCount; done += clusterIndices) {
      clusters.push_back(clusterOf(mesh, part.firstIndex + done, std::min(clusterIndices, part.indexCount - done)));
    }
  }
  return clusters;
}

}  // namespace speculum
