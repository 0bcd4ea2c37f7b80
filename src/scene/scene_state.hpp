#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "geometry/affine.hpp"
#include "scene/scene.hpp"

namespace speculum {

// The camera at one time, in world space. The types below hold everything that moves, evaluated at one time in double
// precision. Planner, renderer and reference tracer all read them, so that their positions are the same.

struct CameraPose {
  glm::dvec3 eye{0.0};
  glm::dmat3 worldToView{1.0};  // rows: right, up, back (right-handed, looking down -z)
  double verticalFov = 1.0;     // radians
  double near = 0.001;          // metres

  bool operator==(const CameraPose&) const = default;
};

// Length below which a vector has no direction: squares of products with shorter vectors leave the range of doubles.
inline constexpr double shortestLength = 1e-30;
inline bool hasDirection(const glm::dvec3& v) {
  return glm::length(v) >= shortestLength;
}

// Throws std::invalid_argument when eye and target coincide or `up` is parallel to the view direction.
CameraPose lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up, double verticalFovDegrees,
                  double near);

// Returns the degrees that `spin` (degrees per second) has added to a rotation after `time` seconds. Each angle is
// reduced modulo 360 before anything is added to it, so that a long run loses no precision to a large sum.
glm::dvec3 spunBy(const glm::dvec3& spin, double time);

// Returns the linear transform from the object's model to the world: `up`, then scale, then rotation and spin.
glm::dmat3 modelTransform(const Object& object, double time);

struct InstanceState {
  int object = 0;  // index into Scene::objects
  int copy = 0;
  int mesh = 0;            // index into Scene::meshes
  Affine worldFromMesh;    // takes Vertex::position (already relative to Mesh::center) to world
  glm::dvec3 center{0.0};  // world; of the bounding sphere
  double radius = 0.0;     // metres
};

// A light at one time. A light within MirrorState::slack of the planes of mirrors is moved in front of the first mirror
// of each plane, if it casts shadows or any mirror casts light.
struct LightState {
  glm::dvec3 position{0.0};  // world
};

struct MirrorState {
  std::vector<glm::dvec3> polygon;  // world, counter-clockwise seen from the front
  // Convex pieces of the mirror, if it is not convex; `polygon` is their hull then.
  std::vector<std::vector<glm::dvec3>> pieces;
  int firstPiece = 0;                // number of the pieces of all mirrors before this one
  glm::dvec3 origin{0.0};            // local (0, 0): the centre, or a polygon's first vertex
  glm::dvec3 normal{0.0, 0.0, 1.0};  // world, unit, to the front
  glm::dvec3 axisX{1.0, 0.0, 0.0};   // world, unit; for ripples
  glm::dvec3 axisY{0.0, 1.0, 0.0};
  double slack = 0.0;  // metres; how far rounding can move points of the mirror's plane off it
  int plane = 0;       // index of the first mirror in the same plane, which may be this one
  // Where mirrors of one plane overlap, a side that reflects covers a back; otherwise the mirror listed first covers. A
  // layer is 0, or one more than the largest layer of the mirrors that cover this one.
  int frontLayer = 0;  // seen from the mirror's front
  int backLayer = 0;

  // The convex polygons that make up the mirror, and their number.
  size_t pieceCount() const { return pieces.empty() ? 1 : pieces.size(); }
  const std::vector<glm::dvec3>& piece(size_t i) const { return pieces.empty() ? polygon : pieces[i]; }
  // Returns a point's coordinates along the axes X and Y, metres from the origin.
  glm::dvec2 local(const glm::dvec3& p) const { return {glm::dot(p - origin, axisX), glm::dot(p - origin, axisY)}; }
  glm::dvec3 at(const glm::dvec2& local) const { return origin + local.x * axisX + local.y * axisY; }
};

// Returns the box around points of the mirror in its local coordinates. A reflectance map covers that of its polygon.
struct MirrorBox {
  glm::dvec2 low;
  glm::dvec2 size;
};
MirrorBox boxOf(const MirrorState& mirror, std::span<const glm::dvec3> points);
// Returns the point nearest to the eye of the box around the mirror's polygon, in local coordinates. Floats of
// positions relative to this point are exact near the eye, however large the mirror is.
glm::dvec2 localNear(const MirrorState& mirror, const glm::dvec3& eye);

struct SceneState {
  double time = 0.0;  // seconds
  CameraPose camera;
  // Sorted by mesh, then object, then copy. An object whose materials make mirrors has an instance of each of its
  // parts.
  std::vector<InstanceState> instances;
  std::vector<LightState> lights;    // parallel to Scene::lights
  std::vector<MirrorState> mirrors;  // by the index of Scene::mirror()
};

// Places the scene's nodes at a time. Angles are reduced in double, so that 1e6 s of animation are as exact as one
// second.
SceneState evaluate(const Scene& scene, double timeSeconds);

// Returns a camera at the bookmark that does not move.
CameraSpec cameraOf(const Bookmark& bookmark, const CameraSpec& camera);

// Says whether the place of an object, a mirror or a light depends on the time.
bool spins(const Object& object);
bool spins(const Mirror& mirror);
bool orbits(const PointLight& light);

// Says whether any object, light or mirror depends on the time, also by ripples.
bool contentMoves(const Scene& scene);
// Returns the time at which objects, lights and mirrors are; nothing if none depends on it.
inline std::optional<double> contentTime(const Scene& scene, double timeSeconds) {
  return contentMoves(scene) ? std::optional(timeSeconds) : std::nullopt;
}

// Says whether the camera, or any object, light or mirror, depends on the time.
bool moves(const Scene& scene);

// Returns the point beside a light that is farther from planes of mirrors than rounding can move it, so that light is
// hidden on one side of a mirror only. A light within MirrorState::slack of a plane comes in front of the plane's first
// mirror. With `eye` (world), the point is for shaders, whose positions are floats relative to that eye.
glm::dvec3 besideMirrors(const glm::dvec3& light, std::span<const MirrorState> mirrors,
                         const std::optional<glm::dvec3>& eye = {});
// Returns the distance, in metres, from the nearest plane of a mirror, at most 1e30.
double heightOverMirrors(const glm::dvec3& point, std::span<const MirrorState> mirrors);

}  // namespace speculum
