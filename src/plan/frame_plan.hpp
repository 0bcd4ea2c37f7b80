#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "geometry/recycled_memory.hpp"
#include "plan/cached_image.hpp"
#include "plan/refined_tiles.hpp"
#include "plan/traced_effects.hpp"
#include "plan/view.hpp"
#include "settings/settings.hpp"

namespace speculum {

class SceneChanges;

// Why a mirror in a view has no pass. Each comment is about that mirror.
enum class SkipReason {
  behind,         // behind the eye
  backface,       // the eye sees the mirror's back or edge
  outside,        // outside the view or the mirror that shows it, or behind the plane of that mirror
  hidden,         // behind occluders
  minPixels,      // smaller than reflection.min_pixels
  minThroughput,  // lets less through than reflection.min_throughput
  maxDepth,       // reflection.max_depth
  maxPasses,      // reflection.max_passes, or the work of planning, was spent on more important mirrors
  unchanged,      // its cached image is reused
  rays,           // rays show its reflection
};
// Returns the reason as `--stats` writes it, such as "min_pixels".
std::string_view skipReasonName(SkipReason reason);

// A mirror that a view draws.
struct MirrorDraw {
  int mirror = 0;                      // index into Scene::mirrors
  bool back = false;                   // its back is seen
  bool byRays = false;                 // rays show its reflection, not an image of its plane
  bool blurs = false;                  // the mirror is rough: the image of its plane is blurred
  bool ripples = false;                // the mirror is rippled: the image of its plane is read where ripples reflect to
  int pass = -1;                       // index into FramePlan::passes of the pass that renders its image; -1: none
  std::optional<CachedLookup> cached;  // set if it reuses an image; with neither pass nor image it shows the background
  Polygon polygon;                     // world, cut to what the view shows, counter-clockwise for the view's eye
  RecycledVector<Polygon> pieces;      // in the place of `polygon`, of a mirror that is not convex
  Plane plane;                         // world; facing the view's eye
  int layer = 0;                       // MirrorState::frontLayer or backLayer, by the side that is seen
};

struct ImageQuality {
  double scale = 1.0;  // resolution relative to the main view
  int samples = 1;
  int interval = 1;  // frames between renderings of a mirror seen directly and of all images in it
};

enum class PassKind { mirror, environment, shadow, main, accumulation, display, targetDisplay };

// Identifies a pass. Equal for the same pass of different frames.
struct PassId {
  PassKind kind = PassKind::mirror;
  MirrorPath path;    // of a mirror pass; empty for other kinds
  int instance = -1;  // of an environment map, index into SceneState::instances
  int light = -1;     // of a shadow map, index into Scene::lights
  int face = -1;      // of an environment or shadow map, in the order of faceAxes()

  auto operator<=>(const PassId&) const = default;
};

// Where the image of a pass comes from in a frame.
enum class PassSource {
  drawn,   // this frame draws it
  reused,  // an earlier frame drew the image; MirrorDraw::cached says whether it is reprojected
  unread,  // a face of a shadow map that no drawn surface reads
};

// Tiles first .. end - 1 of a picture or of a pass (pass_mask.hpp).
struct TileRange {
  size_t first = 0;
  size_t end = 0;

  bool empty() const { return end <= first; }
  bool operator==(const TileRange&) const = default;
};

// Part of a shadow map's face that has texels: metres right and down in the plane one metre before the light.
struct FaceWindow {
  glm::dvec2 low{0.0};
  glm::dvec2 high{0.0};

  bool empty() const { return low.x >= high.x || low.y >= high.y; }
};

// One pass: a view, what is drawn in it, and where its image comes from.
struct Pass {
  PassId id;
  PassSource source = PassSource::drawn;
  View view;
  Projection projection;
  glm::ivec2 corner{0};  // upper left corner of the view's rectangle in its target, texels
  int cube = -1;         // index into FramePlan::cubes of the cube that the pass is a face of; -1: none
  int layer = -1;        // index into FramePlan::passes of the pass whose image a shadow map's face is drawn over
  bool isLayer = false;  // the pass is the layer of a shadow map's face and has the id of that face
  FaceWindow window;     // of a shadow map's face
  ImageQuality quality;
  ImageQuality shownIn;           // quality of the pass that shows the image
  double shownBeyond = 0.0;       // texels beyond the view's cone at which the image may be shown, lookups apart
  double areaPx = 0.0;            // area of the mirror's visible region, in texels of its image
  glm::dvec3 channels{1.0};       // upper bound of each channel's throughput over the visible region, with this mirror
  RecycledVector<int> instances;  // visible ones, indices into SceneState::instances, ascending
  RecycledVector<PartialInstance> partial;  // instances that are seen in part, ascending
  RecycledVector<int> lights;               // lights whose glyphs are visible, indices into Scene::lights
  RecycledVector<MirrorDraw> mirrors;       // in the order of Scene::mirrors
  uint32_t unseen = 0;                      // mirrors that a main or mirror view does not see, without its own

