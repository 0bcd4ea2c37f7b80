// The accuracy panel as a person uses it.
#include <algorithm>

#include "demo_window_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class AccuracyPanel : public DemoWindow {
 protected:
  explicit AccuracyPanel(const std::string& toml = windowScene) : DemoWindow(toml) {
    click("panel.Accuracy");
    demo_->setCapture(true);
  }
  const UiAccuracy& accuracy() { return demo_->model().accuracy; }

  template <typename Done>
  bool waitFor(const Done& done) {
    const auto end = Clock::now() + std::chrono::seconds(150);
    while (!done() && Clock::now() < end) {
      run(1);
    }
    return done();
  }

  void measure() {
    click("accuracy.measure");
    ASSERT_FALSE(accuracy().stage.empty());
    const int before = demo_->framesDrawn();
    ASSERT_TRUE(waitFor([&] { return accuracy().stage.empty() && !accuracy().points.empty(); }));
    EXPECT_GT(demo_->framesDrawn(), before + 5) << "the window goes on meanwhile";
    run(3);
  }
};

// Without a mirror there is little to vary, and the measurement is soon done.
class AccuracyPanelWithoutMirror : public AccuracyPanel {
 protected:
  AccuracyPanelWithoutMirror() : AccuracyPanel(windowScene.substr(0, windowScene.find("[[mirror]]"))) {}
};

TEST_F(AccuracyPanelWithoutMirror, MeasuresTheViewAndAppliesWhatIsClicked) {
  measure();
  const UiAccuracy& measured = accuracy();
  ASSERT_EQ(measured.points.size(), 2u) << "one sample and four";
  ASSERT_FALSE(measured.front.empty());
  EXPECT_GT(measured.noiseFloor, 0.0);
  for (const UiAccuracyPoint& point : measured.points) {
    EXPECT_GT(point.ms, 0.0) << point.name;
    EXPECT_GE(point.error, 0.0) << point.name;
  }
  // The most accurate point takes four samples; the window began with one.
  const int best = measured.front.back();
  EXPECT_NE(measured.current, best);
  click("accuracy.point " + measured.points[best].name);
  EXPECT_EQ(measured.current, best);
  EXPECT_EQ(demo_->model().settings.view.samples, 4);
  run(2);
  drag("accuracy.slider", 0.3, -static_cast<int>(widget("accuracy.slider").width * 0.4));
  EXPECT_EQ(measured.current, measured.front.front());
  ASSERT_GE(measured.current, 0);

  click("quality.max_error");
  run(3);
  EXPECT_NE(measured.choice.find("mean FLIP"), std::string::npos) << measured.choice;
  ASSERT_GE(measured.current, 0);
  EXPECT_LE(measured.points[measured.current].error,
            std::max(demo_->model().settings.quality.maxError, measured.points[best].error));
  expectQuiet();
}

TEST_F(AccuracyPanel, AMeasurementCanBeCancelled) {
  click("accuracy.measure");
  ASSERT_FALSE(accuracy().stage.empty());
  click("accuracy.cancel");
  run(2);
  EXPECT_TRUE(accuracy().stage.empty());
  EXPECT_TRUE(accuracy().points.empty());
  press("shift+n");
  press("Delete");
  press("F2");
  ASSERT_TRUE(demo_->model().edit.selected.kind == Selection::Kind::none);
  click("accuracy.measure");
  EXPECT_FALSE(accuracy().stage.empty()) << "and begun anew, with unsaved changes; closing the window ends it";
}

TEST_F(AccuracyPanel, TheDifferenceFromTheReferenceCoversThePicture) {
  const Pixels before = picture();
  click("accuracy.difference");
  ASSERT_TRUE(waitFor([&] { return accuracy().difference.find("mean FLIP") == 0; })) << accuracy().difference;
  run(2);
  const Pixels heat = picture();
  // The background is right: the darkest colour of the map, at the window's left edge below the panel.
  const size_t corner = 4 * (static_cast<size_t>(height - 3) * width + 3);
  EXPECT_NE(heat.rgba[corner], before.rgba[corner]);
  EXPECT_LT(heat.rgba[corner] + heat.rgba[corner + 1] + heat.rgba[corner + 2], 90);
  const std::string oneSample = accuracy().difference;
  const int grip = static_cast<int>(widget("reflection.max_depth").width * 0.3);
  drag("reflection.max_depth", 0.3, 3 - grip);
  EXPECT_TRUE(waitFor([&] { return accuracy().difference != oneSample; })) << "another setting, another difference";
  click("accuracy.difference");
  run(3);
  EXPECT_GT(picture().rgba[corner + 2], 90) << "the picture is back";
  expectQuiet();
}

}  // namespace
}  // namespace speculum
