// Hard cases of shading and of sizes: no value that is drawn is infinite or NaN.
#include <chrono>
#include <thread>

#include "geometry/affine.hpp"
#include "image/image.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "truth_support.hpp"
#include "virtual_display.hpp"
#include "window/demo.hpp"

namespace speculum::finite_pictures {
namespace {

using namespace testing_support;

constexpr PictureSize size{321, 181};  // odd: the middle of a pixel looks at the target

// Lights that lie on a surface, and one so small and bright that its irradiance leaves the range of a float; normals
// that cancel halfway across a face; highlights seen from the mirror direction.
const std::string litScene = R"([environment] background = [0.2, 0.3, 0.4], ambient = [0.1, 0.1, 0.1]
[camera] position = [0, 0, 3], target = [0, 0, 0]
[[object]] model = "quad.obj", color = [0.8, 0, 0], specular = [0, 0.5, 0], shininess = 1000
[[object]] model = "cancelling.obj", position = [0, 0, 0.5], scale = 0.1, color = [0.3, 0.6, 0]
  specular = [0.5, 0, 0]
[[object]] model = "MODELS/sphere.obj", position = [-0.9, 0.5, 0.6], scale = 0.5, specular = [0.6, 0.6, 0.6]
  shininess = 20000
[[light]] position = [0.6, 0, 0], intensity = 5, radius = 1e-20, glow = 0
[[light]] position = [0.6, -0.6, 1e-3], intensity = 1e36, radius = 1e-22, glow = 0
[[light]] position = [-0.6, -0.6, 1e-12], intensity = 1e4, radius = 1e-3, color = [0, 0, 1], glow = 1e9
[[light]] position = [0, 0, 3], intensity = 10, glow = 0
[[mirror]] position = [0, 0, -2], size = [6, 4], reflectance = [1, 1, 1], base_color = [0.3, 0, 0]
[[mirror]] position = [0, 0, 6], rotation = [0, 180, 0], size = [9, 6], reflectance = [1, 1, 0.5]
  fresnel = "schlick"
)";

std::filesystem::path writeLitScene() {
  writeQuad();
  writeModel("cancelling.obj",
             "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 1\nvn 0 0 -1\nvn 1 0 0\nvn -1 0 0\n"
             "f 1//1 2//2 3//1\nf 1//3 3//4 4//3\n");
  return writeScene("lit", litScene);
}

int notStorable(const LinearImage& image) {
  return static_cast<int>(std::ranges::count_if(image.pixels, [](const glm::vec3& p) {
    return !(p.r >= 0.0f && p.g >= 0.0f && p.b >= 0.0f && p.r <= 65504.0f && p.g <= 65504.0f && p.b <= 65504.0f);
  }));
}

TEST(LightOnASurface, EveryPixelIsFinite) {
  for (const char* samples : {"1", "4"}) {
    QuietSession session(headless(writeLitScene(), size, {{"view.samples", samples}, {"reflection.samples", samples}}));
    const LinearImage radiance = drawRadiance(session);
    EXPECT_EQ(notStorable(radiance), 0) << samples << " samples";
    const auto brightest =
        std::ranges::max_element(radiance.pixels, [](const glm::vec3& a, const glm::vec3& b) { return a.b < b.b; });
    EXPECT_EQ(brightest->b, 65504.0f) << "the glyph should be as bright as can be stored";
  }
}

TEST(LightOnASurface, MatchesTheTracer) {
  const std::filesystem::path file = writeLitScene();
  expectTruth(file, size, 3, trace(file, size, 3));
}

// One pixel of radiance 1 at any exposure.
class OnePixel {
 public:
  OnePixel() {
    options_.validation = false;  // takes longer than 600 pictures of a pixel
    session_.emplace(options_);
  }
  // Returns its 8 bits.
  int shown(double exposure) {
    set(*session_, {{"view.exposure", text(exposure)}});
    return draw(*session_).rgba[0];
  }

