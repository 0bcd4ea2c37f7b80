#pragma once

#include <filesystem>

namespace speculum {

// Absolute folders of the source tree and of this build. Functions, because compiler caches miss every file that is
// compiled with a path of its own on the command line.
std::filesystem::path sourceDir();
std::filesystem::path binaryDir();

}  // namespace speculum
