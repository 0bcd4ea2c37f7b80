#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <vector>

#include "geometry/bvh.hpp"
#include "geometry/mesh.hpp"

namespace speculum {

// A ray prepared for watertight intersection: space is sheared so that the ray runs along an axis, and edges are tested
// in two dimensions. Neighbouring triangles evaluate a shared edge with the same numbers, so no ray passes between
// them. Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection" (2013), in double.
class ShearedRay {
 public:
  explicit ShearedRay(const Ray& ray);

  // Returns the point's coordinates across the ray in x and y, and the ray's parameter t in z.
  glm::dvec3 project(const glm::dvec3& point) const {
    const double* p = glm::value_ptr(point);
    const double along = p[kz_] - origin_.z;
    return {p[kx_] - origin_.x - shear_.x * along, p[ky_] - origin_.y - shear_.y * along, shear_.z * along};
  }

 private:
  glm::dvec3 origin_;  // components in the order kx, ky, kz
  glm::dvec3 shear_;
  int kx_, ky_, kz_;
};

std::vector<Bounds> triangleBounds(const Mesh& mesh);      // relative to Mesh::center
std::vector<uint32_t> partsOfTriangles(const Mesh& mesh);  // index into Mesh::parts, by triangle

struct TriangleHit {
  uint32_t triangle = 0;  // three indices from Mesh::indices[3 * triangle] on
  double t = 0.0;
  glm::dvec3 weights{0.0};  // barycentric, of the three vertices
};

// The triangles of a mesh under a BVH, in model space relative to Mesh::center. Both sides of a triangle are hit.
class TriangleMesh {
 public:
  static constexpr int64_t noTriangle = -1;

  TriangleMesh() = default;
  explicit TriangleMesh(const Mesh& mesh);

  Bounds bounds() const { return bvh_.bounds(); }
  // Returns the nearest hit with ray.tMin < t < ray.tMax on any triangle but `skip` and those with the same corners.
  std::optional<TriangleHit> closest(const Ray& ray, int64_t skip = noTriangle) const;
  // Calls `meet` with all hits that closest() chooses from, in any order, until it returns true.
  void visit(const Ray& ray, int64_t skip, const std::function<bool(const TriangleHit&)>& meet) const;
  uint32_t partOf(uint32_t triangle) const { return parts_[triangle]; }

 private:
  struct Triangle {
    glm::dvec3 a, b, c;
    uint32_t index;
  };
  static std::optional<TriangleHit> intersect(const ShearedRay& ray, const Triangle& triangle, double tMin,
                                              double tMax);
  bool isSkipped(const Triangle& triangle, int64_t skip) const;

  Bvh bvh_;
  std::vector<Triangle> triangles_;  // in the BVH's order
  std::vector<uint32_t> places_;     // index into triangles_, by triangle
  std::vector<uint32_t> parts_;      // by triangle, index into Mesh::parts
};

}  // namespace speculum
