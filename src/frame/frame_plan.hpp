#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "frame/cached_image.hpp"
#include "frame/partial_instances.hpp"
#include "frame/settings.hpp"
#include "frame/traced_effects.hpp"
#include "frame/view.hpp"
#include "geometry/recycled_memory.hpp"

namespace speculum {

class SceneChanges;

enum class SkipReason {
  behind,         // behind the eye
  backface,       // the eye sees its back, or its edge
  outside,        // outside the view, the mirror it is seen in, or behind that mirror's plane
  hidden,         // behind occluders
  minPixels,      // smaller than reflection.min_pixels
  minThroughput,  // lets less through than reflection.min_throughput
  maxDepth,       // reflection.max_depth
  maxPasses,      // reflection.max_passes was spent on better ones
  unchanged,      // its cached image is reused
  rays,           // rays show its reflection
};
std::string_view skipReasonName(SkipReason reason);

// A mirror that a view draws.
struct MirrorDraw {
  int mirror = 0;                      // index into Scene::mirrors
  bool back = false;                   // its back is seen
  bool byRays = false;                 // rays show its reflection, not an image of its plane
  bool blurs = false;                  // rough: the image of its plane is blurred
  bool ripples = false;                // rippled: the image of its plane is looked up where ripples reflect to
  int pass = -1;                       // index into FramePlan::passes of the pass that renders its image; -1: none
  std::optional<CachedLookup> cached;  // set if it reuses a cached image; with neither it shows the background
  Polygon polygon;                     // world, cut to what the view shows, counter-clockwise for the view's eye
  Plane plane;                         // world; facing the view's eye
  int layer = 0;                       // MirrorState::frontLayer or backLayer, by the side that is seen
};

struct ImageQuality {
  double scale = 1.0;  // resolution relative to the main view
  int samples = 1;
  int interval = 1;  // frames between images of the mirror that is seen directly, with all that is seen in it
};

// One pass: a view and what is drawn in it.
struct PlannedPass {
  View view;
  ImageQuality quality;
  ImageQuality shownIn;           // of the pass that shows the image
  int parent = -1;                // index into FramePlan::passes; -1: the main view
  int depth = -1;                 // recursion depth of its mirror: 0 seen directly, 1 in a mirror; -1 for the main view
  double areaPx = 0.0;            // area of the mirror's visible region, in texels of its image
  double throughput = 1.0;        // upper bound over that region, largest channel, including this mirror
  glm::dvec3 channels{1.0};       // upper bound of each channel
  RecycledVector<int> instances;  // visible ones, indices into SceneState::instances, ascending
  RecycledVector<PartialInstance> partial;        // instances that are seen in part, ascending
  RecycledVector<SimplifiedInstance> simplified;  // instances that are drawn with fewer triangles, ascending
  RecycledVector<int> lights;                     // lights whose glyphs are visible, indices into Scene::lights
  RecycledVector<MirrorDraw> mirrors;             // in the order of Scene::mirrors
};

// Six images about a curved mirror's centre, side by side in one target, three to a row: effects.curved_lookup =
// environment. docs/effects.md: Environment maps.
struct EnvironmentMap {
  int object = 0;       // index into Scene::objects
  int copy = 0;         // of the object
  int instance = 0;     // index into SceneState::instances
  RecycledString name;  // of the object and copy, for users
  int size = 0;         // texels of each side of a face
  Projection projection;
  RecycledVector<PlannedPass> faces;  // towards +x, -x, +y, -y, +z, -z; without the object, mirrors without an image
  glm::dvec3 center{0.0};             // world, of the object when they were rendered
  glm::dvec3 low{0.0};                // world, box of what surrounds it in the present frame
  glm::dvec3 high{0.0};
  Settings settings;                 // when they were rendered
  RecycledVector<uint64_t> content;  // as CachedImage::content
  uint64_t serial = 0;               // changes each time that any map is rendered
  int age = 1;                       // frames since it was rendered or last found unchanged, in the next frame
  int due = 1;                       // age at which it is rendered anew
  int cacheIndex = -1;               // index into FrameCache::maps of the map that is reused; -1: this frame renders it
};

// What casts shadows in a shadow map's face and stands still while other casters move. Its image is kept, and each
// frame draws the others over a copy of it.
struct ShadowLayer {
  PlannedPass pass;
  bool rendered = false;             // rendered together with the face; else its texels are unchanged
  RecycledVector<uint64_t> content;  // all that its texels depend on
};

// A part of a shadow map: what a light illuminates in one direction, as disparities from the light.
struct ShadowFace {
  PlannedPass pass;       // objects and mirrors that cast shadows in it; only those that move if drawn over `layer`
  Projection projection;  // of its window
  glm::dvec2 low{0.0};    // window, metres right and down in the plane one metre before the light
  glm::dvec2 high{0.0};
  bool inReach = false;              // a view may show a part of it
  bool read = false;                 // something that is drawn may look it up
  bool rendered = false;             // this frame renders it; else, if it is read, its texels are unchanged
  RecycledVector<uint64_t> content;  // all that its texels depend on; empty if they were never rendered
  std::optional<ShadowLayer> layer;

