#include "frame/occluded_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace speculum {

namespace {

// How much farther from the eye what is hidden has to be, as a part of its distance: the depth test must be sure.
constexpr double depthPart = 1e-4;
constexpr double marginPixels = 1.0;

// A view's axis and what a pixel measures across it at unit depth.
struct Axis {
  Axis(const View& view, const Projection& projection)
      : forward(-glm::transpose(view.worldToView)[2]), pixel(2.0 / (projection.focal * view.pictureSize.y)) {}

  double depth(const glm::dvec3& fromEye) const { return glm::dot(forward, fromEye); }

  glm::dvec3 forward;
  double pixel;
};

// Adds what lies within the edge from a to b of an occluder around `inside` (all from the eye) by `margin`, measured
// across the view at unit depth. The unit normal of the plane through the eye and the edge, inwards; nothing if the
// occluder is too thin to say on which side of the edge it lies.
std::optional<glm::dvec3> addEdge(OccludedRegion& region, const glm::dvec3& a, const glm::dvec3& b,
                                  const glm::dvec3& inside, double margin, const Axis& axis) {
  glm::dvec3 normal = glm::cross(a, b);
  const double length = glm::length(normal);
  if (!(length > 1e-9 * glm::length(a) * glm::length(b))) {
    return std::nullopt;
  }
  normal *= (glm::dot(normal, inside) < 0.0 ? -1.0 : 1.0) / length;
  region.push_back({normal - margin * axis.forward, 0.0});
  return region.back().at(inside) > 0.0 ? std::optional(normal) : std::nullopt;
}

// Without vertices that clipping put on top of another.
std::vector<glm::dvec3> distinctVertices(const std::vector<glm::dvec3>& polygon, double least) {
  std::vector<glm::dvec3> kept;
  for (const glm::dvec3& p : polygon) {
    if (kept.empty() || glm::length(p - kept.back()) > least) {
      kept.push_back(p);
    }
  }
  while (kept.size() > 1 && glm::length(kept.front() - kept.back()) <= least) {
    kept.pop_back();
  }
  return kept;
}

// Andrew's monotone chain (1979): those of the points, in order around them, that no others surround.
std::vector<size_t> outline(const std::vector<glm::dvec2>& points) {
  std::vector<size_t> order(points.size());
  for (size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
  }
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  std::vector<size_t> chain;
  const auto extend = [&](size_t i, size_t least) {
    const auto turnsLeft = [&] {
      const glm::dvec2 a = points[chain.back()] - points[chain[chain.size() - 2]];
      const glm::dvec2 b = points[i] - points[chain.back()];
      return a.x * b.y - a.y * b.x > 0.0;
    };
    while (chain.size() >= least && !turnsLeft()) {
      chain.pop_back();
    }
    chain.push_back(i);
  };
  for (const size_t i : order) {
    extend(i, 2);
  }
  const size_t lower = chain.size();
  for (size_t i = order.size() - 1; i-- > 0;) {
    extend(order[i], lower + 1);
  }
  chain.pop_back();
  return chain;
}

}  // namespace

std::optional<OccludedRegion> hiddenByFace(const FlatOccluder& occluder, const View& view,
                                           const Projection& projection) {
  const double height = occluder.plane.distance(view.eye);
  const double eye = std::abs(height);
  if (!(eye > occluder.slack)) {
    return std::nullopt;
  }
  std::vector<glm::dvec3> drawn = occluder.polygon;
  if (view.clip) {
    drawn = clipPolygon(drawn, Plane{view.clip->point + occluder.slack * view.clip->normal, view.clip->normal});
  }
  drawn = distinctVertices(drawn, 0.01 * occluder.slack);
  if (drawn.size() < 3) {
    return std::nullopt;
  }
  const Axis axis(view, projection);
  // The line of sight through v meets the occluder's plane at v * eye / toPlane(v), in front of v if toPlane(v) > eye.
  const glm::dvec3 toPlane = occluder.plane.normal * (height > 0.0 ? -1.0 : 1.0);
  OccludedRegion region = {{toPlane, -eye - occluder.slack},
                           {(1.0 - depthPart) * toPlane, -eye},
                           {eye * axis.forward - (1.0 + depthPart) * projection.near * toPlane, 0.0}};
  region.reserve(region.size() + 2 * drawn.size());
  const glm::dvec3 inside = vertexMean(drawn) - view.eye;
  for (size_t i = 0; i < drawn.size(); ++i) {
    const auto normal = addEdge(region, drawn[i] - view.eye, drawn[(i + 1) % drawn.size()] - view.eye, inside,
                                marginPixels * axis.pixel, axis);
    if (!normal) {
      return std::nullopt;
    }
    region.push_back({eye * *normal - occluder.slack * toPlane, 0.0});
  }
  return region;
}

