#pragma once

#include <deque>
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
    FlatOccluder occluder;  // without a polygon: hides nothing
    int view = -1;          // number of the view that `region` is for; -1: none yet
    bool hides = false;     // else `region` has no meaning
    int tested = -1;        // number of the last view in which the face, of a mirror, is tested
    OccludedRegion region;  // keeps its memory from view to view
  };
  // Bounds of a face, a little larger than it is.
  struct FaceBounds {
    glm::dvec3 center{0.0};  // world, of a sphere
    double radius = 0.0;     // metres
    double width = 0.0;      // metres, see ConvexFace::width
    Face* face = nullptr;    // one of faces_, made on first use, because most faces are too small to be looked at
  };
  struct Body {
    RecycledVector<FaceBounds> bounds;  // of each face
    BodyOccluder whole;
    int view = -1;  // as Face::view
    std::optional<BodyRegion> region;
  };
  struct Occluder {
    bool isMirror = false;
    int index = 0;                           // index of the mirror or instance
    const OccludedRegion* region = nullptr;  // in the present view
    const HalfSpace* also = nullptr;         // cuts the region; null: nothing does

    bool hides(const glm::dvec3& fromEye) const;
  };
  struct Occluders {
    // Adds an occluder unless no corner of the polygon lies in its region. Returns whether it hides all of the polygon.
    bool add(const Occluder& occluder, const glm::dvec3& eye, std::span<const glm::dvec3> polygon);
    std::optional<Occluder> whole;  // an occluder that hides all of the polygon
    RecycledVector<Occluder> parts;
  };
  struct Candidate {
    int instance = 0;
    glm::dvec3 center{0.0};
    double radius = 0.0;
    double largest = 0.0;  // radius of its largest occluder
  };
  // Facts about a mesh, found on first use.
  struct Shape {
    bool known = false;
    bool transparent = false;  // its instances hide nothing
    double largest = 0.0;      // radius of the largest face, or of the whole body, over the mesh's radius
  };
  const Shape& shapeOf(int mesh);
  Body& bodyOf(int instance);
  Face& faceOf(FaceBounds& bounds, int instance, size_t index);
  // Says whether a face is too narrow in the view to hide anything.
  bool looksNarrow(const FaceBounds& face) const {
    return face.width < narrowest_ * (glm::dot(forward_, face.center - view_->eye) - face.radius);
  }
  const OccludedRegion* regionOf(Face& face) const;  // null: hides nothing
  const BodyRegion* regionOf(Body& body) const;
  class Prefilter;
  Occluders occludersOf(int mirror, const Prefilter& prefilter);
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
  RecycledVector<int> viewMirrors_;          // mirrors that are tested in the view, ascending
  RecycledVector<Candidate> viewInstances_;  // instances that are tested in the view, ascending
  int viewNumber_ = -1;
  glm::dvec3 forward_{0.0};       // axis of the view
  double narrowest_ = 0.0;        // narrowestFace() of the view
  RecycledVector<Face> mirrors_;  // parallel to SceneState::mirrors
  RecycledVector<Shape> shapes_;  // by mesh
  std::unordered_map<int, Body, std::hash<int>, std::equal_to<>, RecyclingAllocator<std::pair<const int, Body>>>
      bodies_;                                        // by index into SceneState::instances; made on first use
  std::deque<Face, RecyclingAllocator<Face>> faces_;  // of objects
};

}  // namespace speculum
