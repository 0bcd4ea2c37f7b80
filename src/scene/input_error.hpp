#pragma once

#include <filesystem>
#include <string_view>

#include "scene/scene_loader.hpp"

namespace speculum {

// Throws InputError with `FILE:LINE: key: wrong (right)`. Control characters, which names and keys taken from a file
// may hold, become '?' so that the message is always one line.
[[noreturn]] void throwInputError(const std::filesystem::path& file, int line, std::string_view key,
                                  std::string_view wrong, std::string_view right);

}  // namespace speculum
