#include "scene/mesh_levels.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "scene/mesh_clusters.hpp"
#include "scene/surface_distance.hpp"

namespace speculum {

namespace {

constexpr size_t fewestTriangles = 48;  // of a mesh that is worth a further level
constexpr size_t fewestOfPart = 8;
constexpr double step = 0.7;        // of the triangles, from level to level
constexpr double leastGain = 0.15;  // of the triangles, by a level that is worth its memory

// Raises `error` to the distance of the point.
void raise(double& error, const SurfaceDistance& surface, const glm::dvec3& point) {
  if (!surface.within(point, error)) {
    error = std::max(error, surface.to(point));
  }
}

// One part of a mesh, and what is left of it.
class SimplifiedPart {
 public:
  SimplifiedPart(const Mesh& mesh, const MeshPart& part, bool lockBorder) : lockBorder_(lockBorder) {
    std::unordered_map<uint32_t, uint32_t> local;
    for (uint32_t i = part.firstIndex; i < part.firstIndex + part.indexCount; ++i) {
      const uint32_t vertex = mesh.indices[i];
      const auto [place, isNew] = local.try_emplace(vertex, static_cast<uint32_t>(vertices_.size()));
      if (isNew) {
        vertices_.push_back(vertex);
        positions_.push_back(mesh.vertices[vertex].position);
        floats_.emplace_back(mesh.vertices[vertex].position);
      }
      indices_.push_back(place->second);
    }
    original_ = std::make_unique<SurfaceDistance>(corners());
  }

  void simplify() {
    if (indices_.size() < 3 * fewestOfPart) {
      return;
    }
    std::vector<uint32_t> fewer(indices_.size());
    const size_t wanted = static_cast<size_t>(step * static_cast<double>(indices_.size() / 3)) * 3;
    constexpr float anyError = 1.0f;  // of the part's extent
    const size_t count =
        meshopt_simplify(fewer.data(), indices_.data(), indices_.size(), &floats_[0].x, floats_.size(),
                         sizeof(glm::vec3), wanted, anyError, lockBorder_ ? meshopt_SimplifyLockBorder : 0, nullptr);
    fewer.resize(count);
    indices_ = std::move(fewer);
  }

  double error() const {
    const SurfaceDistance left(corners());
    double error = 0.0;
    for (const glm::dvec3& position : positions_) {
      raise(error, left, position);
    }
    for (size_t i = 0; i < indices_.size(); i += 3) {
      const glm::dvec3& a = positions_[indices_[i]];
      const glm::dvec3& b = positions_[indices_[i + 1]];
      const glm::dvec3& c = positions_[indices_[i + 2]];
      for (const glm::dvec3& point : {(a + b + c) / 3.0, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)}) {
        raise(error, *original_, point);
      }
    }
    return error;
  }

  size_t indexCount() const { return indices_.size(); }
  void append(std::vector<uint32_t>& indices) const {
    for (const uint32_t index : indices_) {
      indices.push_back(vertices_[index]);
    }
  }

 private:
  std::vector<glm::dvec3> corners() const {
    std::vector<glm::dvec3> corners;
    corners.reserve(indices_.size());
    for (const uint32_t index : indices_) {
      corners.push_back(positions_[index]);
    }
    return corners;
  }

  bool lockBorder_;
  std::vector<uint32_t> vertices_;  // of the mesh
  std::vector<glm::dvec3> positions_;
  std::vector<glm::vec3> floats_;
  std::vector<uint32_t> indices_;  // into `vertices_`
  std::unique_ptr<SurfaceDistance> original_;
};

size_t indexCount(const std::vector<SimplifiedPart>& parts) {
  size_t count = 0;
  for (const SimplifiedPart& part : parts) {
    count += part.indexCount();
  }
  return count;
}

// The next level, of what is left of the parts, with the mesh's vertices.
MeshLevel addLevel(const Mesh& mesh, const std::vector<SimplifiedPart>& parts, std::vector<uint32_t>& indices) {
  MeshLevel level;
  level.all.first = static_cast<uint32_t>(indices.size());
  for (const SimplifiedPart& part : parts) {
    const auto first = static_cast<uint32_t>(indices.size());
    part.append(indices);
    level.parts.push_back({first, static_cast<uint32_t>(indices.size()) - first});
    level.error = std::max(level.error, part.error());
  }
  level.all.count = static_cast<uint32_t>(indices.size()) - level.all.first;
  level.clusters = clustersOf(mesh, indices, level.parts);
  return level;
}

// From indices of the mesh's vertices to those of the levels' own, which it fills.
void numberFromTheCoarsest(const Mesh& mesh, MeshLevels& levels) {
  std::unordered_map<uint32_t, uint32_t> places;
  for (size_t i = levels.levels.size(); i-- > 0;) {
    const IndexRange& all = levels.levels[i].all;
    for (uint32_t k = all.first; k < all.first + all.count; ++k) {
      const auto [place, isNew] = places.try_emplace(levels.indices[k], static_cast<uint32_t>(levels.vertices.size()));
      if (isNew) {
        levels.vertices.push_back(mesh.vertices[levels.indices[k]]);
      }
      levels.indices[k] = place->second;
    }
  }
}

}  // namespace

MeshLevels simplified(const Mesh& mesh) {
  MeshLevels levels;
  if (mesh.indices.size() < 3 * fewestTriangles) {
    return levels;
  }
  std::vector<SimplifiedPart> parts;
  for (const MeshPart& part : mesh.parts) {
    parts.emplace_back(mesh, part, mesh.parts.size() > 1);
  }
  size_t last = mesh.indices.size();
  while (last >= 3 * fewestTriangles) {
    std::for_each(parts.begin(), parts.end(), [](SimplifiedPart& part) { part.simplify(); });
    const size_t left = indexCount(parts);
    if (static_cast<double>(left) > (1.0 - leastGain) * static_cast<double>(last)) {
      break;
    }
    const size_t before = levels.indices.size();
    MeshLevel level = addLevel(mesh, parts, levels.indices);
    if (!std::isfinite(level.error)) {
      levels.indices.resize(before);
      break;
    }
    level.error = std::max(level.error, levels.levels.empty() ? 0.0 : levels.levels.back().error);
    levels.levels.push_back(std::move(level));
    last = left;
  }
  numberFromTheCoarsest(mesh, levels);
  return levels;
}

const MeshLevels& levelsOf(const Mesh& mesh) {
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  if (!mesh.levels) {
    mesh.levels = std::make_shared<const MeshLevels>(simplified(mesh));
  }
  return *mesh.levels;
}

}  // namespace speculum
