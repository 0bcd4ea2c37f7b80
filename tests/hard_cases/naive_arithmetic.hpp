#pragma once

#include <cmath>
#include <glm/glm.hpp>

// Arithmetic of naive methods, exempt from sanitizers: divisions by zero give infinity or NaN.
namespace speculum::hard_cases {

template <typename T>
__attribute__((no_sanitize("float-divide-by-zero"))) T quotient(T a, T b) {
  return a / b;
}

template <typename T>
glm::vec<3, T> naiveNormalize(const glm::vec<3, T>& v) {
  return v * quotient(T(1), std::sqrt(glm::dot(v, v)));
}

template <typename T>
glm::mat<3, 3, T> naiveInverseTranspose(const glm::mat<3, 3, T>& m) {
  const glm::mat<3, 3, T> cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  return cofactor * quotient(T(1), glm::dot(m[0], cofactor[0]));
}

}  // namespace speculum::hard_cases
