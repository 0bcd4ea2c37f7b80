// Saving, prompts about unsaved changes, and copies of them.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "image/picture_files.hpp"
#include "window/support.hpp"

namespace speculum {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

class Saving : public WorkspaceTest {
 protected:
  explicit Saving(const Options& more = {}, const std::string& toml = corridorScene()) : WorkspaceTest(toml, more) {}

  void removeBall() {
    send(SelectNode{ball});
    send(RemoveSelected{});
    ASSERT_TRUE(edit().unsaved);
  }
  // Acts as before a failure, and returns the copy that the log names.
  std::string keptCopy() {
    workspace_->keepUnsavedWork();
    const std::string line = shown().log.lines(LogLevel::warn).back().text;
    const std::string start = "unsaved changes are kept in ";
    EXPECT_TRUE(startsWith(line, start));
    return line.substr(start.size());
  }
};

TEST_F(Saving, SavedSceneLoadsAsEdited) {
  clickBall();
  drag(pixel({0.3, 1.0, 0.5}) + glm::dvec2(60.0, 0.0), {33.0, 0.0});
  send(DuplicateSelected{});
  EXPECT_TRUE(edit().unsaved);
  send(Save{});
  EXPECT_FALSE(edit().unsaved) << edit().note;
  EXPECT_EQ(status(), "Saved " + options_.scene);
  const Scene saved = onDisk();
  ASSERT_EQ(saved.objects.size(), 2u);
  EXPECT_NEAR(saved.objects[0].position.x, 0.3 + 33.0 / focalPixels, 2e-4);
  EXPECT_TRUE(contains(readText(options_.scene), "# In front of the eye.")) << "comments stay";
}

TEST_F(Saving, QuitAsksAboutUnsavedChanges) {
  removeBall();
  send(Quit{});
  EXPECT_EQ(edit().prompt, Prompt::unsavedChanges);
  EXPECT_EQ(edit().afterPrompt, "quitting");
  EXPECT_FALSE(host_.closed);
  send(CancelPrompt{});
  EXPECT_EQ(edit().prompt, Prompt::none);
  EXPECT_FALSE(host_.closed);
  send(Quit{});
  send(DiscardChanges{});
  EXPECT_TRUE(host_.closed);
  EXPECT_EQ(onDisk().objects.size(), 1u) << "nothing was saved";
}

TEST_F(Saving, QuitAsksAboutEditsThatWereRefused) {
  workspace_->setRefusedEdit(true);
  send(Quit{});
  EXPECT_EQ(edit().prompt, Prompt::unsavedChanges);
  EXPECT_FALSE(host_.closed);
  send(DiscardChanges{});
  EXPECT_TRUE(host_.closed);
}

TEST_F(Saving, TypedHomeFoldersAreFollowed) {
  const UserFolders home{"HOME"};
  fs::create_directories(environment("HOME"));
  send(SaveAs{"~/mine.toml"});
  EXPECT_TRUE(fs::exists(fs::path(environment("HOME")) / "mine.toml"));
}

TEST_F(Saving, SavingAtThePromptWritesAndQuits) {
  removeBall();
  send(Quit{});
  send(Save{});
  EXPECT_TRUE(host_.closed);
  EXPECT_TRUE(onDisk().objects.empty());
}

TEST_F(Saving, UnsavedSettingsAreAskedAbout) {
  setExposure(2.0);
  EXPECT_TRUE(edit().unsaved);
  send(Quit{});
  send(CancelPrompt{});
  EXPECT_FALSE(host_.closed);
  setExposure(0.5);
  send(Quit{});
  EXPECT_EQ(edit().prompt, Prompt::unsavedChanges);
}

class LimitedFrames : public Saving {
 protected:
  LimitedFrames() : Saving({.frames = 10}) {}
};

TEST_F(LimitedFrames, QuitNeverAsks) {
  removeBall();
  send(Quit{});
  EXPECT_TRUE(host_.closed);
  EXPECT_EQ(edit().prompt, Prompt::none);
}

TEST_F(Saving, SaveAsSwitchesToTheNewFile) {
  const fs::path other = fs::path(options_.scene).replace_filename("other.toml");
  std::ofstream(other) << "somebody's";
  clickBall();
  send(DuplicateSelected{});
  send(AskWhereToSave{});
  ASSERT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_EQ(edit().proposedFile, options_.scene);
  send(SaveAs{other});
  EXPECT_EQ(edit().prompt, Prompt::saveAs) << "a file that is there is not overwritten unasked";
  EXPECT_EQ(edit().proposedFile, other);
  EXPECT_TRUE(edit().unsaved);
  send(SaveAs{other});
  EXPECT_EQ(edit().prompt, Prompt::none) << edit().note;
  EXPECT_EQ(loadScene(other).objects.size(), 2u);
  EXPECT_EQ(onDisk().objects.size(), 1u);
  EXPECT_FALSE(edit().unsaved);
  EXPECT_EQ(scene().file, other);
  EXPECT_EQ(shownScene(), "other");
}

TEST_F(Saving, OverwriteIsRefusedAgainAfterCancel) {
  const fs::path other = home_.path() / "other.toml";
  std::ofstream(other) << "somebody's";
  removeBall();
  for (int i = 0; i < 2; ++i) {
    send(AskWhereToSave{});
    send(SaveAs{other});
    EXPECT_EQ(edit().prompt, Prompt::saveAs);
    EXPECT_TRUE(contains(edit().note, "Save once more to overwrite it."));
    send(CancelPrompt{});
  }
  EXPECT_EQ(readText(other), "somebody's");
}

TEST_F(Saving, MissingFoldersAreNamed) {
  send(AskWhereToSave{});
  const fs::path folder = home_.path() / "missing";
  send(SaveAs{folder / "scene"});
  EXPECT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_TRUE(contains(edit().note, "no folder " + folder.string() + " "));
  send(SaveAs{home_.path() / "named"});
  EXPECT_EQ(edit().prompt, Prompt::none) << edit().note;
  EXPECT_EQ(scene().file, home_.path() / "named.toml");
}

TEST_F(Saving, SecondSaveKeepsSettingsOfTheFirst) {
  setExposure(2.0);
  send(Save{});
  EXPECT_FALSE(edit().unsaved);
  EXPECT_EQ(settingsOf(onDisk()).view.exposure, 2.0);
  EXPECT_EQ(shown().sceneSettings.view.exposure, 2.0) << "resets go back to it";
  removeBall();
  send(Save{});
  EXPECT_TRUE(onDisk().objects.empty());
  EXPECT_EQ(settingsOf(onDisk()).view.exposure, 2.0);
}

TEST_F(Saving, ForeignChangesAreNotOverwrittenUnasked) {
  removeBall();
  std::ofstream(options_.scene, std::ios::app) << "# written meanwhile\n";
  send(Save{});
  EXPECT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_NE(edit().note, "");
  EXPECT_EQ(onDisk().objects.size(), 1u);
  send(CancelPrompt{});
  EXPECT_TRUE(edit().unsaved);
}

TEST_F(Saving, AnotherSceneWaitsForTheAnswer) {
  removeBall();
  const OpenScene other{sceneFile("no_mirror")};
  send(other);
  ASSERT_EQ(edit().prompt, Prompt::unsavedChanges);
  EXPECT_EQ(edit().afterPrompt, "opening no_mirror.toml");
  send(CancelPrompt{});
  EXPECT_TRUE(edit().unsaved);
  EXPECT_FALSE(workspace_->working()) << "nothing is read";
  send(other);
  send(DiscardChanges{});
  waitFor([&] { return shownScene() == "no_mirror"; });
  EXPECT_FALSE(edit().unsaved);
  EXPECT_EQ(edit().undo, "");
  EXPECT_FALSE(edit().selected) << "it does not outlive its scene";
}

TEST_F(Saving, NewSceneAsksFirstAndSavesElsewhere) {
  removeBall();
  send(NewScene{});
  EXPECT_EQ(edit().prompt, Prompt::unsavedChanges);
  EXPECT_EQ(edit().afterPrompt, "starting a new scene");
  send(DiscardChanges{});
  waitFor([&] { return host_.title == "untitled - Speculum"; });
  EXPECT_EQ(scene().lights.size(), 1u);
  EXPECT_FALSE(edit().unsaved);
  EXPECT_TRUE(edit().isNew && edit().canSave());
  EXPECT_EQ(edit().undo, "");
  EXPECT_EQ(shown().browser.recent, std::vector{fs::path(options_.scene)}) << "no new scene";
  send(AddLight{});
  send(Save{});
  ASSERT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_EQ(edit().proposedFile, documentsDir() / "Speculum" / "untitled.toml");
  send(SaveAs{"mine"});
  EXPECT_EQ(loadScene(documentsDir() / "Speculum" / "mine.toml").lights.size(), 2u);
  EXPECT_EQ(shownScene(), "mine");
  EXPECT_FALSE(edit().isNew);
  EXPECT_EQ(std::ranges::count(shown().browser.scenes, "untitled", &SceneEntry::name), 0);
}

// Finds out by clicks all over the picture.
TEST_F(Saving, NewScenesShowThingsAndTheirImages) {
  send(NewScene{});
  waitFor([&] { return shownScene() == "untitled"; });
  std::map<Selection::Kind, std::set<int>> seen;
  std::set<int> reflected;
  for (int i = 0; i < 16 * 12; ++i) {
    click({width * (i % 16 + 0.5) / 16.0, height * (i / 16 + 0.5) / 12.0});
    const Selection node = edit().selected;
    seen[node.kind].insert(node.index);
    if (node.kind == Selection::Kind::object && !edit().through.empty()) {
      reflected.insert(node.index);
    }
    send(SelectNode{});
  }
  EXPECT_GE(seen[Selection::Kind::object].size(), 3u) << "a floor and two things";
  EXPECT_GE(seen[Selection::Kind::mirror].size(), 1u);
  EXPECT_GE(reflected.size(), 2u);
  EXPECT_TRUE(scene().environment.sky);
}

TEST_F(Saving, NewScenesHaveNothingInAMirrorsPlane) {
  send(NewScene{});
  waitFor([&] { return shownScene() == "untitled"; });
  const SceneState state = evaluate(scene(), 0.0);
  for (const MirrorState& mirror : state.mirrors) {
    int within = 0;
    for (const InstanceState& instance : state.instances) {
      for (const Vertex& vertex : scene().meshes[instance.mesh].vertices) {
        const glm::dvec3 place = instance.worldFromMesh.point(vertex.position);
        within += std::abs(glm::dot(place - mirror.origin, mirror.normal)) < 1e-4 ? 1 : 0;
      }
    }
    EXPECT_EQ(within, 0) << "its back would be seen in patches";
  }
}

TEST_F(Saving, NewScenesAreListedWhileShown) {
  send(NewScene{});
  waitFor([&] { return shownScene() == "untitled"; });
  askWhatToOpen("");
  EXPECT_EQ(edit().proposedFile, dataDirectory("scenes") / "") << "not where the new scene comes from";
  send(OpenScene{sceneFile("no_mirror")});
  waitFor([&] { return shownScene() == "no_mirror"; });
  EXPECT_EQ(std::ranges::count(shown().browser.scenes, "untitled", &SceneEntry::name), 0);
}

// Changes made while a scene is loading bring up the prompt once it is loaded.
TEST_F(Saving, ChangesDuringLoadingAreAskedAbout) {
  // No frame takes the scene before the change.
  workspace_->apply(OpenScene{sceneFile("no_mirror")});
  workspace_->apply(SelectNode{ball});
  workspace_->apply(RemoveSelected{});
  waitFor([&] { return edit().prompt == Prompt::unsavedChanges; });
  EXPECT_EQ(shownScene(), "workspace");
  send(CancelPrompt{});
  frame();
  EXPECT_EQ(shownScene(), "workspace");
  EXPECT_TRUE(edit().unsaved);
}

class ShippedScene : public Saving {
 protected:
  ShippedScene() {
    workspace_->apply(OpenScene{shipped_});
    waitFor([&] { return shownScene() == "no_mirror"; });
  }
  ~ShippedScene() override {
    if (readText(shipped_) != text_) {
      std::ofstream(shipped_) << text_;  // a failure must not last
    }
  }
  void removeFirst() {
    send(SelectNext{});
    send(RemoveSelected{});
  }

