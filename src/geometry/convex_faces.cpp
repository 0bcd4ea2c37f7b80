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

using Ring = std::vector<uint32_t>;  // edges in a row, counter-clockwise

// Grows faces one neighbour at a time. An edge is numbered 3 * triangle + corner and starts at that corner. A join
// takes time in the number of the face's edges, because every sum and maximum over a face is carried along.
class FaceJoiner {
 public:
  FaceJoiner(std::span<const glm::dvec3> positions, std::span<const uint32_t> indices) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> edges;  // by first and last point
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
      const std::array<uint32_t, 3> points{welder_.weld(positions[indices[i]]), welder_.weld(positions[indices[i + 1]]),
                                           welder_.weld(positions[indices[i + 2]])};
      addTriangle(points, edges);
    }
    for (const auto& [points, edge] : edges) {
      const auto twin = edges.find({points.second, points.first});
      twins_[edge] = twin == edges.end() ? none : twin->second;
    }
  }

  std::vector<std::vector<glm::dvec3>> faces() {
    for (size_t i = 0; i < faces_.size(); ++i) {
      while (grow(i)) {
      }
    }
    std::vector<std::vector<glm::dvec3>> polygons;
    for (const Face& face : faces_) {
      if (!face.ring.empty()) {
        polygons.push_back(polygon(face.ring));
      }
    }
    return polygons;
  }

 private:
  static constexpr uint32_t none = ~0u;

  struct Face {
    Ring ring;              // empty once it was joined to another
    glm::dvec3 area{0.0};   // see newellVector
    double diameter = 0.0;  // at least that of the ring
  };

  void addTriangle(const std::array<uint32_t, 3>& points, std::map<std::pair<uint32_t, uint32_t>, uint32_t>& edges) {
    const std::array<glm::dvec3, 3> p{welder_.points()[points[0]], welder_.points()[points[1]],
                                      welder_.points()[points[2]]};
    if (!std::isnormal(polygonArea(p))) {
      return;
    }
    const auto first = static_cast<uint32_t>(starts_.size());
    for (uint32_t k = 0; k < 3; ++k) {
      edges[{points[k], points[(k + 1) % 3]}] = first + k;
      starts_.push_back(points[k]);
      owners_.push_back(faces_.size());
      twins_.push_back(none);
    }
    const double longest = std::max({glm::distance(p[0], p[1]), glm::distance(p[1], p[2]), glm::distance(p[2], p[0])});
    faces_.push_back({{first, first + 1, first + 2}, newellVector(p), longest});
  }

  const glm::dvec3& point(uint32_t edge) const { return welder_.points()[starts_[edge]]; }

  std::vector<glm::dvec3> polygon(const Ring& ring) const {
    std::vector<glm::dvec3> points;
    points.reserve(ring.size());
    for (const uint32_t edge : ring) {
      points.push_back(point(edge));
    }
    return points;
  }

  // Joins one neighbour to a face, or returns false when none fits.
  bool grow(size_t index) {
    for (size_t i = 0; i < faces_[index].ring.size(); ++i) {
      const uint32_t twin = twins_[faces_[index].ring[i]];
      if (twin == none || owners_[twin] == index) {
        continue;
      }
      Face& other = faces_[owners_[twin]];
      if (std::optional<Face> joined = join(faces_[index], i, other, twin)) {
        for (const uint32_t edge : other.ring) {
          owners_[edge] = index;
        }
        other = {};
        faces_[index] = std::move(*joined);
        return true;
      }
    }
    return false;
  }

  // Joins two faces across edge `start` of `a`, which is `twin` in `b`, and those beside it that are common too.
  std::optional<Face> join(const Face& a, size_t start, const Face& b, uint32_t twin) const {
    const auto found = std::find(b.ring.begin(), b.ring.end(), twin);
    if (found == b.ring.end() || !(glm::dot(a.area, b.area) > 0.0)) {
      return std::nullopt;
    }
    const size_t n = a.ring.size();
    const size_t m = b.ring.size();
    const size_t end = static_cast<size_t>(found - b.ring.begin()) + 1;  // in b, where edge `start` begins
    const auto common = [&](size_t i, size_t k) { return starts_[a.ring[i % n]] == starts_[b.ring[k % m]]; };
    size_t before = 0;  // common edges before and after the point at `start`
    size_t after = 0;
    while (before < std::min(n, m) && common(start + n - before - 1, end + before + 1)) {
      ++before;
    }
    while (after < std::min(n, m) && common(start + after + 1, end + 2 * m - after - 1)) {
      ++after;
    }
    if (before + after < 1 || before + after >= std::min(n, m)) {
      return std::nullopt;
    }
    Ring added;
    for (size_t i = 0; i < m - before - after; ++i) {
      added.push_back(b.ring[(end + before + i) % m]);
    }
    Face joined{{}, a.area + b.area, std::max(a.diameter, b.diameter)};
    if (!isFlat(joined, added, point(a.ring[(start + after) % n]))) {
      return std::nullopt;
    }
    const size_t kept = n - before - after;
    joined.ring.reserve(kept + added.size());
    for (size_t i = 0; i < kept; ++i) {
      joined.ring.push_back(a.ring[(start + after + i) % n]);
    }
    joined.ring.insert(joined.ring.end(), added.begin(), added.end());
    return isFace(joined, kept) ? std::optional(std::move(joined)) : std::nullopt;
  }

  bool isFlat(const Face& face, std::span<const uint32_t> ring, const glm::dvec3& origin) const {
    const double twice = glm::length(face.area);
    const Plane plane{origin, face.area / twice};
    const double flat = 1e-6 * std::sqrt(0.5 * twice);
    return std::all_of(ring.begin(), ring.end(),
                       [&](uint32_t edge) { return std::abs(plane.distance(point(edge))) <= flat; });
  }

  // Updates the diameter; the edges from `kept` on were added to the face.
  bool isFace(Face& face, size_t kept) const {
    const std::span<const uint32_t> ring = face.ring;
    for (const uint32_t edge : ring.subspan(kept + 1)) {
      for (const uint32_t old : ring.first(kept + 1)) {
        if (starts_[edge] == starts_[old]) {
          return false;
        }
        face.diameter = std::max(face.diameter, glm::distance(point(edge), point(old)));
      }
    }
    const double scale = face.diameter * face.diameter;
    const size_t n = ring.size();
    const glm::dvec3 normal = glm::normalize(face.area);
    const auto turnsLeft = [&](size_t i) {
      const glm::dvec3& p = point(ring[i]);
      const glm::dvec3 in = p - point(ring[(i + n - 1) % n]);
      const glm::dvec3 out = point(ring[(i + 1) % n]) - p;
      return glm::dot(normal, glm::cross(in, out)) >= -1e-9 * scale;
    };
    // Tests the two points where the faces meet first, because joins seldom fail elsewhere.
    if (!turnsLeft(0) || !turnsLeft(kept) || !(0.5 * glm::length(face.area) >= 1e-8 * scale) ||
        !isFlat(face, ring, point(ring[0]))) {
      return false;
    }
    for (size_t i = 0; i < n; ++i) {
      if (!turnsLeft(i)) {
        return false;
      }
    }
    return true;
  }

  PointWelder welder_;
  std::vector<uint32_t> starts_;  // by edge, its first point
  std::vector<uint32_t> twins_;   // by edge, the one in the opposite direction; the last one where there are several
  std::vector<size_t> owners_;    // by edge, its face
  std::vector<Face> faces_;
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
