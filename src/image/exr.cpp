#include <tinyexr.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "image/file_io.hpp"
#include "image/image.hpp"

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

}  // namespace

LinearImage readExr(const std::filesystem::path& file) {
  const std::vector<uint8_t> bytes = readFileBytes(file);
  float* rgba = nullptr;
  int width = 0;
  int height = 0;
  const char* message = nullptr;
  const int result = LoadEXRFromMemory(&rgba, &width, &height, bytes.data(), bytes.size(), &message);
  const std::unique_ptr<float, decltype(&std::free)> owner(rgba, &std::free);
  if (result != TINYEXR_SUCCESS) {
    throw std::runtime_error(file.string() + ": is not an EXR that can be read: " + takeMessage(message) +
                             " (a single-part RGB, RGBA or Y file is needed)");
  }
  LinearImage image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = glm::vec3(rgba[i * 4], rgba[i * 4 + 1], rgba[i * 4 + 2]);
  }
  return image;
}

void writeExr(const std::filesystem::path& file, const LinearImage& image) {
  static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
  if (image.width < 1 || image.height < 1) {
    throw std::runtime_error(file.string() + ": the picture has no pixels (width and height of 1 or more are needed)");
  }
  replaceFile(file, [&](const std::filesystem::path& target) {
    const char* message = nullptr;
    constexpr int kChannels = 3;
    constexpr int kFullFloat = 0;
    if (SaveEXR(&image.pixels.front().x, image.width, image.height, kChannels, kFullFloat, target.c_str(), &message) !=
        TINYEXR_SUCCESS) {
      throw std::runtime_error(file.string() + ": cannot be written: " + takeMessage(message) +
                               " (check the folder's permissions and free space)");
    }
  });
}

}  // namespace speculum
