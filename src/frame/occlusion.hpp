#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "frame/occluded_region.hpp"
#include "frame/settings.hpp"
#include "frame/view.hpp"

namespace speculum {

// Finds the occluders that hide a mirror from a view's eye: other mirrors, flat faces of objects, and whole objects
// that are about convex. It is conservative by more than a pixel and the rounding of floats, so that leaving a hidden
// mirror out does not change the picture. Where two occluders meet without overlapping, a strip between them hides
// nothing. Objects and mirrors are opaque on both sides.
class Occlusion {
 public:
  Occlusion(const Scene& scene, const SceneState& state, const Settings& settings, const Projection& projection);

  // Names the occluders that hide all of `polygon` (world), a part of `mirror`, in the view: "object NAME", "mirror
  // NAME", or several of them; nothing if they do not. `instances` are those that the view shows.
  std::optional<std::string> hiddenBy(const View& view, std::span<const int> instances, int mirror,
                                      std::span<const glm::dvec3> polygon);

 private:
  struct Body {
    std::vector<FlatOccluder> faces;
    BodyOccluder whole;
  };
  struct Occluder {
    OccludedRegion region;
    bool isMirror = false;
    int index = 0;  // of the mirror or instance
  };
  struct Occluders {
    bool add(std::optional<OccludedRegion> region, const Occluder& of, const glm::dvec3& eye,
             std::span<const glm::dvec3> polygon);
    std::optional<Occluder> whole;  // hides all of it; without its region
    std::vector<Occluder> parts;
  };
  static FlatOccluder flatOccluder(std::vector<glm::dvec3> polygon, double size);
  static BodyOccluder bodyOccluder(const ConvexMesh& mesh, const InstanceState& state);
  const Body& bodyOf(int instance);
  Occluders occludersOf(const View& view, std::span<const int> instances, int mirror,
                        std::span<const glm::dvec3> polygon);
  std::string nameOfOccluder(const Occluder& occluder) const;
  std::optional<std::string> hiddenTogether(std::span<const Occluder> occluders, const View& view,
                                            std::span<const glm::dvec3> polygon) const;

  const Scene& scene_;
  const SceneState& state_;
  const Settings& settings_;
  const Projection& projection_;
  std::vector<FlatOccluder> mirrors_;        // parallel to SceneState::mirrors
  std::vector<double> largestFaces_;         // by mesh, radius as a part of the mesh's
  std::vector<std::optional<Body>> bodies_;  // parallel to SceneState::instances; made on first use
};

}  // namespace speculum
