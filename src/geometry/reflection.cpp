#include "geometry/reflection.hpp"

namespace speculum {

glm::dmat3 reflectionLinear(const glm::dvec3& normal) {
  return glm::dmat3(1.0) - (2.0 / glm::dot(normal, normal)) * glm::outerProduct(normal, normal);
}

glm::dvec3 reflectPoint(const glm::dvec3& p, const Plane& plane) {
  return p - (2.0 * plane.distance(p) / glm::dot(plane.normal, plane.normal)) * plane.normal;
}

}  // namespace speculum
