// A | B in the window: both halves are whole pictures with their own settings, still, moving and saved.
#include "image/picture_files.hpp"
#include "window/journeys_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// A ball before a mirror, and boxes to both sides that turn.
class SplitJourney : public Journey {
 protected:
  SplitJourney()
      : Journey(wallScene + R"(
[[object]] model = "MODELS/box.obj", position = [-1, 0.2, 0], scale = 0.6, spin = [0, 300, 0]
[[object]] model = "MODELS/box.obj", position = [1, 0.2, 0], scale = 0.6, spin = [0, 300, 0]
)") {}

  const ShownSplit& split() const { return shown().split; }
  int dividerX() const { return static_cast<int>(std::lround(split().divider * width)); }
  // Counts the pixels in which both pictures differ, below the labels, between two columns.
  static int differing(const Image8& a, const Image8& b, int from, int to) {
    int count = 0;
    for (int y = 200; y < height; ++y) {
      for (int x = from; x < to; ++x) {
        count += !std::equal(a.at(x, y), a.at(x, y) + 3, b.at(x, y));
      }
    }
    return count;
  }
  int left(const Image8& a, const Image8& b) const { return differing(a, b, 0, dividerX() - 12); }
  int right(const Image8& a, const Image8& b) const { return differing(a, b, dividerX() + 12, width); }
  // As barePicture(), but Escape would end A | B.
  Image8 bothHalves() {
    demo_->apply(TogglePanel{});
    demo_->apply(DismissMessage{});
    run(4);
    Image8 image = picture();
    demo_->apply(TogglePanel{});
    run(3);
    return image;
  }
  void begin() {
    press("c");
    ASSERT_TRUE(split().on);
    setSetting("reflection.scale", "0.125");
    setSetting("view.exposure", "1.5");
    demo_->apply(MoveDivider{0.5});
    run(6);
  }
};

TEST_F(SplitJourney, HalvesAreThePicturesOfTheirSettings) {
  press("space");
  const Image8 a = barePicture();
  setSetting("reflection.scale", "0.125");
  setSetting("view.exposure", "1.5");
  const Image8 b = barePicture();
  press("ctrl+z");
  press("ctrl+z");
  begin();
  const Image8 both = bothHalves();
  EXPECT_EQ(left(both, a), 0);
  EXPECT_EQ(right(both, b), 0);
  EXPECT_GT(left(both, b), 1000);
  EXPECT_GT(right(both, a), 1000);
  EXPECT_TRUE(waitFor([&] { return split().halves[0].error && split().halves[1].error; }));
  EXPECT_GT(*split().halves[0].error, 0.01);
  EXPECT_GT(split().halves[0].gpuMs, 0.0);
  EXPECT_GT(split().halves[1].gpuMs, 0.0);
  EXPECT_EQ(split().halves[1].pictures, shown().settings.quality.stillPictures);
  press("x");
  EXPECT_EQ(shown().settings.reflection.scale, 1.0) << "of A";
  press("F12");
  run(3);
  ASSERT_EQ(home_.pictures().size(), 1u);
  const Image8 saved = readImage8(home_.pictures()[0]);
  EXPECT_EQ(left(saved, both), 0);
  EXPECT_EQ(right(saved, both), 0);
  EXPECT_GT(differing(saved, a, dividerX() - 1, dividerX() + 1), 100) << "with the divider";
  const PixelRect bar = widget("divider");
  dragFrom(bar.x + bar.width / 2.0, 300, 100, 0);
  EXPECT_NEAR(dividerX(), width / 2 + 100, 4);
  press("Escape");
  EXPECT_FALSE(split().on);
  EXPECT_TRUE(barePicture().rgba == a.rgba) << "the scene's settings again";
}

TEST_F(SplitJourney, TargetsShowTheChosenHalf) {
  press("space");
  begin();
  click("panel.Targets");
  run(8);
  const Image8 even = picture();
  run(1);
  const Image8 odd = picture();
  const auto canvas = demo_->panels().targets.canvas;
  ASSERT_TRUE(canvas);
  const auto from = static_cast<int>(canvas->corner.x) + 2;
  EXPECT_EQ(differing(even, odd, from, from + static_cast<int>(canvas->size.x) - 4), 0) << "in every frame";
}

TEST_F(SplitJourney, HalvesMoveTogetherAndAreRecorded) {
  begin();
  const Image8 before = bothHalves();
  run(8);
  const Image8 after = bothHalves();
  EXPECT_GT(left(before, after), 100);
  EXPECT_GT(right(before, after), 100);
  demo_->apply(SetPaused{true});
  demo_->apply(ToggleRecording{false});
  const double start = shown().playback.time;
  demo_->apply(SetPaused{false});
  run(8);
  demo_->apply(ToggleRecording{false});
  EXPECT_TRUE(contains(shown().status.text, "Recorded 4 frames")) << shown().status.text;
  EXPECT_NEAR(shown().playback.time - start, 4.0 / 30.0, 0.04);
  press("c");
  EXPECT_FALSE(split().on);
}

TEST_F(SplitJourney, RecordingInFullScreenSaysHowToStop) {
  press("space");
  begin();
  demo_->apply(TogglePanel{});
  demo_->apply(DismissMessage{});
  run(4);
  const Image8 before = picture();
  demo_->apply(ToggleRecording{false});
  run(5);
  const auto message = [&](const Image8& image) {
    return differing(image, before, 0, dividerX() - 12) + differing(image, before, dividerX() + 12, width);
  };
  // What the test reads of a frame that is recorded is the recorded picture.
  const int one = message(picture());
  run(1);
  const int other = message(picture());
  EXPECT_EQ(std::min(one, other), 0) << "the message is in no picture";
  EXPECT_GT(std::max(one, other), 500);
}

}  // namespace
}  // namespace speculum
