// Settings that leave something out change pictures by no more than its share of the light.
#include "geometry/affine.hpp"
#include "reference/ray_tracer.hpp"
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize smallSize{160, 90};

double largestDifference(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 d = glm::abs(a - b);
  return std::max({d.x, d.y, d.z});
}

// All surfaces, the mirrors' own layers too, have a radiance within 0.1 of the background's. A mirror at the depth
// limit shows the background instead, and the reflectances before it weight the error, so no pixel is off by more than
// 0.1 times their product.
TEST(TailBeyondTheDepthLimit, IsBoundedByTheReflectances) {
  constexpr double reflectance = 0.8;
  std::string text =
      "[environment]\nambient = [1, 1, 1]\nbackground = [0.5, 0.5, 0.5]\n" + cameraText({0.1, 0.2, 1.5}, {0, 0, -2});
  for (const double side : {-2.0, 2.0}) {
    text += "[[mirror]]\n" + rectangleText({0, 0, side}, {0, side < 0 ? 0 : 180, 0}, 8, 6) +
            "reflectance = [0.8, 0.8, 0.8]\nbase_color = [0.5, 0.5, 0.5]\n";
    text += objectText("MODELS/sphere.obj", {0.4 * side, -0.2 * side, -0.3}, {0, 0, 0}, 0.5, {0, 0, 0}) +
            "specular = [0, 0, 0]\nemission = " + (side < 0 ? "[0.4, 0.6, 0.5]\n" : "[0.6, 0.4, 0.45]\n");
  }
  const auto file = writeScene("tail", text);
  const LinearImage whole = trace(file, smallSize, 64).traced.image;
  QuietSession session(truthOptions(file, smallSize, 1));
  for (const int depth : {1, 2, 4}) {
    set(session, {{"reflection.max_depth", std::to_string(depth)}});
    const LinearImage cut = drawRadiance(session);
    const double bound = 0.1 * std::pow(reflectance, depth);
    int over = 0;
    double most = 0.0;
    for (size_t i = 0; i < cut.pixels.size(); ++i) {
      const double off = largestDifference(cut.pixels[i], whole.pixels[i]);
      over += off > bound + 1e-3;  // a half float is off by 2^-12 of 0.6
      most = std::max(most, off);
    }
    EXPECT_LE(over, 40) << "of 14 400, at edges; depth " << depth;
    EXPECT_GT(most, 0.2 * bound) << "nothing is cut off at depth " << depth;
  }
}

// Mirrors with sides of so many pixels show a bright wall. Each that is left out changes at most reflection.min_pixels
// pixels by its reflectance times the wall's radiance.
void expectBoundedChange(double leastSide, double mostSide) {
  std::ostringstream text;
  text << "[settings]\nreflection.max_passes = 2000\nreflection.samples = 1\nview.samples = 1\n"
       << cameraText({0, 0, 10}, {0, 0, 0}) << "vertical_fov = 53.13\n"
       << objectText("MODELS/box.obj", {0, -50, 30}, {0, 0, 0}, 100, {0, 0, 0})
       << "specular = [0, 0, 0]\nemission = [1, 1, 1]\n";
  constexpr double pixel = 10.0 / 90.0;  // at a distance of 10 m
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const double side = pixel * random.uniform(leastSide, mostSide);
    text << "[[mirror]]\n"
         << rectangleText({0.4 * (i % 40 - 19.5), 0.72 * (i / 40 - 6), 0}, {0, 0, random.uniform(0, 90)}, side, side)
         << "reflectance = [0.5, 0.5, 0.5]\n";
  }
  Options options = headless(writeScene("few_pixels", text.str()), smallSize);
  options.validation = false;  // takes seconds for a thousand passes
  QuietSession session(options);
  const auto radiance = [&](const char* pixels) {
    set(session, {{"reflection.min_pixels", pixels}});
    return drawRadiance(session);
  };
  const LinearImage whole = radiance("0");
  const LinearImage cut = radiance("2");
  const auto& skipped = session.lastFrame().plan.skipped;
  const auto left = std::ranges::count(skipped, SkipReason::minPixels, &SkippedMirror::reason);
  EXPECT_GT(left, 50);
  double missing = 0.0;
  for (size_t i = 0; i < cut.pixels.size(); ++i) {
    missing += largestDifference(cut.pixels[i], whole.pixels[i]);
  }
  EXPECT_LE(missing, 0.5 * 2.0 * static_cast<double>(left));
  EXPECT_GT(missing, 0.0);
}

