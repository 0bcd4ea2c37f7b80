// The gallery of scenes: pictures that show their scenes, and a click that loads one.
#include <algorithm>
#include <cmath>

#include "demo_window_support.hpp"
#include "image/picture_files.hpp"

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

class Gallery : public DemoWindow {
 protected:
  Gallery() { click("panel.Scenes"); }

  Image8 crop(const PixelRect& rect) {
    const Pixels pixels = picture();
    Image8 image(rect.width, rect.height);
    for (int y = 0; y < rect.height; ++y) {
      const size_t from = 4 * (static_cast<size_t>(rect.y + y) * pixels.extent.width + rect.x);
      std::copy_n(pixels.rgba.begin() + static_cast<std::ptrdiff_t>(from), 4 * rect.width, image.at(0, y));
    }
    return image;
  }
};

TEST_F(Gallery, ShowsThePictures) {
  PixelRect tile = widget("gallery.bounced_light");
  tile.height = tile.width * 108 / 192;  // without the title
  const Image8 shown = crop(tile);
  const Image8 right = readImage8(sourceFile("scenes/thumbnails/bounced_light.jpg"));
  const Image8 wrong = readImage8(sourceFile("scenes/thumbnails/facing_mirrors.jpg"));
  Image8 scaled(tile.width, tile.height);
  Image8 other(tile.width, tile.height);
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const int fromX = x * right.width / tile.width;
      const int fromY = y * right.height / tile.height;
      std::copy_n(right.at(fromX, fromY), 4, scaled.at(x, y));
      std::copy_n(wrong.at(fromX, fromY), 4, other.at(x, y));
    }
  }
  EXPECT_LT(coarseDifference(shown, scaled), 8.0);
  EXPECT_GT(coarseDifference(shown, other), 24.0);
  expectQuiet();
}

TEST_F(Gallery, AClickLoadsTheScene) {
  const UiModel& model = demo_->model();
  ASSERT_EQ(model.sceneTitles.size(), model.scenes.size());
  EXPECT_EQ(model.scenes[static_cast<size_t>(model.scene)], "demo_window") << "of a file that has no thumbnail";
  click("gallery.facing_mirrors");
  run(4);
  ASSERT_EQ(model.scenes[static_cast<size_t>(model.scene)], "facing_mirrors");
  EXPECT_EQ(model.sceneTitles[static_cast<size_t>(model.scene)], "Facing mirrors");
  EXPECT_EQ(model.message, "");
  const auto nested =
      std::find_if(model.passes.begin(), model.passes.end(), [](const UiPass& p) { return p.depth > 0; });
  EXPECT_NE(nested, model.passes.end()) << "mirrors in mirrors are drawn";
  expectQuiet();
}

TEST_F(Gallery, OpenPanelsAreRemembered) {
  const PixelRect before = widget("gallery.bounced_light");
  demo_.reset();
  start();
  EXPECT_EQ(widget("gallery.bounced_light"), before);
  click("panel.Scenes");
  demo_.reset();
  start();
  for (const auto& [name, rect] : demo_->model().widgets) {
    EXPECT_NE(name, "gallery.bounced_light");
  }
  expectQuiet();
}

TEST_F(Gallery, FollowsTheWindowsEdgeAndTheSizeOfThePanel) {
  const PixelRect before = widget("gallery.bounced_light");
  demo_->window().resize(width + 150, height);
  run(6);
  EXPECT_EQ(widget("gallery.bounced_light").x, before.x + 150);
  click("section.window");
  drag("window.size", 0.2, 40);
  run(3);
  const PixelRect larger = widget("gallery.bounced_light");
  EXPECT_GT(larger.width, before.width + 20);
  EXPECT_GT(larger.height, before.height + 10);
  expectQuiet();
}

}  // namespace
}  // namespace speculum
