#pragma once

#include <algorithm>
#include <set>
#include <vector>

#include "geometry/convex_mesh.hpp"
#include "plan/frame_plan.hpp"
#include "plan/mirror_sight.hpp"
#include "plan/scene_changes.hpp"

namespace speculum::testing_support {

constexpr int width = 640;
constexpr int height = 360;

// A mirror that faces +z, turned by `yaw` degrees.
inline Mirror wall(const glm::dvec3& position, double yaw, const glm::dvec2& size = {2, 2}) {
  return {.position = position, .rotation = {0, yaw, 0}, .size = size};
}

// An object of the scene's first mesh.
inline Object objectAt(const glm::dvec3& position, const glm::dvec3& scale = glm::dvec3(1.0)) {
  return {.mesh = 0, .position = position, .scale = scale};
}

// A mesh of which only the extent counts.
inline Mesh cube(double halfSide, double radius) {
  return {.halfExtent = glm::dvec3(halfSide),
          .radius = radius,
          .vertices = {Vertex{}},
          .indices = {0, 0, 0},
          .parts = {{}}};
}

// Returns a scene whose camera stands at the origin and looks along -z.
inline Scene sceneWith(std::vector<Mirror> mirrors) {
  Scene scene;
  scene.camera.target = {0, 0, -1};
  scene.mirrors = std::move(mirrors);
  return scene;
}

// Two mirrors that face each other, with the camera between them.
inline Scene corridor() {
  Scene scene = sceneWith({wall({0, 0, -5}, 0, {4, 4}), wall({0, 0, 5}, 180, {4, 4})});
  scene.camera.position = {0.3, 0.2, 0};
  scene.camera.target = {0.3, 0.2, -1};
  return scene;
}

// Makes a mesh with its occluders.
inline Mesh meshOf(const std::vector<glm::dvec3>& positions, const std::vector<uint32_t>& indices) {
  Mesh mesh{.indices = indices, .parts = {{.indexCount = static_cast<uint32_t>(indices.size())}}};
  for (const glm::dvec3& p : positions) {
    mesh.vertices.push_back({.position = p});
    mesh.halfExtent = glm::max(mesh.halfExtent, glm::abs(p));
    mesh.radius = std::max(mesh.radius, glm::length(p));
  }
  for (std::vector<glm::dvec3>& face : convexFaces(positions, indices, 32, 4096)) {
    mesh.faces.emplace_back(std::move(face));
  }
  mesh.convex = convexMesh(positions, indices, 4096);
  return mesh;
}

// Returns the plan at time 0; `skipped` lists mirrors that views do not see too.
inline FramePlan planOf(const Scene& scene, const Settings& settings = {}) {
  const SceneState state = evaluate(scene, 0.0);
  FramePlan plan = planFrame({scene, state, settings, {width, height}});
  plan.skipped = skippedMirrors(scene, state, plan, SIZE_MAX);
  return plan;
}

inline std::span<const Cube> shadowMapsOf(const FramePlan& plan) {
  return cubesOf(plan.cubes, PassKind::shadow);
}
inline std::span<const Cube> environmentMapsOf(const FramePlan& plan) {
  return cubesOf(plan.cubes, PassKind::environment);
}

inline const Pass& faceOf(const FramePlan& plan, const Cube& cube, size_t face) {
  return plan.passes[static_cast<size_t>(cube.faces[face])];
}

// Returns the number of mirror passes that cached images replace.
inline size_t reusedMirrors(const FramePlan& plan) {
  return static_cast<size_t>(std::ranges::count_if(plan.passes, [](const Pass& pass) {
    return pass.id.kind == PassKind::mirror && pass.source == PassSource::reused;
  }));
}

inline const SkippedMirror* skipOf(const FramePlan& plan, const MirrorPath& path) {
  const auto it = std::ranges::find(plan.skipped, path, &SkippedMirror::path);
  return it == plan.skipped.end() ? nullptr : &*it;
}

inline int count(const FramePlan& plan, SkipReason reason) {
  return static_cast<int>(std::ranges::count(plan.skipped, reason, &SkippedMirror::reason));
}

// Plans frame after frame, each with the cache that the one before left.
class PlanSequence {
 public:
  explicit PlanSequence(Scene s, int interval = 1, bool skipUnchanged = true) : scene(std::move(s)) {
    settings.reflection.updateInterval = interval;
    settings.reflection.skipUnchanged = skipUnchanged;
  }

  const FramePlan& next(double time = 0.0) {
    const SceneState state = evaluate(scene, time);
    changes.update(scene, state);
    plan = planFrame({scene,
                      state,
                      settings,
                      {width, height},
                      {.images = plan.cached,
                       .cubes = plan.cubes,
                       .main = main.content.empty() ? nullptr : &main,
                       .changes = &changes},
                      0,
                      shownOnly});
    main = {settings, plan.mainContent, plan.encodes};
    return plan;
  }
  void moveCamera(const glm::dvec3& by) {
    scene.camera.position += by;
    scene.camera.target += by;
  }
  // Returns the mirrors seen directly that have a pass, or a cached image that is reused.
  std::set<int> rendered() const {
    std::set<int> mirrors;
    for (const Pass& pass : plan.drawnMirrors()) {
      mirrors.insert(pass.view.path.front());
    }
    return mirrors;
  }
  std::set<int> unchanged() const {
    std::set<int> mirrors;
    for (const SkippedMirror& skip : plan.skipped) {
      if (skip.reason == SkipReason::unchanged) {
        mirrors.insert(skip.path.back());
      }
    }
    return mirrors;
  }

  Scene scene;
  Settings settings;
  bool shownOnly = false;
  FramePlan plan;
  MainImage main;
  SceneChanges changes;
};

}  // namespace speculum::testing_support
