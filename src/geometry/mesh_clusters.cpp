#include "geometry/mesh_clusters.hpp"

#include <meshoptimizer.h>

#include <algorithm>

#include "geometry/bvh.hpp"

namespace speculum {

namespace {

constexpr uint32_t clusterIndices = 3 * 64;
constexpr size_t fewestClusters = 8;

MeshCluster clusterOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices, uint32_t first,
                      uint32_t count) {
  Bounds box;
  for (uint32_t i = first; i < first + count; ++i) {
    box.add(vertices[indices[i]].position);
  }
  return {first, count, box.center(), 0.5 * (box.high - box.low)};
}

// Positions scaled to about unit size, so that floats can hold them.
std::vector<glm::vec3> unitPositions(const Mesh& mesh) {
  std::vector<glm::vec3> positions;
  positions.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) {
    positions.emplace_back(vertex.position / mesh.radius);
  }
  return positions;
}

void sortTriangles(std::span<uint32_t> indices, const std::vector<glm::vec3>& positions) {
  constexpr size_t triangles = clusterIndices / 3;
  constexpr size_t vertices = 64;
  const size_t most = meshopt_buildMeshletsBound(indices.size(), vertices, triangles);
  std::vector<meshopt_Meshlet> meshlets(most);
  std::vector<uint32_t> meshletVertices(most * vertices);
  std::vector<uint8_t> corners(most * clusterIndices);
  meshlets.resize(meshopt_buildMeshlets(meshlets.data(), meshletVertices.data(), corners.data(), indices.data(),
                                        indices.size(), &positions[0].x, positions.size(), sizeof(glm::vec3), vertices,
                                        triangles, 0.0f));
  size_t next = 0;
  for (const meshopt_Meshlet& meshlet : meshlets) {
    for (uint32_t i = 0; i < 3 * meshlet.triangle_count; ++i) {
      indices[next++] = meshletVertices[meshlet.vertex_offset + corners[meshlet.triangle_offset + i]];
    }
  }
}

void sortVertices(Mesh& mesh) {
  std::vector<uint32_t> remap(mesh.vertices.size());
  std::vector<Vertex> sorted(
      meshopt_optimizeVertexFetchRemap(remap.data(), mesh.indices.data(), mesh.indices.size(), mesh.vertices.size()));
  for (uint32_t& index : mesh.indices) {
    sorted[remap[index]] = mesh.vertices[index];
    index = remap[index];
  }
  mesh.vertices = std::move(sorted);
}

}  // namespace

void sortIntoClusters(Mesh& mesh) {
  if (mesh.indices.size() < fewestClusters * clusterIndices) {
    return;
  }
  const std::vector<glm::vec3> positions = unitPositions(mesh);
  for (const MeshPart& part : mesh.parts) {
    sortTriangles(std::span(mesh.indices).subspan(part.firstIndex, part.indexCount), positions);
  }
  sortVertices(mesh);
}

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
