// Offscreen. What a second camera sees is drawn into an OffScreen, and a canvas in the window samples that.
// Read run(), at the end, first.

#include <glm/gtc/matrix_transform.hpp>

#include "common/example.hpp"
#include "common/mesh.hpp"
#include "common/shader_pair.hpp"
#include "common/simple_ui.hpp"
#include "common/view_sets.hpp"

namespace speculum::examples {
namespace {

// Where a pass looks from, and what lights the scene. view.glsl has the same members, and says what they are.
struct View {
  glm::mat4 clipFromWorld{1.0f};
  glm::vec4 eye{0.0f, 0.0f, 0.0f, 1.0f};
  glm::vec4 light{0.0f};
  glm::vec4 lightColor{0.0f};
  glm::vec4 ambient{0.0f};
};

// Push constants. The shaders declare the same members.
struct Object {
  glm::mat4 worldFromModel{1.0f};
  glm::vec4 diffuse{1.0f};
  glm::vec4 specular{0.04f, 0.04f, 0.04f, 60.0f};  // and the shininess
};

struct MirrorPush {
  glm::mat4 worldFromMirror{1.0f};
};

constexpr glm::vec3 background{0.10f, 0.11f, 0.19f};  // linear; the clear color until the panel changes it
constexpr glm::vec3 mirrorSize{1.95f, 1.3f, 1.0f};
constexpr glm::vec3 mirrorCenter{0.0f, 1.0f, -1.4756f};

// Makes the matrix that scales a model, turns it about y by `yaw`, and moves it to `position`.
glm::mat4 place(const glm::vec3& position, const glm::vec3& scale, float yaw = 0.0f) {
  return glm::scale(glm::rotate(glm::translate(glm::mat4(1.0f), position), yaw, {0.0f, 1.0f, 0.0f}), scale);
}

// Vulkan's clip space has y down. Depth is near / distance: 1 at the near plane and 0 infinitely far, which keeps it
// precise. Each pair of inner braces is a column.
glm::mat4 projection(float verticalFov, float aspect) {
  const float focal = 1.0f / std::tan(verticalFov / 2.0f);
  constexpr float near = 0.01f;
  return {{focal / aspect, 0, 0, 0}, {0, -focal, 0, 0}, {0, 0, 0, -1}, {0, 0, near, 0}};
}

// Makes a camera's view of the scene, whose lamp moves with `time`. The camera stands at `offset` from its target,
// turned about it by `turn`.
View viewFrom(const glm::vec3& offset, double time, float aspect, float turn) {
  constexpr glm::vec3 target{0.1f, 0.85f, -0.4f};
  const glm::vec3 eye = target + glm::mat3(glm::rotate(glm::mat4(1.0f), turn, {0, 1, 0})) * offset;
  const auto angle = static_cast<float>(glm::radians(40.0 * time));
  return {.clipFromWorld = projection(glm::radians(45.0f), aspect) * glm::lookAt(eye, target, {0, 1, 0}),
          .eye = glm::vec4(eye, 1.0f),
          .light = glm::vec4(0.9f * std::cos(angle), 1.9f, -0.9f * std::sin(angle), 0.06f),
          .lightColor = glm::vec4(9.0f, 7.8f, 6.2f, 0.4f),
          .ambient = glm::vec4(0.07f, 0.07f, 0.09f, 0.0f)};
}

// The GPU, the frames in flight with their SwapChain, and the images that passes draw into.
struct Core {
  const Options& options;
  std::unique_ptr<Window> window;
  Device device;
  Renderer renderer;
  SharedDepth depth;  // the depth image, which all passes use in turn
  OffScreen offScreen;

  explicit Core(const Options& asked)
      : options(asked),
        window(options.openWindow()),
        device(options.device(window.get())),
        renderer(device, options.renderer(window.get())),
        depth(device, VK_SAMPLE_COUNT_1_BIT, "shared"),
        offScreen(device, {.name = "offscreen", .extent = {512, 512}, .shared = &depth}, renderer.retired()) {}
};

// Draws the objects.
class RenderSystem {
 public:
  RenderSystem(Core& core, VkDescriptorSetLayout views)
      : cube_(core.renderer.uploader(), core.options.model("../common/cube.obj")),
        knot_(core.renderer.uploader(), core.options.model("../../models/torus_knot_upright.obj")),
        shaders_(core.renderer, core.options, "scene",
                 {.setLayouts = {views},
                  .pushConstantBytes = sizeof(Object),
                  .vertexBindings = Mesh::bindings(),
                  .vertexAttributes = Mesh::attributes()}) {}

