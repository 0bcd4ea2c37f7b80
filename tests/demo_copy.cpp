// The command line that the window copies draws what the window shows.
#include "app/screenshot.hpp"
#include "demo_window_support.hpp"
#include "frame/settings.hpp"
#include "image/picture_files.hpp"
#include "scene/scene_loader.hpp"
#include "test_paths.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// The mirror turns, and every reflection with it.
const std::string turning = windowScene + "spin = [0, 90, 0]\n";

class CopiedCommand : public DemoWindow {
 protected:
  CopiedCommand() : DemoWindow(turning) {}

  const std::string& said() { return demo_->model().status.text; }
  // What the copied command draws, run as a person would.
  Image8 drawn() {
    click("copy");
    const std::string command = demo_->window().clipboard();
    EXPECT_EQ(said().find("copied: " + command), 0u) << said();
    const ProcessResult result = runProcess(
        {"bash", "-c", "cd '" + out_.path().string() + "' && PATH=" + binaryDir().string() + ":$PATH && " + command});
    EXPECT_EQ(result.exitCode, 0) << command << "\n" << result.output;
    const std::filesystem::path file = out_.path() / "demo_window.png";
    EXPECT_TRUE(std::filesystem::exists(file)) << command;
    return readImage8(file);
  }
  // What the window shows without its panel.
  Image8 shown() {
    press("Tab");
    press("Escape");  // the message
    Image8 image = pictureOf(picture());
    press("Tab");
    return image;
  }
  void expectSame() {
    const Image8 window = shown();
    const Image8 command = drawn();
    ASSERT_EQ(command.width, window.width) << said();
    EXPECT_EQ(command.rgba, window.rgba) << said();
  }

  TemporaryDirectory out_;
};

TEST_F(CopiedCommand, DrawsTheSceneAtThatTime) {
  press("space");
  expectSame();
  EXPECT_EQ(said().find("--camera"), std::string::npos) << "the camera is the scene's";
  expectQuiet();
}

TEST_F(CopiedCommand, DrawsUnsavedChangesFromACopyOfTheScene) {
  press("space");
  press("shift+n");
  ASSERT_EQ(demo_->model().edit.selected.kind, Selection::Kind::object);
  press("Delete");
  press("F2");
  expectSame();
  EXPECT_NE(said().find("unsaved changes"), std::string::npos) << said();
  EXPECT_EQ(loadScene(options_.scene).objects.size(), 1u) << "the scene's own file is as it was";
  press("ctrl+z");
  press("Escape");
  expectSame();
  EXPECT_EQ(said(), "copied: " + demo_->window().clipboard());
  expectQuiet();
}

// What is saved with the scene the command leaves to the file, which is a copy as long as something else is not saved.
TEST_F(CopiedCommand, CarriesSettingsThatWereSavedWithTheScene) {
  press("space");
  drag("view.exposure", 0.5, -12);
  press("ctrl+s");
  ASSERT_NE(settingsOf(loadScene(options_.scene)).view.exposure, 1.0) << demo_->model().edit.note;
  expectSame();
  EXPECT_EQ(said().find("view.exposure"), std::string::npos) << said();
  drag("view.clear_color", 0.1, 30);
  expectSame();
  EXPECT_NE(said().find("view.clear_color="), std::string::npos) << said();
  press("shift+n");
  press("Delete");
  press("F2");
  expectSame();
  EXPECT_NE(said().find("unsaved changes"), std::string::npos) << said();
  expectQuiet();
}

TEST_F(CopiedCommand, DrawsTheCameraTheSizeAndTheSettings) {
  press("space");
  drag("view.exposure", 0.5, -12);
  drag("view.clear_color", 0.1, 30);
  moveTo(width - 100, 80);
  xdotool({"mousedown", "1"});
  run(2);
  moveTo(width - 180, 110);
  xdotool({"mouseup", "1"});
  demo_->window().resize(777, 555);
  run(5);
  const Image8 before = shown();
  expectSame();
  const std::string command = said();
  for (const char* part : {"--size 777x555", "--camera ", "view.exposure=", "view.clear_color="}) {
    EXPECT_NE(command.find(part), std::string::npos) << part << " in " << command;
  }
  EXPECT_EQ(command.find("view.continuous"), std::string::npos) << "that is the window's own";
  for (int i = 0; i < 6; ++i) {
    press("period");
  }
  EXPECT_NE(before.rgba, shown().rgba);
  expectSame();
  expectQuiet();
}

}  // namespace
}  // namespace speculum
