// Shadow maps against traced shadows on random meshes, where errors may only stand along the outlines of shadows.
#include <numbers>
#include <sstream>

#include "geometry/affine.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "studio.hpp"
#include "truth_support.hpp"

namespace speculum::shadow_truth {
namespace {

using namespace testing_support;

constexpr PictureSize size{128, 96};

// Points of a surface over a grid, closed or open, smooth or creased, with few and long triangles.
struct RandomSurface {
  explicit RandomSurface(Random& random)
      : kind(random.index(4)),
        rows(3 + random.index(9)),
        columns(4 + random.index(11)),
        smooth(random.chance(0.6)),
        waves(static_cast<double>(1 + random.index(4))),
        depth(random.uniform(0.0, 0.3)) {}

  glm::dvec3 at(double row, double column) const {
    const double u = row / static_cast<double>(rows);
    const double v = 2.0 * std::numbers::pi * column / static_cast<double>(columns);
    const double wave = depth * std::sin(waves * std::numbers::pi * u) * std::cos(waves * v);
    const double theta = std::numbers::pi * u;
    switch (kind) {
      case 0:  // a lumpy ball
        return (0.7 + wave) * glm::dvec3(std::sin(theta) * std::cos(v), std::cos(theta), std::sin(theta) * std::sin(v));
      case 1: {  // a ring
        const double tube = 0.25 + 0.5 * wave;
        const double radius = 0.6 + tube * std::cos(2.0 * theta);
        return {radius * std::cos(v), -tube * std::sin(2.0 * theta), radius * std::sin(v)};
      }
      case 2:  // an arch or a tube, open at its ends
        return {0.7 * std::cos(v), 1.4 * (0.5 - u), (0.7 + wave) * std::sin(v)};
      default:  // a sheet with waves
        return {1.8 * (v / (2.0 * std::numbers::pi) - 0.5), 2.0 * wave, 1.8 * (0.5 - u)};
    }
  }

  glm::dvec3 normalAt(double row, double column) const {
    const double step = 0.01;
    const glm::dvec3 n =
        glm::cross(at(row + step, column) - at(row - step, column), at(row, column + step) - at(row, column - step));
    return glm::length(n) > 1e-9 ? -glm::normalize(n) : glm::dvec3(0, row > 0 ? -1 : 1, 0);
  }

  std::string obj() const {
    std::ostringstream out;
    const auto vector = [&](const char* key, const glm::dvec3& v) {
      out << key << ' ' << v.x << ' ' << v.y << ' ' << v.z << '\n';
    };
    for (size_t row = 0; row <= rows; ++row) {
      for (size_t column = 0; column <= columns; ++column) {
        const auto r = static_cast<double>(row);
        const auto c = static_cast<double>(column);
        vector("v", at(r, c));
        vector("vn", normalAt(r, c));
      }
    }
    const auto corner = [&](size_t row, size_t column) {
      const std::string index = std::to_string(row * (columns + 1) + column + 1);
      return ' ' + (smooth ? index + "//" + index : index);
    };
    for (size_t row = 0; row < rows; ++row) {
      for (size_t column = 0; column < columns; ++column) {
        out << 'f' << corner(row, column) << corner(row, column + 1) << corner(row + 1, column + 1)
            << corner(row + 1, column) << '\n';
      }
    }
    return out.str();
  }

