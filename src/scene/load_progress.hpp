#pragma once

#include <filesystem>
#include <functional>

namespace speculum {

// Receives now and then the file that is read and the share of all files that is done, 0 .. 1. An exception from it
// ends the loading.
using LoadProgress = std::function<void(const std::filesystem::path& file, double done)>;

}  // namespace speculum
