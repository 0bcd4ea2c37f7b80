#include "plan/cube_face.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <utility>

#include "plan/mirror_sight.hpp"
#include "plan/view.hpp"
#include "scene/material_mirrors.hpp"

namespace speculum {

namespace {

// Returns the box that surrounds boxes[own]; boxes that are not reflected do not count. Each side lies at the near face
// of the farthest box on that side, such as a wall, or at the far face of a box that encloses the object, such as a
// room; without such boxes, at the end of the scene.
template <typename Predicate>
Bounds boxAround(size_t own, std::span<const Bounds> boxes, const Predicate& isReflected) {
  const Bounds& inner = boxes[own];
  Bounds all = inner;
  Bounds around = inner;
  glm::bvec3 lowFound(false);
  glm::bvec3 highFound(false);
  for (size_t i = 0; i < boxes.size(); ++i) {
    const Bounds& box = boxes[i];
    if (i != own && !isReflected(i)) {
      continue;
    }
    all.add(box);
    const glm::bvec3 above = glm::greaterThanEqual(box.low, inner.high);
    const glm::bvec3 below = glm::lessThanEqual(box.high, inner.low);
    const bool encloses = i != own && !glm::any(above) && !glm::any(below);
    for (int axis = 0; axis < 3; ++axis) {
      if (above[axis] || encloses) {
        around.high[axis] = std::max(around.high[axis], encloses ? box.high[axis] : box.low[axis]);
        highFound[axis] = true;
      }
      if (below[axis] || encloses) {
        around.low[axis] = std::min(around.low[axis], encloses ? box.low[axis] : box.high[axis]);
        lowFound[axis] = true;
      }
    }
  }
  around.low = glm::mix(all.low, around.low, lowFound);
  around.high = glm::mix(all.high, around.high, highFound);
  return around;
}

Pass faceOf(const Scene& scene, const SceneState& state, const Cube& map, const Projection& projection, size_t index) {
  Pass face = planFace({map.center, faceAxes()[index], projection, map.size}, Onlooker::mirror, scene, state, false,
                       map.instance);
  face.id = {.kind = PassKind::environment, .instance = map.instance, .face = static_cast<int>(index)};
  face.corner = map.size * glm::ivec2(index % 3, index / 3);  // three faces to a row
  addVisibleLights(face.view, Onlooker::mirror, scene, state, map.settings.effects, face);
  return face;
}

// Returns the instances of curved mirrors that the passes draw, ascending.
RecycledVector<int> drawnCurved(const Scene& scene, const SceneState& state, std::span<const Pass* const> passes) {
  RecycledVector<int> drawn;
  for (const Pass* pass : passes) {
    std::ranges::copy_if(pass->instances, std::back_inserter(drawn),
                         [&](int i) { return curvedMirrorOf(scene, state.instances[i]).has_value(); });
  }
  std::ranges::sort(drawn);
  drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());  // Clang 14 does not take std::ranges::unique
  return drawn;
}

// Keeps the instances that get maps, those that look widest, ascending.
void keepWidest(RecycledVector<int>& curved, const SceneState& state) {
  const size_t most = std::clamp<size_t>(
      mostFaceTests / (faceAxes().size() * std::max<size_t>(state.instances.size(), 1)), 1, mostEnvironmentMaps);
  if (curved.size() > most) {
    const auto width = [&](int i) {
      const InstanceState& instance = state.instances[i];
      return instance.radius / std::max(1e-9, glm::length(instance.center - state.camera.eye));
    };
    std::ranges::sort(curved, {}, [&](int i) { return std::pair(-width(i), i); });
    curved.resize(most);
    std::ranges::sort(curved);
  }
}

RecycledString mapName(const Scene& scene, const InstanceState& instance) {
  const Object& object = scene.objects[instance.object];
  auto name = nameOf<RecycledString>("object", object.name, instance.object);
  if (object.copies.count > 1) {
    name.append(" copy ").append(std::to_string(instance.copy));
  }
  return name;
}

}  // namespace

std::span<const FaceAxes> faceAxes() {
  static const std::array<FaceAxes, 6> axes = {{{"+x", {1, 0, 0}, {0, 1, 0}},
                                                {"-x", {-1, 0, 0}, {0, 1, 0}},
                                                {"+y", {0, 1, 0}, {0, 0, 1}},
                                                {"-y", {0, -1, 0}, {0, 0, 1}},
                                                {"+z", {0, 0, 1}, {0, 1, 0}},
                                                {"-z", {0, 0, -1}, {0, 1, 0}}}};
  return axes;
}

