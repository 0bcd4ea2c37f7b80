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
  std::vector<glm::vec3> positions(mesh.vertices.size());  // of about unit size, so that floats can hold them
  std::ranges::transform(mesh.vertices, positions.begin(), [&](const Vertex& v) { return v.position / mesh.radius; });
  std::vector<uint32_t> sorted(mesh.indices.size());
  for (const MeshPart& part : mesh.parts) {
    meshopt_spatialSortTriangles(&sorted[part.firstIndex], &mesh.indices[part.firstIndex], part.indexCount,
                                 &positions[0].x, positions.size(), sizeof(glm::vec3));
  }
  positions = {};
  mesh.indices = std::move(sorted);
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
