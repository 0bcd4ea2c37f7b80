#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <string_view>

#include "fuzz_checks.hpp"
#include "scene/obj_loader.hpp"
#include "scene/scene_loader.hpp"
#include "temporary_folder.hpp"

namespace speculum::fuzz {

void require(bool kept, const char* promise);

inline bool finite(const glm::dvec2& v) {
  return std::isfinite(v.x) && std::isfinite(v.y);
}
inline bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool unit(const glm::dvec3& v) {
  return std::abs(glm::length(v) - 1.0) <= 1e-9;
}

// Says whether `read` accepted the input. Throws BrokenPromise for an InputError that is not one line.
template <typename Read>
bool accepted(const Read& read) {
  try {
    read();
    return true;
  } catch (const InputError& refusal) {
    const std::string_view message = refusal.what();
    require(message.find_first_of("\r\n") == std::string_view::npos, "an error is one line");
    require(message.ends_with(')'), "an error ends with what would be right");
    return false;
  }
}

}  // namespace speculum::fuzz
