// Files that are dropped on the window.
#include <gtest/gtest.h>

#include <fstream>

#include "demo_window_support.hpp"
#include "test_paths.hpp"

namespace speculum {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

// Light work: what is shown is not looked at closely here.
Options plain() {
  Options options;
  options.settings = {{"effects.shadows", "false"}, {"view.samples", "1"}, {"reflection.samples", "1"}};
  return options;
}

// Much to read, little to draw.
void writeLarge(const fs::path& file, int vertices) {
  std::string obj;
  for (int i = 0; i < vertices; ++i) {
    obj += "v 0 0 0\n";
  }
  std::ofstream(file) << obj << "v 1 0 0\nv 0 1 0\nf -3 -2 -1\n";
}

class DemoOpen : public DemoWindow {
 protected:
  DemoOpen() : DemoWindow(windowScene, plain(), 4) {}

  // Draws until nothing is loaded any more; returns the frames that it took.
  int wait() {
    int frames = 0;
    run(2);
    for (; !demo_->model().loading.empty() && frames < 2000; ++frames) {
      run(1);
    }
    run(4);
    return frames;
  }

  std::string model(const std::string& name) { return sourceDir().string() + "/models/" + name; }

  std::string shown() { return demo_->model().scenes.at(demo_->model().scene); }
};

TEST_F(DemoOpen, AModelTakesThePlaceOfTheScene) {
  const auto before = background();
  const size_t scenes = demo_->model().scenes.size();
  demo_->window().dropFiles({"/notes.txt", model("queen.obj")});
  wait();
  EXPECT_EQ(demo_->model().message, "");
  EXPECT_EQ(shown(), "queen.obj");
  EXPECT_EQ(demo_->model().scenes.size(), scenes + 1);
  EXPECT_NE(background(), before) << "its sky";
  demo_->window().dropFiles({model("queen.obj")});
  wait();
  EXPECT_EQ(demo_->model().scenes.size(), scenes + 1) << "the same file again";
  expectQuiet();
}

TEST_F(DemoOpen, ASceneIsReadWhileTheWindowGoesOn) {
  const fs::path folder = config_.path() / "scenes";
  fs::create_directories(folder);
  writeLarge(folder / "large.obj", 600000);
  writeLarge(folder / "larger.obj", 4000000);
  std::ofstream(folder / "dropped.toml")
      << "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n[[object]]\nmodel = 'large.obj'\n";
  demo_->openFile(folder / "dropped.toml");
  const int drawn = demo_->framesDrawn();
  run(2);
  EXPECT_EQ(demo_->model().loading, "large.obj");
  EXPECT_EQ(shown(), fs::path(options_.scene).stem()) << "the scene stays until the other is there";
  EXPECT_GT(wait(), 0);
  EXPECT_GT(demo_->framesDrawn(), drawn + 2);
  EXPECT_EQ(shown(), "dropped");
  EXPECT_EQ(demo_->model().message, "");

  demo_->openFile(folder / "larger.obj");
  run(2);
  ASSERT_EQ(demo_->model().loading, "larger.obj");
  click("loading.cancel");
  run(3);
  EXPECT_EQ(demo_->model().loading, "") << "cancelled";
  EXPECT_EQ(shown(), "dropped");
  EXPECT_EQ(demo_->model().message, "") << "which is no error";
  expectQuiet();
}

TEST_F(DemoOpen, TheFolderOfAnOpenedSceneIsListedFirst) {
  const UiModel& ui = demo_->model();
  const fs::path own = fs::path(options_.scene).parent_path();
  EXPECT_EQ(fs::path(ui.scenePaths.front()).parent_path(), own);
  for (const char* name : {"b_scene", "a_scene"}) {
    std::ofstream(config_.path() / (std::string(name) + ".toml"))
        << "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n";
  }
  std::ofstream(config_.path() / "notes.toml") << "something = 1\n";
  demo_->window().dropFiles({config_.path() / "b_scene.toml"});
  wait();
  ASSERT_EQ(shown(), "b_scene");
  ASSERT_GT(ui.scenes.size(), 4u);
  EXPECT_EQ(ui.scenes[0], "a_scene");
  EXPECT_EQ(ui.scenes[1], "b_scene");
  EXPECT_EQ(ui.scenePaths[1], (config_.path() / "b_scene.toml").string());
  EXPECT_EQ(std::count(ui.scenes.begin(), ui.scenes.end(), "notes"), 0) << "no scene";
  EXPECT_EQ(std::count(ui.scenes.begin(), ui.scenes.end(), "gallery"), 1);
  EXPECT_EQ(std::count(ui.scenePaths.begin(), ui.scenePaths.end(), options_.scene), 1) << "what was open";
  expectQuiet();
}

TEST_F(DemoOpen, WhatIsWrongIsOneLineAndTheSceneStays) {
  const std::string before = shown();
  const fs::path broken = config_.path() / "broken.toml";
  std::ofstream(broken) << "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 4]\n";
  demo_->window().dropFiles({broken});
  wait();
  EXPECT_EQ(demo_->model().message.rfind(broken.string() + ":3: camera.target:", 0), 0u) << demo_->model().message;
  demo_->window().dropFiles({"/tmp/notes.txt"});
  wait();
  EXPECT_EQ(demo_->model().message, "/tmp/notes.txt: not a scene (a .toml scene or an .obj model is needed)");
  demo_->window().dropFiles({model("none.obj")});
  wait();
  EXPECT_NE(demo_->model().message.find("none.obj: cannot be read"), std::string::npos);
  EXPECT_EQ(shown(), before);
  demo_->window().dropFiles({model("gem.obj")});
  wait();
  EXPECT_EQ(demo_->model().message, "") << "gone with the next scene";
  expectQuiet();
}

}  // namespace
}  // namespace speculum
