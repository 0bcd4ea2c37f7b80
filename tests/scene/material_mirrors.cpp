// Mirrors that the materials of models make.
#include "scene/material_mirrors.hpp"

#include "geometry/polygon.hpp"
#include "scene/scene_state.hpp"
#include "scene/support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

const std::string mirrorMtl =
    "newmtl matt\nKd 0.5 0.5 0.5\nnewmtl mirror\nKd 0.125 0.25 0.375\nKs 0.875 0.75 0.625\nNs 900\nillum 3\n";
// Two squares beside each other, one of each material.
const std::string panesObj =
    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nusemtl matt\nf 1 2 3 4\nusemtl mirror\n"
    "f 2 5 6 3\n";

class MaterialMirrors : public testing::Test {
 protected:
  Scene load(const std::string& obj, const std::string& mtl = mirrorMtl, const std::string& keys = {}) {
    folder_.write("m.mtl", mtl);
    folder_.write("m.obj", obj);
    return loadScene(folder_.write("s.toml", usualCamera + "[[object]]\nname = 'hall'\nmodel = 'm.obj'\n" + keys));
  }

  LogCapture log_;
  TemporaryFolder folder_;
};

TEST_F(MaterialMirrors, IllumSpecularAndExponentSayMirror) {
  const auto makes = [&](const std::string& lines) {
    return !load(panesObj, "newmtl matt\nnewmtl mirror\n" + lines).materialMirrors.empty();
  };
  EXPECT_TRUE(makes("Ks 0.5 0.5 0.5\nNs 500\nillum 3\n"));
  EXPECT_TRUE(makes("Ks 0.9 0.4 0.1\nNs 1000\nillum 5\n"));
  EXPECT_FALSE(makes("Ks 0.9 0.9 0.9\nNs 1000\nillum 2\n"));
  EXPECT_FALSE(makes("Ks 0.9 0.9 0.9\nNs 1000\n"));
  EXPECT_FALSE(makes("Ks 0.49 0.49 0.49\nNs 1000\nillum 3\n"));
  EXPECT_FALSE(makes("Ks 0.9 0.9 0.9\nNs 499\nillum 3\n"));
  EXPECT_FALSE(makes("Ks 0.9 0.9 0.9\nNs 1000\nillum 4\nd 0.3\n")) << "glass";
  EXPECT_TRUE(makes("Kd 0.9 0.7 0.4\nPm 1\nPr 0.05\n"));
  EXPECT_FALSE(makes("Kd 0.9 0.7 0.4\nPm 1\nPr 0.06\n"));
  EXPECT_FALSE(makes("Kd 0.9 0.7 0.4\nPm 0.9\nPr 0\n"));
  EXPECT_FALSE(makes("Kd 0.9 0.7 0.4\nPm 1\nPr 0\nd 0.5\n"));
  for (const char* rough : {"Pm 0.1\nPr 0.25\n", "Pm 1\nPr 1\n", "Pr 0\n"}) {
    EXPECT_FALSE(makes(std::string("Ks 0.9\nNs 1000\nillum 3\n") + rough)) << "metal-roughness replaces Ks and Ns";
  }
  const Mirror gold = load(panesObj, "newmtl matt\nnewmtl mirror\nKd 0.75 0.5 0.25\nPm 1\nPr 0\n").mirror(0);
  EXPECT_NEAR(glm::distance(gold.reflectance, {0.75, 0.5, 0.25}), 0.0, 1e-12);
  EXPECT_EQ(gold.baseColor, glm::dvec3(0.0));
}

TEST_F(MaterialMirrors, FlatPartIsAPlanarMirrorAndTheRestAnObject) {
  const Scene scene = load(panesObj, mirrorMtl, "position = [10, 0, 0]\nscale = 2\n");
  ASSERT_EQ(scene.mirrorCount(), 1u);
  const Mirror& mirror = scene.mirror(0);
  EXPECT_EQ(mirror.name, "hall mirror");
  EXPECT_LT(glm::distance(mirror.reflectance, {0.875, 0.75, 0.625}), 1e-12);
  EXPECT_LT(glm::distance(mirror.baseColor, {0.125, 0.25, 0.375}), 1e-12);
  EXPECT_LT(glm::distance(mirror.backColor, {0.125, 0.25, 0.375}), 1e-12);
  const SceneState state = evaluate(scene, 0.0);
  ASSERT_EQ(state.mirrors.size(), 1u);
  EXPECT_NEAR(glm::distance(state.mirrors[0].normal, {0, 0, 1}), 0.0, 1e-12);
  EXPECT_NEAR(glm::distance(vertexMean(state.mirrors[0].polygon), {13, 1, 0}), 0.0, 1e-12);
  EXPECT_EQ(state.mirrors[0].polygon.size(), 4u);
  EXPECT_TRUE(state.mirrors[0].pieces.empty());
  ASSERT_EQ(state.instances.size(), 1u);
  const Mesh& rest = scene.meshes[state.instances[0].mesh];
  EXPECT_EQ(rest.indices.size(), 6u);
  EXPECT_EQ(rest.parts.at(0).material.name, "matt");
  EXPECT_EQ(rest.halfExtent, scene.meshes[0].halfExtent) << "the object's handles stay where they are";
  EXPECT_NE(log_.text().find("make 1 planar and 0 curved mirrors"), std::string::npos) << log_.text();
}

