#pragma once

#include <cstdint>
#include <span>

#include "geometry/recycled_memory.hpp"
#include "plan/view.hpp"
#include "settings/settings.hpp"

namespace speculum {

// The image of a mirror that is seen directly, which later frames may reuse: by reflection.update_interval for some
// frames, by reflection.skip_unchanged for as long as nothing in it changes.
struct CachedImage {
  int mirror = 0;  // index into Scene::mirrors
  // State when the image was rendered.
  View view;
  Projection projection;
  Polygon visible;  // world; visible region of the mirror
  Settings settings;
  int samples = 1;                   // samples of a texel
  RecycledVector<uint64_t> content;  // imageContent(); empty without reflection.skip_unchanged

  int age = 1;           // frames since the image was rendered or last found unchanged, as the next frame counts them
  int unchangedFor = 0;  // frames from the rendering of the image until it was last found unchanged
  int due = 1;           // age at which the image is rendered anew
  int pass = -1;  // index into FramePlan::passes of the pass that renders the image in this frame; -1: it is reused
  int cacheIndex = -1;  // index into FrameCache::images of the image that is reused; -1: `pass` renders it
};

// Says where a mirror reads a cached image. Unless `moved`, every pixel of the pass reads its own texel. If `moved`, a
// pixel reads the homogeneous texel texelFromPixel (pixel, 1) + texelFromDisparity d, where d is the disparity (1/m) of
// what the pixel shows.
struct CachedLookup {
  int image = -1;      // index into FramePlan::cached
  bool moved = false;  // whether view or mirror moved since the image was rendered
  glm::dmat3 texelFromPixel{1.0};
  glm::dvec3 texelFromDisparity{0.0};
};

// Below, `now` is the view that the image's mirror makes in this frame, and `visible` is the mirror's visible region
// (world).

// Says whether view, projection and mirror are exactly as they were when the image was rendered.
bool unmoved(const CachedImage& image, const View& now, const Projection& projection,
             std::span<const glm::dvec3> visible);

// Says whether the image shows all that the mirror shows now, at every distance behind the mirror. That is so if the
// image shows the corners of the visible region both at the mirror's own distance and infinitely far away, because all
// between is convex.
bool covers(const CachedImage& image, const View& now, std::span<const glm::dvec3> visible);

// Returns how far the corners of `visible` have moved in the image since it was rendered: the largest shift, in texels.
// Infinite if a corner is not in front of both eyes, that of `now` and that of the image.
double largestShift(const CachedImage& image, const View& now, const Projection& projection,
                    std::span<const glm::dvec3> visible);

// Returns the lookup for a pass with view `parent`, in which the mirror is drawn. Projections are reversed and
// infinite, so clip space (x, y, w) is linear in position. With V R the linear part of a view, P its projection, e its
// eye, and primes for the view of the image: (x, y, w)' = P' V'R' (V R)^-1 P^-1 (x, y, w) + P' V'R' (e - e'). Divided
// by w, the right side is linear in the pixel and in the disparity 1/w.
CachedLookup cachedLookup(const CachedImage& image, const View& parent, const View& now, const Projection& projection);

}  // namespace speculum
