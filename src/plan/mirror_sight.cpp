#include "plan/mirror_sight.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

// Tracing this many samples takes about as long as rendering a pass on lavapipe (docs/performance.md).
constexpr double samplesOfAPass = 1500.0;

// Returns the visible part of a polygon in a mirror's plane. If the polygon is so large that cuts near the eye would be
// off by a part of the eye's height, the strip at the horizon is left out first and the rest is moved exactly into the
// mirror's plane.
Polygon visiblePart(const View& view, const MirrorState& mirror, std::span<const glm::dvec3> polygon, double height) {
  constexpr double large = 1e12;       // distance of a large mirror's farthest vertex, in heights of the eye
  constexpr double leastMetres = 1e9;  // smaller mirrors lose no strip at the horizon
  constexpr double horizon = 1e9;      // distance of the strip, in heights of the eye
  const double farthest = farthestDistance(view.eye, polygon);
  if (height == 0.0 || farthest < std::max(large * std::abs(height), leastMetres)) {
    return visiblePart(view, polygon);
  }
  Polygon part(polygon.begin(), polygon.end());
  for (const glm::dvec3& axis : {mirror.axisX, -mirror.axisX, mirror.axisY, -mirror.axisY}) {
    part = clipPolygon(part, {view.eye + horizon * std::abs(height) * axis, -axis});
  }
  for (glm::dvec3& p : part) {
    p -= (glm::dot(mirror.normal, p - view.eye) + height) * mirror.normal;
  }
  return visiblePart(view, part);
}

bool comesBefore(const MirrorPath& a, const MirrorPath& b) {
  return a.size() != b.size() ? a.size() < b.size() : a < b;
}

// Returns the passes whose skipped mirrors are listed, in the order of the list.
RecycledVector<const Pass*> listedPasses(const FramePlan& plan) {
  RecycledVector<const Pass*> listed;
  for (const Pass& pass : plan.passes) {
    const auto isShown = [&](const CachedImage& image) {
      return image.cacheIndex >= 0 && image.mirror == pass.view.path.front();
    };
    if (!pass.isFace() && (pass.view.path.empty() || std::ranges::none_of(plan.cached, isShown))) {
      listed.push_back(&pass);
    }
  }
  std::ranges::sort(listed, comesBefore, [](const Pass* pass) -> const MirrorPath& { return pass->view.path; });
  return listed;
}

SkippedMirror unseenMirror(const Scene& scene, const SceneState& state, const View& view, int mirror) {
  const MirrorState& placed = state.mirrors[mirror];
  const double height = heightAbove(placed, view.eye);
  if (isBehindEye(view, placed.polygon)) {
    return skippedMirror(view, mirror, SkipReason::behind);
  }
  return showsBack(scene.mirror(mirror), height) ? skippedBack(view, mirror, height)
                                                 : skippedMirror(view, mirror, SkipReason::outside);
}

}  // namespace

double heightAbove(const MirrorState& mirror, const glm::dvec3& eye) {
  const glm::dvec3 from = eye - mirror.origin;
  const double height = glm::dot(mirror.normal, from);
  // Rounding of coordinates counts along the normal, that of the normal along the plane.
  const double ofCoordinates = 1e-15 * glm::dot(glm::abs(mirror.normal), glm::abs(eye) + glm::abs(mirror.origin));
  return std::abs(height) > ofCoordinates + 4e-16 * glm::length(from) ? height : 0.0;
}

bool isBehindEye(const View& view, std::span<const glm::dvec3> polygon) {
  return std::ranges::all_of(polygon,
                             [&](const glm::dvec3& p) { return (view.worldToView * (p - view.eye)).z >= 0.0; });
}

bool showsBack(const Mirror& mirror, double height) {
  return height <= 0.0 && !(mirror.twoSided && height < 0.0);
}

