#include "reference/scenes.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/polygon.hpp"

namespace speculum::testing {

namespace {

void finish(Mesh& mesh, const Material& material) {
  mesh.parts = {{0, static_cast<uint32_t>(mesh.indices.size()), material}};
  for (const Vertex& v : mesh.vertices) {
    mesh.halfExtent = glm::max(mesh.halfExtent, glm::abs(v.position));
    mesh.radius = std::max(mesh.radius, glm::length(v.position));
  }
}

}  // namespace

Mesh polygonMesh(const std::vector<glm::dvec3>& corners, const Material& material) {
  Mesh mesh;
  const glm::dvec3 normal = glm::normalize(newellVector(corners));
  for (const glm::dvec3& p : corners) {
    mesh.vertices.push_back({p, normal, {p.x, p.y}});
  }
  for (uint32_t i = 1; i + 1 < corners.size(); ++i) {
    mesh.indices.insert(mesh.indices.end(), {0, i, i + 1});
  }
  finish(mesh, material);
  return mesh;
}

Mesh sphereMesh(int rings, const Material& material) {
  Mesh mesh;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double theta = std::numbers::pi * i / rings;
      const double phi = 2.0 * std::numbers::pi * (j % columns) / columns;
      // The poles are single points, or the mesh would not be closed.
      const double sine = i == 0 || i == rings ? 0.0 : std::sin(theta);
      const glm::dvec3 p(sine * std::sin(phi), std::cos(theta), sine * std::cos(phi));
      mesh.vertices.push_back({p, p, {static_cast<double>(j) / columns, 1.0 - static_cast<double>(i) / rings}});
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < columns; ++j) {
      const auto a = static_cast<uint32_t>(i * (columns + 1) + j);
      const auto b = static_cast<uint32_t>(a + columns + 1);
      if (i + 1 < rings) {
        mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
      }
      if (i > 0) {
        mesh.indices.insert(mesh.indices.end(), {a, b + 1, a + 1});
      }
    }
  }
  finish(mesh, material);
  return mesh;
}

Mesh bumpyMesh(int rings, unsigned seed) {
  Mesh mesh = sphereMesh(rings);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> frequency(2.0, 9.0);
  const glm::dvec3 f(frequency(random), frequency(random), frequency(random));
  for (Vertex& v : mesh.vertices) {
    const glm::dvec3 s = glm::sin(f * v.position);
    v.position = glm::dvec3(glm::vec3(v.position * (1.0 + 0.3 * s.x * s.y + 0.1 * s.z)));
  }
  return mesh;
}

int addObject(Scene& scene, Mesh mesh, const glm::dvec3& position) {
  scene.meshes.push_back(std::move(mesh));
  scene.objects.push_back({.mesh = static_cast<int>(scene.meshes.size()) - 1, .position = position});
  return static_cast<int>(scene.objects.size()) - 1;
}

Mirror mirrorOf(const std::vector<glm::dvec3>& polygon, double reflectance) {
  return {.polygon = polygon, .reflectance = glm::dvec3(reflectance)};
}

CameraSpec cameraAt(const glm::dvec3& eye, const glm::dvec3& target, double fov) {
  return {.position = eye, .target = target, .verticalFov = fov};
}

}  // namespace speculum::testing
