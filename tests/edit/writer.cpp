// Scene files that were edited and saved.
#include <cctype>

#include "edit/support.hpp"
#include "error_message.hpp"
#include "image/picture_files.hpp"
#include "settings/field_changes.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {
namespace {

namespace fs = std::filesystem;
using Kind = Selection::Kind;

// Returns the comments of a scene file, which must survive changes of values.
std::vector<std::string> commentsOf(const std::string& text) {
  std::vector<std::string> comments;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (line.starts_with('#')) {
      comments.push_back(line);
    }
    at = end + 1;
  }
  return comments;
}

// A scene file in a folder of its own whose models are those of the shipped one.
struct ShippedCopy {
  explicit ShippedCopy(const fs::path& shipped) : file(folder.write("scene.toml", "")) {
    scene = loadScene(shipped);
    original = scene.text;
  }

  Scene reloaded(SceneDocument& document) {
    document.save(file, {}, true);
    return loadScene(file);
  }

  TemporaryFolder folder;
  fs::path file;
  Scene scene;
  std::string original;
};

class ShippedScene : public testing::TestWithParam<fs::path> {};

TEST_P(ShippedScene, UnchangedTextIsTheSameBytes) {
  Scene scene = loadScene(GetParam());
  const SceneDocument document(scene);
  EXPECT_EQ(document.text(GetParam(), {}), readText(GetParam()));
}

void changeEverything(Scene& scene) {
  changeFields(scene.environment);
  changeFields(scene.camera);
  const auto changeAll = [](auto& nodes) { std::ranges::for_each(nodes, [](auto& n) { changeFields(n); }); };
  changeAll(scene.objects);
  changeAll(scene.lights);
  changeAll(scene.mirrors);
  changeAll(scene.bookmarks);
}

TEST_P(ShippedScene, ChangedFieldsReadBackAndCommentsStay) {
  ShippedCopy copy(GetParam());
  SceneDocument document(copy.scene);
  document.change("everything", {}, changeEverything);
  const Scene read = copy.reloaded(document);
  expectSameContent(read, copy.scene, GetParam().string());
  EXPECT_EQ(commentsOf(read.text), commentsOf(copy.original));
  document.undo();
  EXPECT_EQ(document.text(GetParam(), {}), copy.original);
}

TEST_P(ShippedScene, NodesComeAndGo) {
  ShippedCopy copy(GetParam());
  SceneDocument document(copy.scene);
  const glm::dvec3 viewer = copy.scene.camera.position;
  for (size_t i = copy.scene.objects.size(); i-- > 0;) {
    const Selection node{Kind::object, static_cast<int>(i)};
    document.duplicate({&node, 1});
    if (i % 2 == 0) {
      document.remove({{Kind::object, static_cast<int>(i)}});
    }
  }
  for (size_t i = copy.scene.mirrors.size(); i-- > 0;) {
    const Selection node{Kind::mirror, static_cast<int>(i)};
    document.duplicate({&node, 1});
    document.remove({{Kind::mirror, static_cast<int>(i)}});
  }
  for (size_t i = copy.scene.lights.size(); i-- > 1;) {
    document.remove({{Kind::light, static_cast<int>(i)}});
  }
  document.addMirror(viewer + glm::dvec3(0.0, 0.0, -3.0), viewer);
  document.addLight(viewer + glm::dvec3(0.0, 1.0, -3.0), viewer);
  if (!copy.scene.meshes.empty()) {
    document.addObject(0, {1.0, 2.0, 3.0});
  }
  document.addBookmark({.name = "here", .position = viewer, .target = viewer + glm::dvec3(0.0, 0.1, -1.0)});
  const Scene read = copy.reloaded(document);
  expectSameContent(read, copy.scene, GetParam().string());
  while (document.canUndo()) {
    document.undo();
  }
  EXPECT_EQ(document.text(GetParam(), {}), copy.original);
}

std::string nameOfFile(const testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.parent_path().filename().string() + "_" + info.param.stem().string();
  std::ranges::replace_if(
      name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Every, ShippedScene, testing::ValuesIn(shippedScenes()), nameOfFile);

constexpr const char* fileText = R"(title = "a"
[camera]
position = [0, 1, 4]
target = [0, 0, 0]
[[object]]
model = "./triangle.obj" # beside the scene
)";

void moveObject(SceneDocument& document, double x) {
  document.change("move", {}, [x](Scene& scene) { scene.objects[0].position.x = x; });
}

TEST(SaveScene, ModelsAreFoundFromAnotherFolder) {
  TextScene text(fileText);
  fs::create_directories(text.folder / "a b/c");
  moveObject(text.document, 1);
  text.document.save(text.folder / "a b/c/moved.toml", {});
  EXPECT_EQ(text.scene.file, text.folder / "a b/c/moved.toml");
  const Scene read = loadScene(text.folder / "a b/c/moved.toml");
  EXPECT_EQ(read.objects[0].model, "../../triangle.obj");
  expectSameContent(read, text.scene, "moved");
  EXPECT_EQ(readText(text.file), fileText) << "the first file is left alone";
  moveObject(text.document, 0);
  text.document.save(text.file, {}, true);
  EXPECT_EQ(readText(text.file), fileText) << "back home all is as it was";
}

