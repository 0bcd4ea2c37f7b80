#include "scene/gltf_file.hpp"

#include <bit>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "image/picture_files.hpp"
#include "made_gltf.hpp"
#include "made_pictures.hpp"
#include "scene/fingerprint.hpp"
#include "scene/materials.hpp"
#include "scene/model_files.hpp"
#include "scene/obj_support.hpp"

namespace speculum {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// The corners of a mesh's triangles in model space.
std::vector<glm::dvec3> cornersOf(const Mesh& mesh) {
  std::vector<glm::dvec3> points;
  for (const uint32_t index : mesh.indices) {
    points.push_back(mesh.center + mesh.unit * mesh.vertices[index].position);
  }
  return points;
}

void expectNear(const std::vector<glm::dvec3>& actual, const std::vector<glm::dvec3>& expected, double most = 1e-12) {
  ASSERT_EQ(actual.size(), expected.size());
  for (size_t i = 0; i < actual.size(); ++i) {
    EXPECT_LE(glm::distance(actual[i], expected[i]), most) << "corner " << i;
  }
}

class GltfLoader : public ModelTest {
 protected:
  Model load(const std::string& content, const char* name = "m.gltf") {
    return loadModel(folder_.write(name, content), textures_);
  }
  Mesh meshOf(const MadeGltf& made) { return load(made.binary(), "m.glb").mesh; }
  std::string faultOf(const std::string& content, const char* name = "m.gltf") {
    return withoutFolder(messageOf<InputError>([&] { load(content, name); }));
  }
};

const std::vector<glm::dvec3> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const std::vector<float> triangleNumbers{0, 0, 0, 1, 0, 0, 0, 1, 0};
const std::vector<float> squareNumbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};

// Returns a triangle with material 0, which is still to be added, and the picture t.png as texture 0.
MadeGltf texturedTriangle() {
  MadeGltf made;
  made.add("images", {{"uri", "t.png"}});
  made.add("textures", {{"source", 0}});
  made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")},
                {"TEXCOORD_0", made.addNumbers<float>({0, 0, 1, 0, 0, 1}, "VEC2")}},
               {{"material", 0}});
  return made;
}

TEST_F(GltfLoader, TriangleWithoutNormalsIsFlat) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  for (const auto& [name, content] :
       {std::pair("m.glb", made.binary()), std::pair("m.gltf", made.text()), std::pair("binary.gltf", made.binary())}) {
    const Mesh mesh = load(content, name).mesh;
    expectNear(cornersOf(mesh), triangle);
    EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(0, 0, 1));
    EXPECT_EQ(mesh.source, folder_ / name);
  }
  EXPECT_EQ(warnings(), "");
}

TEST_F(GltfLoader, OnlyNodesOfTheDefaultSceneAreDrawn) {
  MadeGltf made;
  const int mesh = made.addTriangle();
  made.add("nodes", {{"mesh", mesh}, {"translation", {5, 0, 0}}});
  made.add("nodes", {{"mesh", mesh}});
  made.add("scenes", {{"nodes", {0}}});
  EXPECT_EQ(cornersOf(meshOf(made)).at(0), glm::dvec3(5, 0, 0)) << "the first scene";
  made.add("scenes", {{"nodes", {1}}});
  made.root["scene"] = 1;
  expectNear(cornersOf(meshOf(made)), triangle);
}

// Random trees of nodes, by matrices or by translation, rotation and scale of either sign.
TEST_F(GltfLoader, NodesAreTransformedByAllAbove) {
  std::mt19937 random(3);
  const auto number = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int i = 0; i < 50; ++i) {
    MadeGltf made;
    const int mesh = made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")},
                                   {"NORMAL", made.addNumbers<float>({0, 0.6f, 0.8f, 0, 0, 1, 1, 0, 0}, "VEC3")}});
    glm::dmat4 sceneFromNode(1.0);
    const int depth = 1 + i % 4;
    for (int node = 0; node < depth; ++node) {
      const glm::dvec3 move(number(-2, 2), number(-2, 2), number(-2, 2));
      const glm::dvec3 scale(number(0.3, 2) * (i % 2 ? -1 : 1), number(0.3, 2), number(0.3, 2) * (i % 3 ? -1 : 1));
      const double angle = number(-3, 3);
      const glm::dvec3 axis = glm::normalize(glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1)));
      const glm::dmat4 local = glm::scale(glm::rotate(glm::translate(glm::dmat4(1.0), move), angle, axis), scale);
      sceneFromNode = sceneFromNode * local;
      json entry;
      if (node % 2 == 0) {
        const glm::dvec3 half = 3.0 * std::sin(0.5 * angle) * axis;  // not of unit length
        entry = {{"translation", {move.x, move.y, move.z}},
                 {"rotation", {half.x, half.y, half.z, 3.0 * std::cos(0.5 * angle)}},
                 {"scale", {scale.x, scale.y, scale.z}}};
      } else {
        entry = {{"matrix", std::vector<double>(&local[0][0], &local[0][0] + 16)}};
      }
      if (node + 1 < depth) {
        entry["children"] = {node + 1};
      } else {
        entry["mesh"] = mesh;
      }
      made.add("nodes", entry);
    }
    made.add("scenes", {{"nodes", {0}}});
    const Mesh actual = meshOf(made);
    std::vector<glm::dvec3> expected;
    for (const glm::dvec3& point : triangle) {
      expected.emplace_back(sceneFromNode * glm::dvec4(point, 1.0));
    }
    if (glm::determinant(sceneFromNode) < 0.0) {
      std::swap(expected[1], expected[2]);
    }
    expectNear(cornersOf(actual), expected, 1e-9);
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(sceneFromNode)));
    EXPECT_LE(glm::distance(actual.vertices[actual.indices[0]].normal,
                            glm::normalize(turn * glm::normalize(glm::dvec3(0, 0.6f, 0.8f)))),
              1e-6);
    const glm::dvec3 front = glm::cross(expected[1] - expected[0], expected[2] - expected[0]);
    EXPECT_GT(glm::dot(front, turn * glm::dvec3(0, 0, 1)), 0.0) << "the front stays in front";
  }
}

TEST_F(GltfLoader, IndicesOfEveryType) {
  MadeGltf made;
  const int positions = made.addNumbers(squareNumbers, "VEC3");
  const std::vector<int> accessors{made.addNumbers<uint8_t>({0, 1, 2, 2, 1, 3}, "SCALAR"),
                                   made.addNumbers<uint16_t>({0, 1, 2, 2, 1, 3}, "SCALAR"),
                                   made.addNumbers<uint32_t>({0, 1, 2, 2, 1, 3}, "SCALAR")};
  made.add("nodes", {{"mesh", 0}});
  for (const int indices : accessors) {
    made.root["meshes"] = json::array();
    made.addMesh({{"POSITION", positions}}, {{"indices", indices}});
    expectNear(cornersOf(meshOf(made)), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}});
  }
}

template <typename T>
class GltfNumbers : public GltfLoader {};
using Integers = testing::Types<int8_t, uint8_t, int16_t, uint16_t>;
TYPED_TEST_SUITE(GltfNumbers, Integers);

// KHR_mesh_quantization: integers as they are, or as shares of the largest.
TYPED_TEST(GltfNumbers, AreNormalizedIfSaid) {
  constexpr TypeParam most = std::numeric_limits<TypeParam>::max();
  constexpr TypeParam least = std::numeric_limits<TypeParam>::min();
  for (const bool normalized : {false, true}) {
    MadeGltf made;
    made.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    const auto positions = made.addNumbers<TypeParam>({least, 0, 0, most, 0, 0, 0, most, 0}, "VEC3", normalized);
    made.add("nodes", {{"mesh", made.addMesh({{"POSITION", positions}})}});
    const double one = normalized ? 1.0 : most;
    const double low = normalized ? (least < 0 ? -1.0 : 0.0) : least;
    expectNear(cornersOf(this->meshOf(made)), {{low, 0, 0}, {one, 0, 0}, {0, one, 0}}, 1e-9 * one);
  }
}

TEST_F(GltfLoader, BuffersMayBeInterleaved) {
  MadeGltf made;
  std::string content;
  for (size_t i = 0; i < 3; ++i) {
    content += MadeGltf::bytesOf<float>({0.0f, 0.0f, -1.0f});
    content +=
        MadeGltf::bytesOf<float>({triangleNumbers[3 * i], triangleNumbers[3 * i + 1], triangleNumbers[3 * i + 2]});
  }
  const int view = made.addView(content, 24);
  const json accessor{{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  const int normals = made.add("accessors", accessor);
  const int positions = made.add("accessors", accessor);
  made.root["accessors"][positions]["byteOffset"] = 12;
  made.add("nodes", {{"mesh", made.addMesh({{"POSITION", positions}, {"NORMAL", normals}})}});
  const Mesh mesh = meshOf(made);
  expectNear(cornersOf(mesh), triangle);
  EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(0, 0, -1));
}

TEST_F(GltfLoader, SparseAccessorsReplaceSomeElements) {
  for (const bool hasView : {true, false}) {
    MadeGltf made;
    const int positions = made.addNumbers(hasView ? triangleNumbers : std::vector<float>(9), "VEC3");
    if (!hasView) {
      made.root["accessors"][positions].erase("bufferView");
    }
    const int indices = made.addView(MadeGltf::bytesOf<uint16_t>({1, 2}));
    const int values = made.addView(MadeGltf::bytesOf<float>({4, 0, 0, 0, 5, 6}));
    made.root["accessors"][positions]["sparse"] = {{"count", 2},
                                                   {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                                   {"values", {{"bufferView", values}}}};
    made.add("nodes", {{"mesh", made.addMesh({{"POSITION", positions}})}});
    expectNear(cornersOf(meshOf(made)), {{0, 0, 0}, {4, 0, 0}, {0, 5, 6}});
  }
}

TEST_F(GltfLoader, StripsAndFansBecomeTriangles) {
  MadeGltf made;
  const int positions = made.addNumbers<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
  made.add("nodes", {{"mesh", 0}});
  made.addMesh({{"POSITION", positions}}, {{"mode", 5}});
  const std::vector<glm::dvec3> p{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
  const Mesh strip = meshOf(made);
  expectNear(cornersOf(strip), {p[0], p[1], p[2], p[1], p[3], p[2], p[2], p[3], p[4]});
  for (const Vertex& vertex : strip.vertices) {
    EXPECT_EQ(vertex.normal, glm::dvec3(0, 0, 1)) << "every triangle faces the same side";
  }
  const int fan = made.addNumbers<uint16_t>({0, 1, 3, 2}, "SCALAR");
  made.root["meshes"][0]["primitives"][0].update({{"mode", 6}, {"indices", fan}});
  expectNear(cornersOf(meshOf(made)), {p[1], p[3], p[0], p[3], p[2], p[0]});
  const int stitched = made.addNumbers<uint16_t>({0, 1, 2, 2, 2, 2, 3, 4}, "SCALAR");
  made.root["meshes"][0]["primitives"][0].update({{"mode", 5}, {"indices", stitched}});
  EXPECT_EQ(meshOf(made).indices.size(), 6u);
  EXPECT_EQ(warnings(), "") << "strips repeat vertices where they turn";
}

TEST_F(GltfLoader, LinesAndPointsAreLeftOut) {
  MadeGltf made;
  const int positions = made.addNumbers(triangleNumbers, "VEC3");
  made.add("nodes", {{"mesh", 0}});
  made.addMesh({{"POSITION", positions}}, {{"mode", 1}});
  EXPECT_EQ(faultOf(made.text()),
            "m.gltf:1: meshes: mesh 0 has lines or points, they are left out (no triangle is left to draw)");
  made.root["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", positions}}}});
  made.root["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", positions}}}, {"mode", 0}});
  EXPECT_EQ(meshOf(made).defects,
            (std::vector{(folder_ / "m.glb").string() +
                         ":1: meshes: mesh 0 has lines or points, they are left out (and 1 more)"}));
}

