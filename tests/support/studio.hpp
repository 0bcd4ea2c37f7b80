#pragma once

#include "picture_support.hpp"
#include "test_headers.hpp"

namespace speculum::testing_support {

// The shared device and the renderer of all studios of a process, which stays to the end like the device.
struct Gpu {
  static Gpu& shared() {
    static Gpu* const gpu = new Gpu;
    return *gpu;
  }

  Device& device = sharedDevice(RenderPath::automatic);
  Renderer renderer{device, {.extent = {1, 1}}};
};

// A scene whose nodes, time and settings change between pictures without new meshes, materials or pipelines.
class Studio {
 public:
  // Begins with the scene, settings and size of `options`.
  explicit Studio(const Options& options) : Studio(loadSceneWithSettings(options), options.size) {}
  ~Studio() {
    gpu_.renderer.waitIdle();
    EXPECT_EQ(gpu_.device.validationMessages(), 0) << scene.file;
    EXPECT_EQ(sceneRenderer.finiteWatch().count(), 0u) << describe(sceneRenderer.finiteWatch().findings().front());
  }
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  // Shows the nodes of another scene. Its models must be the first models of this scene, in the same order.
  void show(const Scene& other) { static_cast<SceneContent&>(scene) = other; }
  // Draws the picture and reuses cached images where possible.
  Image8 draw() {
    gpu_.renderer.reloadShaders();
    const VkExtent2D extent{static_cast<uint32_t>(size_.width), static_cast<uint32_t>(size_.height)};
    if (const VkExtent2D before = gpu_.renderer.displayExtent();
        before.width != extent.width || before.height != extent.height) {
      gpu_.renderer.resizeHeadless(extent);
    }
    Frame frame = gpu_.renderer.beginFrame().value();
    state = evaluate(scene, time);
    state.camera = camera.value_or(state.camera);
    FrameCache cache = sceneRenderer.cache(state);
    cache.main = reusesMain ? cache.main : nullptr;
    plan = planFrame({scene, state, settings, {size_.width, size_.height}, cache, 0, shownOnly});
    frame.capture = true;
    sceneRenderer.record(frame, state, settings, plan);
    gpu_.renderer.endFrame(frame);
    return pictureOf(gpu_.renderer.readback());
  }
  // Draws the picture with all images rendered anew.
  Image8 fresh() {
    sceneRenderer.restart();
    return draw();
  }

  Scene scene;
  Settings settings;
  double time = 0.0;                 // seconds
  std::optional<CameraPose> camera;  // in place of the scene's
  bool reusesMain = false;           // reuse an unchanged main view, as the window does
  bool shownOnly = false;            // FrameRequest::shownOnly
  SceneState state;                  // of the last picture, as is `plan`
  FramePlan plan;
  SceneRenderer sceneRenderer;

 private:
  Studio(LoadedScene loaded, PictureSize size)
      : scene(std::move(loaded.scene)),
        settings(std::move(loaded.settings)),
        sceneRenderer(Gpu::shared().renderer, scene),
        size_(size) {}

  Gpu& gpu_ = Gpu::shared();
  PictureSize size_;
};

}  // namespace speculum::testing_support
