#pragma once

#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "geometry/bvh.hpp"
#include "geometry/triangle_mesh.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

enum class HitKind { object, mirror, glyph };

struct SceneHit {
  HitKind kind = HitKind::object;
  int index = 0;             // into SceneState::instances, mirrors or lights
  uint32_t triangle = 0;     // objects: three indices from Mesh::indices[3 * triangle] on
  double t = 0.0;            // in lengths of the ray's direction
  glm::dvec3 weights{0.0};   // objects: barycentric
  bool mirrorFront = false;  // mirrors: the ray comes from the front side
};

// Surfaces that a ray ignores: the surface that the ray starts on, and the mirror that reflected it, with all mirrors
// of the same plane.
struct Skip {
  int instance = -1;
  uint32_t triangle = 0;
  int mirror = -1;
  int secondMirror = -1;
  int passed = std::numeric_limits<int>::max();  // instance seen through at Ray::tMin, where later ones are still met
};

// Everything that a ray can meet at one time: a BVH over instances, mirrors and glyphs. Instances are intersected in
// their mesh's space. Positions, also of rays, are relative to the camera's eye in the state, because differences of
// world coordinates are exact where coordinates far from the world's origin are not.
class TraceWorld {
 public:
  // Keeps a reference to the scene and builds the BVHs of its meshes.
  explicit TraceWorld(const Scene& scene);
  // Takes the nodes from `state`, relative to its camera's eye, and builds the BVH over them.
  void place(const SceneState& state);

  // Returns the first surface or glyph on the ray that the onlooker sees.
  std::optional<SceneHit> closest(const Ray& ray, const Skip& skip, Onlooker onlooker = Onlooker::eye) const;
  // Returns the share of light that passes the objects and mirrors, from either side, on the ray. Glyphs cast no
  // shadow. No triangle hides a light, at t = 1, that lies in the triangle's plane.
  double transmittance(const Ray& ray, const Skip& skip, bool endsAtLight) const;
  // Returns the share of the surface that is there at a point of an object, 0 .. 1: the material's coverage. Curved
  // mirrors are there wholly.
  double coverageOf(const SceneHit& objectHit) const;
  // Returns the parameter t in (tMin, tMax) at which the ray meets a mirror's polygon; nothing if it does not.
  std::optional<double> meetMirror(const Ray& ray, int mirror) const;

  const Scene& scene() const { return *scene_; }
  // Nodes of the state placed last, relative to its camera's eye.
  const std::vector<InstanceState>& instances() const { return instances_; }
  const std::vector<MirrorState>& mirrors() const { return mirrors_; }
  const std::vector<LightState>& lights() const { return lights_; }
  const glm::dmat3& normalFromMesh(int instance) const { return placements_[instance].normalFromMesh; }
  // Returns the index into Mesh::parts of the part that was hit.
  uint32_t partOf(const SceneHit& objectHit) const;

 private:
  struct Item {
    HitKind kind;
    int index;
  };
  struct Placement {
    glm::dmat3 meshFromWorld;  // linear part
    glm::dmat3 normalFromMesh;
  };
  Bounds boundsOf(const Item& item) const;
  Visibility visibilityOf(const Item& item) const;
  bool skipsMirror(const Skip& skip, int mirror) const;
  // Says whether `hit` comes before `other` at the same distance: by layer for mirrors, by index for instances.
  bool covers(const SceneHit& hit, const SceneHit& other) const;
  Ray toMesh(const Ray& ray, int instance, double tMax) const;
  std::optional<SceneHit> meet(const Item& item, const Ray& ray, const ShearedRay& sheared, double tMax,
                               const Skip& skip) const;
  std::optional<double> meetPolygon(const Ray& ray, const ShearedRay& sheared, int mirror, double tMax) const;
  std::optional<double> meetGlyph(const Ray& ray, int light, double tMax) const;

  // Says whether a point lies in the plane of the triangle that was hit, as far as the rounding of world coordinates
  // tells.
  bool liesInPlane(const glm::dvec3& point, const SceneHit& objectHit) const;

  const Scene* scene_;
  glm::dvec3 eye_{0.0};               // in the world; points are relative to it
  std::vector<TriangleMesh> meshes_;  // parallel to Scene::meshes
  std::vector<bool> transparent_;     // by mesh: some material is
  std::vector<InstanceState> instances_;
  std::vector<Placement> placements_;
  std::vector<MirrorState> mirrors_;
  std::vector<LightState> lights_;
  Bvh bvh_;
  std::vector<Item> items_;  // in the BVH's order
};

}  // namespace speculum
