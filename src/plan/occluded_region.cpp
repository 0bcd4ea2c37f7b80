#include "plan/occluded_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace speculum {

namespace {

// Relative distance by which a hidden point must lie beyond the occluder, so that the depth test is sure.
constexpr double depthPart = 1e-4;
constexpr double marginPixels = 1.0;

// A view's axis and the size of a pixel at unit depth.
struct Axis {
  Axis(const View& view, const Projection& projection)
      : forward(-glm::transpose(view.worldToView)[2]), pixel(2.0 / (projection.focal * view.pictureSize.y)) {}

  double depth(const glm::dvec3& fromEye) const { return glm::dot(forward, fromEye); }

  glm::dvec3 forward;
  double pixel;
};

// Adds the half space on the left of the edge from a to b, as seen from the eye, narrowed by `margin`, which is
// measured across the view at unit depth. Returns the unit normal of the plane through eye and edge; nothing if the
// edge points at the eye or `inside` is not on its left. All vectors start at the eye.
std::optional<glm::dvec3> addEdge(OccludedRegion& region, const glm::dvec3& a, const glm::dvec3& b,
                                  const glm::dvec3& inside, double margin, const Axis& axis) {
  glm::dvec3 normal = glm::cross(b, a);
  const double length = glm::length(normal);
  if (!(length > 1e-9 * glm::length(a) * glm::length(b))) {
    return std::nullopt;
  }
  normal /= length;
  region.push_back({normal - margin * axis.forward, 0.0});
  return region.back().at(inside) > 0.0 ? std::optional(normal) : std::nullopt;
}

// Returns the body's outline as seen from the eye: directed edges as pairs of indices into its points. An edge belongs
// to the outline if just one of its two triangles faces the eye.
RecycledVector<std::pair<uint32_t, uint32_t>> outline(const BodyOccluder& body, const glm::dvec3& eye) {
  RecycledVector<int> facing;  // 1 if the triangle runs counter-clockwise from the eye, -1 if clockwise
  facing.reserve(body.normals.size());
  for (size_t i = 0; i < body.normals.size(); ++i) {
    const glm::dvec3& corner = body.points[body.mesh->triangles[i][0]];
    facing.push_back(glm::dot(body.normals[i], eye - corner) > 0.0 ? 1 : -1);
  }
  RecycledVector<std::pair<uint32_t, uint32_t>> outline;
  for (const ConvexMesh::Edge& edge : body.mesh->edges) {
    const int along = facing[edge.triangles[0]] + (edge.sameDirection ? 1 : -1) * facing[edge.triangles[1]];
    if (along != 0) {
      outline.push_back(along > 0 ? std::pair(edge.from, edge.to) : std::pair(edge.to, edge.from));
    }
  }
  return outline;
}

}  // namespace

// The mean of the corners lies within half the width of an edge, and so within that distance of the plane through the
// edge and the eye.
double narrowestFace(const View& view, const Projection& projection) {
  return 2.0 * marginPixels * Axis(view, projection).pixel;
}

