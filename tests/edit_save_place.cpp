// The file that a scene is saved to when the user types a name.
#include "edit/scene_writer.hpp"
#include "error_message.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

namespace fs = std::filesystem;

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
