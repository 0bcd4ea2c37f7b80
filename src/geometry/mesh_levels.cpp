#include "geometry/mesh_levels.hpp"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <unordered_map>
#include <utility>

#include "geometry/mesh_clusters.hpp"
#include "geometry/solid_mesh.hpp"
#include "geometry/surface_distance.hpp"

namespace speculum {

struct LevelsOfMesh {
  std::mutex making;
  std::atomic<bool> made = false;
  MeshLevels levels;
};

namespace {

constexpr size_t fewestTriangles = 48;  // of a mesh that is worth a further level
constexpr size_t fewestOfPart = 8;
constexpr double step = 0.7;       // of the triangles, from level to level
constexpr double largeStep = 0.5;  // while there are more than `large` of them
constexpr size_t large = 50'000;
constexpr size_t mostMeasured = 10'000;  // vertices, and triangles, of a part
constexpr double leastGain = 0.15;       // of the triangles, by a level that is worth its memory

double longestSide(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
}

// Largest distance of points and triangles from a surface.
class Deviation {
 public:
  // `spacing`: distance of the points at which triangles are measured; `atLeast`: lower bound of the result.
  Deviation(const SurfaceDistance& surface, double spacing, double atLeast)
      : surface_(surface), spacing_(spacing), largest_(atLeast) {}

  void add(const glm::dvec3& point) {
    if (!surface_.within(point, largest_)) {
      largest_ = std::max(largest_, surface_.to(point));
    }
  }

  // Measures points between the corners, which were added before.
  void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    constexpr double mostSteps = 8.0;
    const double side = longestSide(a, b, c);
    const double apart = std::max(spacing_, 0.5 * largest_);
    const int steps = static_cast<int>(std::ceil(std::clamp(side / apart, 1.0, mostSteps)));
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const glm::dvec3 weight = glm::dvec3(i, j, steps - i - j) / static_cast<double>(steps);
        if (std::max({weight.x, weight.y, weight.z}) < 1.0) {
          add(weight.x * a + weight.y * b + weight.z * c);
        }
      }
    }
  }

  double largest() const { return largest_; }

 private:
  const SurfaceDistance& surface_;
  double spacing_;
  double largest_;
};

// Collects the vertices of a level: one for each normal that its triangles need at a point of the mesh.
class LevelVertices {
 public:
  explicit LevelVertices(std::vector<Vertex>& all) : all_(all) {}

  // Returns the index of the vertex at `point`, a number that identifies a point, whose normal is near that of
  // `vertex`.
  uint32_t find(uint32_t point, const Vertex& vertex) {
    constexpr double steps = 128.0;  // of a normal's coordinates; nearer normals count as one
    uint64_t key = point;
    for (int i = 0; i < 3; ++i) {
      key = key << 9 | static_cast<uint64_t>(std::lround(steps * (1.0 + vertex.normal[i])));
    }
    const auto [found, isNew] = indices_.try_emplace(key, static_cast<uint32_t>(all_.size()));
    if (isNew) {
      all_.push_back(vertex);
    }
    return found->second;
  }

 private:
  std::vector<Vertex>& all_;
  std::unordered_map<uint64_t, uint32_t> indices_;  // into all_, by point and rounded normal
};

// One part of a mesh and its simplified triangles. Vertices of equal position are one point where the surface is
// smooth, with interpolated or with face normals. Across hard edges and seams of texture coordinates they stay several
// points. meshoptimizer keeps points where three or more such edges meet: without its corners a slab becomes thinner,
// and objects below it show through.
class SimplifiedPart {
 public:
  // `firstPoint`: number of the first point, above those of the parts before.
  SimplifiedPart(const Mesh& mesh, const MeshPart& part, uint32_t firstPoint)
      : lockBorder_(mesh.parts.size() > 1), firstPoint_(firstPoint) {
    const bool textured = part.material.diffuseTexture >= 0;
    std::map<std::array<double, 5>, std::vector<uint32_t>> coincident;
    std::unordered_map<uint32_t, uint32_t> points;  // by vertex
    for (uint32_t i = part.firstIndex; i < part.firstIndex + part.indexCount; ++i) {
      const auto [point, isNew] = points.try_emplace(mesh.indices[i]);
      if (isNew) {
        const Vertex& vertex = mesh.vertices[mesh.indices[i]];
        const glm::dvec3& p = vertex.position;
        const glm::dvec2 uv = textured ? vertex.uv : glm::dvec2(0.0);
        point->second = pointFor(vertex, coincident[{p.x, p.y, p.z, uv.x, uv.y}]);
      }
      indices_.push_back(point->second);
    }
    allIndices_ = indices_;
    for (size_t i = 0; i < indices_.size(); i += 3) {
      const double side =
          longestSide(positions_[indices_[i]], positions_[indices_[i + 1]], positions_[indices_[i + 2]]);
      meanSide_ += side / static_cast<double>(indices_.size() / 3);
    }
    original_ = std::make_unique<SurfaceDistance>(corners(indices_));
  }

