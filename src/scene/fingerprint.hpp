#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "platform/bytes.hpp"
#include "scene/scene.hpp"

namespace speculum {

// FNV-1a with 64 bits (Fowler, Noll, Vo): detects changes of content, but not forgeries.
class Fingerprint {
 public:
  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);  // adds the length too, so that "ab" "c" differs from "a" "bc"
  template <typename T>
  requires std::is_arithmetic_v<T>
  void add(T value) { add(std::as_bytes(std::span(&value, 1))); }

  std::string hex() const;  // 16 digits

 private:
  uint64_t state_ = fnv1aStart;
};

// Adds everything that a picture of the scene depends on except settings: values of the scene, and models and textures
// as they were read. Names and paths are left out, so that a scene saved elsewhere has the same fingerprint.
void addScene(Fingerprint& fingerprint, const Scene& scene);

}  // namespace speculum
