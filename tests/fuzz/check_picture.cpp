#include "fuzz_support.hpp"
#include "image/picture_files.hpp"

namespace speculum::fuzz {

bool checkPicture(std::string_view bytes) {
  static const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("picture", bytes);
  Image8 picture;
  const bool isPicture = accepted<FileError>([&] { picture = readImage8(file); });
  if (isPicture) {
    require(picture.width > 0 && picture.height > 0, "a picture has pixels");
    require(picture.rgba.size() == size_t{4} * picture.width * picture.height, "every pixel has four bytes");
  }
  LinearImage radiance;
  const bool isRadiance = accepted<FileError>([&] { radiance = readExr(file); });
  if (isRadiance) {
    require(radiance.width > 0 && radiance.height > 0, "a picture has pixels");
    require(radiance.pixels.size() == static_cast<size_t>(radiance.width) * radiance.height, "every pixel has a value");
  }
  return isPicture || isRadiance;
}

}  // namespace speculum::fuzz
