// Mirror in mirror. A mirror's image needs the images of the mirrors that are seen in it. So the passes are a list,
// deepest first, and each fetches pixels from images that earlier ones have drawn.
// Read run(), at the end, first.

#include <glm/gtc/matrix_transform.hpp>
#include <map>

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
  glm::vec4 clipPlane{0.0f, 0.0f, 0.0f, 1.0f};  // this one cuts nothing
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
  glm::vec4 reflectance{0.92f, 0.93f, 0.94f, 1.0f};
  uint32_t naive = 0;
};

constexpr glm::vec3 background{0.10f, 0.11f, 0.19f};  // linear; the clear color until the panel changes it
constexpr glm::vec3 mirrorSize{1.95f, 1.3f, 1.0f};

// A mirror: a rectangle of mirrorSize. scene.toml has the same values.
struct Mirror {
  glm::vec3 center;
  glm::vec3 normal;  // of its front; length 1
  float yaw;         // radians about y from +z to the normal
};
constexpr std::array mirrors{Mirror{{0.0f, 1.0f, -1.4756f}, {0.0f, 0.0f, 1.0f}, 0.0f},
                             Mirror{{0.0f, 1.0f, 2.9756f}, {0.0f, 0.0f, -1.0f}, glm::pi<float>()}};

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

