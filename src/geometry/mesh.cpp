#include "geometry/mesh.hpp"

#include <meshoptimizer.h>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geometry/bvh.hpp"

namespace speculum {

namespace {

// A row or column that a texel of a smaller picture covers, and its share of that texel.
struct Share {
  int index;
  float weight;
};

std::vector<Share> sharesOf(int texel, int count, int size) {
  const double from = static_cast<double>(texel) * size / count;
  const double to = static_cast<double>(texel + 1) * size / count;
  std::vector<Share> shares;
  for (int i = static_cast<int>(from); i < size && i < to; ++i) {
    const double covered = std::min(to, i + 1.0) - std::max<double>(from, i);
    shares.push_back({i, static_cast<float>(covered / (to - from))});
  }
  return shares;
}

constexpr uint32_t clusterIndices = 3 * 64;
constexpr size_t fewestClusters = 8;

MeshCluster clusterOf(const Mesh& mesh, uint32_t first, uint32_t count) {
  Bounds box;
  for (uint32_t i = first; i < first + count; ++i) {
    box.add(mesh.vertices[mesh.indices[i]].position);
  }
  return {first, count, box.center(), 0.5 * (box.high - box.low)};
}

// The vertices of a part, numbered from 0. A vertex of many triangles gets another number after every 256 of them,
// since the time of sorting grows with the triangles around a vertex.
struct PartVertices {
  std::vector<uint32_t> indices;     // numbers of vertices: indices into the lists below
  std::vector<uint32_t> ofMesh;      // vertex of the mesh
  std::vector<glm::vec3> positions;  // scaled to about unit size, so that floats can hold them

  // The number of a vertex of the mesh within the part, and how many more triangles may use that number.
  struct Last {
    uint32_t index = 0;
    uint32_t trianglesLeft = 0;
  };

  // `last` has an entry for each vertex of the mesh, whose `trianglesLeft` is 0 before and after.
  PartVertices(const Mesh& mesh, std::span<const uint32_t> all, std::span<Last> last) {
    constexpr uint32_t mostTriangles = 256;
    indices.reserve(all.size());
    for (const uint32_t vertex : all) {
      Last& found = last[vertex];
      if (found.trianglesLeft == 0) {
        found = {static_cast<uint32_t>(ofMesh.size()), mostTriangles};
        ofMesh.push_back(vertex);
        positions.emplace_back(mesh.vertices[vertex].position / mesh.radius);
      }
      --found.trianglesLeft;
      indices.push_back(found.index);
    }
    for (const uint32_t vertex : all) {
      last[vertex].trianglesLeft = 0;
    }
  }
};

// Says whether many triangles lie in one place, going by some of them. Sorting compares each of these with all others.
bool coincide(const PartVertices& part) {
  constexpr size_t samples = 4096;
  constexpr ptrdiff_t most = samples / 64;
  const size_t triangles = part.indices.size() / 3;
  std::vector<std::array<float, 3>> places;
  for (size_t i = 0; i < samples && triangles >= samples; ++i) {
    const uint32_t* triangle = &part.indices[i * triangles / samples * 3];
    const glm::vec3 place = part.positions[triangle[0]] + part.positions[triangle[1]] + part.positions[triangle[2]];
    places.push_back({place.x, place.y, place.z});
  }
  std::ranges::sort(places);
  for (auto first = places.begin(); first != places.end();) {
    const auto next = std::upper_bound(first, places.end(), *first);
    if (next - first > most) {
      return true;
    }
    first = next;
  }
  return false;
}

void sortTriangles(const Mesh& mesh, std::span<uint32_t> indices, std::span<PartVertices::Last> last) {
  constexpr size_t triangles = clusterIndices / 3;
  constexpr size_t vertices = 64;
  const PartVertices part(mesh, indices, last);
  if (coincide(part)) {
    return;
  }
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

// Sorts the vertices in place by their first use, and drops those without a use.
void sortVertices(Mesh& mesh) {
  std::vector<uint32_t> places(mesh.vertices.size());
  const size_t used =
      meshopt_optimizeVertexFetchRemap(places.data(), mesh.indices.data(), mesh.indices.size(), places.size());
  for (uint32_t& index : mesh.indices) {
    index = places[index];
  }
  auto next = static_cast<uint32_t>(used);
  for (uint32_t& place : places) {
    place = place == ~0u ? next++ : place;
  }
  for (uint32_t i = 0; i < places.size(); ++i) {
    while (places[i] != i) {
      const uint32_t place = places[i];
      std::swap(mesh.vertices[i], mesh.vertices[place]);
      if (!mesh.colors.empty()) {
        std::swap(mesh.colors[i], mesh.colors[place]);
      }
      std::swap(places[i], places[place]);
    }
  }
  mesh.vertices.resize(used);
  mesh.colors.resize(mesh.colors.empty() ? 0 : used);
}

}  // namespace

glm::dvec4 textureAt(const Texture& texture, const glm::dvec2& uv, bool clamps) {
  if (texture.texels.empty()) {
    return glm::dvec4(1.0);
  }
  const auto place = [&](double along, int size) {
    return clamps ? std::clamp(along * size, 0.5, size - 0.5) - 0.5 : (along - std::floor(along)) * size - 0.5;
  };
  const auto wrap = [](int i, int size) { return ((i % size) + size) % size; };
  const double x = place(uv.x, texture.width);
  const double y = place(1.0 - uv.y, texture.height);
  const double cornerX = std::floor(x);
  const double cornerY = std::floor(y);
  const auto texel = [&](int dx, int dy) {
    const int column = wrap(static_cast<int>(cornerX) + dx, texture.width);
    const int row = wrap(static_cast<int>(cornerY) + dy, texture.height);
    const size_t i = static_cast<size_t>(row) * static_cast<size_t>(texture.width) + static_cast<size_t>(column);
    return glm::dvec4(texture.texels[i], texture.opacity.empty() ? 1.0f : texture.opacity[i]);
  };
  const double wx = x - cornerX;
  const double wy = y - cornerY;
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), wx), glm::mix(texel(0, 1), texel(1, 1), wx), wy);
}

