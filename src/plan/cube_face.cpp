#include "plan/cube_face.hpp"

#include <algorithm>
#include <array>

#include "plan/mirror_sight.hpp"

namespace speculum {

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

glm::ivec2 faceCorner(int size, size_t face) {
  return size * glm::ivec2(face % 3, face / 3);
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

}  // namespace speculum