TEST(SaveScene, MapsOfMirrorsAreFoundAndCopied) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "elsewhere/deep");
  fs::create_directories(folder / "maps");
  writePng(folder / "maps/dirt.png", Image8(2, 2));
  const fs::path file = folder.write("home/scene.toml",
                                     "[camera]\nposition = [0, 1, 4]\ntarget = [0, 0, 0]\n[[mirror]]\nsize = [1, 1]\n"
                                     "reflectance_map = \"../maps/./dirt.png\"\n");
  Scene scene = loadScene(file);
  ASSERT_EQ(scene.mirrors[0].map, 0);
  SceneDocument document(scene);
  const Selection mirror{Kind::mirror, 0};
  document.duplicate({&mirror, 1});
  document.save(folder / "elsewhere/moved.toml", {});
  for (const Mirror& read : loadScene(folder / "elsewhere/moved.toml").mirrors) {
    EXPECT_EQ(read.reflectanceMap, "../maps/dirt.png");
  }
  EXPECT_EQ(filesNamedBy(folder / "elsewhere/moved.toml").size(), 2u);
  EXPECT_EQ(mapsOutside(scene, folder / "elsewhere"), std::vector<size_t>{0});
  document.save(folder / "elsewhere/deep/packed.toml", {}, false, true);
  const Scene packed = loadScene(folder / "elsewhere/deep/packed.toml");
  EXPECT_EQ(packed.mirrors[0].reflectanceMap, "models/dirt.png");
  EXPECT_TRUE(mapsOutside(packed, folder / "elsewhere/deep").empty());
  document.save(file, {}, true);
  EXPECT_EQ(loadScene(file).mirrors[1].map, 0);
}

TEST(SaveScene, AbsolutePathsStay) {
  const TemporaryFolder folder;
  const fs::path model = folder.write("models/triangle.obj", triangleObj);
  const fs::path file = folder.write("scene.toml",
                                     "[camera]\nposition = [0, 1, 4]\ntarget = [0, 0, 0]\n[[object]]\n"
                                     "model = '" +
                                         model.string() + "'\n");
  Scene scene = loadScene(file);
  SceneDocument document(scene);
  document.save(folder / "models/scene.toml", {});
  EXPECT_EQ(readText(folder / "models/scene.toml"), readText(file));
}

TEST(SaveScene, NamesThatAreNotUtf8ReadBack) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "lat\xfcn");
  const fs::path model = folder.write("lat\xfcn/w\xff.obj", triangleObj);
  Scene scene = loadScene(model);
  SceneDocument document(scene);
  for (const char* name : {"lat\xfcn/scene.toml", "scene.toml"}) {
    document.save(folder / name, {});
    EXPECT_TRUE(fs::equivalent(loadScene(folder / name).meshes.at(0).source, model)) << name;
  }
  folder.write("lat\xfcn/w\u00ff.obj", triangleObj);
  const std::string message = messageOf<SaveError>([&] { document.save(folder / "other.toml", {}); });
  EXPECT_TRUE(contains(message, "would not be found as 'lat\u00fcn/w\u00ff.obj'")) << message;
}

TEST(SaveScene, FileChangedMeanwhileIsNotOverwritten) {
  TextScene text(fileText);
  moveObject(text.document, 1);
  const std::string theirs = std::string(fileText) + "# mine now\n";
  text.folder.write("scene.toml", theirs);
  const std::string message = messageOf<SaveError>([&] { text.document.save(text.file, {}); });
  EXPECT_TRUE(contains(message, "another program has changed the file"));
  EXPECT_TRUE(contains(message, "save under another name, or overwrite"));
  EXPECT_EQ(readText(text.file), theirs);
  EXPECT_TRUE(text.document.modified());
  text.document.save(text.file, {}, true);
  EXPECT_FALSE(text.document.modified());
  moveObject(text.document, 2);
  text.document.save(text.file, {});
  expectSameContent(loadScene(text.file), text.scene, "saved twice");
}

TEST(SaveScene, LinksAndModesStay) {
  TextScene text(fileText);
  const fs::path behind = text.folder / "behind.toml";
  fs::rename(text.file, behind);
  fs::permissions(behind, fs::perms(0640));
  fs::create_symlink("behind.toml", text.file);
  moveObject(text.document, 1);
  text.document.save(text.file, {});
  EXPECT_TRUE(fs::is_symlink(text.file));
  EXPECT_EQ(fs::status(behind).permissions(), fs::perms(0640));
  expectSameContent(loadScene(behind), text.scene, "behind the link");
}