  const fs::path shipped_ = dataDirectory("scenes") / "no_mirror.toml";
  const std::string text_ = readText(shipped_);
};

TEST_F(ShippedScene, IsSavedToTheUsersFolder) {
  const fs::path own = documentsDir() / "Speculum" / "no_mirror.toml";
  removeFirst();
  const size_t nodes = allNodes(scene()).size();
  EXPECT_FALSE(edit().saveFile);
  send(Save{});
  ASSERT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_EQ(edit().proposedFile, own);
  send(SaveAs{own});
  EXPECT_EQ(edit().saveFile, own);
  ASSERT_EQ(edit().prompt, Prompt::none) << edit().note;
  EXPECT_EQ(scene().file, own);
  EXPECT_EQ(allNodes(loadScene(own)).size(), nodes);
  removeFirst();
  send(Save{});
  EXPECT_EQ(edit().prompt, Prompt::none) << "the second time unasked";
  EXPECT_EQ(allNodes(loadScene(own)).size(), nodes - 1);
  EXPECT_EQ(readText(shipped_), text_);
}

// The test does not save twice, because that would overwrite a shipped scene.
TEST_F(ShippedScene, OwnFileIsRefusedAtFirst) {
  removeFirst();
  send(AskWhereToSave{});
  send(SaveAs{shipped_});
  EXPECT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_TRUE(contains(edit().note, "it comes with the program\nSave once more to overwrite it."));
  EXPECT_TRUE(edit().unsaved);
  EXPECT_EQ(readText(shipped_), text_);
}

class CopiedCommand : public Saving {
 protected:
  std::string command() {
    send(CopyCommandLine{});
    EXPECT_TRUE(startsWith(status(), "Copied: " + host_.clipboard));
    return host_.clipboard;
  }
  // The scene that the command draws.
  Scene drawnScene() {
    const std::string text = command();
    const size_t begin = text.find("--scene ") + 8;
    return loadScene(text.substr(begin, text.find(' ', begin) - begin));
  }
};

TEST_F(CopiedCommand, SaysTimeSizeCameraAndSettings) {
  EXPECT_FALSE(contains(command(), "--camera")) << "the camera is the scene's";
  send(StepTime{30});
  drag({700, 500}, {60, 10});
  setExposure(0.5);
  host_.size = {777, 555};
  const std::string text = command();
  for (const char* part : {"speculum render", "--size 777x555", "--time 0.5", "--camera ", "view.exposure=0.5"}) {
    EXPECT_TRUE(contains(text, part)) << part << " in " << text;
  }
  changeSettings([](Settings& settings) { settings.view.continuous = true; });
  EXPECT_EQ(command(), text) << "that is the window's own";
}

TEST_F(CopiedCommand, NamesACopyWithUnsavedChanges) {
  removeBall();
  EXPECT_TRUE(drawnScene().objects.empty());
  EXPECT_TRUE(contains(status(), "unsaved changes"));
  EXPECT_EQ(onDisk().objects.size(), 1u) << "the scene's own file is as it was";
  send(Undo{});
  EXPECT_EQ(drawnScene().file, options_.scene);
  EXPECT_EQ(status(), "Copied: " + host_.clipboard);
}

TEST_F(CopiedCommand, LeavesSavedSettingsToTheFile) {
  setExposure(0.5);
  send(Save{});
  EXPECT_FALSE(contains(command(), "view.exposure"));
  removeBall();
  EXPECT_EQ(settingsOf(drawnScene()).view.exposure, 0.5) << "the copy has them";
}

TEST_F(Saving, FailuresKeepUnsavedWorkInACopy) {
  workspace_->keepUnsavedWork();
  EXPECT_TRUE(shown().log.lines(LogLevel::err).empty()) << "there is none";
  removeBall();
  EXPECT_TRUE(loadScene(keptCopy()).objects.empty());
}

// The scene has a background, a sky, or neither, and a clear color from a file before or none.
class ClearColor : public Saving, public testing::WithParamInterface<std::pair<const char*, const char*>> {
 protected:
  ClearColor()
      : Saving({}, std::string("[environment]\n") + GetParam().first +
                       "\n[camera]\nposition = [0, 1, 1]\ntarget = [0, 1, "
                       "0]\n" +
                       GetParam().second) {}
  void setClearColor(const std::optional<glm::dvec3>& color) {
    changeSettings([&](Settings& settings) { settings.view.clearColor = color; });
  }
};

TEST_P(ClearColor, TakenBackLeavesTheFile) {
  const glm::dvec3 green(0.0, 0.5, 0.0);
  setClearColor(green);
  send(Save{});
  ASSERT_EQ(settingsOf(onDisk()).view.clearColor, green);
  start();
  setClearColor(std::nullopt);
  EXPECT_TRUE(edit().unsaved);
  EXPECT_EQ(edit().undo, "change Clear color");
  send(Undo{});
  EXPECT_EQ(workspace_->settings().view.clearColor, green);
  EXPECT_FALSE(edit().unsaved);
  send(Redo{});
  EXPECT_FALSE(workspace_->settings().view.clearColor);
  send(CopyCommandLine{});
  EXPECT_TRUE(contains(host_.clipboard, " --set view.clear_color= ")) << host_.clipboard;
  send(Save{});
  EXPECT_FALSE(edit().unsaved) << edit().note;
  EXPECT_FALSE(settingsOf(onDisk()).view.clearColor);
  EXPECT_FALSE(contains(readText(options_.scene), "clear_color"));
  EXPECT_EQ(onDisk().environment, scene().environment);
}

INSTANTIATE_TEST_SUITE_P(
    Each, ClearColor,
    testing::Values(std::pair("background = [0.2, 0.3, 0.4]", ""),
                    std::pair("sky = { zenith = [0, 0, 1], horizon = [1, 1, 1], ground = [0, 1, 0] }", ""),
                    std::pair("", "[settings]\n\"view.clear_color\" = [1, 0, 0]\n"),
                    std::pair("", "[settings]\nview = { clear_color = [1, 0, 0], exposure = 2 }\n"),
                    std::pair("", "[settings.view]\nclear_color = [1, 0, 0]\n")));

// A box of the scene's own folder stands in the corridor, so that its model can go.
class OwnModel : public Saving {
 protected:
  OwnModel() : Saving({}, corridorScene("[[object]] model = \"" + model() + "\"\n")) {}
  ~OwnModel() override { fs::remove(model()); }