RecycledVector<Bounds> boxesOf(const Scene& scene, const SceneState& state, const glm::dvec3& origin) {
  RecycledVector<Bounds> boxes;
  for (const InstanceState& instance : state.instances) {
    const glm::dvec3& half = scene.meshes[instance.mesh].halfExtent;
    glm::dvec3 reach(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      reach += glm::abs(instance.worldFromMesh.linear[axis]) * half[axis];
    }
    const glm::dvec3 center = instance.worldFromMesh.translation - origin;
    boxes.push_back({center - reach, center + reach});
  }
  for (const MirrorState& mirror : state.mirrors) {
    Bounds& box = boxes.emplace_back();
    std::ranges::for_each(mirror.polygon, [&](const glm::dvec3& p) { box.add(p - origin); });
  }
  return boxes;
}

void addVisibleInstances(const View& view, Onlooker onlooker, const Scene& scene, const SceneState& state,
                         bool cullClusters, int without, Pass& pass) {
  for (int i = 0; i < static_cast<int>(state.instances.size()); ++i) {
    const InstanceState& instance = state.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (i == without || !sees(onlooker, scene.objects[instance.object].visible) ||
        !boundsVisible(view, instance, mesh.halfExtent)) {
      continue;
    }
    RecycledVector<IndexRange> ranges =
        cullClusters ? visibleRanges(view, instance, mesh) : RecycledVector<IndexRange>{allOf(mesh)};
    if (ranges.empty()) {
      continue;
    }
    pass.instances.push_back(i);
    if (ranges.front() != allOf(mesh)) {
      pass.partial.push_back({i, std::move(ranges)});
    }
  }
}

void addVisibleLights(const View& view, Onlooker onlooker, const Scene& scene, const SceneState& state,
                      const EffectSettings& effects, Pass& pass) {
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const PointLight& light = scene.lights[i];
    if (hasGlyph(light, effects) && sees(onlooker, light.visible) &&
        sphereVisible(view, state.lights[i].position, light.radius)) {
      pass.lights.push_back(static_cast<int>(i));
    }
  }
}

View viewOf(const CubeFace& face) {
  const glm::dvec3& forward = face.axes.forward;
  const glm::dvec3& up = face.axes.up;
  CameraPose pose;
  pose.eye = face.center;
  pose.worldToView = glm::transpose(glm::dmat3(glm::cross(forward, up), up, -forward));  // the axes are its rows
  return mainView(pose, face.projection, face.size, face.size);
}

Pass planFace(const CubeFace& face, Onlooker onlooker, const Scene& scene, const SceneState& state, bool cullClusters,
              int without) {
  Pass pass;
  pass.view = viewOf(face);
  pass.projection = face.projection;
  pass.areaPx = pass.view.rect.area();
  addVisibleInstances(pass.view, onlooker, scene, state, cullClusters, without, pass);
  View drawn = pass.view;
  widen(drawn, face.projection, 1);
  for (size_t i = 0; i < scene.mirrorCount(); ++i) {
    const MirrorState& mirror = state.mirrors[i];
    const double height = glm::dot(mirror.normal, pass.view.eye - mirror.origin);
    const bool back = height < 0.0 && !scene.mirror(i).twoSided;
    MirrorDraw draw = facingDraw(mirror, static_cast<int>(i), height, back, drawn);
    if (height != 0.0 && !draw.polygon.empty()) {
      pass.mirrors.push_back(std::move(draw));
    }
  }
  return pass;
}

EnvironmentMaps environmentMaps(const Scene& scene, const SceneState& state, const Settings& settings,
                                std::span<const Pass* const> passes) {
  EnvironmentMaps maps;
  if (!settings.effects.curved || settings.effects.curvedLookup != CurvedLookup::environment) {
    return maps;
  }
  const RecycledVector<Bounds> boxes = boxesOf(scene, state);
  RecycledVector<int> curved = drawnCurved(scene, state, passes);
  const size_t drawn = curved.size();
  keepWidest(curved, state);
  // Behind the boxes of instances stand those of mirrors.
  const auto isReflected = [&](size_t i) {
    return i >= state.instances.size() || sees(Onlooker::mirror, scene.objects[state.instances[i].object].visible);
  };
  maps.omitted = drawn - curved.size();
  for (const int i : curved) {
    const InstanceState& instance = state.instances[i];
    const Bounds box = boxAround(static_cast<size_t>(i), boxes, isReflected);
    Cube map{.kind = PassKind::environment,
             .object = instance.object,
             .copy = instance.copy,
             .mesh = instance.mesh,
             .instance = i,
             .name = mapName(scene, instance),
             .size = settings.effects.environmentSize,
             .center = instance.center,
             .low = box.low,
             .high = box.high,
             .settings = settings};
    Projection projection;
    projection.focal = static_cast<double>(map.size - 2 * environmentBorder) / map.size;
    projection.aspect = 1.0;
    projection.near = nearOf(state, projection);
    for (size_t face = 0; face < map.faces.size(); ++face) {
      maps.faces.push_back(faceOf(scene, state, map, projection, face));
    }
    maps.cubes.push_back(std::move(map));
  }
  return maps;
}

}  // namespace speculum
