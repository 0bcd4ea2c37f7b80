#include "geometry/mesh_clusters.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <unordered_map>

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

// The vertices of a part, numbered from 0. One of many triangles counts as another after every few of them, since the
// time of sorting grows with the triangles around a vertex.
struct PartVertices {
  std::vector<uint32_t> indices;     // into the others
  std::vector<uint32_t> ofMesh;      // vertices
  std::vector<glm::vec3> positions;  // scaled to about unit size, so that floats can hold them

  PartVertices(const Mesh& mesh, std::span<const uint32_t> all) {
    constexpr uint32_t mostTriangles = 256;
    struct Last {
      uint32_t index;
      uint32_t triangles;
    };
    std::unordered_map<uint32_t, Last> last;  // by vertex of the mesh
    for (const uint32_t vertex : all) {
      const auto [found, isNew] = last.try_emplace(vertex);
      if (isNew || found->second.triangles == mostTriangles) {
        found->second = {static_cast<uint32_t>(ofMesh.size()), 0};
        ofMesh.push_back(vertex);
        positions.emplace_back(mesh.vertices[vertex].position / mesh.radius);
      }
      ++found->second.triangles;
      indices.push_back(found->second.index);
    }
  }
};

void sortTriangles(const Mesh& mesh, std::span<uint32_t> indices) {
  constexpr size_t triangles = clusterIndices / 3;
  constexpr size_t vertices = 64;
  const PartVertices part(mesh, indices);
  const size_t most = meshopt_buildMeshletsBound(indices.size(), vertices, triangles);
  std::vector<meshopt_Meshlet> meshlets(most);
  std::vector<uint32_t> meshletVertices(most * vertices);
  std::vector<uint8_t> corners(most * clusterIndices);
  meshlets.resize(meshopt_buildMeshlets(meshlets.data(), meshletVertices.data(), corners.data(), part.indices.data(),
                                        part.indices.size(), &part.positions[0].x, part.positions.size(),
                                        sizeof(glm::vec3), vertices, triangles, 0.0f));
  size_t next = 0;
  for (const meshopt_Meshlet& meshlet : meshlets) {
    for (uint32_t i = 0; i < 3 * meshlet.triangle_count; ++i) {
      indices[next++] = part.ofMesh[meshletVertices[meshlet.vertex_offset + corners[meshlet.triangle_offset + i]]];
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
  for (const MeshPart& part : mesh.parts) {
    sortTriangles(mesh, std::span(mesh.indices).subspan(part.firstIndex, part.indexCount));
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