TEST(MirrorsOfFewPixels, LeaveOutTheirAreaAtMost) {
  expectBoundedChange(1.0, 3.0);
}

TEST(MirrorsOfFewPixels, BelowAPixelLeaveOutTheirArea) {
  expectBoundedChange(0.2, 1.0);
}

// The eye is in a room of any size, less than a millimetre from its mirror.
TEST(EyeNearerThanTheNearPlane, SmallRoomsKeepTheirOrder) {
  std::vector<std::filesystem::path> files;
  for (const double unit : {1.0, 1e-3, 1e-6, 1e-9}) {
    const std::string scene =
        "[environment]\nbackground = [0.3, 0.4, 0.6]\nambient = [0.5, 0.5, 0.5]\n" +
        cameraText(unit * glm::dvec3(0.1, 0.2, 4e-4), unit * glm::dvec3(0.3, 0.1, -1.0)) + "[[mirror]]\n" +
        rectangleText({0, 0, 0}, {0, 0, 0}, unit, unit) + "reflectance = [0.9, 0.9, 0.9]\n" +
        objectText("MODELS/torus_knot.obj", unit * glm::dvec3(0.1, 0.1, 0.3), {20, 30, 0}, 0.2 * unit,
                   {0.8, 0.3, 0.1}) +
        objectText("MODELS/box.obj", unit * glm::dvec3(0.2, 0.1, 0.6), {30, 10, 0}, 0.3 * unit, {0.1, 0.3, 0.8});
    files.push_back(writeScene("small_room_" + text(unit), scene));
  }
  expectTruths(files, smallSize, 2);
}

// Sheets of one plane that overlap, some facing away, before a mirror that shows them once more. With `rays` there are
// layers under the reflections, shadows, light off sheets, and ripples: rays leave the sheets and meet them.
std::string sheetsInOnePlane(Random& random, bool rays) {
  const glm::dvec3 rotation = random.inBox(40.0);
  const glm::dmat3 turn = rotationFromDegrees(rotation);
  const glm::dvec3 center = random.uniform(0, 1) < 0.5 ? glm::dvec3(0.0) : random.inBox(1e6);
  std::ostringstream text;
  text << "[environment]\nbackground = [0.3, 0.4, 0.6]\nambient = [0.5, 0.5, 0.5]\n"
       << cameraText(center + turn * glm::dvec3(random.uniform(-3, 3), random.uniform(-1, 2), 2.5), center)
       << objectText("MODELS/torus_knot.obj", center + turn * glm::dvec3(0.4, 0.3, 1.5), {20, 30, 0}, 0.6,
                     {0.8, 0.3, 0.1});
  for (int i = 0; i < 5; ++i) {
    const glm::dvec3 at = center + turn * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), 0.0);
    const double quarterTurns = std::floor(random.uniform(0, 4));
    const bool away = random.uniform(0, 1) < 0.3;
    std::vector<glm::dvec3> corners;
    for (int corner = 0; corner < 3 + i; ++corner) {
      const double angle = (away ? -1.0 : 1.0) * 2.0 * std::numbers::pi * (corner + 0.37 * quarterTurns) / (3 + i);
      corners.push_back(at + turn * (glm::dvec3(std::cos(angle), std::sin(angle), 0.0) * random.uniform(0.9, 1.0)));
    }
    text << "[[mirror]]\n"
         << polygonText(corners) << "reflectance = " << random.vec(0.2, 0.9) << "\nback_color = " << random.vec(0, 1)
         << "\ntwo_sided = " << (i == 1 ? "true" : "false") << "\n";
    if (rays) {
      text << "base_color = " << random.vec(0, 1) << "\ncasts_light = " << (i == 2 ? "true" : "false") << "\n"
           << (i == 3 ? "ripple = { amplitude = 0.01, wavelength = 1 }\n" : "");
    }
  }
  for (int i = 0; rays && i < 2; ++i) {
    text << "[[light]]\nposition = " << testing_support::text(center + turn * glm::dvec3(2.0 * i - 1.0, 1.5, 1.5 + i))
         << "\nintensity = 4\ncasts_shadow = true\n";
  }
  text << "[[mirror]]\n" << rectangleText(center + turn * glm::dvec3(0, 0, 5), rotation + glm::dvec3(0, 180, 0), 6, 6);
  return text.str();
}

TEST(MirrorsInOnePlane, CoverInTheOrderOfTheFile) {
  constexpr PictureSize large{240, 135};
  Random random(7);
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 12; ++i) {
    files.push_back(writeScene("one_plane_" + std::to_string(i), sheetsInOnePlane(random, false)));
  }
  expectTruths(files, large, 3);
}

