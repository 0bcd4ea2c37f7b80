#include <cstdint>

#include "fuzz_checks.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size <= speculum::fuzz::kLargestInput) {
    speculum::fuzz::checkSweep({reinterpret_cast<const char*>(data), size});
  }
  return 0;
}
