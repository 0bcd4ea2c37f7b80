// The thumbnails of the gallery show their scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/picture_files.hpp"
#include "picture_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

std::vector<std::filesystem::path> shippedScenes() {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(sourceFile("scenes"))) {
    if (entry.path().extension() == ".toml") {
      scenes.push_back(entry.path());
    }
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

std::filesystem::path thumbnailOf(const std::filesystem::path& scene) {
  return scene.parent_path() / "thumbnails" / (scene.stem().string() + ".jpg");
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
  ASSERT_GT(shippedScenes().size(), 10u);
  for (const std::filesystem::path& scene : shippedScenes()) {
    const std::filesystem::path file = thumbnailOf(scene);
    ASSERT_TRUE(std::filesystem::exists(file)) << file << " (scripts/thumbnails makes it)";
    EXPECT_LE(std::filesystem::file_size(file), 8192u) << file;
    const Image8 picture = readImage8(file);
    EXPECT_EQ(picture.width, 192);
    EXPECT_EQ(picture.height, 108);
  }
}

TEST(Thumbnails, ShowTheirScenes) {
  for (const char* name : {"gallery", "many_mirrors", "outdoors"}) {
    Options options = headless(sourceFile("scenes/" + std::string(name) + ".toml"), {192, 108});
    set(options, {{"view.samples", "4"}, {"reflection.samples", "4"}});
    const Image8 drawn = draw(options, 1.0);
    EXPECT_LT(coarseDifference(drawn, readImage8(thumbnailOf(options.scene))), 4.0) << name;
    for (const std::filesystem::path& other : shippedScenes()) {
      if (other.stem() != name) {
        EXPECT_GT(coarseDifference(drawn, readImage8(thumbnailOf(other))), 16.0) << name << " and " << other.stem();
      }
    }
  }
}

}  // namespace
}  // namespace speculum
