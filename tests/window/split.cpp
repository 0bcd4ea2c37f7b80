// A | B without a window: which settings are changed, what ends it, and the comparison of both halves.
#include "accuracy/ground_truth.hpp"
#include "compare/image_metrics.hpp"
#include "window/support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class Split : public WorkspaceTest {
 protected:
  const ShownSplit& split() const { return workspace_->split().shown(); }
  double exposure(int half) const { return workspace_->shownSettings(half).view.exposure; }
};

TEST_F(Split, PanelsChangeTheChosenHalf) {
  send(ToggleSplit{});
  ASSERT_TRUE(split().on);
  EXPECT_EQ(split().chosen, 1);
  EXPECT_EQ(split().divider, 0.5);
  EXPECT_TRUE(split().halves[0].differs.empty());
  setExposure(2.0);
  EXPECT_EQ(exposure(0), 1.0);
  EXPECT_EQ(exposure(1), 2.0);
  EXPECT_EQ(split().halves[0].differs, (std::vector<SettingChange>{{"view.exposure", "1.0"}}));
  EXPECT_EQ(split().halves[1].differs, (std::vector<SettingChange>{{"view.exposure", "2.0"}}));
  send(ChooseOtherHalf{});
  EXPECT_EQ(shown().settings.view.exposure, 1.0);
  setExposure(3.0);
  EXPECT_EQ(exposure(0), 3.0);
  EXPECT_FALSE(edit().unsaved) << "both are trials";
  send(ChooseHalf{1});
  send(Undo{});
  EXPECT_EQ(exposure(0), 1.0) << "the last change was one of A";
  EXPECT_EQ(split().chosen, 0) << "and the panels show it";
  send(Undo{});
  EXPECT_EQ(exposure(1), 1.0);
  send(Redo{});
  EXPECT_EQ(exposure(1), 2.0);
  send(Escape{});
  EXPECT_FALSE(split().on);
  EXPECT_EQ(shown().settings.view.exposure, 1.0);
  EXPECT_TRUE(edit().undo.empty()) << "steps of halves are gone";
  EXPECT_TRUE(edit().redo.empty());
}

TEST_F(Split, NaiveBBeginsAnewWhileComparing) {
  send(ToggleSplit{});
  setExposure(2.0);
  send(ToggleSplit{SplitStart::naive});
  EXPECT_TRUE(split().on);
  EXPECT_EQ(workspace_->shownSettings(1).reflection.maxDepth, 1);
  EXPECT_EQ(exposure(1), 1.0);
  send(ToggleSplit{});
  EXPECT_FALSE(split().on);
}

TEST_F(Split, KeepTakesTheHalfAsOneStep) {
  const Settings before = shown().settings;
  send(ToggleSplit{SplitStart::naive});
  EXPECT_EQ(workspace_->shownSettings(1).reflection.maxDepth, 1);
  EXPECT_EQ(workspace_->shownSettings(1).quality.stillPictures, 1);
  EXPECT_TRUE(workspace_->shownSettings(0) == before);
  setExposure(2.0);
  send(KeepHalf{});
  EXPECT_FALSE(split().on);
  EXPECT_EQ(shown().settings.view.exposure, 2.0);
  EXPECT_EQ(shown().settings.reflection.maxDepth, 1);
  EXPECT_TRUE(edit().unsaved);
  send(Undo{});
  EXPECT_TRUE(shown().settings == before);
  send(KeepHalf{});
  EXPECT_TRUE(shown().settings == before) << "nothing to keep";
}

TEST_F(Split, SceneIsSavedWithItsOwnSettings) {
  send(ToggleSplit{});
  setExposure(2.0);
  send(SelectNode{ball});
  send(RemoveSelected{});
  send(Save{});
  EXPECT_TRUE(onDisk().objects.empty());
  EXPECT_EQ(settingsOf(onDisk()).view.exposure, 1.0);
}

TEST_F(Split, EscapeEndsOneThingAtATime) {
  send(ToggleSplit{});
  send(SelectNode{ball});
  send(Escape{});
  EXPECT_TRUE(split().on);
  send(Escape{});
  EXPECT_FALSE(split().on);
  send(ToggleSplit{});
  send(ToggleSplit{});
  EXPECT_FALSE(split().on) << "the same key";
}

TEST_F(Split, ClicksFollowTheImagesOfTheirHalf) {
  const glm::dvec2 image(width / 2.0 + focalPixels * 0.3 / 6.0, height / 2.0);  // of the ball, in the mirror ahead
  send(ToggleSplit{});
  changeSettings([](Settings& settings) { settings.reflection.maxDepth = 0; });
  click(image);
  EXPECT_NE(edit().through, MirrorPath{0}) << "B shows no image there";
  send(SelectNode{});
  send(MoveDivider{0.9});
  click(image);
  EXPECT_EQ(edit().through, MirrorPath{0});
}

TEST_F(Split, DividerLeavesBothHalves) {
  host_.free = PixelRect{400, 0, 400, height};
  send(ToggleSplit{});
  EXPECT_NEAR(split().divider, 600.0 / width, 1e-9) << "in the middle of what panels leave free";
  send(MoveDivider{-1.0});
  EXPECT_GT(split().divider, 0.0);
  send(MoveDivider{2.0});
  EXPECT_LT(split().divider, 1.0);
}

