#pragma once

#include <filesystem>

namespace speculum {

// Absolute folders of the source tree and of this build. They are functions and no macros, because a compiler cache
// misses every file with such a path on its command line.
std::filesystem::path sourceDir();
std::filesystem::path binaryDir();

}  // namespace speculum
