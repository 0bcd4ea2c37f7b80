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

void checkMessage(std::string_view message) {
  require(message.find_first_of("\r\n") == std::string_view::npos, "an error is one line");
  require(message.ends_with(')'), "an error ends with what would be right");
}

}  // namespace speculum::fuzz