TEST_F(GltfLoader, MotionIsLeftOutWithOneWarning) {
  MadeGltf made;
  const int mesh = made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")}});
  made.add("nodes", {{"mesh", mesh}, {"skin", 0}});
  made.add("skins", 7);
  made.add("animations", {{"channels", 7}});
  EXPECT_EQ(meshOf(made).indices.size(), 3u);
  made.root["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}, {{"POSITION", 0}}};
  EXPECT_EQ(meshOf(made).indices.size(), 3u);
  const std::string motion = "warning: m.glb:1: animations: animations are left out, the model stands still\n";
  EXPECT_EQ(warnings(), motion + "warning: m.glb:1: meshes: mesh 0 has morph targets, they are left out\n" + motion);
}

TEST_F(GltfLoader, SkinsMoveVerticesByTheirJoints) {
  MadeGltf made;
  const int mesh =
      made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")},
                    {"NORMAL", made.addNumbers<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")},
                    {"JOINTS_0", made.addNumbers<uint8_t>({0, 0, 0, 0, 1, 0, 0, 9, 0, 1, 0, 0}, "VEC4")},
                    {"WEIGHTS_0", made.addNumbers<float>({1, 0, 0, 0, 2, 0, 0, 0, 0.5f, 0.5f, 0, 0}, "VEC4")}});
  std::vector<float> inverse(48);  // one more matrix than joints
  for (size_t i = 0; i < inverse.size(); ++i) {
    inverse[i] = i % 16 % 5 == 0 ? 1.0f : 0.0f;
  }
  inverse[16 + 12] = -1.0f;  // the second joint is at x = 1 where it is bound
  const int matrices = made.addNumbers(inverse, "MAT4");
  made.add("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", matrices}});
  made.add("nodes", {{"mesh", mesh}, {"skin", 0}, {"translation", {50, 0, 0}}});
  made.add("nodes", {{"translation", {0, 0, 3}}, {"children", {2}}});
  made.add("nodes", {{"translation", {1, 0, 0}}, {"scale", {1, 2, 1}}});
  made.add("scenes", {{"nodes", {0, 1}}});
  const Mesh drawn = meshOf(made);
  expectNear(cornersOf(drawn), {{0, 0, 3}, {1, 0, 3}, {0, 1.5, 3}});
  EXPECT_EQ(warnings(), "");
}

TEST_F(GltfLoader, BuffersAreFoundLikeTexturesAndNeverOutside) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  folder_.write("model/my data.bin", made.bytes + "and more");
  folder_.write("model/textures/Below.BIN", made.bytes);
  folder_.write("secret.bin", made.bytes);
  for (const std::string uri :
       {"my%20data.bin", "my data.bin", "./x/../my%20data.bin", "C:\\\\work\\\\my data.bin", "../elsewhere/below.bin",
        "/home/me/textures/below.bin", "my%20data.bin?v=1", "my data.bin#a?b"}) {
    const Mesh mesh = load(made.text(uri), "model/m.gltf").mesh;
    EXPECT_EQ(mesh.indices.size(), 3u) << uri;
    ASSERT_EQ(mesh.namedFiles.size(), 1u) << uri;
    EXPECT_EQ(mesh.materialFiles.size(), 1u) << uri;
  }
  EXPECT_EQ(warnings(), "");
  for (const std::string& uri :
       {std::string("../secret.bin"), (folder_ / "secret.bin").string(), std::string("%2e%2e/secret.bin"),
        std::string("x/../../secret.bin"), std::string("..\\\\secret.bin"), std::string(" ../secret.bin"),
        std::string("../secret.bin?v=1"), std::string("x?/../../secret.bin"), std::string("my data.bin%3Fv=1"),
        "\"" + (folder_ / "secret.bin").string() + "\""}) {
    EXPECT_TRUE(contains(faultOf(made.text(uri), "model/m.gltf"), "buffers: there is no file '")) << uri;
  }
}

// Numbers whose bytes need the characters 62 and 63 of the alphabet.
TEST_F(GltfLoader, Base64OfUrlsIsRead) {
  const float number = std::bit_cast<float>(0x3fffbfffu);
  const std::vector<float> numbers{0, 0, 0, number, number, 0, 0, number, 0};
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addMesh({{"POSITION", made.addNumbers(numbers, "VEC3")}})}});
  std::string base64 = MadeGltf::base64(made.bytes);
  ASSERT_NE(base64.find_first_of("+"), std::string::npos);
  ASSERT_NE(base64.find_first_of("/"), std::string::npos);
  std::ranges::replace(base64, '+', '-');
  std::ranges::replace(base64, '/', '_');
  expectNear(cornersOf(load(made.text("data:;base64," + base64)).mesh),
             {{0, 0, 0}, {number, number, 0}, {0, number, 0}});
  EXPECT_EQ(warnings(), "");
}

// Some writers know no integers.
TEST_F(GltfLoader, WholeFloatsAreIntegers) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  made.add("scenes", {{"nodes", {0}}});
  made.root["scene"] = 0;
  json root = json::parse(made.text("whole.bin"));
  folder_.write("whole.bin", made.bytes);
  const std::function<void(json&)> toFloats = [&](json& value) {
    if (value.is_structured()) {
      std::ranges::for_each(value, toFloats);
    } else if (value.is_number_integer()) {
      value = value.get<double>();
    }
  };
  toFloats(root);
  ASSERT_TRUE(contains(root.dump(), "\"mesh\":0.0"));
  expectNear(cornersOf(load(root.dump()).mesh), triangle);
  EXPECT_EQ(warnings(), "");
  root["nodes"][0]["mesh"] = 0.5;
  EXPECT_TRUE(contains(faultOf(root.dump()), "nodes: mesh of 0 is wrong"));
}

TEST_F(GltfLoader, LargeNumbersOfExtensionsAreRead) {
  for (const double strength : {2147483647.0, 2147483648.0, 5e9}) {
    MadeGltf made;
    made.add("nodes",
             {{"mesh", made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")}}, {{"material", 0}})}});
    made.add("materials", {{"emissiveFactor", {1, 1, 1}},
                           {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}});
    EXPECT_EQ(meshOf(made).parts.at(0).material.emission, glm::dvec3(strength));
  }
}

TEST_F(GltfLoader, SeveralBuffersOfEveryKind) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  json root = json::parse(made.text("whole.bin"));
  folder_.write("whole.bin", made.bytes);
  const std::string base64 = MadeGltf::base64(made.bytes);
  for (const std::string& uri :
       {std::string("whole.bin"), "data:application/gltf-buffer;base64," + base64, "data:;base64," + base64,
        "data:;BASE64," + base64, "DATA:;base64," + base64, "data:anything/at-all;charset=x;base64," + base64}) {
    root["buffers"] = {{{"byteLength", 4}, {"uri", "data:,none"}}, {{"byteLength", made.bytes.size()}, {"uri", uri}}};
    root["bufferViews"][0]["buffer"] = 1;
    EXPECT_EQ(load(root.dump()).mesh.indices.size(), 3u) << uri;
  }
}

TEST_F(GltfLoader, MaterialsGroupTriangles) {
  MadeGltf made;
  const int positions = made.addNumbers(triangleNumbers, "VEC3");
  for (const json& material : std::vector<json>{1, 0, nullptr, 7}) {
    made.addMesh({{"POSITION", positions}}, material.is_null() ? json::object() : json{{"material", material}});
    made.add("nodes", {{"mesh", made.root["meshes"].size() - 1}});
  }
  made.add("materials", {{"name", "red"}, {"emissiveFactor", {0.5, 0, 0}}});
  made.add("materials", {{"name", "bright"},
                         {"emissiveFactor", {1, 1, 1}},
                         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 5}}}}}});
  const Mesh mesh = meshOf(made);
  ASSERT_EQ(mesh.parts.size(), 3u);
  EXPECT_EQ(mesh.parts[0].material.name, "bright");
  EXPECT_EQ(mesh.parts[0].material.emission, glm::dvec3(5.0));
  EXPECT_EQ(mesh.parts[1].material.emission, glm::dvec3(0.5, 0, 0));
  EXPECT_EQ(mesh.parts[2].indexCount, 6u) << "without a material, and with one that is not there";
}

TEST_F(GltfLoader, VertexColorsOfEveryType) {
  MadeGltf made;
  const int positions = made.addNumbers(triangleNumbers, "VEC3");
  const std::vector<int> colors{
      made.addNumbers<float>({1, 0, 0.2f, 0, 1, 0.2f, 0, 7, 0.2f}, "VEC3"),
      made.addNumbers<uint8_t>({255, 0, 51, 9, 0, 255, 51, 9, 0, 255, 51, 9}, "VEC4", true),
      made.addNumbers<uint16_t>({65535, 0, 13107, 0, 65535, 13107, 0, 65535, 13107}, "VEC3", true)};
  made.add("nodes", {{"mesh", 0}});
  for (const int color : colors) {
    made.root["meshes"] = json::array();
    made.addMesh({{"POSITION", positions}, {"COLOR_0", color}});
    const Mesh mesh = meshOf(made);
    ASSERT_EQ(mesh.colors.size(), 3u);
    EXPECT_LE(glm::distance(glm::vec3(mesh.colors[mesh.indices[0]]), glm::vec3(1, 0, 0.2f)), 1e-6f);
    EXPECT_LE(glm::distance(glm::vec3(mesh.colors[mesh.indices[2]]), glm::vec3(0, 1, 0.2f)), 1e-6f);
  }
}

