// Hard cases of input: unusable shapes are rejected by name, or dropped with a warning.
#include "geometry/affine.hpp"
#include "scene/obj_support.hpp"
#include "scene_text.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::text;
using Polygon = std::vector<glm::dvec3>;

std::string faultOf(const std::string& text) {
  return sceneFaultOf(usualCamera + text);
}

std::string mirrorFault(const Polygon& polygon) {
  return faultOf("[[mirror]]\n" + testing_support::polygonText(polygon));
}

void expectRejected(const std::string& text, const std::string& says) {
  EXPECT_TRUE(contains(faultOf(text), says));
}

TEST(RejectedShapes, ZeroScaleIsNamed) {
  const std::string object = "[[object]]\nmodel = \"triangle.obj\"\nscale = ";
  expectRejected(object + "0\n", "scale: is zero along an axis");
  expectRejected(object + "[1, 0, 1]\n", "scale: is zero along an axis");
  expectRejected(object + "[1, -0.0, 1]\n", "scale: is zero along an axis");
  EXPECT_EQ(faultOf(object + "[1, -1e-20, 1e13]\n"), "nothing was thrown");
}

TEST(RejectedShapes, MirrorsWithoutAreaAreNamed) {
  expectRejected("[[mirror]]\nsize = [0, 1]\n", "size[0]: is 0");
  expectRejected("[[mirror]]\nsize = [1, 1e-9]\n", "size: has no area");
  EXPECT_TRUE(contains(mirrorFault({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}), "polygon: has no area"));
  EXPECT_TRUE(contains(mirrorFault({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}), "polygon: has no area"));
}

// Tests mirrors of diameter 2 and area h: the limit is h = 4e-8.
TEST(RejectedShapes, AreaLimitIsThatOfTheDiameter) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto triangle = [&](double h) { return Polygon{{0, 0, 0}, {2 * unit, 0, 0}, {unit, h * unit, 0}}; };
    EXPECT_TRUE(contains(mirrorFault(triangle(3.9e-8)), "has no area")) << unit;
    EXPECT_EQ(mirrorFault(triangle(4.1e-8)), "nothing was thrown") << unit;
  }
}

// Lifts one vertex off a square of diameter sqrt(2); the mean plane takes a quarter of the height.
TEST(RejectedShapes, NonPlanarMirrorsAreNamed) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto square = [&](double lift) {
      return Polygon{{0, 0, 0}, {unit, 0, 0}, {unit, unit, lift * unit}, {0, unit, 0}};
    };
    EXPECT_TRUE(contains(mirrorFault(square(1e-3)), "is not planar")) << unit;
    EXPECT_EQ(mirrorFault(square(1e-5)), "nothing was thrown") << unit;
  }
}

class SliverTriangles : public ObjTest {
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
};

TEST_F(SliverTriangles, AreReportedBelow1e5) {
  EXPECT_EQ(load(sliver(1.1e-5)).indices.size(), 3u);
  EXPECT_EQ(warnings(), "");
  const Mesh mesh = load(sliver(0.9e-5));
  ASSERT_EQ(mesh.indices.size(), 3u);
  EXPECT_TRUE(contains(warnings(), "m.obj:4: f: a face is a sliver, its normal is inexact\n"));
  EXPECT_LT(degreesOff(mesh.vertices[0].normal), 0.01);
}

TEST_F(SliverTriangles, AreDroppedBelow1e10) {
  EXPECT_EQ(load(sliver(1.1e-10)).indices.size(), 3u);
  EXPECT_EQ(load(sliver(0.9e-10) + "v 5 5 5\nv 6 5 5\nv 5 6 5\nf 4 5 6\n").indices.size(), 3u);
}

}  // namespace
}  // namespace speculum
