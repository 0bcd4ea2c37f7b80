#pragma once

#include "edit/picture_view.hpp"
#include "edit/selection.hpp"
#include "plan/frame_plan.hpp"
#include "scene/trace_world.hpp"

namespace speculum {

// A node that a pixel shows.
struct Picked {
  Selection what;
  MirrorPath path;        // mirrors from the eye that it is seen in; indices into Scene::mirrors
  glm::dvec3 point{0.0};  // world, on the node itself

  bool operator==(const Picked&) const = default;
};

// Limits of the frame plan: a mirror beyond them shows no image.
struct PickLimits {
  int maxDepth = 4;                        // reflection.max_depth
  double minThroughput = 0.0;              // reflection.min_throughput
  std::span<const SkippedMirror> skipped;  // of the picture's frame plan, if there is one
};

// Finds the nodes under a pixel, in double precision and without the GPU.
class Picker {
 public:
  // Keeps a reference to the scene, whose meshes must not change; builds their hierarchies.
  explicit Picker(const Scene& scene) : world_(scene) {}

  // Returns the node on which the ray through a point of the picture ends, then the mirrors on its way, the one nearest
  // to the eye last; nothing where the background or the sky is seen directly. Reflections are followed as planar
  // mirrors draw them; rippled and rough mirrors count as smooth. `picture` is the camera's view of the state.
  std::vector<Picked> at(const SceneState& state, const PictureView& picture, const glm::dvec2& pixel,
                         const PickLimits& limits);

 private:
  TraceWorld world_;
};

}  // namespace speculum
