// Saving, prompts about unsaved changes, and copies of them.
#include "app/recovery.hpp"
#include "workspace_support.hpp"

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
    const std::string line = view().log.lines(LogLevel::warn).back().text;
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
  EXPECT_EQ(view().sceneSettings.view.exposure, 2.0) << "resets go back to it";
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
  EXPECT_TRUE(view().browser.recent.empty());
  send(AddLight{});
  send(Save{});
  ASSERT_EQ(edit().prompt, Prompt::saveAs);
  EXPECT_EQ(edit().proposedFile, documentsDir() / "Speculum" / "untitled.toml");
  send(SaveAs{"mine"});
  EXPECT_EQ(loadScene(documentsDir() / "Speculum" / "mine.toml").lights.size(), 2u);
  EXPECT_EQ(shownScene(), "mine");
  EXPECT_FALSE(edit().isNew);
  EXPECT_EQ(std::ranges::count(view().browser.scenes, "untitled", &SceneEntry::name), 0);
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

TEST_F(Saving, NewScenesAreListedWhileShown) {
  send(NewScene{});
  waitFor([&] { return shownScene() == "untitled"; });
  askWhatToOpen("");
  EXPECT_EQ(edit().proposedFile, dataDirectory("scenes") / "") << "not where the new scene comes from";
  send(OpenScene{sceneFile("no_mirror")});
  waitFor([&] { return shownScene() == "no_mirror"; });
  EXPECT_EQ(std::ranges::count(view().browser.scenes, "untitled", &SceneEntry::name), 0);
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
  EXPECT_TRUE(view().log.lines(LogLevel::err).empty()) << "there is none";
  removeBall();
  EXPECT_TRUE(loadScene(keptCopy()).objects.empty());
}

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

TEST_F(Saving, NextStartOffersTheKeptChanges) {
  removeBall();
  workspace_->keepUnsavedWork();
  start();
  ASSERT_EQ(edit().prompt, Prompt::recovery);
  const fs::path kept = edit().proposedFile;
  send(OpenScene{kept});
  waitFor([&] { return scene().file == kept; });
  EXPECT_TRUE(scene().objects.empty());
  EXPECT_TRUE(edit().unsaved);
  EXPECT_TRUE(contains(host_.title, "*"));
  send(Save{});
  EXPECT_EQ(edit().prompt, Prompt::saveAs) << "a copy is no place for a scene";
  start();
  EXPECT_EQ(edit().prompt, Prompt::recovery) << "neither saved nor discarded";
  send(CancelPrompt{});
  start();
  EXPECT_EQ(edit().prompt, Prompt::none);
}

TEST_F(Saving, OtherWindowsKeepTheirRecords) {
  removeBall();
  const std::string first = keptCopy();
  setExposure(0.5);
  const std::string second = keptCopy();
  ASSERT_NE(first, second);
  EXPECT_EQ(settingsOf(loadScene(second)).view.exposure, 0.5);
  start();
  EXPECT_EQ(edit().proposedFile, second);
  Recovery().record(first);  // as another window does meanwhile
  send(CancelPrompt{});
  start();
  EXPECT_EQ(edit().proposedFile, first);
  send(CancelPrompt{});
  start();
  EXPECT_EQ(edit().prompt, Prompt::none);
}

TEST_F(Saving, UnansweredOfferIsMadeAgain) {
  removeBall();
  workspace_->keepUnsavedWork();
  start();
  const fs::path kept = edit().proposedFile;
  send(OpenScene{sceneFile("no_mirror")});
  waitFor([&] { return scene().file.filename() == "no_mirror.toml"; });
  send(Quit{});
  start();
  EXPECT_EQ(edit().prompt, Prompt::recovery);
  EXPECT_EQ(edit().proposedFile, kept);
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
