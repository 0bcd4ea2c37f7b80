#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/scene_loader.hpp"
#include "temporary_folder.hpp"

namespace speculum {
namespace {

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class ObjText : public testing::Test {
 protected:
  Mesh load(const std::string& text) { return loadObj(folder_.write("model.obj", text), textures_); }

  std::string faultOf(const std::string& text) {
    try {
      load(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::string file() const { return (folder_ / "model.obj").string(); }

  std::string place(int line) const { return file() + ":" + std::to_string(line) + ": "; }

 private:
  TemporaryFolder folder_;
  std::vector<Texture> textures_;
};

TEST_F(ObjText, ContinuedFaceHasTheVerticesOfAllItsLines) {
  for (const std::string end : {"\n", "\r\n"}) {
    const Mesh mesh = load(kSquare + "f 1 2 \\" + end + "3 \\" + end + "4" + end);
    EXPECT_EQ(mesh.indices.size(), 6u);
    EXPECT_EQ(mesh.halfExtent, glm::dvec3(0.5, 0.5, 0.0));
  }
}

TEST_F(ObjText, ContinuedVertexHasTheNumbersOfAllItsLines) {
  const Mesh mesh = load("v 0 0 \\\n4\nv 2 0 4\\\n\nv 0 2 4\nf 1 2 3\n");
  EXPECT_EQ(mesh.center, glm::dvec3(1.0, 1.0, 4.0));
}

TEST_F(ObjText, BackslashSeparatesTokens) {
  EXPECT_EQ(load(kSquare + "f 1 2\\\n3\n").indices.size(), 3u);
}

TEST_F(ObjText, ContinuationAtTheEndOfTheFileEndsTheLine) {
  EXPECT_EQ(load(kSquare + "f 1 2 3 \\").indices.size(), 3u);
}

TEST_F(ObjText, CommentIsNotContinued) {
  EXPECT_EQ(load(kSquare + "# C:\\models\\\nf 1 2 3\nf 1 3 4 # half \\\nf 1 2 4\n").indices.size(), 9u);
}

TEST_F(ObjText, FaultIsAtTheFirstOfContinuedLines) {
  EXPECT_TRUE(faultOf(kSquare + "f 1 2 \\\n\\\n9\n").starts_with(place(5)));
}

TEST_F(ObjText, LinesAfterContinuedOnesKeepTheirNumbers) {
  EXPECT_TRUE(faultOf(kSquare + "f 1 2 \\\n3 \\\r\n4\n\n# comment\nf 1 2 9\n").starts_with(place(10)));
}

TEST_F(ObjText, BytesThatAreNoModelAreTold) {
  std::string bytes;
  for (int i = 0; i < 4096; ++i) {
    bytes.push_back(static_cast<char>(1 + (i * 131 + i / 7) % 255));
  }
  for (const std::string& text :
       {std::string(), bytes, bytes + '\0', std::string(100, '\\'), std::string("\\\n\\\n")}) {
    const std::string fault = faultOf(text);
    EXPECT_TRUE(fault.starts_with(file() + ":")) << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace speculum
