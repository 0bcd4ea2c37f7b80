#pragma once

#include <filesystem>
#include <functional>

namespace speculum {

// Called now and then with the file that is read and the share of all files that is done, 0 .. 1. An exception from it
// ends the loading.
using LoadProgress = std::function<void(const std::filesystem::path& file, double done)>;

}  // namespace speculum