MirrorDraw facingDraw(const MirrorState& mirror, int index, double height, bool back, const View& drawn) {
  MirrorDraw draw{.mirror = index, .plane = {mirror.origin, mirror.normal}};
  draw.back = back;
  draw.layer = height < 0.0 ? mirror.backLayer : mirror.frontLayer;
  draw.polygon = visiblePart(drawn, mirror, mirror.polygon, height);
  for (const std::vector<glm::dvec3>& piece : mirror.pieces) {
    draw.pieces.push_back(visiblePart(drawn, mirror, piece, height));
  }
  if (height < 0.0) {
    draw.plane.normal = -draw.plane.normal;
    std::ranges::reverse(draw.polygon);
    std::ranges::for_each(draw.pieces, [](Polygon& piece) { std::ranges::reverse(piece); });
  }
  return draw;
}

Sight sightOf(const Scene& scene, const SceneState& state, const View& view, const View& drawn, int mirror) {
  const MirrorState& geometry = state.mirrors[mirror];
  Sight sight{.height = heightAbove(geometry, view.eye)};
  sight.visible = visiblePart(view, geometry, geometry.polygon, sight.height);
  if (!sight.visible.empty()) {
    sight.draw = facingDraw(geometry, mirror, sight.height, showsBack(scene.mirror(mirror), sight.height), drawn);
  }
  return sight;
}

glm::dvec3 reflectanceBound(const MirrorOptics& optics, const Plane& plane, const glm::dvec3& eye,
                            std::span<const glm::dvec3> visible) {
  if (optics.fresnel == Fresnel::none) {
    return optics.reflectance;
  }
  const double farthest = farthestDistance(eye, visible);
  return optics.reflectanceAt(farthest > 0.0 ? plane.distance(eye) / farthest : 1.0);
}

std::string_view whyRays(const MirrorQuality& own, const MirrorOptics& optics, const Settings& settings, bool reflects,
                         double samples) {
  const EffectSettings& effects = settings.effects;
  if (optics.ripple && effects.rippleLookup == ReflectionSource::traced) {
    return "ripples";
  }
  if (!reflects) {
    return "";
  }
  if (optics.alpha > 0.0 && effects.roughLookup == ReflectionSource::traced) {
    return "rough";
  }
  const ReflectionMethod method = reflectionOf(own, settings).method;
  if (method == ReflectionMethod::automatic && samples < samplesOfAPass) {
    return "faster, since it covers few pixels";
  }
  return method != ReflectionMethod::rays ? "" : own.method ? "quality.method" : "reflection.method";
}

SkippedMirror skippedMirror(const View& view, int mirror, SkipReason reason, RecycledString detail) {
  SkippedMirror skipped{view.path, reason, std::move(detail)};
  skipped.path.push_back(mirror);
  return skipped;
}

SkippedMirror skippedBack(const View& view, int mirror, double height) {
  return skippedMirror(view, mirror, SkipReason::backface, height == 0.0 ? "the eye is in its plane" : "");
}

RecycledVector<SkippedMirror> skippedMirrors(const Scene& scene, const SceneState& state, const FramePlan& plan,
                                             size_t most) {
  RecycledVector<SkippedMirror> all = plan.skipped;
  std::ranges::sort(all, comesBefore, &SkippedMirror::path);
  const auto seen = static_cast<std::ptrdiff_t>(all.size());
  for (const Pass* pass : listedPasses(plan)) {
    const View& view = pass->view;
    for (int i = 0;
         pass->unseen > 0 && all.size() - static_cast<size_t>(seen) < most && i < static_cast<int>(scene.mirrorCount());
         ++i) {
      const bool own = !view.path.empty() && view.path.back() == i;
      if (own || std::ranges::binary_search(pass->mirrors, i, {}, &MirrorDraw::mirror)) {
        continue;
      }
      SkippedMirror unseen = unseenMirror(scene, state, view, i);
      if (!std::binary_search(all.begin(), all.begin() + seen, unseen,
                              [](const auto& a, const auto& b) { return comesBefore(a.path, b.path); })) {
        all.push_back(std::move(unseen));
      }
    }
  }
  // Both parts are in order: passes are, and so are the mirrors of each.
  std::ranges::inplace_merge(all, all.begin() + seen, comesBefore, &SkippedMirror::path);
  all.resize(std::min(all.size(), most));
  return all;
}

size_t skippedCount(const FramePlan& plan) {
  size_t count = plan.skipped.size();
  for (const Pass* pass : listedPasses(plan)) {
    count += pass->unseen;
  }
  return count;
}

}  // namespace speculum
