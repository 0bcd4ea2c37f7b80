// What the keys of the window do, pressed as X events.
#include <algorithm>
#include <fstream>
#include <sstream>

#include "app/screenshot.hpp"
#include "demo_window_support.hpp"
#include "image/picture_files.hpp"
#include "ui/panels.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class DemoKeys : public DemoWindow {
 protected:
  DemoKeys() : before_(environment("XDG_PICTURES_DIR")) {
    setEnvironment("XDG_PICTURES_DIR", (config_.path() / "pictures").string());
  }
  ~DemoKeys() override { setEnvironment("XDG_PICTURES_DIR", before_); }

  // The one that is there more than before.
  Image8 newPicture(const std::string& key) {
    std::vector<std::filesystem::path> had = pictures();
    press(key);
    for (const std::filesystem::path& file : pictures()) {
      if (std::find(had.begin(), had.end(), file) == had.end()) {
        EXPECT_EQ(demo_->model().status.text, "saved " + file.string());
        return readImage8(file);
      }
    }
    ADD_FAILURE() << key << " saved no picture: " << demo_->model().status.text;
    return {};
  }
  std::vector<std::filesystem::path> pictures() {
    std::error_code none;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(config_.path() / "pictures" / "Speculum", none)) {
      files.push_back(entry.path());
    }
    return files;
  }

  std::string before_;
};

TEST_F(DemoKeys, PicturesAreSavedWithAndWithoutThePanel) {
  const Image8 window = newPicture("F12");
  const Image8 bare = newPicture("shift+F12");
  ASSERT_EQ(window.width, width);
  ASSERT_EQ(bare.height, height);
  EXPECT_NE(window.rgba, bare.rgba);
  press("Tab");
  EXPECT_NE(bare.rgba, pictureOf(picture()).rgba) << "the message about the last one";
  EXPECT_EQ(bare.rgba, newPicture("F12").rgba) << "which is in no picture";
  press("Escape");
  EXPECT_EQ(bare.rgba, pictureOf(picture()).rgba) << "what the window shows with its panel hidden";
  EXPECT_EQ(pictures().size(), 3u);
  expectQuiet();
}

TEST_F(DemoKeys, MessagesAreReadWithThePanelHidden) {
  press("space");
  press("Tab");
  const Pixels before = picture();
  press("ctrl+z");
  ASSERT_EQ(demo_->model().status.text, "nothing to undo");
  const Pixels with = picture();
  int left = width, right = 0, top = height, bottom = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const size_t at = 4 * (static_cast<size_t>(y) * width + x);
      if (!std::equal(&with.rgba[at], &with.rgba[at] + 3, &before.rgba[at])) {
        left = std::min(left, x);
        right = std::max(right, x);
        top = std::min(top, y);
        bottom = std::max(bottom, y);
      }
    }
  }
  EXPECT_LT(left, 30);
  EXPECT_LT(right, 200) << "no wider than it needs to be";
  EXPECT_GT(right, 100);
  EXPECT_GT(top, height - 40);
  EXPECT_LT(bottom, height);
  const auto end = Clock::now() + std::chrono::seconds(15);
  bool faded = false;
  while (!demo_->model().status.text.empty() && Clock::now() < end) {
    run(1);
    const Pixels now = picture();
    faded = faded || (now.rgba != with.rgba && now.rgba != before.rgba);
  }
  run(2);
  EXPECT_TRUE(faded) << "little by little";
  EXPECT_EQ(before.rgba, picture().rgba);
  expectQuiet();
}

TEST_F(DemoKeys, ARecordingWithThePanelHiddenHasNoMessages) {
  press("space");
  press("Tab");
  const Image8 plain = pictureOf(picture());
  press("ctrl+z");
  press("F10");
  press("F10");
  const std::filesystem::path folder = pictures().front();
  for (const char* name : {"00000.png", "00002.png"}) {
    EXPECT_EQ(readImage8(folder / name).rgba, plain.rgba) << name;
  }
  EXPECT_NE(demo_->model().status.text.find("recorded "), std::string::npos);
  expectQuiet();
}

