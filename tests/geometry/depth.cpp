#include "geometry/projection.hpp"
#include "random.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

constexpr glm::dvec2 picture(640, 360);
const Projection projection(glm::radians(60.0), picture.x / picture.y, 0.001);
constexpr double distance = 50.0;  // metres

// Plane of a mirror met at 45 degrees, seen by a reflected eye `h` behind it.
glm::dvec4 mirrorPlane(double h) {
  return {std::sqrt(0.5), 0.0, -std::sqrt(0.5), -h};
}

DepthResolution common(double angleDegrees, double extent, double t = distance) {
  const double a = glm::radians(angleDegrees);
  return depthResolution({.projection = projection, .pictureSize = picture},
                         {{0.0, 0.0, -t}, {0.0, std::sin(a), std::cos(a)}, extent});
}

DepthResolution oblique(double h) {
  return depthResolution({.projection = projection, .plane = mirrorPlane(h), .pictureSize = picture},
                         {{0.0, 0.0, -distance}, {0.0, 0.0, 1.0}, 1.0});
}

void expectBetween(const std::optional<double>& value, double low, double high) {
  ASSERT_TRUE(value);
  EXPECT_GE(*value, low);
  EXPECT_LE(*value, high);
}

// Gaps that a renderer kept in order 50 m away, near which each bound must lie.
TEST(DepthResolution, ReversedDepthMatchesMeasurement) {
  constexpr double measured = 7.5e-6;  // metres
  expectBetween(common(0.0, 1.0).storage, measured / 2, measured * 2);
  expectBetween(common(0.0, 1.0).rounded, measured, measured * 4);
}

TEST(DepthResolution, ObliqueDepthMatchesMeasurement) {
  constexpr std::array<std::pair<double, double>, 4> measured = {{{1, 3e-4}, {0.1, 3e-3}, {0.01, 3e-2}, {1e-4, 4}}};
  for (const auto& [h, gap] : measured) {
    SCOPED_TRACE(h);
    expectBetween(oblique(h).storage, gap / 2, gap * 2);
    EXPECT_GE(oblique(h).rounded, gap);
    if (h > 1e-3) {
      EXPECT_LE(oblique(h).rounded, gap * 10) << "a bound adds up what seldom comes together";
    }
  }
  EXPECT_FALSE(oblique(1e-6).storage);
  EXPECT_FALSE(oblique(1e-6).rounded);
  EXPECT_FALSE(oblique(1e-6).snapped);
}

TEST(DepthResolution, GrazingSurfacesMatchMeasurement) {
  constexpr std::array<std::pair<double, double>, 3> measured = {{{60, 1e-6}, {89, 1e-5}, {89.9, 1e-4}}};
  for (const auto& [angle, relative] : measured) {
    SCOPED_TRACE(angle);
    const double gap = relative * distance;
    expectBetween(common(angle, 10.0).rounded, gap / 2, gap * 4);
  }
}

TEST(DepthResolution, ResolutionIsRelativeToDistance) {
  for (double t = 0.01; t < 1e7; t *= 1.7) {
    const DepthResolution resolution = common(0.0, 0.0, t);
    expectBetween(resolution.storage, std::ldexp(t, -24), std::ldexp(t, -23) * 1.001);
    EXPECT_GT(resolution.rounded, resolution.storage);
    EXPECT_GE(resolution.snapped, resolution.rounded);
  }
}

TEST(DepthResolution, SnappingMattersForSlopesOnly) {
  EXPECT_DOUBLE_EQ(*common(0.0, 1.0).snapped, *common(0.0, 1.0).rounded);
  // A 512th of a pixel, twice, on a slope of 45 degrees: the pixel's angle times the distance.
  const double pixel = 2.0 / (projection.focal * picture.y) * distance;
  EXPECT_NEAR(*common(45.0, 1.0).snapped - *common(45.0, 1.0).rounded, 2.0 * pixel / 512.0, 1e-6);
}

TEST(DepthResolution, NothingWithoutAProjectionOrAnEdge) {
  EXPECT_FALSE(oblique(-1.0).storage) << "the eye on the kept side";
  const DepthProjection view{.projection = projection, .pictureSize = picture};
  EXPECT_FALSE(depthResolution(view, {{0, 0, 5}, {0, 0, 1}, 1}).snapped) << "behind the eye";
  EXPECT_FALSE(depthResolution(view, {{0, 0, -5}, {0, 1, 0}, 1}).snapped) << "seen edge-on";
  EXPECT_FALSE(depthResolution(view, {{0, 0, -1e-4}, {0, 0, 1}, 0}).snapped) << "clamped";
}

// A triangle of a mesh.
struct Triangle {
  glm::dvec3 center;                  // of its mesh
  std::array<glm::dvec3, 3> corners;  // relative to it
};

testing_support::Random numbers(1);

glm::dvec3 turned(const glm::dvec3& normal, double length) {
  const glm::dvec3 side = glm::normalize(glm::cross(normal, glm::dvec3(0.36, 0.48, 0.8)));
  const double angle = numbers.uniform(0.0, 6.283185307179586);
  return length * (std::cos(angle) * side + std::sin(angle) * glm::cross(normal, side));
}