  bool drawn() const { return source == PassSource::drawn; }
  bool isFace() const { return id.kind == PassKind::shadow || id.kind == PassKind::environment; }
};

// Six images about a point, side by side in one target, whose faces are passes: the environment map of a curved mirror
// (effects.curved_lookup = environment) or the shadow map of a light (effects.shadow_lookup = map). docs/effects.md
// describes both.
struct Cube {
  PassKind kind = PassKind::environment;
  int light = -1;       // of a shadow map, index into Scene::lights
  int object = -1;      // of an environment map, index into Scene::objects
  int copy = 0;         // index of the object's copy
  int mesh = -1;        // of the object's part, index into Scene::meshes
  int instance = -1;    // index into SceneState::instances
  RecycledString name;  // of the light, or of the object and copy, for users
  int size = 0;         // texels of each side of a face; of the largest face of all maps if it is a shadow map's
  std::array<int, 6> faces{-1, -1, -1, -1, -1, -1};  // indices into FramePlan::passes, in the order of faceAxes()
  // Only shadow maps have slots. All of them share one target, a grid of slots that are counted row by row. Each face
  // takes one slot. A face has -1 if it shows no caster, or if it is too narrow for hybrid shadows.
  std::array<int, 6> slots{-1, -1, -1, -1, -1, -1};
  glm::dvec3 center{0.0};  // world, when it was rendered
  glm::dvec3 low{0.0};     // world, box of what surrounds the mirror in the present frame
  glm::dvec3 high{0.0};
  Settings settings;    // when it was rendered
  uint64_t serial = 0;  // grows each time that any cube of its kind, or a face of a shadow map, is rendered
  int age = 1;          // frames since it was rendered or last found unchanged, in the next frame
  int due = 1;          // age at which it is rendered anew
  int cacheIndex = -1;  // of an environment map, index into FrameCache::cubes of the map that is reused; -1: none
  // Numbers that the texels of each face, and of the layer below it, depend on. Empty if the content is not compared or
  // there is no layer.
  std::array<RecycledVector<uint64_t>, 6> content;
  std::array<RecycledVector<uint64_t>, 6> layerContent;
};

// A mirror in a view that has no pass.
struct SkippedMirror {
  MirrorPath path;  // ends with the mirror
  SkipReason reason = SkipReason::outside;
  RecycledString detail;
};

// The main view that the frame before drew.
struct MainImage {
  Settings settings;
  RecycledVector<uint64_t> content;  // FramePlan::mainContent
  bool encoded = false;              // FramePlan::encodes: the same view is drawn once more before it can be reused
};

// Images of the frame before that this frame may reuse.
struct FrameCache {
  std::span<const CachedImage> images;          // FramePlan::cached of the frame before
  std::span<const Cube> cubes;                  // FramePlan::cubes of the frame before
  const MainImage* main = nullptr;              // null: the main view is drawn in any case
  const SceneChanges* changes = nullptr;        // up to this frame; null: unchanged images are not looked for
  std::shared_ptr<const RefinedTiles> refined;  // tiles of the mean that its next picture is drawn for; null: all
  int accumulated = 0;                          // pictures in that mean
  double waitedMs = 0.0;                        // time in which the GPU was waited for, to find the tiles
};

// A picture to plan: a scene at one moment.
struct FrameRequest {
  const Scene& scene;
  const SceneState& state;
  Settings settings;   // as requested
  glm::ivec2 size{0};  // of the picture, pixels
  FrameCache cache;    // images of the frame before
  int picture = 0;     // index in the mean of view.accumulate pictures
  // Only the display shows the main view, alone, in pixels of its own: no other half or cover, no target of the main
  // view, and nothing reads its radiance later.
  bool shownOnly = false;
};

// The plan of a frame: one list of passes. Passes that draw are recorded in the order of the list: faces of shadow
// maps, each after its layer, faces of environment maps, mirrors, children before their parent, and the main view.
// Passes that the frame reuses stand in the list too, because what they show is on the screen; reused mirrors stand
// before those that are drawn.
struct FramePlan {
  Projection projection;  // of all passes but faces
  int width = 0;          // pixels of the picture
  int height = 0;
  int picture = 0;                                                    // index in the mean of view.accumulate pictures
  RecycledVector<Pass> passes{Pass{.id = {.kind = PassKind::main}}};  // the last is the main view
  // Shadow maps of the lights that may cast shadows, in the order of lights, then environment maps of the curved
  // mirrors that are drawn, `instance` ascending.
  RecycledVector<Cube> cubes;
  RecycledVector<uint64_t> mainContent;   // imageContent() of the main view if it shows cached images only; else empty
  RecycledVector<SkippedMirror> skipped;  // mirrors that a view sees; skippedMirrors() adds the others
  RecycledVector<CachedImage> cached;     // images that this frame reuses or renders; the next frame may reuse them
  TracedEffects effects;                  // effects that the passes call for
  // Tiles that this frame draws if several frames draw one picture (pass_mask.hpp); none: the frame draws all
  // tiles.
  std::optional<TileRange> tiles;
  // The main view is drawn into the display image, in colors of the display. It has no target of radiance, and the
  // display pass is left out.
  bool encodes = false;
  // Tiles of the main view in which this picture of a mean is drawn. Elsewhere it has no meaning: nothing is drawn
  // there, in mirror images neither. Null: all.
  std::shared_ptr<const RefinedTiles> refined;

