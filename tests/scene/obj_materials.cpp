#include "scene/obj_loader.hpp"

#include <ctime>

#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "instrumented.hpp"
#include "made_pictures.hpp"
#include "scene/materials.hpp"
#include "scene/model_files.hpp"
#include "scene/obj_support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

class MtlFile : public ObjTest {
 protected:
  // Returns the material m of that text, which a face has.
  Material materialOf(const std::string& mtl) {
    return load(squareText + "usemtl m\nf 1 2 3\n", mtl).parts.at(0).material;
  }
};

void expectDefault(const Material& material) {
  EXPECT_EQ(material.diffuse, glm::dvec3(0.6));
  EXPECT_EQ(material.specular, glm::dvec3(0.0));
  EXPECT_EQ(material.emission, glm::dvec3(0.0));
  EXPECT_EQ(material.shininess, 1.0);
  EXPECT_EQ(material.diffuseTexture, -1);
}

TEST_F(MtlFile, IsRead) {
  const Mesh mesh = load(squareText + "usemtl red\nf 1 2 3\n",
                         "newmtl red\n\tKd 0.8 0.1 0.2 # a comment\n  Ks 0.1 0.2 0.3\nKe 1 2 3\nNs 64\r\nKa 1 1 1\n");
  const Material& material = mesh.parts.at(0).material;
  EXPECT_EQ(material.name, "red");
  EXPECT_NEAR(material.diffuse.x, 0.8, 1e-15);
  EXPECT_NEAR(material.diffuse.z, 0.2, 1e-15);
  EXPECT_NEAR(material.specular.y, 0.2, 1e-15);
  EXPECT_EQ(material.emission, glm::dvec3(1, 2, 3));
  EXPECT_EQ(material.shininess, 64.0);
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlFile, OtherFormsOfNumbersAreRead) {
  const Material material = materialOf("newmtl m\nKd 0.5\nKs xyz 0.1 0.2 0.3\nKe spectral lamp.rfl 2\nd -halo 1\n");
  EXPECT_EQ(material.diffuse, glm::dvec3(0.5)) << "one number counts for all three";
  EXPECT_EQ(material.specular, glm::dvec3(0.0));
  EXPECT_EQ(warnings(),
            "warning: m.mtl:3: Ks: is not three numbers, it is left out\n"
            "warning: m.mtl:4: Ke: is not three numbers, it is left out\n");
}

TEST(MetalRoughness, BecomesDiffuseAndSpecular) {
  Material material;
  const glm::dvec3 base(0.8, 0.4, 0.2);
  setMetalRoughness(material, base, 0.0, 0.5);
  EXPECT_EQ(material.diffuse, base);
  EXPECT_EQ(material.specular, glm::dvec3(0.04));
  EXPECT_DOUBLE_EQ(material.shininess, 30.0);
  setMetalRoughness(material, base, 1.0, 0.5);
  EXPECT_EQ(material.diffuse, glm::dvec3(0.0));
  EXPECT_EQ(material.specular, base);
  setMetalRoughness(material, base, 1.0, 0.75);
  EXPECT_EQ(material.diffuse, 0.5 * base);
  EXPECT_LE(glm::distance(material.specular, 0.5 * (base + 0.04)), 1e-15);
  setMetalRoughness(material, base, 1.0, 1.0);
  EXPECT_EQ(material.diffuse, base);
  EXPECT_EQ(material.specular, glm::dvec3(0.04));
  EXPECT_EQ(material.shininess, 1.0);
  setMetalRoughness(material, base, 7.0, -1.0);
  EXPECT_EQ(material.specular, base);
  EXPECT_EQ(material.shininess, 1e6);
}

TEST_F(MtlFile, MetalAndRoughnessReplaceColors) {
  const Material metal = materialOf("newmtl m\nKd 0.8 0.4 0.2\nKs 1 1 1\nPm 1\nPr 0.5\n");
  EXPECT_EQ(metal.diffuse, glm::dvec3(0.0));
  EXPECT_NEAR(glm::distance(metal.specular, glm::dvec3(0.8, 0.4, 0.2)), 0.0, 1e-12);
  EXPECT_NEAR(metal.shininess, 30.0, 1e-9);
  const Material plastic = materialOf("newmtl m\nKd 0.8 0.4 0.2\nNs 30\npm 0\n");
  EXPECT_NEAR(glm::distance(plastic.diffuse, glm::dvec3(0.8, 0.4, 0.2)), 0.0, 1e-12);
  EXPECT_EQ(plastic.specular, glm::dvec3(0.04));
  EXPECT_NEAR(plastic.shininess, 30.0, 1e-9) << "without Pr the roughness follows from Ns";
  EXPECT_EQ(materialOf("newmtl m\nPr what\n").specular, glm::dvec3(0.0));
  EXPECT_EQ(warnings(), "warning: m.mtl:2: Pr: is not a finite number, it is left out\n");
  EXPECT_NEAR(materialOf("newmtl m\nNs 30\nPm 0\nPr what\n").shininess, 30.0, 1e-9);
  EXPECT_EQ(materialOf("newmtl m\nPm 7\nPr 0.5\n").diffuse, glm::dvec3(0.0));
  EXPECT_TRUE(contains(warnings(), "m.mtl:2: Pm: is out of range, the nearest number in range counts"));
}

TEST_F(MtlFile, TexturedMetalsHaveHighlightsOfTheMeanColor) {
  writePng(folder_.path() / "t.png",
           testing_support::madePicture(2, 1, [](int x, int) { return glm::ivec4(255 * x, 0, 255, 255); }));
  const Material metal = materialOf("newmtl m\nmap_Kd t.png\nKd 0.5 0.5 0.5\nPm 1\nPr 0.5\n");
  EXPECT_EQ(metal.specular, glm::dvec3(0.25, 0.0, 0.5));
  EXPECT_EQ(metal.diffuseTexture, 0);
}

