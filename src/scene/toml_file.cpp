#include "scene/toml_file.hpp"

#include <spdlog/fmt/fmt.h>

#include "scene/input_error.hpp"
#include "scene/toml_depth.hpp"

namespace speculum {

namespace fs = std::filesystem;

// Bytes; no scene written by hand is larger.
constexpr uintmax_t kLargestFile = 16u << 20;

std::string readTomlText(const fs::path& file, std::string_view kind) {
  return readInputText(file, fmt::format("a {} is needed", kind), kLargestFile);
}

toml::table readToml(const fs::path& file, std::string_view kind) {
  return parseToml(file, readTomlText(file, kind), kind);
}

toml::table parseToml(const fs::path& file, std::string_view text, std::string_view kind) {
  if (const int line = lineOfTooDeepKey(text)) {
    throwInputError(file, line, "toml", "a key has too many parts",
                    fmt::format("no key of a {} has more than 3", kind));
  }
  if (const int line = lineOfStrayCharacter(text)) {
    throwInputError(file, line, "toml", "a character that is not ASCII stands outside quotation marks",
                    "a TOML 1.0 file is needed, which quotes such keys and texts");
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const int line = static_cast<int>(error.source().begin.line);
    throwInputError(file, std::max(1, line), "toml", error.description(), "a TOML 1.0 file is needed");
  }
}

}  // namespace speculum
