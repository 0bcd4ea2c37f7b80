#include "frame/image_content.hpp"

#include <algorithm>
#include <bit>
#include <set>
#include <utility>

#include "frame/mesh_level.hpp"
#include "scene/scene_fields.hpp"

namespace speculum {

namespace {

// A list of numbers that is compared bit by bit, because 0 and -0 may be drawn differently.
class Numbers {
 public:
  void add(double value) { numbers_.push_back(std::bit_cast<uint64_t>(value)); }
  void add(const glm::dvec2& v) { addAll(v.x, v.y); }
  void add(const glm::dvec3& v) { addAll(v.x, v.y, v.z); }
  void add(const glm::dmat3& m) { addAll(m[0], m[1], m[2]); }
  void add(const Plane& plane) { addAll(plane.point, plane.normal); }
  void add(const PixelRect& rect) { addAll(rect.x, rect.y, rect.width, rect.height); }
  template <typename T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) {
      add(*value);
    }
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add(static_cast<double>(values.size()));
    for (const T& value : values) {
      add(value);
    }
  }
  template <typename... T>
  void addAll(const T&... values) {
    (add(values), ...);
  }

  void add(const std::string& text) { add(std::vector<double>(text.begin(), text.end())); }
  template <typename Enum>
  requires std::is_enum_v<Enum>
  void add(Enum value) { add(static_cast<double>(value)); }
  // Adds the fields that are read where the node is drawn; SceneState has the others.
  template <Described Node>
  void add(const Node& node) {
    forEachField<Node>([&](const auto& field) {
      if (field.use == FieldUse::appearance) {
        add(node.*field.member);
      }
    });
  }
  void add(const View& view) {
    addAll(view.eye, view.worldToView, view.clip, view.cone, view.rect, view.pictureSize, view.path);
  }
  void add(const SimplifiedInstance& simplified) { addAll(simplified.instance, simplified.level); }
  // A cached image is compared by itself; a mirror without an image shows the background.
  void add(const MirrorDraw& draw) {
    addAll(draw.cached.has_value(), draw.mirror, draw.back, draw.byRays, draw.blurs, draw.ripples, draw.polygon,
           draw.plane, draw.layer);
  }

  std::vector<uint64_t> take() { return std::move(numbers_); }

 private:
  std::vector<uint64_t> numbers_;
};

void addInstance(const ImageSurroundings& around, int index, Numbers& numbers) {
  const InstanceState& instance = around.state.instances[index];
  numbers.addAll(index, instance.object, instance.mesh, instance.worldFromMesh.linear,
                 instance.worldFromMesh.translation, instance.center, instance.radius);
  numbers.add(around.scene.objects[instance.object]);
}

void addMirror(const ImageSurroundings& around, int index, Numbers& numbers) {
  const MirrorState& state = around.state.mirrors[index];
  numbers.addAll(index, state.polygon, state.origin, state.normal, state.axisX, state.axisY);
  numbers.add(around.scene.mirrors[index]);
}

void addEffects(const ImageSurroundings& around, const View& main, Numbers& numbers) {
  const TracedEffects& effects = around.effects;
  numbers.addAll(effects.any(), effects.traces(), effects.shadows.has_value(), effects.shadowMaps,
                 effects.castsLight.has_value(), static_cast<double>(effects.bouncedLights.size()));
  const bool waves = around.settings.effects.ripple && std::ranges::any_of(around.scene.mirrors, [](const Mirror& m) {
                       return m.ripple && m.ripple->speed != 0.0;
                     });
  numbers.add(waves && (effects.any() || effects.ripple) ? around.state.time : 0.0);
  if (!effects.any()) {
    return;
  }
  numbers.add(main.eye);  // origin of the space that rays are traced in
  for (const BouncedLight& bounced : effects.bouncedLights) {
    numbers.addAll(bounced.light, bounced.mirror);
  }
}

// Returns all indices below `count`, or none.
std::set<int> indices(bool all, size_t count) {
  std::set<int> found;
  for (size_t i = 0; all && i < count; ++i) {
    found.insert(static_cast<int>(i));
  }
  return found;
}

}  // namespace

std::vector<uint64_t> imageContent(const ImageSurroundings& around, const View& main,
                                   std::span<const PlannedPass* const> passes) {
  Numbers numbers;
  numbers.add(around.scene.environment.cleared(around.settings.view.clearColor));
  numbers.addAll(around.projection.focal, around.projection.aspect, around.projection.near, around.projection.offset);
  addEffects(around, main, numbers);
  const bool all = around.effects.any() || !around.maps.empty();
  numbers.addAll(all, around.shadowSerial);
  for (const auto& [instance, serial] : around.maps) {
    numbers.addAll(instance, serial);
  }
  std::set<int> instances = indices(all, around.state.instances.size());
  std::set<int> mirrors = indices(all, around.state.mirrors.size());
  for (const PlannedPass* pass : passes) {
    numbers.addAll(pass->view, pass->channels, pass->instances, pass->simplified, pass->lights, pass->mirrors);
    instances.insert(pass->instances.begin(), pass->instances.end());
    for (const MirrorDraw& draw : pass->mirrors) {
      mirrors.insert(draw.mirror);
    }
  }
  for (const int instance : instances) {
    addInstance(around, instance, numbers);
  }
  for (const int mirror : mirrors) {
    addMirror(around, mirror, numbers);
  }
  for (size_t i = 0; i < around.scene.lights.size(); ++i) {
    numbers.addAll(around.state.lights[i].position, around.scene.lights[i]);
  }
  return numbers.take();
}

std::vector<uint64_t> shadowContent(const SceneState& state, const ShadowFace& face, const PlannedPass& casters) {
  Numbers numbers;
  numbers.addAll(casters.view, face.low, face.high, face.projection.near, casters.instances);
  for (const int i : casters.instances) {
    const InstanceState& instance = state.instances[i];
    numbers.addAll(instance.mesh, levelOf(casters, i), instance.worldFromMesh.linear,
                   instance.worldFromMesh.translation);
  }
  for (const MirrorDraw& draw : casters.mirrors) {
    numbers.addAll(draw.mirror, draw.polygon);
  }
  return numbers.take();
}

}  // namespace speculum