TEST_F(MtlFile, EmissionTexturesCountByTheirMean) {
  writePng(folder_.path() / "t.png",
           testing_support::madePicture(2, 1, [](int x, int) { return glm::ivec4(255 * x, 0, 255, 255); }));
  EXPECT_EQ(materialOf("newmtl m\nmap_Ke t.png\n").emission, glm::dvec3(0.5, 0.0, 1.0));
  EXPECT_EQ(materialOf("newmtl m\nmap_Ke t.png\nKe 4\n").emission, glm::dvec3(2.0, 0.0, 4.0));
  EXPECT_EQ(materialOf("newmtl m\nKe 0 0 0\nmap_Ke t.png\n").emission, glm::dvec3(0.5, 0.0, 1.0));
  EXPECT_EQ(materialOf("newmtl m\nKe 1 2 3\nmap_Ke none.png\n").emission, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_TRUE(textures_.empty());
  EXPECT_EQ(warnings(), "warning: m.mtl:3: map_Ke: there is no file 'none.png', the texture is left out\n");
  EXPECT_EQ(materialOf("newmtl m\nmap_Ke none.png\n").emission, glm::dvec3(0.0));
}

TEST_F(MtlFile, ShininessBelowOneCountsAsOne) {
  EXPECT_EQ(materialOf("newmtl m\nNs 0.2\n").shininess, 1.0);
}

TEST_F(MtlFile, FacesAreGroupedByFirstUse) {
  const Mesh mesh = load(squareText + "f 1 2 3\nusemtl b\nf 1 2 3\nf 3 2 1\nusemtl a \nf 1 2 3\nusemtl b\nf 2 3 1\n",
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

TEST_F(MtlFile, MissingFileIsAWarning) {
  const Mesh mesh = load("mtllib none.mtl\nusemtl x\n" + std::string(triangleObj));
  expectDefault(mesh.parts.at(0).material);
  EXPECT_EQ(warnings(), "warning: m.obj:1: mtllib: there is no file 'none.mtl', its faces get the default material\n");
}

TEST_F(MtlFile, MissingNameIsOneWarning) {
  const Mesh mesh = load(squareText + "usemtl x\nf 1 2 3\nusemtl x\nf 1 2 3\n", "newmtl y\nKd 1 1 1\n");
  expectDefault(mesh.parts.at(0).material);
  EXPECT_EQ(warnings(), "warning: m.obj:6: usemtl: there is no material 'x', its faces get the default one\n");
}

TEST_F(MtlFile, OpacityIsRead) {
  EXPECT_EQ(materialOf("newmtl m\nd 0.25\n").opacity, 0.25);
  EXPECT_EQ(materialOf("newmtl m\nd -halo 0.25\n").opacity, 0.25);
  EXPECT_EQ(materialOf("newmtl m\nTr 0.25\n").opacity, 0.75);
  EXPECT_EQ(materialOf("newmtl m\nd 7\n").opacity, 1.0);
  EXPECT_FALSE(materialOf("newmtl m\nd 1\n").isTransparent());
  EXPECT_EQ(warnings(), "");
}

// Exporters write Tr 1, and d 0, for materials that are meant to be seen.
TEST_F(MtlFile, MaterialsWithoutOpacityAreDrawnAsOpaque) {
  for (const std::string line : {"d 0", "Tr 1", "Tr 1.000", "d -3", "d 0\nmap_Kd none.png"}) {
    EXPECT_EQ(materialOf("newmtl m\n" + line + "\n").opacity, 1.0) << line;
  }
  EXPECT_TRUE(contains(warnings(), "m.mtl:1: newmtl: 'm' has no opacity at all, it is drawn as with d 1"));
}

TEST_F(MtlFile, TexturesGiveOpacity) {
  const auto write = [&](const char* name, const auto& color) {
    writePng(folder_.path() / name, testing_support::madePicture(4, 4, color));
  };
  write("leaf.png", [](int x, int) { return glm::ivec4(255, 255, 255, x < 2 ? 0 : 255); });
  write("veil.png", [](int x, int) { return glm::ivec4(255, 255, 255, 64 * x); });
  const auto reds = [](int x, int) { return glm::ivec4(51 * x, 0, 0, 255); };
  folder_.write("mask.tga", testing_support::tgaFile(testing_support::madePicture(4, 4, reds), 24, 0));
  const Material leaf = materialOf("newmtl m\nmap_Kd leaf.png\n");
  EXPECT_EQ(leaf.opacityTexture, leaf.diffuseTexture);
  EXPECT_EQ(leaf.cutoff, 0.5);
  EXPECT_LT(materialOf("newmtl m\nmap_Kd leaf.png\nd 0.5\n").cutoff, 0.0);
  const Material veil = materialOf("newmtl m\nmap_Kd veil.png\n");
  EXPECT_LT(veil.cutoff, 0.0);
  EXPECT_TRUE(veil.isTransparent());
  const Material mask = materialOf("newmtl m\nmap_Kd leaf.png\nmap_d mask.tga\n");
  EXPECT_NE(mask.opacityTexture, mask.diffuseTexture);
  EXPECT_EQ(textures_[static_cast<size_t>(mask.opacityTexture)].opacity[1], 0.2f);
  EXPECT_FALSE(materialOf("newmtl m\nmap_d none.png\n").isTransparent());
  EXPECT_EQ(warnings(), "warning: m.mtl:2: map_d: there is no file 'none.png', the texture is left out\n");
}

// Whether a picture has alpha is a matter of its file, not of its pixels.
TEST_F(MtlFile, OpaqueTexturesAreNoCoverage) {
  const auto reds = [](int x, int) { return glm::ivec4(51 * x, 0, 0, 255); };
  const Image8 red = testing_support::madePicture(4, 4, reds);
  writePng(folder_ / "alpha.png", red);
  folder_.write("alpha.tga", testing_support::tgaFile(red, 32, 8));
  folder_.write("white.tga", testing_support::tgaFile(Image8(4, 4), 24, 0));
  for (const std::string picture : {"alpha.png", "alpha.tga", "white.tga"}) {
    const std::string keys = "map_Kd " + picture + "\nmap_d " + picture;
    EXPECT_FALSE(materialOf("newmtl m\nNs 900\n" + keys + "\n").isTransparent()) << keys;
    const Material alone = materialOf("newmtl m\nmap_d " + picture + "\n");
    EXPECT_EQ(alone.isTransparent(), picture != "white.tga") << "its red is meant: " << picture;
  }
  const Mesh two = load(squareText + "usemtl m\nf 1 2 3\nusemtl n\nf 1 3 4\n",
                        "newmtl m\nmap_d white.tga\nnewmtl n\nillum 3\nKs 1\nNs 900\nmap_d white.tga\n");
  EXPECT_TRUE(two.parts.at(1).material.mirror) << "an opaque picture is no coverage of a mirror";
  EXPECT_TRUE(contains(two.materialFiles.back().string(), "white.tga")) << "a change of the file is noticed";
  EXPECT_EQ(warnings(), "warning: m.mtl:4: map_d: 'white.tga' is that of map_Kd and has no alpha, it is left out\n");
}

// Exporters name one picture as color and as opacity, whether it has alpha or not.
TEST_F(MtlFile, ColorsAreNoOpacity) {
  const auto colors = [](int x, int) { return glm::ivec4(51 * x, 0, 0, 85 * x); };
  const Image8 picture = testing_support::madePicture(4, 4, colors);
  folder_.write("rgb.tga", testing_support::tgaFile(picture, 24, 0));
  folder_.write("rgba.tga", testing_support::tgaFile(picture, 32, 8));
  EXPECT_FALSE(materialOf("newmtl m\nmap_Kd rgb.tga\nmap_d RGB.TGA\n").isTransparent());
  EXPECT_EQ(warnings(), "warning: m.mtl:3: map_d: 'RGB.TGA' is that of map_Kd and has no alpha, it is left out\n");
  const Material both = materialOf("newmtl m\nmap_Kd rgba.tga\nmap_d rgba.tga\n");
  EXPECT_EQ(both.opacityTexture, both.diffuseTexture);
  EXPECT_TRUE(both.isTransparent());
}

// The fourth byte of a pixel is unused, or an exporter left it zero.
TEST_F(MtlFile, TexturesWithoutOpacityAreDrawnAsOpaque) {
  const auto clear = [](int x, int) { return glm::ivec4(51 * x, 0, 0, 0); };
  const Image8 picture = testing_support::madePicture(4, 4, clear);
  folder_.write("unused.tga", testing_support::tgaFile(picture, 32, 0));
  EXPECT_FALSE(materialOf("newmtl m\nmap_Kd unused.tga\n").isTransparent());
  EXPECT_EQ(warnings(), "");
  folder_.write("zero.tga", testing_support::tgaFile(picture, 32, 8));
  writePng(folder_ / "zero.png", picture);
  for (const std::string keys : {"map_Kd zero.tga", "map_Kd zero.png", "map_d zero.png"}) {
    EXPECT_FALSE(materialOf("newmtl m\n" + keys + "\n").isTransparent()) << keys;
  }
  EXPECT_TRUE(contains(warnings(), "m.mtl:1: newmtl: 'm' has a texture without any opacity, it is drawn as opaque"));
}

// Blender and others write d, illum and, for textures of opacity, map_d.
TEST_F(MtlFile, AlphaIsIgnoredWhereMaterialsSayOpaque) {
  writePng(folder_.path() / "gloss.png",
           testing_support::madePicture(4, 4, [](int x, int) { return glm::ivec4(255, 255, 255, x < 2 ? 0 : 255); }));
  const std::string keys = "newmtl m\nmap_Kd gloss.png\n";
  for (const char* opaque : {"d 1\nillum 2\n", "illum 0\nTr 0.000\n", "D 1\nIllum 3\n"}) {
    EXPECT_FALSE(materialOf(keys + opaque).isTransparent()) << opaque;
    EXPECT_TRUE(materialOf(keys + opaque + "map_d gloss.png\n").isTransparent()) << opaque;
    EXPECT_TRUE(materialOf("newmtl x\n" + std::string(opaque) + keys).isTransparent()) << "another material's keys";
  }
  for (const char* open : {"", "d 1\n", "illum 2\n", "d 1\nillum 4\n", "d 0\nillum 2\n", "d 0.5\nillum 2\n"}) {
    EXPECT_TRUE(materialOf(keys + open).isTransparent()) << open;
  }
}

TEST_F(MtlFile, TexturesMayBeMovedAndClamped) {
  writePng(folder_.path() / "t.png", Image8(2, 2));
  const std::string obj = squareText + "vt 1 2\nvt 100 0\nvt 0 0\nusemtl m\nf 1/1 2/2 3/3\n";
  const Mesh moved = load(obj, "newmtl m\nmap_Kd -s 2 -1 -o 0.5 1 t.png\n");
  std::vector<glm::dvec2> uv;
  for (const uint32_t index : moved.indices) {
    uv.push_back(moved.vertices[index].uv - moved.vertices[moved.indices[0]].uv);
  }
  EXPECT_EQ(uv[1], glm::dvec2(198, 2));
  EXPECT_EQ(uv[2], glm::dvec2(-2, 2));
  EXPECT_EQ(glm::fract(moved.vertices[moved.indices[0]].uv), glm::dvec2(0.5, 0));
  EXPECT_FALSE(moved.parts[0].material.clamps);
  const Mesh clamped = load(obj, "newmtl m\nmap_Kd -clamp on t.png\n");
  EXPECT_TRUE(clamped.parts[0].material.clamps);
  EXPECT_EQ(clamped.vertices[clamped.indices[1]].uv, glm::dvec2(100, 0)) << "whole numbers count";
  EXPECT_EQ(clamped.repeats, 0u);
}

TEST_F(MtlFile, TextureIsDecodedToLinear) {
  Image8 image(2, 1);
  image.at(1, 0)[0] = 0;
  image.at(1, 0)[1] = 128;
  std::filesystem::create_directory(folder_ / "images");
  writePng(folder_ / "images/my wall.png", image);
  EXPECT_EQ(materialOf("newmtl m\nKd 1 1 1\nmap_Kd images\\my wall.png\n").diffuseTexture, 0);
  ASSERT_EQ(textures_.size(), 1u);
  EXPECT_EQ(textures_[0].width, 2);
  EXPECT_EQ(textures_[0].height, 1);
  EXPECT_EQ(textures_[0].texels[0], glm::vec3(1.0f));
  EXPECT_EQ(textures_[0].texels[1], glm::vec3(0.0f, static_cast<float>(srgbDecode(128.0 / 255.0)), 1.0f));
}

TEST_F(MtlFile, TextureAloneHasItsOwnColor) {
  writePng(folder_ / "t.png", Image8(1, 1));
  for (const char* more : {"", "map_Kd\n", "map_Kd -bm 1\n"}) {  // without a name they change nothing
    const Material material = materialOf(std::string("newmtl black\nKd 0 0 0\nnewmtl m\nmap_Kd t.png\n") + more);
    EXPECT_EQ(material.diffuse, glm::dvec3(1.0)) << more;
    EXPECT_EQ(material.diffuseTexture, 0) << more;
  }
}

TEST_F(MtlFile, TextureOptionsAreNotItsName) {
  writePng(folder_ / "a wall.png", Image8(1, 1));
  for (const char* options : {"-blendu on ", "-bm 0.5 -clamp off\t", "-o 1 ", "-o 1 2 3 -s 1e2147483648 -mm 0 1 "}) {
    const Material material = materialOf(std::string("newmtl m\nmap_Kd ") + options + "a wall.png\nKd 0.5 0.5 0.5\n");
    EXPECT_EQ(material.diffuseTexture, 0) << options;
    EXPECT_EQ(material.diffuse, glm::dvec3(0.5)) << options;
  }
  EXPECT_EQ(textures_.size(), 1u);
}

// Every option with each of its words, too few of them, and none, in any case, before the names of files.
TEST_F(MtlFile, TextureOptionsLeaveTheNameAlone) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> options{{"-s", {"2", "2 3", "2 3 4"}},
                                                                              {"-o", {"0.5", "0.5 1", "0 0 0"}},
                                                                              {"-t", {"0", "0 0 0"}},
                                                                              {"-mm", {"0", "0 1"}},
                                                                              {"-bm", {"0.5"}},
                                                                              {"-boost", {"3"}},
                                                                              {"-texres", {"512"}},
                                                                              {"-clamp", {"on", "off", "ON"}},
                                                                              {"-cc", {"on", "Off"}},
                                                                              {"-blendu", {"on"}},
                                                                              {"-blendv", {"off"}},
                                                                              {"-imfchan", {"l", "R"}},
                                                                              {"-type", {"sphere", "cube_top"}},
                                                                              {"-colorspace", {"sRGB", "linear"}}};
  for (const std::string name : {"check.png", "a wall.png", "-o.png"}) {
    writePng(folder_ / name, Image8(1, 1));
    for (const auto& [option, words] : options) {
      std::vector<std::string> all = words;
      all.emplace_back();
      for (const std::string& word : all) {
        if (option == "-colorspace" && word.empty() && name[0] == 'a') {
          continue;  // its first word may be a color space
        }
        std::string upper = option;
        std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return std::toupper(c); });
        for (const std::string& written : {option, upper}) {
          const std::string before = written + " " + word + " ";
          const std::string more = " " + written + " " + word;
          for (const std::string& line : {before + name, before + "-bm 1 " + name, name + more}) {
            textures_.clear();
            materialOf("newmtl m\nmap_Kd " + line + "\n");
            ASSERT_EQ(textures_.size(), 1u) << line;
            EXPECT_EQ(textures_[0].source.filename(), name) << line;
            ASSERT_EQ(warnings(), "") << line;
          }
        }
      }
    }
  }
}

