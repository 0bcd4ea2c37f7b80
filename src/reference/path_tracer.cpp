#include "reference/path_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <numbers>

#include "scene/material_mirrors.hpp"

namespace speculum {

namespace {

uint64_t splitMix(uint64_t& state) {
  state += 0x9E3779B97F4A7C15ull;
  uint64_t z = state;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}

double unitInterval(uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1.0p-53;
}

// Returns the mirror image of a ray in the plane through `position` with unit `normal`. The image starts at the
// reflected eye and, because distances stay the same, reaches the mirror at the same t. A ray that would go below the
// mirror's own plane is turned back above it.
Ray reflectedRay(const Ray& ray, const glm::dvec3& position, const glm::dvec3& normal, const glm::dvec3& planeNormal,
                 double t) {
  const glm::dvec3 toEye = ray.origin - position;
  Ray reflected{position + toEye - 2.0 * glm::dot(toEye, normal) * normal,
                ray.direction - 2.0 * glm::dot(ray.direction, normal) * normal, t};
  const double outward = glm::dot(reflected.direction, planeNormal);
  if (outward < 0.0) {
    reflected.direction -= 2.0 * outward * planeNormal;
    reflected.origin = position - t * reflected.direction;
  }
  return reflected;
}

// Samples a normal about n with GGX density D(m)(n.m): Walter et al., "Microfacet Models for Refraction through Rough
// Surfaces" (2007), equations 35 and 36.
glm::dvec3 microfacet(const glm::dvec3& n, double alpha, const glm::dvec2& u) {
  const double cosine2 = (1.0 - u.x) / (1.0 + (alpha * alpha - 1.0) * u.x);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine2));
  const double angle = 2.0 * std::numbers::pi * u.y;
  const glm::dvec3 helper = std::abs(n.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(helper, n));
  const glm::dvec3 y = glm::cross(n, x);
  return sine * std::cos(angle) * x + sine * std::sin(angle) * y + std::sqrt(cosine2) * n;
}

}  // namespace

MicrofacetSampler::MicrofacetSampler(uint32_t x, uint32_t y) : state_((uint64_t{y} << 32) | x) {
  shift_.x = unitInterval(splitMix(state_));
  shift_.y = unitInterval(splitMix(state_));
}

glm::dvec2 MicrofacetSampler::next(int level) {
  if (level > 0) {
    const double a = unitInterval(splitMix(state_));
    return {a, unitInterval(splitMix(state_))};
  }
  constexpr double plastic = 1.32471795724474602596;
  ++drawn_;
  return glm::fract(shift_ + static_cast<double>(drawn_) * glm::dvec2(1.0 / plastic, 1.0 / (plastic * plastic)));
}

bool PathTracer::reflects(const SceneHit& hit) const {
  if (hit.kind == HitKind::object) {
    return curvedMirrorOf(world_.scene(), world_.instances()[hit.index]).has_value();
  }
  return hit.kind == HitKind::mirror && (hit.mirrorFront || world_.scene().mirror(hit.index).twoSided);
}

PathTracer::Bounce PathTracer::mirrorBounce(const Ray& ray, const SceneHit& hit) const {
  const Mirror& mirror = world_.scene().mirror(hit.index);
  const MirrorOptics optics = opticsOf(mirror);
  const MirrorState& state = world_.mirrors()[hit.index];
  const double side = hit.mirrorFront ? 1.0 : -1.0;
  const glm::dvec3 position = ray.at(hit.t);
  const glm::dvec3 normal = side * mirrorNormal(mirror, state, position, time_);
  return {.base = {.position = position,
                   .normal = normal,
                   .toViewer = -ray.direction,
                   .diffuse = optics.baseColor,
                   .self = {.mirror = hit.index}},
          .planeNormal = side * state.normal,
          .reflectance = mapShare(world_.scene(), mirror, state, position) *
                         optics.reflectanceAt(-glm::dot(normal, ray.direction)),
          .alpha = optics.alpha,
          .t = hit.t};
}

PathTracer::Bounce PathTracer::curvedBounce(const Ray& ray, const SceneHit& hit) const {
  const MirrorOptics optics = opticsOf(*curvedMirrorOf(world_.scene(), world_.instances()[hit.index]));
  const ShadingPoint point = objectPoint(world_, ray, hit);
  return {.base = {.position = point.position,
                   .normal = point.normal,
                   .toViewer = point.toViewer,
                   .diffuse = optics.baseColor,
                   .self = point.self},
          .planeNormal = point.facet,
          .reflectance = optics.reflectanceAt(glm::dot(point.normal, point.toViewer)),
          .alpha = optics.alpha,
          .t = hit.t};
}

PathTracer::Bounce PathTracer::bounceAt(const Ray& ray, const SceneHit& hit) const {
  return hit.kind == HitKind::object ? curvedBounce(ray, hit) : mirrorBounce(ray, hit);
}