// Seen from a micrometre above their plane, so that depth changes by most of its range from pixel to pixel.
TEST(MirrorsInOnePlane, CoverUnderAGrazingEye) {
  Random random(3);
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 24; ++i) {
    const glm::dvec3 eye(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5),
                         std::pow(10.0, random.uniform(-6, i % 3 == 2 ? -2 : -4)));
    const bool wide = i % 2 == 1;
    std::ostringstream scene;
    scene << "[environment]\nbackground = [0.8, 0.4, 0.8]\nambient = [0.3, 0.3, 0.1]\n"
          << cameraText(eye, eye + glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), wide ? -0.2 : 0.0))
          << "vertical_fov = " << (wide ? 165 : 60) << "\n";
    for (int mirror = 0; mirror < 3; ++mirror) {
      const bool away = mirror == 0 && i % 4 == 1;  // other mirrors cover its back
      scene << "[[mirror]]\n"
            << rectangleText({random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0.0},
                             {away ? 180 : 0, 0, random.uniform(0, 90)}, random.uniform(1, 2), random.uniform(1, 2))
            << "reflectance = " << random.vec(0.2, 0.9) << "\n";
    }
    files.push_back(writeScene("grazing_plane_" + std::to_string(i), scene.str()));
  }
  expectTruths(files, smallSize, 1);
}

TEST(MirrorsInOnePlane, RaysMeetThePlaneOnce) {
  Random random(8);
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 2; ++i) {
    files.push_back(writeScene("rays_of_one_plane_" + std::to_string(i), sheetsInOnePlane(random, true)));
  }
  expectTruths(files, smallSize, 3);
}

// Ripples and a lamp a little above a lake whose first corner, and whose centre, are far away.
TEST(LargeMirrors, AreExactNearTheEye) {
  Random random(14);
  for (const double size : {300.0, 1e4, 1e6}) {
    const double wavelength = size == 300.0 ? 0.01 : 0.35;
    const glm::dvec3 center(0.9 * size, 0, random.uniform(-0.9, 0.9) * size);
    const glm::dvec3 side(size, 0, 0);
    const glm::dvec3 depth(0, 0, size);
    const std::string lake = "[[mirror]]\n" + polygonText({center - side + depth, center + side + depth,
                                                           center + side - depth, center - side - depth});
    const std::string rest =
        "[environment]\nambient = [0.1, 0.1, 0.1]\nsky = { zenith = [0.1, 0.2, 0.6], horizon = "
        "[0.8, 0.8, 0.8], ground = [0.1, 0.1, 0.1] }\n" +
        objectText("MODELS/block.obj", {0, 0.02, 0}, {0, 0, 0}, 0.5, {0.6, 0.5, 0.4}) +
        "[[light]]\nposition = [-0.4, 0.3, 0.3]\ncasts_shadow = true\n";
    const std::string name = "lake" + text(size);
    const PictureSize picture{96, 54};
    for (const std::string& ripple : {std::string(), "ripple = { amplitude = " + text(0.01 * wavelength) +
                                                         ", wavelength = " + text(wavelength) + ", speed = 0.2 }\n"}) {
      const auto file = writeScene(name, cameraText({0.2, 0.9, 0.8}, {0, 0, 0}) + rest + lake + ripple);
      expectTruth(file, picture, 1, trace(file, picture, 1));
    }
  }
}

// Five million waves later water looks as at first, to a billionth of a wave.
TEST(LongTimes, RipplesComeBackAfterDays) {
  const auto file = writeScene(
      "long_ripples", "[environment]\nbackground = [0.3, 0.4, 0.6]\nambient = [0.5, 0.5, 0.5]\n" +
                          cameraText({0.2, 1, 2}, {0, 0, -1}) + "[[mirror]]\n" +
                          rectangleText({0, 0, -1}, {-90, 0, 0}, 8, 6) +
                          "ripple = { amplitude = 0.01, wavelength = 0.5, speed = 0.2 }\n" +
                          objectText("MODELS/torus_knot.obj", {0.3, 0.8, -2}, {20, 30, 0}, 0.6, {0.8, 0.3, 0.1}));
  for (const double time : {0.3, 1.2}) {
    const Image8 later = draw(truthOptions(file, smallSize, 1), 1e6 + time);
    expectAlike(later, draw(truthOptions(file, smallSize, 1), time), 1, "ripples_after_days");
    expectTruth(file, smallSize, 1, trace(file, smallSize, 1, 1e6 + time), 1e6 + time);
  }
}

}  // namespace
}  // namespace speculum
