#include "app/screenshot.hpp"

#include <array>
#include <ctime>

#include "platform/folders.hpp"

namespace speculum {

namespace {

// A path that nothing has, in Speculum's folder of the user's pictures, which is created.
std::filesystem::path newPath(const std::string& scene, const std::string& ending) {
  const std::filesystem::path folder = picturesDir() / "Speculum";
  std::filesystem::create_directories(folder);
  const std::time_t now = std::time(nullptr);
  std::array<char, 32> when{};
  std::strftime(when.data(), when.size(), "%Y-%m-%d_%H-%M-%S", std::localtime(&now));
  const std::string name = scene + "_" + when.data();
  std::filesystem::path path = folder / (name + ending);
  for (int number = 2; std::filesystem::exists(path); ++number) {
    path = folder / (name + "_" + std::to_string(number) + ending);
  }
  return path;
}

}  // namespace

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
  return newPath(scene, ".png");
}

std::filesystem::path newRecordingFolder(const std::string& scene) {
  const std::filesystem::path folder = newPath(scene, "");
  std::filesystem::create_directory(folder);
  return folder;
}

}  // namespace speculum