TEST_F(MtlFile, TextureOptionsCountInAnyCaseAndPlace) {
  writePng(folder_ / "t.png", Image8(1, 1));
  const std::string obj = squareText + "vt 1 2\nvt 3 0\nvt 0 0\nusemtl m\nf 1/1 2/2 3/3\n";
  for (const std::string line : {"-S 2 2 -Clamp ON t.png", "t.png -s 2 2 -clamp on", "t.png -clamp On -s 2 2 2 # big",
                                 "-clamp on t.png -s 2", "-blenu on -s 2 -clamp on t.png"}) {
    const Mesh mesh = load(obj, "newmtl m\nmap_Kd " + line + "\n");
    EXPECT_EQ(mesh.vertices[mesh.indices[1]].uv.x, 6.0) << line;
    EXPECT_TRUE(mesh.parts.at(0).material.clamps) << line;
  }
  EXPECT_EQ(warnings(), "warning: m.mtl:2: map_Kd: '-blenu' is no known option, it is left out\n");
  std::set<std::filesystem::path> files;
  folder_.write("m.mtl", "newmtl m\nmap_Kd -blenu on t.png\n");
  addFilesOfObj(folder_.write("m.obj", "mtllib m.mtl\n"), files);
  EXPECT_TRUE(files.contains(folder_ / "t.png"));
}

