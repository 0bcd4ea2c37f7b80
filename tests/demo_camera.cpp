// The camera by pointer, keys and gamepad, and recording.
#include <fstream>

#include "app/screenshot.hpp"
#include "demo_window_support.hpp"
#include "image/picture_files.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class DemoCamera : public DemoWindow {
 protected:
  DemoCamera() : before_(environment("XDG_PICTURES_DIR")) {
    setEnvironment("XDG_PICTURES_DIR", (config_.path() / "pictures").string());
    demo_->setGamepadSource([this] { return pad_; });
  }
  ~DemoCamera() override { setEnvironment("XDG_PICTURES_DIR", before_); }

  void pressPad(GamepadButton button) {
    pad_ = GamepadState{};
    pad_->buttons[static_cast<size_t>(button)] = true;
    run(3);
    pad_ = GamepadState{};
    run(3);
  }
  std::vector<std::filesystem::path> saved() {
    std::error_code none;
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(config_.path() / "pictures" / "Speculum", none)) {
      paths.push_back(entry.path());
    }
    return paths;
  }
  glm::dvec3 eye() { return demo_->camera().eye; }
  glm::dvec3 forward() { return -glm::dvec3(glm::transpose(demo_->camera().worldToView)[2]); }

  std::optional<GamepadState> pad_;
  std::string before_;
};

TEST_F(DemoCamera, TheMiddleButtonPans) {
  const glm::dvec3 before = eye();
  const glm::dvec3 looked = forward();
  moveTo(600, 400);
  xdotool({"mousedown", "2"});
  run(3);
  moveTo(700, 350);
  xdotool({"mouseup", "2"});
  run(3);
  // The target is 4 m away and the picture 700 pixels high at 60 degrees.
  const double metresPerPixel = 2.0 * std::tan(glm::radians(30.0)) * 4.0 / height;
  EXPECT_NEAR(glm::distance(eye(), before + glm::dvec3(-100.0, -50.0, 0.0) * metresPerPixel), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(forward(), looked), 0.0, 1e-9);
  moveTo(600, 400);
  EXPECT_NEAR(glm::distance(eye(), before + glm::dvec3(-100.0, -50.0, 0.0) * metresPerPixel), 0.0, 1e-9) << "let go";
  expectQuiet();
}

TEST_F(DemoCamera, SticksAndTriggersMoveAndTurn) {
  const glm::dvec3 before = eye();
  pad_ = GamepadState{.leftY = -1.0f};
  run(5);
  EXPECT_LT(eye().z, before.z) << "forwards";
  EXPECT_NEAR(eye().x, before.x, 1e-9);
  pad_ = GamepadState{.rightTrigger = 1.0f};
  run(5);
  EXPECT_GT(eye().y, before.y) << "up";
  pressPad(GamepadButton::leftStick);
  EXPECT_EQ(eye(), before) << "back to the scene's camera";
  pressPad(GamepadButton::b);
  EXPECT_EQ(demo_->model().cameraMode, CameraMode::fly);
  pad_ = GamepadState{.rightX = 1.0f};
  run(5);
  EXPECT_GT(forward().x, 0.0) << "to the right";
  EXPECT_NEAR(glm::distance(eye(), before), 0.0, 1e-9);
  pad_ = GamepadState{};
  run(2);
  const glm::dvec3 still = forward();
  run(5);
  EXPECT_EQ(forward(), still);
  expectQuiet();
}

TEST_F(DemoCamera, ButtonsDoWhatTheHelpSays) {
  const UiModel& model = demo_->model();
  pressPad(GamepadButton::start);
  EXPECT_TRUE(model.paused);
  pressPad(GamepadButton::start);
  EXPECT_FALSE(model.paused);
  pressPad(GamepadButton::rightBumper);
  EXPECT_TRUE(model.paused);
  const double time = model.time;
  pressPad(GamepadButton::leftBumper);
  EXPECT_NEAR(model.time, time - timeStep, 1e-12);
  const Pixels with = picture();
  pressPad(GamepadButton::back);
  EXPECT_NE(picture().rgba, with.rgba) << "the panel is hidden";
  const glm::dvec3 before = eye();
  pressPad(GamepadButton::a);
  EXPECT_GT(glm::distance(eye(), before), 0.1);
  pressPad(GamepadButton::y);
  EXPECT_LT(eye().z, -2.0) << "behind the mirror";
  pressPad(GamepadButton::x);
  EXPECT_GT(eye().z, -2.0) << "before it";
  pressPad(GamepadButton::rightStick);
  EXPECT_EQ(saved().size(), 1u);
  expectQuiet();
}