  static std::string model() {
    const fs::path file = sceneDirectory() / "own.obj";
    fs::copy_file(sourceFile("models/box.obj"), file, fs::copy_options::skip_existing);
    return file.string();
  }
};

// No scene without its model can be saved, but the copy can be mended by hand.
TEST_F(OwnModel, CopyIsKeptWhenItIsGone) {
  const std::string file = model();
  setExposure(2.5);
  fs::remove(file);
  send(Save{});
  EXPECT_TRUE(contains(edit().note, "would not be found")) << edit().note;
  EXPECT_TRUE(contains(readText(keptCopy()), "\"view.exposure\" = 2.5"));
}

class Kept : public Saving {
 protected:
  // Calls what every step of the window does, so many seconds after the start of the test.
  void step(double seconds) {
    workspace_->keepChanges(
        start_ + std::chrono::duration_cast<SceneOpener::Clock::duration>(std::chrono::duration<double>(seconds)));
  }
  // Returns the copies of all windows.
  static std::vector<fs::path> copies() {
    std::vector<fs::path> files;
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator(userConfigDir() / "unsaved", none)) {
      if (entry.path().extension() == ".toml") {
        files.push_back(entry.path());
      }
    }
    return files;
  }
  // Ends this session without a word, and begins another one that is offered what it kept.
  fs::path offered() {
    start();
    EXPECT_EQ(edit().prompt, Prompt::recovery);
    return edit().proposedFile;
  }