Texture shrunk(const Texture& texture, int width, int height) {
  Texture small{.source = texture.source,
                .linear = texture.linear,
                .width = width,
                .height = height,
                .mean = texture.mean,
                .hasAlpha = texture.hasAlpha,
                .isMask = texture.isMask};
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      glm::vec3 sum(0.0f);
      float opacity = 0.0f;
      for (const Share& row : sharesOf(y, small.height, texture.height)) {
        for (const Share& column : sharesOf(x, small.width, texture.width)) {
          const size_t i =
              static_cast<size_t>(row.index) * static_cast<size_t>(texture.width) + static_cast<size_t>(column.index);
          sum += row.weight * column.weight * texture.texels[i];
          opacity += texture.opacity.empty() ? 0.0f : row.weight * column.weight * texture.opacity[i];
        }
      }
      small.texels.push_back(sum);
      if (!texture.opacity.empty()) {
        small.opacity.push_back(opacity);
      }
    }
  }
  return small;
}

bool Mesh::isTransparent() const {
  return std::ranges::any_of(parts, [](const MeshPart& part) { return part.material.isTransparent(); });
}

bool Mesh::hasVertexAlpha() const {
  return std::ranges::any_of(parts, [](const MeshPart& part) { return part.material.vertexAlpha; });
}

std::vector<glm::dvec3> Mesh::positions() const {
  std::vector<glm::dvec3> positions(vertices.size());
  std::ranges::transform(vertices, positions.begin(), &Vertex::position);
  return positions;
}

void countFlat(Mesh& mesh) {
  const auto isFlat = [](const Vertex& vertex) { return vertex.normal == glm::dvec3(0.0); };
  mesh.flatVertices = static_cast<uint32_t>(std::ranges::count_if(mesh.vertices, isFlat));
  mesh.flatCorners = 0;
  for (size_t i = 0; i < mesh.indices.size() && mesh.flatVertices > 0; ++i) {
    mesh.flatCorners += isFlat(mesh.vertices[mesh.indices[i]]);
  }
}

std::array<glm::dvec3, 3> cornerNormals(const Mesh& mesh, const uint32_t* triangle) {
  const std::array corners{&mesh.vertices[triangle[0]], &mesh.vertices[triangle[1]], &mesh.vertices[triangle[2]]};
  std::array normals{corners[0]->normal, corners[1]->normal, corners[2]->normal};
  if (std::ranges::find(normals, glm::dvec3(0.0)) != normals.end()) {
    const glm::dvec3 area =
        glm::cross(corners[1]->position - corners[0]->position, corners[2]->position - corners[0]->position);
    const double size = glm::length(area);
    const glm::dvec3 own =
        size > 1e-150 ? area / size : glm::dvec3(0.0, 1.0, 0.0);  // of a sliver that rounding flattened
    std::ranges::replace(normals, glm::dvec3(0.0), own);
  }
  return normals;
}

ShadedVertices::ShadedVertices(const Mesh& mesh) : mesh_(mesh) {
  if (mesh.flatVertices == 0) {
    return;
  }
  std::vector<uint32_t> places(mesh.vertices.size());
  uint32_t next = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    places[i] = mesh.vertices[i].normal == glm::dvec3(0.0) ? ~0u : next++;
  }
  indices_.reserve(mesh.indices.size());
  for (const uint32_t index : mesh.indices) {
    indices_.push_back(places[index] == ~0u ? next++ : places[index]);
  }
}

std::vector<glm::vec4> ShadedVertices::colors() const {
  if (mesh_.colors.empty() || mesh_.flatVertices == 0) {
    return mesh_.colors;
  }
  std::vector<glm::vec4> colors(countOf(mesh_));
  for (size_t i = 0; i < indices_.size(); ++i) {
    colors[indices_[i]] = mesh_.colors[mesh_.indices[i]];
  }
  return colors;
}

void sortIntoClusters(Mesh& mesh) {
  if (mesh.indices.size() < fewestClusters * clusterIndices) {
    return;
  }
  std::vector<PartVertices::Last> last(mesh.vertices.size());
  for (const MeshPart& part : mesh.parts) {
    sortTriangles(mesh, std::span(mesh.indices).subspan(part.firstIndex, part.indexCount), last);
  }
  last = {};
  sortVertices(mesh);
}

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
