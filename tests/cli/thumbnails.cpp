// The thumbnails of the gallery show their scenes.
#include "image/picture_files.hpp"
#include "picture_support.hpp"
#include "sampling.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

std::filesystem::path thumbnailOf(const std::string& scene) {
  const std::filesystem::path file = sceneFile(scene);
  return file.parent_path() / "thumbnails" / file.stem().concat(".jpg");
}

// Root mean square difference of 16 x 9 block means, in 0 .. 255.
double coarseDifference(const Image8& a, const Image8& b) {
  double sum = 0.0;
  for (int block = 0; block < 16 * 9 * 3; ++block) {
    const auto mean = [&](const Image8& image) {
      const int w = image.width / 16;
      const int h = image.height / 9;
      double total = 0.0;
      for (int i = 0; i < w * h; ++i) {
        total += image.at(block / 3 % 16 * w + i % w, block / 3 / 16 * h + i / w)[block % 3];
      }
      return total / (w * h);
    };
    sum += std::pow(mean(a) - mean(b), 2.0);
  }
  return std::sqrt(sum / (16 * 9 * 3));
}

TEST(Thumbnails, EveryShippedSceneHasOne) {
  std::vector<std::string> scenes = sceneNames("hard/");
  ASSERT_GT(scenes.size(), 10u);
  std::ranges::copy(sceneNames(), std::back_inserter(scenes));
  ASSERT_GT(scenes.size(), 20u);
  for (const std::string& scene : scenes) {
    const std::filesystem::path file = thumbnailOf(scene);
    ASSERT_TRUE(std::filesystem::exists(file)) << file << " (scripts/thumbnails makes it)";
    EXPECT_LE(std::filesystem::file_size(file), 8192u) << file;
    EXPECT_EQ(readImage8(file).width, 192);
    EXPECT_EQ(readImage8(file).height, 108);
  }
}

TEST(Thumbnails, ShowTheirScenes) {
  for (const std::string name :
       fullTests() ? std::vector{"gallery", "many_mirrors", "outdoors"} : std::vector{"many_mirrors"}) {
    Options options = headless(sceneFile(name), {192, 108}, {{"view.samples", "4"}, {"reflection.samples", "4"}});
    const Image8 drawn = draw(options, 1.0);
    for (const std::string& scene : sceneNames()) {
      const double d = coarseDifference(drawn, readImage8(thumbnailOf(scene)));
      EXPECT_TRUE(scene == name ? d < 4.0 : d > 16.0) << name << " and " << scene << ": " << d;
    }
  }
}

}  // namespace
}  // namespace speculum
