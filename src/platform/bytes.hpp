#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace speculum {

inline constexpr uint64_t fnv1aStart = 0xcbf29ce484222325u;

// FNV-1a with 64 bits (Fowler, Noll, Vo): detects content that changed by accident, not by intent. `hash` is
// fnv1aStart or the hash of the bytes before these.
constexpr uint64_t fnv1a(std::span<const std::byte> bytes, uint64_t hash = fnv1aStart) {
  for (const std::byte byte : bytes) {
    hash = (hash ^ static_cast<uint64_t>(byte)) * 0x100000001b3u;
  }
  return hash;
}

// Return the number that bytes of a file are: of at most four, the most significant one first, and of four, that one
// last.
template <typename Bytes>
uint32_t bigEndian(const Bytes& bytes) {
  uint32_t value = 0;
  for (const auto byte : bytes) {
    value = value << 8 | static_cast<uint8_t>(byte);
  }
  return value;
}
template <typename Bytes>
uint32_t littleEndian(const Bytes& bytes) {
  return bigEndian(std::array{bytes[3], bytes[2], bytes[1], bytes[0]});
}

}  // namespace speculum
