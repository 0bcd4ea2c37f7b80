#include "image/exr.hpp"

#include <tinyexr.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "image/exr_layout.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace {

std::string takeMessage(const char* message) {
  if (message == nullptr) {
    return "unknown fault";
  }
  std::string text(message);
  FreeEXRErrorMessage(message);
  return text.substr(0, text.find('\n'));
}

// Encodes in memory, because SaveEXR() returns success even if the disk is too full for a file's last bytes.
std::vector<uint8_t> encodeExr(const std::filesystem::path& file, const LinearImage& image) {
  // Readers expect the channels in alphabetical order.
  std::array<EXRChannelInfo, 3> channels{};
  std::array<std::vector<float>, 3> planes;
  std::array<unsigned char*, 3> planePointers{};
  for (int c = 0; c < 3; ++c) {
    channels[c].name[0] = "BGR"[c];
    planes[c].reserve(image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) {
      planes[c].push_back(pixel[2 - c]);
    }
    planePointers[c] = reinterpret_cast<unsigned char*>(planes[c].data());
  }
  std::array<int, 3> pixelTypes;
  pixelTypes.fill(TINYEXR_PIXELTYPE_FLOAT);
  // Header and image borrow these arrays: FreeEXRHeader() and FreeEXRImage() must not see them.
  EXRHeader header;
  InitEXRHeader(&header);
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  header.num_channels = 3;
  header.channels = channels.data();
  header.pixel_types = pixelTypes.data();
  header.requested_pixel_types = pixelTypes.data();
  EXRImage source;
  InitEXRImage(&source);
  source.num_channels = 3;
  source.width = image.width;
  source.height = image.height;
  source.images = planePointers.data();
  unsigned char* memory = nullptr;
  const char* message = nullptr;
  const size_t size = SaveEXRImageToMemory(&source, &header, &memory, &message);
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(memory, &std::free);
  if (size == 0) {
    throw FileError(file, "cannot be encoded as EXR: " + takeMessage(message), "a smaller picture is needed");
  }
  return {memory, memory + size};
}

}  // namespace

LinearImage readExr(const std::filesystem::path& file) {
  std::vector<uint8_t> bytes = readFile(file);
  const auto refuse = [&](const std::string& fault) {
    throw FileError(file, "is not an EXR that can be read: " + fault, "a single-part RGB, RGBA or Y file is needed");
  };
  try {
    checkExrLayout(bytes);
  } catch (const std::runtime_error& fault) {
    refuse(fault.what());
  }
  float* rgba = nullptr;
  int width = 0;
  int height = 0;
  const char* message = nullptr;
  const int result = LoadEXRFromMemory(&rgba, &width, &height, bytes.data(), bytes.size(), &message);
  const std::unique_ptr<float, decltype(&std::free)> owner(rgba, &std::free);
  if (result != TINYEXR_SUCCESS) {
    refuse(takeMessage(message));
  }
  LinearImage image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = glm::vec3(rgba[i * 4], rgba[i * 4 + 1], rgba[i * 4 + 2]);
  }
  return image;
}

void writeExr(const std::filesystem::path& file, const LinearImage& image) {
  if (image.width < 1 || image.height < 1) {
    throw FileError(file, "the picture has no pixels", "width and height of 1 or more are needed");
  }
  replaceFile(file, encodeExr(file, image));
}

}  // namespace speculum
