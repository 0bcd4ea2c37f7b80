// Hard cases of input: unusable shapes are rejected by name, or dropped with a warning.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/affine.hpp"
#include "geometry/polygon.hpp"
#include "naive_arithmetic.hpp"
#include "platform/process.hpp"
#include "scene_support.hpp"
#include "scene_text.hpp"
#include "test_paths.hpp"

namespace speculum {
namespace {

using testing_support::text;
using Polygon = std::vector<glm::dvec3>;

class RejectedShapes : public testing::Test {
 protected:
  std::string message(const std::string& rest) {
    const std::filesystem::path file =
        folder_.write("scene.toml", "[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\n" + rest);
    folder_.write("t.obj", kTriangleObj);
    return inputErrorOf([&] { loadScene(file); });
  }
  std::string mirrorMessage(const Polygon& polygon) {
    return message("[[mirror]]\n" + testing_support::polygonText(polygon));
  }
  void expectRejected(const std::string& rest, const std::string& says) {
    const std::string text = message(rest);
    EXPECT_NE(text.find("scene.toml:"), std::string::npos) << text;
    EXPECT_NE(text.find(says), std::string::npos) << text;
  }

  TemporaryFolder folder_;
};

TEST_F(RejectedShapes, ZeroScaleIsNamed) {
  const std::string object = "[[object]]\nmodel = \"t.obj\"\nscale = ";
  expectRejected(object + "0\n", "scale: is zero along an axis");
  expectRejected(object + "[1, 0, 1]\n", "scale: is zero along an axis");
  expectRejected(object + "[1, -0.0, 1]\n", "scale: is zero along an axis");
  EXPECT_EQ(message(object + "[1, -1e-20, 1e13]\n"), "no InputError was thrown");
  // Such a scale has no inverse: normals carried by it are not numbers.
  const glm::dmat3 flat(1, 0, 0, 0, 0, 0, 0, 0, 1);
  EXPECT_FALSE(std::isfinite((hard_cases::naiveInverseTranspose(flat) * glm::dvec3(0, 1, 1)).y))
      << "the naive way should fail";
}

TEST_F(RejectedShapes, MirrorsWithoutAreaAreNamed) {
  expectRejected("[[mirror]]\nsize = [0, 1]\n", "size[0]: is 0");
  expectRejected("[[mirror]]\nsize = [1, 1e-9]\n", "size: has no area");
  EXPECT_NE(mirrorMessage({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}).find("polygon: has no area"), std::string::npos);
  EXPECT_NE(mirrorMessage({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}).find("polygon: has no area"), std::string::npos);
  const glm::dvec3 naive = hard_cases::naiveNormalize(newellVector(Polygon{{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}));
  EXPECT_TRUE(std::isnan(naive.x)) << "the naive way should fail";
}

// Tests mirrors of diameter 2 and area h: the limit is h = 4e-8.
TEST_F(RejectedShapes, AreaLimitIsThatOfTheDiameter) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto triangle = [&](double h) { return Polygon{{0, 0, 0}, {2 * unit, 0, 0}, {unit, h * unit, 0}}; };
    EXPECT_NE(mirrorMessage(triangle(3.9e-8)).find("has no area"), std::string::npos) << unit;
    EXPECT_EQ(mirrorMessage(triangle(4.1e-8)), "no InputError was thrown") << unit;
  }
}

// Lifts one vertex off a square of diameter sqrt(2); the mean plane takes a quarter of the height.
TEST_F(RejectedShapes, NonPlanarMirrorsAreNamed) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto square = [&](double lift) {
      return Polygon{{0, 0, 0}, {unit, 0, 0}, {unit, unit, lift * unit}, {0, unit, 0}};
    };
    EXPECT_NE(mirrorMessage(square(1e-3)).find("is not planar"), std::string::npos) << unit;
    EXPECT_EQ(mirrorMessage(square(1e-5)), "no InputError was thrown") << unit;
  }
}

TEST_F(RejectedShapes, ProgramExitsWithTwoAndOneLine) {
  const std::filesystem::path file = folder_.write(
      "flat.toml",
      "[camera]\nposition = [0, 0, 3]\ntarget = [0, 0, 0]\n[[mirror]]\nname = \"flat one\"\nsize = [1, 1e-9]\n");
  const ProcessResult result = runProcess(
      {binaryDir().string() + "/speculum", "render", "--scene", file.string(), "--out", (folder_ / "x.png").string()});
  EXPECT_EQ(result.exitCode, 2) << result.output;
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  EXPECT_NE(result.output.find("flat.toml:6: mirror[flat one].size: has no area"), std::string::npos) << result.output;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.png"));
}

class SliverTriangles : public testing::Test {
 protected:
  // Returns a triangle of quality q = 2 area / longest edge^2 and a size of 1 m, in a plane that is parallel to no
  // axis.
  static std::string sliver(double q) {
    const glm::dmat3 turn = rotationFromDegrees({20, 30, 40});
    std::string obj;
    for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0.5, q, 0)}) {
      const glm::dvec3 v = turn * p + glm::dvec3(0.3, 0.7, 0.2);
      obj += "v " + text(v.x) + " " + text(v.y) + " " + text(v.z) + "\n";
    }
    return obj + "f 1 2 3\n";
  }
  static double degreesOff(const glm::dvec3& n) {
    const glm::dvec3 exact = rotationFromDegrees({20, 30, 40})[2];
    return std::isfinite(n.x) ? glm::degrees(std::atan2(glm::length(glm::cross(n, exact)), glm::dot(n, exact))) : 180.0;
  }
  Mesh load(const std::string& obj) { return loadObj(folder_.write("m.obj", obj), textures_); }

  TemporaryFolder folder_;
  std::vector<Texture> textures_;
  LogCapture log_;
};

TEST_F(SliverTriangles, AreReportedBelow1e5) {
  EXPECT_EQ(load(sliver(1.1e-5)).indices.size(), 3u);
  EXPECT_EQ(log_.text(), "");
  const Mesh mesh = load(sliver(0.9e-5));
  ASSERT_EQ(mesh.indices.size(), 3u);
  EXPECT_NE(log_.text().find("1 triangles are slivers"), std::string::npos) << log_.text();
  EXPECT_LT(degreesOff(mesh.vertices[0].normal), 0.01);
}

TEST_F(SliverTriangles, AreDroppedBelow1e10) {
  EXPECT_EQ(load(sliver(1.1e-10)).indices.size(), 3u);
  EXPECT_EQ(load(sliver(0.9e-10) + "v 5 5 5\nv 6 5 5\nv 5 6 5\nf 4 5 6\n").indices.size(), 3u);
  EXPECT_NE(log_.text().find("dropped 1 degenerate triangles"), std::string::npos) << log_.text();
}

TEST_F(SliverTriangles, HaveWildFloatNormals) {
  const Mesh mesh = load(sliver(1e-7));
  const auto corner = [&](int i) { return glm::vec3(mesh.center + mesh.vertices[mesh.indices[i]].position); };
  const glm::vec3 naive = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
  EXPECT_GT(degreesOff(glm::dvec3(naive)), 5.0) << "the naive way should fail";
  EXPECT_LT(degreesOff(mesh.vertices[0].normal), 1e-4) << "in double there is no trouble yet";
}

}  // namespace
}  // namespace speculum
