#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "geometry/bvh.hpp"
#include "geometry/mesh.hpp"
#include "geometry/polygon.hpp"
#include "geometry/projection.hpp"
#include "geometry/recycled_memory.hpp"
#include "scene/scene.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

// Name of a node for users: "mirror 'floor'", or "mirror 2" if it has none.
template <typename String = std::string>
String nameOf(std::string_view kind, std::string_view name, int index) {
  String text(kind);
  if (name.empty()) {
    text.append(" ").append(std::to_string(index));
  } else {
    text.append(" '").append(name).append("'");
  }
  return text;
}

// Name of a path for users, from the eye on: "floor > 3" if the second mirror, number 3, has no name.
inline std::string mirrorPathName(const Scene& scene, std::span<const int> path) {
  std::string text;
  for (const int mirror : path) {
    const std::string& name = scene.mirror(mirror).name;
    text += (text.empty() ? "" : " > ") + (name.empty() ? std::to_string(mirror) : name);
  }
  return text;
}

// Mirrors that reflect a view, from the camera's eye on, as indices into Scene::mirrors; empty for the main view.
using MirrorPath = RecycledVector<int>;

// Returns the recursion depth of the mirror at the end of a path: 0 for one seen directly, -1 without a mirror.
inline int depthOf(const MirrorPath& path) {
  return static_cast<int>(path.size()) - 1;
}

// The camera, or the camera reflected in a chain of mirrors. All views of a frame share one projection, so that a
// mirror image lines up with the view it is seen from, pixel by pixel.
struct View {
  glm::dvec3 eye{0.0};              // world; reflected about every mirror of the path
  glm::dmat3 worldToView{1.0};      // V R1 .. Rk, linear part; apply it to differences from `eye`
  std::optional<Plane> clip;        // world; only its positive side is drawn
  RecycledVector<glm::dvec3> cone;  // world, inward unit normals of planes through `eye` that bound what can be seen
  PixelRect rect;                   // pixels of the whole picture at this view's resolution
  glm::dvec2 pictureSize{0.0};      // pixels of the whole picture at this view's resolution; need not be whole
  MirrorPath path;

  // An odd number of reflections turns counter-clockwise into clockwise.
  bool mirrored() const { return path.size() % 2 == 1; }
};

// Returns the depth along the axis of view, in metres, below which the depth test keeps no order: smaller than the
// depth of anything drawn, at most the camera's near and 1 mm, and no smaller than needed, because GPUs are slow with
// tiny depths. Within 1/1000 of its radius, an object around the eye may be drawn out of order. Uses only the focal
// length and aspect of `projection`.
double nearOf(const SceneState& state, const Projection& projection);

// Returns the camera's view of a picture of `width` x `height` pixels.
View mainView(const CameraPose& camera, const Projection& projection, int width, int height);

// Replaces the view's cone by planes through the sides of its rectangle.
void boundByRectangle(View& view, const Projection& projection);

// Moves the sides of the view's rectangle and the planes of its cone outwards on the screen by `pixels`.
void widen(View& view, const Projection& projection, int pixels);

// Returns the size of the drawn part of the projection plane, centred, in widths and heights of the picture: 1 where
// `view.rect` lies within the picture. More where an image has a margin beyond the picture's border, or reaches it with
// a part of its last texel, because the picture is no whole number of texels.
glm::dvec2 overscan(const View& view);

// Returns inward unit normals of the planes through the eye and the edges of a convex polygon (world); skips edges that
// point at the eye.
RecycledVector<glm::dvec3> coneThrough(const glm::dvec3& eye, std::span<const glm::dvec3> polygon);

// Returns `parent` reflected about a mirror's plane. `plane` faces the parent's eye; `visible` is the mirror's visible
// region (world). `rect` and `pictureSize` are at the resolution of mirror images.
View reflectedView(const View& parent, int mirror, const Plane& plane, std::span<const glm::dvec3> visible,
                   const PixelRect& rect, const glm::dvec2& pictureSize);

// Says whether the view may see a part of the convex hull of points (world).
bool hullVisible(const View& view, std::span<const glm::dvec3> points);

// Cuts a convex polygon (world) by the view's clip plane and cone.
Polygon visiblePart(const View& view, std::span<const glm::dvec3> polygon);

bool sphereVisible(const View& view, const glm::dvec3& center, double radius);

// Says whether the view may see a part of the box that reaches `halfExtent` from the origin of its own space.
bool boxVisible(const View& view, const Affine& worldFromBox, const glm::dvec3& halfExtent);

// Says the same of a box in world space. True wherever hullVisible() is for points in the box.
bool boxVisible(const View& view, const Bounds& box);

// Returns world positions in clip space. Subtracts the eye first.
RecycledVector<glm::dvec4> toClip(const View& view, const Projection& projection, std::span<const glm::dvec3> polygon);

// Sorts the instances that a view shows so that little is shaded and then hidden: nearer ones first, with the instances
// of one mesh together. Instances at equal distances keep their order.
std::vector<int> frontToBack(const View& view, std::span<const int> instances, const SceneState& state);

// An instance that a view sees only in part: some of its mesh's clusters.
struct PartialInstance {
  int instance = 0;                   // index into SceneState::instances
  RecycledVector<IndexRange> ranges;  // indices that are drawn; ascending and disjoint
};

// Finds the instance in an ascending list; null if the list does not have it.
const PartialInstance* partOf(const RecycledVector<PartialInstance>& partial, int instance);

IndexRange allOf(const Mesh& mesh);

// Says whether the view may see a part of the instance's bounding sphere and a part of its mesh's box, which reaches
// `halfExtent` from the centre.
bool boundsVisible(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent);

// Returns the index ranges of the clusters that the view may see: everything in one range unless leaving some out saves
// more than the extra draw calls cost, empty if the view sees nothing. No visible triangle is left out.
RecycledVector<IndexRange> visibleRanges(const View& view, const InstanceState& instance, const Mesh& mesh);
// Says whether the view sees only front faces of the mesh if that is solid: the view's eye is outside the mesh's box,
// and the box lies before the view's clip plane.
bool seesOnlyFronts(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent);
uint32_t indexCount(std::span<const IndexRange> ranges);

}  // namespace speculum
