#pragma once

#include <cstdint>
#include <span>
#include <utility>

#include "geometry/recycled_memory.hpp"
#include "plan/cached_image.hpp"
#include "plan/cube_face.hpp"
#include "plan/frame_plan.hpp"
#include "plan/scene_changes.hpp"

namespace speculum {

// Largest margin around an image that is cached, as a part of the picture's height. Margins are as wide as the motion
// of the last frames calls for.
inline constexpr double largestMargin = 0.1;

// A mirror seen directly, whose image may be reused and is cached.
struct ReuseRequest {
  const View& view;  // view of the mirror's pass, without a margin
  const Projection& projection;
  std::span<const glm::dvec3> visible;  // world; visible region of the mirror
  const Settings& settings;
  int samples = 1;   // a texel of the image
  int interval = 1;  // frames between two images
  int order = 0;     // number of the mirror in order of discovery; new images become due in turn by this number
};

struct ImageChoice {
  CachedImage image;   // a cached image if it can be reused; else a new one, whose view includes a margin
  bool moved = false;  // whether view or mirror moved since the cached image was rendered
};

// Chooses the image that a mirror shows, by the age of the cached image, what it covers and the settings it was drawn
// under.
ImageChoice chooseImage(std::span<const CachedImage> images, const ReuseRequest& request);

// State that all images of a frame share.
struct ImageSurroundings {
  const Scene& scene;
  const SceneState& state;
  const Settings& settings;
  const Projection& projection;
  const TracedEffects& effects;                   // of all passes
  const SceneChanges* changes;                    // up to this frame; null: unchanged images are not looked for
  RecycledVector<std::pair<int, uint64_t>> maps;  // environment maps that may be looked up: instance, their serial
  uint64_t shadowSerial = 0;                      // largest Cube::serial of a shadow map
};

// Reuses the cached image of the same mirror if `image`, which this frame would render, is the same bit for bit. `main`
// is the view in which the mirror is seen; `passes` are its own and those of all mirrors seen in it.
void reuseIfUnchanged(CachedImage& image, std::span<const CachedImage> images, const ImageSurroundings& around,
                      const View& main, std::span<const Pass* const> passes);

// Says whether the plan, whose passes must be complete, would draw the same main view with the same images as `before`,
// that of the last frame (null: none). If so, reuses it, unless it was encoded.
bool reuseMain(FramePlan& plan, const MainImage* before, const ImageSurroundings& around);

// Finds the faces of shadow maps that must be drawn: faces that are read and whose content differs from `before`, the
// maps of the frame before. Without reflection.skip_unchanged or `around.changes`, all faces that are read are drawn;
// and so they are if the faces together draw more than four million instances, which would take too much memory to
// compare. In a face that changes again, casters that stand still are drawn to a layer. Adds faces and layers to the
// plan, whose list of passes must be empty.
void addShadowMaps(FramePlan& plan, PlannedCubes maps, std::span<const Cube> before, const ImageSurroundings& around);

// Reuses environment maps of the frame before (`before`), by reflection.skip_unchanged and
// effects.environment_interval; maps that are not reused get a new serial. `around.maps` is empty, since an environment
// map shows no other. Adds the faces of all maps to the plan, behind the faces of the shadow maps.
void addEnvironmentMaps(FramePlan& plan, PlannedCubes maps, std::span<const Cube> before,
                        const ImageSurroundings& around, const View& main);

}  // namespace speculum