TEST_F(GltfLoader, DoubleSidedMirrorsReflectOnBothSides) {
  MadeGltf made;
  made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")}}, {{"material", 0}});
  made.add("nodes", {{"mesh", 0}});
  std::set<std::string> fingerprints;
  for (const bool both : {false, true}) {
    made.root["materials"] = {{{"pbrMetallicRoughness", {{"roughnessFactor", 0}}}, {"doubleSided", both}}};
    const Scene scene = loadScene(folder_.write("m.glb", made.binary()));
    ASSERT_EQ(scene.materialMirrors.size(), 1u);
    EXPECT_EQ(scene.materialMirrors[0].mirror.twoSided, both);
    Fingerprint fingerprint;
    addScene(fingerprint, scene);
    fingerprints.insert(fingerprint.hex());
  }
  EXPECT_EQ(fingerprints.size(), 2u);
}

TEST_F(GltfLoader, MetalAndRoughnessAreConverted) {
  MadeGltf made;
  const int positions = made.addNumbers(triangleNumbers, "VEC3");
  made.addMesh({{"POSITION", positions}}, {{"material", 0}});
  made.add("nodes", {{"mesh", 0}});
  for (const double metal : {0.0, 0.25, 1.0}) {
    made.root["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"metallicFactor", metal}, {"roughnessFactor", 0.5}}}}};
    const Material material = meshOf(made).parts.at(0).material;
    Material expected;
    setMetalRoughness(expected, {0.5, 0.25, 1.0}, metal, 0.5);
    EXPECT_EQ(material.diffuse, expected.diffuse);
    EXPECT_EQ(material.specular, expected.specular);
    EXPECT_EQ(material.shininess, expected.shininess);
  }
  // One pixel: roughness 51 / 255, metal 102 / 255. The factors of a material are 1.
  Image8 image(1, 1);
  image.rgba = {7, 51, 102, 255};
  writePng(folder_ / "mr.png", image);
  made.add("textures", {{"source", 0}});
  made.add("images", {{"uri", "mr.png"}});
  made.root["materials"] = {{{"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}}};
  const Mesh mesh = meshOf(made);
  Material expected;
  setMetalRoughness(expected, glm::dvec3(1.0), 0.4, 0.2);
  EXPECT_LE(glm::distance(mesh.parts.at(0).material.diffuse, expected.diffuse), 1e-12);
  EXPECT_NEAR(mesh.parts.at(0).material.shininess, expected.shininess, 1e-9 * expected.shininess);
  EXPECT_TRUE(contains(mesh.defects.at(0), "has a texture of metal and roughness, its mean is drawn"));
}

class GltfTextures : public GltfLoader {
 protected:
  // A triangle with texture coordinates, and a material with a texture of this image.
  MadeGltf made(const json& image) {
    MadeGltf made;
    const int uv = made.addNumbers<float>({0, 0, 1, 0, 0, 0.25f}, "VEC2");
    const int other = made.addNumbers<float>({0.5f, 0.5f, 0, 0, 0, 1}, "VEC2");
    made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")}, {"TEXCOORD_0", uv}, {"TEXCOORD_1", other}},
                 {{"material", 0}});
    made.add("nodes", {{"mesh", 0}});
    made.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    made.add("textures", {{"source", 0}});
    made.add("images", image);
    return made;
  }
  static json& textureOf(MadeGltf& made) {
    return made.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  }
  std::string picture() {
    writePng(folder_ / "t.png", testing_support::greyPicture(4, 2, 255));
    return readText(folder_ / "t.png");
  }
};

TEST_F(GltfTextures, PicturesMayStandAnywhere) {
  const std::string png = picture();
  folder_.write("pictures/a b.png", png);
  folder_.write(" first.png", png);
  MadeGltf embedded = made({{"mimeType", "image/png"}});
  embedded.root["images"][0]["bufferView"] = embedded.addView(png);
  int count = 0;
  for (const MadeGltf& made :
       {made({{"uri", "t.png"}}), made({{"uri", "pictures/a%20b.png"}}), embedded, made({{"uri", " first.png"}}),
        made({{"uri", "data:image/png;base64," + MadeGltf::base64(png)}})}) {
    const Mesh mesh = meshOf(made);
    EXPECT_GE(mesh.parts.at(0).material.diffuseTexture, 0);
    EXPECT_EQ(textures_.back().width, 4);
    ++count;
  }
  EXPECT_EQ(textures_.size(), 5u);
  EXPECT_EQ(count, 5);
  EXPECT_EQ(warnings(), "");
}

TEST_F(GltfTextures, DataUrisMayBeBrokenOrEscaped) {
  const std::string data = MadeGltf::base64(picture());
  std::string lines;
  std::string escaped;
  for (size_t i = 0; i < data.size(); ++i) {
    lines += (i % 20 == 0 ? "\r\n" : "") + data.substr(i, 1);
    escaped += data[i] == '/' ? "%2F" : data[i] == '+' ? "%2b" : data.substr(i, 1);
  }
  EXPECT_NE(escaped, data);
  for (const std::string& text : {lines, escaped}) {
    textures_.clear();
    EXPECT_EQ(meshOf(made({{"uri", "data:image/png;base64," + text}})).parts.at(0).material.diffuseTexture, 0);
    EXPECT_EQ(textures_.at(0).width, 4);
  }
  EXPECT_EQ(warnings(), "");
}

// A small file may name one large picture any number of times.
TEST_F(GltfTextures, EachPictureIsReadOnce) {
  const std::string png = picture();
  MadeGltf made = this->made({{"mimeType", "image/png"}});
  made.root["images"][0]["bufferView"] = made.addView(png);
  const json view = made.root["bufferViews"].back();
  for (int i = 1; i < 5; ++i) {
    made.add("textures", {{"source", made.add("images", {{"bufferView", made.add("bufferViews", view)}})}});
    made.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
    made.add("nodes", {{"mesh", made.addMesh({{"POSITION", 2}}, {{"material", i}})}});
  }
  EXPECT_EQ(meshOf(made).parts.size(), 5u);
  EXPECT_EQ(textures_.size(), 1u);
}

TEST_F(GltfTextures, AlphaIsCoverageUnlessOpaque) {
  MadeGltf made = this->made({{"uri", "t.png"}});
  writePng(folder_.path() / "t.png",
           testing_support::madePicture(4, 4, [](int x, int) { return glm::ivec4(255, 255, 255, 60 * x); }));
  json& material = made.root["materials"][0];
  material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
  const auto read = [&] { return meshOf(made).parts.at(0).material; };
  EXPECT_FALSE(read().isTransparent()) << "OPAQUE is the usual mode";
  material["alphaMode"] = "BLEND";
  EXPECT_EQ(read().opacity, 0.5);
  EXPECT_EQ(read().opacityTexture, read().diffuseTexture);
  EXPECT_LT(read().cutoff, 0.0);
  material["alphaMode"] = "MASK";
  EXPECT_EQ(read().cutoff, 0.5);
  material["alphaCutoff"] = 0.25;
  EXPECT_EQ(read().cutoff, 0.25);
}

TEST_F(GltfLoader, MaterialsOfExtensionsHaveTheirBaseColor) {
  MadeGltf made;
  made.add("materials", {{"extensions",
                          {{"KHR_materials_pbrSpecularGlossiness",
                            {{"diffuseFactor", {0.2, 0.4, 0.6, 0.5}}, {"glossinessFactor", 0.25}}}}},
                         {"alphaMode", "BLEND"}});
  made.add("materials", {{"extensions", {{"KHR_materials_unlit", json::object()}}},
                         {"pbrMetallicRoughness", {{"baseColorFactor", {0.1, 0.9, 0.5, 1}}}}});
  made.add("materials", {{"name", "coat"}, {"extensions", {{"KHR_materials_clearcoat", json::object()}}}});
  made.add("materials", {{"extensions",
                          {{"KHR_materials_pbrSpecularGlossiness",
                            {{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {0.9, 0.9, 0.9}}}}}},
                         {"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1, 1}}, {"metallicFactor", 0}}}});
  made.add("materials", 7);
  made.root["extensionsRequired"] = {"KHR_materials_unlit", "KHR_materials_pbrSpecularGlossiness",
                                     "KHR_materials_clearcoat", "KHR_texture_basisu"};
  for (int material = 0; material < 4; ++material) {
    const int positions = made.addNumbers(triangleNumbers, "VEC3");
    made.add("nodes", {{"mesh", made.addMesh({{"POSITION", positions}}, {{"material", material}})}});
  }
  const Mesh mesh = meshOf(made);
  ASSERT_EQ(mesh.parts.size(), 4u);
  EXPECT_EQ(mesh.parts[3].material.diffuse, glm::dvec3(0.5, 0.25, 1)) << "the file's own description";
  EXPECT_EQ(mesh.parts[0].material.diffuse, glm::dvec3(0.2, 0.4, 0.6));
  EXPECT_EQ(mesh.parts[0].material.opacity, 0.5);
  EXPECT_NEAR(mesh.parts[0].material.shininess, 2 / std::pow(0.75, 4) - 2, 1e-9);
  EXPECT_EQ(mesh.parts[1].material.diffuse, glm::dvec3(0.1, 0.9, 0.5));
  ASSERT_GE(mesh.defects.size(), 3u);
  EXPECT_TRUE(contains(mesh.defects[0], "extensionsRequired: KHR_texture_basisu cannot be read")) << mesh.defects[0];
  EXPECT_TRUE(std::ranges::any_of(mesh.defects, [](const std::string& defect) {
    return defect.ends_with(":1: KHR_materials_clearcoat: is not read, 'coat' is drawn without it");
  })) << warnings();
}

TEST_F(GltfLoader, WhatMaterialsTransmitIsNotCovered) {
  MadeGltf made;
  made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")}}, {{"material", 0}});
  made.add("nodes", {{"mesh", 0}});
  for (const auto& [mode, opacity] : {std::pair("OPAQUE", 0.25), std::pair("BLEND", 0.125), std::pair("MASK", 0.5)}) {
    made.root["materials"] = {{{"alphaMode", mode},
                               {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}},
                               {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}}}}}};
    const Mesh mesh = meshOf(made);
    EXPECT_EQ(mesh.parts.at(0).material.opacity, opacity) << mode;
    EXPECT_TRUE(mesh.defects.empty());
  }
  Image8 image(1, 1);
  image.rgba = {51, 255, 255, 255};
  writePng(folder_ / "clear.png", image);
  made.add("textures", {{"source", 0}});
  made.add("images", {{"uri", "clear.png"}});
  json clear{{"transmissionFactor", 1}};
  made.root["materials"] = {{{"extensions", {{"KHR_materials_transmission", clear}}}}};
  EXPECT_NEAR(meshOf(made).parts.at(0).material.opacity, 0.04, 1e-12) << "clear glass is seen";
  clear["transmissionTexture"] = {{"index", 0}};
  made.root["materials"] = {{{"extensions", {{"KHR_materials_transmission", clear}}}}};
  const Mesh mesh = meshOf(made);
  EXPECT_NEAR(mesh.parts.at(0).material.opacity, 1.0 - 0.96 * 0.2, 1e-12);
  EXPECT_TRUE(contains(mesh.defects.at(0), "has a texture of its transmission"));
}

TEST_F(GltfLoader, AlphaOfVertexColorsCountsUnlessOpaque) {
  MadeGltf made;
  const int positions = made.addNumbers(triangleNumbers, "VEC3");
  const int clear = made.addNumbers<uint8_t>({255, 0, 0, 0, 255, 0, 0, 51, 255, 0, 0, 255}, "VEC4", true);
  const int dense = made.addNumbers<float>({1, 0, 0, 1, 1, 0, 0, 7, 1, 0, 0, 1}, "VEC4");
  made.add("materials", {{"alphaMode", "OPAQUE"}});
  made.add("materials", {{"alphaMode", "BLEND"}});
  made.add("materials", {{"alphaMode", "MASK"}});
  made.add("materials", {{"alphaMode", "BLEND"}, {"name", "dense"}});
  for (int material = 0; material < 4; ++material) {
    made.add("nodes", {{"mesh", made.addMesh({{"POSITION", positions}, {"COLOR_0", material < 3 ? clear : dense}},
                                             {{"material", material}})}});
  }
  const Mesh mesh = meshOf(made);
  ASSERT_EQ(mesh.parts.size(), 4u);
  EXPECT_FALSE(mesh.parts[0].material.isTransparent());
  EXPECT_TRUE(mesh.parts[1].material.vertexAlpha && mesh.parts[1].material.isTransparent());
  EXPECT_TRUE(mesh.parts[2].material.vertexAlpha);
  EXPECT_EQ(mesh.parts[2].material.cutoff, 0.5);
  EXPECT_FALSE(mesh.parts[3].material.isTransparent()) << "no alpha is below 1";
  EXPECT_TRUE(mesh.hasVertexAlpha());
  EXPECT_EQ(mesh.colors[mesh.indices[1]], glm::vec4(1, 0, 0, 0.2f));
}

TEST_F(GltfLoader, AlphaOfTrianglesLeftOutIsNone) {
  MadeGltf made;
  const int positions = made.addNumbers(triangleNumbers, "VEC3");
  const int clear = made.addNumbers<uint8_t>({255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}, "VEC4", true);
  made.add("materials", {{"alphaMode", "BLEND"}});
  const int hidden = made.addMesh({{"POSITION", positions}, {"COLOR_0", clear}}, {{"material", 0}});
  made.add("nodes", {{"mesh", hidden}, {"scale", {0, 0, 0}}});
  made.add("nodes", {{"mesh", made.addMesh({{"POSITION", positions}}, {{"material", 0}})}});
  const Mesh mesh = meshOf(made);
  ASSERT_EQ(mesh.indices.size(), 3u);
  EXPECT_TRUE(mesh.colors.empty());
  EXPECT_FALSE(mesh.hasVertexAlpha());
}

TEST_F(GltfTextures, MissingOrUnreadablePicturesAreLeftOut) {
  folder_.write("text.png", "no picture");
  for (const auto& [image, problem] :
       {std::pair(json{{"uri", "none.png"}}, "images: there is no file 'none.png', the texture is left out"),
        std::pair(json{{"uri", "text.png"}}, "is not a picture that can be read"),
        std::pair(json{{"uri", "data:image/png;base64,AAAA"}}, "m.glb#images[0]: is not a picture that can be read"),
        std::pair(json{{"bufferView", 99}}, "images: image 0 has no data, the texture is left out")}) {
    const Mesh mesh = meshOf(made(image));
    EXPECT_EQ(mesh.parts.at(0).material.diffuseTexture, -1);
    ASSERT_EQ(mesh.defects.size(), 1u);
    EXPECT_TRUE(contains(mesh.defects[0], problem));
  }
  MadeGltf made = this->made({{"uri", "none.png"}});
  made.root["textures"][0] = json::object();
  EXPECT_TRUE(contains(meshOf(made).defects.at(0), "there is no image -1"));
  made.root["textures"][0]["sampler"] = 3;
  EXPECT_TRUE(contains(meshOf(made).defects.at(0), "there is no sampler 3, the texture repeats"));
  made.root["textures"][0].erase("sampler");
  made.root["textures"][0]["extensions"]["EXT_texture_webp"] = {{"source", 0}};
  EXPECT_TRUE(contains(meshOf(made).defects.at(0), "has no picture but that of EXT_texture_webp, it is left out"));
  textureOf(made)["index"] = 5;
  EXPECT_TRUE(contains(meshOf(made).defects.at(0), "there is no texture 5"));
}

TEST_F(GltfTextures, CoordinatesAreThoseTheTextureAsksFor) {
  picture();
  MadeGltf made = this->made({{"uri", "t.png"}});
  const auto uvs = [&] {
    std::vector<glm::dvec3> points;
    for (const Vertex& vertex : meshOf(made).vertices) {
      points.emplace_back(vertex.uv, 0.0);
    }
    return points;
  };
  expectNear(uvs(), {{0, 1, 0}, {1, 1, 0}, {0, 0.75, 0}});
  textureOf(made)["texCoord"] = 1;
  expectNear(uvs(), {{0.5, 0.5, 0}, {0, 1, 0}, {0, 0, 0}});
  EXPECT_EQ(warnings(), "");
  textureOf(made)["texCoord"] = 2;
  EXPECT_TRUE(contains(meshOf(made).defects.at(0),
                       "textures: texture 0 is on a mesh without its texture coordinates, which count as 0"));
  // The example of the extension's text: the lower left quadrant, turned clockwise.
  textureOf(made) = {
      {"index", 0},
      {"texCoord", 1},
      {"extensions",
       {{"KHR_texture_transform",
         {{"offset", {0, 1}}, {"rotation", glm::half_pi<double>()}, {"scale", {0.5, 0.5}}, {"texCoord", 0}}}}}};
  expectNear(uvs(), {{0, 0, 0}, {0, 0.5, 0}, {0.125, 0, 0}});
  textureOf(made)["extensions"]["KHR_texture_transform"] = {{"offset", {0.25, 0}}, {"scale", {2, 4}}};
  expectNear(uvs(), {{0.25 + 1, 1 - 2, 0}, {0.25, 1, 0}, {0.25, 1 - 4, 0}});  // texCoord is the texture's again
}

TEST_F(GltfTextures, ClampingAndMirroringWarnWhereTheyCount) {
  picture();
  MadeGltf made = this->made({{"uri", "t.png"}});
  made.add("samplers", {{"wrapS", 33071}});
  made.root["textures"][0]["sampler"] = 0;
  EXPECT_TRUE(meshOf(made).defects.empty()) << "nothing leaves the picture";
  textureOf(made)["extensions"]["KHR_texture_transform"] = {{"scale", {1, 5}}};
  EXPECT_TRUE(meshOf(made).defects.empty()) << "it leaves where it repeats";
  textureOf(made)["extensions"]["KHR_texture_transform"] = {{"scale", {1.5, 1}}};
  EXPECT_TRUE(contains(meshOf(made).defects.at(0), "samplers: texture 0 is mirrored, or clamped in one direction"));
  made.root["samplers"][0]["wrapT"] = 33071;
  EXPECT_TRUE(meshOf(made).defects.empty());
  EXPECT_TRUE(meshOf(made).parts.at(0).material.clamps);
  made.root["samplers"][0] = {{"wrapS", 10497}};
  EXPECT_TRUE(meshOf(made).defects.empty());
}

TEST_F(GltfLoader, VertexColorsTintMetals) {
  MadeGltf made;
  made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")},
                {"COLOR_0", made.addNumbers<float>({1, 0, 0, 1, 0.5f, 0, 1, 0.25f, 0.75f}, "VEC3")}},
               {{"material", 0}});
  made.add("nodes", {{"mesh", 0}});
  made.add("materials", {{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 1, 1, 1}}, {"roughnessFactor", 0}}}});
  const Material material = meshOf(made).parts.at(0).material;
  EXPECT_LE(glm::distance(material.mirror.value(), {0.5, 0.25, 0.25}), 1e-7);
}

