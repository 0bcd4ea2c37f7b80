#include <nlohmann/json.hpp>

#include "accuracy/sweep_json.hpp"
#include "compare/image_metrics.hpp"
#include "error_message.hpp"
#include "image/image.hpp"
#include "made_pictures.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::greyPicture;

Comparison compare(const Image8& a, const Image8& b, const CompareOptions& options = {}) {
  return compareImages(comparedImage(a, "a.png"), comparedImage(b, "b.png"), options);
}

TEST(ImageMetrics, EqualPicturesHaveNoError) {
  const Image8 image =
      testing_support::madePicture(40, 30, [](int x, int y) { return glm::ivec4(5 * x, 7 * y, 3 * (x + y), 255); });
  const ImageMetrics m = compare(image, image).whole;
  EXPECT_EQ(m.rmse, 0.0);
  EXPECT_EQ(m.relativeRmse, 0.0);
  EXPECT_EQ(m.psnr, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(m.ssim, 1.0, 1e-12);
  EXPECT_EQ(m.flip, 0.0);
  EXPECT_EQ(m.maxDiff, 0.0);
  EXPECT_EQ(m.pixelsOver, 0);
  EXPECT_EQ(m.pixels, 1200);
}

TEST(ImageMetrics, ConstantPicturesFollowTheFormulas) {
  const ImageMetrics m = compare(greyPicture(32, 32, 128), greyPicture(32, 32, 138)).whole;
  const double a = srgbDecode(128 / 255.0);
  const double b = srgbDecode(138 / 255.0);
  EXPECT_NEAR(m.rmse, b - a, 1e-7);
  EXPECT_NEAR(m.relativeRmse, (b - a) / a, 1e-6);
  EXPECT_NEAR(m.psnr, 20.0 * std::log10(25.5), 1e-9);
  const double x = 128 / 255.0;
  const double y = 138 / 255.0;
  EXPECT_NEAR(m.ssim, (2.0 * x * y + 1e-4) / (x * x + y * y + 1e-4), 1e-9);
  EXPECT_EQ(m.maxDiff, 10.0);
  EXPECT_EQ(m.p99Diff, 10.0);
  EXPECT_EQ(m.pixelsOver, 1024);
}

TEST(ImageMetrics, CountsAndPercentilesTakeTheWorstChannel) {
  const Image8 a = greyPicture(20, 10, 100);
  Image8 b = a;
  b.at(3, 2)[1] = 102;
  b.at(4, 2)[2] = 97;
  b.at(5, 2)[0] = 110;
  const ImageMetrics m = compare(a, b, {.tolerance = 2.0}).whole;
  EXPECT_EQ(m.pixelsOver, 2);
  EXPECT_EQ(m.maxDiff, 10.0);
  // 198 of 200 pixels, the 99 %, differ by at most 2.
  EXPECT_EQ(m.p99Diff, 2.0);
  EXPECT_EQ(compare(a, b, {.tolerance = 3.0}).whole.pixelsOver, 1);
}

TEST(ImageMetrics, UnderAMaskOnlyItsPixelsCount) {
  const Image8 a = greyPicture(40, 40, 100);
  Image8 b = a;
  PixelMask mask{40, 40, std::vector<uint8_t>(1600, 0)};
  for (int y = 0; y < 40; ++y) {
    for (int x = 20; x < 40; ++x) {
      mask.selected[static_cast<size_t>(y) * 40 + x] = 1;
      b.at(x, y)[0] = 110;
    }
  }
  const Comparison c = compare(a, b, {.mask = &mask});
  ASSERT_TRUE(c.masked);
  EXPECT_EQ(c.masked->pixels, 800);
  EXPECT_EQ(c.masked->pixelsOver, 800);
  EXPECT_EQ(c.whole.pixelsOver, 800);
  EXPECT_NEAR(c.masked->rmse, c.whole.rmse * std::sqrt(2.0), 1e-9);
  EXPECT_GT(c.masked->flip, 1.5 * c.whole.flip);
  EXPECT_LT(c.masked->ssim, c.whole.ssim);
  std::ranges::fill(mask.selected, 0);
  EXPECT_FALSE(compare(a, b, {.mask = &mask}).masked);
}

TEST(ImageMetrics, LinearPicturesAreClampedAndEncoded) {
  LinearImage bright(12, 12);
  LinearImage half(12, 12);
  for (size_t i = 0; i < bright.pixels.size(); ++i) {
    bright.pixels[i] = glm::vec3(7.0f, -3.0f, 0.5f);
    half.pixels[i] = glm::vec3(1.0f, 0.0f, 0.5f);
  }
  EXPECT_EQ(compareImages(comparedImage(bright), comparedImage(half)).whole.rmse, 0.0);
  EXPECT_NEAR(comparedImage(half).display[0].b, 255.0 * srgbEncode(0.5), 1e-4);
}

TEST(ImageMetrics, RefusesPicturesThatCannotBeCompared) {
  const std::string sizes = messageOf([] { compare(greyPicture(4, 4, 0), greyPicture(4, 5, 0)); });
  EXPECT_TRUE(contains(sizes, "b.png"));
  EXPECT_TRUE(contains(sizes, "4x5"));
  EXPECT_TRUE(contains(sizes, "4x4"));
  LinearImage broken(3, 2);
  broken.at(2, 1).g = std::numeric_limits<float>::quiet_NaN();
  const std::string nan = messageOf([&] { comparedImage(broken, "broken.exr"); });
  EXPECT_TRUE(contains(nan, "broken.exr"));
  EXPECT_TRUE(contains(nan, "(2, 1)"));
  EXPECT_THROW(compare(Image8(), Image8()), std::runtime_error);
  const PixelMask mask{2, 2, std::vector<uint8_t>(4, 1)};
  EXPECT_THROW(compare(greyPicture(4, 4, 0), greyPicture(4, 4, 0), {.mask = &mask}), std::runtime_error);
  EXPECT_THROW(readComparedImage("/no/such/file.png"), std::runtime_error);
}

TEST(ImageMetrics, JsonHasFixedKeysAndNullInfinity) {
  const Image8 a = greyPicture(16, 16, 90);
  const PixelMask mask{16, 16, std::vector<uint8_t>(256, 1)};
  const nlohmann::ordered_json json = comparisonJson(compare(a, a, {.mask = &mask}));
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) {
    keys.push_back(key);
  }
  EXPECT_EQ(keys, (std::vector<std::string>{"rmse", "relative_rmse", "psnr", "ssim", "flip", "max_diff", "p99_diff",
                                            "pixels_over", "mask"}));
  EXPECT_TRUE(json["psnr"].is_null());
  EXPECT_EQ(json["mask"]["rmse"], 0.0);
  EXPECT_TRUE(json["pixels_over"].is_number_integer());
}

TEST(ImageMetrics, TableNamesEveryMetric) {
  const std::string table = comparisonTable(compare(greyPicture(16, 16, 90), greyPicture(16, 16, 95)), 2.0);
  for (const char* word : {"RMSE", "relative", "PSNR", "SSIM", "FLIP", "largest", "99th", "pixels over 2/255", "256"}) {
    EXPECT_TRUE(contains(table, word)) << word << " in\n" << table;
  }
}

}  // namespace
}  // namespace speculum
