#pragma once

#include <glm/glm.hpp>

#include "geometry/polygon.hpp"

namespace speculum {

// Householder reflection I - 2 n n^T / (n.n): the linear part of the reflection about any plane with normal n. The
// division makes it exact for normals that are not of unit length.
inline glm::dmat3 reflectionLinear(const glm::dvec3& normal) {
  return glm::dmat3(1.0) - (2.0 / glm::dot(normal, normal)) * glm::outerProduct(normal, normal);
}

// The point's mirror image: p - 2 (n.(p - q)) n / (n.n) for a plane through q.
inline glm::dvec3 reflectPoint(const glm::dvec3& p, const Plane& plane) {
  return p - (2.0 * plane.distance(p) / glm::dot(plane.normal, plane.normal)) * plane.normal;
}

}  // namespace speculum
