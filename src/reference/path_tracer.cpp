#include "reference/path_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <numbers>

#include "geometry/affine.hpp"
#include "scene/material_mirrors.hpp"

namespace speculum {

namespace {

constexpr double pi = std::numbers::pi;

glm::dvec3 safeNormalize(const glm::dvec3& v) {
  return v / std::sqrt(std::max(glm::dot(v, v), 1e-200));
}

// Returns the radiance due to a light or its mirror image, at `toLight` from the point.
glm::dvec3 lightRadiance(const ShadingPoint& point, const glm::dvec3& toLight, const PointLight& light) {
  const glm::dvec3 l = safeNormalize(toLight);
  const double cosine = std::clamp(glm::dot(point.normal, l), 0.0, 1.0);
  const double lobe = std::clamp(glm::dot(point.normal, safeNormalize(l + point.toViewer)), 0.0, 1.0);
  const glm::dvec3 brdf =
      point.diffuse / pi + point.specular * ((point.shininess + 8.0) / (8.0 * pi) * std::pow(lobe, point.shininess));
  const double distance2 = std::max(glm::dot(toLight, toLight), light.radius * light.radius);
  return light.color * light.intensity * (cosine / distance2) * brdf;
}

// End of a ray to a light, as a share of its length: up to 1, rounding would decide whether the ray meets a surface on
// which the light lies.
constexpr double lightEnd = 1.0 - 1e-12;

// Returns the start of a ray to a light, as a share of its length: surfaces that coincide with the point's, moved by
// rounding, are not in the way. Points are relative to the eye.
double lightStart(const ShadingPoint& point, const glm::dvec3& toLight) {
  return 1e-9 * glm::length(point.position) / glm::length(toLight);
}

// Returns the share by which the mirror's map multiplies its reflectance at a position relative to the eye; 1 without a
// map.
glm::dvec3 mapShare(const Scene& scene, const Mirror& mirror, const MirrorState& state, const glm::dvec3& position) {
  if (mirror.map < 0) {
    return glm::dvec3(1.0);
  }
  const Texture& map = scene.textures[mirror.map];
  const MirrorBox box = boxOf(state, state.polygon);
  const glm::dvec2 uv = (state.local(position) - box.low) / box.size;
  const glm::dvec2 edge = 0.5 / glm::dvec2(map.width, map.height);  // the outermost texels reach to the border
  return textureAt(map, glm::clamp(uv, edge, 1.0 - edge), false);
}

// Returns the radiance due to a light by way of one mirror: along the straight line from the point to the light's image
// behind the mirror.
glm::dvec3 bouncedLight(const TraceWorld& world, const ShadingPoint& point, int light, int mirror) {
  const Mirror& material = world.scene().mirror(mirror);
  const MirrorState& plane = world.mirrors()[mirror];
  const PointLight& source = world.scene().lights[light];
  const glm::dvec3& position = world.lights()[light].position;
  const double pointSide = glm::dot(plane.normal, point.position - plane.origin);
  const double lightSide = glm::dot(plane.normal, position - plane.origin);
  const bool sameSide = pointSide > 0.0 ? lightSide > 0.0 : material.twoSided && pointSide < 0.0 && lightSide < 0.0;
  if (!sameSide || (point.self.mirror >= 0 && world.mirrors()[point.self.mirror].plane == plane.plane)) {
    return glm::dvec3(0.0);
  }
  const glm::dvec3 toImage = position - 2.0 * lightSide * plane.normal - point.position;
  const Ray leg{point.position, toImage, 0.0, 1.0};
  const auto crossing = world.meetMirror(leg, mirror);
  if (!crossing || glm::dot(point.normal, toImage) <= 0.0) {
    return glm::dvec3(0.0);
  }
  double passes = 1.0;  // share of the light
  if (source.castsShadow) {
    Skip first = point.self;
    first.secondMirror = mirror;
    const glm::dvec3 bounce = leg.at(*crossing);
    const Skip second{.mirror = mirror};
    passes = world.transmittance({point.position, toImage, lightStart(point, toImage), *crossing}, first, false);
    passes *= passes > 0.0 ? world.transmittance({bounce, position - bounce, 0.0, lightEnd}, second, true) : 0.0;
  }
  const double cosine = std::abs(glm::dot(plane.normal, safeNormalize(toImage)));
  return passes * mapShare(world.scene(), material, plane, leg.at(*crossing)) *
         opticsOf(material).reflectanceAt(cosine) * lightRadiance(point, toImage, source);
}

glm::dvec3 directLight(const TraceWorld& world, const ShadingPoint& point, int light) {
  const PointLight& source = world.scene().lights[light];
  const glm::dvec3 toLight = world.lights()[light].position - point.position;
  const Ray ray{point.position, toLight, lightStart(point, toLight), lightEnd};
  if (glm::dot(point.normal, toLight) <= 0.0) {
    return glm::dvec3(0.0);
  }
  return (source.castsShadow ? world.transmittance(ray, point.self, true) : 1.0) *
         lightRadiance(point, toLight, source);
}

void applyMaterial(const Scene& scene, const Object& object, const Material& material, const glm::dvec2& uv,
                   ShadingPoint& point) {
  point.diffuse = object.color.value_or(material.diffuse);
  if (material.diffuseTexture >= 0) {
    point.diffuse *= glm::dvec3(textureAt(scene.textures[material.diffuseTexture], uv, material.clamps));
  }
  point.specular = object.specular.value_or(material.specular);
  point.shininess = std::max(1.0, object.shininess.value_or(material.shininess));
  point.emission = object.emission.value_or(material.emission);
}

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

// Returns the mirror's front normal at a world position relative to the eye: the normal of its plane or, with ripples,
// of the height field, which is the same from both sides.
glm::dvec3 mirrorNormal(const Mirror& mirror, const MirrorState& state, const glm::dvec3& position, double time) {
  if (!mirror.ripple || mirror.ripple->amplitude == 0.0) {
    return state.normal;
  }
  const double k = 2.0 * pi / mirror.ripple->wavelength;
  const double slope = mirror.ripple->amplitude * k;
  const double shift = productModulo(mirror.ripple->speed, time, mirror.ripple->wavelength);
  const glm::dvec2 at = state.local(position);
  const glm::dvec3 first = slope * std::cos(k * (at.x + shift)) * state.axisX;
  const glm::dvec3 second =
      slope * std::cos(k * (0.6 * at.x + 0.8 * at.y - shift)) * (0.6 * state.axisX + 0.8 * state.axisY);
  return glm::normalize(state.normal - first - second);
}

// Returns the point at which `ray` met an object. The shading normal is negated when the triangle's geometric normal,
// by the winding in the model file, faces away from the viewer.
ShadingPoint objectPoint(const TraceWorld& world, const Ray& ray, const SceneHit& hit) {
  const InstanceState& instance = world.instances()[hit.index];
  const Mesh& mesh = world.scene().meshes[instance.mesh];
  const uint32_t* index = &mesh.indices[size_t{hit.triangle} * 3];
  const Vertex& a = mesh.vertices[index[0]];
  const Vertex& b = mesh.vertices[index[1]];
  const Vertex& c = mesh.vertices[index[2]];
  const glm::dvec3& w = hit.weights;
  const glm::dmat3& normalFromMesh = world.normalFromMesh(hit.index);

  ShadingPoint point;
  point.position = instance.worldFromMesh.point(w.x * a.position + w.y * b.position + w.z * c.position);
  point.toViewer = safeNormalize(-ray.direction);
  const glm::dvec3 geometric = normalFromMesh * glm::cross(b.position - a.position, c.position - a.position);
  const auto [normalA, normalB, normalC] = cornerNormals(mesh, index);
  const glm::dvec3 shading = safeNormalize(normalFromMesh * (w.x * normalA + w.y * normalB + w.z * normalC));
  const double side = glm::dot(geometric, point.toViewer) < 0.0 ? -1.0 : 1.0;
  point.normal = side * shading;
  point.facet = side * safeNormalize(geometric);
  point.self = {.instance = hit.index, .triangle = hit.triangle};
  static const Material defaultMaterial;
  const Material& material = mesh.parts.empty() ? defaultMaterial : mesh.parts[world.partOf(hit)].material;
  applyMaterial(world.scene(), world.scene().objects[instance.object], material, w.x * a.uv + w.y * b.uv + w.z * c.uv,
                point);
  if (!mesh.colors.empty()) {
    point.diffuse *= w.x * glm::dvec3(mesh.colors[index[0]]) + w.y * glm::dvec3(mesh.colors[index[1]]) +
                     w.z * glm::dvec3(mesh.colors[index[2]]);
  }
  return point;
}

// Returns the sum of emission, ambient light, and Phong-Blinn from every light and its images in mirrors that cast
// light, with shadows.
glm::dvec3 surfaceRadiance(const TraceWorld& world, const ShadingPoint& point) {
  const Scene& scene = world.scene();
  glm::dvec3 radiance = point.emission + scene.environment.ambient * point.diffuse;
  if (point.diffuse == glm::dvec3(0.0) && point.specular == glm::dvec3(0.0)) {
    return radiance;
  }
  for (size_t light = 0; light < scene.lights.size(); ++light) {
    radiance += directLight(world, point, static_cast<int>(light));
    for (size_t mirror = 0; mirror < scene.mirrorCount(); ++mirror) {
      if (scene.mirror(mirror).castsLight) {
        radiance += bouncedLight(world, point, static_cast<int>(light), static_cast<int>(mirror));
      }
    }
  }
  return radiance;
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
    ++chain.count;
  }
  return chain;
}

}  // namespace speculum
