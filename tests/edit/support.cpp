#include "edit/support.hpp"
#include "test_paths.hpp"

namespace speculum {

namespace fs = std::filesystem;

std::vector<fs::path> shippedScenes() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(sourceDir() / "scenes")) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::ranges::sort(files);
  return files;
}

void expectSameContent(const Scene& actual, const Scene& expected, const std::string& about) {
  EXPECT_EQ(actual.title, expected.title) << about;
  EXPECT_TRUE(actual.environment == expected.environment) << about;
  EXPECT_TRUE(actual.camera == expected.camera) << about;
  EXPECT_TRUE(actual.lights == expected.lights) << about;
  EXPECT_TRUE(actual.mirrors == expected.mirrors) << about;
  EXPECT_TRUE(actual.bookmarks == expected.bookmarks) << about;
  ASSERT_EQ(actual.objects.size(), expected.objects.size()) << about;
  for (size_t i = 0; i < actual.objects.size(); ++i) {
    const Object& wanted = expected.objects[i];
    Object object = actual.objects[i];
    EXPECT_TRUE(fs::equivalent(actual.meshes[object.mesh].source, expected.meshes[wanted.mesh].source)) << about;
    object.mesh = wanted.mesh;
    object.model = wanted.model;
    EXPECT_TRUE(object == wanted) << about << " object " << i;
  }
}

}  // namespace speculum