TEST_F(DemoCamera, BLooksFromBehindAMirrorAndOutOfIt) {
  press("b");
  EXPECT_LT(eye().z, -2.0);
  EXPECT_NEAR(glm::distance(forward(), glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-9);
  // All of its 5 m x 3 m at (0, 1, -2) is in the picture.
  const CameraPose camera = demo_->camera();
  const double half = std::tan(0.5 * camera.verticalFov);
  for (const glm::dvec3& corner : {glm::dvec3(-2.5, -0.5, -2.0), glm::dvec3(2.5, 2.5, -2.0)}) {
    const glm::dvec3 seen = camera.worldToView * (corner - camera.eye);
    EXPECT_LT(std::abs(seen.y / seen.z), half);
    EXPECT_LT(std::abs(seen.x / seen.z), half * width / height);
  }
  press("shift+b");
  EXPECT_NEAR(eye().z, -2.0 + 0.01, 1e-9);
  EXPECT_NEAR(forward().z, 1.0, 1e-9);
  expectQuiet();
}

TEST_F(DemoCamera, BookmarksAreGoneBackToAndSavedWithTheScene) {
  press("f");
  const CameraPose framed = demo_->camera();
  press("m");
  press("b");
  press("m");
  ASSERT_EQ(demo_->model().bookmarks.size(), 2u);
  EXPECT_NE(demo_->model().bookmarks[0], demo_->model().bookmarks[1]);
  press("shift+M");
  EXPECT_NEAR(glm::distance(eye(), framed.eye), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(demo_->camera().worldToView[0], framed.worldToView[0]), 0.0, 1e-9);
  press("ctrl+s");
  const Scene saved = loadScene(sceneDirectory() / "demo_window.toml");
  ASSERT_EQ(saved.bookmarks.size(), 2u);
  EXPECT_EQ(saved.bookmarks[0].position, framed.eye);
  click("bookmark.remove");
  EXPECT_EQ(demo_->model().bookmarks.size(), 1u);
  expectQuiet();
}

TEST_F(DemoCamera, RecordsAnEvenSequence) {
  press("F10");
  const double start = demo_->model().time;
  run(6);
  const double passed = demo_->model().time - start;
  press("F10");
  ASSERT_EQ(saved().size(), 1u);
  EXPECT_NEAR(passed, 6.0 / Recorder::framesPerSecond, 1e-9) << "however long the frames took";
  const std::filesystem::path folder = saved().front();
  const Image8 first = readImage8(folder / "00000.png");
  EXPECT_EQ(first.width, width);
  EXPECT_TRUE(std::filesystem::exists(folder / "00006.png"));
  EXPECT_NE(demo_->model().status.text.find(folder.string()), std::string::npos) << demo_->model().status.text;
  const auto count = [&] { return std::distance(std::filesystem::directory_iterator(folder), {}); };
  const auto recorded = count();
  run(5);
  EXPECT_EQ(count(), recorded) << "ended";
  expectQuiet();
}

TEST_F(DemoCamera, RecordsWithoutThePanel) {
  press("shift+F10");
  press("shift+F10");
  ASSERT_EQ(saved().size(), 1u);
  press("Tab");
  press("Escape");  // the message
  EXPECT_EQ(readImage8(saved().front() / "00001.png").rgba, pictureOf(picture()).rgba);
  expectQuiet();
}

TEST_F(DemoCamera, ARecordingThatCannotBeginSaysSo) {
  std::ofstream(config_.path() / "pictures") << "a file in the folder's place";
  press("F10");
  EXPECT_EQ(demo_->model().status.text.rfind("not recorded: ", 0), 0u) << demo_->model().status.text;
  expectQuiet();
}

TEST(CameraLook, FromAFloorMirrorLeansTheWayTheCameraLooks) {
  CameraSpec spec;
  spec.position = {0.0, 2.0, 5.0};
  const CameraPose start = lookAt(spec.position, spec.target, spec.up, spec.verticalFov, spec.near);
  MirrorState floor;
  floor.polygon = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}};
  floor.normal = {0, 1, 0};
  for (const auto side : {CameraController::MirrorSide::back, CameraController::MirrorSide::front}) {
    CameraController camera;
    camera.reset(spec);
    camera.pose(start);
    camera.lookFrom(floor, side, 1.5);
    const CameraPose pose = camera.pose(start);
    EXPECT_EQ(pose.eye.y > 0.0, side == CameraController::MirrorSide::front);
    EXPECT_GT(pose.worldToView[1][2], -1.0);
    const glm::dvec3 forward = -glm::dvec3(glm::transpose(pose.worldToView)[2]);
    EXPECT_GT(forward.y, 0.9);
    EXPECT_LT(forward.z, -0.1) << "the top of the picture is towards where the camera came from";
  }
}

TEST(Gamepad, SticksRestAndBeginWithoutAJump) {
  EXPECT_EQ(outOfRest(0.2f), 0.0f);
  EXPECT_EQ(outOfRest(-0.25f), 0.0f);
  EXPECT_FALSE(std::signbit(outOfRest(-0.1f)));
  EXPECT_NEAR(outOfRest(0.26f), 0.0133f, 1e-3f);
  EXPECT_EQ(outOfRest(1.0f), 1.0f);
  EXPECT_EQ(outOfRest(-1.0f), -1.0f);
}

}  // namespace
}  // namespace speculum