  const Pass& main() const { return passes.back(); }
  Pass& main() { return passes.back(); }
  // Returns the width of wireframe lines in a view, in its texels.
  double lineWidth(const View& view, const ViewSettings& settings) const {
    return std::max(1.0, settings.lineWidth * view.pictureSize.x / width);
  }
  // Says whether the main view or mean of an earlier frame is shown again, because this frame would draw the same.
  bool mainReused() const { return !main().drawn(); }
  // Says whether the main view shows the background or the sky only.
  bool showsNothing() const { return main().instances.empty() && main().lights.empty() && main().mirrors.empty(); }
  // Returns the mirror passes that the frame draws. They stand side by side in the list.
  std::span<const Pass> drawnMirrors() const;
  // Returns the mirror passes of the picture that the frame shows: the passes that it draws or, if it shows the last
  // picture again, all that made that picture.
  std::span<const Pass> shownMirrors() const;
};

// Returns the cubes of one kind, which stand side by side in `cubes`.
std::span<const Cube> cubesOf(std::span<const Cube> cubes, PassKind kind);

// Says whether a main view with these settings has one sample for each pixel of the display.
bool mayEncode(const ViewSettings& view);

// Visits the passes whose drawing reaches the eye: all but those of shadow maps.
template <typename Visit>
void forEachSeen(const FramePlan& plan, const Visit& visit) {
  for (const Pass& pass : plan.passes) {
    if (pass.id.kind != PassKind::shadow) {
      visit(pass);
    }
  }
}

// Returns the name of a pass for users, such as "mirror wall > mirror door" or "shadow map of light 'lamp' +x".
std::string passName(const Scene& scene, const FramePlan& plan, const Pass& pass);

// Returns the pass among shownMirrors() that has this path; null if there is none.
const Pass* mirrorPass(const FramePlan& plan, std::span<const int> path);

// Finds the passes that a picture needs, and why every other mirror has none. A pure function. The budget of passes
// goes to the mirrors with the most visible pixels times throughput first. Along each side, the main view has
// view.scale times the texels of the picture, rounded, and mirror images have reflection.scale times the texels of the
// main view, unless a mirror has a quality of its own. An image in an image has no higher resolution and no more
// samples than the image that shows it.
//
// With reflection.skip_unchanged, a mirror seen directly reuses its image in `cache.images` if everything that the
// image depends on is exactly as it was. With reflection.update_interval above 1, it also reuses its image while that
// is younger than its due age, was drawn under the same settings and covers what is seen. The budget of passes is spent
// as if every image were rendered, so that no image depends on which others are reused.
//
// Shadow and environment maps in `cache.cubes` are reused by reflection.skip_unchanged and effects.environment_interval
// (image_reuse.cpp). With reflection.skip_unchanged and without view.continuous, the main view in `cache.main` is
// reused if it would be drawn exactly the same.
//
// A main view that is shown only is encoded early if it has one sample for each pixel of the display, none of its
// surfaces are shaded after the pass, and the last frame did not draw the same. So a picture that stays is drawn twice
// and then reused.
//
// A picture of a mean is planned at its pictureOffset(); the request's settings are pictureSettings() then. If it is
// the next one of `cache.accumulated`, it is drawn in the tiles `cache.refined` only. If `picture` is view.accumulate
// or more, the mean is complete and is shown again: mainReused().
FramePlan planFrame(const FrameRequest& request);

enum class TargetKind { color, depth };

// Says whether the pass with this path has this target in every frame: only the main view has, its colors.
inline bool isAlwaysThere(const MirrorPath& path, TargetKind kind) {
  return path.empty() && kind == TargetKind::color;
}

// A pass's target, shown over the picture in an area of the display image.
struct TargetDisplay {
  int pass = 0;    // index into FramePlan::passes
  PixelRect area;  // pixels
  TargetKind kind = TargetKind::color;
  double zoom = 0.0;                // display pixels for each texel; 0 fits the image into the area's middle
  glm::dvec2 origin{0.0};           // texel at the area's upper left corner; only if zoom > 0
  double halfDistance = 1.0;        // metres from the eye that depth shows half bright
  std::optional<glm::ivec2> probe;  // texel to read: see SceneRenderer::probed
};

// Value of a target at one texel.
struct TexelValue {
  glm::ivec2 texel{0};      // from the target's top left
  bool depth = false;       // the target is a depth image; `value` is 0 then
  glm::vec4 value{0.0f};    // linear radiance, disparity in 1/m; the mean of the texel's samples
  float storedDepth = 0.0;  // of the first sample; near plane / metres along the view, 0: infinitely far
};

}  // namespace speculum
