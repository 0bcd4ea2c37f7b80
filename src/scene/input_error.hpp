#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "scene/scene_loader.hpp"

namespace speculum {

// The message with control characters, which names and keys taken from a file may hold, replaced by '?': always one
// line.
std::string oneLine(std::string message);

// Throws InputError with `FILE:LINE: key: wrong (right)`, made one line.
[[noreturn]] void throwInputError(const std::filesystem::path& file, int line, std::string_view key,
                                  std::string_view wrong, std::string_view right);

}  // namespace speculum
