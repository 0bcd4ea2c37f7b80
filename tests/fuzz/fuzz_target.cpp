#include <cstdint>

#include "fuzz_checks.hpp"

// libFuzzer's entry; SPECULUM_CHECK is the function of fuzz_checks.hpp that the program is built for.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size <= speculum::fuzz::largestInput) {
    speculum::fuzz::SPECULUM_CHECK({reinterpret_cast<const char*>(data), size});
  }
  return 0;
}