TEST_F(MtlFile, TextureOptionsWithoutANameAreADefect) {
  for (const std::string line : {"-bm 1", "-s 1 1 1", "-clamp # on"}) {
    const Mesh mesh = load(squareText + "usemtl m\nf 1 2 3\n", "newmtl m\nmap_Kd " + line + "\n");
    ASSERT_EQ(mesh.defects.size(), 1u) << line;
    EXPECT_EQ(withoutFolder(mesh.defects[0]), "m.mtl:2: map_Kd: has options but names no file, it is left out") << line;
  }
}

TEST_F(MtlFile, MaterialNamesMayBeInQuotes) {
  for (const std::string used : {"a b", "\"a b\"", "'a b' # c"}) {
    for (const std::string named : {"a b", "\"a b\""}) {
      const Mesh mesh = load(squareText + "usemtl " + used + "\nf 1 2 3\n", "newmtl " + named + "\nKd 0 1 0\n");
      EXPECT_EQ(mesh.parts.at(0).material.diffuse, glm::dvec3(0, 1, 0)) << used << ", " << named;
    }
  }
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlFile, UnreadableTexturesAreLeftOut) {
  folder_.write("text.png", "no picture");
  folder_.write("photo.webp", "RIFF....WEBPVP8 ");
  folder_.write("scan.tif", "II*.");
  using namespace std::string_literals;
  folder_.write("large.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x40\0\0\0\x40\0\x08\0\0\0\0", 29));
  for (const auto& [name, problem] :
       {std::pair("none.png", "there is no file 'none.png'"s), std::pair("/dev/zero", "there is no file '/dev/zero'"s),
        std::pair("text.png", "text.png: is not a picture that can be read (a PNG or JPEG file is needed)"s),
        std::pair("photo.webp", "photo.webp: is a WebP file"s), std::pair("scan.tif", "scan.tif: is a TIFF file"s),
        std::pair("large.png",
                  "large.png: the picture has 16384x16384 pixels (at most 2^26, such as 8192x8192, are read)"s)}) {
    const Mesh mesh =
        load(squareText + "usemtl m\nf 1 2 3\n", std::string("newmtl m\nKd 1 1 1\nmap_Kd ") + name + "\n");
    EXPECT_EQ(mesh.parts.at(0).material.diffuseTexture, -1);
    ASSERT_EQ(mesh.defects.size(), 1u);
    EXPECT_TRUE(contains(mesh.defects[0], "m.mtl:3: map_Kd: "));
    EXPECT_TRUE(contains(mesh.defects[0], problem)) << mesh.defects[0];
    EXPECT_TRUE(contains(mesh.defects[0], "the texture is left out"));
  }
}

// One model may name pictures of several formats.
TEST_F(MtlFile, EachFormatOfPicturesIsNamedOnce) {
  using namespace std::string_literals;
  std::string obj = squareText;
  std::string mtl;
  std::string expected;
  int line = 0;
  for (const auto& [name, content, format] :
       {std::tuple("a.webp", "RIFF....WEBPVP8 "s, "a WebP"), std::tuple("b.webp", "RIFF....WEBPVP8L"s, ""),
        std::tuple("a.tif", "II*."s, "a TIFF"), std::tuple("b.tif", "MM\0*"s, ""),
        std::tuple("a.dds", "DDS |"s, "a DDS"), std::tuple("a.ktx", "\xabKTX 11"s, "a KTX"),
        std::tuple("b.ktx2", "\xabKTX 20"s, ""), std::tuple("a.exr", "v/1\x01"s, "an EXR"),
        std::tuple("a.hdr", "#?RADIANCE\n"s, "an HDR"), std::tuple("b.hdr", "#?RGBE\n"s, ""),
        std::tuple("a.jp2", "\0\0\0\x0cjP  \r\n"s, "a JPEG 2000"), std::tuple("b.j2k", "\xff\x4f\xff\x51"s, ""),
        std::tuple("a.jxl", "\0\0\0\x0cJXL \r\n"s, "a JPEG XL"), std::tuple("a.avif", "\0\0\0 ftypavif"s, "an AVIF"),
        std::tuple("a.heic", "\0\0\0 ftypheic"s, "a HEIC"), std::tuple("a.svg", "<svg xmlns='"s, "an SVG"),
        std::tuple("b.svg", "<?xml version"s, "an SVG or another XML")}) {
    folder_.write(name, content);
    obj += fmt::format("usemtl {}\nf 1 2 3\n", name);
    mtl += fmt::format("newmtl {}\nmap_Kd {}\n", name, name);
    line += 2;
    if (*format != '\0') {
      expected += fmt::format(
          "warning: m.mtl:{}: map_Kd: {}: is {} file (a PNG or JPEG file is needed), the texture is "
          "left out\n",
          line, name, format);
    } else {
      expected.insert(expected.size() - 1, " (and 1 more)");
    }
  }
  load(obj, mtl);
  EXPECT_EQ(warnings(), expected);
}

