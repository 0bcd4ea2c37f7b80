#pragma once

#include <filesystem>

#include "image/image.hpp"

namespace speculum {

// Reads a single-part RGB, RGBA or Y file. Throws FileError.
LinearImage readExr(const std::filesystem::path& file);
// Writes RGB as floats. Throws FileError.
void writeExr(const std::filesystem::path& file, const LinearImage& image);

}  // namespace speculum