TEST_F(DemoKeys, MessagesPushNoWidgetAndFade) {
  const PixelRect before = widget("view.exposure");
  click("screenshot");
  EXPECT_EQ(pictures().size(), 1u);
  EXPECT_EQ(demo_->model().status.text.rfind("saved ", 0), 0u) << demo_->model().status.text;
  EXPECT_EQ(widget("view.exposure").y, before.y);
  const auto end = Clock::now() + std::chrono::seconds(15);
  while (!demo_->model().status.text.empty() && Clock::now() < end) {
    run(1);
  }
  EXPECT_EQ(demo_->model().status.text, "");
  EXPECT_NE(demo_->model().log.history->lines().back().text.find("saved "), std::string::npos) << "the log keeps it";
  expectQuiet();
}

TEST_F(DemoKeys, APictureThatCannotBeSavedSaysSo) {
  std::ofstream(config_.path() / "pictures") << "a file in the folder's place";
  press("F12");
  EXPECT_EQ(demo_->model().status.text.rfind("not saved: ", 0), 0u) << demo_->model().status.text;
  expectQuiet();
}

TEST_F(DemoKeys, FullScreenAndBack) {
  const auto waitFor = [&](uint32_t wanted) {
    const auto end = Clock::now() + std::chrono::seconds(5);
    while (demo_->renderer().displayExtent().width != wanted && Clock::now() < end) {
      ASSERT_TRUE(demo_->step());
    }
    EXPECT_EQ(demo_->renderer().displayExtent().width, wanted);
  };
  press("F11");
  waitFor(1280);
  EXPECT_TRUE(demo_->window().fullScreen());
  press("F11");
  waitFor(width);
  EXPECT_EQ(demo_->renderer().displayExtent().height, static_cast<uint32_t>(height));
  EXPECT_FALSE(demo_->window().fullScreen());
  expectQuiet();
}

TEST_F(DemoKeys, TimeIsPausedSteppedAndScaled) {
  const UiModel& model = demo_->model();
  press("space");
  ASSERT_TRUE(model.paused);
  const double start = model.time;
  run(5);
  EXPECT_EQ(model.time, start);
  press("period");
  press("period");
  EXPECT_NEAR(model.time, start + 2.0 / 60.0, 1e-12);
  press("comma");
  EXPECT_NEAR(model.time, start + 1.0 / 60.0, 1e-12);
  press("bracketleft");
  EXPECT_EQ(model.timeSpeed, 0.5);
  press("bracketright");
  press("bracketright");
  press("bracketright");
  EXPECT_EQ(model.timeSpeed, 4.0);
  press("space");
  EXPECT_FALSE(model.paused);
  const double going = model.time;
  double passed = 0.0;
  for (int frame = 0; frame < 20; ++frame) {
    const auto begun = Clock::now();
    run(1);
    // A longer pause is none of the animation's business.
    passed += std::min(0.1, std::chrono::duration<double>(Clock::now() - begun).count());
  }
  EXPECT_GT(model.time - going, 2.0 * passed);
  EXPECT_LT(model.time - going, 6.0 * passed);
  press("period");
  EXPECT_TRUE(model.paused) << "a step pauses";
  for (int i = 0; i < 20; ++i) {
    press("bracketleft");
  }
  EXPECT_EQ(model.timeSpeed, slowestTime);
  expectQuiet();
}

TEST_F(DemoKeys, TheTimeRowScrubsAndSteps) {
  const UiModel& model = demo_->model();
  click("pause");
  ASSERT_TRUE(model.paused);
  drag("time", 0.05, 150);
  const double there = model.time;
  EXPECT_GT(there, 5.0);
  EXPECT_LT(there, 20.0);
  click("time.on");
  EXPECT_NEAR(model.time, there + 1.0 / 60.0, 1e-12);
  click("time.back");
  click("time.back");
  EXPECT_NEAR(model.time, there - 1.0 / 60.0, 1e-12);
  drag("time.speed", 0.5, 30);
  EXPECT_GT(model.timeSpeed, 1.0);
  expectQuiet();
}

class OtherKeyboards : public DemoKeys {
 protected:
  void layout(const std::vector<std::string>& names) {
    std::vector<std::string> command = {"setxkbmap"};
    command.insert(command.end(), names.begin(), names.end());
    ASSERT_EQ(runProcess(command).exitCode, 0);
    run(5);
  }
  // By what is printed on it.
  void hold(const std::string& key) {
    xdotool({"keydown", "--window", windowId(), key});
    run(4);
    xdotool({"keyup", "--window", windowId(), key});
    run(3);
  }
  glm::dvec3 eye() { return demo_->camera().eye; }
};

