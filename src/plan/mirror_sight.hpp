#pragma once

#include <span>

#include "plan/frame_plan.hpp"

namespace speculum {

// A mirror as the eye of a view sees it.
struct Sight {
  MirrorDraw draw;      // before settings are applied; empty if nothing is visible
  double height = 0.0;  // heightAbove() of the view's eye
  Polygon visible;      // world; visible region
};

// Returns the signed distance of the eye from the mirror's plane, metres, positive before the front; exactly 0 where
// rounding cannot tell the side. Coordinates are rounded, so the threshold grows with their distance from the origin.
double heightAbove(const MirrorState& mirror, const glm::dvec3& eye);

// Says whether all of a polygon (world) lies behind the view's eye.
bool isBehindEye(const View& view, std::span<const glm::dvec3> polygon);

// Says whether an eye `height` metres before the mirror's front sees no reflection, but its back or its edge.
bool showsBack(const Mirror& mirror, double height);

// Returns mirror number `index` as an eye `height` metres before its front sees it: the side, plane and polygon, cut by
// `drawn`, that face the eye.
MirrorDraw facingDraw(const MirrorState& mirror, int index, double height, bool back, const View& drawn);

// Finds what a view sees of a mirror. `drawn` is the view, widened by what is drawn beyond its edge. Polygons are cut
// by `drawn` before they are drawn, because floats are too coarse for the depth near the eye of a polygon whose
// vertices lie far outside the view.
Sight sightOf(const Scene& scene, const SceneState& state, const View& view, const View& drawn, int mirror);

// Returns an upper bound of the mirror's reflectance over its visible region. Schlick's F grows towards grazing; the
// flattest line of sight to a polygon ends at its farthest vertex.
glm::dvec3 reflectanceBound(const MirrorOptics& optics, const Plane& plane, const glm::dvec3& eye,
                            std::span<const glm::dvec3> visible);

// Returns why rays show the reflection of a mirror that is seen in `samples` samples: because its method (`own` or
// reflection.method) says so, or because an image of its plane cannot show it. Empty if an image shows it. Without
// `reflects`, at a limit of depth or throughput, the mirror reflects the background alone, so only ripples count.
std::string_view whyRays(const MirrorQuality& own, const MirrorOptics& optics, const Settings& settings, bool reflects,
                         double samples);

// Returns the mirror in a view, for a list of skipped ones.
SkippedMirror skippedMirror(const View& view, int mirror, SkipReason reason, RecycledString detail = {});
// Returns it as one whose back is seen by the view's eye, `height` metres before its front.
SkippedMirror skippedBack(const View& view, int mirror, double height);

// Length at which the lists that users see end: about 25 MB as JSON.
constexpr size_t mostListed = 100'000;

// Returns the mirrors in views that have no pass, ascending by depth, then by path: those of FramePlan::skipped and,
// with their reasons, those that the views do not see. Returns the first `most` of them. Does not list mirrors in
// cached images. `scene` and `state` are those that were planned.
RecycledVector<SkippedMirror> skippedMirrors(const Scene& scene, const SceneState& state, const FramePlan& plan,
                                             size_t most);
// Returns the length that the list has without a limit.
size_t skippedCount(const FramePlan& plan);

}  // namespace speculum
