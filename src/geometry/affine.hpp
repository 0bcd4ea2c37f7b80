#pragma once

#include <glm/glm.hpp>

namespace speculum {

// Returns a b modulo m, within m / 2 of 0 and to the last digit however large the product is.
double productModulo(double a, double b, double m);

// x -> linear * x + translation, in double.
struct Affine {
  glm::dmat3 linear{1.0};
  glm::dvec3 translation{0.0};  // metres

  glm::dvec3 point(const glm::dvec3& p) const { return linear * p + translation; }
  glm::dvec3 vector(const glm::dvec3& v) const { return linear * v; }
};

double largestEntry(const glm::dmat3& m);  // by magnitude

// The matrix that carries normals: sign(det M) * cofactor(M / max|M|). Unlike the inverse transpose it exists for
// every scale from 1e-20 to 1e13 and keeps a surface's outside outside under negative scale. Not normalised.
glm::dmat3 normalMatrix(const glm::dmat3& linear);

// R = Ry Rx Rz for pitch (x), yaw (y), roll (z) in degrees; angles are reduced modulo 360 in double before use.
glm::dmat3 rotationFromDegrees(const glm::dvec3& pitchYawRoll);

// Rotation by `degrees` about `axis` (any length > 0), right-hand rule.
glm::dmat3 rotationAboutAxis(const glm::dvec3& axis, double degrees);

}  // namespace speculum