TEST_F(GltfTextures, FilesThatAreNamedAreListed) {
  picture();
  MadeGltf made = this->made({{"uri", "t.png"}});
  folder_.write("m.bin", made.bytes);
  const fs::path file = folder_.write("m.gltf", made.text("m.bin"));
  std::set<fs::path> files;
  addModelFiles(file, files);
  EXPECT_EQ(files, (std::set<fs::path>{file, folder_ / "m.bin", folder_ / "t.png"}));
  EXPECT_EQ(loadModel(file, textures_).mesh.namedFiles, (std::vector<fs::path>{"m.bin", "t.png"}));
  files.clear();
  addModelFiles(folder_.write("damaged.gltf", "{\"images\": ["), files);
  EXPECT_EQ(files, std::set<fs::path>{folder_ / "damaged.gltf"});
}

TEST_F(GltfLoader, CameraAndLightsBecomeThoseOfTheScene) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}, {"translation", {0, 0, -4}}});
  made.add("cameras",
           {{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 1}}}});
  made.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  made.add("nodes", {{"camera", 0}});
  made.add("nodes", {{"camera", 1}, {"translation", {0.5, 0.25, 2}}, {"scale", {2, 2, 2}}});
  const json lights = {{{"type", "point"}, {"name", "lamp"}, {"color", {1, 0.5, 0.25}}, {"intensity", 30}},
                       {{"type", "directional"}, {"intensity", 2}},
                       {{"type", "spot"}, {"spot", json::object()}}};
  made.root["extensions"]["KHR_lights_punctual"]["lights"] = lights;
  for (int i = 0; i < 4; ++i) {
    made.add("nodes", {{"translation", {0, 3, 0}},
                       {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                       {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  const fs::path file = folder_.write("m.glb", made.binary());
  const Scene scene = loadScene(file);
  const glm::dvec3 moved = scene.objects.at(0).position;
  EXPECT_LE(glm::distance(scene.camera.position - moved, glm::dvec3(0.5, 0.25, 2)), 1e-9);
  EXPECT_LE(glm::distance(scene.camera.target - moved, glm::dvec3(0.5, 0.25, -4)), 1e-9) << "as far as the model";
  EXPECT_NEAR(scene.camera.verticalFov, glm::degrees(0.5), 1e-9);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].name, "lamp");
  EXPECT_EQ(scene.lights[0].color, glm::dvec3(1, 0.5, 0.25));
  EXPECT_EQ(scene.lights[0].intensity, 30.0);
  EXPECT_TRUE(scene.lights[0].castsShadow);
  EXPECT_LE(glm::distance(scene.lights[0].position - moved, glm::dvec3(0, 3, 0)), 1e-9);
  // The directional light shines along -Z of its node, which is -Y here.
  const glm::dvec3 towards = scene.lights[1].position - moved - scene.meshes[0].center;
  EXPECT_LE(glm::length(glm::normalize(towards) - glm::dvec3(0, 1, 0)), 1e-9);
  EXPECT_NEAR(scene.lights[1].intensity / glm::dot(towards, towards), 2.0, 1e-9) << "the irradiance that is said";
  EXPECT_TRUE(contains(warnings(), "lights: light 2 is a spot, it shines to all sides"));
  EXPECT_TRUE(contains(warnings(), "lights: light 3 is not there"));
  const Scene saved = loadScene(folder_.write("saved.toml", scene.text));
  EXPECT_TRUE(saved.camera == scene.camera && saved.lights == scene.lights);
  // As an object of a scene, a model brings neither.
  const Scene other = loadScene(folder_.write("other.toml", usualCamera + "[[object]]\nmodel = \"m.glb\"\n"));
  EXPECT_TRUE(other.lights.empty());
}

TEST_F(GltfLoader, CamerasBelowSeeNoFloor) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  made.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  made.add("nodes", {{"camera", 0}});
  for (const double height : {0.5, -3.0}) {
    made.root["nodes"][1]["translation"] = {0.5, height, 4};
    EXPECT_EQ(loadScene(folder_.write("m.glb", made.binary())).mirrors.empty(), height < 0.0);
  }
}

TEST_F(GltfLoader, EachLightIsRepairedAlone) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  const std::vector<json> lights{{{"type", "point"}}, {{"type", "spot"}}, {{"intensity", 5}}, 7, {{"type", "point"}}};
  for (size_t i = 0; i < lights.size(); ++i) {
    made.root["extensions"]["KHR_lights_punctual"]["lights"].push_back(lights[i]);
    made.add("nodes", {{"translation", {i, 0, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  const Scene scene = loadScene(folder_.write("m.glb", made.binary()));
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_NEAR(scene.lights[1].position.x - scene.lights[0].position.x, 4.0, 1e-9);
  EXPECT_TRUE(contains(warnings(), "lights: 1 (")) << warnings();
  EXPECT_TRUE(contains(warnings(), "cannot be read, what uses it is left out (and 2 more)"));
}

TEST_F(GltfLoader, BrightLightsAreDimmedTogether) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  json& lights = made.root["extensions"]["KHR_lights_punctual"]["lights"];
  lights = {{{"type", "point"}}, {{"type", "point"}}};
  for (int i = 0; i < 2; ++i) {
    made.add("nodes", {{"translation", {0.5, 0.5, 5}}, {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
  }
  for (const double candela : {100.0, 50'000.0}) {
    const bool bright = candela > 100.0;
    lights[0]["intensity"] = candela;
    lights[1]["intensity"] = 0.25 * candela;
    const Scene scene = loadScene(folder_.write("m.glb", made.binary()));
    EXPECT_NEAR(scene.lights.at(0).intensity, bright ? 80.0 : 100.0, 1e-9);
    EXPECT_NEAR(scene.lights.at(1).intensity, bright ? 20.0 : 25.0, 1e-9);
    EXPECT_EQ(contains(log_.text(), "its lights are very bright, their intensities are divided by 625.0"), bright)
        << log_.text();
  }
}

TEST_F(GltfLoader, LampsWithinTheModelAreUsual) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  made.add("nodes", {{"translation", {0.5, 0.5, 0.01}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  made.root["extensions"]["KHR_lights_punctual"]["lights"].push_back({{"type", "point"}, {"intensity", 10}});
  loadScene(folder_.write("m.glb", made.binary()));
  EXPECT_FALSE(contains(log_.text(), "divided by")) << log_.text();
}

TEST_F(GltfLoader, HiddenNodesAreNotDrawn) {
  MadeGltf made;
  const int mesh = made.addTriangle();
  made.add("nodes", {{"children", {1, 2}}});
  made.add("nodes", {{"mesh", mesh}, {"children", {3}}});
  made.add("nodes", {{"mesh", mesh}});
  made.add("nodes", {{"mesh", mesh}});
  made.add("scenes", {{"nodes", {0}}});
  made.root["extensionsRequired"] = {"KHR_node_visibility"};
  for (const auto& [visible, triangles] :
       {std::pair(json(true), 3), std::pair(json(false), 1), std::pair(json(0), 3)}) {
    made.root["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = visible;
    EXPECT_EQ(meshOf(made).indices.size(), 3u * triangles) << visible;
  }
  EXPECT_EQ(warnings(), "");
}

TEST_F(GltfLoader, TextThatIsNotUtf8CountsAsLatin1) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}, {"name", "K@rper"}});
  made.add("materials", {{"name", "h\u00fcgel"}});
  std::string text = made.text();
  text[text.find('@')] = '\xf6';
  EXPECT_EQ(load(text).mesh.indices.size(), 3u);
  EXPECT_EQ(warnings(), "warning: m.gltf:1: json: has bytes that are not UTF-8, they count as Latin-1\n");
  EXPECT_TRUE(contains(faultOf("\xff\xfe{"), "is UTF-16 text"));
}

TEST_F(GltfLoader, CamerasWithoutAUsablePlaceAreLeftOut) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  made.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  for (const json& node : std::vector<json>{{{"scale", {0, 0, 0}}},
                                            {{"translation", {1e300, 0, 0}}},
                                            {{"matrix", {1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}}) {
    made.root["nodes"][1] = node;
    made.root["nodes"][1]["camera"] = 0;
    const Scene scene = loadScene(folder_.write("m.glb", made.binary()));
    EXPECT_EQ(scene.camera.verticalFov, 36.0) << "the usual one";
    EXPECT_EQ(scene.meshes[0].defects.size(), 1u);
  }
}

// Each number of a file, wrong in several ways, costs one warning. What it belongs to is drawn.
TEST_F(GltfLoader, WrongNumbersWarnAndDraw) {
  writePng(folder_ / "t.png", testing_support::greyPicture(4, 2, 255));
  struct Place {
    const char* list;
    std::string numbers;
    size_t count;
  };
  const std::string glossy = "/extensions/KHR_materials_pbrSpecularGlossiness/";
  for (const auto& [list, numbers, count] : std::vector<Place>{
           {"/materials", "/pbrMetallicRoughness/baseColorFactor", 4},
           {"/materials", "/pbrMetallicRoughness/metallicFactor", 1},
           {"/materials", "/pbrMetallicRoughness/roughnessFactor", 1},
           {"/materials", "/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset", 2},
           {"/materials", "/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/scale", 2},
           {"/materials", "/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation", 1},
           {"/materials", glossy + "diffuseFactor", 4},
           {"/materials", glossy + "glossinessFactor", 1},
           {"/materials", glossy + "diffuseTexture/extensions/KHR_texture_transform/offset", 2},
           {"/materials", glossy + "diffuseTexture/extensions/KHR_texture_transform/scale", 2},
           {"/materials", glossy + "diffuseTexture/extensions/KHR_texture_transform/rotation", 1},
           {"/materials", "/extensions/KHR_materials_transmission/transmissionFactor", 1},
           {"/materials", "/emissiveFactor", 3},
           {"/materials", "/extensions/KHR_materials_emissive_strength/emissiveStrength", 1},
           {"/materials", "/alphaCutoff", 1},
           {"/nodes", "/translation", 3},
           {"/nodes", "/rotation", 4},
           {"/nodes", "/scale", 3},
           {"/nodes", "/matrix", 16},
           {"/cameras", "/perspective/yfov", 1},
           {"/extensions/KHR_lights_punctual/lights", "/color", 3},
           {"/extensions/KHR_lights_punctual/lights", "/intensity", 1}}) {
    const bool bounded = list != std::string("/nodes") && !contains(numbers, "KHR_texture_transform");
    std::vector<json> wrong{"text", nullptr, json::object()};
    if (count > 1) {
      wrong.insert(wrong.end(), {1.0, std::vector(count - 1, 0.5), std::vector(count + 1, 0.5)});
      wrong.push_back(std::vector(count, 0.5));
      wrong.back().back() = "text";
    }
    if (bounded) {
      wrong.push_back(count == 1 ? json(-4) : json(std::vector(count, -4.0)));
    }
    for (const json& value : wrong) {
      MadeGltf made = texturedTriangle();
      if (contains(numbers, glossy)) {
        made.add("materials",
                 {{"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"diffuseTexture", {{"index", 0}}}}}}}});
      } else {
        made.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
      }
      made.add("nodes", {{"mesh", 0}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
      made.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
      made.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
      made.root[json::json_pointer(list)][0][json::json_pointer(numbers)] = value;
      const Mesh mesh = meshOf(made);
      EXPECT_EQ(mesh.indices.size(), 3u) << numbers << " " << value;
      const std::string last = numbers.substr(1) + " of 0 is wrong, the nearest or the usual value counts";
      ASSERT_EQ(mesh.defects.size(), 1u) << numbers << " " << value;
      EXPECT_TRUE(mesh.defects[0].ends_with(last)) << mesh.defects[0];
    }
  }
}

// The library takes an index of a wrong type for a missing one.
TEST_F(GltfLoader, WrongIndicesWarnAndDraw) {
  writePng(folder_ / "t.png", testing_support::greyPicture(4, 2, 255));
  const std::string base = "/materials/0/pbrMetallicRoughness/baseColorTexture";
  for (const std::string& place :
       std::vector<std::string>{base + "/index",
                                base + "/texCoord",
                                base + "/extensions/KHR_texture_transform/texCoord",
                                base,
                                base + "/extensions/KHR_texture_transform",
                                "/materials/0/pbrMetallicRoughness",
                                "/materials/0/emissiveTexture/index",
                                "/materials/0/pbrMetallicRoughness/metallicRoughnessTexture/index",
                                "/materials/0/extensions/KHR_materials_transmission/transmissionTexture/index",
                                "/textures/0/source",
                                "/textures/0/sampler",
                                "/nodes/1/mesh",
                                "/nodes/0/skin",
                                "/nodes/0/camera",
                                "/nodes/0/extensions/KHR_lights_punctual/light",
                                "/accessors/0/byteOffset",
                                "/accessors/1/bufferView",
                                "/bufferViews/0/byteOffset",
                                "/bufferViews/0/byteStride",
                                "/meshes/0/primitives/0/material",
                                "/meshes/0/primitives/0/mode"}) {
    for (const json& value : {json("0"), json(0.5), json::array({0})}) {
      MadeGltf made = texturedTriangle();
      made.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
      made.add("nodes", {{"mesh", 0}});
      made.add("nodes", json::object());
      made.root[json::json_pointer(place)] = value;
      const Mesh mesh = meshOf(made);
      EXPECT_EQ(mesh.indices.size(), 3u) << place << value;
      ASSERT_GE(mesh.defects.size(), 1u) << place << value;
      EXPECT_TRUE(mesh.defects[0].ends_with(contains(place, "primitives")
                                                ? "that is no integer from 0, the usual one counts"
                                                : "is wrong, the nearest or the usual value counts"))
          << mesh.defects[0];
    }
  }
}

TEST_F(GltfLoader, MatricesTakeMemoryForTheirBytesOnly) {
  MadeGltf made;
  made.addTriangle();
  made.add("nodes", {{"mesh", 0}, {"skin", 0}});
  made.add("accessors", {{"bufferView", 0}, {"componentType", 5126}, {"type", "MAT4"}, {"count", 1 << 30}});
  made.add("skins", {{"joints", {0}}, {"inverseBindMatrices", 1}});
  const Mesh mesh = meshOf(made);
  EXPECT_EQ(mesh.indices.size(), 3u);
  EXPECT_TRUE(contains(mesh.defects.at(0), "accessors: 1 does not hold what is needed of it"));
}

// The library reads these as other numbers, or leaves a list out for one of its members.
TEST_F(GltfLoader, WrongNumbersOfAnyKindWarn) {
  struct Wrong {
    const char* place;
    json value;
    const char* defect;
  };
  const std::vector<Wrong> values{
      {"/nodes/1/mesh", 4294967296, "nodes: mesh of 1 is wrong"},
      {"/accessors/1/bufferView", -1, "accessors: bufferView of 1 is wrong"},
      {"/accessors/1/bufferView", UINT64_MAX, "accessors: bufferView of 1 is wrong"},
      {"/nodes/1/children", json::array({4294967298}), "nodes: have children that are no indices"},
      {"/bufferViews/0/byteOffset", -36, "bufferViews: byteOffset of 0 is wrong"},
      {"/bufferViews/0/byteStride", -4, "bufferViews: byteStride of 0 is wrong"},
      {"/accessors/0/sparse/indices/byteOffset", -4, "accessors: sparse/indices/byteOffset of 0 is wrong"},
      {"/accessors/0/sparse/indices/byteOffset", 4294967296, "accessors: sparse/indices/byteOffset of 0 is wrong"},
      {"/accessors/0/sparse/values/byteOffset", "4", "accessors: sparse/values/byteOffset of 0 is wrong"},
      {"/nodes/1/children", "1", "nodes: have children that are no indices, these are left out"},
      {"/nodes/1/children", json::array({"1", 2}), "nodes: have children that are no indices, these are left out"},
      {"/scenes/0/nodes", json::array({0, "1"}), "scenes: have nodes that are no indices, these are left out"},
      {"/meshes/1/primitives", json::object(), "meshes: have primitives that are no list, they are left out"}};
  for (const auto& [place, value, defect] : values) {
    MadeGltf made;
    made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")},
                  {"TEXCOORD_0", made.addNumbers<float>({0, 0, 1, 0, 0, 1}, "VEC2")}});
    made.add("meshes", {{"primitives", json::array()}});
    made.add("nodes", {{"mesh", 0}});
    made.add("nodes", json::object());
    made.add("nodes", json::object());
    made.add("scenes", {{"nodes", {0, 1}}});
    made.root["accessors"][0]["sparse"] = {
        {"count", 1}, {"indices", {{"bufferView", 0}, {"componentType", 5121}}}, {"values", {{"bufferView", 0}}}};
    made.root[json::json_pointer(place)] = value;
    const Mesh mesh = meshOf(made);
    EXPECT_EQ(mesh.indices.size(), 3u) << place << value;
    ASSERT_GE(mesh.defects.size(), 1u) << place << value;
    EXPECT_TRUE(contains(mesh.defects[0], defect)) << mesh.defects[0];
  }
}

TEST_F(GltfLoader, ExtremeNumbersAreNoDefects) {
  MadeGltf made;
  made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")}}, {{"material", 0}});
  made.add("nodes", {{"mesh", 0}, {"rotation", {0, 0, 0, 3}}, {"camera", 0}});
  made.add("nodes", {{"mesh", 0}, {"scale", {-1, 0, 1e30}}, {"translation", {-1e3, 0, 1e3}}});
  made.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.005}, {"znear", 0.1}}}});
  made.add("materials", {{"alphaMode", "MASK"},
                         {"alphaCutoff", 1.5},
                         {"emissiveFactor", {1, 0, 1}},
                         {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 1e6}}}}},
                         {"pbrMetallicRoughness", {{"baseColorFactor", {0, 1, 0, 0}}, {"roughnessFactor", 0}}}});
  made.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 1e9}}};
  EXPECT_EQ(meshOf(made).defects, std::vector<std::string>());
}

