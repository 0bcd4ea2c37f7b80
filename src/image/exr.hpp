#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "image/image.hpp"

namespace speculum {

// Reads a single-part RGB, RGBA or Y file. Throws FileError.
LinearImage readExr(const std::filesystem::path& file);
// Writes RGB as floats. Throws FileError.
void writeExr(const std::filesystem::path& file, const LinearImage& image);

// Checks that the chunks of an EXR file fill every pixel of its data window once and with as much data as they need,
// because tinyexr does not check and would write outside its images or leave rows unset. Then marks the rows as
// ascending: each chunk says where it belongs, but tinyexr turns files with descending rows upside down. Throws
// std::runtime_error saying what is wrong, without the file's name. Limits: one part, 2^26 pixels (with the parts of
// tiles beyond the window and all levels), 2^28 values of all channels.
void checkExrLayout(std::vector<uint8_t>& bytes);

}  // namespace speculum
