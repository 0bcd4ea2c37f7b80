#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <string_view>

#include "fuzz_checks.hpp"
#include "platform/files.hpp"
#include "scene/obj_loader.hpp"
#include "scene/scene_loader.hpp"
#include "temporary_folder.hpp"

namespace speculum::fuzz {

void require(bool kept, const char* promise);  // throws BrokenPromise unless `kept`

inline bool finite(const glm::dvec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
inline bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool unit(const glm::dvec3& v) {
  return std::abs(glm::length(v) - 1.0) <= 1e-9;
}

// Requires what drawing takes for granted of a loaded mesh.
void checkMesh(const Mesh& mesh, size_t textureCount);

void checkMessage(std::string_view message);  // requires one line that ends with what would be right

// Says whether `read` accepted the input. Throws BrokenPromise for a Refusal that is not one line.
template <typename Refusal = InputError, typename Read>
bool accepted(const Read& read) {
  try {
    read();
    return true;
  } catch (const Refusal& refusal) {
    checkMessage(refusal.what());
  }
  return false;
}

}  // namespace speculum::fuzz