TEST_F(MtlFile, ManyReasonsAreCountedTogether) {
  using namespace std::string_literals;
  constexpr int count = 200;
  std::string obj = squareText;
  std::string mtl;
  for (int i = 0; i < count; ++i) {
    const std::string name = std::to_string(i);
    std::string header = "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x40\0\0\0\x40\0\x08\0\0\0\0"s;
    header[23] = static_cast<char>(i);  // last byte of the height
    folder_.write(name + ".png", header);
    obj += fmt::format("usemtl {}\nf 1 2 3\n", name);
    mtl += fmt::format("newmtl {}\nmap_Kd {}.png\n", name, name);
  }
  const std::vector<std::string> defects = load(obj + "f 1 2 9\n", mtl).defects;
  ASSERT_EQ(defects.size(), 51u);
  EXPECT_TRUE(contains(defects[0], "has a vertex that is not there"));
  EXPECT_TRUE(contains(defects[49], "48.png: the picture has 16384x16432 pixels"));
  EXPECT_TRUE(
      defects[50].ends_with("m.mtl:100: map_Kd: has more kinds of defects, which are counted here "
                            "(and 150 more)"))
      << defects[50];
}

TEST_F(MtlFile, WarningsNamePicturesAsTheirMaterialsDo) {
  folder_.write("real.ktx2", "\xabKTX 20");
  std::filesystem::create_symlink("real.ktx2", folder_ / "link.ktx2");
  for (const std::string key : {"map_Kd", "map_Ke", "map_d"}) {
    const Mesh mesh = load(squareText + "usemtl m\nf 1 2 3\n", "newmtl m\n" + key + " link.ktx2\n");
    EXPECT_TRUE(contains(withoutFolder(mesh.defects.at(0)), "m.mtl:2: " + key + ": link.ktx2: is a KTX file"));
  }
}

TEST_F(MtlFile, KeysThatAreNotReadAreNamedOnce) {
  load(squareText + "usemtl m\nf 1 2 3\n",
       "newmtl m\nmap_Pr r.png\nmap_Bump -bm 0.5 b.png\nPc 1\nillumination 2\nNORM n.png\nrefl -type sphere c.mpc\n"
       "newmtl n\nmap_Pr s.png\nKx 1\nps 0.5\nmap_Pm m.png\nmap_ks k.png\naniso 0.5\ndisp d.png\nmap_Bump b.png\n");
  const std::string left = " is not read, the material is drawn without it";
  EXPECT_EQ(warnings(), "warning: m.mtl:2: map_Pr:" + left + " (and 1 more)\n" + "warning: m.mtl:3: map_Bump:" + left +
                            " (and 1 more)\n" + "warning: m.mtl:4: Pc:" + left + "\n" +
                            "warning: m.mtl:5: newmtl: 'illumination' is no known key, it is left out (and 1 more)\n" +
                            "warning: m.mtl:6: NORM:" + left + "\n" + "warning: m.mtl:7: refl:" + left + "\n" +
                            "warning: m.mtl:11: ps:" + left + "\n" + "warning: m.mtl:12: map_Pm:" + left + "\n" +
                            "warning: m.mtl:13: map_ks:" + left + "\n" + "warning: m.mtl:14: aniso:" + left + "\n" +
                            "warning: m.mtl:15: disp:" + left + "\n");
}

// Exporters write these for every material.
TEST_F(MtlFile, KeysThatChangeNothingAreNoDefects) {
  materialOf(
      "newmtl m\nKa 1 1 1\nNi 1.5\nTf 1 1 1\nsharpness 60\nmap_Ka none.png\nmap_aat on\nPs 0\nPc 0.0\nPcr 0.03\n"
      "aniso 0\nanisor 0\nbump\nmap_Bump -bm 1\nnorm # none\n");
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlFile, DamagedMasksCountForEachMaterial) {
  folder_.write("text.png", "no picture");
  const Mesh mesh = load(squareText + "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n",
                         "newmtl a\nmap_d text.png\nnewmtl b\nmap_d text.png\n");
  ASSERT_EQ(mesh.defects.size(), 1u);
  EXPECT_TRUE(contains(mesh.defects[0], "the texture is left out (and 1 more)")) << mesh.defects[0];
}

// 2x2 pictures: a red and a green pixel above a blue and a white one.
TEST_F(MtlFile, TexturesOfManyFormatsAreRead) {
  using namespace std::string_literals;
  const std::string tga = std::string("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\2\0\x18\x20", 18) + "\0\0\xff"s + "\0\xff\0"s +
                          "\xff\0\0"s + "\xff\xff\xff";
  const std::string bmp = "BM"s + std::string("\x46\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\2\0\0\0\2\0\0\0\1\0\x18\0", 28) +
                          std::string(24, '\0') + "\xff\0\0"s + "\xff\xff\xff"s + "\0\0"s + "\0\0\xff"s + "\0\xff\0"s +
                          "\0\0"s;
  for (const auto& [name, bytes] : {std::pair("t.tga", tga), std::pair("t.TGA", tga), std::pair("t.bmp", bmp)}) {
    folder_.write(name, bytes);
    textures_.clear();
    EXPECT_EQ(materialOf(std::string("newmtl m\nmap_Kd ") + name + "\n").diffuseTexture, 0) << warnings();
    ASSERT_EQ(textures_.at(0).texels.size(), 4u);
    EXPECT_EQ(textures_[0].texels[0], glm::vec3(1, 0, 0)) << name;
    EXPECT_EQ(textures_[0].texels[1], glm::vec3(0, 1, 0)) << name;
    EXPECT_EQ(textures_[0].texels[2], glm::vec3(0, 0, 1)) << name;
    EXPECT_EQ(textures_[0].texels[3], glm::vec3(1, 1, 1)) << name;
  }
}

// The file lies at `there`; the material names it in each of the ways of other machines.
TEST_F(MtlFile, FilesAreFoundByTheirNames) {
  for (const std::string there : {"Wall A.png", "textures/Wall A.png", "Tex/wall a.PNG", "MAPS/WALL A.PNG"}) {
    const TemporaryFolder folder;
    std::filesystem::create_directories((folder / there).parent_path());
    writePng(folder / there, Image8(1, 1));
    for (const std::string name :
         {"wall a.png", "\"Wall A.png\"", "'wall A.png'", "C:\\models\\room\\Wall A.png", "/home/me/room/wall a.png",
          "..\\..\\textures\\wall a.png", "D:Wall A.png", "wall a.png # the wall", "images/wall a.png"}) {
      folder.write("m.mtl", "newmtl m\nmap_Kd " + name + "\n");
      std::vector<Texture> textures;
      const Mesh mesh = loadObj(folder.write("m.obj", "mtllib m.mtl\n" + squareText + "usemtl m\nf 1 2 3\n"), textures);
      EXPECT_EQ(mesh.parts.at(0).material.diffuseTexture, 0) << there << " by " << name;
    }
  }
  EXPECT_EQ(warnings(), "");
}