  bool rendersLayer() const { return rendered && layer && layer->rendered; }
};

// Six images about a light that casts shadows, side by side, three to a row: effects.shadow_lookup = map.
// docs/effects.md: Shadow maps.
struct ShadowMap {
  int light = 0;                     // index into Scene::lights
  RecycledString name;               // of the light, for users
  int size = 0;                      // texels of each side of a face
  RecycledVector<ShadowFace> faces;  // in the order of faceAxes()
  uint64_t serial = 0;               // grows each time that a face of this map is rendered
};

// Kinds of recorded passes.
enum class PassKind { mirror, environment, shadow, main, accumulation, display, debugView };

// Identifies a pass. Equal for the same pass of different frames.
struct PassId {
  PassKind kind = PassKind::mirror;
  MirrorPath path;    // empty for other passes
  int instance = -1;  // of an environment map, index into SceneState::instances
  int light = -1;     // of a shadow map, index into Scene::lights
  int face = -1;      // of an environment or shadow map, index into its faces

  bool operator==(const PassId&) const = default;
};

struct SkippedMirror {
  int mirror = 0;
  MirrorPath path;  // ends with this one
  int depth = 0;
  SkipReason reason = SkipReason::outside;
  RecycledString detail;
};

// The main view that the frame before drew.
struct MainImage {
  Settings settings;
  RecycledVector<uint64_t> content;  // FramePlan::mainContent
};

// Images of the frame before that this frame may reuse.
struct FrameCache {
  std::span<const CachedImage> images;  // FramePlan::cached of that frame
  std::span<const EnvironmentMap> maps;
  std::span<const ShadowMap> shadowMaps;
  const MainImage* main = nullptr;        // null: the main view is drawn in any case
  const SceneChanges* changes = nullptr;  // up to this frame; null: unchanged images are not looked for
};

// Tiles first .. end - 1.
struct TileRange {
  size_t first = 0;
  size_t end = 0;

  bool empty() const { return end <= first; }
  bool operator==(const TileRange&) const = default;
};

struct FramePlan {
  Projection projection;
  int width = 0;  // pixels of the picture
  int height = 0;
  int picture = 0;                     // index in the mean of view.accumulate pictures
  RecycledVector<PlannedPass> passes;  // of mirrors, in the order of recording: children before their parent
  PlannedPass main;
  bool mainReused = false;               // the frame before drew the same main view or mean, which is shown again
  RecycledVector<uint64_t> mainContent;  // imageContent() of the main view if it shows cached images only; else empty
  RecycledVector<SkippedMirror> skipped;
  RecycledVector<CachedImage> cached;  // reused or rendered by this frame; the next one may reuse them
  // Passes that cached images replace, in no particular order: what they show is on the screen and calls for effects.
  RecycledVector<PlannedPass> reused;
  RecycledVector<EnvironmentMap> maps;  // of the curved mirrors that are drawn; `instance` ascending
  // One for each light of the scene that may cast shadows, if these are looked up; a map's index is its place in the
  // target.
  RecycledVector<ShadowMap> shadowMaps;
  TracedEffects effects;  // that all of these passes call for
  // Tiles that this frame draws of a picture that several frames draw (picture_tiles.hpp); none: it draws all.
  std::optional<TileRange> tiles;
};

// Mirror passes of the picture that the frame shows: those that it draws, or `reused` if it shows the last picture
// again.
inline const RecycledVector<PlannedPass>& shownPasses(const FramePlan& plan) {
  return plan.mainReused ? plan.reused : plan.passes;
}

// Visits the main view, all mirror passes, those that cached images replace included, and the faces of environment
// maps.
template <typename Visit>
void forEachPass(const FramePlan& plan, const Visit& visit) {
  visit(plan.main);
  std::ranges::for_each(plan.passes, visit);
  std::ranges::for_each(plan.reused, visit);
  for (const EnvironmentMap& map : plan.maps) {
    std::ranges::for_each(map.faces, visit);
  }
}

// Returns the one of shownPasses() with that path; null if there is none.
const PlannedPass* mirrorPass(const FramePlan& plan, std::span<const int> path);

// Finds the passes that a picture of `width` x `height` pixels needs, and why every other mirror has none. Pure. The
// budget of passes goes to the best first, by visible pixels times throughput. The main view has view.scale times as
// many texels along each side, rounded, and mirror images reflection.scale times as many as that, unless a mirror has a
// quality of its own. An image in an image has no more texels and samples than the one that shows it.
//
// With reflection.skip_unchanged, a mirror seen directly reuses its image in `cache.images` if everything that the
// image depends on is exactly as it was. With reflection.update_interval above 1, it also does so while the image is
// younger than its due age, was drawn under the same settings and covers what is seen. The budget of passes is spent as
// if every image were rendered, so that no image depends on which others are reused.
//
// `cache.maps` are reused likewise, by reflection.skip_unchanged and effects.environment_interval. With
// reflection.skip_unchanged and without view.continuous, so is the main view if it is exactly as it was.
//
// Plans picture number `picture` of a mean, at its offset, under pictureSettings(). If that is view.accumulate or more,
// the mean is complete and is shown again: `mainReused`.
FramePlan planFrame(const Scene& scene, const SceneState& state, const Settings& settings, int width, int height,
                    const FrameCache& cache = {}, int picture = 0);

}  // namespace speculum
