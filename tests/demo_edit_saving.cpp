// Saving what was edited in the window, and the questions about what is not saved.
#include <fstream>
#include <sstream>

#include "demo_edit_support.hpp"
#include "frame/settings.hpp"

namespace speculum {
namespace {

using namespace testing_support;

TEST_F(EditWindow, WhatIsSavedIsDrawnToTheSameBytes) {
  clickBall();
  const glm::ivec2 center = pixel({0.3, 1.0, 0.5});
  dragPointer(center.x + 60, center.y, 33, 0);
  press("ctrl+d");
  EXPECT_TRUE(edit().unsaved);
  const std::vector<uint8_t> edited = bare();
  press("ctrl+s");
  EXPECT_FALSE(edit().unsaved) << edit().note;
  const Scene saved = onDisk();
  ASSERT_EQ(saved.objects.size(), 2u);
  EXPECT_NEAR(saved.objects[0].position.x, 0.3 + 33 / focalPixels, 2e-4);
  std::ifstream file(options_.scene);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("# In front of the eye."), std::string::npos) << "comments stay";
  expectQuiet();
  demo_.reset();
  start();
  press("Tab");
  EXPECT_EQ(edited, bare());
  expectQuiet();
}

TEST_F(EditWindow, ClosingAsksAboutUnsavedChanges) {
  clickBall();
  press("Delete");
  askToClose();
  click("edit.ask.cancel");
  run(20);
  EXPECT_FALSE(edit().asksSave);
  EXPECT_FALSE(demo_->window().shouldClose());
  askToClose();
  press("Escape");
  run(5);
  EXPECT_FALSE(edit().asksSave) << "Escape cancels";
  askToClose();
  answer("discard");
  EXPECT_TRUE(stepUntilClosed());
  EXPECT_EQ(onDisk().objects.size(), 1u) << "nothing was saved";
  expectQuiet();
}

TEST_F(EditWindow, SavingOnTheWayOutWritesTheScene) {
  clickBall();
  press("Delete");
  askToClose();
  answer("save");
  EXPECT_TRUE(stepUntilClosed());
  EXPECT_TRUE(onDisk().objects.empty());
  expectQuiet();
}

TEST_F(EditWindow, SavedAsAnotherFileTheSceneGoesOnThere) {
  clickBall();
  press("ctrl+d");
  press("ctrl+shift+s");
  ASSERT_TRUE(edit().asksWhere);
  run(5);
  const std::string other = std::filesystem::path(options_.scene).replace_filename("other.toml").string();
  std::ofstream(other) << "somebody's";
  xdotool({"type", "--window", windowId(), other});
  run(5);
  EXPECT_EQ(edit().saveAs, other);
  press("Return");
  EXPECT_TRUE(edit().asksWhere) << "a file that is there is not overwritten unasked";
  EXPECT_TRUE(edit().unsaved);
  press("Return");
  run(5);
  EXPECT_FALSE(edit().asksWhere) << edit().note;
  EXPECT_EQ(loadScene(other).objects.size(), 2u);
  EXPECT_EQ(onDisk().objects.size(), 1u);
  EXPECT_FALSE(edit().unsaved);
  EXPECT_EQ(edit().file, other);
  expectQuiet();
}

TEST_F(EditWindow, AnotherSceneIsChosenOnceUnsavedChangesAreAnswered) {
  press("Tab");
  press("n");
  press("Delete");
  const int shown = demo_->model().scene;
  const auto choose = [&] {
    click("scene");
    click("scene.no_mirror");
    run(3);
  };
  choose();
  ASSERT_TRUE(edit().asksSave);
  EXPECT_EQ(demo_->model().scene, shown);
  press("Escape");
  EXPECT_FALSE(edit().asksSave);
  EXPECT_TRUE(edit().unsaved);
  choose();
  ASSERT_TRUE(edit().asksSave);
  click("edit.ask.discard");
  waitFor([&] { return shownScene() == "no_mirror"; });
  EXPECT_FALSE(edit().unsaved);
  EXPECT_EQ(edit().undo, "");
  expectQuiet();
}

TEST_F(EditWindow, ASecondSaveKeepsTheSettingsOfTheFirst) {
  press("Tab");
  drag("view.exposure", 0.5, 30);
  const double exposure = demo_->model().settings.view.exposure;
  ASSERT_NE(exposure, 1.0);
  press("F2");
  EXPECT_FALSE(edit().unsaved);
  EXPECT_TRUE(edit().unsavedSettings);
  click("edit.save");
  EXPECT_FALSE(edit().unsavedSettings);
  EXPECT_EQ(settingsOf(onDisk()).view.exposure, exposure);
  press("F2");
  press("Tab");
  clickBall();
  press("Delete");
  press("ctrl+s");
  EXPECT_TRUE(onDisk().objects.empty());
  EXPECT_EQ(settingsOf(onDisk()).view.exposure, exposure);
  expectQuiet();
}

// Light work: what is shown is not looked at here.
Options plain() {
  Options options;
  options.settings = {{"effects.shadows", "false"}, {"view.samples", "1"}};
  return options;
}

class SavingAShippedScene : public EditWindow {
 protected:
  SavingAShippedScene() : EditWindow(plain()), before_(environment("XDG_DOCUMENTS_DIR")) {
    setEnvironment("XDG_DOCUMENTS_DIR", (config_.path() / "documents").string());
    demo_->openFile(shipped_);
    waitFor([&] { return shownScene() == "no_mirror"; });
  }
  ~SavingAShippedScene() override {
    setEnvironment("XDG_DOCUMENTS_DIR", before_);
    if (contents(shipped_) != shippedText_) {
      std::ofstream(shipped_) << shippedText_;  // a failure must not last
    }
  }