TEST_F(GltfLoader, NearestNumbersCount) {
  MadeGltf made;
  made.addMesh({{"POSITION", made.addNumbers(triangleNumbers, "VEC3")}}, {{"material", 0}});
  made.add("nodes", {{"mesh", 0}, {"rotation", {0, 0, 0, 0}}, {"scale", {2, 2}}});
  made.add("materials", {{"alphaMode", "BLEND"},
                         {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0.5, -1, 7}}, {"metallicFactor", 0}}}});
  Model model = load(made.binary(), "m.glb");
  ASSERT_EQ(model.mesh.defects.size(), 2u);
  EXPECT_TRUE(model.mesh.defects[0].ends_with("counts")) << model.mesh.defects[0];
  EXPECT_EQ(model.mesh.parts.at(0).material.diffuse, glm::dvec3(0, 0.5, 0));
  EXPECT_EQ(model.mesh.parts.at(0).material.opacity, 1.0);
  expectNear(cornersOf(model.mesh), {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}});
  made.root["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0.5, 0};
  EXPECT_EQ(meshOf(made).parts.at(0).material.diffuse, glm::dvec3(0, 0.5, 0)) << "without alpha";
}

TEST_F(GltfLoader, ContradictionsWarnAndDraw) {
  for (const auto& [damage, problem] :
       {std::pair<void (*)(json&), const char*>([](json& r) { r["scene"] = 9; }, "scene: is not there"),
        {[](json& r) {
           r["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
           r["nodes"][0]["scale"] = {2, 2, 2};
         },
         "nodes: have a matrix and another transform"},
        {[](json& r) {
           r["nodes"][0]["matrix"] = nullptr, r["nodes"][0]["scale"] = {2, 2, 2};
         },
         "nodes: have a matrix and another transform, the other counts"},
        {[](json& r) { r["materials"][0]["alphaMode"] = "FOO"; }, "materials: have an alphaMode"},
        {[](json& r) { r["asset"]["minVersion"] = "2.9"; }, "asset.minVersion: is not 2.0"}}) {
    MadeGltf made;
    made.add("nodes", {{"mesh", made.addTriangle()}});
    made.add("materials", json::object());
    damage(made.root);
    const Mesh mesh = meshOf(made);
    EXPECT_EQ(mesh.indices.size(), 3u);
    ASSERT_EQ(mesh.defects.size(), 1u);
    EXPECT_TRUE(contains(mesh.defects[0], problem)) << mesh.defects[0];
  }
}

// What is wrong with a file, and what it costs.
struct Damage {
  const char* name;
  std::function<void(json&)> apply;
  const char* message;
  bool refused = false;
  size_t warnings = 1;
};

void PrintTo(const Damage& damage, std::ostream* stream) {
  *stream << damage.name;
}

class GltfDamage : public GltfLoader, public testing::WithParamInterface<Damage> {};

TEST_F(GltfLoader, IndicesOfNothingWarnAndDraw) {
  for (const auto& [damage, problem] :
       {std::pair<void (*)(json&), const char*>([](json& r) { r["meshes"][0]["primitives"][0]["material"] = 7; },
                                                "meshes: there is no material 7, its triangles get the default one"),
        {[](json& r) { r["nodes"][0]["skin"] = 3; },
         "nodes: there is no skin 3, the mesh stands where its node does"}}) {
    MadeGltf made;
    made.add("nodes", {{"mesh", made.addTriangle()}});
    damage(made.root);
    const Mesh mesh = meshOf(made);
    EXPECT_EQ(mesh.indices.size(), 3u);
    ASSERT_EQ(mesh.defects.size(), 1u);
    EXPECT_TRUE(contains(mesh.defects[0], problem)) << mesh.defects[0];
  }
}

// Two triangles, of which the damage may touch the second.
TEST_P(GltfDamage, CostsWhatItTouches) {
  MadeGltf made;
  made.addTriangle();
  const int positions = made.addNumbers(triangleNumbers, "VEC3");
  const int indices = made.addNumbers<uint16_t>({0, 1, 2}, "SCALAR");
  made.addMesh({{"POSITION", positions}}, {{"indices", indices}});
  made.add("nodes", {{"mesh", 0}, {"children", {1}}});
  made.add("nodes", {{"mesh", 1}});
  made.add("scenes", {{"nodes", {0}}});
  json root = json::parse(made.text());
  EXPECT_EQ(load(root.dump()).mesh.indices.size(), 6u);
  GetParam().apply(root);
  if (GetParam().refused) {
    const std::string fault = faultOf(root.dump());
    EXPECT_TRUE(startsWith(fault, "m.gltf:1: ") && fault.ends_with(')')) << fault;
    EXPECT_TRUE(contains(fault, GetParam().message));
    return;
  }
  const Mesh mesh = load(root.dump()).mesh;
  EXPECT_EQ(mesh.indices.size(), 3u);
  ASSERT_EQ(mesh.defects.size(), GetParam().warnings);
  EXPECT_TRUE(contains(mesh.defects[0], GetParam().message)) << mesh.defects[0];
}

const char* const numbersMissing = "does not hold what is needed of it, what uses it is left out";

INSTANTIATE_TEST_SUITE_P(
    All, GltfDamage,
    testing::Values(
        Damage{"TwoIndices", [](json& r) { r["accessors"][2]["count"] = 2; },
               "mesh 1 has a last triangle of fewer than three vertices, it is left out"},
        Damage{"BufferWithoutData",
               [](json& r) {
                 r["buffers"].push_back({{"byteLength", 36}});
                 r["bufferViews"][1]["buffer"] = 1;
               },
               "buffers: 1 has no data, as with EXT_meshopt_compression, what uses it is left out", false, 2},
        Damage{"IndexOfAVertex", [](json& r) { r["accessors"][2]["count"] = 3, r["accessors"][1]["count"] = 2; },
               "mesh 1 has a triangle with a vertex that is not there"},
        Damage{"AccessorBeyondItsView", [](json& r) { r["accessors"][1]["count"] = 4; }, numbersMissing},
        Damage{"AccessorOfHugeCount", [](json& r) { r["accessors"][1]["count"] = 1ull << 60; },
               "too many vertices for a file of this size"},
        Damage{"OffsetBeyondTheView", [](json& r) { r["accessors"][1]["byteOffset"] = 4; }, numbersMissing},
        Damage{"HugeOffset", [](json& r) { r["accessors"][1]["byteOffset"] = ~0ull - 3; }, numbersMissing},
        Damage{"StrideBeyondTheView", [](json& r) { r["bufferViews"][1]["byteStride"] = 16; }, numbersMissing},
        Damage{"ViewBeyondItsBuffer", [](json& r) { r["bufferViews"][1]["byteLength"] = 1000; }, numbersMissing},
        Damage{"HugeViewOffset", [](json& r) { r["bufferViews"][1]["byteOffset"] = ~0ull - 3; }, numbersMissing},
        Damage{"MissingView", [](json& r) { r["accessors"][1]["bufferView"] = 9; }, numbersMissing},
        Damage{"MissingBuffer", [](json& r) { r["bufferViews"][1]["buffer"] = 99; }, numbersMissing},
        Damage{"UnknownComponents", [](json& r) { r["accessors"][1]["componentType"] = 5127; }, numbersMissing},
        Damage{"WrongType", [](json& r) { r["accessors"][1]["type"] = "VEC2"; }, numbersMissing},
        Damage{"MissingAccessor", [](json& r) { r["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = 99; },
               numbersMissing},
        Damage{"NoPosition",
               [](json& r) {
                 r["meshes"][1]["primitives"][0]["attributes"] = {{"NORMAL", 0}};
               },
               "mesh 1 has a primitive of an unknown mode or without POSITION"},
        Damage{"UnknownMode", [](json& r) { r["meshes"][1]["primitives"][0]["mode"] = 7; }, "of an unknown mode"},
        Damage{"MissingMesh", [](json& r) { r["nodes"][1]["mesh"] = 2; }, "nodes: there is no mesh 2"},
        Damage{"MissingNode", [](json& r) { r["nodes"][0]["children"] = {7}; }, "node 7 is not there"},
        Damage{"SparseIndexBeyondTheCount",
               [](json& r) {
                 r["accessors"][1]["sparse"] = {
                     {"count", 1},
                     {"indices", {{"bufferView", 0}, {"byteOffset", 12}, {"componentType", 5126}}},
                     {"values", {{"bufferView", 0}}}};
                 r["accessors"][1]["count"] = 1;
               },
               numbersMissing},
        Damage{"SparseOfNegativeCount",
               [](json& r) {
                 r["accessors"][1]["sparse"] = {{"count", -1},
                                                {"indices", {{"bufferView", 2}, {"componentType", 5123}}},
                                                {"values", {{"bufferView", 0}}}};
               },
               numbersMissing},
        Damage{"SparseOfAViewThatIsNoIndex",
               [](json& r) {
                 r["accessors"][1]["sparse"] = {{"count", 1},
                                                {"indices", {{"bufferView", 4294967298}, {"componentType", 5123}}},
                                                {"values", {{"bufferView", 0}}}};
               },
               "accessors: sparse/indices/bufferView of 1 is wrong", false, 2},
        Damage{"ViewOfABufferThatIsNoIndex", [](json& r) { r["bufferViews"][1]["buffer"] = 4294967296; },
               "bufferViews: buffer of 1 is wrong", false, 2},
        Damage{"InfinitePositions",
               [](json& r) {
                 r["nodes"][1]["scale"] = {1e308, 1e308, 1e308};
                 r["nodes"][0]["scale"] = {1, 1, 1};
                 r["nodes"][1]["translation"] = {1e308, 1e308, 1e308};
               },
               "triangles: ", false},
        // What tinygltf alone refuses a file for.
        Damage{"IndicesWithoutAView", [](json& r) { r["accessors"][2]["bufferView"] = 9; }, numbersMissing},
        Damage{"MissingIndices", [](json& r) { r["meshes"][1]["primitives"][0]["indices"] = 99; }, numbersMissing},
        Damage{"IndicesOfAWrongType", [](json& r) { r["meshes"][1]["primitives"][0]["indices"] = "2"; },
               numbersMissing},
        Damage{"AttributeOfAWrongType",
               [](json& r) { r["meshes"][1]["primitives"][0]["attributes"]["POSITION"] = "1"; }, numbersMissing},
        Damage{"PrimitiveOfAWrongType", [](json& r) { r["meshes"][1]["primitives"][0] = 5; }, "without POSITION"},
        Damage{"ViewOfNegativeLength", [](json& r) { r["bufferViews"][1]["byteLength"] = -1; },
               "bufferViews: 1 ('byteLength'", false, 2},
        Damage{"AccessorWithoutACount", [](json& r) { r["accessors"][1].erase("count"); }, "accessors: 1 ('count'",
               false, 2},
        Damage{"AccessorOfAnUnknownType", [](json& r) { r["accessors"][1]["type"] = "VEC5"; },
               "accessors: 1 (Unsupported `type`", false, 2},
        Damage{"MeshOfAWrongType", [](json& r) { r["meshes"][1] = 3; }, "meshes: 1 (`meshes'"},
        Damage{"NodeOfAWrongType",
               [](json& r) {
                 r["nodes"][1] = json::array({"mesh", 1});
               },
               "nodes: 1 (`nodes'"},
        Damage{"MaterialOfAWrongType",
               [](json& r) {
                 r["materials"] = {1};
                 r["scenes"][0]["nodes"] = {1};
               },
               "materials: 0 (`materials'"},
        Damage{"CameraWithoutAType",
               [](json& r) {
                 r["cameras"] = json::array({json::object()});
                 r["scenes"][0]["nodes"] = {1};
               },
               "cameras: 0 ('type'"},
        Damage{"LightsOfAWrongType",
               [](json& r) {
                 r["extensions"]["KHR_lights_punctual"]["lights"] = {1};
                 r["scenes"][0]["nodes"] = {1};
               },
               "lights: 0 ("},
        Damage{"CompressedButNotRequired",
               [](json& r) {
                 r["meshes"][1]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}};
                 r["accessors"][1].erase("bufferView");
               },
               "mesh 1 is compressed by KHR_draco_mesh_compression, it is left out"},
        Damage{"InstancesOfANode",
               [](json& r) {
                 r["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = json::object();
                 r["scenes"][0]["nodes"] = {1};
               },
               "nodes: node 1 has instances by EXT_mesh_gpu_instancing, it is drawn once"},
        Damage{"Version", [](json& r) { r["asset"]["version"] = "1.0"; }, "asset.version: is '1.0'", true},
        Damage{"NoAsset", [](json& r) { r.erase("asset"); }, "asset.version: is missing", true},
        Damage{"RequiredExtensions",
               [](json& r) {
                 r["extensionsRequired"] = {"KHR_draco_mesh_compression", "KHR_texture_transform", "X\n"};
               },
               "extensionsRequired: KHR_draco_mesh_compression, X\\x0a cannot be read", true},
        Damage{"NothingToDraw", [](json& r) { r["scenes"][0]["nodes"] = json::array(); }, "the model has no triangle",
               true},
        Damage{"NoBuffers",
               [](json& r) {
                 r.erase("buffers");
                 r["extensionsRequired"] = {"KHR_texture_basisu"};
               },
               "accessors: 0 does not hold what is needed of it, what uses it is left out (and 2 more) (no triangle",
               true},
        Damage{"NodesOfAWrongType",
               [](json& r) {
                 r["nodes"] = {1, 2};
               },
               "nodes: 0 (`nodes' does not contain an JSON object.) cannot be read", true},
        Damage{"DeepExtras",
               [](json& r) {
                 json deep = 1;
                 for (int i = 0; i < 70; ++i) {
                   deep = json::array({deep});
                 }
                 r["extras"] = deep;
               },
               "json: has more than 64 levels", true},
        Damage{"LevelsWithinTexts",
               [](json& r) {
                 r["extras"] = std::string(70, '[') + '"' + std::string(70, '{');
                 r["nodes"][0]["children"] = {7};
               },
               "node 7 is not there"}),
    [](const auto& info) { return info.param.name; });

TEST_F(GltfLoader, NodesInACircleAreDrawnOnce) {
  MadeGltf made;
  const int mesh = made.addTriangle();
  made.add("nodes", {{"mesh", mesh}, {"children", {1, 1}}, {"translation", {1, 0, 0}}});
  made.add("nodes", {{"mesh", mesh}, {"children", {0}}});
  made.add("scenes", {{"nodes", {0}}});
  const Mesh drawn = meshOf(made);
  EXPECT_EQ(drawn.indices.size(), 6u);
  EXPECT_TRUE(contains(drawn.defects.at(0),
                       "nodes: node 0 is not there, or has two parents, it is left out here (and 1 more)"));
}

TEST_F(GltfLoader, SmallFilesDrawTheirMeshesNotWithoutEnd) {
  MadeGltf made;
  std::vector<float> numbers;
  for (int i = 0; i < 3000; ++i) {
    numbers.insert(numbers.end(), triangleNumbers.begin(), triangleNumbers.end());
  }
  const int mesh = made.addMesh({{"POSITION", made.addNumbers(numbers, "VEC3")}});
  for (int i = 0; i < 1000; ++i) {
    made.add("nodes", {{"mesh", mesh}});
  }
  const Mesh drawn = meshOf(made);
  EXPECT_GT(drawn.indices.size(), 1'000'000u);
  EXPECT_LT(drawn.indices.size(), 3'000'000u);
  EXPECT_TRUE(
      contains(drawn.defects.at(0), "mesh 0 has, as often as it is drawn, too many vertices for a file of this size"));
}

// Exporters put all vertices of a model into one buffer, of which each primitive names its own.
TEST_F(GltfLoader, PrimitivesMayShareAllVertices) {
  constexpr int count = 3000;
  MadeGltf made;
  std::vector<float> numbers;
  std::vector<float> normals;
  for (int i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    numbers.insert(numbers.end(), {x, 0, 0, x + 1, 0, 0, x, 1, 0});
    normals.insert(normals.end(), {0, 0, 1, 0, 0, 1, 0, 0.6f, 0.8f});
  }
  const json attributes = {{"POSITION", made.addNumbers(numbers, "VEC3")},
                           {"NORMAL", made.addNumbers(normals, "VEC3")}};
  const int mesh = made.add("meshes", {{"primitives", json::array()}});
  std::vector<glm::dvec3> expected;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t first = 3 * (count - 1 - i);
    made.root["meshes"][mesh]["primitives"].push_back(
        {{"attributes", attributes}, {"indices", made.addNumbers<uint32_t>({first + 2, first, first + 1}, "SCALAR")}});
    for (const uint32_t vertex : {first + 2, first, first + 1}) {
      expected.emplace_back(glm::make_vec3(&numbers[size_t{3} * vertex]));
    }
  }
  made.add("nodes", {{"mesh", mesh}});
  const Mesh drawn = meshOf(made);
  EXPECT_EQ(warnings(), "");
  EXPECT_EQ(drawn.vertices.size(), expected.size());
  std::vector<glm::dvec3> actual = cornersOf(drawn);
  for (size_t i = 0; i < actual.size(); ++i) {
    const glm::dvec3 normal = actual[i].y > 0.5 ? glm::dvec3(0, 0.6f, 0.8f) : glm::dvec3(0, 0, 1);
    EXPECT_LE(glm::distance(drawn.vertices[drawn.indices[i]].normal, normal), 1e-6);
  }
  for (std::vector<glm::dvec3>* points : {&actual, &expected}) {  // triangles are sorted
    std::ranges::sort(*points, {}, [](const glm::dvec3& p) { return std::pair(std::round(p.x), std::round(p.y)); });
  }
  expectNear(actual, expected);
}

TEST_F(GltfLoader, OtherFilesAreNamed) {
  EXPECT_TRUE(contains(faultOf(""), "m.gltf:1: file: is empty"));
  EXPECT_TRUE(contains(faultOf("ply\nformat ascii"), "m.gltf:1: file: is a PLY file"));
  EXPECT_TRUE(contains(faultOf("version https://git-lfs.github.com/spec/v1\n"), "is a Git LFS pointer"));
  EXPECT_TRUE(contains(faultOf("{\"asset\":\n{\"version\" \"2.0\"}}"), "m.gltf:2: json: parse error at line 2"));
  EXPECT_TRUE(contains(faultOf("{\"asset\": 1e999}"), "m.gltf:1: json: number overflow"));
  EXPECT_TRUE(
      contains(faultOf("glTF" + MadeGltf::bytesOf<uint32_t>({1, 20, 0, 0}), "m.glb"), "m.glb:1: version: is 1"));
  EXPECT_TRUE(contains(faultOf("glTF", "m.glb"), "m.glb:1: file: ends within its header"));
  EXPECT_TRUE(contains(faultOf(std::string(200, '[')), "m.gltf:1: json: has more than 64 levels"));
  EXPECT_TRUE(contains(faultOf("PK\x03\x04" + std::string(200, '[')), "m.gltf:1: file: is a ZIP archive"));
  for (const std::string name : {"m.gltf", "m.glb"}) {
    for (const std::string before : {"", "# Blender\n\n", "mtllib a b.mtl\no Cube\n", "\xef\xbb\xbf"}) {
      EXPECT_TRUE(contains(faultOf(before + std::string(triangleObj), name.c_str()),
                           name + ":1: file: is a Wavefront OBJ file (let its name end with .obj)"));
    }
  }
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  EXPECT_TRUE(contains(messageOf<InputError>([&] { loadObj(folder_.write("m.obj", made.binary()), textures_); }),
                       "is a glTF file (let its name end with .glb)"));
  EXPECT_TRUE(contains(messageOf<InputError>([&] { loadObj(folder_.write("m.obj", made.text()), textures_); }),
                       "is a glTF file (let its name end with .gltf)"));
}

TEST_F(GltfLoader, LengthsThatAreWrongWarnAndDraw) {
  MadeGltf made;
  made.add("nodes", {{"mesh", made.addTriangle()}});
  const std::string right = made.binary();
  for (const auto& [content, isWhole] :
       {std::pair(right, true), std::pair(std::string(right).replace(8, 1, 1, '\1'), false),
        std::pair(right + std::string(4, '\0'), false), std::pair(right.substr(0, right.size() - 4), false),
        std::pair(std::string(right).replace(right.size() - 41, 1, 1, '\1'), false)}) {
    ModelDefects defects;
    const fs::path file = folder_.write("m.glb", content);
    GltfFile read(file, defects);
    EXPECT_EQ(defects.report().size(), isWhole ? 0u : 1u);
    if (!isWhole) {
      EXPECT_TRUE(contains(defects.report().at(0), "m.glb:1: file: is not as long as it says"));
    }
  }
}

TEST_F(GltfLoader, RefusalsBlameWhatLeavesTrianglesOut) {
  MadeGltf made;
  const int none = made.addNumbers<float>({0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
  made.addMesh({{"POSITION", none}, {"NORMAL", made.addNumbers<float>({0, 0, 1, 0, 0, 1}, "VEC2")}});
  made.add("nodes", {{"mesh", 0}});
  EXPECT_TRUE(contains(faultOf(made.text()), "m.gltf:1: meshes: the model has no triangle"));
  made.root["nodes"][0]["mesh"] = "0";
  EXPECT_TRUE(contains(faultOf(made.text()), "m.gltf:1: nodes: mesh of 0 is wrong"));
}

// Bytes of files with everything are changed, cut or repeated: the file is drawn, or refused in one line.
TEST_F(GltfLoader, RandomDamageIsDrawnOrRefused) {
  MadeGltf made;
  made.root["extensionsUsed"] = {"KHR_texture_transform", "KHR_lights_punctual"};
  made.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"color", {1, 1, 1}}}};
  made.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.5}, {"znear", 0.1}}}});
  writePng(folder_ / "t.png", testing_support::greyPicture(4, 2, 255));
  made.add("images", {{"bufferView", made.addView(readText(folder_ / "t.png"))}, {"mimeType", "image/png"}});
  made.add("textures", {{"source", 0}});
  made.add(
      "materials",
      {{"name", "m"},
       {"emissiveFactor", {1, 1, 1}},
       {"emissiveTexture", {{"index", 0}}},
       {"pbrMetallicRoughness",
        {{"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"rotation", 0.5}}}}}}}}}});
  const int positions = made.addNumbers(squareNumbers, "VEC3");
  const int indices = made.addView(MadeGltf::bytesOf<uint16_t>({1, 2}));
  const int values = made.addView(MadeGltf::bytesOf<float>({4, 0, 0, 0, 5, 6}));
  made.root["accessors"][positions]["sparse"] = {{"count", 2},
                                                 {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                                                 {"values", {{"bufferView", values}}}};
  made.addMesh({{"POSITION", positions},
                {"NORMAL", made.addNumbers(squareNumbers, "VEC3")},
                {"TEXCOORD_0", made.addNumbers<uint8_t>({0, 0, 255, 0, 0, 255, 255, 255}, "VEC2", true)}},
               {{"indices", made.addNumbers<uint8_t>({0, 1, 2, 3}, "SCALAR")}, {"mode", 5}, {"material", 0}});
  made.add("nodes", {{"mesh", 0}, {"children", {1, 2}}, {"scale", {-1, 1, 1}}});
  made.add("nodes", {{"camera", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}});
  made.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  made.add("scenes", {{"nodes", {0}}});
  std::mt19937 random(11);
  const auto below = [&](size_t count) { return std::uniform_int_distribution<size_t>(0, count - 1)(random); };
  int drawn = 0;
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string content = i % 2 ? made.text() : made.binary();
    for (size_t changes = 1 + below(3); changes > 0 && !content.empty(); --changes) {
      const size_t at = below(content.size());
      const size_t count = std::min(1 + below(20), content.size() - at);
      switch (below(5)) {
        case 0:
          content[at] = static_cast<char>(below(256));
          break;
        case 1:
          content[at] = static_cast<char>('0' + below(10));
          break;
        case 2:
          content.erase(at, count);
          break;
        case 3:
          content.insert(at, content.substr(at, count));
          break;
        default:
          if (below(10) == 0) {
            content.resize(at);
          }
      }
    }
    const fs::path file = folder_.write(i % 2 ? "m.gltf" : "m.glb", content);
    try {
      const Scene scene = loadScene(file);
      EXPECT_GE(scene.meshes[0].indices.size(), 3u);
      ++drawn;
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.ends_with(')') && message.find('\n') == std::string::npos) << message;
      ++refused;
    }
  }
  EXPECT_GT(drawn, 300);
  EXPECT_GT(refused, 300);
}

TEST(ModelFormats, AreKnownByTheirEndings) {
  for (const char* name : {"a.gltf", "a.GLTF", "a.glb", "a.GlB", "a.obj"}) {
    EXPECT_TRUE(isModelFile(name)) << name;
  }
  EXPECT_FALSE(isModelFile("a.fbx"));
  EXPECT_EQ(modelFormatNames(), "Wavefront OBJ or glTF 2.0");
  EXPECT_EQ(modelPatterns(), "*.obj *.OBJ *.gltf *.GLTF *.glb *.GLB");
}

}  // namespace
}  // namespace speculum