  size_t kind, rows, columns;
  bool smooth;
  double waves, depth;
};

// A light in, on or behind the plane of a piece of the surface, inside it, near or far.
glm::dvec3 randomLight(Random& random, const RandomSurface& surface) {
  const double row = static_cast<double>(random.index(surface.rows)) + 0.3;
  const double column = static_cast<double>(random.index(surface.columns)) + 0.6;
  const glm::dvec3 p = surface.at(row, column);
  const glm::dvec3 n = surface.normalAt(row, column);
  const glm::dvec3 along = glm::normalize(glm::cross(n, random.direction()));
  const double behind = random.uniform(0.0, 0.3);
  switch (random.index(6)) {
    case 0:
      return p + random.uniform(0.5, 3.0) * along;
    case 1:
      return p + random.uniform(0.002, 0.05) * n;
    case 2:
      return p + random.uniform(0.5, 3.0) * along - behind * n;
    case 3:
      return 0.3 * random.direction();
    case 4:
      return 60.0 * random.direction();
    default:
      return random.uniform(1.0, 3.0) * random.direction();
  }
}

std::filesystem::path surfaceScene(Random& random, unsigned seed) {
  const RandomSurface surface(random);
  const std::string name = "surface_" + std::to_string(seed);
  writeModel(name + ".obj", surface.obj());
  const glm::dvec3 light = randomLight(random, surface);
  const bool inside = surface.kind == 0 && random.chance(0.3);
  const glm::dvec3 eye = (inside ? 0.3 : 2.2) * random.direction();
  std::ostringstream out;
  out << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
      << cameraText(eye, 0.3 * random.direction()) << "vertical_fov = 55\n"
      << objectText(name + ".obj", {0, 0, 0}, {0, 0, 0}, 1.0, {0.8, 0.75, 0.7});
  if (random.chance(0.5)) {
    out << "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = [0, " << random.uniform(-1.2, -0.6)
        << ", 0]\nscale = [6, 0.1, 6]\n";
  }
  out << "[[light]]\nposition = " << text(light) << "\nintensity = " << 4.0 * std::max(glm::dot(light, light), 0.2)
      << "\nglow = 0\ncasts_shadow = true\n";
  return writeScene(name, out.str());
}

// Says of each pixel whether it lies within `reach` pixels of one where `mask` differs from its neighbour.
std::vector<bool> nearOutline(const std::vector<bool>& mask, int reach) {
  std::vector<bool> near(mask.size());
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const bool own = mask[static_cast<size_t>(y * size.width + x)];
      for (int j = std::max(y - reach, 0); j <= std::min(y + reach, size.height - 1); ++j) {
        for (int i = std::max(x - reach, 0); i <= std::min(x + reach, size.width - 1); ++i) {
          if (mask[static_cast<size_t>(j * size.width + i)] != own) {
            near[static_cast<size_t>(y * size.width + x)] = true;
          }
        }
      }
    }
  }
  return near;
}

struct Agreement {
  PictureAgreement all;
  PictureAgreement offOutlines;  // pixels apart from the outlines of traced shadows
};

// Draws the scene with maps and with traced shadows.
Agreement compareShadows(const std::filesystem::path& file, const std::string& mapSize,
                         ShadowLookup lookup = ShadowLookup::map, const SettingList& more = {}) {
  Options options = headless(file, size, {{"view.samples", "1"}, {"effects.shadow_map_size", mapSize}});
  set(options, more);
  Studio studio(options);
  const Image8 traced = studio.draw();
  studio.settings.effects.shadows = false;
  const Image8 lit = studio.draw();
  studio.settings.effects.shadows = true;
  studio.settings.effects.shadowLookup = lookup;
  const Image8 mapped = studio.draw();
  std::vector<bool> counts = nearOutline(difference(traced, lit, 8).isOver, 2);
  counts.flip();
  return {difference(mapped, traced, 8), difference(mapped, traced, 8, counts)};
}

TEST(ShadowMaps, RandomSurfacesErrOnlyAlongOutlines) {
  int pixels = 0;
  int wrong = 0;
  for (const unsigned seed : sampledSeeds(1000, 90)) {
    Random random(seed);
    const Agreement agreement = compareShadows(surfaceScene(random, seed), "1024");
    EXPECT_LE(agreement.offOutlines.over, 12) << "seed " << seed;
    pixels += agreement.all.counted;
    wrong += agreement.all.over;
  }
  std::printf("%.3f %% of the pixels are wrong\n", 100.0 * wrong / pixels);
  EXPECT_LT(wrong, 0.0015 * pixels);
}

// A corner of walls without thickness, mouldings on one of them, and the light behind that one.
std::filesystem::path corner(Random& random, unsigned seed) {
  std::ostringstream out;
  out << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
      << cameraText({1.5, random.uniform(-0.5, 0.5), 0.5}, {-0.9, 0, -0.8})
      << "[[object]]\nmodel = \"quad.obj\"\nposition = [-1, 0, 1]\nrotation = [0, 90, 0]\nscale = [2, 6, 1]\n"
      << "[[object]]\nmodel = \"quad.obj\"\nposition = [2, 0, -1]\nscale = [3, 6, 1]\n";
  for (int i = 0; i < 3; ++i) {
    const double depth = random.uniform(0.03, 0.3);
    const double z = random.uniform(-0.8, 0.8);
    out << "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = " << text(glm::dvec3(0.5 * depth - 1.0, -1.5, z))
        << "\nscale = " << text(glm::dvec3(depth, 3, random.uniform(0.03, 0.2))) << "\n";
  }
  const double x = -random.uniform(4, 8);
  out << "[[light]]\nposition = " << text(glm::dvec3(x, 0.2, random.uniform(0, 2)))
      << "\nintensity = 90\nglow = 0\ncasts_shadow = true\n";
  return writeScene("corner_" + std::to_string(seed), out.str());
}

