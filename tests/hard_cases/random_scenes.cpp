// Random scenes that combine hard cases, against the tracer: the eye 1 um to 1 cm from a mirror that reaches behind it,
// mostly at grazing angles, up to 1e7 m from the origin, mirrors in mirrors to depth 32.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "geometry/affine.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{192, 108};

// The mirror's frame: x and y in its plane, z its normal; the eye looks along x.
struct Setting {
  glm::dvec3 origin;
  glm::dvec3 angles;
  glm::dmat3 frame;
  double height = 0.0;     // of the eye above the mirror, metres
  double elevation = 0.0;  // of the line of sight above the mirror, degrees
  double reach = 0.0;      // of the scene along x, metres

  glm::dvec3 at(double x, double y, double z) const { return origin + frame * glm::dvec3(x, y, z); }
};

Setting randomSetting(Random& random, bool deep) {
  Setting s;
  const double far = random.chance(0.3) ? 0.0 : std::pow(10.0, random.uniform(0, 7));
  s.origin = far * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  s.angles = {random.uniform(-80, 80), random.uniform(-180, 180), random.uniform(-180, 180)};
  s.frame = rotationFromDegrees(s.angles);
  s.height = std::pow(10.0, random.uniform(-6, -2));
  const double grazing = std::pow(10.0, random.uniform(-3, 0));
  s.elevation = random.chance(0.7) ? (random.chance(0.7) ? -grazing : grazing) : random.uniform(-80, -1);
  if (deep && random.chance(0.6)) {
    s.elevation = random.uniform(-89, -75);  // bounces many times before it leaves the mirrors
  }
  s.reach = random.uniform(4, 9);
  return s;
}

std::string mirrorText(Random& random, const std::string& shape, bool plain) {
  std::ostringstream out;
  out << "[[mirror]]\n" << shape << "reflectance = " << random.vec(plain ? 0.85 : 0.6, 1.0) << "\n";
  if (!plain && random.chance(0.4)) {
    out << "base_color = " << random.vec(0, 0.5) << "\n";
  }
  if (!plain && random.chance(0.3)) {
    out << "fresnel = \"schlick\"\n";
  }
  if (random.chance(0.3)) {
    out << "two_sided = true\n";
  }
  return out.str();
}

// A polygon in the mirror's frame.
std::string polygon(const Setting& s, std::vector<glm::dvec3> corners) {
  for (glm::dvec3& p : corners) {
    p = s.at(p.x, p.y, p.z);
  }
  return polygonText(corners);
}

// Above the mirror and parallel to it but for a little; seen in it, and it in that, without end.
std::string facingMirror(Random& random, const Setting& s) {
  const double z = random.uniform(2.5, 4.0);
  const double tilt = random.uniform(-0.03, 0.03);
  return polygon(s, {{-6, -9, z - 6 * tilt}, {-6, 9, z - 6 * tilt}, {12, 9, z + 12 * tilt}, {12, -9, z + 12 * tilt}});
}

std::string wallAhead(Random& random, const Setting& s) {
  const double lean = random.uniform(-0.5, 0.5);
  const double x = s.reach + random.uniform(0.5, 2.0);
  return polygon(s, {{x, 6, -1}, {x, -6, -1}, {x + lean * 5, -6, 4}, {x + lean * 5, 6, 4}});
}

struct HardScene {
  std::filesystem::path file;
  int maxDepth = 4;
};

HardScene hardScene(unsigned seed) {
  Random random(seed + 5000);
  const bool deep = seed % 3 == 0;
  const Setting s = randomSetting(random, deep);
  const double e = glm::radians(s.elevation);
  const glm::dvec3 eye = s.at(0, 0, s.height);
  const glm::dvec3 target = eye + s.frame * glm::dvec3(std::cos(e), random.uniform(-0.2, 0.2), std::sin(e));
  const double roll = random.uniform(-40, 40);
  const glm::dvec3 up = s.frame * rotationAboutAxis({1, 0, 0}, roll) * glm::dvec3(0, 0, 1);
  std::ostringstream out;
  out << "[environment]\nambient = " << random.vec(0.02, 0.2) << "\nsky = { zenith = " << random.vec(0, 1)
      << ", horizon = " << random.vec(0, 1) << ", ground = " << random.vec(0, 1) << " }\n"
      << cameraText(eye, target, up) << "vertical_fov = " << random.uniform(40, 85) << "\n";
  for (unsigned i = 0; i < 6; ++i) {
    // Some stand across the mirror's plane.
    out << randomObjectText(random, seed * 16 + i + 100000, 0.9, {0.6, 1.6}, [&] {
      return text(s.at(random.uniform(1.5, s.reach), random.uniform(-3, 3), random.uniform(-0.2, 2.5)));
    });
  }
  for (int i = 0; i < 2; ++i) {
    out << randomLightText(random, text(s.at(random.uniform(0, 6), random.uniform(-3, 3), random.uniform(0.5, 2.4))));
  }
  out << mirrorText(random, rectangleText(s.origin, s.angles, random.uniform(14, 40), random.uniform(14, 40)), deep);
  if (deep) {
    out << mirrorText(random, facingMirror(random, s), true);
  } else {
    out << mirrorText(random, wallAhead(random, s), false);
    const glm::dvec3 tilted = s.angles + glm::dvec3(random.uniform(-60, 60), random.uniform(-60, 60), 0);
    out << mirrorText(random,
                      rectangleText(s.at(random.uniform(-1, 4), random.uniform(-2, 2), random.uniform(0.3, 2)), tilted,
                                    random.uniform(0.5, 4), random.uniform(0.5, 4)),
                      false);
  }
  return {writeScene("hard_" + std::to_string(seed), out.str()), deep ? 32 : 4};
}

void expectHardTruth(unsigned seed) {
  const HardScene scene = hardScene(seed);
  const Truth truth = trace(scene.file, size, scene.maxDepth);
  EXPECT_GE(share(truth.traced.mirrorMask, 1), 0.2) << "too little of a mirror in view to judge by";
  expectTruth(scene.file, size, scene.maxDepth, truth);
}

class HardScenes : public testing::TestWithParam<unsigned> {};

TEST_P(HardScenes, MatchTheTracer) {
  expectHardTruth(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Seeds, HardScenes, testing::ValuesIn(sampledSeeds(200, 10)),
                         testing::PrintToStringParamName());

TEST(FreshHardScene, MatchesTheTracer) {
  unsigned seed = std::random_device()() % 1000000 + 1000;
  while (share(trace(hardScene(seed).file, size, 4).traced.mirrorMask, 1) < 0.2) {
    ++seed;
  }
  std::printf("fresh seed %u\n", seed);
  SCOPED_TRACE("seed " + std::to_string(seed));
  expectHardTruth(seed);
}

}  // namespace
}  // namespace speculum
