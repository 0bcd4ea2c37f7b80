#include "plan/depth_readout.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/projection.hpp"

namespace speculum {

namespace {

// Returns the distance from the eye to which a sphere reaches within the cone. The sphere's centre is at distance d. In
// a direction at angle a from the centre the sphere reaches to d cos a + sqrt(r^2 - d^2 sin^2 a), which falls with a.
// The smallest a within the cone follows from the plane that the centre is farthest beyond.
double farthestSphereDistance(const View& view, const glm::dvec3& center, double radius) {
  double beyond = 0.0;
  for (const glm::dvec3& normal : view.cone) {
    beyond = std::max(beyond, -glm::dot(normal, center - view.eye));
  }
  const double d = glm::length(center - view.eye);
  beyond = std::min({beyond, d, radius});
  return std::sqrt(d * d - beyond * beyond) + std::sqrt(radius * radius - beyond * beyond);
}

// View-space direction through the middle of what the pass draws.
glm::dvec3 middleOf(const View& view, const Projection& projection) {
  const PixelRect& rect = view.rect;
  const glm::dvec2 pixel(rect.x + 0.5 * rect.width, rect.y + 0.5 * rect.height);
  const glm::dvec2 ndc = 2.0 * pixel / view.pictureSize - 1.0 - projection.offset;
  return glm::normalize(glm::dvec3(ndc.x * projection.aspect / projection.focal, -ndc.y / projection.focal, -1.0));
}

// View-space direction towards a point or, if the point is outside the cone, the nearest direction found within the
// cone.
glm::dvec3 directionTo(const View& view, const Projection& projection, const glm::dvec3& center) {
  constexpr int rounds = 16;
  glm::dvec3 d = center - view.eye;
  for (int i = 0; i < rounds; ++i) {
    for (const glm::dvec3& normal : view.cone) {
      d -= std::min(glm::dot(normal, d), 0.0) * normal;
    }
  }
  const glm::dvec3 seen = view.worldToView * d;
  constexpr double steepest = 1e-3;  // cosine of the largest angle to the axis that a picture shows
  return seen.z < -steepest * glm::length(seen) ? glm::normalize(seen) : middleOf(view, projection);
}

class Farthest {
 public:
  Farthest(const View& view, const Projection& projection) : view_(view), projection_(projection) {}

  void addBody(const glm::dvec3& center, double radius) {
    const double distance = farthestSphereDistance(view_, center, radius);
    if (distance > distance_ && std::isfinite(distance)) {
      distance_ = distance;
      point_ = FarthestPoint{distance * directionTo(view_, projection_, center), radius};
    }
  }

  void addMirror(std::span<const glm::dvec3> polygon) {
    for (const glm::dvec3& p : visiblePart(view_, polygon)) {
      const glm::dvec3 seen = view_.worldToView * (p - view_.eye);
      if (glm::length(seen) > distance_ && seen.z < 0.0) {
        distance_ = glm::length(seen);
        point_ = FarthestPoint{seen, 0.0};
      }
    }
  }

  const std::optional<FarthestPoint>& point() const { return point_; }

 private:
  const View& view_;
  const Projection& projection_;
  double distance_ = 0.0;
  std::optional<FarthestPoint> point_;
};

}  // namespace

std::optional<FarthestPoint> farthestVisible(const Pass& pass, const Projection& projection, const Scene& scene,
                                             const SceneState& state) {
  Farthest farthest(pass.view, projection);
  for (const int i : pass.instances) {
    farthest.addBody(state.instances[i].center, state.instances[i].radius);
  }
  for (const int i : pass.lights) {
    farthest.addBody(state.lights[i].position, scene.lights[i].radius);
  }
  for (const MirrorDraw& draw : pass.mirrors) {
    farthest.addMirror(draw.polygon);
  }
  return farthest.point();
}

std::optional<DepthReadout> depthReadout(const Pass& pass, const Projection& projection, const Scene& scene,
                                         const SceneState& state) {
  const View& view = pass.view;
  const std::optional<FarthestPoint> farthest = farthestVisible(pass, projection, scene, state);
  if (!farthest) {
    return std::nullopt;
  }
  const auto gapIn = [&](const DepthProjection& depth) {
    return resolvableGap(depth, farthest->point, glm::radians(readoutAngle), farthest->extent);
  };
  DepthProjection depth{.projection = projection, .pictureSize = view.pictureSize};
  DepthReadout readout{.distance = glm::length(farthest->point), .oblique = {}, .plain = gapIn(depth)};
  if (view.clip) {
    depth.plane = glm::dvec4(view.worldToView * view.clip->normal, view.clip->distance(view.eye));
    readout.oblique = gapIn(depth);
  }
  return readout;
}

std::optional<double> gapWith(const DepthReadout& readout, ClipMethod clip) {
  return clip == ClipMethod::oblique ? readout.oblique : readout.plain;
}

}  // namespace speculum
