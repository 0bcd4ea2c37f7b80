#include "plan/cached_image.hpp"

#include <algorithm>
#include <limits>

namespace speculum {

namespace {

constexpr double eyePlane = 1e-12;   // depth over distance from which on a point counts as in front of the eye
constexpr double filterReach = 0.5;  // texels from where an image is read to the farthest texel centre that is used

// Takes view space to (x, y, w) of clip space.
glm::dmat3 clipFromView(const Projection& projection) {
  const glm::dmat4 m = projection.matrix();
  const auto column = [&](int i) { return glm::dvec3(m[i].x, m[i].y, m[i].w); };
  return {column(0), column(1), column(2)};
}

// Takes homogeneous pixels of the target that shows `view.rect` to x and y of device coordinates.
glm::dmat3 deviceFromPixel(const View& view) {
  const glm::dvec2 step = 2.0 / view.pictureSize;
  glm::dmat3 m(1.0);
  m[0][0] = step.x;
  m[1][1] = step.y;
  m[2] = glm::dvec3(view.rect.x * step.x - 1.0, view.rect.y * step.y - 1.0, 1.0);
  return m;
}

glm::dmat3 pixelFromDevice(const View& view) {
  const glm::dvec2 half = 0.5 * view.pictureSize;
  glm::dmat3 m(1.0);
  m[0][0] = half.x;
  m[1][1] = half.y;
  m[2] = glm::dvec3(half.x - view.rect.x, half.y - view.rect.y, 1.0);
  return m;
}

// Returns the image's texel that shows a point, given relative to the image's eye; nothing if the point is behind the
// eye.
std::optional<glm::dvec2> texelOf(const View& view, const Projection& projection, const glm::dvec3& relative) {
  const glm::dvec3 clip = clipFromView(projection) * (view.worldToView * relative);
  if (!(clip.z > eyePlane * glm::length(relative))) {
    return std::nullopt;
  }
  const glm::dvec3 texel = pixelFromDevice(view) * clip;
  return glm::dvec2(texel) / texel.z;
}

bool shows(const CachedImage& cached, const glm::dvec3& relative) {
  const std::optional<glm::dvec2> texel = texelOf(cached.view, cached.projection, relative);
  return texel && texel->x >= filterReach && texel->y >= filterReach &&
         texel->x <= cached.view.rect.width - filterReach && texel->y <= cached.view.rect.height - filterReach &&
         std::ranges::all_of(cached.view.cone,
                             [&](const glm::dvec3& normal) { return glm::dot(normal, relative) >= 0.0; });
}

}  // namespace

bool unmoved(const CachedImage& cached, const View& now, const Projection& projection,
             std::span<const glm::dvec3> visible) {
  return cached.view.eye == now.eye && cached.view.worldToView == now.worldToView &&
         cached.view.pictureSize == now.pictureSize && cached.projection == projection &&
         std::ranges::equal(cached.visible, visible);
}

bool covers(const CachedImage& cached, const View& now, std::span<const glm::dvec3> visible) {
  return std::ranges::all_of(visible, [&](const glm::dvec3& corner) {
    return shows(cached, corner - cached.view.eye) && shows(cached, corner - now.eye);
  });
}

double largestShift(const CachedImage& cached, const View& now, const Projection& projection,
                    std::span<const glm::dvec3> visible) {
  // Compare in the image's own pixels, whatever rectangle the present view has.
  View present = now;
  present.rect = cached.view.rect;
  double largest = 0.0;
  for (const glm::dvec3& corner : visible) {
    const std::optional<glm::dvec2> here = texelOf(present, projection, corner - now.eye);
    for (const glm::dvec3& relative : {corner - cached.view.eye, corner - now.eye}) {
      const std::optional<glm::dvec2> there = texelOf(cached.view, cached.projection, relative);
      if (!here || !there) {
        return std::numeric_limits<double>::infinity();
      }
      largest = std::max(largest, glm::length(*there - *here));
    }
  }
  return largest;
}

CachedLookup cachedLookup(const CachedImage& cached, const View& parent, const View& now,
                          const Projection& projection) {
  const glm::dmat3 thenFromNow = cached.view.worldToView * glm::transpose(now.worldToView);
  const glm::dmat3 texelFromView = pixelFromDevice(cached.view) * clipFromView(cached.projection);
  return {
      .moved = true,
      .texelFromPixel = texelFromView * thenFromNow * glm::inverse(clipFromView(projection)) * deviceFromPixel(parent),
      .texelFromDisparity = texelFromView * (cached.view.worldToView * (now.eye - cached.view.eye))};
}

}  // namespace speculum