 private:
  Options options_ = headless(
      writeScene("one_pixel", "[environment]\nbackground = [1, 1, 1]\n" + cameraText({0, 0, 1}, {0, 0, 0})), {1, 1});
  std::optional<QuietSession> session_;
};

// Returns a number on the straight part of the sRGB curve whose float arithmetic ends exactly between two steps.
std::optional<float> tieAbove(int step) {
  const float wanted = static_cast<float>(step) + 0.5f;
  float x = wanted / 255.0f / 12.92f * (1.0f - 1e-6f);
  for (int i = 0; i < 32; ++i, x = std::nextafter(x, 1.0f)) {
    const volatile float encoded = 12.92f * x;
    if (255.0f * encoded == wanted) {
      return x;
    }
  }
  return std::nullopt;
}

// Products of floats are the same on every device, so what is exactly between two steps is for the program to decide.
TEST(TiesOfEightBits, RoundUpOnTheStraightPart) {
  OnePixel pixel;
  std::array<int, 2> found{};
  for (int step = 0; step < 10; ++step) {
    if (const std::optional<float> tie = tieAbove(step)) {
      EXPECT_EQ(pixel.shown(*tie), step + 1);
      ++found[step % 2];
    }
  }
  EXPECT_GE(found[0], 2) << "above even steps";
  EXPECT_GE(found[1], 2) << "above odd steps";
}

// Powers are not: within 1/4000 of a step around a tie a device may show either.
TEST(TiesOfEightBits, NeighboursRoundToTheNearest) {
  OnePixel pixel;
  for (int step = 0; step < 255; ++step) {
    EXPECT_EQ(pixel.shown(srgbDecode((step + 0.49975) / 255.0)), step);
    EXPECT_EQ(pixel.shown(srgbDecode((step + 0.50025) / 255.0)), step + 1);
  }
}

// A lamp without shadows on a turned mirror, or so near to it that single precision does not tell its side.
TEST(LightOnASurface, LampOnAMirrorMatchesTheTracer) {
  const glm::dvec3 rotation(30, 40, 20);
  const glm::dmat3 turn = rotationFromDegrees(rotation);
  const glm::dvec3 center(0.3, 0.9, -0.4);
  std::vector<std::filesystem::path> files;
  for (const double height : {0.0, 1e-12, 1e-8, 1e-7, 1e-6}) {
    files.push_back(writeScene("lamp_" + text(height),
                               "[environment]\nambient = [0.1, 0.1, 0.1]\n" + cameraText({0, 2, 5}, {0, 1, 0}) +
                                   objectText("MODELS/room.obj", {0, 0, 0}, {0, 0, 0}, 1.0, {0.6, 0.6, 0.6}) +
                                   "[[mirror]]\n" + rectangleText(center, rotation, 1.5, 1.2) +
                                   "casts_light = true\n[[light]]\nposition = " +
                                   text(center + 0.3 * turn[0] + height * turn[2]) + "\nintensity = 4\n"));
  }
  expectTruths(files, {160, 90}, 1);
}

// A box with a lamp on a mirror that casts light, or on several that do not, or so near to them that single precision
// does not tell its side.
std::string boxWithLampOnMirrors(Random& random) {
  const glm::dvec3 lamp = random.inBox(0.7);
  const bool castsLight = random.chance(0.6);
  std::ostringstream out;
  out << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
      << cameraText(lamp + 1.5 * random.direction(), lamp)
      << objectText("MODELS/box.obj", {0, 0, 0}, random.inBox(180.0), 6.0, {0.6, 0.6, 0.6})
      << "[[light]]\nposition = " << text(lamp) << "\nintensity = 4\ncasts_shadow = true\n";
  for (double mirrors = castsLight ? 1.0 : random.uniform(1.0, 4.0); mirrors >= 1.0; mirrors -= 1.0) {
    const glm::dvec3 rotation = random.inBox(180.0);
    const double height = std::stod(random.pick(std::array{"0", "1e-13", "1e-8", "1e-7", "1e-6"}));
    const glm::dvec3 local(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.chance(0.5) ? height : -height);
    out << "[[mirror]]\n"
        << rectangleText(lamp + rotationFromDegrees(rotation) * local, rotation, 1.2, 1.0)
        << "casts_light = " << (castsLight ? "true" : "false")
        << "\ntwo_sided = " << (random.chance(0.4) ? "true" : "false") << "\n";
  }
  return out.str();
}

// Planes that leave the lamp a narrow wedge.
TEST(LightOnASurface, LampInAWedgeMatchesTheTracer) {
  const glm::dvec3 lamp(0.678, 0.626, -0.596);
  std::ostringstream scene;
  scene << "[environment]\nambient = [0.1, 0.1, 0.1]\n"
        << cameraText({-0.569, 1.337, -0.162}, lamp)
        << objectText("MODELS/box.obj", {0, 0, 0}, {17, 77, -81}, 6.0, {0.6, 0.6, 0.6})
        << "[[light]]\nposition = " << text(lamp) << "\nintensity = 4\ncasts_shadow = true\n";
  for (const glm::dvec3 rotation : {glm::dvec3(105.6, -119.26, 19.27), {60.12, -85.25, 25.87}, {-90.6, 120, -44.85}}) {
    scene << "[[mirror]]\n"
          << rectangleText(lamp + rotationFromDegrees(rotation) * glm::dvec3(0.2, 0.1, 0.0), rotation, 1.2, 1.0)
          << "casts_light = false\n";
  }
  const auto file = writeScene("lamp_in_a_wedge", scene.str());
  expectTruth(file, {96, 54}, 1, trace(file, {96, 54}, 1));
}

TEST(LightOnASurface, ShadowsOfLampsOnMirrorsMatchTracer) {
  Random random(11);
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 17; ++i) {
    files.push_back(writeScene("lamp_on_mirrors_" + std::to_string(i), boxWithLampOnMirrors(random)));
  }
  expectTruths(files, {96, 54}, 1);
}

