#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "frame/settings.hpp"
#include "frame/view.hpp"

namespace speculum {

// The image of a mirror that is seen directly, kept for frames to come: reflection.update_interval, .skip_unchanged.
struct HeldImage {
  int mirror = 0;  // index into Scene::mirrors
  // As they were when the image was rendered.
  View view;
  Projection projection;
  std::vector<glm::dvec3> visible;  // world; the part of the mirror that was seen
  Settings settings;
  std::vector<uint64_t> content;  // imageContent(); empty without reflection.skip_unchanged
  int age = 1;                    // frames since its last turn, in the next frame
  int kept = 0;                   // frames from when it was rendered to its last turn, when it was found unchanged
  int due = 1;                    // age at which it is rendered anew
  int pass = -1;     // index into FramePlan::passes of the pass that renders it in this frame; -1: it was there before
  int earlier = -1;  // index among the images held before this frame; -1: `pass` renders it
};

// How a mirror reads an image of an earlier frame.
struct HeldLookup {
  int image = -1;      // index into FramePlan::held
  bool moved = false;  // else nothing did since, and it is read like an image of this frame
  // With `moved`: homogeneous texel of the image = texelFromPixel (pixel of the pass, 1) + texelFromDisparity d, where
  // d is 1 / w, in 1/m, of what is seen in the mirror.
  glm::dmat3 texelFromPixel{1.0};
  glm::dvec3 texelFromDisparity{0.0};
};

// `now` is the view that the same mirror makes now and `visible` the part of it that is seen (world).

// Whether view, projection and mirror are exactly what they were.
bool unmoved(const HeldImage& held, const View& now, const Projection& projection, std::span<const glm::dvec3> visible);

// Whether the image shows everything that is to be seen, whatever its distance behind the mirror: the corners of the
// visible part at the mirror's own distance and infinitely far away are within what was rendered. What lies between is
// then as well, because all of it is convex.
bool covers(const HeldImage& held, const View& now, std::span<const glm::dvec3> visible);

// Texels by which these corners have moved since the image was rendered, at most. Infinite where one was not in front
// of the eye.
double largestShift(const HeldImage& held, const View& now, const Projection& projection,
                    std::span<const glm::dvec3> visible);

// The lookup in the image by a pass that looks through `parent`, in which the mirror is drawn. Both projections are
// reversed and infinite, so clip space (x, y, w) is linear in position: with V R the linear parts of the mirror's views
// and e their eyes, (x, y, w) then = P' V'R' (V R)^-1 P^-1 (x, y, w) now + P' V'R' (e - e'). Divided by w now.
HeldLookup heldLookup(const HeldImage& held, const View& parent, const View& now, const Projection& projection);

}  // namespace speculum