  void simplify() {
    if (indices_.size() < 3 * fewestOfPart) {
      return;
    }
    std::vector<uint32_t> fewer(indices_.size());
    const size_t triangles = indices_.size() / 3;
    const double part = triangles > large ? largeStep : step;
    const size_t wanted = static_cast<size_t>(part * static_cast<double>(triangles)) * 3;
    constexpr float anyError = 1.0f;  // of the part's extent
    const size_t count =
        meshopt_simplify(fewer.data(), indices_.data(), indices_.size(), &floats_[0].x, floats_.size(),
                         sizeof(glm::vec3), wanted, anyError, lockBorder_ ? meshopt_SimplifyLockBorder : 0, nullptr);
    fewer.resize(count);
    indices_ = std::move(fewer);
  }

  // Distance between the part and its simplified triangles, at least that of the level before.
  double error(double atLeast) const {
    const SurfaceDistance left(corners(indices_));
    Deviation ofMesh(left, meanSide_, atLeast);
    for (size_t i = 0; i < positions_.size(); i += stride(positions_.size())) {
      ofMesh.add(positions_[i]);
    }
    add(ofMesh, allIndices_);
    Deviation ofLevel(*original_, 0.5 * meanSide_, ofMesh.largest());
    add(ofLevel, indices_);
    return ofLevel.largest();
  }

  size_t indexCount() const { return indices_.size(); }
  uint32_t endPoint() const { return firstPoint_ + static_cast<uint32_t>(positions_.size()); }

  void append(LevelVertices& vertices, std::vector<uint32_t>& indices) const {
    for (size_t i = 0; i < indices_.size(); i += 3) {
      const std::array<glm::dvec3, 3> p{positions_[indices_[i]], positions_[indices_[i + 1]],
                                        positions_[indices_[i + 2]]};
      const glm::dvec3 area = glm::cross(p[1] - p[0], p[2] - p[0]);
      if (!std::isnormal(glm::dot(area, area))) {
        continue;
      }
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t point = indices_[i + k];
        indices.push_back(vertices.find(firstPoint_ + point, vertexFor(point, glm::normalize(area))));
      }
    }
  }

 private:
  std::vector<glm::dvec3> corners(const std::vector<uint32_t>& indices) const {
    std::vector<glm::dvec3> corners(indices.size());
    std::ranges::transform(indices, corners.begin(), [&](uint32_t index) { return positions_[index]; });
    return corners;
  }

  // Returns the step between the vertices or triangles that are measured: large parts are sampled.
  static size_t stride(size_t count) { return 1 + count / mostMeasured; }

  void add(Deviation& deviation, const std::vector<uint32_t>& indices) const {
    for (size_t t = 0; t < indices.size() / 3; t += stride(indices.size() / 3)) {
      const uint32_t* corner = &indices[3 * t];
      deviation.add(positions_[corner[0]], positions_[corner[1]], positions_[corner[2]]);
    }
  }

  // Returns the point on the same smooth surface as `vertex` among those of one position, or a new point.
  uint32_t pointFor(const Vertex& vertex, std::vector<uint32_t>& coincident) {
    constexpr double smooth = 0.77;  // cosine; bevels are steeper
    for (const uint32_t point : coincident) {
      if (glm::dot(vertices_[point].front().normal, vertex.normal) >= smooth) {
        vertices_[point].push_back(vertex);
        return point;
      }
    }
    coincident.push_back(static_cast<uint32_t>(positions_.size()));
    positions_.push_back(vertex.position);
    floats_.emplace_back(vertex.position);
    vertices_.push_back({vertex});
    return coincident.back();
  }

  // Returns the vertex at a point whose normal is nearest to a triangle's.
  Vertex vertexFor(uint32_t point, const glm::dvec3& normal) const {
    const std::vector<Vertex>& all = vertices_[point];
    Vertex best = *std::ranges::max_element(
        all, [&](const Vertex& a, const Vertex& b) { return glm::dot(a.normal, normal) < glm::dot(b.normal, normal); });
    if (glm::dot(best.normal, normal) < 0.0) {
      best.normal = normal;
    }
    return best;
  }

  bool lockBorder_;
  uint32_t firstPoint_;
  std::vector<glm::dvec3> positions_;  // by point
  std::vector<glm::vec3> floats_;
  std::vector<std::vector<Vertex>> vertices_;  // of the mesh, by point
  std::vector<uint32_t> allIndices_;           // of the mesh, into positions_
  std::vector<uint32_t> indices_;              // simplified, into positions_
  double meanSide_ = 0.0;                      // mean of the longest sides of the mesh's triangles
  std::unique_ptr<SurfaceDistance> original_;
};