// In the last three, an edge at which two walls meet lies within a fraction of a texel of the texels' centres.
std::vector<unsigned> cornerSeeds() {
  std::vector<unsigned> seeds = sampledSeeds(100, 50);
  seeds.insert(seeds.end(), {96, 212, 381});
  return seeds;
}

TEST(ShadowMaps, ThinWallsLeakNoLight) {
  writeQuad();
  for (const unsigned seed : cornerSeeds()) {
    Random random(seed);
    EXPECT_LE(compareShadows(corner(random, seed), "256").all.over, 12) << "seed " << seed;
  }
}

// Draws scenes with hybrid shadows and returns the share of their pixels that differ from traced ones.
template <typename MakeScene>
double wrongShare(unsigned first, unsigned count, const MakeScene& scene, const char* mapSize,
                  const SettingList& settings = {}) {
  int pixels = 0;
  int wrong = 0;
  for (const unsigned seed : sampledSeeds(first, count)) {
    Random random(seed);
    const PictureAgreement agreement = compareShadows(scene(random, seed), mapSize, ShadowLookup::hybrid, settings).all;
    if (agreement.over > 0) {
      std::printf("seed %u: %d wrong\n", seed, agreement.over);
    }
    pixels += agreement.counted;
    wrong += agreement.over;
  }
  std::printf("%.4f %% of the pixels are wrong\n", 100.0 * wrong / pixels);
  return static_cast<double>(wrong) / pixels;
}

TEST(HybridShadows, EqualTracedOnRandomSurfaces) {
  EXPECT_LT(wrongShare(1000, 90, surfaceScene, "512"), fullTests() ? 3e-5 : 2e-5);
}

TEST(HybridShadows, EqualTracedBetweenThinWalls) {
  writeQuad();
  // Nine of a hundred corners show light in the column of pixels where walls without thickness meet.
  EXPECT_LT(wrongShare(100, 50, corner, "256"), fullTests() ? 1e-4 : 2e-5);
}

// Rods, sheets and points of pyramids that are thinner than a texel of the map, over a floor.
std::filesystem::path thinThings(Random& random, unsigned seed) {
  std::ostringstream out;
  out << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
      << cameraText({1.5, 2.0, 1.8}, {0, 0, 0})
      << "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = [0, -0.2, 0]\nscale = [8, 0.2, 8]\n";
  for (int i = 0; i < 12; ++i) {
    const double thickness = random.uniform(0.001, 0.02);
    const std::array scales{glm::dvec3(thickness, thickness, random.uniform(0.2, 1.5)),
                            glm::dvec3(thickness, random.uniform(0.2, 0.8), 0.6),
                            glm::dvec3(random.uniform(0.002, 0.03))};
    const glm::dvec3 scale = scales.at(random.index(scales.size()));
    constexpr std::array models{"block", "sphere", "gem"};
    const glm::dvec3 position = random.inBox(1.0);
    out << "[[object]]\nmodel = \"MODELS/" << random.pick(models)
        << ".obj\"\nposition = " << text(glm::dvec3(position.x, 0.5 + 0.45 * position.y, position.z))
        << "\nrotation = " << random.vec(-180, 180) << "\nscale = " << text(scale) << "\n";
  }
  out << "[[light]]\nposition = " << text(glm::dvec3(random.uniform(-2, 2), random.uniform(1.5, 4), 0.5))
      << "\nintensity = 30\nglow = 0\ncasts_shadow = true\n";
  return writeScene("thin_" + std::to_string(seed), out.str());
}

TEST(HybridShadows, FindCastersThinnerThanATexel) {
  EXPECT_LT(wrongShare(200, 40, thinThings, "128"), 2e-4);
}