  static std::string contents(const std::filesystem::path& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  void deleteAThing() {
    press("n");
    press("Delete");
    ASSERT_TRUE(edit().unsaved);
  }
  void saveAs(const std::filesystem::path& file) {
    press("ctrl+shift+s");
    run(5);
    xdotool({"type", "--window", windowId(), file.string()});
    run(5);
    ASSERT_EQ(edit().saveAs, file.string());
    press("Return");
    run(3);
  }

  const std::filesystem::path shipped_ = dataDirectory("scenes") / "no_mirror.toml";
  const std::string shippedText_ = contents(shipped_);
  std::string before_;
};

TEST_F(SavingAShippedScene, GoesToAFileOfOnesOwnAndTheSecondTimeThereUnasked) {
  const std::filesystem::path own = config_.path() / "documents" / "Speculum" / "no_mirror.toml";
  deleteAThing();
  const size_t things = edit().things.size();
  press("ctrl+s");
  ASSERT_TRUE(edit().asksWhere);
  EXPECT_EQ(edit().saveAs, own.string());
  run(5);
  press("Return");
  run(3);
  ASSERT_FALSE(edit().asksWhere) << edit().note;
  EXPECT_EQ(edit().file, own.string());
  const auto thingsIn = [](const Scene& scene) {
    return scene.objects.size() + scene.mirrors.size() + scene.lights.size();
  };
  EXPECT_EQ(thingsIn(loadScene(own)), things);
  deleteAThing();
  press("ctrl+s");
  EXPECT_FALSE(edit().asksWhere) << edit().note;
  EXPECT_FALSE(edit().unsaved);
  EXPECT_EQ(thingsIn(loadScene(own)), things - 1);
  EXPECT_EQ(contents(shipped_), shippedText_);
  expectQuiet();
}

// Saved once more it would be overwritten, which is not for a test to do.
TEST_F(SavingAShippedScene, ItsOwnFileIsRefusedAtFirst) {
  deleteAThing();
  saveAs(shipped_);
  EXPECT_TRUE(edit().asksWhere);
  EXPECT_NE(edit().note.find("it comes with the program\nSave once more to overwrite it."), std::string::npos)
      << edit().note;
  press("Escape");
  EXPECT_FALSE(edit().asksWhere);
  EXPECT_TRUE(edit().unsaved);
  EXPECT_EQ(contents(shipped_), shippedText_);
  expectQuiet();
}

TEST_F(SavingAShippedScene, WhatWasRefusedIsRefusedAgainOnceTheQuestionWasLeft) {
  const std::filesystem::path other = config_.path() / "other.toml";
  std::ofstream(other) << "somebody's";
  deleteAThing();
  for (int i = 0; i < 2; ++i) {
    saveAs(other);
    EXPECT_TRUE(edit().asksWhere);
    EXPECT_NE(edit().note.find("Save once more to overwrite it."), std::string::npos) << edit().note;
    press("Escape");
  }
  EXPECT_EQ(contents(other), "somebody's");
  expectQuiet();
}

TEST_F(EditWindow, ThePathIsSelectedAtEveryOpening) {
  for (const std::string name : {"first", "second"}) {
    press("ctrl+shift+s");
    run(5);
    const auto place = std::filesystem::path(options_.scene).parent_path() / name;
    xdotool({"type", "--window", windowId(), (place / "scene").string()});
    run(5);
    EXPECT_EQ(edit().saveAs, (place / "scene").string()) << "what was there is replaced";
    press("Return");
    run(3);
    EXPECT_TRUE(edit().asksWhere);
    EXPECT_NE(edit().note.find("no folder " + place.string() + " "), std::string::npos) << edit().note;
    press("Escape");
    EXPECT_FALSE(edit().asksWhere);
  }
  press("ctrl+shift+s");
  run(5);
  const auto place = std::filesystem::path(options_.scene).replace_filename("named");
  xdotool({"type", "--window", windowId(), place.string()});
  run(5);
  press("Return");
  run(3);
  EXPECT_FALSE(edit().asksWhere) << edit().note;
  EXPECT_EQ(edit().file, place.string() + ".toml");
  expectQuiet();
}

TEST_F(EditWindow, UnsavedSettingsAreAskedAbout) {
  press("Tab");
  drag("view.exposure", 0.5, 30);
  EXPECT_FALSE(edit().unsaved);
  askToClose();
  press("Escape");
  run(3);
  EXPECT_FALSE(edit().asksSave);
  drag("view.exposure", 0.5, -60);
  askToClose();
  answer("discard");
  EXPECT_TRUE(stepUntilClosed());
  expectQuiet();
}

TEST_F(EditWindow, TapsBetweenTwoFramesReachTheTextField) {
  press("ctrl+shift+s");
  run(5);
  // All of it before the next frame.
  xdotool({"type", "--window", windowId(), "--delay", "1", "abcd"});
  xdotool({"key", "--window", windowId(), "--delay", "1", "BackSpace", "BackSpace", "Left", "x"});
  run(15);
  EXPECT_EQ(edit().saveAs, "axb");
  press("Escape");
  expectQuiet();
}

TEST_F(EditWindow, AFileThatSomebodyElseChangedIsNotOverwrittenUnasked) {
  clickBall();
  press("Delete");
  std::ofstream(options_.scene, std::ios::app) << "# written meanwhile\n";
  press("ctrl+s");
  EXPECT_TRUE(edit().asksWhere) << edit().note;
  EXPECT_EQ(onDisk().objects.size(), 1u);
  press("Escape");
  EXPECT_TRUE(edit().unsaved);
  expectQuiet();
}

TEST_F(EditWindow, WhatIsSelectedDoesNotOutliveItsScene) {
  press("Tab");
  press("shift+n");  // the last thing, the mirror behind: no_mirror has none
  ASSERT_TRUE(edit().selected);
  click("scene");
  click("scene.no_mirror");
  waitFor([&] { return shownScene() == "no_mirror"; });
  EXPECT_FALSE(edit().selected);
  press("b");  // no mirror to look from
  expectQuiet();
}

TEST_F(EditWindow, AMirrorThatWasDeletedIsNotLookedFrom) {
  press("b");
  while (!demo_->model().edit.things.empty()) {
    press("n");
    press("Delete");
  }
  press("b");
  expectQuiet();
}

}  // namespace
}  // namespace speculum
