#pragma once

#include <memory>

#include "edit/picture_view.hpp"
#include "edit/selection.hpp"
#include "frame/frame_plan.hpp"

namespace speculum {

// A thing that a pixel shows.
struct Picked {
  Selection what;
  std::vector<int> path;  // mirrors that it is seen through, from the eye; indices into Scene::mirrors
  glm::dvec3 point{0.0};  // world, on the thing itself

  bool operator==(const Picked&) const = default;
};

// Which mirrors show an image.
struct PickLimits {
  int maxDepth = 4;                        // reflection.max_depth
  double minThroughput = 0.0;              // reflection.min_throughput
  std::span<const SkippedMirror> skipped;  // of the plan of the picture, if it is known
};

// Finds what a pixel shows, in double and without the GPU.
class Picker {
 public:
  // Keeps a reference to the scene, whose meshes must not change; builds their hierarchies.
  explicit Picker(const Scene& scene);
  ~Picker();
  Picker(const Picker&) = delete;
  Picker& operator=(const Picker&) = delete;

  // What the ray through a point of the picture ends on first, then the mirrors it was seen through, the one nearest to
  // the eye last. Reflections are followed in planar mirrors as they are drawn; those of ripples and of rough mirrors
  // as in the mirror's plane. Nothing of the background seen directly. `picture` is a camera's view of the state.
  std::vector<Picked> at(const SceneState& state, const PictureView& picture, const glm::dvec2& pixel,
                         const PickLimits& limits);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace speculum
