#include <stb_image_write.h>

#include <stdexcept>
#include <string>

#include "image/image.hpp"

namespace speculum {

namespace {

void appendBytes(void* context, void* data, int size) {
  auto& bytes = *static_cast<std::vector<uint8_t>*>(context);
  const auto* first = static_cast<const uint8_t*>(data);
  bytes.insert(bytes.end(), first, first + size);
}

}  // namespace

std::vector<uint8_t> encodeJpeg(const Image8& image, int quality) {
  constexpr int largestSide = 65535;  // the format counts in 16 bits
  if (image.width < 1 || image.height < 1 || image.width > largestSide || image.height > largestSide) {
    throw std::runtime_error("a picture of " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                             " cannot be a JPEG (1 to 65535 pixels in either direction can)");
  }
  if (quality < 1 || quality > 100) {
    throw std::runtime_error("JPEG quality " + std::to_string(quality) + " is out of range (1 .. 100)");
  }
  std::vector<uint8_t> bytes;
  if (!stbi_write_jpg_to_func(&appendBytes, &bytes, image.width, image.height, 4, image.rgba.data(), quality)) {
    throw std::runtime_error("a picture of " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                             " could not be encoded as JPEG (is there memory left?)");
  }
  return bytes;
}

}  // namespace speculum