// Blocks and balls that stand on a floor, with the light behind them: where they touch it, pixels hold both, and the
// floor's own part of such a pixel may be lit though the floor at the pixel's centre is hidden.
std::filesystem::path feet(Random& random, unsigned seed) {
  std::ostringstream out;
  out << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
      << cameraText({random.uniform(-1, 1), random.uniform(0.8, 2), 2.5}, {0, 0.2, 0})
      << "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = [0, -0.2, 0]\nscale = [8, 0.2, 8]\n";
  for (int i = 0; i < 10; ++i) {
    const double size = random.uniform(0.1, 0.5);
    out << "[[object]]\nmodel = \"MODELS/" << (random.chance(0.7) ? "block" : "sphere")
        << ".obj\"\nposition = " << text(glm::dvec3(random.uniform(-1.5, 1.5), 0.0, random.uniform(-1.5, 1.0)))
        << "\nrotation = [0, " << random.uniform(0, 90) << ", 0]\nscale = " << size << "\n";
  }
  out << "[[light]]\nposition = "
      << text(glm::dvec3(random.uniform(-3, 3), random.uniform(1, 3), random.uniform(-3, 3)))
      << "\nintensity = 30\nglow = 0\ncasts_shadow = true\n";
  return writeScene("feet_" + std::to_string(seed), out.str());
}

TEST(HybridShadows, EqualTracedWithFourSamples) {
  const SettingList settings{{"view.samples", "4"}};
  EXPECT_LT(wrongShare(1000, 60, surfaceScene, "512", settings), 1e-4);
  EXPECT_LT(wrongShare(200, 30, thinThings, "128", settings), 2e-4);
  EXPECT_LT(wrongShare(100, 30, feet, "512", settings), 1e-4);
}

// A sphere and a block over a floor, and a light that is up to 1e13 m away.
std::filesystem::path farLight(Random& random, unsigned seed) {
  const double distance = std::pow(10.0, random.uniform(2.0, 13.0));
  const glm::dvec3 light = distance * glm::normalize(glm::dvec3(random.uniform(-1, 1), 1.0, random.uniform(-1, 1)));
  std::ostringstream out;
  out << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
      << cameraText({1.5, 2.0, 1.8}, {0, 0, 0})
      << "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = [0, -0.2, 0]\nscale = [8, 0.2, 8]\n"
      << "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = [-0.4, 0, 0]\nrotation = " << random.vec(-180, 180)
      << "\nscale = 0.4\n"
      << "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [0.4, 0.5, 0.2]\nscale = 0.3\n"
      << "[[light]]\nposition = " << text(light) << "\nintensity = " << 3.0 * distance * distance
      << "\nglow = 0\ncasts_shadow = true\n";
  return writeScene("far_light_" + std::to_string(seed), out.str());
}

TEST(HybridShadows, EqualTracedUnderFarLights) {
  EXPECT_LT(wrongShare(200, 30, farLight, "256"), 5e-5);
}

// A light that lies in a face of a turned block or quad, or in the face's plane beside it, over a floor.
std::filesystem::path lightInFace(Random& random, unsigned seed) {
  const bool isQuad = random.chance(0.3);
  const glm::dvec3 origin =
      random.chance(0.7) ? glm::dvec3(0.0) : std::pow(10.0, random.uniform(1, 7)) * random.direction();
  const glm::dvec3 angles = random.chance(0.4) ? glm::dvec3(90.0 * std::floor(random.uniform(0, 4)), 0, 0)
                                               : glm::dvec3(random.uniform(-180, 180), random.uniform(-180, 180), 0);
  const glm::dvec3 scale(random.uniform(0.3, 1.5), random.uniform(0.3, 1.5), random.uniform(0.3, 1.5));
  const glm::dvec3 position = origin + random.inBox(0.5);
  const double beside = random.chance(0.5) ? 1.0 : 3.0;
  const glm::dvec2 at(beside * random.uniform(-0.45, 0.45), beside * random.uniform(-0.45, 0.45));
  const glm::dvec3 local =
      isQuad ? glm::dvec3(2.0 * at, 0.0) : glm::dvec3(random.chance(0.5) ? 0.5 : -0.5, 0.5 + at.x, at.y);
  const glm::dvec3 light = position + rotationFromDegrees(angles) * (scale * local);
  std::ostringstream out;
  out << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
      << cameraText(origin + 3.5 * glm::normalize(random.direction() + glm::dvec3(0, 1.2, 0)), origin)
      << "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = " << text(origin - glm::dvec3(0, 1.5, 0))
      << "\nscale = [8, 0.2, 8]\n"
      << "[[object]]\nmodel = \"" << (isQuad ? "quad.obj" : "MODELS/block.obj") << "\"\nposition = " << text(position)
      << "\nrotation = " << text(angles) << "\nscale = " << text(scale) << "\n"
      << "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = " << text(origin + random.inBox(1.2))
      << "\nscale = 0.2\n"
      << "[[light]]\nposition = " << text(light) << "\nintensity = 30\nglow = 0\ncasts_shadow = true\n";
  return writeScene("light_in_face_" + std::to_string(seed), out.str());
}