// Names of materials and files come from systems without regard to case, and from programs that write Latin-1.
TEST_F(MtlFile, FoldersHaveAnyCase) {
  std::filesystem::create_directories(folder_ / "Images/Deep");
  writePng(folder_ / "Images/Deep/wall.png", Image8(1, 1));
  for (const char* name : {"images\\deep\\Wall.PNG", "IMAGES/DEEP/wall.png", "./images/../Images/deep/wall.png"}) {
    EXPECT_EQ(materialOf(std::string("newmtl m\nmap_Kd ") + name + "\n").diffuseTexture, 0) << name;
  }
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlFile, FoldersAboveHaveAnyCase) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "Textures");
  writePng(folder / "Textures/Wood.png", Image8(1, 1));
  folder.write("Textures/M.mtl", "newmtl m\nmap_Kd ..\\textures\\wood.png\n");
  folder.write("models/m.mtl", "newmtl m\n");
  std::vector<Texture> textures;
  const std::string obj = "mtllib ../textures/m.mtl\n" + squareText + "usemtl m\nf 1 2 3\n";
  loadObj(folder.write("models/m.obj", obj), textures);
  EXPECT_EQ(textures.size(), 1u);
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlFile, NamesAreUtf8OrLatin1) {
  for (const std::string first : {"K\xf6ln", "K\xc3\xb6ln"}) {
    for (const std::string second : {"K\xf6ln", "K\xc3\xb6ln"}) {
      const Material material =
          load(squareText + "usemtl " + first + "\nf 1 2 3\n", "newmtl " + second + "\nKd 1 0 0\n")
              .parts.at(0)
              .material;
      EXPECT_EQ(material.diffuse, glm::dvec3(1, 0, 0));
      EXPECT_EQ(material.name, "K\xc3\xb6ln");
    }
  }
  writePng(folder_ / "K\xc3\xb6ln.png", Image8(1, 1));
  EXPECT_EQ(materialOf("newmtl m\nmap_Kd k\xf6ln.PNG\n").diffuseTexture, 0);
  load(squareText + "usemtl m\nf 1 2 3\n", std::string("\xff\xfen\0e\0w\0", 8));
  EXPECT_EQ(warnings(),
            "warning: m.obj:1: mtllib: m.mtl: is UTF-16 text (save it as UTF-8), its faces get the default material\n");
}

TEST_F(MtlFile, SearchStaysInTheModelsFolders) {
  const TemporaryFolder folder;
  for (const char* elsewhere : {"other/t.png", "t.png", "model/deep/t.png", "model/textures/deep/t.png"}) {
    std::filesystem::create_directories((folder / elsewhere).parent_path());
    writePng(folder / elsewhere, Image8(1, 1));
  }
  for (const char* name : {"T.png", "c:\\t.png", "/nowhere/t.png", "../model/../x/t.png", "..", ".", "textures"}) {
    folder.write("model/m.mtl", std::string("newmtl m\nmap_Kd ") + name + "\n");
    std::vector<Texture> textures;
    loadObj(folder.write("model/m.obj", "mtllib m.mtl\n" + squareText + "usemtl m\nf 1 2 3\n"), textures);
    EXPECT_TRUE(textures.empty()) << name;
  }
}

// Textures that stand for many large ones have no texels here.
TEST_F(MtlFile, TexturesBeyondTheBoundAreDrawnSmaller) {
  Image8 halves(2048, 1024);
  std::fill(halves.rgba.begin(), halves.rgba.begin() + halves.rgba.size() / 2, uint8_t{0});
  writePng(folder_ / "halves.png", halves);
  writePng(folder_ / "line.png", Image8(1 << 22, 1));
  writePng(folder_ / "column.png", Image8(1, 1 << 22));
  const auto sizes = [&](const char* name, std::vector<Texture> others) {
    textures_ = std::move(others);
    const size_t count = textures_.size();
    folder_.write("m.mtl", std::string("newmtl m\nmap_Kd ") + name + ".png\n");
    const std::string obj = "mtllib m.mtl\n" + squareText + "usemtl m\nf 1 2 3\n";
    const std::vector<std::string> defects = loadModel(folder_.write("m.obj", obj), textures_).mesh.defects;
    EXPECT_EQ(textures_.at(count).texels.size(), textures_[count].width * textures_[count].height);
    EXPECT_EQ(textures_[count].shrinkage.empty() ? 0u : 1u, defects.size()) << "--strict refuses them";
    return glm::ivec2(textures_[count].width, textures_[count].height);
  };
  const Texture large{.width = 8192, .height = 8192};
  EXPECT_EQ(sizes("halves", std::vector(3, large)), glm::ivec2(2048, 1024));
  EXPECT_EQ(warnings(), "");
  EXPECT_EQ(sizes("halves", std::vector(4, large)), glm::ivec2(1448, 724));
  EXPECT_EQ(textures_.back().texels.front(), glm::vec3(0.0f));
  EXPECT_NEAR(textures_.back().texels.back().g, 1.0f, 1e-6f);
  EXPECT_TRUE(contains(warnings(),
                       "halves.png: is drawn with 1448x724 texels: the textures before it have 2^28 texels or more\n"));
  EXPECT_EQ(sizes("line", std::vector(4, large)), glm::ivec2(1 << 20, 1));
  EXPECT_EQ(sizes("column", std::vector(4, large)), glm::ivec2(1, 1 << 20));
  EXPECT_EQ(sizes("halves", std::vector(8, large)), glm::ivec2(91, 45));
}

TEST_F(MtlFile, ManyTexturesAreReadInShortTime) {
  constexpr int count = 2000;
  std::string obj = squareText;
  std::string mtl;
  writePng(folder_ / "pixel.png", Image8(1, 1));
  const std::string png = readText(folder_ / "pixel.png");
  for (int i = 0; i < count; ++i) {
    const std::string name = std::to_string(i);
    folder_.write(name + ".png", png);
    obj.append("usemtl ").append(name).append("\nf 1 2 3\n");
    mtl.append("newmtl ").append(name).append("\nmap_Kd ").append(name).append(".png\n");
  }
  const std::clock_t start = std::clock();
  EXPECT_EQ(load(obj, mtl).parts.back().material.diffuseTexture, count - 1);
  EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC);
}