TEST_F(OtherKeyboards, OnDvorakWhatFliesDoesNotStepAndTimeIsSteppedBeside) {
  layout({"us", "-variant", "dvorak"});
  press("space");
  ASSERT_TRUE(demo_->model().paused);
  const glm::dvec3 before = eye();
  press("v");  // where an American keyboard has the full stop
  const double time = demo_->model().time;
  press("v");
  EXPECT_NEAR(demo_->model().time, time + timeStep, 1e-12);
  press("w");  // where it has the comma
  press("w");
  EXPECT_NEAR(demo_->model().time, time - timeStep, 1e-12);
  press("space");
  press("space");
  EXPECT_EQ(eye(), before) << "nothing of it flies";
  const double still = demo_->model().time;
  hold("comma");
  const glm::dvec3 forwards = eye();
  EXPECT_LT(forwards.z, before.z - 1e-3);
  hold("period");
  EXPECT_GT(eye().y, forwards.y + 1e-3);
  EXPECT_EQ(demo_->model().time, still);
  expectQuiet();
}

TEST_F(OtherKeyboards, OnColemakTheSceneIsFramedWhereAnAmericanKeyboardDoes) {
  layout({"us", "-variant", "colemak"});
  const glm::dvec3 before = eye();
  hold("f");
  const glm::dvec3 up = eye();
  EXPECT_GT(up.y, before.y + 1e-3);
  EXPECT_NEAR(up.z, before.z, 1e-9);
  press("t");
  EXPECT_GT(glm::distance(eye(), up), 0.1);
  expectQuiet();
}

TEST_F(DemoKeys, FLooksAtTheWholeScene) {
  const glm::dvec3 before = demo_->camera().eye;
  press("f");
  const CameraPose camera = demo_->camera();
  EXPECT_GT(glm::distance(camera.eye, before), 0.1);
  // The ends of the wall mirror, 5 m x 3 m at (0, 1, -2).
  const double half = std::tan(0.5 * camera.verticalFov);
  for (const glm::dvec3& corner : {glm::dvec3(-2.5, -0.5, -2.0), glm::dvec3(2.5, 2.5, -2.0)}) {
    const glm::dvec3 seen = camera.worldToView * (corner - camera.eye);
    EXPECT_LT(seen.z, 0.0);
    EXPECT_LT(std::abs(seen.y / seen.z), half);
    EXPECT_LT(std::abs(seen.x / seen.z), half * width / height);
  }
  expectQuiet();
}

TEST_F(DemoKeys, HelpListsTheKeys) {
  const Pixels before = picture();
  press("F1");
  EXPECT_TRUE(demo_->model().help);
  const size_t middle = 4 * (static_cast<size_t>(height / 2) * width + width / 2);
  const Pixels with = picture();
  EXPECT_FALSE(std::equal(before.rgba.begin() + middle, before.rgba.begin() + middle + 40, with.rgba.begin() + middle));
  press("F1");
  EXPECT_FALSE(demo_->model().help);
  expectQuiet();
}

TEST_F(DemoKeys, EscapeClosesWhatIsOnTopAndNeverQuits) {
  const auto shown = [&](const std::string& key) {
    const auto& widgets = demo_->model().widgets;
    return std::any_of(widgets.begin(), widgets.end(), [&](const auto& widget) { return widget.first == key; });
  };
  press("n");
  click("scene");
  ASSERT_TRUE(shown("scene.no_mirror"));
  press("Escape");
  EXPECT_FALSE(shown("scene.no_mirror")) << "the list of scenes";
  EXPECT_TRUE(demo_->model().edit.open);
  press("F1");
  press("Escape");
  EXPECT_FALSE(demo_->model().help);
  EXPECT_TRUE(demo_->model().edit.open);
  press("Escape");
  EXPECT_FALSE(demo_->model().edit.open);
  EXPECT_TRUE(demo_->model().edit.selected);
  press("Escape");
  EXPECT_FALSE(demo_->model().edit.selected);
  press("Escape");
  EXPECT_FALSE(demo_->window().shouldClose());
  expectQuiet();
}

