#pragma once

#include <filesystem>
#include <string>

#include "core/renderer.hpp"
#include "image/image.hpp"

namespace speculum {

// The opaque picture of what the renderer has read back.
Image8 pictureOf(Pixels pixels);

// A new file in Speculum's folder of the user's pictures, named after the scene and the local time. Creates the folder.
// Throws std::filesystem::filesystem_error if that fails.
std::filesystem::path newPictureFile(const std::string& scene);

// Likewise a new, empty folder.
std::filesystem::path newRecordingFolder(const std::string& scene);

}  // namespace speculum