  const SceneOpener::Clock::time_point start_ = SceneOpener::Clock::now();
};

// The process ends in a way that it cannot notice, after an edit and the second that a copy may take.
TEST_F(Kept, ChangesOutliveEverySignal) {
  const fs::path original = scene().file;
  for (const int signal : {SIGKILL, SIGSEGV, SIGABRT, SIGTERM, SIGQUIT}) {
    const pid_t child = ::fork();
    if (child == 0) {
      const rlimit none{};
      ::setrlimit(RLIMIT_CORE, &none);
      removeBall();
      setExposure(0.25);
      step(1.0);
      step(2.0);
      ::raise(signal);
      ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_NE(status, 0);
    const fs::path copy = offered();
    send(CancelPrompt{});
    removeBall();
    setExposure(0.25);
    EXPECT_EQ(readText(copy), workspace_->saving().text(copy, workspace_->settings(), ReadBack::required));
    EXPECT_TRUE(loadScene(copy).objects.empty());
    ASSERT_EQ(offered(), copy);
    send(OpenScene{copy});
    waitFor([&] { return scene().file == copy; });
    EXPECT_EQ(settingsOf(scene()).view.exposure, 0.25);
    EXPECT_TRUE(edit().unsaved);
    EXPECT_FALSE(std::ranges::count(shown().browser.recent, copy)) << "it goes when it is saved";
    send(Save{});
    EXPECT_EQ(edit().prompt, Prompt::saveAs);
    EXPECT_EQ(edit().proposedFile, original) << "of which it is a copy";
    send(CancelPrompt{});
    send(SaveAs{home_.path() / ("saved" + std::to_string(signal))});
    EXPECT_TRUE(copies().empty()) << "they are saved";
    start();
    EXPECT_EQ(edit().prompt, Prompt::none);
  }
}

TEST_F(Kept, CopiesAreSavedToTheirOriginal) {
  const fs::path original = scene().file;
  removeBall();
  step(1.0);
  step(2.0);
  const fs::path copy = offered();
  EXPECT_EQ(edit().ownFile, original);
  send(OpenScene{copy});
  waitFor([&] { return scene().file == copy; });
  EXPECT_EQ(edit().ownFile, original) << "whose models stay where they are";
  send(AskWhatToAdd{});
  EXPECT_EQ(edit().proposedFile, original.parent_path() / "") << "files are looked for beside it";
  send(CancelPrompt{});
  send(Save{});
  send(SaveAs{edit().proposedFile});
  EXPECT_EQ(edit().prompt, Prompt::saveAs) << "it may have changed since";
  send(SaveAs{edit().proposedFile});
  EXPECT_EQ(edit().prompt, Prompt::none) << edit().note;
  EXPECT_EQ(scene().file, original);
  EXPECT_TRUE(loadScene(original).objects.empty());
  EXPECT_TRUE(copies().empty());
}

TEST_F(Kept, CopyFollowsChangesWithinASecond) {
  step(0.0);
  step(1.0);
  removeBall();
  step(10.0);
  step(10.9);
  EXPECT_TRUE(copies().empty());
  step(11.0);
  ASSERT_EQ(copies().size(), 1u);
  const fs::path copy = copies().front();
  const std::string first = readText(copy);
  step(12.0);
  setExposure(0.5);
  step(12.5);
  EXPECT_EQ(readText(copy), first);
  step(13.5);
  EXPECT_EQ(settingsOf(loadScene(copy)).view.exposure, 0.5);
  EXPECT_EQ(copies(), std::vector<fs::path>{copy}) << "the same one";
  int written = 0;
  for (int i = 0; i < 100; ++i) {
    setExposure(1.0 + i, true);
    const std::string before = readText(copy);
    step(20.0 + 0.1 * i);
    written += readText(copy) != before;
  }
  EXPECT_GE(written, 7) << "also while changes go on";
  EXPECT_LE(written, 10) << "at most once a second";
}

TEST_F(Kept, CopiesGoWithTheChanges) {
  const auto keep = [&] {
    removeBall();
    step(100.0);
    step(200.0);
    EXPECT_EQ(copies().size(), 1u);
  };
  keep();
  send(Undo{});
  step(300.0);
  step(400.0);
  EXPECT_TRUE(copies().empty()) << "undone";
  start();
  keep();
  send(Quit{});
  send(DiscardChanges{});
  step(300.0);
  EXPECT_TRUE(host_.closed && copies().empty()) << "discarded";
  start();
  keep();
  send(OpenScene{sceneFile("no_mirror")});
  EXPECT_EQ(copies().size(), 1u) << "not yet";
  send(DiscardChanges{});
  waitFor([&] { return shownScene() == "no_mirror"; });
  EXPECT_TRUE(copies().empty()) << "another scene is shown";
  start();
  keep();
  send(Save{});
  EXPECT_TRUE(copies().empty()) << "saved";
}

class KeptOfLimitedFrames : public Kept {
 protected:
  KeptOfLimitedFrames() {
    removeBall();
    step(1.0);
    step(2.0);
    options_.frames = 10;
  }
};

TEST_F(KeptOfLimitedFrames, AreLeftToTheNextWindow) {
  options_.scene = copies().front().string();
  start();
  setExposure(0.5);
  step(3.0);
  step(4.0);
  send(Quit{});
  EXPECT_EQ(copies(), std::vector<fs::path>{options_.scene});
}

TEST_F(Kept, NextStartOffersTheCopyUntilAnswered) {
  removeBall();
  workspace_->keepUnsavedWork();
  const fs::path kept = offered();
  send(CancelPrompt{});
  EXPECT_EQ(offered(), kept) << "later";
  send(OpenScene{sceneFile("no_mirror")});
  waitFor([&] { return scene().file.filename() == "no_mirror.toml"; });
  send(Quit{});
  EXPECT_EQ(offered(), kept) << "another scene is no answer";
  send(OpenScene{kept});
  waitFor([&] { return scene().file == kept; });
  EXPECT_TRUE(scene().objects.empty());
  EXPECT_TRUE(edit().unsaved);
  EXPECT_TRUE(contains(host_.title, "*"));
  setExposure(0.5);
  step(1.0);
  step(2.0);
  EXPECT_EQ(copies(), std::vector<fs::path>{kept}) << "it goes on in the same copy";
  send(Save{});
  EXPECT_EQ(edit().prompt, Prompt::saveAs) << "a copy is no place for a scene";
  EXPECT_EQ(offered(), kept) << "neither saved nor discarded";
  EXPECT_EQ(settingsOf(loadScene(kept)).view.exposure, 0.5);
  send(DiscardChanges{});
  EXPECT_EQ(edit().prompt, Prompt::none);
  EXPECT_TRUE(copies().empty());
  start();
  EXPECT_EQ(edit().prompt, Prompt::none);
}

// Several windows edit the same scene at once.
TEST_F(Kept, EveryWindowHasACopyOfItsOwn) {
  std::vector<std::unique_ptr<Workspace>> windows;
  for (int i = 0; i < 4; ++i) {
    start();
    EXPECT_EQ(edit().prompt, Prompt::none) << "what living windows keep is not offered";
    setExposure(1.5 + i);
    step(2.0 * i);
    step(2.0 * i + 1.0);
    EXPECT_EQ(copies().size(), static_cast<size_t>(i + 1));
    windows.push_back(std::move(workspace_));
  }
  windows.erase(windows.begin() + 1);  // ends without a word
  std::set<double> found;
  const fs::path first = offered();
  found.insert(settingsOf(loadScene(first)).view.exposure);
  windows.push_back(std::move(workspace_));
  start();
  EXPECT_EQ(edit().prompt, Prompt::none) << "another window offers it";
  windows.clear();
  for (int i = 0; i < 4; ++i) {
    found.insert(settingsOf(loadScene(offered())).view.exposure);
    send(DiscardChanges{});
  }
  EXPECT_EQ(found, (std::set<double>{1.5, 2.5, 3.5, 4.5}));
  EXPECT_TRUE(copies().empty());
}

TEST_F(Kept, NamesMayBeAsLongAsFilesAllow) {
  const std::string text = readText(options_.scene);
  for (const std::string& character : {std::string("n"), std::string("\u00e4"), std::string("\u65e5")}) {
    for (const size_t bytes : {1, 240, 250}) {
      std::string stem;
      while (stem.size() + character.size() <= std::max(bytes, character.size())) {
        stem += character;
      }
      options_.scene = (home_.path() / (stem + ".toml")).string();
      std::ofstream(options_.scene) << text;
      start();
      setExposure(0.5);
      step(1.0);
      step(2.0);
      const fs::path copy = offered();
      EXPECT_EQ(copy.stem(), stem);
      EXPECT_EQ(settingsOf(loadScene(copy)).view.exposure, 0.5);
      send(DiscardChanges{});
      removeBall();
      send(CopyCommandLine{});
      EXPECT_TRUE(startsWith(status(), "Copied: ")) << status();
      for (int i = 0; i < 2; ++i) {
        send(TakeScreenshot{});
        drawFrame();
        EXPECT_TRUE(startsWith(status(), "Saved ")) << status();
      }
    }
  }
}

// A model's file has no room for the ending of a scene's.
TEST_F(Kept, NamesAreCutBetweenCharacters) {
  std::string stem = "x";
  while (stem.size() < 251) {
    stem += "\u00e4";
  }
  options_.scene = (home_.path() / (stem + ".obj")).string();
  fs::copy_file(sourceFile("models/box.obj"), options_.scene);
  start();
  setExposure(0.5);
  step(1.0);
  step(2.0);
  EXPECT_EQ(offered().filename().string(), stem.substr(0, 249) + ".toml");
}

TEST_F(Kept, FoldersOfOthersAreLeftAlone) {
  const fs::path unsaved = userConfigDir() / "unsaved";
  const fs::path elsewhere = home_.path() / "elsewhere";
  const fs::path target = elsewhere / "mine.toml";
  fs::create_directories(elsewhere);
  fs::create_directories(unsaved / "empty");
  fs::copy_file(options_.scene, target);
  fs::create_symlink(elsewhere, unsaved / "link");
  fs::create_directories(unsaved / "linked");
  fs::create_symlink(target, unsaved / "linked" / "scene.toml");
  fs::create_directories(unsaved / "folder" / "folder.toml");
  std::ofstream(unsaved / "file.toml") << "";
  start();
  EXPECT_EQ(edit().prompt, Prompt::none);
  std::ofstream(unsaved / "1") << "no folder";
  fs::create_symlink(elsewhere, unsaved / "2");
  removeBall();
  step(1.0);
  step(2.0);
  EXPECT_TRUE(loadScene(offered()).objects.empty()) << "there is room beside them";
  send(DiscardChanges{});
  start();
  fs::remove_all(unsaved);
  std::ofstream(unsaved) << "no folder";
  removeBall();
  step(3.0);
  step(4.0);
  step(20.0);
  EXPECT_EQ(shown().log.lines(LogLevel::warn).size(), 1u) << "it is said once";
  fs::remove(unsaved);
  step(40.0);
  EXPECT_EQ(copies().size(), 1u) << "as soon as it can be kept";
  fs::remove_all(unsaved);
  setExposure(0.5);
  step(50.0);
  step(60.0);
  EXPECT_EQ(copies().size(), 1u) << "again";
  EXPECT_TRUE(fs::exists(target));
}

// Where a model of the scene, its materials and its texture lie, and how they name each other.
struct ModelPlaces {
  const char* model;
  const char* materials;  // as the model names them
  const char* texture;    // as the materials name it
};

// The models lie in a folder `from`, which goes away after the scene was saved into `to`.
class ModelsBrought : public Saving {
 protected:
  void make(const std::vector<ModelPlaces>& places) {
    const fs::path folder = home_.path() / "from";
    fs::create_directories(folder);
    std::string objects;
    for (size_t i = 0; i < places.size(); ++i) {
      const fs::path model = folder / places[i].model;
      const fs::path materials = model.parent_path() / slashed(places[i].materials);
      const fs::path texture = materials.parent_path() / slashed(places[i].texture);
      for (const fs::path& file : {model, materials, texture}) {
        fs::create_directories(file.lexically_normal().parent_path());
        fs::create_directories(file.parent_path());
      }
      Image8 picture(2, 2);
      picture.at(0, 0)[1] = static_cast<uint8_t>(50 + i);
      writePng(texture, picture);
      std::ofstream(materials) << "newmtl a\nmap_Kd " << places[i].texture << "\n";
      std::ofstream(model) << "mtllib " << places[i].materials << "\nusemtl a\nv " << i
                           << " 0 0\nv 9 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
      objects += "[[object]]\nname = 'object " + std::to_string(i) + "'\nmodel = '" + places[i].model + "'\n";
    }
    options_.scene = (folder / "scene.toml").string();
    std::ofstream(options_.scene) << "[camera]\nposition = [0, 0, 9]\ntarget = [0, 0, 0]\n" + objects;
    fs::create_directories(to_);
    start();
    setExposure(0.5);
  }
  static std::string slashed(std::string name) {
    std::ranges::replace(name, '\\', '/');
    return name;
  }
  // Returns the shape and the texture of every object.
  static std::vector<std::pair<std::vector<glm::dvec3>, std::vector<glm::vec3>>> contentOf(const Scene& scene) {
    std::vector<std::pair<std::vector<glm::dvec3>, std::vector<glm::vec3>>> content;
    for (const Object& object : scene.objects) {
      const Mesh& mesh = scene.meshes.at(object.mesh);
      content.emplace_back(mesh.positions(), scene.textures.at(mesh.parts.at(0).material.diffuseTexture).texels);
    }
    return content;
  }
  // Saves with the models, which are taken away, and returns the scene as it is read then.
  Scene brought() {
    const auto before = contentOf(scene());
    send(SaveAs{to_ / "scene.toml", true});
    EXPECT_EQ(edit().prompt, Prompt::none) << edit().note;
    EXPECT_FALSE(edit().unsaved);
    fs::rename(home_.path() / "from", home_.path() / "gone");
    Scene scene = loadScene(to_ / "scene.toml");
    EXPECT_TRUE(contentOf(scene) == before);
    for (const Object& object : scene.objects) {
      EXPECT_TRUE(startsWith(object.model, "models")) << object.model;
    }
    return scene;
  }

  const fs::path to_ = home_.path() / "to";
};

TEST_F(ModelsBrought, WithMaterialsAndTexturesWhereverTheyLie) {
  for (const ModelPlaces& places :
       {ModelPlaces{"car.obj", "car.mtl", "wood.png"}, ModelPlaces{"m/car.obj", "car.mtl", "tex/wood.png"},
        ModelPlaces{"a/b/c/car.obj", "../../mtl/car.mtl", "../../t/wood.png"},
        ModelPlaces{"a car.obj", "the materials.mtl", "some wood.png"},
        ModelPlaces{"m/car.obj", "mtl\\car.mtl", "tex\\..\\wood.png"},
        ModelPlaces{"\u00e4/\u65e5.obj", "\u00fc.mtl", "..//./\u00f6.png"}}) {
    SCOPED_TRACE(places.model);
    make({places});
    brought();
    fs::remove_all(home_.path() / "gone");
    fs::remove_all(to_);
  }
}

TEST_F(ModelsBrought, ThatShareNamesOrFiles) {
  make({{"a/car.obj", "car.mtl", "wood.png"},
        {"b/car.obj", "car.mtl", "wood.png"},
        {"b/van.obj", "van.mtl", "wood.png"},
        {"c/van.obj", "../b/van.mtl", "wood.png"}});
  const Scene scene = brought();
  EXPECT_EQ(scene.meshes.size(), 4u);
}

TEST_F(ModelsBrought, ThroughLinks) {
  make({{"car.obj", "car.mtl", "wood.png"}});
  const fs::path from = home_.path() / "from";
  const fs::path store = home_.path() / "store";
  fs::create_directories(store);
  for (const char* name : {"car.obj", "car.mtl", "wood.png"}) {
    fs::rename(from / name, store / (std::string("stored ") + name));
    fs::create_symlink(store / (std::string("stored ") + name), from / name);
  }
  start();
  setExposure(0.5);
  brought();
  EXPECT_FALSE(fs::is_symlink(to_ / "models" / "car.obj"));
}

// Something of another content, or of no content, stands where a copy would go.
TEST_F(ModelsBrought, OverwritesNothing) {
  for (const char* name : {"car.obj", "car.mtl", "wood.png"}) {
    for (const std::string kind : {"file", "folder", "link", "pipe"}) {
      SCOPED_TRACE(name + (" " + kind));
      make({{"car.obj", "car.mtl", "wood.png"}});
      const fs::path taken = to_ / "models" / name;
      fs::create_directories(taken.parent_path());
      kind == "file"     ? static_cast<void>(std::ofstream(taken) << "precious")
      : kind == "folder" ? static_cast<void>(fs::create_directory(taken))
      : kind == "link"   ? fs::create_symlink(home_.path() / "nowhere", taken)
                         : static_cast<void>(runProcess({"mkfifo", taken.string()}));
      const Scene scene = brought();
      EXPECT_EQ(scene.objects[0].model, "models-2/car.obj");
      EXPECT_TRUE(kind != "file" || readText(taken) == "precious");
      EXPECT_FALSE(fs::exists(home_.path() / "nowhere"));
      fs::remove_all(home_.path() / "gone");
      fs::remove_all(to_);
    }
  }
  make({{"car.obj", "car.mtl", "wood.png"}});
  std::ofstream(to_ / "models") << "no folder";
  EXPECT_EQ(brought().objects[0].model, "models-2/car.obj");
}

TEST_F(ModelsBrought, EqualCopiesAreUsedAgain) {
  make({{"car.obj", "car.mtl", "wood.png"}});
  send(SaveAs{to_ / "first.toml", true});
  start();  // the scene in its old folder
  setExposure(0.25);
  const fs::file_time_type time = fs::last_write_time(to_ / "models" / "car.obj");
  EXPECT_EQ(brought().objects[0].model, "models/car.obj");
  EXPECT_EQ(fs::last_write_time(to_ / "models" / "car.obj"), time);
}

// A texture that is not where the materials say is found in `textures`, unless a file of its name lies nearer.
TEST_F(ModelsBrought, FilesFoundBySearchStayFound) {
  make({{"chair/chair.obj", "chair.mtl", "color.png"}, {"table/table.obj", "table.mtl", "color.png"}});
  const fs::path chair = home_.path() / "from" / "chair";
  fs::create_directory(chair / "textures");
  fs::rename(chair / "color.png", chair / "textures" / "color.png");
  start();
  setExposure(0.5);
  brought();
}

TEST_F(ModelsBrought, FilesOfMissingWholePathsStayFound) {
  make({{"chair.obj", "chair.mtl", "color.png"}});
  std::ofstream(home_.path() / "from" / "chair.mtl") << "newmtl a\nmap_Kd /no/such/folder/color.png\n";
  start();
  setExposure(0.5);
  brought();
}

TEST_F(ModelsBrought, EarlierScenesKeepTheirPictures) {
  const fs::path from = home_.path() / "from";
  make({{"chair.obj", "chair.mtl", "color.png"}});
  fs::create_directory(from / "textures");
  fs::rename(from / "color.png", from / "textures" / "color.png");
  start();
  const auto first = contentOf(scene());
  setExposure(0.5);
  send(SaveAs{to_ / "first.toml", true});
  make({{"table.obj", "table.mtl", "color.png"}});
  EXPECT_TRUE(startsWith(brought().objects[0].model, "models-2/"));
  EXPECT_TRUE(contentOf(loadScene(to_ / "first.toml")) == first);
}

TEST_F(ModelsBrought, FailedCopyLeavesNothing) {
  make({{"car.obj", "car.mtl", "wood.png"}, {"van.obj", "van.mtl", "wood.png"}});
  fs::remove(home_.path() / "from" / "van.obj");
  send(AskWhereToSave{});
  send(SaveAs{to_ / "scene.toml", true});
  EXPECT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_TRUE(fs::is_empty(to_));
}

TEST_F(ModelsBrought, RefusedOverwritingCopiesNothing) {
  make({{"car.obj", "car.mtl", "wood.png"}});
  std::ofstream(to_ / "scene.toml") << "precious";
  send(AskWhereToSave{});
  send(SaveAs{to_ / "scene.toml", true});
  EXPECT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_FALSE(fs::exists(to_ / "models"));
}

// Scene files are UTF-8.
TEST_F(ModelsBrought, CopiesFindLatin1Folders) {
  make({{"car.obj", "car.mtl", "wood.png"}});
  const fs::path folder = home_.path() / "lat\xfcn";
  fs::rename(home_.path() / "from", folder);
  options_.scene = (folder / "scene.toml").string();
  start();
  setExposure(0.25);
  EXPECT_TRUE(fs::equivalent(loadScene(keptCopy()).meshes.at(0).source, folder / "car.obj"));
}

TEST_F(ModelsBrought, OtherFailuresOfferNoOverwriting) {
  make({{"car.obj", "car.mtl", "wood.png"}});
  fs::rename(home_.path() / "from", home_.path() / "gone");
  std::ofstream(to_ / "scene.toml") << "somebody's";
  send(SaveAs{to_ / "scene.toml", false});
  EXPECT_TRUE(contains(edit().note, "would not be found")) << edit().note;
  EXPECT_FALSE(contains(edit().note, "once more"));
  send(Save{});
  EXPECT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_TRUE(contains(edit().note, "there is no folder")) << edit().note;
}

TEST_F(ModelsBrought, OnlyIfWanted) {
  make({{"car.obj", "car.mtl", "wood.png"}});
  send(SaveAs{to_ / "scene.toml", false});
  EXPECT_EQ(loadScene(to_ / "scene.toml").objects[0].model, "../from/car.obj");
  EXPECT_FALSE(fs::exists(to_ / "models"));
}

TEST_F(ModelsBrought, EditingAndSavingGoOn) {
  make({{"car.obj", "car.mtl", "wood.png"}, {"van.obj", "van.mtl", "wood2.png"}});
  send(SelectNode{ball});
  send(RemoveSelected{});
  std::ofstream(to_ / "scene.toml") << "somebody's";
  send(AskWhereToSave{});
  send(SaveAs{to_ / "scene.toml", true});
  EXPECT_EQ(edit().prompt, Prompt::saveAs) << "not overwritten unasked";
  EXPECT_EQ(fs::weakly_canonical(scene().meshes[1].source), home_.path() / "from" / "van.obj");
  send(SaveAs{to_ / "scene.toml", true});
  EXPECT_EQ(edit().prompt, Prompt::none) << edit().note;
  EXPECT_FALSE(fs::exists(to_ / "models" / "car.obj")) << "no object uses it";
  EXPECT_EQ(edit().models[1], to_ / "models" / "van.obj");
  send(Undo{});
  EXPECT_EQ(scene().objects.size(), 2u);
  send(Save{});
  EXPECT_EQ(edit().prompt, Prompt::none) << edit().note;
  const Scene both = loadScene(to_ / "scene.toml");
  EXPECT_EQ(both.objects[0].model, "../from/car.obj");
  EXPECT_EQ(both.objects[1].model, "models/van.obj");
  send(SaveAs{home_.path() / "from" / "again.toml", false});
  EXPECT_EQ(edit().prompt, Prompt::none) << edit().note;
  EXPECT_EQ(loadScene(home_.path() / "from" / "again.toml").objects[1].model, "../to/models/van.obj");
}

// A whole path leads to the file from everywhere on this machine.
TEST_F(ModelsBrought, WholePathsStay) {
  const std::string texture = (home_.path() / "wood.png").string();
  make({{"car.obj", "car.mtl", texture.c_str()}});
  brought();
  EXPECT_EQ(std::distance(fs::directory_iterator(to_ / "models"), fs::directory_iterator()), 2);
}

TEST_F(Saving, UndrawableStepIsTakenBack) {
  EXPECT_FALSE(workspace_->undoFailedChange("no memory")) << "nothing to take back";
  removeBall();
  EXPECT_TRUE(workspace_->undoFailedChange("no memory"));
  EXPECT_EQ(scene().objects.size(), 1u);
  EXPECT_EQ(workspace_->problem(), "Cannot remove object 'ball': no memory");
  EXPECT_FALSE(workspace_->undoFailedChange("no memory")) << "no frame was drawn: it was not that step";
  EXPECT_TRUE(scene().objects.empty()) << "the work is kept";
}

}  // namespace
}  // namespace speculum
