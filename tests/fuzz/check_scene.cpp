#include <algorithm>
#include <array>
#include <glm/gtx/component_wise.hpp>

#include "edit/scene_document.hpp"
#include "fuzz_support.hpp"
#include "geometry/polygon.hpp"
#include "plan/frame_plan.hpp"
#include "scene/scene_state.hpp"

namespace speculum::fuzz {

namespace {

constexpr int pictureWidth = 64;  // pixels of the planned pictures
constexpr int pictureHeight = 48;

void checkTransforms(const SceneState& state) {
  require(finite(state.camera.eye), "the eye is finite");
  for (int i = 0; i < 3; ++i) {
    require(unit(state.camera.worldToView[i]), "the camera's axes are of unit length");
  }
  for (const InstanceState& instance : state.instances) {
    const Affine& affine = instance.worldFromMesh;
    require(finite(affine.linear[0]) && finite(affine.linear[1]) && finite(affine.linear[2]) &&
                finite(affine.translation) && finite(instance.center) && std::isfinite(instance.radius),
            "transforms of objects are finite");
  }
  for (const LightState& light : state.lights) {
    require(finite(light.position), "lights are at finite places");
  }
}

void checkMirrors(const SceneState& state) {
  for (const MirrorState& mirror : state.mirrors) {
    require(finite(mirror.origin), "a mirror is at a finite place");
    require(!polygonDefect(mirror.polygon), "mirrors are planar, convex, with an area");
    for (const glm::dvec3& axis : {mirror.normal, mirror.axisX, mirror.axisY}) {
      require(finite(axis) && unit(axis), "a mirror's axes are of unit length");
    }
  }
}

void checkView(const View& view) {
  require(finite(view.eye), "a pass's eye is finite");
  for (const glm::dvec3& normal : view.cone) {
    require(finite(normal) && unit(normal), "planes that bound a view are unit vectors");
  }
}

void checkPlan(const FramePlan& plan, const Settings& settings, size_t mirrorCount) {
  require(plan.drawnMirrors().size() <= static_cast<size_t>(settings.reflection.maxPasses),
          "passes keep to their budget");
  checkView(plan.main().view);
  for (const Pass& pass : plan.drawnMirrors()) {
    checkView(pass.view);
    require(!pass.view.rect.empty() && std::isfinite(pass.areaPx) && std::isfinite(glm::compMax(pass.channels)),
            "a pass has pixels");
    require(pass.view.path.size() <= static_cast<size_t>(settings.reflection.maxDepth), "passes keep to the depth");
    for (const MirrorDraw& draw : pass.mirrors) {
      require(draw.mirror >= 0 && static_cast<size_t>(draw.mirror) < mirrorCount && unit(draw.plane.normal),
              "mirrors drawn are the scene's");
      require(std::ranges::all_of(draw.polygon, [](const glm::dvec3& p) { return finite(p); }),
              "what is drawn of a mirror is finite");
    }
  }
}

// Limits copies and passes, which take time and test nothing new.
void shorten(Scene& scene, Settings& settings) {
  for (Object& object : scene.objects) {
    object.copies.count = std::min(object.copies.count, 16);
  }
  if (scene.mirrors.size() > 64) {
    scene.mirrors.resize(64);
  }
  settings.reflection.maxPasses = std::min(settings.reflection.maxPasses, 12);
}

void useScene(Scene scene, Settings settings) {
  // The last copy is the farthest.
  for (const Object& object : scene.objects) {
    require(finite(object.position + static_cast<double>(object.copies.count) * object.copies.step),
            "copies are at finite places");
  }
  shorten(scene, settings);
  RecycledVector<CachedImage> cached;
  for (const double time : {0.0, 1.0 / 60.0, 3600.0, 1e6, -1e6, -0.25}) {
    const SceneState state = evaluate(scene, time);
    checkTransforms(state);
    checkMirrors(state);
    const FramePlan plan = planFrame({scene, state, settings, {pictureWidth, pictureHeight}, {.images = cached}});
    checkPlan(plan, settings, scene.mirrors.size());
    cached = plan.cached;
  }
}

// A file that is saved unchanged is the same bytes; one that is edited reads back as edited, or save() would throw.
void editScene(Scene scene, std::string_view text, const std::filesystem::path& file) {
  SceneDocument document(scene);
  require(document.text(file, {}) == text, "a scene that is saved unchanged is the same text");
  document.change("everything", {}, [](Scene& edited) {
    edited.environment.ambient = {0.125, 0.5, 0.3};
    edited.environment.sky.reset();
    edited.camera.verticalFov = 45.5;
    for (Object& object : edited.objects) {
      object.name += '!';
      object.mirror = object.mirror ? std::optional<ObjectMirror>() : ObjectMirror();
    }
    for (PointLight& light : edited.lights) {
      light.orbit = light.orbit ? std::optional<Orbit>() : Orbit{.speed = 2.0};
    }
    for (Mirror& mirror : edited.mirrors) {
      mirror.ripple = mirror.ripple ? std::optional<Ripple>() : Ripple{.amplitude = 0.5};
      mirror.roughness = 0.75;
    }
  });
  document.addMirror({0.0, 1.0, 2.0}, {0.0, 1.0, 3.0});
  document.addLight({0.0, 1.0, 2.0}, {0.0, 1.0, 3.0});
  document.text(file, {});
  document.remove({Selection{Selection::Kind::mirror, 0}});
  document.remove({Selection{Selection::Kind::light, 0}});
  if (!scene.objects.empty()) {
    document.remove({Selection{Selection::Kind::object, 0}});
  }
  document.text(file, {});
}

}  // namespace

bool checkScene(std::string_view text) {
  static const TemporaryFolder folder;
  static const std::array models{
      folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
      folder.write("large.obj", "v 0 0 0\nv 1e200 0 0\nv 0 -1e200 0\nf 1 2 3\n"),
  };
  const std::filesystem::path file = folder.write("scene.toml", text);
  require(std::filesystem::exists(models[0]), "the models are there");
  Scene scene;
  Settings settings;
  const bool isScene = accepted([&] {
    scene = loadScene(file);
    settings = settingsOf(scene);
  });
  if (isScene) {
    editScene(scene, text, file);
    useScene(std::move(scene), settings);
  }
  return isScene;
}

}  // namespace speculum::fuzz