// A light that lies on a turned mirror, or in the mirror's plane beside it, over a floor and up to 1e7 m from the
// origin.
std::filesystem::path lightInMirror(Random& random, unsigned seed) {
  const glm::dvec3 origin = std::pow(10.0, random.uniform(1, 7)) * random.direction();
  const glm::dvec3 angles = random.chance(0.3) ? glm::dvec3(0.0) : random.inBox(180.0);
  const glm::dvec3 position = origin + random.inBox(0.5);
  const double beside = random.chance(0.5) ? 1.0 : 3.0;
  const glm::dvec3 local(beside * random.uniform(-0.6, 0.6), beside * random.uniform(-0.45, 0.45), 0.0);
  const glm::dvec3 light = position + rotationFromDegrees(angles) * local;
  std::ostringstream out;
  out << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
      << cameraText(origin + 3.5 * glm::normalize(random.direction() + glm::dvec3(0, 1.2, 0)), origin)
      << "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = " << text(origin - glm::dvec3(0, 1.5, 0))
      << "\nscale = [8, 0.2, 8]\n"
      << "[[mirror]]\n"
      << rectangleText(position, angles, 1.5, 1.1)
      << "casts_light = false\ntwo_sided = " << (random.chance(0.4) ? "true\n" : "false\n")
      << objectText("MODELS/sphere.obj", origin + random.inBox(1.2), {0, 0, 0}, 0.2, {0.7, 0.7, 0.7})
      << "[[light]]\nposition = " << text(light) << "\nintensity = 30\nglow = 0\ncasts_shadow = true\n";
  return writeScene("light_in_mirror_" + std::to_string(seed), out.str());
}

// Against the tracer, whose lights are in the surface as well.
template <typename MakeScene>
void expectTracedShadows(const std::vector<unsigned>& seeds, const MakeScene& scene) {
  for (const unsigned seed : seeds) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::filesystem::path file = scene(random, seed);
    const Image8 expected = trace(file, size, 0).picture;
    Options options = truthOptions(file, size, 0);
    set(options, {{"effects.shadow_map_size", "512"}});
    Studio studio(options);
    EXPECT_LE(difference(studio.draw(), expected, 8).over, 12) << "traced";
    studio.settings.effects.shadowLookup = ShadowLookup::hybrid;
    EXPECT_LE(difference(studio.draw(), expected, 8).over, 12) << "hybrid";
    studio.settings.effects.shadowLookup = ShadowLookup::map;
    const Image8 mapped = studio.draw();
    studio.settings.effects.shadows = false;
    std::vector<bool> counts = nearOutline(difference(expected, studio.draw(), 8).isOver, 2);
    counts.flip();
    EXPECT_LE(difference(mapped, expected, 8, counts).over, 12) << "map";
  }
}

TEST(HybridShadows, LightsAreNotHiddenByFacesTheyLieIn) {
  writeQuad();
  std::vector<unsigned> seeds = sampledSeeds(200, 20);
  seeds.insert(seeds.end(), {22, 133});  // far from the origin; its face is nearer than the light's rounding
  expectTracedShadows(seeds, lightInFace);
}

TEST(HybridShadows, LightsInTheirMirrorsShineToOneSideOnly) {
  expectTracedShadows(sampledSeeds(200, 20), lightInMirror);
}

// Where a map decides, a surface is shaded once a pixel. Shadows that cross a pixel between its corners are missed, and
// so are those of casters less than a texel before the floor; a texel is as large as these few pixels.
TEST(HybridShadows, EqualTracedAtEverySample) {
  const SettingList settings{{"effects.per_sample", "true"}, {"view.samples", "4"}};
  EXPECT_LT(wrongShare(1000, 90, surfaceScene, "auto", settings), 1.5e-3);
  EXPECT_LT(wrongShare(200, 40, thinThings, "auto", settings), 3e-3);
}

}  // namespace
}  // namespace speculum::shadow_truth
