#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "scene/obj_loader.hpp"
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

  void write(const std::string& name, const std::string& text) { folder_.write(name, text); }

  std::string mtl() const { return (folder_ / "m.mtl").string(); }

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

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += part;
  }
  return text;
}

TEST_F(ObjText, FacesOfUpTo1000Vertices) {
  EXPECT_TRUE(faultOf(kSquare + "f" + repeated(" 1 2 3 4", 250) + "\n").empty());
  EXPECT_EQ(faultOf(kSquare + "f" + repeated(" 1 2 3 4", 250) + " 1\n"),
            place(5) + "f: has 1001 vertices (3 .. 1000 are needed)");
}

TEST_F(ObjText, SecondByteOrderMarkIsNoFace) {
  EXPECT_EQ(load("\xef\xbb\xbf\xef\xbb\xbf" + std::string("f 99 99 99\n") + kSquare + "f 1 2 3\n").indices.size(), 3u);
}

TEST_F(ObjText, NumbersOfManyDigitsAreWhatTheyAre) {
  const std::string one = "1" + std::string(400, '0') + "e-400";
  EXPECT_EQ(load(kSquare + "v " + one + " 1 2\nf 1 2 5\n").halfExtent, glm::dvec3(0.5, 0.5, 1.0));
  const Mesh mesh = load(kSquare + "vn " + one + " 0 0\nvt " + one + " 0\nf 1/1/1 2/1/1 3/1/1\n");
  EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(1, 0, 0));
  EXPECT_EQ(mesh.vertices[0].uv, glm::dvec2(1, 0));
}

TEST_F(ObjText, ExponentsOfAnySize) {
  const Mesh mesh = load(kSquare + "v 1e2147483648 0 0\nv 2 0e99999999999 1e-2147483649\nf 1 2 5\nf 1 6 3\n");
  ASSERT_EQ(mesh.indices.size(), 3u);
  EXPECT_EQ(mesh.center + mesh.vertices[1].position, glm::dvec3(2, 0, 0));
}

TEST_F(ObjText, RadiusOfAnySize) {
  EXPECT_NEAR(load("v 0 0 0\nv 6e200 0 0\nv 0 8e200 0\nf 1 2 3\n").radius / 5e200, 1.0, 1e-14);
  EXPECT_NEAR(load("v 0 0 0\nv 6e-200 0 0\nv 0 8e-200 0\nf 1 2 3\n").radius / 5e-200, 1.0, 1e-14);
}

TEST_F(ObjText, MaterialsOfAFileNamedOftenAreReadOnce) {
  write("m.mtl", repeated("newmtl a\n", 10'000));
  const auto start = std::chrono::steady_clock::now();
  load(repeated("mtllib m.mtl\nmtllib ./m.mtl\n", 1000) + kSquare + "usemtl a\nf 1 2 3\n");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5)) << "read 2000 times it takes minutes";
  write("m.mtl", repeated("newmtl a\n", 10'001));
  EXPECT_EQ(faultOf("mtllib m.mtl\n" + kSquare + "f 1 2 3\n"),
            mtl() + ":10001: newmtl: is one too many (at most 10000 materials are read)");
}

TEST_F(ObjText, DevicesAreNoTextures) {
  write("m.mtl", "newmtl a\nmap_Kd /dev/zero\n");
  EXPECT_EQ(faultOf("mtllib m.mtl\n" + kSquare + "usemtl a\nf 1 2 3\n"),
            mtl() + ":2: map_Kd: /dev/zero: is a device or pipe (name a PNG or JPEG file, relative to the MTL file)");
}

}  // namespace
}  // namespace speculum
