#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

Image8 smoothPicture(int width, int height) {
  Image8 image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = static_cast<uint8_t>(255 * x / width);
      image.at(x, y)[1] = static_cast<uint8_t>(255 * y / height);
      image.at(x, y)[2] = static_cast<uint8_t>(128 + 100 * std::sin(0.1 * (x + y)));
      image.at(x, y)[3] = static_cast<uint8_t>(x);
    }
  }
  return image;
}

Image8 decoded(const std::vector<uint8_t>& bytes) {
  const TemporaryFolder folder;
  return readImage8(folder.write("a.jpg", {reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

double rmsDifference(const Image8& a, const Image8& b) {
  double sum = 0.0;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    const double difference = i % 4 == 3 ? 0.0 : static_cast<double>(a.rgba[i]) - b.rgba[i];
    sum += difference * difference;
  }
  return std::sqrt(sum / (0.75 * static_cast<double>(a.rgba.size())));
}

TEST(Jpeg, KeepsSizeAndColorAndDropsAlpha) {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{37, 19}, std::pair{160, 90}, std::pair{300, 1}}) {
    const Image8 image = smoothPicture(width, height);
    const Image8 read = decoded(encodeJpeg(image, 95));
    ASSERT_EQ(read.width, width);
    ASSERT_EQ(read.height, height);
    EXPECT_LT(rmsDifference(image, read), 3.0) << width << "x" << height;
    EXPECT_EQ(read.at(0, 0)[3], 255);
  }
}

TEST(Jpeg, QualityIsPaidForInBytes) {
  const Image8 image = smoothPicture(160, 90);
  const std::vector<uint8_t> low = encodeJpeg(image, 40);
  const std::vector<uint8_t> high = encodeJpeg(image, 95);
  EXPECT_LT(low.size(), high.size());
  EXPECT_GT(rmsDifference(image, decoded(low)), rmsDifference(image, decoded(high)));
  EXPECT_EQ(high, encodeJpeg(image, 95));
}

TEST(Jpeg, RefusesImpossibleSizesAndQualities) {
  EXPECT_THROW(encodeJpeg(Image8(), 88), std::runtime_error);
  EXPECT_THROW(encodeJpeg(Image8(65536, 1), 88), std::runtime_error);
  EXPECT_THROW(encodeJpeg(Image8(8, 8), 0), std::runtime_error);
  EXPECT_THROW(encodeJpeg(Image8(8, 8), 101), std::runtime_error);
}

}  // namespace
}  // namespace speculum
