#pragma once

#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "geometry/recycled_memory.hpp"
#include "plan/occluded_region.hpp"
#include "plan/view.hpp"
#include "settings/settings.hpp"

namespace speculum {

// Finds the occluders that hide a mirror from a view's eye: other mirrors, flat faces of objects, and whole objects
// that are about convex. It is conservative by more than a pixel and the rounding of floats, so that leaving a hidden
// mirror out does not change the picture. Where two occluders meet without overlapping, a strip between them hides
// nothing. Objects and mirrors are opaque on both sides.
class Occlusion {
 public:
  // Keeps references. `mirrors` is a hierarchy over boxes around the mirrors, with room for rounding.
  Occlusion(const Scene& scene, const SceneState& state, const Settings& settings, const Projection& projection,
            const Bvh& mirrors);

  // Sets the view for hiddenBy() and keeps a reference to it. `instances` and `mirrors` are those that the view shows,
  // ascending; if there are very many, only those that look largest are tested as occluders.
  void setView(const View& view, std::span<const int> instances, RecycledVector<int> mirrors);

  // Names the occluders that hide all of `polygon` (world), a part of `mirror`, in the view: "object NAME", "mirror
  // NAME", or several of them; nothing if a part of `polygon` may be visible.
  std::optional<RecycledString> hiddenBy(int mirror, std::span<const glm::dvec3> polygon);

 private:
  // The region that an occluder hides is found when a view first needs it.
  struct Face {
    FlatOccluder occluder;
    int view = -1;          // number of the view that `region` is for; -1: none yet
    bool hides = false;     // else `region` has no meaning
    int tested = -1;        // number of the last view in which the face, of a mirror, is tested
    OccludedRegion region;  // keeps its memory from view to view
  };
  struct Body {
    RecycledVector<Face> faces;
    BodyOccluder whole;
    int view = -1;  // as Face::view
    std::optional<BodyRegion> region;
  };
  struct Occluder {
    OccludedRegion region;
    bool isMirror = false;
    int index = 0;  // index of the mirror or instance
  };
  struct Occluders {
    // Adds a region, cut by the half space `also` if there is one, unless no corner of the polygon lies in it. Returns
    // whether the region holds all of the polygon.
    bool add(const OccludedRegion& region, const HalfSpace* also, const Occluder& of, const glm::dvec3& eye,
             std::span<const glm::dvec3> polygon);
    std::optional<Occluder> whole;  // an occluder that hides all of the polygon; its `region` is left empty
    RecycledVector<Occluder> parts;
  };
  Body& bodyOf(int instance);
  const OccludedRegion* regionOf(Face& face) const;  // null: hides nothing
  const BodyRegion* regionOf(Body& body) const;
  Occluders occludersOf(int mirror, std::span<const glm::dvec3> polygon);
  bool skips(const View& view) const;
  RecycledString nameOfOccluder(const Occluder& occluder) const;
  RecycledString namesOf(std::span<const Occluder* const> occluders) const;
  std::optional<RecycledString> hiddenTogether(std::span<const Occluder> occluders,
                                               std::span<const glm::dvec3> polygon) const;

  const Scene& scene_;
  const SceneState& state_;
  const Settings& settings_;
  const Projection& projection_;
  const View* view_ = nullptr;
  const Bvh& hierarchy_;
  RecycledVector<int> viewMirrors_;    // mirrors that are tested in the view, ascending
  RecycledVector<int> viewInstances_;  // instances that are tested in the view, ascending
  int viewNumber_ = -1;
  RecycledVector<Face> mirrors_;         // parallel to SceneState::mirrors
  RecycledVector<double> largestFaces_;  // by mesh: radius of the largest face over the mesh's radius
  RecycledVector<bool> transparent_;     // by mesh: its instances hide nothing
  std::unordered_map<int, Body, std::hash<int>, std::equal_to<>, RecyclingAllocator<std::pair<const int, Body>>>
      bodies_;  // by index into SceneState::instances; made on first use
};

}  // namespace speculum
