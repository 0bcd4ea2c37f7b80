#pragma once

#include <cstdint>

namespace speculum {

// Returns the number that at most four bytes of a file are, the most significant one first.
template <typename Bytes>
uint32_t bigEndian(const Bytes& bytes) {
  uint32_t value = 0;
  for (const auto byte : bytes) {
    value = value << 8 | static_cast<uint8_t>(byte);
  }
  return value;
}

}  // namespace speculum
