#include "app/screenshot.hpp"

#include <array>
#include <ctime>

#include "core/platform.hpp"

namespace speculum {

Image8 pictureOf(Pixels pixels) {
  Image8 image;
  image.width = static_cast<int>(pixels.extent.width);
  image.height = static_cast<int>(pixels.extent.height);
  image.rgba = std::move(pixels.rgba);
  for (size_t i = 3; i < image.rgba.size(); i += 4) {
    image.rgba[i] = 255;
  }
  return image;
}

std::filesystem::path newPictureFile(const std::string& scene) {
  const std::filesystem::path folder = picturesDir() / "Speculum";
  std::filesystem::create_directories(folder);
  const std::time_t now = std::time(nullptr);
  std::array<char, 32> when{};
  std::strftime(when.data(), when.size(), "%Y-%m-%d_%H-%M-%S", std::localtime(&now));
  const std::string name = scene + "_" + when.data();
  std::filesystem::path file = folder / (name + ".png");
  for (int number = 2; std::filesystem::exists(file); ++number) {
    file = folder / (name + "_" + std::to_string(number) + ".png");
  }
  return file;
}

}  // namespace speculum
