#include "fuzz_support.hpp"

#include <spdlog/spdlog.h>

namespace speculum::fuzz {

namespace {

// Switches warnings off, because there would be thousands a second.
[[maybe_unused]] const bool quiet = [] {
  spdlog::set_level(spdlog::level::off);
  return true;
}();

}  // namespace

void require(bool kept, const char* promise) {
  if (!kept) {
    throw BrokenPromise(promise);
  }
}

}  // namespace speculum::fuzz
