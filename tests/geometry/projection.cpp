#include <rapidcheck.h>

#include "geometry/projection.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

const Projection wide(glm::radians(60.0), 16.0 / 9.0, 0.001);

glm::dvec3 toNdc(const glm::dvec4& clip) {
  return glm::dvec3(clip) / clip.w;
}

TEST(Projection, MatrixAndFunctionAgree) {
  const glm::dvec3 p(0.3, -0.7, -2.5);
  EXPECT_EQ(wide.matrix() * glm::dvec4(p, 1.0), wide.clip(p));
}

TEST(Projection, TopOfViewIsFirstRow) {
  const double y = 2.0 * std::tan(glm::radians(30.0));
  EXPECT_NEAR(toNdc(wide.clip({0.0, y, -2.0})).y, -1.0, 1e-15);
}

TEST(Projection, ObliqueDepthIsOneAtThePlane) {
  // A floor 1 m below a reflected eye that looks down at it: kept is what lies below the floor's image.
  const glm::dvec4 plane(0.0, glm::normalize(glm::dvec2(1.0, -1.0)).x, glm::normalize(glm::dvec2(1.0, -1.0)).y, -1.0);
  const auto oblique = obliqueProjection(wide, plane);
  ASSERT_TRUE(oblique);
  const glm::dvec3 normal(plane);
  const glm::dvec3 onPlane = normal * 1.0 + glm::dvec3(0.2, 0, 0);
  const glm::dvec4 at = *oblique * glm::dvec4(onPlane, 1.0);
  EXPECT_NEAR(at.z, at.w, 1e-12);
  const glm::dvec4 behind = *oblique * glm::dvec4(onPlane - 0.01 * normal, 1.0);
  EXPECT_GT(behind.z, behind.w);
  const glm::dvec4 front = *oblique * glm::dvec4(onPlane + 0.01 * normal, 1.0);
  EXPECT_LT(front.z, front.w);
}

TEST(ScreenRect, RoundsOutwardsAndPads) {
  const std::vector<glm::dvec4> clip = {{-0.5, -0.5, 0, 1}, {0.5, -0.5, 0, 1}, {0.5, 0.5, 0, 1}, {-0.5, 0.5, 0, 1}};
  EXPECT_EQ(screenRect(clip, 100, 100, {0, 0, 100, 100}), (PixelRect{24, 24, 52, 52}));
  EXPECT_EQ(screenRect(clip, 100, 100, {50, 0, 50, 100}), (PixelRect{50, 24, 26, 52}));
  EXPECT_DOUBLE_EQ(screenArea(clip, 100, 100), 2500.0);
}

TEST(ScreenRect, IsEverythingAtTheEyesPlane) {
  const std::vector<glm::dvec4> clip = {{0, 0, 0, 1}, {1e-14, 0, 0, 1e-13}, {0, 0.5, 0, 1}};
  EXPECT_EQ(screenRect(clip, 64, 32, {0, 0, 64, 32}), (PixelRect{0, 0, 64, 32}));
}

TEST(ScreenRect, IsEmptyWithoutVertices) {
  EXPECT_TRUE(screenRect({}, 64, 32, {0, 0, 64, 32}).empty());
  EXPECT_EQ(screenArea({}, 64, 32), 0.0);
}

// Distance in pixels from the line through two corners of a polygon; positive on the side of `inside`.
double distanceFromEdge(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& inside) {
  const glm::dvec2 across = glm::normalize(glm::dvec2(b.y - a.y, a.x - b.x));
  return glm::dot(across, p - a) * (glm::dot(across, inside - a) < 0.0 ? -1.0 : 1.0);
}

TEST(Grown, MovesEdgesByPixelsAndKeepsDepth) {
  constexpr glm::dvec2 half(320.0, 180.0);
  EXPECT_TRUE(rc::check("edges of a quadrangle", [&] {
    const auto number = [](double low, double high) {
      return low + (high - low) * *rc::gen::inRange(0, 10001) / 10000.0;
    };
    const bool turned = *rc::gen::arbitrary<bool>();
    std::vector<glm::dvec4> clip;
    for (const glm::dvec2& corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
      const double w = std::pow(10.0, number(-6, 6));
      const glm::dvec2 p = corner * glm::dvec2(number(0.5, 1.0), number(0.5, 1.0));
      clip.emplace_back(p * w, 0.001, w);
    }
    if (turned) {
      std::ranges::reverse(clip);
    }
    const std::vector<glm::dvec4> moved = grown(clip, 640, 360, 0.01);
    RC_ASSERT(moved.size() == clip.size());
    const auto pixel = [&](const glm::dvec4& v) { return glm::dvec2(v) / v.w * half; };
    for (size_t i = 0; i < clip.size(); ++i) {
      const size_t next = (i + 1) % clip.size();
      RC_ASSERT(moved[i].w == clip[i].w);
      RC_ASSERT(moved[i].z == clip[i].z);
      for (const size_t end : {i, next}) {
        const double off = distanceFromEdge(pixel(moved[end]), pixel(clip[i]), pixel(clip[next]), glm::dvec2(0.0));
        RC_ASSERT(std::abs(off + 0.01) < 1e-9);
      }
    }
  }));
}

