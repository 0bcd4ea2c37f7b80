#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frame/settings.hpp"
#include "frame/view.hpp"

namespace speculum {

// Finds what hides a mirror: one flat convex occluder, another mirror or a face of an object, that covers all of it as
// seen from a view's eye. Conservative: by more than what rounding on the GPU and the edges of pixels can undo, so that
// a hidden mirror would not have left a trace in the picture. Objects and mirrors are opaque on both sides.
class Occlusion {
 public:
  Occlusion(const Scene& scene, const SceneState& state, const Settings& settings, const Projection& projection);

  // What hides all of `polygon` (world), a part of `mirror`, in the view: "object NAME" or "mirror NAME". `instances`
  // are those that the view shows.
  std::optional<std::string> hiddenBy(const View& view, std::span<const int> instances, int mirror,
                                      std::span<const glm::dvec3> polygon);

 private:
  struct Occluder {
    std::vector<glm::dvec3> polygon;  // world
    Plane plane;
    double slack = 0.0;  // metres by which it may stand elsewhere on the GPU
  };
  static Occluder occluder(std::vector<glm::dvec3> polygon, double size);
  const std::vector<Occluder>& facesOf(int instance);
  bool covers(const Occluder& occluder, const View& view, std::span<const glm::dvec3> polygon) const;
  bool isBehind(const Occluder& occluder, const View& view, std::span<const glm::dvec3> polygon) const;

  const Scene& scene_;
  const SceneState& state_;
  const Settings& settings_;
  const Projection& projection_;
  std::vector<Occluder> mirrors_;                                    // parallel to SceneState::mirrors
  std::vector<std::optional<std::vector<Occluder>>> instanceFaces_;  // made when first asked for
};

}  // namespace speculum
