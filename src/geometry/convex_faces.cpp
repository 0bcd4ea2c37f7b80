#include "geometry/convex_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "geometry/polygon.hpp"
#include "geometry/weld.hpp"

namespace speculum {

namespace {

using Ring = std::vector<uint32_t>;  // of welded vertices, counter-clockwise; empty: joined to another

class FaceJoiner {
 public:
  FaceJoiner(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices) {
    const auto weld = [&](uint32_t index) { return welder_.weld(positions[index]); };
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
      const Ring ring = {weld(indices[i]), weld(indices[i + 1]), weld(indices[i + 2])};
      if (std::isnormal(polygonArea(polygon(ring)))) {
        rings_.push_back(ring);
        enter(rings_.size() - 1);
      }
    }
  }

  std::vector<std::vector<glm::dvec3>> faces() {
    for (size_t i = 0; i < rings_.size(); ++i) {
      while (grow(i)) {
      }
    }
    std::vector<std::vector<glm::dvec3>> faces;
    for (const Ring& ring : rings_) {
      if (!ring.empty()) {
        faces.push_back(polygon(ring));
      }
    }
    return faces;
  }

 private:
  using Edge = std::pair<uint32_t, uint32_t>;

  std::vector<glm::dvec3> polygon(const Ring& ring) const {
    std::vector<glm::dvec3> points;
    points.reserve(ring.size());
    for (const uint32_t i : ring) {
      points.push_back(welder_.points()[i]);
    }
    return points;
  }

  void enter(size_t index) {
    const Ring& ring = rings_[index];
    for (size_t i = 0; i < ring.size(); ++i) {
      owners_[{ring[i], ring[(i + 1) % ring.size()]}] = index;
    }
  }

  // Joins one neighbour to a ring; whether there was one.
  bool grow(size_t index) {
    const Ring ring = rings_[index];
    for (size_t i = 0; i < ring.size(); ++i) {
      const auto owner = owners_.find({ring[(i + 1) % ring.size()], ring[i]});
      if (owner == owners_.end() || owner->second == index || rings_[owner->second].empty()) {
        continue;
      }
      const size_t other = owner->second;
      if (std::optional<Ring> joined = join(ring, i, rings_[other])) {
        rings_[index] = std::move(*joined);
        rings_[other].clear();
        enter(index);
        return true;
      }
    }
    return false;
  }

  // Across the edge at `start` of `a` and those beside it that are common too.
  std::optional<Ring> join(const Ring& a, size_t start, const Ring& b) const {
    const auto found = std::find(b.begin(), b.end(), a[start]);
    if (found == b.end()) {
      return std::nullopt;
    }
    const size_t n = a.size();
    const size_t m = b.size();
    const auto inB = static_cast<size_t>(found - b.begin());  // of a[start]; the edge enters it
    size_t before = 0;                                        // common edges before and after
    size_t after = 0;
    while (before < std::min(n, m) && a[(start + n - before - 1) % n] == b[(inB + before + 1) % m]) {
      ++before;
    }
    while (after < std::min(n, m) && a[(start + after + 1) % n] == b[(inB + 2 * m - after - 1) % m]) {
      ++after;
    }
    const size_t common = before + after;
    if (common < 1 || common >= std::min(n, m)) {
      return std::nullopt;
    }
    Ring ring;
    for (size_t i = 0; i <= n - common; ++i) {
      ring.push_back(a[(start + after + i) % n]);
    }
    for (size_t i = 1; i < m - common; ++i) {
      ring.push_back(b[(inB + before + i) % m]);
    }
    return isFace(ring, polygon(a), polygon(b)) ? std::optional(ring) : std::nullopt;
  }

  bool isFace(const Ring& ring, std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) const {
    Ring sorted = ring;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end() ||
        !(glm::dot(newellVector(a), newellVector(b)) > 0.0)) {
      return false;
    }
    const std::vector<glm::dvec3> joined = polygon(ring);
    if (polygonDefect(joined)) {
      return false;
    }
    const Plane plane{joined[0], glm::normalize(newellVector(joined))};
    const double flat = 1e-6 * std::sqrt(polygonArea(joined));
    return std::all_of(joined.begin(), joined.end(),
                       [&](const glm::dvec3& p) { return std::abs(plane.distance(p)) <= flat; });
  }

  PointWelder welder_;
  std::vector<Ring> rings_;
  std::map<Edge, size_t> owners_;  // ring on the left of a directed edge; the last one where several claim it
};

}  // namespace

std::vector<std::vector<glm::dvec3>> convexFaces(std::span<const glm::dvec3> positions,
                                                 std::span<const uint32_t> indices, size_t most, size_t mostTriangles) {
  if (indices.size() / 3 > mostTriangles) {
    return {};
  }
  std::vector<std::vector<glm::dvec3>> faces = FaceJoiner(positions, indices).faces();
  std::stable_sort(faces.begin(), faces.end(),
                   [](const auto& a, const auto& b) { return polygonArea(a) > polygonArea(b); });
  faces.resize(std::min(faces.size(), most));
  return faces;
}

}  // namespace speculum
