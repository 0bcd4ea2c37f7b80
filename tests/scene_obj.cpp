#include <gtest/gtest.h>

#include "image/image.hpp"
#include "scene_support.hpp"

namespace speculum {
namespace {

constexpr const char* kVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

class ObjMaterial : public testing::Test {
 protected:
  Mesh load(const std::string& obj, const std::string& mtl) {
    folder_.write("m.mtl", mtl);
    return loadObj(folder_.write("m.obj", "mtllib m.mtl\n" + std::string(kVertices) + obj), textures_);
  }

  TemporaryFolder folder_;
  std::vector<Texture> textures_;
  LogCapture log_;
};

void expectDefault(const Material& material) {
  EXPECT_EQ(material.diffuse, glm::dvec3(0.6));
  EXPECT_EQ(material.specular, glm::dvec3(0.0));
  EXPECT_EQ(material.emission, glm::dvec3(0.0));
  EXPECT_EQ(material.shininess, 1.0);
  EXPECT_EQ(material.diffuseTexture, -1);
}

TEST_F(ObjMaterial, IsRead) {
  const Mesh mesh = load("usemtl red\nf 1 2 3\n",
                         "newmtl red\n\tKd 0.8 0.1 0.2 # a comment\n  Ks 0.1 0.2 0.3\nKe 1 2 3\nNs 64\r\nKa 1 1 1\n");
  const Material& material = mesh.parts.at(0).material;
  EXPECT_EQ(material.name, "red");
  EXPECT_NEAR(material.diffuse.x, 0.8, 1e-15);
  EXPECT_NEAR(material.diffuse.z, 0.2, 1e-15);
  EXPECT_NEAR(material.specular.y, 0.2, 1e-15);
  EXPECT_EQ(material.emission, glm::dvec3(1, 2, 3));
  EXPECT_EQ(material.shininess, 64.0);
  EXPECT_EQ(log_.text(), "");
}

TEST_F(ObjMaterial, ShininessBelowOneCountsAsOne) {
  EXPECT_EQ(load("usemtl m\nf 1 2 3\n", "newmtl m\nNs 0.2\n").parts[0].material.shininess, 1.0);
}

TEST_F(ObjMaterial, FacesAreGroupedInTheOrderOfFirstUse) {
  const Mesh mesh = load("f 1 2 3\nusemtl b\nf 1 2 3\nf 3 2 1\nusemtl a \nf 1 2 3\nusemtl b\nf 2 3 1\n",
                         "newmtl a\nKd 1 0 0\nnewmtl unused\nmap_Kd none.png\nnewmtl b\nKd 0 1 0\n");
  ASSERT_EQ(mesh.parts.size(), 3u);
  expectDefault(mesh.parts[0].material);
  EXPECT_EQ(mesh.parts[1].material.name, "b");
  EXPECT_EQ(mesh.parts[2].material.name, "a");
  EXPECT_EQ(mesh.parts[0].indexCount, 3u);
  EXPECT_EQ(mesh.parts[1].firstIndex, 3u);
  EXPECT_EQ(mesh.parts[1].indexCount, 9u);
  EXPECT_EQ(mesh.parts[2].firstIndex, 12u);
  EXPECT_EQ(mesh.parts[2].indexCount, 3u);
  EXPECT_EQ(mesh.indices.size(), 15u);
}

TEST_F(ObjMaterial, MissingFileIsAWarning) {
  const Mesh mesh =
      loadObj(folder_.write("m.obj", "mtllib none.mtl\nusemtl x\n" + std::string(kTriangleObj)), textures_);
  expectDefault(mesh.parts.at(0).material);
  EXPECT_EQ(log_.text(), "warning: " + (folder_ / "m.obj").string() + ": there is no material file '" +
                             (folder_ / "none.mtl").string() + "', its faces get the default material\n");
}

TEST_F(ObjMaterial, MissingNameIsOneWarning) {
  const Mesh mesh = load("usemtl x\nf 1 2 3\nusemtl x\nf 1 2 3\n", "newmtl y\nKd 1 1 1\n");
  expectDefault(mesh.parts.at(0).material);
  EXPECT_EQ(log_.text(), "warning: " + (folder_ / "m.obj").string() +
                             ": there is no material 'x', its faces get the default material\n");
}

TEST_F(ObjMaterial, OpacityIsAWarning) {
  for (const char* opacity : {"d 0.5", "Tr 0.5", "map_d mask.png"}) {
    load("usemtl m\nf 1 2 3\n", std::string("newmtl m\nKd 1 1 1\n") + opacity + "\n");
    EXPECT_NE(log_.text().find("m.mtl:1: material 'm' is not opaque, it is drawn opaque\n"), std::string::npos)
        << opacity;
  }
}

TEST_F(ObjMaterial, TextureIsDecodedToLinear) {
  Image8 image(2, 1);
  image.at(1, 0)[0] = 0;
  image.at(1, 0)[1] = 128;
  std::filesystem::create_directory(folder_ / "images");
  writePng(folder_ / "images/my wall.png", image);
  const Mesh mesh = load("usemtl m\nf 1 2 3\n", "newmtl m\nKd 1 1 1\nmap_Kd images\\my wall.png\n");
  EXPECT_EQ(mesh.parts[0].material.diffuseTexture, 0);
  ASSERT_EQ(textures_.size(), 1u);
  EXPECT_EQ(textures_[0].width, 2);
  EXPECT_EQ(textures_[0].height, 1);
  EXPECT_EQ(textures_[0].texels[0], glm::vec3(1.0f));
  EXPECT_EQ(textures_[0].texels[1], glm::vec3(0.0f, static_cast<float>(srgbDecode(128.0 / 255.0)), 1.0f));
}

TEST_F(ObjMaterial, OptionsOfATextureAreNotItsName) {
  writePng(folder_ / "a wall.png", Image8(1, 1));
  for (const char* options : {"-blendu on ", "-bm 0.5 -clamp off\t", "-o 1 ", "-o 1 2 3 -s 1e2147483648 -mm 0 1 "}) {
    const Mesh mesh =
        load("usemtl m\nf 1 2 3\n", std::string("newmtl m\nmap_Kd ") + options + "a wall.png\nKd 0.5 0.5 0.5\n");
    EXPECT_EQ(mesh.parts[0].material.diffuseTexture, 0) << options;
    EXPECT_EQ(mesh.parts[0].material.diffuse, glm::dvec3(0.5)) << options;
  }
  EXPECT_EQ(textures_.size(), 1u);
}

TEST_F(ObjMaterial, TextureThatCannotBeReadIsAnError) {
  folder_.write("text.png", "no picture");
  for (const char* name : {"none.png", "text.png"}) {
    const std::string message =
        inputErrorOf([&] { load("usemtl m\nf 1 2 3\n", std::string("newmtl m\nKd 1 1 1\nmap_Kd ") + name + "\n"); });
    EXPECT_EQ(message.rfind((folder_ / "m.mtl").string() + ":3: map_Kd: ", 0), 0u) << message;
    EXPECT_NE(message.find(name), std::string::npos) << message;
  }
}

struct Fault {
  const char* name;
  std::string text;
  const char* place;
  const char* message;
};

void PrintTo(const Fault& fault, std::ostream* stream) {
  *stream << fault.name;
}

std::string nameOf(const testing::TestParamInfo<Fault>& info) {
  return info.param.name;
}

class ObjFault : public testing::TestWithParam<Fault> {};

TEST_P(ObjFault, IsToldWithItsLine) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("m.obj", GetParam().text);
  std::vector<Texture> textures;
  const LogCapture quiet;
  const std::string message = inputErrorOf([&] { loadObj(file, textures); });
  EXPECT_EQ(message.rfind(file.string() + ":" + GetParam().place + " ", 0), 0u) << message;
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

const std::string kV = kVertices;

INSTANTIATE_TEST_SUITE_P(
    Tokens, ObjFault,
    testing::Values(
        Fault{"WordInPosition", "# a comment\nv 1 abc 2\n", "2: v:", "'abc' is not a number"},
        Fault{"TrailingLetters", "v 1 2 3x\n", "1: v:", "'3x' is not a number"},
        Fault{"TwoSigns", "v 1 2 +-3\n", "1: v:", "'+-3' is not a number"},
        Fault{"TwoCoordinates", "v 1 2\n", "1: v:", "has 2 numbers (3 .. 8 are needed)"},
        Fault{"NormalOfFour", "vn 1 2 3 4\n", "1: vn:", "has 4 numbers (3 are needed)"},
        Fault{"EmptyTexcoord", "vt\n", "1: vt:", "has 0 numbers (1 .. 3 are needed)"},
        Fault{"IndexTooLarge", kV + "f 1 2 4\n", "4: f:", "v index 4 is out of range (1 .. 3, or -3 .. -1)"},
        Fault{"IndexZero", kV + "f 0 1 2\n", "4: f:", "v index 0 is out of range"},
        Fault{"RelativeIndexTooFar", kV + "f -4 1 2\n", "4: f:", "v index -4 is out of range"},
        Fault{"IndexOfLaterVertex", kV + "f 1 2 4\nv 1 1 1\n", "4: f:", "v index 4 is out of range"},
        Fault{"IndexBeyondIntegers", kV + "f 1 2 99999999999999999999\n", "4: f:", "is out of range"},
        Fault{"TexcoordTooLarge", kV + "vt 0 0\nf 1/1 2/2 3/1\n", "5: f:", "vt index 2 is out of range (1 .. 1"},
        Fault{"NoTexcoords", kV + "f 1/1 2/1 3/1\n", "4: f:", "(there is no vt line above)"},
        Fault{"NormalTooLarge", kV + "vn 0 0 1\nf 1//1 2//1 3//2\n", "5: f:", "vn index 2 is out of range"},
        Fault{"NormalOfTriple", kV + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/-2 3/1/1\n", "6: f:", "vn index -2"},
        Fault{"IndexIsWord", kV + "f 1 2 x\n", "4: f:", "'x' is not an index"},
        Fault{"IndexIsEmpty", kV + "f 1 2 3//\n", "4: f:", "'' is not an index"},
        Fault{"IndexOfFour", kV + "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n", "6: f:", "'1/1' is not an index"},
        Fault{"FaceOfTwo", kV + "f 1 2\n", "4: f:", "has 2 vertices (a face needs 3 or more)"},
        Fault{"FaceOfNone", kV + "\nf\n", "5: f:", "has 0 vertices"},
        Fault{"LinesOfOldMacs", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 9\r", "4: f:", "v index 9"},
        Fault{"LinesOfWindows", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 9\r\n", "4: f:", "v index 9"},
        Fault{"Empty", "", "1: f:", "has no triangle"}, Fault{"OnlyVertices", kV, "1: f:", "has no triangle"},
        Fault{"OnlyDegenerateFaces", kV + "f 1 1 2\n", "1: f:", "has no triangle"},
        Fault{"Binary", std::string("\x7f\x45LF\0\0\1v 1\n", 10), "1: file:", "is not a text file"},
        Fault{"Text", "once upon a time\nthere was no model\n", "1: f:", "has no triangle"}),
    nameOf);

class MtlFault : public testing::TestWithParam<Fault> {};

TEST_P(MtlFault, IsToldWithItsLine) {
  const TemporaryFolder folder;
  const std::filesystem::path mtl = folder.write("m.mtl", GetParam().text);
  const std::filesystem::path obj = folder.write("m.obj", "mtllib m.mtl\n" + kV + "f 1 2 3\n");
  std::vector<Texture> textures;
  const std::string message = inputErrorOf([&] { loadObj(obj, textures); });
  EXPECT_EQ(message.rfind(mtl.string() + ":" + GetParam().place + " ", 0), 0u) << message;
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Tokens, MtlFault,
    testing::Values(Fault{"KdNan", "newmtl a\nKd nan 0 0\n", "2: Kd:", "is not finite"},
                    Fault{"KsNegative", "newmtl a\nKs 0 -1 0\n", "2: Ks:", "is negative"},
                    Fault{"KeIsWord", "newmtl a\nKe x 0 0\n", "2: Ke:", "'x' is not a number"},
                    Fault{"KdOfOne", "newmtl a\nKd 0.5\n", "2: Kd:", "has 1 numbers (3 are needed)"},
                    Fault{"NsInfinite", "newmtl a\nNs inf\n", "2: Ns:", "is not finite"},
                    Fault{"OpacityIsWord", "newmtl a\nd half\n", "2: d:", "'half' is not a number"},
                    Fault{"Binary", std::string("newmtl a\n\0\0", 11), "2: file:", "is not a text file"}),
    nameOf);

TEST(ObjFiles, MissingFileAndFolder) {
  const TemporaryFolder folder;
  std::vector<Texture> textures;
  const std::string missing = inputErrorOf([&] { loadObj(folder / "none.obj", textures); });
  EXPECT_EQ(missing.rfind((folder / "none.obj").string() + ":1: file: ", 0), 0u) << missing;
  const std::string directory = inputErrorOf([&] { loadObj(folder / "", textures); });
  EXPECT_NE(directory.find("is a folder"), std::string::npos) << directory;
}

TEST(ObjFiles, CommentsAndByteOrderMarkAreNoTokens) {
  const TemporaryFolder folder;
  std::vector<Texture> textures;
  const LogCapture log;
  const Mesh mesh = loadObj(
      folder.write("m.obj", "\xef\xbb\xbfv 0 0 0 # first\nv 1 0 0\nv 0 1 0\nf 1 2 3 # 1 2 3\nf 3 2 1#x"), textures);
  EXPECT_EQ(mesh.indices.size(), 6u);
  EXPECT_EQ(log.text(), "");
}

}  // namespace
}  // namespace speculum