// Takes every point x to the other side of the plane: x - 2 n (n . (x - q)), which is (1 - 2 n n^T) x + 2 (n . q) n.
glm::mat4 reflection(const glm::vec3& q, const glm::vec3& n) {
  const glm::mat3 linear = glm::mat3(1.0f) - 2.0f * glm::outerProduct(n, n);
  glm::mat4 matrix(linear);
  matrix[3] = glm::vec4(2.0f * glm::dot(n, q) * n, 1.0f);
  return matrix;
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

// Makes the view that `mirror` shows in `view`, that of the reflected eye. The matrix reflects the world in place of
// the eye, which gives the same picture. Highlights are computed in the real world, so they need the reflected eye.
View reflectedView(const View& view, const Mirror& mirror) {
  const glm::mat4 reflect = reflection(mirror.center, mirror.normal);
  View reflected = view;
  reflected.clipFromWorld = view.clipFromWorld * reflect;
  reflected.eye = reflect * view.eye;
  // Cuts away what is behind the mirror: it stands between the reflected eye and the mirror, and would hide the room.
  reflected.clipPlane = glm::vec4(mirror.normal, -glm::dot(mirror.normal, mirror.center));
  return reflected;
}

// Says whether a view may see the mirror's front: the eye is before the mirror, and not all corners lie beyond one side
// of the picture. A mirror that is hidden by something else gets a pass in vain.
bool maySee(const View& view, const Mirror& mirror) {
  glm::bvec4 beyond(true);  // right, above, left, below
  for (const glm::vec2& corner : {glm::vec2(-0.5f, -0.5f), {0.5f, -0.5f}, {0.5f, 0.5f}, {-0.5f, 0.5f}}) {
    const glm::vec4 p = view.clipFromWorld * place(mirror.center, mirrorSize, mirror.yaw) * glm::vec4(corner, 0, 1);
    beyond = beyond && glm::greaterThan(glm::vec4(p.x, -p.y, -p.x, p.y), glm::vec4(p.w));
  }
  return glm::dot(mirror.normal, glm::vec3(view.eye) - mirror.center) > 0.0f && !glm::any(beyond);
}

// The GPU, the frames in flight with their SwapChain, and the images that passes draw into.
struct Core {
  const Options& options;
  std::unique_ptr<Window> window;
  Device device;
  Renderer renderer;
  SharedDepth depth;  // the depth image, which all passes use in turn
  OffScreen noImage;  // one pixel of the background, shown by mirrors that have no pass
  std::map<std::pair<int, size_t>, OffScreen> offScreens;  // by depth and mirror; drawn anew only once fetched

  explicit Core(const Options& asked)
      : options(asked),
        window(options.openWindow()),
        device(options.device(window.get())),
        renderer(device, options.renderer(window.get())),
        depth(device, VK_SAMPLE_COUNT_1_BIT, "shared"),
        noImage(device, {.name = "background", .depth = false}, renderer.retired()) {}
};

using Images = std::array<OffScreen*, mirrors.size()>;  // for each mirror, what it shows in a view

struct ImagePass {
  View reflected;
  OffScreen* target;
  Images shown;  // what the mirrors in it show
  bool flipped;  // reflected an odd number of times
};

// Adds a pass for each mirror that `view` may see to the list, after the passes whose images it fetches. Returns what
// the mirrors show. `view` has been reflected `depth` times, and no image is reflected more than `maxDepth` times.
Images listPasses(Core& core, const View& view, int depth, int maxDepth, bool naive, std::vector<ImagePass>& passes) {
  Images images;
  images.fill(&core.noImage);
  for (size_t m = 0; m < mirrors.size(); ++m) {
    if (depth < maxDepth && maySee(view, mirrors[m])) {
      const View reflected = naive ? view : reflectedView(view, mirrors[m]);
      const Images nested = listPasses(core, reflected, depth + 1, maxDepth, naive, passes);
      const OffScreenDesc desc{.name = "offscreen", .shared = &core.depth};
      images[m] = &core.offScreens.try_emplace({depth, m}, core.device, desc, core.renderer.retired()).first->second;
      passes.push_back({reflected, images[m], nested, !naive && (depth + 1) % 2 == 1});
    }
  }
  return images;
}

// Draws the objects.
class RenderSystem {
 public:
  RenderSystem(Core& core, VkDescriptorSetLayout views)
      : cube_(core.renderer.uploader(), core.options.model("../common/cube.obj")),
        knot_(core.renderer.uploader(), core.options.model("../../models/torus_knot_upright.obj")),
        sphere_(core.renderer.uploader(), core.options.model("../../models/sphere.obj")),
        frame_(core.renderer.uploader(), core.options.model("../../models/frame_wide.obj")),
        shaders_(core.renderer, core.options, "scene",
                 {.setLayouts = {views},
                  .pushConstantBytes = sizeof(Object),
                  .vertexBindings = Mesh::bindings(),
                  .vertexAttributes = Mesh::attributes()}) {}

  void record(const PassScope& pass, VkDescriptorSet viewSet, double time) const {
    const auto spin = static_cast<float>(glm::radians(30.0 * time));
    const std::pair<const Mesh*, Object> objects[] = {
        {&cube_, {place({0, -0.05f, 0}, {8, 0.1f, 6}), {0.26f, 0.15f, 0.09f, 1}, {0.05f, 0.05f, 0.05f, 40}}},
        {&cube_, {place({0, 1.5f, -1.55f}, {8, 3.0f, 0.1f}), {0.07f, 0.19f, 0.22f, 1}}},
        {&frame_, {place({0, 1.0f, -1.5f}, glm::vec3(0.65f)), {0.42f, 0.26f, 0.075f, 1}, {0.55f, 0.38f, 0.13f, 48}}},
        {&cube_, {place({0, 1.5f, 3.05f}, {8, 3.0f, 0.1f}), {0.30f, 0.12f, 0.10f, 1}}},
        {&frame_,
         {place({0, 1.0f, 3.0f}, glm::vec3(0.65f), glm::pi<float>()),
          {0.42f, 0.26f, 0.075f, 1},
          {0.55f, 0.38f, 0.13f, 48}}},
        {&cube_, {place({0, 0.25f, 0}, {0.62f, 0.5f, 0.62f}), {0.6f, 0.56f, 0.48f, 1}}},
        {&knot_, {place({0, 0.5f, 0}, glm::vec3(0.9f), spin), {0.5f, 0.09f, 0.04f, 1}, {0.3f, 0.28f, 0.25f, 70}}},
        {&sphere_,
         {place({-0.85f, 0.27f, -0.6f}, glm::vec3(0.54f)), {0.05f, 0.13f, 0.42f, 1}, {0.1f, 0.1f, 0.1f, 200}}},
        {&sphere_, {place({0.85f, 0.2f, -0.85f}, glm::vec3(0.4f)), {0.5f, 0.4f, 0.12f, 1}, {0.1f, 0.1f, 0.1f, 200}}},
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
  Mesh sphere_;
  Mesh frame_;
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

// Draws a mirror, which fetches its pixels from the OffScreen in `viewSet`.
class MirrorSystem {
 public:
  MirrorSystem(Core& core, VkDescriptorSetLayout views)
      : shaders_(core.renderer, core.options, "mirror",
                 {.setLayouts = {views}, .pushConstantBytes = sizeof(MirrorPush)}) {}

  void record(const PassScope& pass, VkDescriptorSet viewSet, const Mirror& mirror, bool naive) const {
    shaders_.bind(pass, viewSet);
    pass.cull(VK_CULL_MODE_BACK_BIT);  // seen from behind, it is not drawn
    shaders_.push(pass, MirrorPush{.worldFromMirror = place(mirror.center, mirrorSize, mirror.yaw), .naive = naive});
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
  bool naive = options.naive;
  int maxDepth = mirrors.size() < 3 ? 8 : 4;  // reflections of an image, at most; each may show all other mirrors
  UiState state{.clearColor = background, .naive = &naive, .depth = &maxDepth, .mostDepth = 2 * maxDepth};
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
    std::vector<ImagePass> passes;
    const Images images = listPasses(core, camera, 0, naive ? 1 : maxDepth, naive, passes);
    PassDesc clear = fullPass("background", core.noImage.targets());
    clear.clearColor = radiance(state.clearColor);
    core.renderer.beginPass(*frame, clear);  // ends at once, with the statement
    for (const auto& [reflected, target, shown, flipped] : passes) {
      target->resize(naive ? VkExtent2D{512, 512} : frame->extent, core.renderer.retired());
      PassDesc desc = fullPass("offscreen", target->targets());
      desc.clearColor = radiance(state.clearColor);
      // A reflection turns left into right, so corners that ran counter-clockwise run clockwise.
      desc.frontFace = flipped ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
      // The pass begins with the barrier offscreenBeforeWrite, which waits for shaders that still read the OffScreen.
      // It ends at the brace with offscreenToSample, so that shaders of later passes read what it has drawn.
      const PassScope pass = core.renderer.beginPass(*frame, desc);
      const VkDescriptorSet viewSet = views.write(*frame, reflected);
      renderSystem.record(pass, viewSet, loop.time());
      for (size_t m = 0; m < mirrors.size(); ++m) {
        mirrorSystem.record(pass, views.write(*frame, reflected, shown[m]), mirrors[m], naive);
      }
      pointLightSystem.record(pass, viewSet);
    }
    {
      PassDesc desc = fullPass("window", core.renderer.displayTargets(*frame));
      desc.targets.depth = core.depth.image();  // displayTargets() has none
      desc.clearColor = displayed(state.clearColor);
      const PassScope pass = core.renderer.beginPass(*frame, desc);
      const VkDescriptorSet viewSet = views.write(*frame, camera);
      renderSystem.record(pass, viewSet, loop.time());
      for (size_t m = 0; m < mirrors.size(); ++m) {
        mirrorSystem.record(pass, views.write(*frame, camera, images[m]), mirrors[m], naive);
      }
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
