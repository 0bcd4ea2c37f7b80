#include "edit/picture_view.hpp"

#include <algorithm>

#include "geometry/polygon.hpp"

namespace speculum {

namespace {

Selection selectionOf(const SceneHit& hit, const TraceWorld& world) {
  switch (hit.kind) {
    case HitKind::object: {
      const InstanceState& instance = world.instances()[hit.index];
      return {Selection::Kind::object, instance.object, instance.copy};
    }
    case HitKind::mirror:
      return mirrorNode(world.scene(), hit.index);
    case HitKind::glyph:
      return {Selection::Kind::light, hit.index};
  }
  return {};
}

// Says whether the plan skipped the mirror at the end of the path, so that it shows no image.
bool isSkipped(const PickLimits& limits, const MirrorPath& path) {
  return std::ranges::any_of(limits.skipped, [&](const SkippedMirror& skip) {
    const bool shown = skip.reason == SkipReason::maxPasses || skip.reason == SkipReason::maxDepth ||
                       skip.reason == SkipReason::minPixels || skip.reason == SkipReason::minThroughput;
    return shown && skip.path == path;
  });
}

}  // namespace

PictureView::PictureView(const CameraPose& camera, int width, int height)
    : projection_(camera.verticalFov, static_cast<double>(width) / height, camera.near) {
  view_ = mainView(camera, projection_, width, height);
  const glm::dvec2 size = view_.pictureSize;
  shown_ = {{0.0, 0.0}, {0.0, size.y}, size, {size.x, 0.0}};
}

PictureView::PictureView(View view, const Projection& projection) : view_(std::move(view)), projection_(projection) {}

std::optional<PictureView> PictureView::through(const Scene& scene, const SceneState& state,
                                                std::span<const int> path) const {
  PictureView seen = *this;
  for (const int index : path) {
    if (index < 0 || static_cast<size_t>(index) >= state.mirrors.size()) {
      return std::nullopt;
    }
    const MirrorState& mirror = state.mirrors[index];
    Plane plane{mirror.origin, mirror.normal};
    const double height = plane.distance(seen.eye());
    const Polygon visible = visiblePart(seen.view_, mirror.polygon);
    if (visible.empty() || height == 0.0 || (height < 0.0 && !scene.mirror(index).twoSided)) {
      return std::nullopt;
    }
    plane.normal *= height < 0.0 ? -1.0 : 1.0;
    PictureView next(reflectedView(seen.view_, index, plane, visible, view_.rect, view_.pictureSize), projection_);
    for (const glm::dvec4& clip : toClip(seen.view_, projection_, visible)) {
      if (clip.w <= projection_.near) {
        next.shown_ = shown_;
        break;
      }
      next.shown_.push_back(toPixel(clip));
    }
    seen = std::move(next);
  }
  return seen;
}

glm::dvec3 PictureView::forward() const {
  return glm::transpose(view_.worldToView) * glm::dvec3(0.0, 0.0, -1.0);
}

Ray PictureView::ray(const glm::dvec2& pixel) const {
  const glm::dvec2 device = 2.0 * pixel / view_.pictureSize - 1.0;
  const glm::dvec3 direction(device.x * projection_.aspect / projection_.focal, -device.y / projection_.focal, -1.0);
  return {view_.eye, glm::transpose(view_.worldToView) * direction};
}

double PictureView::depth(const glm::dvec3& world) const {
  return -(view_.worldToView * (world - view_.eye)).z;
}

glm::dvec2 PictureView::toPixel(const glm::dvec4& clip) const {
  return 0.5 * (glm::dvec2(clip) / clip.w + 1.0) * view_.pictureSize;
}

std::optional<glm::dvec2> PictureView::pixel(const glm::dvec3& world) const {
  const glm::dvec4 clip = projection_.clip(view_.worldToView * (world - view_.eye));
  return clip.w > projection_.near ? std::optional(toPixel(clip)) : std::nullopt;
}

double PictureView::metresPerPixel(const glm::dvec3& world) const {
  return 2.0 * std::max(depth(world), projection_.near) / (projection_.focal * view_.pictureSize.y);
}

std::optional<PixelLine> PictureView::line(const glm::dvec3& a, const glm::dvec3& b) const {
  const double depthA = depth(a);
  const double depthB = depth(b);
  // Cuts a little beyond the near plane, so that pixel() takes both ends despite rounding.
  const double near = projection_.near * 1.001;
  if (depthA < near && depthB < near) {
    return std::nullopt;
  }
  const auto cut = [&](const glm::dvec3& in, const glm::dvec3& out, double depthIn, double depthOut) {
    return depthOut >= near ? out : glm::mix(in, out, (depthIn - near) / (depthIn - depthOut));
  };
  const auto first = pixel(cut(b, a, depthB, depthA));
  const auto second = pixel(cut(a, b, depthA, depthB));
  return first && second ? std::optional(PixelLine{*first, *second}) : std::nullopt;
}

std::optional<PixelLine> PictureView::clippedLine(const glm::dvec3& a, const glm::dvec3& b) const {
  const auto whole = line(a, b);
  return whole ? clipped(*whole) : std::nullopt;
}

// Clips as in Cyrus, Beck, "Generalized Two- and Three-Dimensional Clipping" (1978), for either winding.
std::optional<PixelLine> PictureView::clipped(const PixelLine& line) const {
  const glm::dvec2 along = line.b - line.a;
  const double winding = twiceArea(shown_) < 0.0 ? -1.0 : 1.0;
  double enter = 0.0;
  double leave = 1.0;
  for (size_t i = 0; i < shown_.size(); ++i) {
    const glm::dvec2 edge = (shown_[(i + 1) % shown_.size()] - shown_[i]) * winding;
    const double inside = cross(edge, line.a - shown_[i]);
    const double slope = cross(edge, along);
    if (slope == 0.0) {
      if (inside < 0.0) {
        return std::nullopt;
      }
    } else if (slope > 0.0) {
      enter = std::max(enter, -inside / slope);
    } else {
      leave = std::min(leave, -inside / slope);
    }
  }
  return enter < leave ? std::optional(PixelLine{line.a + enter * along, line.a + leave * along}) : std::nullopt;
}

std::vector<Picked> Picker::at(const SceneState& state, const PictureView& picture, const glm::dvec2& pixel,
                               const PickLimits& limits) {
  world_.place(state);
  const glm::dvec3& eye = state.camera.eye;
  Ray ray{glm::dvec3(0.0), glm::normalize(picture.ray(pixel).direction)};
  Skip skip;
  std::vector<Picked> found;
  MirrorPath path;
  glm::dvec3 throughput(1.0);
  while (const auto hit = world_.closest(ray, skip, path.empty() ? Onlooker::eye : Onlooker::mirror)) {
    found.push_back({selectionOf(*hit, world_), path, eye + ray.at(hit->t)});
    if (hit->kind != HitKind::mirror) {
      break;
    }
    const Mirror& mirror = world_.scene().mirror(hit->index);
    const MirrorState& placed = world_.mirrors()[hit->index];
    path.push_back(hit->index);
    throughput *= opticsOf(mirror).reflectanceAt(std::abs(glm::dot(placed.normal, ray.direction)));
    const double largest = std::max({throughput.r, throughput.g, throughput.b});
    if (!(hit->mirrorFront || mirror.twoSided) || static_cast<int>(path.size()) > limits.maxDepth || largest == 0.0 ||
        largest < limits.minThroughput || isSkipped(limits, path)) {
      break;
    }
    // The reflected ray starts at the reflected eye and reaches the mirror at the same t, so that it needs no offset
    // off the surface.
    ray = {reflectPoint(ray.origin, {placed.origin, placed.normal}), reflectionLinear(placed.normal) * ray.direction,
           hit->t};
    skip = {.mirror = hit->index};
  }
  std::ranges::reverse(found);
  return found;
}

}  // namespace speculum
