#pragma once

#include <optional>
#include <span>
#include <vector>

#include "edit/selection.hpp"
#include "geometry/bvh.hpp"
#include "geometry/mesh.hpp"
#include "plan/frame_plan.hpp"
#include "plan/view.hpp"
#include "scene/trace_world.hpp"

namespace speculum {

// A straight line on the picture, in pixels from its top left corner.
struct PixelLine {
  glm::dvec2 a{0.0};
  glm::dvec2 b{0.0};
};

// The camera's view of the picture that the user points into, or that view reflected in a chain of mirrors. Projects
// exactly as passes do. Pixels run from the top left corner; the centre of the first one is at (0.5, 0.5).
class PictureView {
 public:
  PictureView(const CameraPose& camera, int width, int height);
  // Returns the view of the world's image in these mirrors, indices into SceneState::mirrors from the eye; nothing if
  // one of the mirrors does not exist or is not seen from its reflecting side.
  std::optional<PictureView> through(const Scene& scene, const SceneState& state, std::span<const int> path) const;

  const View& view() const { return view_; }
  const glm::dvec3& eye() const { return view_.eye; }  // world; reflected about the mirrors
  const MirrorPath& path() const { return view_.path; }
  glm::dvec3 forward() const;  // world, unit
  // Returns the ray (world) from the eye through a point of the picture; its direction is one metre deep, not of unit
  // length.
  Ray ray(const glm::dvec2& pixel) const;
  double depth(const glm::dvec3& world) const;  // metres in front of the eye's plane
  // Returns the pixel of a point; nothing for points nearer than the near plane.
  std::optional<glm::dvec2> pixel(const glm::dvec3& world) const;
  double metresPerPixel(const glm::dvec3& world) const;  // at the point's depth
  // Returns the line between two points (world), cut to its part beyond the near plane; nothing if there is none.
  std::optional<PixelLine> line(const glm::dvec3& a, const glm::dvec3& b) const;
  // Clips a line to the picture, or to the last mirror of the path. Returns nothing if no part of it remains.
  std::optional<PixelLine> clipped(const PixelLine& line) const;
  std::optional<PixelLine> clippedLine(const glm::dvec3& a, const glm::dvec3& b) const;  // line(), clipped
  bool sees(const glm::dvec3& center, double radius) const { return sphereVisible(view_, center, radius); }

 private:
  PictureView(View view, const Projection& projection);
  glm::dvec2 toPixel(const glm::dvec4& clip) const;

  View view_;
  Projection projection_;
  std::vector<glm::dvec2> shown_;  // convex polygon, pixels: part of the picture that shows this view
};

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

// An edge of a mesh, relative to Mesh::center, with the third vertices of the triangles at it.
struct MeshEdge {
  glm::dvec3 a{0.0};
  glm::dvec3 b{0.0};
  glm::dvec3 left{0.0};
  glm::dvec3 right{0.0};
  bool border = false;  // not shared by exactly two triangles: part of every outline

  // Says whether the surface turns away from `eye` here: both triangles lie on one side of the plane through eye and
  // edge.
  bool outlines(const glm::dvec3& eye) const;
};

// Points and edges that an object's outline is drawn from.
struct MeshOutline {
  std::vector<glm::dvec3> points;  // at most 512, for a convex hull
  std::vector<MeshEdge> edges;     // empty for a mesh with too many triangles to test in every frame
};
MeshOutline meshOutline(const Mesh& mesh);

// Returns the outline of the selected node, or of its image in the mirrors that `picture` looks through; empty where
// the node is not seen. The outline of a mirror is its polygon, that of a light a circle, that of an object the edges
// where its mesh turns away from the eye or ends. An object without edges in `shape`, or with more than 4000 such
// edges, has the convex hull of its points or, if one of them is behind the eye, the edges of its box.
std::vector<PixelLine> outlineOf(const Scene& scene, const SceneState& state, const Selection& selection,
                                 const PictureView& picture, const MeshOutline& shape);

}  // namespace speculum