// The eye is near a lamp on a mirror, and what the mirror hides from the lamp is up to a hundred times as far away.
TEST(LightOnASurface, LampsStayHiddenBehindTheirMirror) {
  Random random(13);
  for (int i = 0; i < 8; ++i) {
    const double eyeDistance = random.uniform(0.2, 1.0);
    const double hall = random.uniform(4.0, 30.0);
    const double height = std::array{0.0, 2e-6, 2e-5, 2e-4}[i / 2];  // before the mirror, which hides it from the eye
    const std::string other =
        i % 2 == 0 ? ""
                   : "[[mirror]]\nposition = [0, 1, " + text(-0.7 * hall) + "]\nsize = [4, 2.4]\ncasts_light = true\n";
    const auto file = writeScene(
        "hidden_lamp" + std::to_string(i),
        "[environment]\nambient = [0.1, 0.1, 0.1]\n" +
            cameraText(glm::dvec3(0, 1, 0) + eyeDistance * glm::normalize(glm::dvec3(random.uniform(-1, 1), 0.3, -1)),
                       {0, 0.9, -0.5 * hall}) +
            objectText("MODELS/box.obj", {0, -0.4 * hall, 0}, {0, 0, 0}, 2.0 * hall, {0.6, 0.6, 0.6}) +
            "[[light]]\nposition = " + text(glm::dvec3(0, 1, height)) + "\ncasts_shadow = true\nintensity = " +
            text(hall * hall) + "\n[[mirror]]\nposition = [0, 1, 0]\nsize = [4, 2.4]\n" + other);
    expectTruth(file, {96, 54}, 1, trace(file, {96, 54}, 1));
  }
}

// The eye is in a box that has a lamp on its wall, beside a ball. Where light arrives at a small angle, rounding still
// moves the wall before the lamp: in up to 1.6 % of the pixels, against 47 % if rays end at the lamp.
TEST(LightOnASurface, ShadowsOfLampsOnWallsMatchTracer) {
  Random random(12);
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 rotation = random.inBox(180.0);
    const glm::dmat3 turn = rotationFromDegrees(rotation);
    const double size = random.uniform(3.0, 30.0);
    const auto place = [&](double x, double y, double z) { return turn * (size * glm::dvec3(x, y, z)); };
    const glm::dvec3 lamp = place(random.uniform(-0.3, 0.3), random.uniform(0.2, 0.8), 0.5);
    const glm::dvec3 eye = place(random.uniform(-0.3, 0.3), random.uniform(0.2, 0.8), random.uniform(-0.4, 0.2));
    const std::filesystem::path file = writeScene(
        "lamp_on_wall_" + std::to_string(i),
        "[environment]\nambient = [0.1, 0.1, 0.1]\n" + cameraText(eye, eye + random.direction()) +
            objectText("MODELS/box.obj", {0, 0, 0}, rotation, size, {0.6, 0.6, 0.6}) +
            objectText("MODELS/sphere.obj", place(0.1, 0.4, 0.25), {0, 0, 0}, 0.1 * size, {0.3, 0.6, 0.6}) +
            "[[light]]\nposition = " + text(lamp) + "\ncasts_shadow = true\nintensity = " + text(size * size) + "\n");
    const PictureSize picture{96, 54};
    const Image8 expected = trace(file, picture, 1).picture;
    EXPECT_LE(difference(draw(truthOptions(file, picture, 1)), expected, 2).share(), 0.02) << file;
  }
}

