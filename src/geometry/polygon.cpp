#include "geometry/polygon.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

double diameter(std::span<const glm::dvec3> polygon) {
  double largest = 0.0;
  for (const glm::dvec3& p : polygon) {
    largest = std::max(largest, farthestDistance(p, polygon));
  }
  return largest;
}

// Says whether no vertex lies farther than `tolerance` outside the line of any edge. Comparing each edge with the next
// is not enough: many small turns to the wrong side add up to a hollow.
bool isConvex(std::span<const glm::dvec3> polygon, const glm::dvec3& normal, double tolerance) {
  const size_t n = polygon.size();
  double turning = 0.0;
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec3 edge = polygon[(i + 1) % n] - polygon[i];
    const glm::dvec3 inwards = glm::cross(normal, edge);
    const double most = tolerance * glm::length(inwards);
    for (const glm::dvec3& p : polygon) {
      if (glm::dot(inwards, p - polygon[i]) < -most) {
        return false;
      }
    }
    const glm::dvec3 next = polygon[(i + 2) % n] - polygon[(i + 1) % n];
    turning += std::atan2(glm::dot(normal, glm::cross(edge, next)), glm::dot(edge, next));
  }
  // A convex outline turns once; a pentagram turns left at every vertex as well, but twice around.
  return turning < 3.0 * 3.14159265358979323846;
}

}  // namespace

std::vector<glm::dvec2> convexHull(std::vector<glm::dvec2> points) {
  std::ranges::sort(points,
                    [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> hull;
  const auto add = [&](const glm::dvec2& p, size_t first) {
    while (hull.size() >= first + 2) {
      const glm::dvec2& start = hull[hull.size() - 2];
      if (cross(hull.back() - start, p - start) > 0.0) {
        break;
      }
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const glm::dvec2& p : points) {
    add(p, 0);
  }
  const size_t lower = hull.empty() ? 0 : hull.size() - 1;
  for (auto p = points.rbegin(); p != points.rend(); ++p) {
    add(*p, lower);
  }
  return hull;
}

glm::dvec3 newellVector(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0.0);
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return sum;
}

glm::dvec3 vertexMean(std::span<const glm::dvec3> polygon) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& p : polygon) {
    sum += p - polygon[0];
  }
  return polygon[0] + sum / static_cast<double>(polygon.size());
}

double polygonArea(std::span<const glm::dvec3> polygon) {
  return 0.5 * glm::length(newellVector(polygon));
}

double farthestDistance(const glm::dvec3& from, std::span<const glm::dvec3> points) {
  double farthest = 0.0;
  for (const glm::dvec3& p : points) {
    farthest = std::max(farthest, glm::length(p - from));
  }
  return farthest;
}

std::optional<std::string> polygonDefect(std::span<const glm::dvec3> polygon) {
  if (polygon.size() < 3) {
    return "has fewer than 3 vertices";
  }
  for (const glm::dvec3& p : polygon) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return "has a vertex that is not finite";
    }
  }
  const double scale = diameter(polygon);
  if (!(polygonArea(polygon) >= 1e-8 * scale * scale) || scale == 0.0) {
    return "has no area";
  }
  const Plane plane{polygon[0], glm::normalize(newellVector(polygon))};
  for (const glm::dvec3& p : polygon) {
    if (std::abs(plane.distance(p)) > 1e-4 * scale) {
      return "is not planar";
    }
  }
  if (!isConvex(flattened(polygon, plane.normal), plane.normal, 1e-5 * scale)) {
    return "is not convex";
  }
  return std::nullopt;
}

Polygon distinctVertices(std::span<const glm::dvec3> polygon, double least) {
  Polygon distinct;
  distinct.reserve(polygon.size());
  for (const glm::dvec3& p : polygon) {
    if (distinct.empty() || glm::length(p - distinct.back()) > least) {
      distinct.push_back(p);
    }
  }
  while (distinct.size() > 1 && glm::length(distinct.front() - distinct.back()) <= least) {
    distinct.pop_back();
  }
  return distinct;
}

std::vector<glm::dvec3> flattened(std::span<const glm::dvec3> polygon, const glm::dvec3& normal) {
  const Plane plane{polygon[0], normal};
  const double size = farthestDistance(polygon[0], polygon);
  std::vector<glm::dvec3> flat(polygon.begin(), polygon.end());
  for (glm::dvec3& vertex : flat) {
    const double distance = plane.distance(vertex);
    vertex -= std::abs(distance) > 1e-12 * size ? distance * normal : glm::dvec3(0.0);
  }
  const Polygon distinct = distinctVertices(flat, 1e-9 * size);
  return {distinct.begin(), distinct.end()};
}

Polygon clipPolygon(std::span<const glm::dvec3> polygon, const Plane& keep) {
  Polygon kept;
  kept.reserve(polygon.size() + 1);
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = keep.distance(a);
    const double db = keep.distance(b);
    if (da >= 0.0) {
      kept.push_back(a);
    }
    if ((da >= 0.0) != (db >= 0.0)) {
      kept.push_back(a + (b - a) * (da / (da - db)));
    }
  }
  return kept;
}

}  // namespace speculum