TEST_F(DemoKeys, AClickBelongsToWhatIsUnderItsOwnPosition) {
  press("n");
  ASSERT_TRUE(demo_->model().edit.selected);
  const PixelRect box = widget("pause");
  const auto x = std::to_string(box.x + box.width / 2);
  const auto y = std::to_string(box.y + box.height / 2);
  for (const bool paused : {true, false}) {
    moveTo(width / 2, 30);
    // All before the next frame.
    xdotool({"mousemove", "--window", windowId(), x, y, "mousedown", "1", "mouseup", "1", "mousemove", "--window",
             windowId(), std::to_string(width / 2), "30"});
    run(5);
    EXPECT_TRUE(demo_->model().edit.selected) << "no click into the picture";
    EXPECT_EQ(demo_->model().paused, paused);
  }
  expectQuiet();
}

TEST(KeyHelpList, IsInTheDocs) {
  std::ifstream file(sourceFile("docs/window.md"));
  std::stringstream docs;
  docs << file.rdbuf();
  ASSERT_GT(panels::keyHelp().size(), 10u);
  std::vector<panels::KeyHelp> all(panels::keyHelp().begin(), panels::keyHelp().end());
  all.insert(all.end(), panels::gamepadHelp().begin(), panels::gamepadHelp().end());
  for (const panels::KeyHelp& key : all) {
    EXPECT_NE(docs.str().find("| `" + std::string(key.keys) + "` | " + key.what + " |"), std::string::npos)
        << "| `" << key.keys << "` | " << key.what << " |";
  }
}

TEST(CameraControl, FramesASphereInPicturesOfAnyShape) {
  CameraSpec spec;
  spec.position = {1.0, 2.0, 3.0};
  spec.target = {0.0, 0.5, 0.0};
  const CameraPose start = lookAt(spec.position, spec.target, spec.up, spec.verticalFov, spec.near);
  const Sphere sphere{{5.0, -2.0, 1.0}, 3.0};
  for (const double aspect : {0.25, 1.0, 4.0}) {
    CameraController camera;
    camera.reset(spec);
    camera.pose(start);
    camera.frame(sphere, aspect);
    const CameraPose pose = camera.pose(start);
    const glm::dvec3 seen = pose.worldToView * (sphere.center - pose.eye);
    EXPECT_NEAR(seen.x, 0.0, 1e-9);
    EXPECT_NEAR(seen.y, 0.0, 1e-9);
    // The sphere touches the nearer pair of the frustum's sides.
    const double half = 0.5 * pose.verticalFov;
    const double narrower = std::min(half, std::atan(std::tan(half) * aspect));
    EXPECT_NEAR(-seen.z * std::sin(narrower), sphere.radius, 1e-9);
    EXPECT_NEAR(glm::distance(pose.worldToView[0], start.worldToView[0]), 0.0, 1e-9) << "the direction stays";
  }
}

TEST(CameraControl, ADragOfNinetyPixelsTurnsByLessThanThirtyDegreesAndStopsBeforeThePole) {
  CameraSpec spec;
  spec.position = {0.0, 2.0, 4.0};
  spec.target = {0.0, 1.0, 0.0};
  const CameraPose start = lookAt(spec.position, spec.target, spec.up, spec.verticalFov, spec.near);
  for (const CameraMode mode : {CameraMode::orbit, CameraMode::fly}) {
    CameraController camera;
    camera.setMode(mode);
    camera.reset(spec);
    const auto forward = [&] { return -glm::dvec3(glm::transpose(camera.pose(start).worldToView)[2]); };
    const glm::dvec3 before = forward();
    camera.drag(0.0, 90.0);
    const double turned = glm::degrees(std::acos(glm::dot(before, forward())));
    EXPECT_GT(turned, 5.0);
    EXPECT_LT(turned, 30.0);
    for (const double way : {1.0, -1.0}) {
      camera.drag(0.0, way * 5000.0);
      const double pitch = glm::degrees(std::asin(forward().y));
      EXPECT_GT(std::abs(pitch), 80.0) << "as far as it goes, in one large step too";
      EXPECT_LT(std::abs(pitch), 89.0);
      EXPECT_LT(pitch * way, 0.0) << "down to look up, in both modes";
    }
  }
}

}  // namespace
}  // namespace speculum