TEST_F(MtlFile, FilesAreReadOnce) {
  folder_.write("m.mtl", repeated("newmtl a\n", 10'000));
  const std::clock_t start = std::clock();
  load(repeated("mtllib m.mtl\nmtllib ./m.mtl\n", 1000) + squareText + "usemtl a\nf 1 2 3\n");
  EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC) << "read 2000 times it takes minutes";
}

TEST_F(MtlFile, EveryNamedFileIsRead) {
  folder_.write("my file.mtl", "newmtl a\nNs 7\nnewmtl b\nNs 8\n");
  const Mesh mesh = load("mtllib none.mtl my\\ file.mtl\tm.mtl\n" + squareText +
                             "usemtl a\nf 1 2 3\nusemtl b\nf 2 3 4\nusemtl c\nf 3 4 1\n",
                         "newmtl b\nNs 1\nnewmtl c\nNs 9\n");
  ASSERT_EQ(mesh.parts.size(), 3u);
  EXPECT_EQ(mesh.parts[0].material.shininess, 7.0);
  EXPECT_EQ(mesh.parts[1].material.shininess, 1.0) << "the first that defines it counts";
  EXPECT_EQ(mesh.parts[2].material.shininess, 9.0);
}

TEST_F(MtlFile, MaterialsMayBeNamedBeforeTheirFile) {
  folder_.write("m.mtl", "newmtl a\nKd 0 1 0\n");
  for (const std::string& text :
       {"usemtl a\n" + squareText + "f 1 2 3\nmtllib m.mtl\n", "usemtl a\nf 1 2 3\nmtllib m.mtl\n" + squareText,
        squareText + "usemtl a\nf 1 2 3\nmtllib m.mtl"}) {
    EXPECT_EQ(load(text).parts.at(0).material.diffuse, glm::dvec3(0, 1, 0)) << text;
  }
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlFile, KeysHaveAnyCase) {
  writePng(folder_ / "t.png", Image8(1, 1));
  const Material material = load("MTLLIB m.mtl\n" + squareText + "UseMtl m\nF 1 2 3\n",
                                 "NEWMTL m\nkd 0.5 0 0\nKS 0 0.25 0\nke 0 0 3\nnS 9\nMAP_KD t.png\n")
                                .parts.at(0)
                                .material;
  EXPECT_EQ(material.diffuse, glm::dvec3(0.5, 0, 0));
  EXPECT_EQ(material.specular, glm::dvec3(0, 0.25, 0));
  EXPECT_EQ(material.emission, glm::dvec3(0, 0, 3));
  EXPECT_EQ(material.shininess, 9.0);
  EXPECT_EQ(material.diffuseTexture, 0);
}

TEST_F(MtlFile, CommentsAreNoPartOfNames) {
  writePng(folder_ / "t#1.png", Image8(1, 1));
  const Mesh mesh =
      load(squareText + "usemtl my red # a comment\nf 1 2 3\n", "newmtl my red # another\nmap_Kd t#1.png # a third\n");
  EXPECT_EQ(mesh.parts.at(0).material.name, "my red");
  EXPECT_EQ(mesh.parts.at(0).material.diffuseTexture, 0);
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlFile, CommentsAloneNameNoFile) {
  const Mesh mesh = load("mtllib # none\n" + squareText + "usemtl m\nf 1 2 3\n", "newmtl m\nmap_Kd # no texture\n");
  EXPECT_EQ(mesh.parts.at(0).material.diffuse, glm::dvec3(0.8));
  EXPECT_EQ(warnings(), "");
}

// 3ds Max names its materials so.
TEST_F(MtlFile, NamesMayHoldNumberSigns) {
  const std::string names = "newmtl Material #25\nKd 1 0 0\nnewmtl Material #26\nKd 0 1 0\nnewmtl #FF0000\nKd 0 0 1\n";
  const auto colorOf = [&](const std::string& name) {
    return load(squareText + "usemtl " + name + "\nf 1 2 3\n", names).parts.at(0).material.diffuse;
  };
  EXPECT_EQ(colorOf("Material #25"), glm::dvec3(1, 0, 0));
  EXPECT_EQ(colorOf("Material #26"), glm::dvec3(0, 1, 0));
  EXPECT_EQ(colorOf("#FF0000"), glm::dvec3(0, 0, 1));
  EXPECT_EQ(colorOf("#FF0000 # red"), glm::dvec3(0.6)) << "a comment begins at the first one";
  EXPECT_TRUE(contains(warnings(), "there is no material '#FF0000 # red'"));
  EXPECT_EQ(colorOf("Material #27"), glm::dvec3(0.6)) << "which of the two is meant is not known";
  EXPECT_TRUE(contains(warnings(), "there is no material 'Material #27'"));
  for (const std::string name : {"wall #1.png", "#1.png", "deep #2/a b.png"}) {
    std::filesystem::create_directories((folder_ / name).parent_path());
    writePng(folder_ / name, Image8(1, 1));
    for (const std::string options : {"", "-s 1 1 1 ", "-clamp on "}) {
      EXPECT_GE(materialOf("newmtl m\nmap_Kd " + options + name + "\n").diffuseTexture, 0) << name;
    }
    folder_.write("n #3.mtl", "newmtl m\nmap_Kd " + name + "\n");
    const std::filesystem::path model =
        folder_.write("n.obj", "mtllib n #3.mtl\n" + squareText + "usemtl m\nf 1 2 3\n");
    EXPECT_GE(loadObj(model, textures_).parts.at(0).material.diffuseTexture, 0) << name;
    std::set<std::filesystem::path> files;
    addFilesOfObj(model, files);
    EXPECT_TRUE(files.contains(folder_ / name)) << name;
  }
}

TEST_F(MtlFile, MasksHaveTheOptionsOfTheColors) {
  writePng(folder_ / "t.png", Image8(2, 2));
  writePng(folder_ / "d.png", testing_support::madePicture(2, 2, [](int x, int) { return glm::ivec4(99 * x); }));
  const std::string obj = squareText + "vt 1 2\nvt 3 0\nvt 0 0\nusemtl m\nf 1/1 2/2 3/3\n";
  const auto scaleOf = [&](const std::string& keys) {
    const Mesh mesh = load(obj, "newmtl m\n" + keys);
    return mesh.vertices[mesh.indices[1]].uv.x / 3.0;
  };
  EXPECT_EQ(scaleOf("map_Kd -s 2 2 t.png\nmap_d -s 2 2 d.png\n"), 2.0);
  EXPECT_EQ(scaleOf("map_d -s 4 4 d.png\n"), 4.0) << "it is alone";
  EXPECT_EQ(warnings(), "");
  EXPECT_EQ(scaleOf("map_d -s 4 4 d.png\nmap_Kd -s 2 2 t.png\n"), 2.0);
  EXPECT_EQ(warnings(),
            "warning: m.mtl:2: map_d: 'd.png' has other options than map_Kd, those of map_Kd count for both\n");
  EXPECT_FALSE(load(obj, "newmtl m\nmap_Kd t.png\nmap_d -clamp on d.png\n").parts.at(0).material.clamps);
  EXPECT_TRUE(load(obj, "newmtl m\nmap_d -clamp on d.png\n").parts.at(0).material.clamps);
}

TEST_F(MtlFile, MaterialsDoNotInherit) {
  const Mesh mesh =
      load(squareText + "usemtl b\nf 1 2 3\n", "newmtl a\nKd 1 0 0\nKs 1 1 1\nKe 1 1 1\nNs 50\nd 0.5\nnewmtl b\n");
  const Material& material = mesh.parts.at(0).material;
  EXPECT_EQ(material.diffuse, glm::dvec3(0.8));
  EXPECT_EQ(material.specular, glm::dvec3(0.0));
  EXPECT_EQ(material.emission, glm::dvec3(0.0));
  EXPECT_EQ(material.shininess, 1.0);
  EXPECT_EQ(warnings(), "");
}

TEST_F(MtlFile, MostAreTenThousand) {
  load(squareText + "f 1 2 3\n", repeated("newmtl a\n", 10'001));
  EXPECT_EQ(warnings(), "warning: m.mtl:10001: newmtl: is one too many, 10000 materials of a file are read\n");
}

TEST_F(MtlFile, UsablePartsOfKeysAreUsed) {
  const glm::dvec3 usual(0.8);
  for (const auto& [key, diffuse] :
       std::initializer_list<std::pair<const char*, glm::dvec3>>{{"Kd 1 0 0 1", {1, 0, 0}},
                                                                 {"Kd nan 0 0", {0.8, 0, 0}},
                                                                 {"Kd 0.5 0.5", {0.5, 0.5, 0.8}},
                                                                 {"Kd 0 -1 0", {0, 0.8, 0}},
                                                                 {"Kd 0 0 1e39", {0, 0, 0.8}},
                                                                 {"Kd x 0 0", {0.8, 0, 0}},
                                                                 {"Kd", usual},
                                                                 {"Kd inf", usual},
                                                                 {"Kd 0 1.#IND 0", {0, 0.8, 0}}}) {
    EXPECT_EQ(materialOf(std::string("newmtl m\n") + key + "\n").diffuse, diffuse) << key;
  }
  for (const auto& [key, shininess] : std::initializer_list<std::pair<const char*, double>>{{"Ns 7 8 9", 7.0},
                                                                                            {"Ns", 1.0},
                                                                                            {"Ns x", 1.0},
                                                                                            {"Ns nan", 1.0},
                                                                                            {"Ns -5", 1.0},
                                                                                            {"Ns 1e30", 1e6},
                                                                                            {"Ns inf", 1.0}}) {
    EXPECT_EQ(materialOf(std::string("newmtl m\n") + key + "\n").shininess, shininess) << key;
  }
  EXPECT_EQ(materialOf("newmtl m\nKs 0 -1 0\nKe 1 nan 2\n").specular, glm::dvec3(0.0));
  EXPECT_TRUE(contains(warnings(),
                       "warning: m.mtl:3: Ke: is not three numbers in range, the usual value stands for the others\n"));
}

TEST_F(MtlFile, DamagedFilesCostTheirMaterials) {
  for (const std::string& mtl :
       {std::string("newmtl a\n\0\0", 11), std::string(5000, '\\'), std::string("\xff\xfen\0e\0w\0", 8)}) {
    EXPECT_EQ(load(squareText + "f 1 2 3\nusemtl b\nf 1 2 3\n", mtl).indices.size(), 6u);
  }
}

TEST_F(MtlFile, LibrariesHaveBlanksAndBackslashes) {
  for (const std::string name :
       {"a b.mtl", "two  blanks and more .mtl", "with'quote \xff.mtl", "folder/in it/c d.mtl"}) {
    folder_.write(name, "newmtl a\nKd 0.125 0 0\n");
    std::string escaped;
    for (const char c : name) {
      escaped += (c == ' ' ? "\\" : "") + std::string(1, c);
    }
    std::string windows = name;
    std::ranges::replace(windows, '/', '\\');
    for (const std::string& written : {name, escaped, windows, "none.mtl " + escaped}) {
      const Mesh mesh = load("mtllib " + written + "\n" + squareText + "usemtl a\nf 1 2 3\n");
      EXPECT_EQ(mesh.parts.at(0).material.diffuse.x, 0.125) << written;
    }
  }
}

TEST_F(MtlFile, SeveralLibrariesMayHaveBlanks) {
  folder_.write("box mtllib red.mtl", "newmtl a\nKd 0.125 0 0\n");
  folder_.write("box mtllib green.MTL", "newmtl b\nKd 0.25 0 0\n");
  folder_.write("in/c.mtl", "newmtl c\nKd 0.5 0 0\n");
  const Mesh mesh = load("mtllib box mtllib red.mtl  box mtllib green.mtl none.mtl in/c.mtl\n" + squareText +
                         "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\nusemtl c\nf 1 2 3\n");
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(mesh.parts.at(i).material.diffuse.x, 0.125 * (1 << i));
  }
  ASSERT_EQ(mesh.defects.size(), 1u);
  EXPECT_TRUE(contains(mesh.defects[0], "there is no file 'none.mtl'")) << mesh.defects[0];
}

TEST_F(MtlFile, LibrariesOfLongLinesAreFoundInTime) {
  std::string names;
  for (int i = 0; i < 32'000; ++i) {
    names += " w" + std::to_string(i);
  }
  const std::clock_t start = std::clock();
  load("mtllib" + names + " m.mtl\n" + squareText + "f 1 2 3\n", "newmtl a\n");
  std::set<std::filesystem::path> files;
  addFilesOfObj(folder_ / "m.obj", files);
  EXPECT_TRUE(files.contains(folder_ / "m.mtl"));
  EXPECT_LT(std::clock() - start, testing_support::instrumented * 4 * CLOCKS_PER_SEC);
}

TEST_F(MtlFile, NumbersOfAnySizeAreFinite) {
  for (const std::string key : {"Kd", "Ks", "Ke", "Ns", "d", "Tr"}) {
    for (const std::string& value :
         std::initializer_list<std::string>{"1e39", "1e300", "-1", "nan", "inf", "-inf", "1e99999999999", "1e-400",
                                            "0e9999999999", "1" + std::string(400, '0') + "e-400"}) {
      const Material material = materialOf("newmtl m\n" + key + " 0.5 0.5 " + value + "\n" + key + " " + value + "\n");
      for (const glm::dvec3& color : {material.diffuse, material.specular, material.emission}) {
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(color, glm::dvec3(0.0))) && color.x + color.y + color.z < 1e39)
            << key << value;
      }
      EXPECT_TRUE(material.shininess >= 1.0 && material.shininess <= 1e6) << key << value;
    }
  }
  const Mesh mesh = load("usemtl a\n" + squareText + "f 1 2 3\n", "newmtl a\nNs 1e300\nKd 1e30 1e-300 0\n");
  EXPECT_EQ(mesh.parts.at(0).material.shininess, 1e6);
  EXPECT_NEAR(mesh.parts.at(0).material.diffuse.x, 1e30, 1e15);
}

}  // namespace
}  // namespace speculum
