#include "scene/toml_file.hpp"

#include <spdlog/fmt/fmt.h>

#include "platform/file_io.hpp"
#include "scene/input_error.hpp"
#include "scene/toml_depth.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// A device or pipe might never end, and nobody writes a larger scene by hand.
constexpr uintmax_t kLargestFile = 16u << 20;

}  // namespace

std::string readTomlText(const fs::path& file, std::string_view kind) {
  const std::string right = fmt::format("a {} is needed", kind);
  std::error_code error;
  if (fs::exists(file, error) && !fs::is_directory(file, error)) {
    const bool regular = fs::is_regular_file(file, error);
    if (!regular || fs::file_size(file, error) > kLargestFile) {
      throwInputError(file, 1, "file", regular ? "is larger than 16 MiB" : "is a device or pipe", right);
    }
  }
  try {
    const std::vector<uint8_t> bytes = readFileBytes(file);
    return std::string(bytes.begin(), bytes.end());
  } catch (const std::runtime_error& failure) {
    const std::string message = failure.what();
    const size_t start = file.string().size() + 2;
    throwInputError(file, 1, "file", message.substr(start, message.rfind(" (") - start), right);
  }
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
