#include "geometry/triangle_mesh.hpp"

#include <algorithm>
#include <array>

namespace speculum {

namespace {

int largestAxis(const glm::dvec3& d) {
  const glm::dvec3 a = glm::abs(d);
  return a.x >= a.y ? (a.x >= a.z ? 0 : 2) : (a.y >= a.z ? 1 : 2);
}

}  // namespace

ShearedRay::ShearedRay(const Ray& ray) {
  kz_ = largestAxis(ray.direction);
  kx_ = (kz_ + 1) % 3;
  ky_ = (kz_ + 2) % 3;
  const glm::dvec3& d = ray.direction;
  origin_ = {ray.origin[kx_], ray.origin[ky_], ray.origin[kz_]};
  shear_ = {d[kx_] / d[kz_], d[ky_] / d[kz_], 1.0 / d[kz_]};
}

std::vector<Bounds> triangleBounds(const Mesh& mesh) {
  std::vector<Bounds> boxes(mesh.indices.size() / 3);
  for (size_t i = 0; i < 3 * boxes.size(); ++i) {
    boxes[i / 3].add(mesh.vertices[mesh.indices[i]].position);
  }
  return boxes;
}

std::vector<uint32_t> partsOfTriangles(const Mesh& mesh) {
  std::vector<uint32_t> parts(mesh.indices.size() / 3);
  for (size_t p = 0; p < mesh.parts.size(); ++p) {
    const MeshPart& part = mesh.parts[p];
    std::fill_n(parts.begin() + part.firstIndex / 3, part.indexCount / 3, static_cast<uint32_t>(p));
  }
  return parts;
}

TriangleMesh::TriangleMesh(const Mesh& mesh) : bvh_(triangleBounds(mesh)), parts_(partsOfTriangles(mesh)) {
  triangles_.reserve(parts_.size());
  places_.resize(parts_.size());
  for (const uint32_t i : bvh_.order()) {
    places_[i] = static_cast<uint32_t>(triangles_.size());
    const uint32_t* v = &mesh.indices[size_t{i} * 3];
    triangles_.push_back({mesh.vertices[v[0]].position, mesh.vertices[v[1]].position, mesh.vertices[v[2]].position, i});
  }
}

std::optional<TriangleHit> TriangleMesh::intersect(const ShearedRay& ray, const Triangle& triangle, double tMin,
                                                   double tMax) {
  const glm::dvec3 a = ray.project(triangle.a);
  const glm::dvec3 b = ray.project(triangle.b);
  const glm::dvec3 c = ray.project(triangle.c);
  const double u = c.x * b.y - c.y * b.x;
  const double v = a.x * c.y - a.y * c.x;
  const double w = b.x * a.y - b.y * a.x;
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) {
    return std::nullopt;
  }
  const double area = u + v + w;
  if (area == 0.0) {
    return std::nullopt;
  }
  const double inverse = 1.0 / area;
  const double t = (u * a.z + v * b.z + w * c.z) * inverse;
  if (!(t > tMin && t < tMax)) {
    return std::nullopt;
  }
  return TriangleHit{triangle.index, t, glm::dvec3(u, v, w) * inverse};
}

// Also skips triangles with the same corners: models that list each face twice, once for each side, have two triangles
// at the point that a ray leaves.
bool TriangleMesh::isSkipped(const Triangle& triangle, int64_t skip) const {
  if (skip == noTriangle || triangle.index == skip) {
    return triangle.index == skip;
  }
  const Triangle& own = triangles_[places_[static_cast<size_t>(skip)]];
  const std::array corners{triangle.a, triangle.b, triangle.c};
  return std::ranges::is_permutation(corners, std::array{own.a, own.b, own.c});
}

std::optional<TriangleHit> TriangleMesh::closest(const Ray& ray, int64_t skip) const {
  const ShearedRay sheared(ray);
  std::optional<TriangleHit> best;
  bvh_.traverse(ray, [&](uint32_t first, uint32_t count, double& tMax) {
    for (uint32_t i = first; i < first + count; ++i) {
      const auto hit = intersect(sheared, triangles_[i], ray.tMin, tMax);
      if (hit && !isSkipped(triangles_[i], skip)) {
        best = hit;
        tMax = hit->t;
      }
    }
    return false;
  });
  return best;
}

void TriangleMesh::visit(const Ray& ray, int64_t skip, const std::function<bool(const TriangleHit&)>& meet) const {
  const ShearedRay sheared(ray);
  bool ends = false;
  bvh_.traverse(ray, [&](uint32_t first, uint32_t count, double& tMax) {
    for (uint32_t i = first; i < first + count && !ends; ++i) {
      const auto hit = intersect(sheared, triangles_[i], ray.tMin, tMax);
      ends = hit && !isSkipped(triangles_[i], skip) && meet(*hit);
    }
    return ends;
  });
}

}  // namespace speculum
