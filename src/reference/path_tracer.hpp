#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "reference/ray_tracer.hpp"
#include "scene/trace_world.hpp"

namespace speculum {

// A point of a surface with everything that its radiance depends on. Positions are relative to the eye of the world's
// state.
struct ShadingPoint {
  glm::dvec3 position{0.0};
  glm::dvec3 normal{0.0};    // unit, on the viewer's side; zero if the model's normals cancel
  glm::dvec3 toViewer{0.0};  // unit
  glm::dvec3 facet{0.0};     // unit normal of the triangle itself, on the viewer's side; zero for mirrors
  glm::dvec3 diffuse{0.0};   // with texture and vertex colors applied
  glm::dvec3 specular{0.0};
  glm::dvec3 emission{0.0};
  double shininess = 1.0;
  Skip self;
};

// Samples of the unit square for microfacets. For the first rough bounce of a path (level 0) they come from an additive
// recurrence with the plastic number (Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018),
// shifted per pixel; for later rough bounces they come from a hash, so that levels are independent of each other.
class MicrofacetSampler {
 public:
  MicrofacetSampler(uint32_t x, uint32_t y);
  glm::dvec2 next(int level);

 private:
  uint64_t state_;
  glm::dvec2 shift_;
  uint64_t drawn_ = 0;
};

// Consecutive reflecting sides along a ray, including the one that maxDepth cuts off.
struct MirrorChain {
  int count = 0;            // at most 255
  bool background = false;  // the ray meets nothing at all
};

// Follows one pixel's rays through the mirrors of a world. Positions are relative to the eye of the world's state.
class PathTracer {
 public:
  PathTracer(const TraceWorld& world, const Environment& environment, const TraceOptions& options, double time,
             MicrofacetSampler sampler)
      : world_(world), environment_(environment), options_(options), time_(time), sampler_(sampler) {}

  // Returns the radiance along a ray with a direction of unit length.
  glm::dvec3 radiance(const Ray& ray) { return follow({ray, {}, 0, glm::dvec3(1.0), 0}); }

  // Follows the mirrors along a ray; rough mirrors count as smooth.
  MirrorChain followMirrors(Ray ray) const;

 private:
  struct Path {
    Ray ray;
    Skip skip;
    int depth;              // depth of the next mirror
    glm::dvec3 throughput;  // product of the bounces so far
    int roughLevel;         // rough bounces so far
  };
  // One point of the reflecting side of a flat or curved mirror.
  struct Bounce {
    ShadingPoint base;       // surface under the reflection; its normal includes ripples
    glm::dvec3 planeNormal;  // unit, on the viewer's side; of a curved mirror the normal of the triangle
    glm::dvec3 reflectance;
    double alpha;  // width of the GGX distribution; 0: smooth
    double t;
  };
  bool reflects(const SceneHit& hit) const;
  Bounce bounceAt(const Ray& ray, const SceneHit& hit) const;
  glm::dvec3 follow(Path path);
  Bounce mirrorBounce(const Ray& ray, const SceneHit& hit) const;
  Bounce curvedBounce(const Ray& ray, const SceneHit& hit) const;
  glm::dvec3 backSide(const Ray& ray, const SceneHit& hit) const;
  glm::dvec3 roughReflection(const Path& path, const Bounce& bounce);
  Path reflected(const Path& path, const Bounce& bounce, const glm::dvec3& normal) const;

  const TraceWorld& world_;
  const Environment& environment_;
  const TraceOptions& options_;
  double time_;
  MicrofacetSampler sampler_;
};

}  // namespace speculum
