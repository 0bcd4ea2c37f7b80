#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace speculum {

// Inputs have at most INT_MAX bytes.

// Decodes a PNG, JPEG, TGA, BMP, PSD or the first picture of a GIF to rows of 8-bit RGBA. What a damaged picture leaves
// out does not depend on what the memory held before. `channels` are those that the decoder counts in the file. Returns
// null, and decodeFailure() of the same thread says why, if it cannot be decoded; the numbers are then unset.
std::unique_ptr<uint8_t, void (*)(void*)> decodePicture(std::span<const uint8_t> bytes, int& width, int& height,
                                                        int& channels);
// Reads the size alone; false if it cannot be read.
bool readPictureSize(std::span<const uint8_t> bytes, int& width, int& height);
const char* decodeFailure();

// Unpacks zlib's format into `unpacked`. Returns the number of bytes; negative if there are more, or if `packed` is
// damaged.
int unpackZlib(std::span<const char> packed, std::span<char> unpacked);

}  // namespace speculum
