#pragma once

#include <filesystem>
#include <optional>

namespace speculum {

// Finds a scene or model that comes with the program: by its name, such as "gallery", or by its path within the
// program's data. Nothing if there is none.
std::optional<std::filesystem::path> shippedScene(const std::filesystem::path& wanted);

}  // namespace speculum