TEST_F(MaterialMirrors, FrontFollowsTheWinding) {
  for (const char* keys : {"scale = [-1, 1, 1]\n", "rotation = [0, 180, 0]\n", "scale = [1, -2, -1]\n"}) {
    const Scene scene = load(panesObj, mirrorMtl, keys);
    const SceneState state = evaluate(scene, 0.0);
    const Mesh& mesh = scene.meshes[0];
    const glm::dmat3& linear = state.instances[0].worldFromMesh.linear;
    const glm::dvec3 up = glm::normalize(glm::transpose(glm::inverse(linear)) * glm::dvec3(0, 0, 1));
    EXPECT_GT(glm::dot(up, state.mirrors.at(0).normal), 0.999) << keys << mesh.parts.size();
    EXPECT_GT(glm::dot(newellVector(state.mirrors[0].polygon), state.mirrors[0].normal), 0.0);
  }
}

// A frame of four rectangles: its hull has a hole. Two squares of one plane: their hull has a gap.
TEST_F(MaterialMirrors, PiecesOfOnePlaneAreOneMirror) {
  const Scene ring = load(
      "mtllib m.mtl\nv 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\nusemtl mirror\n"
      "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  ASSERT_EQ(ring.mirrorCount(), 1u);
  const MirrorState whole = evaluate(ring, 0.0).mirrors[0];
  EXPECT_NEAR(polygonArea(whole.polygon), 9.0, 1e-12);
  double area = 0.0;
  for (const auto& piece : whole.pieces) {
    area += polygonArea(piece);
  }
  EXPECT_NEAR(area, 8.0, 1e-12);
  const Scene squares = load(
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\nv 2 0 1\nv 3 0 1\n"
      "usemtl mirror\nf 1 2 3 4\nf 5 6 7 8\nf 5 6 10 9\n");
  ASSERT_EQ(squares.mirrorCount(), 2u) << "the third square lies in another plane";
  EXPECT_EQ(evaluate(squares, 0.0).mirrors[0].pieces.size(), 2u);
}

TEST_F(MaterialMirrors, SmoothPartsAreCurvedMirrors) {
  const Scene scene = load(
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.3\ns 1\nusemtl mirror\nf 1 2 3\nf 1 3 4\n"
      "usemtl matt\ns off\nf 4 3 2\n");
  EXPECT_EQ(scene.mirrorCount(), 0u);
  const SceneState state = evaluate(scene, 0.0);
  ASSERT_EQ(state.instances.size(), 2u);
  EXPECT_FALSE(curvedMirrorOf(scene, state.instances[0]));
  EXPECT_LT(glm::distance(curvedMirrorOf(scene, state.instances[1])->reflectance, {0.875, 0.75, 0.625}), 1e-12);
  EXPECT_TRUE(hasCurvedMirrors(scene));
}

// Files round normals to two decimals or to bytes; the square leans, so that rounding turns its normal.
TEST_F(MaterialMirrors, RoundedNormalsAreFlat) {
  const auto square = [](const std::string& normals) {
    return "mtllib m.mtl\nv 0 0 0\nv 1 0 0.3\nv 1 1 0.5\nv 0 1 0.2\n" + normals +
           "usemtl mirror\nf 1//1 2//2 3//3 4//4\n";
  };
  const auto planar = [&](const std::string& normals) { return load(square(normals)).mirrorCount(); };
  EXPECT_EQ(planar(repeated("vn -0.28 -0.19 0.94\n", 4)), 1u);
  EXPECT_EQ(planar(repeated("vn -36 -24 119\n", 4)), 1u) << "of bytes";
  EXPECT_EQ(planar(repeated("vn -0.31 -0.19 0.94\n", 4)), 0u) << "more than rounding turns it";
  EXPECT_EQ(planar(repeated("vn -0.28 -0.19 0.94\nvn -0.285 -0.185 0.94\n", 2)), 0u) << "it is shaded as a curve";
}

// Squares at distances of their own, each of a material of its own, which grow from the first to the last.
std::string squaresObj(int count, const char* materials = nullptr) {
  std::string obj = "mtllib m.mtl\n";
  for (int i = 0; i < count; ++i) {
    const std::string z = std::to_string(0.1 * i);
    const std::string side = std::to_string(1.0 + 0.01 * i);
    obj += "v 0 0 " + z + "\nv " + side + " 0 " + z + "\nv " + side + " " + side + " " + z + "\nv 0 " + side + " " + z;
    obj += "\nusemtl " + (materials ? std::string(materials) : "c" + std::to_string(i)) + "\nf -4 -3 -2 -1\n";
  }
  return obj;
}

std::string mirrorMaterials(int count) {
  std::string mtl = mirrorMtl;
  for (int i = 0; i < count; ++i) {
    mtl += "newmtl c" + std::to_string(i) + "\nPm 1\nPr 0\nKd 0.9\n";
  }
  return mtl;
}

TEST_F(MaterialMirrors, LargestPlanesOfTheModelCount) {
  for (const char* material : {"mirror", static_cast<const char*>(nullptr)}) {
    const Scene scene = load(squaresObj(40, material), mirrorMaterials(40));
    ASSERT_EQ(scene.mirrorCount(), 32u);
    const SceneState state = evaluate(scene, 0.0);
    for (const MirrorState& mirror : state.mirrors) {
      EXPECT_GT(polygonArea(mirror.polygon), 1.07 * 1.07) << "eight smaller ones are curved mirrors";
    }
    size_t triangles = 0;
    for (const InstanceState& instance : state.instances) {
      triangles += curvedMirrorOf(scene, instance) ? scene.meshes[instance.mesh].indices.size() / 3 : 0;
    }
    EXPECT_EQ(triangles, 16u);
  }
  EXPECT_FALSE(contains(log_.text(), "warning")) << log_.text();
}

TEST_F(MaterialMirrors, MaterialsBeyondTheLimitAreWarnedAbout) {
  const Scene scene = load(squaresObj(260), mirrorMaterials(260));
  EXPECT_EQ(scene.mirrorCount(), 32u);
  const SceneState state = evaluate(scene, 0.0);
  EXPECT_EQ(scene.meshes[state.instances.at(0).mesh].indices.size(), 4u * 6u) << "four are surfaces";
  EXPECT_EQ(state.instances.size(), 1u + 256u - 32u);
  EXPECT_TRUE(contains(log_.text(), "m.obj:1: materials: 260 say mirror, the first 256 make mirrors")) << log_.text();
  EXPECT_EQ(scene.meshes[0].defects.size(), 1u);
}

TEST_F(MaterialMirrors, FlatPartsAreCurvedMirrorsWherePlanarOnesCannotBe) {
  for (const char* keys : {"visible = 'eye'\n", "copies = { count = 1001, step = [3, 0, 0] }\n",
                           "copies = { count = 10001, step = [3, 0, 0] }\n"}) {
    const Scene scene = load(panesObj, mirrorMtl, keys);
    EXPECT_EQ(scene.mirrorCount(), 0u) << keys;
    EXPECT_TRUE(hasCurvedMirrors(scene)) << keys;
    EXPECT_EQ(contains(log_.text(), "its planar mirrors of object 'hall' become curved"), keys[0] == 'c') << keys;
  }
  const Scene copies = load(panesObj, mirrorMtl, "copies = { count = 3, step = [0, 5, 0] }\nspin = [0, 90, 0]\n");
  EXPECT_EQ(copies.mirrorCount(), 3u);
  EXPECT_EQ(copies.mirror(2).name, "hall mirror 2");
  const SceneState state = evaluate(copies, 1.0);
  EXPECT_NEAR(glm::distance(vertexMean(state.mirrors[2].polygon), {0, 10.5, -1.5}), 0.0, 1e-12);
  EXPECT_TRUE(spins(copies.mirror(0)));
}

TEST_F(MaterialMirrors, AreLeftOutOnDemand) {
  for (const char* keys :
       {"mirrors_from_materials = false\n", "mirror = {}\n", "copies = { count = 70000, step = [3, 0, 0] }\n"}) {
    const Scene scene = load(panesObj, mirrorMtl, keys);
    const SceneState state = evaluate(scene, 0.0);
    EXPECT_EQ(scene.mirrorCount(), 0u) << keys;
    EXPECT_EQ(state.instances.at(0).mesh, 0) << keys;
    EXPECT_EQ(hasCurvedMirrors(scene), scene.objects[0].mirror.has_value()) << keys;
    EXPECT_EQ(log_.text().find("planar"), std::string::npos) << keys;
    EXPECT_TRUE(scene.meshes[0].defects.empty()) << "the model is as it should be: " << keys;
  }
  EXPECT_TRUE(contains(log_.text(), "its materials make no mirrors of object 'hall', which is too large"))
      << log_.text();
}

TEST_F(MaterialMirrors, ObjectsColorsReplaceThoseOfTheMaterial) {
  const Scene scene = load(panesObj, mirrorMtl, "specular = [0.5, 2, 0.5]\ncolor = [0.3, 0.3, 0.3]\n");
  EXPECT_EQ(scene.mirror(0).reflectance, glm::dvec3(0.5, 1.0, 0.5));
  EXPECT_EQ(scene.mirror(0).baseColor, glm::dvec3(0.3));
}

}  // namespace
}  // namespace speculum