// A bright light in the plane of an object's quad, of a mirror's front or back, or of a quad that its image lights by
// way of a mirror: turned anywhere, as a part of a large plane, far from the origin, and seen in another mirror.
std::string lightInAPlane(Random& random, int kind, bool shadows) {
  const glm::dvec3 rotation = random.inBox(180.0);
  const glm::dmat3 turn = rotationFromDegrees(rotation);
  const glm::dvec3 center = random.inBox(random.chance(0.5) ? 1.0 : 1e5);
  const auto at = [&](double x, double y, double z) { return center + turn * glm::dvec3(x, y, z); };
  const bool back = kind == 2;
  std::ostringstream scene;
  scene << "[environment]\nambient = [0.05, 0.05, 0.05]\nbackground = [0.1, 0.2, 0.3]\n"
        << cameraText(at(0.9, 0.3, back ? -1.6 : 1.6), at(0.1, 0.1, 0))
        << "[[light]]\nposition = " << text(at(0.3, -0.2, 0))
        << "\nintensity = 5000\ncasts_shadow = " << (shadows ? "true\n" : "false\n");
  if (kind == 0 || kind == 3) {
    const double size = random.chance(0.5) ? 1.0 : random.uniform(1.0, 200.0);
    const glm::dvec3 corner = size > 1.0 ? at(0.8 * size, -0.7 * size, 0) : center;
    scene << objectText("quad.obj", corner, rotation, size, {0.7, 0.6, 0.5}) << "specular = [0.3, 0.3, 0.3]\n";
  } else {
    scene << "[[mirror]]\n"
          << rectangleText(center, rotation, 2.0, 2.0) << "reflectance = [0.3, 0.3, 0.3]\n"
          << "base_color = [0.7, 0.7, 0.2]\nback_color = [0.7, 0.2, 0.2]\n";
  }
  const double low = back ? -1.0 : -0.5;
  scene << "[[mirror]]\ncasts_light = " << (kind == 3 ? "true\n" : "false\n")
        << polygonText({at(-1, 1.2, low), at(1, 1.2, low), at(1, 1.2, low + 1.5), at(-1, 1.2, low + 1.5)});
  return scene.str();
}

TEST(LightOnASurface, InItsPlaneAddsNoHalo) {
  writeQuad();
  Random random(5);
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 16; ++i) {
    files.push_back(writeScene("plane_light_" + std::to_string(i), lightInAPlane(random, i % 4, i / 4 % 2 == 1)));
  }
  const Options options = truthOptions(files.front(), {96, 54}, 2);
  Studio studio(options);
  studio.settings.effects.rays = RayMethod::software;
  for (size_t i = 0; i < files.size(); ++i) {
    // Unless all are drawn, each pair of kind, shadows and method comes once.
    if (!fullTests() && (i + i / 4 + i / 8) % 2 != 0) {
      continue;
    }
    studio.settings.reflection.method = i >= 8 ? ReflectionMethod::rays : ReflectionMethod::automatic;
    expectTruth(studio, files[i], trace(files[i], {96, 54}, 2));
  }
}

// A quad anywhere about a light in its plane, over a floor and beside a ball. Seen from points near that plane,
// rounding decides where a ray to the light would meet the quad.
TEST(LightOnASurface, HoldsBackNoLight) {
  writeQuad();
  Random random(9);
  std::optional<Studio> studio;
  for (int i = 0; i < (fullTests() ? 40 : 4); ++i) {
    const glm::dvec3 light = {random.uniform(-1.2, 1.2), random.uniform(0.2, 1.0), random.uniform(-0.8, 0.8)};
    const auto file =
        writeScene("light_in_a_quad_" + std::to_string(i),
                   "[environment]\nambient = [0.05, 0.05, 0.05]\nbackground = [0.2, 0.25, 0.3]\n" +
                       cameraText({0, 2, 4}, {0, 0, 0}) +
                       objectText("quad.obj", {0, -1.2, 0}, {-90, 0, 0}, 12.0, {0.7, 0.7, 0.7}) +
                       objectText("quad.obj", light, random.inBox(180.0), random.uniform(1.0, 2.0), {0.3, 0.7, 0.3}) +
                       objectText("MODELS/sphere.obj", {0.1, -0.4, 0}, {0, 0, 0}, 0.7, {0.7, 0.5, 0.4}) +
                       "[[light]]\nposition = " + text(light) + "\nintensity = 40\nglow = 0\ncasts_shadow = true\n");
    if (!studio) {
      studio.emplace(truthOptions(file, {96, 54}, 1));
    }
    expectTruth(*studio, file, trace(file, {96, 54}, 1));
  }
}

