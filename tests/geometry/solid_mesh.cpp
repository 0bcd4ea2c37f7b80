#include "geometry/mesh.hpp"

#include <algorithm>
#include <functional>
#include <numbers>

#include "geometry/bvh.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "systems/triangles.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::fullTests;
using testing_support::Random;

bool solid(const Triangles& body) {
  return isSolid(body.positions, body.indices);
}

void append(Triangles& body, const Triangles& other) {
  for (size_t i = 0; i < other.indices.size(); i += 3) {
    body.triangle(other.positions[other.indices[i]], other.positions[other.indices[i + 1]],
                  other.positions[other.indices[i + 2]]);
  }
}

Triangles boxAt(const glm::dvec3& center, const glm::dvec3& half) {
  Triangles body;
  body.box(center - half, center + half);
  return body;
}

void turnInsideOut(Triangles& body) {
  for (size_t i = 0; i < body.indices.size(); i += 3) {
    std::swap(body.indices[i], body.indices[i + 1]);
  }
}

// A tube of about the given radius along a closed curve; radii and rings are jittered.
Triangles tube(Random& random, const std::function<glm::dvec3(double)>& curve, double radius, double jitter) {
  const int rings = 12 + static_cast<int>(random.index(40));
  const int sides = 3 + static_cast<int>(random.index(8));
  std::vector<std::vector<glm::dvec3>> points;
  for (int ring = 0; ring < rings; ++ring) {
    const double t = 2.0 * std::numbers::pi * ring / rings;
    const glm::dvec3 along = glm::normalize(curve(t + 1e-4) - curve(t - 1e-4));
    const glm::dvec3 side = glm::normalize(glm::cross(along, glm::dvec3(0.1, 0.2, 1.0)));
    const glm::dvec3 up = glm::cross(side, along);
    std::vector<glm::dvec3>& circle = points.emplace_back();
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      const double r = radius * random.uniform(1.0 - jitter, 1.0 + jitter);
      circle.push_back(curve(t) + r * (std::cos(angle) * side + std::sin(angle) * up));
    }
  }
  Triangles body;
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<glm::dvec3>& a = points[ring];
    const std::vector<glm::dvec3>& b = points[(ring + 1) % rings];
    for (int i = 0; i < sides; ++i) {
      const int next = (i + 1) % sides;
      body.quad(a[i], b[i], b[next], a[next]);
    }
  }
  return body;
}

// A ball with dents and spikes; large ones make it cross itself.
Triangles dentedBall(Random& random) {
  const double depth = random.uniform(0.0, 1.2);
  const int rings = 4 + static_cast<int>(random.index(12));
  const int sides = 3 + static_cast<int>(random.index(16));
  std::vector<std::vector<glm::dvec3>> points;
  for (int ring = 0; ring <= rings; ++ring) {
    const double polar = std::numbers::pi * ring / rings;
    const bool pole = ring == 0 || ring == rings;
    const glm::dvec3 shift = depth * random.inBox(0.4);
    const double height = random.uniform(1.0 - depth, 1.0);
    std::vector<glm::dvec3>& circle = points.emplace_back();
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      const double r = pole ? 0.0 : std::sin(polar) * random.uniform(1.0 - depth, 1.0);
      circle.push_back(shift + glm::dvec3(r * std::cos(angle), height * std::cos(polar), r * std::sin(angle)));
    }
  }
  Triangles body;
  for (int ring = 0; ring < rings; ++ring) {
    for (int i = 0; i < sides; ++i) {
      const int next = (i + 1) % sides;
      if (ring > 0) {
        body.triangle(points[ring][i], points[ring][next], points[ring + 1][i]);
      }
      if (ring + 1 < rings) {
        body.triangle(points[ring][next], points[ring + 1][next], points[ring + 1][i]);
      }
    }
  }
  return body;
}

