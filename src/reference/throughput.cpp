#include "reference/throughput.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "geometry/triangle_mesh.hpp"

namespace speculum {

namespace {

// Returns the processor time of this thread, which other load does not change.
double threadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Mesh bumpySphere(int64_t triangles) {
  const auto rings = static_cast<uint32_t>(std::max(4.0, std::sqrt(static_cast<double>(triangles) / 4.0)));
  const uint32_t columns = 2 * rings;
  Mesh mesh;
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t j = 0; j <= columns; ++j) {
      const double theta = std::numbers::pi * i / rings;
      const double phi = 2.0 * std::numbers::pi * j / columns;
      const glm::dvec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      const double bump = 1.0 + 0.2 * std::sin(7.0 * n.x) * std::sin(5.0 * n.y) + 0.1 * std::sin(11.0 * n.z);
      mesh.vertices.push_back({bump * n, n, glm::dvec2(0.0)});
    }
  }
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t j = 0; j < columns; ++j) {
      const uint32_t a = i * (columns + 1) + j;
      const uint32_t b = a + columns + 1;
      mesh.indices.insert(mesh.indices.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  mesh.parts = {{0, static_cast<uint32_t>(mesh.indices.size()), {}}};
  return mesh;
}

std::vector<Ray> randomRays(int64_t count) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const auto direction = [&] { return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))); };
  std::vector<Ray> rays(static_cast<size_t>(count));
  for (Ray& ray : rays) {
    ray.origin = 3.0 * direction();
    ray.direction = direction() - ray.origin;
  }
  return rays;
}

}  // namespace

RayThroughput measureRayThroughput(int64_t triangles, int64_t rays) {
  const Mesh mesh = bumpySphere(triangles);
  const std::vector<Ray> queries = randomRays(rays);
  RayThroughput result{.triangles = static_cast<int64_t>(mesh.indices.size()) / 3, .rays = rays};
  const double buildStart = threadSeconds();
  const TriangleMesh tree(mesh);
  result.buildSeconds = threadSeconds() - buildStart;
  int64_t hits = 0;
  const double start = threadSeconds();
  for (const Ray& ray : queries) {
    hits += tree.closest(ray).has_value();
  }
  result.seconds = threadSeconds() - start;
  result.hitFraction = static_cast<double>(hits) / static_cast<double>(rays);
  return result;
}

}  // namespace speculum