  void record(const PassScope& pass, VkDescriptorSet viewSet, double time) const {
    const auto spin = static_cast<float>(glm::radians(30.0 * time));
    const std::pair<const Mesh*, Object> objects[] = {
        {&cube_, {place({0, -0.05f, 0}, {8, 0.1f, 6}), {0.26f, 0.15f, 0.09f, 1}, {0.05f, 0.05f, 0.05f, 40}}},
        {&cube_, {place({0, 0.25f, 0}, {0.62f, 0.5f, 0.62f}), {0.6f, 0.56f, 0.48f, 1}}},
        {&knot_, {place({0, 0.5f, 0}, glm::vec3(0.9f), spin), {0.5f, 0.09f, 0.04f, 1}, {0.3f, 0.28f, 0.25f, 70}}},
    };
    shaders_.bind(pass, viewSet);
    pass.cull(VK_CULL_MODE_BACK_BIT);
    for (const auto& [mesh, object] : objects) {
      shaders_.push(pass, object);
      mesh->draw(pass.commands());
    }
  }

 private:
  Mesh cube_;
  Mesh knot_;
  ShaderPair shaders_;
};

// Draws the lamp.
class PointLightSystem {
 public:
  PointLightSystem(Core& core, VkDescriptorSetLayout views)
      : shaders_(core.renderer, core.options, "light", {.setLayouts = {views}}) {}

  void record(const PassScope& pass, VkDescriptorSet viewSet) const {
    shaders_.bind(pass, viewSet);
    pass.cull(VK_CULL_MODE_NONE);
    vkCmdDraw(pass.commands(), 6, 1, 0, 0);
  }

 private:
  ShaderPair shaders_;
};

// Draws a canvas that shows the OffScreen.
class MirrorSystem {
 public:
  MirrorSystem(Core& core, VkDescriptorSetLayout views)
      : shaders_(core.renderer, core.options, "mirror",
                 {.setLayouts = {views}, .pushConstantBytes = sizeof(MirrorPush)}) {}

  void record(const PassScope& pass, VkDescriptorSet viewSet) const {
    shaders_.bind(pass, viewSet);
    pass.cull(VK_CULL_MODE_BACK_BIT);  // seen from behind, it is not drawn
    shaders_.push(pass, MirrorPush{.worldFromMirror = place(mirrorCenter, mirrorSize)});
    vkCmdDraw(pass.commands(), 6, 1, 0, 0);
  }

 private:
  ShaderPair shaders_;
};

Drawn run(const Options& options) {
  Core core(options);
  ViewSets<View> views(core.renderer);
  const RenderSystem renderSystem(core, views.layout());
  const PointLightSystem pointLightSystem(core, views.layout());
  const MirrorSystem mirrorSystem(core, views.layout());
  const std::unique_ptr<SimpleUI> ui = SimpleUI::forWindow(core.renderer, core.window.get());
  UiState state{.clearColor = background};
  const IdleGuard idle(core.device);  // waits for the GPU before what is above is destroyed

  for (Loop loop(options, core.window.get()); loop.next();) {
    std::optional<Frame> frame = core.renderer.beginFrame();  // waits for the frame before the last one
    if (!frame) {
      continue;  // no image to draw into, as while the window is minimised
    }
    frame->capture = !core.window;  // keeps the picture, for --out
    if (ui) {
      ui->build(state);
    }
    core.depth.require(frame->extent, core.renderer.retired());  // grows; retired() frees the old one when unused
    const float aspect = static_cast<float>(frame->extent.width) / static_cast<float>(frame->extent.height);
    const View camera = viewFrom({1.5f, 0.65f, 2.7f}, loop.time(), aspect, ui ? ui->turn() : 0.0f);
    const View secondCamera = viewFrom({-1.5f, 1.0f, 2.5f}, loop.time(), 1.5f, 0.0f);  // 1.5: aspect of the canvas
    {
      PassDesc desc = fullPass("offscreen", core.offScreen.targets());
      desc.clearColor = radiance(state.clearColor);
      // The pass begins with the barrier offscreenBeforeWrite, which waits for shaders that still read the OffScreen.
      // It ends at the brace with offscreenToSample, so that shaders of later passes read what it has drawn.
      const PassScope pass = core.renderer.beginPass(*frame, desc);
      const VkDescriptorSet viewSet = views.write(*frame, secondCamera);
      renderSystem.record(pass, viewSet, loop.time());
      pointLightSystem.record(pass, viewSet);
    }
    {
      PassDesc desc = fullPass("window", core.renderer.displayTargets(*frame));
      desc.targets.depth = core.depth.image();  // displayTargets() has none
      desc.clearColor = displayed(state.clearColor);
      const PassScope pass = core.renderer.beginPass(*frame, desc);
      const VkDescriptorSet viewSet = views.write(*frame, camera);
      renderSystem.record(pass, viewSet, loop.time());
      mirrorSystem.record(pass, views.write(*frame, camera, &core.offScreen));
      pointLightSystem.record(pass, viewSet);
    }
    if (ui) {
      ui->record(*frame);
    }
    core.renderer.endFrame(*frame);  // submits; the next beginFrame presents the image
  }
  return finish(core.renderer);
}

}  // namespace
}  // namespace speculum::examples

int main(int argc, char** argv) {
  return speculum::examples::exampleMain(argc, argv, EXAMPLE_NAME, speculum::examples::run);
}