Triangles randomComponent(Random& random) {
  const size_t kind = random.index(4);
  if (kind == 0) {
    const double thin = random.chance(0.3) ? 1e-3 : 1.0;
    return boxAt(random.inBox(1.0),
                 {random.uniform(0.1, 1.0), thin * random.uniform(0.1, 1.0), random.uniform(0.1, 1.0)});
  }
  if (kind == 1) {
    return dentedBall(random);
  }
  if (kind == 2) {
    const double wave = random.uniform(0.0, 0.8);
    return tube(
        random, [=](double t) { return glm::dvec3(std::cos(t), wave * std::sin(3.0 * t), std::sin(t)); },
        random.uniform(0.02, 1.2), random.uniform(0.0, 0.5));
  }
  // A lying eight, whose branches pass each other at a distance or through each other.
  const double lift = random.uniform(0.0, 0.5);
  return tube(
      random, [=](double t) { return glm::dvec3(std::sin(t), lift * std::cos(t), std::sin(2.0 * t)); },
      random.uniform(0.02, 0.5), random.uniform(0.0, 0.5));
}

// Components beside, in and through each other, and with all that a solid must not have.
Triangles randomBody(Random& random) {
  Triangles body;
  for (size_t i = 0, count = 1 + random.index(3); i < count; ++i) {
    Triangles component = randomComponent(random);
    if (random.chance(0.1)) {
      turnInsideOut(component);
    }
    append(body, component);
  }
  const size_t spoilt = random.index(12);
  const size_t triangle = 3 * random.index(body.indices.size() / 3);
  if (spoilt == 0) {
    body.indices.erase(body.indices.begin() + static_cast<std::ptrdiff_t>(triangle),
                       body.indices.begin() + static_cast<std::ptrdiff_t>(triangle + 3));
  } else if (spoilt == 1) {
    std::swap(body.indices[triangle], body.indices[triangle + 1]);
  } else if (spoilt == 2) {
    // One vertex moves, with all triangles that share it.
    const glm::dvec3 from = body.positions[body.indices[triangle]];
    const glm::dvec3 to = random.inBox(1.5);
    std::ranges::replace(body.positions, from, to);
  }
  return body;
}

// Says whether a ray meets the body first at the back of a triangle, with no front as near.
bool meetsBackFirst(const Triangles& body, const glm::dvec3& origin, const glm::dvec3& direction) {
  double nearestBack = INFINITY;
  double nearestFront = INFINITY;
  for (size_t i = 0; i < body.indices.size(); i += 3) {
    const glm::dvec3& a = body.positions[body.indices[i]];
    const glm::dvec3 ab = body.positions[body.indices[i + 1]] - a;
    const glm::dvec3 ac = body.positions[body.indices[i + 2]] - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double facing = -glm::dot(normal, direction);
    const glm::dvec3 q = glm::cross(origin - a, direction);
    const double u = glm::dot(ac, q) / facing;
    const double v = -glm::dot(ab, q) / facing;
    const double t = glm::dot(normal, origin - a) / facing;
    // Edges are missed by rounding, never hit twice: a hit on an edge may hide what is behind.
    constexpr double rounding = 1e-9;
    if (t > 0.0 && u >= -rounding && v >= -rounding && u + v <= 1.0 + rounding) {
      (facing > 0.0 ? nearestFront : nearestBack) = std::min(facing > 0.0 ? nearestFront : nearestBack, t);
    }
  }
  return nearestBack < nearestFront - 1e-6;
}

// Rays from outside the box towards a point in it.
int backsSeen(const Triangles& body, Random& random, int rays) {
  const Bounds box = Bounds::around(body.positions);
  const glm::dvec3 half = 0.5 * (box.high - box.low);
  int seen = 0;
  for (int i = 0; i < rays; ++i) {
    glm::dvec3 origin = box.center() + 3.0 * glm::length(half) * random.direction();
    glm::dvec3 target = box.center() + half * random.inBox(1.0);
    if (random.chance(0.5)) {
      // Close to a triangle, from a plane beside the box.
      const size_t t = 3 * random.index(body.indices.size() / 3);
      const double w = random.uniform(0.0, 1.0);
      target = w * body.positions[body.indices[t]] +
               (1.0 - w) * (0.5 * body.positions[body.indices[t + 1]] + 0.5 * body.positions[body.indices[t + 2]]);
    }
    seen += meetsBackFirst(body, origin, glm::normalize(target - origin));
  }
  return seen;
}