std::optional<OccludedRegion> hiddenByBody(std::span<const glm::dvec3> vertices, double slack,
                                           const FlatOccluder& target, const View& view, const Projection& projection) {
  const Axis axis(view, projection);
  const double eye = target.plane.distance(view.eye);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  double aboveTarget = std::numeric_limits<double>::infinity();
  std::vector<glm::dvec3> fromEye;
  std::vector<glm::dvec2> projected;
  for (const glm::dvec3& p : vertices) {
    if (view.clip && view.clip->distance(p) < slack) {
      return std::nullopt;
    }
    fromEye.push_back(p - view.eye);
    const double depth = axis.depth(fromEye.back());
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
    aboveTarget = std::min(aboveTarget, (eye > 0.0 ? 1.0 : -1.0) * target.plane.distance(p));
    const glm::dvec3 inView = view.worldToView * fromEye.back();
    projected.emplace_back(glm::dvec2(inView) / depth);
  }
  if (!(nearest > (1.0 + depthPart) * projection.near + slack)) {
    return std::nullopt;
  }
  OccludedRegion region;
  if (!(aboveTarget > depthPart * std::abs(eye) + slack + target.slack)) {
    region.push_back({axis.forward, -(1.0 + depthPart) * farthest - slack});
  }
  const glm::dvec3 inside = vertexMean(fromEye);
  const std::vector<size_t> around = outline(projected);
  if (around.size() < 3) {
    return std::nullopt;
  }
  // What is at least `nearest` deep is at least `slack` within the outline there.
  const double margin = marginPixels * axis.pixel + slack / nearest;
  for (size_t i = 0; i < around.size(); ++i) {
    if (!addEdge(region, fromEye[around[i]], fromEye[around[(i + 1) % around.size()]], inside, margin, axis)) {
      return std::nullopt;
    }
  }
  return region;
}

std::vector<std::vector<glm::dvec3>> outside(const OccludedRegion& region, const glm::dvec3& eye,
                                             const std::vector<std::vector<glm::dvec3>>& polygons) {
  std::vector<std::vector<glm::dvec3>> pieces;
  for (const std::vector<glm::dvec3>& polygon : polygons) {
    std::vector<glm::dvec3> within = polygon;
    std::vector<std::vector<glm::dvec3>> cut;
    for (const HalfSpace& half : region) {
      const auto inside = [&](const glm::dvec3& p) { return half.at(p - eye) > 0.0; };
      if (std::all_of(within.begin(), within.end(), inside)) {
        continue;
      }
      const double slope2 = glm::dot(half.gradient, half.gradient);
      const bool apart = !(slope2 > 0.0) || std::none_of(within.begin(), within.end(), inside);
      if (apart) {
        cut.clear();
        cut.push_back(polygon);
        within.clear();
        break;
      }
      const glm::dvec3 point = eye - half.gradient * (half.constant / slope2);
      const glm::dvec3 normal = half.gradient / std::sqrt(slope2);
      cut.push_back(clipPolygon(within, {point, -normal}));
      within = clipPolygon(within, {point, normal});
    }
    pieces.insert(pieces.end(), cut.begin(), cut.end());
  }
  return pieces;
}

}  // namespace speculum