// Appends the simplified triangles of the parts as the next level.
MeshLevel addLevel(const std::vector<SimplifiedPart>& parts, double error, MeshLevels& levels) {
  MeshLevel level{.error = error};
  level.all.first = static_cast<uint32_t>(levels.indices.size());
  LevelVertices vertices(levels.vertices);
  for (const SimplifiedPart& part : parts) {
    const auto first = static_cast<uint32_t>(levels.indices.size());
    part.append(vertices, levels.indices);
    level.parts.push_back({first, static_cast<uint32_t>(levels.indices.size()) - first});
  }
  level.all.count = static_cast<uint32_t>(levels.indices.size()) - level.all.first;
  level.clusters = clustersOf(levels.vertices, levels.indices, level.parts);
  return level;
}

std::shared_ptr<LevelsOfMesh> sharedLevels(const Mesh& mesh) {
  static std::mutex mutex;
  const std::scoped_lock lock(mutex);
  if (!mesh.levels) {
    mesh.levels = std::make_shared<LevelsOfMesh>();
  }
  return mesh.levels;
}

}  // namespace

bool mayHaveLevels(const Mesh& mesh) {
  return mesh.indices.size() >= 3 * fewestTriangles;
}

MeshLevels simplified(const Mesh& mesh, const std::function<bool()>& cancelled) {
  MeshLevels levels;
  if (!mayHaveLevels(mesh)) {
    return levels;
  }
  std::vector<SimplifiedPart> parts;
  for (const MeshPart& part : mesh.parts) {
    parts.emplace_back(mesh, part, parts.empty() ? 0 : parts.back().endPoint());
  }
  size_t last = mesh.indices.size();
  while (last >= 3 * fewestTriangles) {
    if (cancelled && cancelled()) {
      throw std::runtime_error("simplifying was cancelled");
    }
    size_t left = 0;
    for (SimplifiedPart& part : parts) {
      part.simplify();
      left += part.indexCount();
    }
    if (left == 0 || static_cast<double>(left) > (1.0 - leastGain) * static_cast<double>(last)) {
      break;
    }
    double error = levels.levels.empty() ? 0.0 : levels.levels.back().error;
    for (const SimplifiedPart& part : parts) {
      error = part.error(error);
    }
    if (std::isinf(error)) {
      break;
    }
    levels.levels.push_back(addLevel(parts, error, levels));
    last = left;
  }
  if (mesh.solid) {
    std::vector<glm::dvec3> positions(levels.vertices.size());
    std::ranges::transform(levels.vertices, positions.begin(), &Vertex::position);
    for (MeshLevel& level : levels.levels) {
      level.solid = isSolid(positions, std::span(levels.indices).subspan(level.all.first, level.all.count));
    }
  }
  return levels;
}

const MeshLevels& levelsOf(const Mesh& mesh, const std::function<bool()>& cancelled) {
  const std::shared_ptr<LevelsOfMesh> shared = sharedLevels(mesh);
  // Not std::call_once: ThreadSanitizer reports exceptions that leave it, and a cancelled call throws one.
  const std::lock_guard lock(shared->making);
  if (!shared->made) {
    shared->levels = simplified(mesh, cancelled);
    shared->made = true;
  }
  return shared->levels;
}

bool levelsMade(const Mesh& mesh) {
  return !mayHaveLevels(mesh) || sharedLevels(mesh)->made;
}

}  // namespace speculum
