#include "window/view_controller.hpp"

#include "scene/model_formats.hpp"

namespace speculum {

namespace {

double aspectOf(const glm::ivec2& size) {
  return size.y > 0 ? static_cast<double>(size.x) / size.y : 1.0;
}

}  // namespace

SceneState ViewController::state(const Scene& scene, double time) {
  SceneState state = evaluate(scene, time);
  state.camera = camera.pose(state.camera);
  return state;
}

WatchedState ViewController::watchedState(const Scene& scene, const SceneState& shown) const {
  return {.camera = shown.camera,
          .movedCamera = camera.moved(),
          .time = shown.time,
          .seeks = playback.seeks(),
          .paused = playback.shown().paused,
          .animated = animated(scene)};
}

void ViewController::frame(const Scene& scene, const Selection& node, const glm::ivec2& size, const PixelRect& free) {
  SceneState state = evaluate(scene, time());
  if (!node && isModelFile(scene.file) && !state.instances.empty()) {
    state.mirrors.clear();  // an opened model stands on a mirror that is much larger
  }
  const Sphere bounds = boundsOf(scene, state, node);
  if (bounds.radius > 0.0) {
    const glm::dvec2 pixels = glm::max(glm::dvec2(size), 1.0);
    const glm::dvec2 half = glm::dvec2(free.width, free.height) / pixels;
    const glm::dvec2 corner = 2.0 * glm::dvec2(free.x, free.y) / pixels;
    camera.frame(bounds, aspectOf(size), {.center = {corner.x + half.x - 1.0, 1.0 - corner.y - half.y}, .half = half});
  }
}

// Says what is seen, because a back that does not reflect looks like a fault.
std::string ViewController::lookFromMirror(const Scene& scene, MirrorSide side, const Selection& selected,
                                           std::span<const PassRow> passes, const glm::ivec2& size) {
  const int mirror = camera.lookFromMirror(side, evaluate(scene, time()), selected, passes, aspectOf(size));
  if (mirror < 0) {
    return "The scene has no mirror to look from";
  }
  const std::string name = describe(scene, mirrorNode(scene, mirror));
  if (side == MirrorSide::front) {
    return "Looking out of " + name;
  }
  const bool reflects = scene.mirror(static_cast<size_t>(mirror)).twoSided;
  return "Behind " + name +
         (reflects ? ", which reflects on both sides" : ". Its back does not reflect; Shift+B looks out of its front");
}

}  // namespace speculum