TEST(Grown, AcuteCornersAndRepeatedOnesStayNear) {
  const std::vector<glm::dvec4> needle = {{-1, 0, 1, 1}, {1, 1e-4, 1, 1}, {1, 1e-4, 1, 1}, {1, -1e-4, 1, 1}};
  const std::vector<glm::dvec4> moved = grown(needle, 200, 200, 0.01);
  for (size_t i = 0; i < needle.size(); ++i) {
    EXPECT_LT(100.0 * glm::length(moved[i] - needle[i]), 0.03) << i;
  }
  EXPECT_LT(moved[3].y, needle[3].y);
  EXPECT_GT(moved[1].y, needle[1].y);
}

TEST(Grown, LeavesPolygonsInTheEyesPlane) {
  const std::vector<glm::dvec4> clip = {{0, 0, 0, 1}, {1e-14, 0, 0, 1e-13}, {0, 0.5, 0, 1}};
  EXPECT_EQ(grown(clip, 64, 32, 1.0), clip);
}

// Polygons are given by their places in a plane, whose points are at distance w from the eye.
std::vector<glm::dvec4> inPlane(std::span<const glm::dvec2> polygon) {
  std::vector<glm::dvec4> clip;
  for (const glm::dvec2& p : polygon) {
    clip.emplace_back(p, 0.001, 3.0 + 0.9 * p.x - 0.4 * p.y);
  }
  return clip;
}

// Twice the areas of the triangles of a point and the polygon's edges.
std::vector<double> edgeAreas(std::span<const glm::dvec4> polygon, const glm::dvec2& p) {
  std::vector<double> areas;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a(polygon[i]);
    const glm::dvec2 b(polygon[(i + 1) % polygon.size()]);
    areas.push_back((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x));
  }
  return areas;
}

bool inside(std::span<const glm::dvec4> polygon, const glm::dvec2& p) {
  const std::vector<double> areas = edgeAreas(polygon, p);
  const auto left = std::ranges::count_if(areas, [](double area) { return area > 0.0; });
  return left == 0 || left == static_cast<std::ptrdiff_t>(areas.size());
}

bool onAnEdgesLine(std::span<const glm::dvec4> polygon, const glm::dvec2& p) {
  return std::ranges::any_of(edgeAreas(polygon, p), [](double area) { return std::abs(area) < 1e-9; });
}

using Parts = std::vector<std::vector<glm::dvec4>>;

TEST(CutAway, LeavesWhatIsNotCovered) {
  EXPECT_TRUE(rc::check("points of two polygons", [&] {
    const auto number = [](double low, double high) {
      return low + (high - low) * *rc::gen::inRange(0, 1'000'001) / 1'000'000.0;
    };
    const auto polygon = [&](double size) {
      std::vector<glm::dvec2> corners;
      const int count = *rc::gen::inRange(3, 8);
      const glm::dvec2 center(number(-0.7, 0.7), number(-0.7, 0.7));
      const double turn = number(0.0, 6.28);
      for (int i = 0; i < count; ++i) {
        const double angle = turn + 2.0 * std::numbers::pi * i / count;
        corners.push_back(center + size * glm::dvec2(std::cos(angle), std::sin(angle)));
      }
      return corners;
    };
    const std::vector<glm::dvec2> corners = polygon(number(0.05, 1.0));
    std::vector<glm::dvec2> covering = polygon(number(0.05, 1.0));
    if (*rc::gen::arbitrary<bool>()) {
      // Shares an edge, from one side or the other.
      const bool across = *rc::gen::arbitrary<bool>();
      const glm::dvec2 a = corners[0];
      const glm::dvec2 b = corners[1];
      const glm::dvec2 aside = glm::dvec2(a.y - b.y, b.x - a.x) * (across ? -1.0 : 1.0);
      covering = {a, b, b + aside, a + aside};
    }
    if (*rc::gen::arbitrary<bool>()) {
      std::ranges::reverse(covering);
    }
    const std::vector<glm::dvec4> whole = inPlane(corners);
    const std::vector<glm::dvec4> cover = inPlane(covering);
    Parts parts{whole};
    cutAway(parts, cover);
    for (const auto& part : parts) {
      for (const glm::dvec4& v : part) {
        RC_ASSERT(std::abs(v.w - inPlane(std::array{glm::dvec2(v)})[0].w) < 1e-14);
      }
    }
    for (int i = 0; i < 50; ++i) {
      const glm::dvec2 p(number(-1.7, 1.7), number(-1.7, 1.7));
      if (onAnEdgesLine(whole, p) || onAnEdgesLine(cover, p)) {
        continue;
      }
      const auto within = std::ranges::count_if(parts, [&](const auto& part) { return inside(part, p); });
      RC_ASSERT(within == (inside(whole, p) && !inside(cover, p) ? 1 : 0));
    }
  }));
}

TEST(CutAway, LeavesTheWholeWhereNothingIsCovered) {
  const std::vector<glm::dvec4> square = inPlane(std::array<glm::dvec2, 4>{{{0, 0}, {0.1, 0}, {0.1, 0.3}, {0, 0.3}}});
  const std::vector<glm::dvec4> beside =
      inPlane(std::array<glm::dvec2, 4>{{{0.1, 0}, {0.7, 0}, {0.7, 0.3}, {0.1, 0.3}}});
  Parts parts{square};
  cutAway(parts, beside);
  EXPECT_EQ(parts, Parts{square});
  cutAway(parts, inPlane(std::array<glm::dvec2, 3>{{{0, 0}, {0.1, 0.1}, {0.1, 0.1}}}));
  EXPECT_EQ(parts, Parts{square});
  cutAway(parts, square);
  EXPECT_TRUE(parts.empty());
}

}  // namespace
}  // namespace speculum