// Depth at a pixel by a rasteriser with floats that snaps vertices to 1/256 pixel.
float pixelDepth(const Triangle& triangle, const glm::dmat4& clipFromView, const glm::dvec2& pixel) {
  glm::dmat4 clipFromMesh = clipFromView;
  clipFromMesh[3] = clipFromView * glm::dvec4(triangle.center, 1.0);
  const glm::mat4 m(clipFromMesh);
  std::array<glm::dvec2, 3> window;
  std::array<double, 3> depth{};
  for (int i = 0; i < 3; ++i) {
    const glm::vec4 clip = m * glm::vec4(glm::vec3(triangle.corners[i]), 1.0f);
    const float inverse = 1.0f / clip.w;
    const glm::vec2 half = glm::vec2(picture) * 0.5f;
    window[i] = glm::round(glm::dvec2(glm::vec2(clip) * inverse * half + half) * 256.0) / 256.0;
    depth[i] = clip.z * inverse;
  }
  const glm::dvec2 a = window[1] - window[0];
  const glm::dvec2 b = window[2] - window[0];
  const glm::dvec2 p = pixel - window[0];
  const double area = a.x * b.y - a.y * b.x;
  const double u = (p.x * b.y - p.y * b.x) / area;
  const double v = (a.x * p.y - a.y * p.x) / area;
  return static_cast<float>(depth[0] + u * (depth[1] - depth[0]) + v * (depth[2] - depth[0]));
}

// A triangle of random size around a point of the plane, in a mesh whose centre is up to `extent` away.
Triangle triangleAt(const glm::dvec3& point, const glm::dvec3& normal, double extent) {
  const double size = std::pow(10.0, numbers.uniform(-2.0, 0.0)) * std::min(extent, -0.3 * point.z);
  const glm::dvec3 first = turned(normal, size);
  const glm::dvec3 second = glm::cross(normal, first);
  Triangle triangle{.center = point + turned(normal, numbers.uniform(0.0, std::max(extent - 2.0 * size, 0.0)))};
  const glm::dvec3 middle = point - triangle.center;
  triangle.corners = {middle + first, middle - 0.5 * first + 0.9 * second, middle - 0.5 * first - 0.9 * second};
  return triangle;
}

// A view and a surface anywhere in it.
struct Setting {
  DepthProjection view{.projection = projection, .pictureSize = picture};
  glm::dmat4 clipFromView = projection.matrix();
  glm::dvec2 pixel{0.0};
  glm::dvec3 ray{0.0};
  DepthSurface surface;
};

Setting randomSetting(bool withPlane) {
  Setting setting;
  setting.pixel = glm::floor(glm::dvec2(numbers.uniform(0.0, picture.x), numbers.uniform(0.0, picture.y))) + 0.5;
  const glm::dvec2 ndc = 2.0 * setting.pixel / picture - 1.0;
  setting.ray =
      glm::normalize(glm::dvec3(ndc.x * projection.aspect / projection.focal, -ndc.y / projection.focal, -1.0));
  const double t = std::pow(10.0, numbers.uniform(0.0, 4.0));
  const double angle = glm::radians(numbers.uniform(0.0, 80.0));
  const glm::dvec3 normal = std::cos(angle) * -setting.ray + turned(-setting.ray, std::sin(angle));
  setting.surface = {t * setting.ray, normal, t * std::pow(10.0, numbers.uniform(-2.0, 1.0))};
  if (withPlane) {
    setting.view.plane = mirrorPlane(std::pow(10.0, numbers.uniform(-3.0, 1.0)));
    setting.clipFromView = *obliqueProjection(projection, *setting.view.plane);
  }
  return setting;
}

struct Trial {
  int inOrder = 0;
  int outOfOrder = 0;
};

// Counts random pairs of surfaces, `part` of the bound apart, by the order of their depths.
Trial trials(bool withPlane, double part) {
  Trial trial;
  for (int i = 0; i < 20000; ++i) {
    const Setting setting = randomSetting(withPlane);
    const auto& [point, normal, extent] = setting.surface;
    const std::optional<double> gap = depthResolution(setting.view, setting.surface).snapped;
    if (!gap || *gap > 0.1 * glm::length(point)) {
      continue;
    }
    const glm::dvec3 behind = point + part * *gap * setting.ray;
    const float nearer = pixelDepth(triangleAt(point, normal, extent), setting.clipFromView, setting.pixel);
    const float farther = pixelDepth(triangleAt(behind, normal, extent), setting.clipFromView, setting.pixel);
    ++(nearer > farther ? trial.inOrder : trial.outOfOrder);
  }
  return trial;
}

TEST(DepthResolution, KeepsRandomSurfacesInOrder) {
  for (const bool plane : {false, true}) {
    SCOPED_TRACE(plane ? "oblique" : "common");
    const Trial kept = trials(plane, 1.0);
    EXPECT_GT(kept.inOrder, 5000) << "too few to judge by";
    EXPECT_EQ(kept.outOfOrder, 0);
    const Trial lost = trials(plane, 0.01);
    EXPECT_GT(lost.outOfOrder, lost.inOrder / 10) << "a hundredth of the gap should fail";
  }
}

}  // namespace
}  // namespace speculum
