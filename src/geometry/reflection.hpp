#pragma once

#include <glm/glm.hpp>

#include "geometry/polygon.hpp"

namespace speculum {

// Householder reflection I - 2 n n^T / (n.n): the linear part of the reflection about any plane with normal n. The
// division makes it exact for normals that are not of unit length.
glm::dmat3 reflectionLinear(const glm::dvec3& normal);

// The point's mirror image: p - 2 (n.(p - q)) n / (n.n) for a plane through q.
glm::dvec3 reflectPoint(const glm::dvec3& p, const Plane& plane);

}  // namespace speculum