TEST(SolidMesh, ShowsNoBackToRandomRays) {
  const int bodies = fullTests() ? 200'000 : 1500;
  int solids = 0;
  int open = 0;
  for (int seed = 0; seed < bodies; ++seed) {
    Random random(static_cast<unsigned>(seed));
    const Triangles body = randomBody(random);
    const bool isOne = solid(body);
    const int seen = backsSeen(body, random, 40);
    ASSERT_TRUE(!isOne || seen == 0) << "seed " << seed;
    solids += isOne;
    open += seen > 0;
  }
  std::printf("%d of %d bodies are solid, %d show a back\n", solids, bodies, open);
  EXPECT_GT(solids, bodies / 8);
  EXPECT_GT(open, bodies / 5);
}

TEST(SolidMesh, ComponentsMayCrossContainAndTouch) {
  Triangles body = boxAt({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(solid(body));
  append(body, boxAt({0.5, 0.5, 0.5}, {1, 1, 1}));
  append(body, boxAt({0, 0, 0}, {0.2, 0.2, 0.2}));
  append(body, boxAt({-2, -2, -2}, {1, 1, 1}));  // a shared corner
  EXPECT_TRUE(solid(body));
}

TEST(SolidMesh, RefusesWhatMayShowABack) {
  Triangles inside = boxAt({0, 0, 0}, {1, 1, 1});
  turnInsideOut(inside);
  EXPECT_FALSE(solid(inside));
  Triangles hollow = boxAt({0, 0, 0}, {3, 3, 3});
  append(hollow, inside);
  EXPECT_FALSE(solid(hollow)) << "a component inside out, though only from within it shows";
  Triangles open = boxAt({0, 0, 0}, {1, 1, 1});
  open.indices.resize(open.indices.size() - 3);
  EXPECT_FALSE(solid(open));
  Triangles turned = boxAt({0, 0, 0}, {1, 1, 1});
  std::swap(turned.indices[0], turned.indices[1]);
  EXPECT_FALSE(solid(turned));
  Triangles flat = boxAt({0, 0, 0}, {1, 0, 1});
  EXPECT_FALSE(solid(flat));
  Triangles edge = boxAt({0, 0, 0}, {1, 1, 1});
  append(edge, boxAt({2, 2, 0}, {1, 1, 1}));
  EXPECT_FALSE(solid(edge)) << "an edge of four triangles";
  Triangles doubled = boxAt({0, 0, 0}, {1, 1, 1});
  doubled.triangle(doubled.positions[0], doubled.positions[1], doubled.positions[2]);
  EXPECT_FALSE(solid(doubled)) << "a triangle twice";
  doubled.triangle(doubled.positions[1], doubled.positions[0], doubled.positions[2]);
  EXPECT_FALSE(solid(doubled)) << "and its other side";
  Triangles infinite = boxAt({0, 0, 0}, {1, 1, 1});
  std::ranges::replace(infinite.positions, infinite.positions[0], glm::dvec3(INFINITY, 0, 0));
  EXPECT_FALSE(solid(infinite));
  EXPECT_FALSE(isSolid({}, {}));
}

// Faces of a box become fans about a point in their plane. Outside of the face, some triangles of the fan are folded
// over others.
TEST(SolidMesh, RefusesFolds) {
  for (const bool folded : {false, true}) {
    Triangles box = boxAt({0, 0, 0}, {1, 1, 1});
    box.indices.erase(box.indices.begin(), box.indices.begin() + 6);  // the face at z = 1
    const std::array<glm::dvec3, 4> ring{glm::dvec3(-1, -1, 1), {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    for (size_t i = 0; i < 4; ++i) {
      box.triangle(ring[i], ring[(i + 1) % 4], glm::dvec3(folded ? 1.5 : 0.5, 0.2, 1));
    }
    EXPECT_EQ(solid(box), !folded);
  }
}

TEST(SolidMesh, ComponentsMayShareAVertex) {
  Triangles body;
  const std::array<glm::dvec3, 4> ring{glm::dvec3(-1, -1, 1), {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  for (const double side : {1.0, -1.0}) {
    for (size_t i = 0; i < 4; ++i) {
      const glm::dvec3 a = side * ring[i];
      const glm::dvec3 b = side * ring[(i + 1) % 4];
      side > 0 ? body.triangle({0, 0, 0}, b, a) : body.triangle({0, 0, 0}, a, b);
    }
    body.quad(side * ring[0], side * ring[side > 0 ? 1 : 3], side * ring[2], side * ring[side > 0 ? 3 : 1]);
  }
  EXPECT_TRUE(solid(body));
}

// A prism over a bow tie is closed and consistently wound, and half of it is inside out.
TEST(SolidMesh, RefusesACrossingPrism) {
  const std::array<glm::dvec3, 4> tie{glm::dvec3(-2, -1, 0), {2, 1, 0}, {2, -1, 0}, {-2, 1.2, 0}};
  Triangles prism;
  const glm::dvec3 up(0, 0, 1);
  for (size_t i = 0; i < 4; ++i) {
    prism.quad(tie[i], tie[(i + 1) % 4], tie[(i + 1) % 4] + up, tie[i] + up);
  }
  prism.quad(tie[0] + up, tie[1] + up, tie[2] + up, tie[3] + up);
  prism.quad(tie[3], tie[2], tie[1], tie[0]);
  EXPECT_FALSE(solid(prism));
  turnInsideOut(prism);
  EXPECT_FALSE(solid(prism));
}

// A corner that touches a face of its own component, exactly and within the tolerance.
TEST(SolidMesh, RefusesToTouchItself) {
  const auto dented = [](double depth) {
    Triangles box = boxAt({0, 0, 0}, {1, 1, 1});
    box.indices.erase(box.indices.begin(), box.indices.begin() + 6);  // the face at z = 1
    const glm::dvec3 tip(0.1, 0.2, 1.0 - depth);
    const std::array<glm::dvec3, 4> ring{glm::dvec3(-1, -1, 1), {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    for (size_t i = 0; i < 4; ++i) {
      box.triangle(ring[i], ring[(i + 1) % 4], tip);
    }
    return box;
  };
  EXPECT_TRUE(solid(dented(-0.5)));
  EXPECT_TRUE(solid(dented(1.9)));
  EXPECT_FALSE(solid(dented(2.0)));
  EXPECT_FALSE(solid(dented(2.0 - 1e-8)));
  EXPECT_FALSE(solid(dented(2.5)));
}

// A torus of 200 000 triangles, whole, without one of them, and with a spike through its tube.
TEST(SolidMesh, LargeMeshesAreExamined) {
  constexpr int along = 1000;
  constexpr int around = 100;
  Triangles torus;
  for (int i = 0; i < along * around; ++i) {
    const double a = 2.0 * std::numbers::pi * (i / around) / along;
    const double b = 2.0 * std::numbers::pi * (i % around) / around;
    const double radius = 3.0 + std::cos(b);
    torus.positions.emplace_back(radius * std::cos(a), std::sin(b), radius * std::sin(a));
  }
  for (int i = 0; i < along * around; ++i) {
    const auto corner = [&](int ring, int k) {
      return static_cast<uint32_t>((i / around + ring) % along * around + (i + k) % around);
    };
    torus.indices.insert(torus.indices.end(),
                         {corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 0), corner(0, 1), corner(1, 1)});
  }
  EXPECT_TRUE(solid(torus));
  Triangles open = torus;
  open.indices.resize(open.indices.size() - 3);
  EXPECT_FALSE(solid(open));
  torus.positions[12345] = {-3.0, 0.0, 0.0};
  EXPECT_FALSE(solid(torus));
}

TEST(SolidMesh, TakesNoLongerThanLimited) {
  // Needles through one point: every pair of boxes overlaps.
  Triangles needles;
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const glm::dvec3 d = random.direction();
    const glm::dvec3 side = 1e-3 * glm::normalize(glm::cross(d, glm::dvec3(0.3, 0.5, 0.7)));
    const glm::dvec3 up = 1e-3 * glm::normalize(glm::cross(d, side));
    const std::array<glm::dvec3, 4> p{d, -d + side, -d - side + up, -d - side - up};
    needles.triangle(p[0], p[1], p[2]);
    needles.triangle(p[0], p[2], p[3]);
    needles.triangle(p[0], p[3], p[1]);
    needles.triangle(p[1], p[3], p[2]);
  }
  EXPECT_FALSE(solid(needles));
  Triangles many;
  for (size_t i = 0; i <= mostSolidTriangles / 12; ++i) {
    append(many, boxAt({3.0 * static_cast<double>(i), 0, 0}, {1, 1, 1}));
  }
  EXPECT_FALSE(solid(many));
}

}  // namespace
}  // namespace speculum
