#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "image/image.hpp"

namespace speculum {

// Reads a PNG or JPEG file of at most 2^26 pixels. Throws FileError.
Image8 readImage8(const std::filesystem::path& file);
// Reads a picture that a model names: a PNG, JPEG, TGA, BMP, PSD or the first picture of a GIF. Throws FileError, which
// names the format of other pictures.
Image8 readTexture(const std::filesystem::path& file);
// Does the same for the content of a picture; `name` stands in messages, and a TGA is known by its extension.
Image8 readTexture(const std::filesystem::path& name, const std::vector<uint8_t>& bytes);
// Writes a PNG file. Throws FileError.
void writePng(const std::filesystem::path& file, const Image8& image);

// Baseline JPEG without alpha; quality 1 .. 100, chroma at half the resolution up to 90. Throws std::runtime_error for
// a picture without pixels, one of more than 65535 pixels in a direction, and any other quality.
std::vector<uint8_t> encodeJpeg(const Image8& image, int quality);

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
