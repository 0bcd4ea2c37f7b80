#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frame/occluded_region.hpp"
#include "frame/settings.hpp"
#include "frame/view.hpp"

namespace speculum {

// Finds the occluders that hide a mirror from a view's eye, alone or several together: other mirrors, flat faces of
// objects, whole convex objects. It is conservative by more than rounding on the GPU and the edges of pixels, so that a
// hidden mirror would not have left a trace in the picture. Where two occluders meet without one reaching behind the
// other, that leaves a strip that hides nothing. Objects and mirrors are opaque on both sides.
class Occlusion {
 public:
  Occlusion(const Scene& scene, const SceneState& state, const Settings& settings, const Projection& projection);

  // Names the occluders that hide all of `polygon` (world), a part of `mirror`, in the view: "object NAME", "mirror
  // NAME", or several of them. `instances` are those that the view shows.
  std::optional<std::string> hiddenBy(const View& view, std::span<const int> instances, int mirror,
                                      std::span<const glm::dvec3> polygon);

 private:
  struct Body {
    std::vector<FlatOccluder> faces;
    BodyOccluder whole;
  };
  struct Hider {
    OccludedRegion region;
    bool isMirror = false;
    int index = 0;  // of the mirror or instance
  };
  struct Hiders {
    bool add(std::optional<OccludedRegion> region, const Hider& of, const glm::dvec3& eye,
             std::span<const glm::dvec3> polygon);
    std::optional<Hider> whole;  // hides all of it; without its region
    std::vector<Hider> parts;
  };
  static FlatOccluder occluder(std::vector<glm::dvec3> polygon, double size);
  static BodyOccluder wholeOf(const ConvexMesh& mesh, const InstanceState& state);
  const Body& bodyOf(int instance);
  Hiders hiders(const View& view, std::span<const int> instances, int mirror, std::span<const glm::dvec3> polygon);
  std::string nameOfHider(const Hider& hider) const;
  std::optional<std::string> hiddenTogether(std::span<const Hider> hiders, const View& view,
                                            std::span<const glm::dvec3> polygon) const;

  const Scene& scene_;
  const SceneState& state_;
  const Settings& settings_;
  const Projection& projection_;
  std::vector<FlatOccluder> mirrors_;        // parallel to SceneState::mirrors
  std::vector<double> largestFaces_;         // of each mesh, radius as a part of the mesh's
  std::vector<std::optional<Body>> bodies_;  // parallel to SceneState::instances; made when first asked for
};

}  // namespace speculum