bool hiddenByFace(const FlatOccluder& occluder, const View& view, const Projection& projection,
                  OccludedRegion& region) {
  const double height = occluder.plane.distance(view.eye);
  const double eye = std::abs(height);
  if (!(eye > occluder.slack)) {
    return false;
  }
  std::span<const glm::dvec3> drawn = occluder.polygon;
  Polygon clipped;
  if (view.clip) {
    const Plane clip{view.clip->point + occluder.slack * view.clip->normal, view.clip->normal};
    const auto kept = std::ranges::count_if(drawn, [&](const glm::dvec3& p) { return clip.distance(p) >= 0.0; });
    if (kept == 0) {
      return false;
    }
    if (kept < std::ssize(drawn)) {
      clipped = distinctVertices(clipPolygon(drawn, clip), 0.01 * occluder.slack);
      drawn = clipped;
    }
  }
  if (drawn.size() < 3) {
    return false;
  }
  const Axis axis(view, projection);
  // The line of sight through v meets the occluder's plane at v * eye / toPlane(v), in front of v if toPlane(v) > eye.
  const glm::dvec3 toPlane = occluder.plane.normal * (height > 0.0 ? -1.0 : 1.0);
  region.assign({{toPlane, -eye - occluder.slack},
                 {(1.0 - depthPart) * toPlane, -eye},
                 {eye * axis.forward - (1.0 + depthPart) * projection.near * toPlane, 0.0}});
  region.reserve(region.size() + 2 * drawn.size());
  const glm::dvec3 inside = vertexMean(drawn) - view.eye;
  const auto corner = [&](size_t i) {  // counter-clockwise as seen from the eye
    i %= drawn.size();
    return drawn[height < 0.0 ? drawn.size() - 1 - i : i] - view.eye;
  };
  for (size_t i = 0; i < drawn.size(); ++i) {
    const auto normal = addEdge(region, corner(i), corner(i + 1), inside, marginPixels * axis.pixel, axis);
    if (!normal) {
      return false;
    }
    region.push_back({eye * *normal - occluder.slack * toPlane, 0.0});
  }
  return true;
}

std::optional<BodyRegion> hiddenByBody(const BodyOccluder& body, const View& view, const Projection& projection) {
  const Axis axis(view, projection);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (const glm::dvec3& p : body.points) {
    if (view.clip && view.clip->distance(p) < body.slack) {
      return std::nullopt;
    }
    const double depth = axis.depth(p - view.eye);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  if (!(nearest > (1.0 + depthPart) * projection.near + body.slack)) {
    return std::nullopt;
  }
  BodyRegion region{.beyond = {axis.forward, -(1.0 + depthPart) * farthest - body.slack}};
  const glm::dvec3 inside = vertexMean(body.points) - view.eye;
  // A displacement by `slack`, at depth `nearest` or beyond, is seen as slack / nearest at most.
  const double margin = marginPixels * axis.pixel + body.slack / nearest;
  for (const auto& [from, to] : outline(body, view.eye)) {
    if (!addEdge(region.outline, body.points[from] - view.eye, body.points[to] - view.eye, inside, margin, axis)) {
      return std::nullopt;
    }
  }
  return region.outline.empty() ? std::nullopt : std::optional(std::move(region));
}

bool isBefore(const BodyOccluder& body, const FlatOccluder& target, const glm::dvec3& eye) {
  const double height = target.plane.distance(eye);
  const double least = depthPart * std::abs(height) + body.slack + target.slack;
  return std::ranges::all_of(
      body.points, [&](const glm::dvec3& p) { return (height > 0.0 ? 1.0 : -1.0) * target.plane.distance(p) > least; });
}

RecycledVector<Polygon> outside(const OccludedRegion& region, const HalfSpace* also, const glm::dvec3& eye,
                                const RecycledVector<Polygon>& polygons) {
  RecycledVector<Polygon> pieces;
  for (const Polygon& polygon : polygons) {
    const size_t before = pieces.size();
    Polygon within = polygon;
    // Moves what lies outside the half space to the pieces. Returns false if the polygon lies outside the region.
    const auto cut = [&](const HalfSpace& half) {
      const auto inside = std::ranges::count_if(within, [&](const glm::dvec3& p) { return half.at(p - eye) > 0.0; });
      if (inside == std::ssize(within)) {
        return true;
      }
      const double slope2 = glm::dot(half.gradient, half.gradient);
      if (!(slope2 > 0.0) || inside == 0) {
        return false;
      }
      const glm::dvec3 point = eye - half.gradient * (half.constant / slope2);
      const glm::dvec3 normal = half.gradient / std::sqrt(slope2);
      pieces.push_back(clipPolygon(within, {point, -normal}));
      within = clipPolygon(within, {point, normal});
      return true;
    };
    if ((also && !cut(*also)) || !std::ranges::all_of(region, cut)) {
      pieces.resize(before);
      pieces.push_back(polygon);
    }
  }
  return pieces;
}

}  // namespace speculum
