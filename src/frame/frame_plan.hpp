#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "frame/held_image.hpp"
#include "frame/partial_instances.hpp"
#include "frame/settings.hpp"
#include "frame/traced_effects.hpp"
#include "frame/view.hpp"

namespace speculum {

enum class SkipReason {
  behind,         // behind the eye
  backface,       // the eye sees its back, or its edge
  outside,        // outside the view, the mirror it is seen in, or behind that mirror's plane
  hidden,         // behind something else
  minPixels,      // smaller than reflection.min_pixels
  minThroughput,  // lets less through than reflection.min_throughput
  maxDepth,       // reflection.max_depth
  maxPasses,      // reflection.max_passes was spent on better ones
  unchanged,      // an image of an earlier frame serves
};
std::string_view skipReasonName(SkipReason reason);

// A mirror drawn in some view.
struct MirrorDraw {
  int mirror = 0;                   // index into Scene::mirrors
  bool back = false;                // its painted back is seen
  bool scatters = false;            // rippled or rough: rays are traced, an image of its plane would not show it
  bool blurs = false;               // rough: the image of its plane is blurred
  int pass = -1;                    // index into FramePlan::passes of its image; -1: it has none of this frame
  std::optional<HeldLookup> held;   // of its image of an earlier frame; with neither it shows the background
  std::vector<glm::dvec3> polygon;  // world, cut to what the view shows, counter-clockwise for the view's eye
  Plane plane;                      // world; facing the view's eye
};

// One pass: a view and what is drawn in it.
struct PlannedPass {
  View view;
  int parent = -1;             // index into FramePlan::passes; -1: the main view
  int depth = -1;              // of its mirror: 0 seen directly, 1 in a mirror; -1 for the main view
  double areaPx = 0.0;         // of the mirror's visible part, in screen pixels
  double throughput = 1.0;     // upper bound over that part, largest channel, with this mirror's own reflectance
  glm::dvec3 channels{1.0};    // the same for each channel
  std::vector<int> instances;  // visible, indices into SceneState::instances, ascending
  std::vector<PartialInstance> partial;        // those of them that are seen in part, ascending
  std::vector<SimplifiedInstance> simplified;  // those of them that are drawn with fewer triangles, ascending
  std::vector<int> lights;                     // whose glyphs are visible, indices into Scene::lights
  std::vector<MirrorDraw> mirrors;             // in the order of Scene::mirrors
};

// What a curved mirror reflects with effects.curved_lookup = environment: six images about its centre, side by side in
// one target, three to a row. docs/effects.md: Environment maps.
struct EnvironmentMap {
  int object = 0;    // index into Scene::objects
  int copy = 0;      // of the object
  int instance = 0;  // index into SceneState::instances
  std::string name;  // of the object and copy, for people
  int size = 0;      // texels of each side of a face
  Projection projection;
  std::vector<PlannedPass> faces;  // towards +x, -x, +y, -y, +z, -z; without the object, mirrors without an image
  glm::dvec3 center{0.0};          // world, of the object when they were rendered
  glm::dvec3 low{0.0};             // world, box of what surrounds it in the present frame
  glm::dvec3 high{0.0};
  Settings settings;              // that they were rendered under
  std::vector<uint64_t> content;  // as HeldImage::content
  int serial = 0;                 // another one for each time that any map is rendered
  int age = 1;                    // frames since its last turn, in the next frame
  int due = 1;                    // age at which it is rendered anew
  int earlier = -1;               // index among the maps before this frame; -1: this frame renders it
};

// What a pass that was recorded draws.
enum class PassKind { mirror, environment, main, display, debugView };

struct SkippedMirror {
  int mirror = 0;
  std::vector<int> path;  // mirrors from the eye, ending with this one
  int depth = 0;
  SkipReason reason = SkipReason::outside;
  std::string detail;
};

// The main view as an earlier frame drew it.
struct MainImage {
  Settings settings;
  std::vector<uint64_t> content;  // FramePlan::mainContent
};

// What the frame before left that this one can be planned with.
struct EarlierImages {
  std::span<const HeldImage> held;
  std::span<const EnvironmentMap> maps;
  const MainImage* main = nullptr;  // null: the main view is drawn in any case
};

struct FramePlan {
  Projection projection;
  int width = 0;  // pixels of the picture
  int height = 0;
  std::vector<PlannedPass> passes;  // of mirrors, in the order of recording: children before their parent
  PlannedPass main;
  bool mainUnchanged = false;  // the frame before drew it: it is shown again
  // imageContent() of the main view, where it shows images of the frame before only; else empty.
  std::vector<uint64_t> mainContent;
  std::vector<SkippedMirror> skipped;
  std::vector<HeldImage> held;  // after this frame; what the next one may be planned with
  // That would be rendered if images of earlier frames did not serve, in no particular order: what they show is on the
  // screen all the same, and calls for effects.
  std::vector<PlannedPass> shown;
  std::vector<EnvironmentMap> maps;  // of the curved mirrors that are drawn; `instance` ascending
  TracedEffects effects;             // that all of these passes call for
};

// Which passes a picture of `width` x `height` pixels needs, and why every other mirror has none. Pure. Recursion is
// spent best first, by visible pixels times throughput.
//
// With reflection.skip_unchanged, a mirror seen directly shows its image in `earlier.held` again if everything that it
// depends on is exactly as it was. With reflection.update_interval above 1, it also does if the image is younger than
// its due age, was drawn under the same settings and covers what is seen. The budget of passes is spent as if every
// image were rendered, so that an image does not depend on which others are; the passes of held ones are then left out.
//
// `earlier.maps` serve like images, by reflection.skip_unchanged and effects.environment_interval. With the former and
// without view.continuous, so does the main view if it too is exactly as it was.
FramePlan planFrame(const Scene& scene, const SceneState& state, const Settings& settings, int width, int height,
                    const EarlierImages& earlier = {});

}  // namespace speculum