glm::dvec3 PathTracer::backSide(const Ray& ray, const SceneHit& hit) const {
  return surfaceRadiance(world_, {.position = ray.at(hit.t),
                                  .normal = -world_.mirrors()[hit.index].normal,
                                  .toViewer = -ray.direction,
                                  .diffuse = world_.scene().mirror(hit.index).backColor,
                                  .self = {.mirror = hit.index}});
}

PathTracer::Path PathTracer::reflected(const Path& path, const Bounce& bounce, const glm::dvec3& normal) const {
  return {reflectedRay(path.ray, bounce.base.position, normal, bounce.planeNormal, bounce.t), bounce.base.self,
          path.depth + 1, path.throughput, path.roughLevel};
}

glm::dvec3 PathTracer::roughReflection(const Path& path, const Bounce& bounce) {
  const int level = path.roughLevel;
  const int wanted = level == 0 ? options_.roughSamples : level == 1 ? std::max(1, options_.roughSamples / 16) : 1;
  glm::dvec3 sum(0.0);
  int taken = 0;
  for (int drawn = 0; taken < wanted && drawn < 4 * wanted + 16; ++drawn) {
    const glm::dvec3 m = microfacet(bounce.base.normal, bounce.alpha, sampler_.next(level));
    const double facing = -glm::dot(m, path.ray.direction);
    const glm::dvec3 direction = path.ray.direction + 2.0 * facing * m;
    if (facing <= 0.0 || glm::dot(direction, bounce.planeNormal) <= 0.0) {
      continue;
    }
    ++taken;
    Path next = reflected(path, bounce, m);
    ++next.roughLevel;
    sum += follow(next);
  }
  return taken > 0 ? sum / static_cast<double>(taken) : follow(reflected(path, bounce, bounce.base.normal));
}

glm::dvec3 PathTracer::follow(Path path) {
  glm::dvec3 sum(0.0);
  glm::dvec3 weight(1.0);
  for (;;) {
    const auto hit = world_.closest(path.ray, path.skip, path.depth == 0 ? Onlooker::eye : Onlooker::mirror);
    if (!hit) {
      return sum + weight * environment_.radiance(glm::normalize(path.ray.direction));
    }
    if (hit->kind == HitKind::glyph) {
      const PointLight& light = world_.scene().lights[hit->index];
      return sum + weight * light.color * light.glow;
    }
    if (hit->kind == HitKind::mirror && !reflects(*hit)) {
      return sum + weight * backSide(path.ray, *hit);
    }
    if (!reflects(*hit)) {
      const double coverage = world_.coverageOf(*hit);
      if (coverage > 0.0) {
        sum += coverage * weight * surfaceRadiance(world_, objectPoint(world_, path.ray, *hit));
      }
      if (coverage == 1.0) {
        return sum;
      }
      weight *= 1.0 - coverage;
      path.ray.tMin = hit->t;  // what is behind
      path.skip.passed = hit->index;
      continue;
    }
    const Bounce bounce = bounceAt(path.ray, *hit);
    if (bounce.base.diffuse != glm::dvec3(0.0)) {
      sum += weight * (1.0 - bounce.reflectance) * surfaceRadiance(world_, bounce.base);
    }
    weight *= bounce.reflectance;
    path.throughput *= bounce.reflectance;
    const Path next = reflected(path, bounce, bounce.base.normal);
    const double throughput = glm::compMax(path.throughput);
    if (path.depth >= options_.maxDepth || throughput < options_.minThroughput || throughput == 0.0) {
      return sum + weight * environment_.radiance(glm::normalize(next.ray.direction));
    }
    if (bounce.alpha > 0.0) {
      return sum + weight * roughReflection(path, bounce);
    }
    path = next;
  }
}

MirrorChain PathTracer::followMirrors(Ray ray) const {
  MirrorChain chain;
  Skip skip;
  glm::dvec3 throughput(1.0);
  const int most = std::min(255, std::max(options_.maxDepth, 0) + 1);
  while (chain.count < most) {
    const auto hit = world_.closest(ray, skip, chain.count == 0 ? Onlooker::eye : Onlooker::mirror);
    chain.background = chain.background || (chain.count == 0 && !hit);
    if (!hit || !reflects(*hit)) {
      break;
    }
    const Bounce bounce = bounceAt(ray, *hit);
    ray = reflectedRay(ray, bounce.base.position, bounce.base.normal, bounce.planeNormal, bounce.t);
    skip = bounce.base.self;
    throughput *= bounce.reflectance;
    ++chain.count;
  }
  chain.throughput = (throughput.r + throughput.g + throughput.b) / 3.0;
  return chain;
}

}  // namespace speculum