TEST(SaveScene, AnotherFileIsNotOverwritten) {
  TextScene text(fileText);
  const fs::path other = text.folder.write("other.toml", "important");
  EXPECT_TRUE(contains(messageOf<SaveError>([&] { text.document.save(other, {}); }), "there is such a file already"));
  EXPECT_EQ(readText(other), "important");
  EXPECT_TRUE(contains(messageOf<SaveError>([&] { text.document.save(text.model, {}, true); }), "name of a model"));
  EXPECT_EQ(readText(text.model), triangleObj);
}

TEST(SaveScene, DeletedFileIsWrittenAgain) {
  TextScene text(fileText);
  fs::remove(text.file);
  text.document.save(text.file, {});
  EXPECT_EQ(readText(text.file), fileText);
}

TEST(SaveScene, UnreadableSceneIsNotWritten) {
  TextScene text(fileText);
  text.document.change("break", {}, [](Scene& scene) { scene.camera.target = scene.camera.position; });
  const std::string camera = messageOf<SaveError>([&] { text.document.save(text.file, {}); });
  EXPECT_TRUE(contains(camera, "camera.target: has no direction"));
  EXPECT_FALSE(contains(camera, "\n"));
  text.document.undo();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  text.document.change("break", {}, [&](Scene& scene) { scene.objects[0].scale = glm::dvec3(nan); });
  EXPECT_TRUE(contains(messageOf<SaveError>([&] { text.document.save(text.file, {}); }), "not saved"));
  EXPECT_EQ(readText(text.file), fileText);
  text.document.undo();
  const std::string setting = messageOf<SaveError>([&] {
    text.document.save(text.file, {{{"view.exposure", "bright"}}});
  });
  EXPECT_TRUE(contains(setting, "view.exposure"));
}

TEST(SaveScene, MissingFolderIsAnError) {
  TextScene text(fileText);
  const std::string message = messageOf<SaveError>([&] { text.document.save(text.folder / "none/scene.toml", {}); });
  EXPECT_TRUE(contains(message, "there is no folder"));
  EXPECT_EQ(text.scene.file, text.file);
}

TEST(SaveScene, EverySettingReadsBack) {
  Settings other;
  for (const SettingField& field : settingFields()) {
    for (const char* value : {"true", "false", "0.123456789", "0.5", "1e-3", "2", "32", "512", "oblique", "aces",
                              "trilinear", "image", "environment", "map", "software", "rays", "1, 0,0.25", "x"}) {
      if (sameSetting(field, other, Settings())) {
        setSetting(other, field.key, value);
      }
    }
  }
  const std::string before =
      "[settings]\n\"view.exposure\" = 2 # bright\n" + std::string(fileText + sizeof("title = \"a\""));
  TextScene text(before);
  const std::vector<SettingChange> changes = settingChanges(Settings(), other);
  for (const SettingField& field : settingFields()) {
    EXPECT_FALSE(sameSetting(field, other, Settings())) << field.key << " is not tried";
  }
  text.document.save(text.file, changes);
  EXPECT_EQ(settingsKey(settingsOf(loadScene(text.file))), settingsKey(other));
  EXPECT_TRUE(contains(readText(text.file), "\"view.exposure\" = 0.123456789 # bright\n"));
  text.document.save(text.file, {});
  EXPECT_EQ(readText(text.file), before);
}

// The file that a scene is saved to when the user types a name.
TEST(SavePlace, MissingTomlEndingIsAdded) {
  EXPECT_EQ(sceneFileNamed("/a/b.toml"), "/a/b.toml");
  EXPECT_EQ(sceneFileNamed("/a/b"), "/a/b.toml");
  EXPECT_EQ(sceneFileNamed("b.v2"), "b.v2.toml");
  EXPECT_EQ(sceneFileNamed("b.obj"), "b.obj") << "a model: refused later, with its reason";
  EXPECT_THROW(sceneFileNamed(""), SaveError);
  EXPECT_THROW(sceneFileNamed("/a/"), SaveError);
}

TEST(SavePlace, MissingFolderIsNamed) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(requireFolder(folder / "a.toml"));
  EXPECT_NO_THROW(requireFolder("a.toml")) << "the working directory";
  const std::string error = messageOf<SaveError>([&] { requireFolder(folder / "one" / "two" / "a.toml"); });
  EXPECT_TRUE(contains(error, "no folder " + (folder / "one").string() + " ("));
  std::ofstream(folder / "file") << "no folder";
  EXPECT_THROW(requireFolder(folder / "file" / "a.toml"), SaveError);
  EXPECT_FALSE(fs::exists(folder / "one"));
}

TEST(SavePlace, DeletedWorkingFolderIsRefused) {
  const fs::path before = fs::current_path();
  {
    const TemporaryFolder folder;
    fs::current_path(folder / "");
  }
  EXPECT_THROW(requireFolder("a.toml"), SaveError);
  EXPECT_NO_THROW(requireFolder("/tmp/a.toml"));
  fs::current_path(before);
}

}  // namespace
}  // namespace speculum
