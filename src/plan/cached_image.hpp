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
  int samples = 1;                   // a texel
  RecycledVector<uint64_t> content;  // imageContent(); empty without reflection.skip_unchanged

  int age = 1;           // frames since it was rendered or last found unchanged, in the next frame
  int unchangedFor = 0;  // frames from when it was rendered to when it was last found unchanged
  int due = 1;           // age at which it is rendered anew
  int pass = -1;         // index into FramePlan::passes of the pass that renders it in this frame; -1: reused
  int cacheIndex = -1;   // index into FrameCache::images of the image that is reused; -1: `pass` renders it
};

// Says where a mirror reads a cached image. Unless `moved`, every pixel reads its own texel. Else the homogeneous texel
// is texelFromPixel (pixel of the pass, 1) + texelFromDisparity d, with the disparity d (1/m) of what is seen there.
struct CachedLookup {
  int image = -1;      // index into FramePlan::cached
  bool moved = false;  // whether view or mirror moved since the image was rendered
  glm::dmat3 texelFromPixel{1.0};
  glm::dvec3 texelFromDisparity{0.0};
};

// Below, `now` is the view that the image's mirror makes in this frame, and `visible` its visible region.

// Says whether view, projection and mirror are exactly what they were.
bool unmoved(const CachedImage& image, const View& now, const Projection& projection,
             std::span<const glm::dvec3> visible);

// Says whether the image shows all that the mirror shows now, at every distance behind it. It does if it shows the
// corners of the visible region both at the mirror's own distance and infinitely far away: all between is convex.
bool covers(const CachedImage& image, const View& now, std::span<const glm::dvec3> visible);

// Returns how far the corner that moved most moved in the image since it was rendered, in texels. Infinite where a
// corner is not in front of both eyes.
double largestShift(const CachedImage& image, const View& now, const Projection& projection,
                    std::span<const glm::dvec3> visible);

// Returns the lookup for a pass with view `parent`, in which the mirror is drawn. Projections are reversed and
// infinite, so clip space (x, y, w) is linear in position. With V R the linear part of a view, P its projection, e its
// eye, and primes for the image's: (x, y, w)' = P' V'R' (V R)^-1 P^-1 (x, y, w) + P' V'R' (e - e'); divided by w.
CachedLookup cachedLookup(const CachedImage& image, const View& parent, const View& now, const Projection& projection);

}  // namespace speculum