// In the space of so small a body the square of the light's distance is no float.
TEST(LightOnASurface, FarLightsLeaveShadowsOfSmallBodies) {
  writeQuad();
  const auto file = writeScene(
      "small_body", "[environment]\nambient = [0.05, 0.05, 0.05]\n" + cameraText({0, 2e-5, 4e-5}, {0, 0, 0}) +
                        objectText("quad.obj", {0, -1e-5, 0}, {-90, 0, 0}, 1e-4, {0.7, 0.7, 0.7}) +
                        objectText("MODELS/sphere.obj", {0, 0, 0}, {0, 0, 0}, 5e-6, {0.7, 0.5, 0.4}) +
                        "[[light]]\nposition = [2e14, 9e14, 1e14]\nintensity = 3e30\nglow = 0\ncasts_shadow = true\n");
  const Truth truth = trace(file, {96, 54}, 1);
  const Image8 picture = draw(truthOptions(file, {96, 54}, 1));
  expectAlike(picture, truth.picture, 2, "small_body");
}

class AnySize : public testing::TestWithParam<PictureSize> {};

// A mirror over all of the view shows the sky; a body would have edges, and a pixel here is metres wide.
TEST_P(AnySize, MatchesTheTracer) {
  const std::filesystem::path file = writeScene("any_size", R"(
[environment] sky = { zenith = [0.1, 0.2, 0.9], horizon = [0.9, 0.8, 0.3], ground = [0.2, 0.5, 0.1] }
[camera] position = [0, 1, 2], target = [0.1, 0.3, -2]
[[mirror]] position = [0, 0, -1], rotation = [-30, 10, 0], size = [1e6, 1e6]
)");
  const Truth truth = trace(file, GetParam(), 3);
  EXPECT_GT(share(truth.traced.mirrorDepth, 1), 0.2);
  const Image8 picture = draw(truthOptions(file, GetParam(), 3));
  ASSERT_EQ(picture.width, GetParam().width);
  ASSERT_EQ(picture.height, GetParam().height);
  EXPECT_EQ(difference(picture, truth.picture, 2).over, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, AnySize, testing::Values(PictureSize{1, 1}, PictureSize{2, 1}, PictureSize{1, 720}, PictureSize{8192, 1}),
    [](const auto& info) { return std::to_string(info.param.width) + "x" + std::to_string(info.param.height); });

// Runs the window until a condition holds. Only a failure takes a minute.
template <typename Condition>
bool runUntil(Demo& demo, const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition() && std::chrono::steady_clock::now() < end) {
    demo.step();
  }
  return condition();
}

Options windowOptions() {
  Options options;
  options.scene = sceneFile("single_plane").string();
  options.size = {64, 48};
  options.validation = true;
  options.window.presentMode = PresentMode::immediate;
  options.settings = {{"debug.check_finite", "true"}};
  return options;
}

TEST(TimeSteps, SuspendDoesNotAdvanceAnimation) {
  const test::VirtualDisplay display;
  Demo demo(windowOptions());
  ASSERT_TRUE(runUntil(demo, [&] { return demo.framesDrawn() > 2; }));
  const double before = demo.shown().playback.time;
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  const int drawn = demo.framesDrawn();
  ASSERT_TRUE(runUntil(demo, [&] { return demo.framesDrawn() > drawn; }));
  EXPECT_GE(demo.shown().playback.time, before);
  EXPECT_LT(demo.shown().playback.time - before, 0.5);
}

TEST(AnySizeOfWindow, OnePixelRunsAndMinimisedPauses) {
  const test::VirtualDisplay display;
  Demo demo(windowOptions());
  const auto until = [&](const auto& condition) { return runUntil(demo, condition); };
  ASSERT_TRUE(until([&] { return demo.framesDrawn() > 2; }));
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(1, 300), std::pair(64, 48)}) {
    demo.window().resize(width, height);
    const VkExtent2D wanted{static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
    EXPECT_TRUE(until([&] {
      const VkExtent2D extent = demo.renderer().displayExtent();
      return extent.width == wanted.width && extent.height == wanted.height;
    })) << width
        << "x" << height;
    const int drawn = demo.framesDrawn();
    EXPECT_TRUE(until([&] { return demo.framesDrawn() > drawn + 3; }));
  }
  demo.window().iconify();
  ASSERT_TRUE(until([&] { return demo.window().paused(); }));
  const int drawn = demo.framesDrawn();
  for (int i = 0; i < 5; ++i) {
    demo.step();
  }
  EXPECT_EQ(demo.framesDrawn(), drawn);
  demo.window().restore();
  EXPECT_TRUE(until([&] { return demo.framesDrawn() > drawn + 3; }));
  EXPECT_EQ(demo.device().validationMessages(), 0);
  EXPECT_EQ(demo.nonFinite(), 0u);
}

}  // namespace
}  // namespace speculum::finite_pictures