TEST_F(Split, FailedFrameEndsIt) {
  send(ToggleSplit{});
  EXPECT_TRUE(workspace_->undoFailedChange("no memory"));
  EXPECT_FALSE(split().on);
  EXPECT_TRUE(contains(workspace_->problem(), "no memory"));
}

TEST_F(Split, MessageEndsWithIt) {
  send(ToggleSplit{});
  EXPECT_TRUE(startsWith(status(), "A | B: the panel changes the settings of B"));
  send(Escape{});
  EXPECT_EQ(status(), "");
}

TEST_F(Split, LessonsOpenTheirSceneWithBothSettings) {
  ASSERT_EQ(split().lessons.size(), 10u);
  const Lesson& lesson = workspace_->split().lessons()[0];
  send(SelectNode{ball});
  send(RemoveSelected{});
  host_.free = PixelRect{300, 0, 200, height};
  send(OpenScene{lesson.scene, 0});
  EXPECT_EQ(edit().prompt, Prompt::unsavedChanges);
  send(DiscardChanges{});
  waitFor([&] { return split().lesson.has_value(); });
  EXPECT_EQ(*split().lesson, 0u);
  EXPECT_FALSE(host_.sidePanels);
  EXPECT_DOUBLE_EQ(split().divider, 600.0 / width) << "in the middle, once the panels at the right are closed";
  EXPECT_EQ(shownScene(), "gallery");
  EXPECT_TRUE(shown().playback.paused);
  EXPECT_EQ(eye(), lesson.camera->position);
  EXPECT_EQ(workspace_->shownSettings(0).reflection.scale, 0.25);
  EXPECT_EQ(workspace_->shownSettings(1).reflection.scale, 1.0);
  EXPECT_EQ(workspace_->shownSettings(0).view.toneMap, ToneMap::aces) << "on top of the scene's";
  EXPECT_FALSE(edit().unsaved);
  send(OpenScene{options_.scene});
  waitFor([&] { return shownScene() == "workspace"; });
  EXPECT_FALSE(split().on);
  EXPECT_FALSE(split().lesson);
}

class Comparing : public testing::Test {
 protected:
  void SetUp() override { view_.begin({}, {}, 0.5); }
  void drawn(int half, std::optional<uint64_t> still, const SplitView::Truth& truth = nullptr) {
    view_.frameDrawn(
        {.half = half, .gpuMs = 1.0 + half, .pictures = 1 + 63 * half, .text = "text", .still = still}, truth,
        [this](int of) { return pictures_[static_cast<size_t>(of)]; }, [](int) { return Settings(); });
  }
  void wait() {
    for (int i = 0; i < 3000 && view_.working(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      view_.update();
    }
  }
  static Image8 gray(uint8_t code) {
    Image8 image(32, 32);
    std::ranges::fill(image.rgba, code);
    return image;
  }
  const ShownSplit::Half& half(size_t of) const { return view_.shown().halves[of]; }

  SplitView view_{{}};
  std::array<Image8, 2> pictures_{gray(100), gray(140)};
};

TEST_F(Comparing, CompleteStillPicturesAreCompared) {
  drawn(0, 1);
  drawn(1, std::nullopt);
  EXPECT_FALSE(view_.working()) << "B is not complete";
  EXPECT_EQ(half(1).gpuMs, 2.0);
  EXPECT_EQ(half(1).pictures, 64);
  EXPECT_EQ(half(1).picture, "text");
  drawn(1, 7);
  EXPECT_TRUE(view_.working());
  wait();
  const double flip = compareImages(comparedImage(pictures_[0]), comparedImage(pictures_[1])).whole.flip;
  EXPECT_GT(flip, 0.01);
  for (const size_t of : {0, 1}) {
    ASSERT_TRUE(half(of).error);
    EXPECT_NEAR(*half(of).error, flip, 1e-12);
    EXPECT_FALSE(half(of).ofReference);
  }
  drawn(0, 1);
  EXPECT_FALSE(view_.working()) << "the same pictures";
  EXPECT_TRUE(half(0).error);
  drawn(0, 2);
  EXPECT_FALSE(half(0).error) << "of another picture";
  EXPECT_TRUE(view_.working());
  drawn(0, std::nullopt);
  EXPECT_FALSE(view_.working());
}

TEST_F(Comparing, ReferenceIsUsedOnceThereIsOne) {
  drawn(0, 1);
  drawn(1, 2);
  wait();
  auto truth = std::make_shared<GroundTruth>();
  truth->image = LinearImage(32, 32);
  truth->mirrors = {32, 32, std::vector<uint8_t>(32 * 32)};
  pictures_[1] = gray(0);
  drawn(0, 1, truth);
  EXPECT_TRUE(view_.working());
  wait();
  EXPECT_TRUE(half(0).ofReference);
  EXPECT_GT(*half(0).error, 0.1);
  EXPECT_EQ(*half(1).error, 0.0) << "as black as the reference";
}

}  // namespace
}  // namespace speculum
