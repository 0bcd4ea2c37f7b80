#include "reference/shading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/affine.hpp"

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
    passes = world.transmittance({point.position, toImage, lightStart(point, toImage), *crossing}, first);
    passes *= passes > 0.0 ? world.transmittance({bounce, position - bounce, 0.0, lightEnd}, second) : 0.0;
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
  return (source.castsShadow ? world.transmittance(ray, point.self) : 1.0) * lightRadiance(point, toLight, source);
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

}  // namespace

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

}  // namespace speculum
