#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace speculum {

// Decodes a PNG or JPEG to rows of 8-bit RGBA. Parts that a damaged picture leaves out have one value, whatever the
// memory held before. Returns null, and decodeFailure() says why, if it cannot be decoded.
std::unique_ptr<uint8_t, void (*)(void*)> decodePicture(std::span<const uint8_t> bytes, int& width, int& height);
// Reads the size alone; false if it cannot be read.
bool readPictureSize(std::span<const uint8_t> bytes, int& width, int& height);
const char* decodeFailure();

// Unpacks zlib's format into `unpacked`. Returns the number of bytes, negative if there are more or they are damaged.
int unpackZlib(std::span<const char> packed, std::span<char> unpacked);

}  // namespace speculum
