// Hard cases of whole pictures: far from the origin, turned inside out, mirrors in mirrors, seams, lights on surfaces.
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum::scene_pictures {
namespace {

using namespace testing_support;

constexpr PictureSize size{320, 180};

// Returns everything that a scene can hold, moved by `at`: turning objects with textures and highlights, copies, a
// model whose own vertices are 1e7 m away, an orbiting camera and light, mirrors in mirrors, one of them a polygon.
std::string fullScene(const glm::dvec3& at) {
  std::string obj;
  for (const glm::dvec3& p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)}) {
    const glm::dvec3 v = p + glm::dvec3(1e7, 2e7, -1e7);
    obj += "v " + text(v.x) + " " + text(v.y) + " " + text(v.z) + "\n";
  }
  writeModel("far_tetrahedron.obj", obj + "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto p = [&](double x, double y, double z) { return text(at + glm::dvec3(x, y, z)); };
  const std::string object = "[[object]] model = ";
  return "[environment] ambient = [0.1, 0.1, 0.1], sky = { zenith = [0.1, 0.2, 0.9], horizon = [0.9, 0.8, 0.3], "
         "ground = [0.2, 0.5, 0.1] }\n[camera] orbit_speed = 4, position = " +
         p(0.2, 1.4, 4) + ", target = " + p(0, 1, -1) + "\n" + object + "'MODELS/chequer.obj', scale = [2, 1, 2], " +
         "position = " + p(0, 0, 0) + "\n" + object + "'MODELS/teapot.obj', spin = [0, 35, 0], shininess = 200, " +
         "specular = [0.5, 0.5, 0.5], position = " + p(-1, 0.5, 0.3) + "\n" + object +
         "'MODELS/box.obj', scale = 0.4, copies = { count = 3, step = [0.6, 0.1, -0.35] }, position = " +
         p(0.4, 0.5, 0.5) + "\n" + object +
         "'far_tetrahedron.obj', color = [0.9, 0.4, 0.1], position = " + p(0.5 - 1e7, 1.5 - 2e7, 1e7) +
         "\n[[light]] intensity = 12, position = " + p(1, 2.5, 1) + ", orbit = { center = " + p(0, 2, 0) +
         ", axis = [0.3, 1, 0], speed = 50 }\n" +
         "[[mirror]] name = 'back', size = [4, 3], rotation = [2, 8, 0], reflectance = [0.9, 0.95, 0.9], " +
         "base_color = [0.1, 0, 0], position = " + p(0, 1.5, -2) + "\n[[mirror]] name = 'turning', size = [1, 1.5], " +
         "spin = [0, 20, 0], two_sided = true, position = " + p(1.4, 1.2, -0.5) + "\n[[mirror]] polygon = [" +
         p(-3, 0, 5) + ", " + p(-3, 3, 5) + ", " + p(3, 3, 5.5) + ", " + p(3, 0, 5.5) + "]\n";
}

TEST(SceneMovedFar, PictureEqualsThatAtTheOrigin) {
  constexpr double time = 3.7;
  const Image8 near = draw(headless(writeScene("at_origin", fullScene(glm::dvec3(0.0))), size), time);
  for (const glm::dvec3& at : {glm::dvec3(1e3, -2e3, 1e3), 1e7 * glm::dvec3(1.0, -0.7, 0.9)}) {
    const Image8 far = draw(headless(writeScene("far_away", fullScene(at)), size), time);
    const PictureAgreement d = difference(far, near, 1);
    EXPECT_EQ(d.over, 0) << "largest difference " << d.largest << "/255, " << at.x << " m away";
    expectAlike(far, near, 1, "moved_far");
  }
}

// Two facing mirrors, and a body with flat faces whose outside is given by the winding alone.
std::string turnedBody(const glm::dvec3& scale) {
  return R"([environment] background = [0.1, 0.2, 0.3]
[camera] position = [0.6, 1.3, 2.2], target = [-0.3, 1, -2]
[[object]] model = "body.obj", position = [-0.7, 0.7, -1.3], rotation = [20, 40, 10], color = [0.8, 0.7, 0.6]
  copies = { count = 2, step = [0.3, 0.9, 0.2] }
  scale = )" +
         text(scale) + R"(
[[light]] position = [0.5, 2, 2], intensity = 12
[[light]] position = [-1, 1.5, -2], intensity = 8, color = [0.3, 1, 0.5]
[[mirror]] position = [0, 1, -2.5], size = [6, 4]
[[mirror]] position = [0, 1, 2.5], rotation = [0, 180, 0], size = [6, 4]
)";
}

TEST(NegativeScaleAndBounces, MatchesTheTracer) {
  writeModel(
      "body.obj",
      "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\nf 1 4 3 2\nf 5 6 7 8\n"
      "f 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n");
  std::vector<std::filesystem::path> files;
  for (const glm::dvec3& scale :
       {glm::dvec3(0.3), glm::dvec3(-0.3, 0.3, 0.4), glm::dvec3(0.3, -0.4, -0.3), glm::dvec3(-0.3)}) {
    files.push_back(writeScene("turned_body_" + std::to_string(files.size()), turnedBody(scale)));
  }
  EXPECT_GT(share(trace(files.front(), size, 4).traced.mirrorDepth, 3), 0.01) << "too few bounces in view";
  expectTruths(files, size, 4);
}

const std::string nestedPrefix = R"(
[environment] sky = { zenith = [0.1, 0.2, 0.9], horizon = [0.9, 0.8, 0.3], ground = [0.2, 0.5, 0.1] }
  ambient = [0.2, 0.2, 0.2]
[camera] position = [0.5, 1.2, 2.6], target = [-0.2, 1, -2]
[settings] "reflection.max_depth" = 5, "reflection.max_passes" = 2000, "reflection.min_pixels" = 0
[[light]] position = [0, 3, 1], intensity = 15
[[object]] model = "MODELS/torus_knot.obj", position = [-0.4, 1, -1.9]
[[object]] model = "MODELS/queen.obj", position = [1.5, 0.4, 0.3]
[[object]] model = "MODELS/sphere.obj", position = [-1.9, 1, 0.5]
[[object]] model = "MODELS/vase.obj", position = [0.2, 0.2, 2.9]
)";

// A triangle of mirrors around the scene and one inside it; bodies stand across the planes of all of them.
const std::array<std::string, 4> nestedMirrors = {
    "[[mirror]] name = 'a', position = [0, 1, -2], size = [5, 3]\n",
    "[[mirror]] name = 'b', position = [-2, 1, 0.5], rotation = [0, 70, 3], size = [5, 3], reflectance = [0.9, 0.8, "
    "0.7]\n",
    "[[mirror]] name = 'c', position = [2, 1, 0.5], rotation = [-4, -65, 0], size = [5, 3]\n",
    "[[mirror]] name = 'd', position = [0, 1, 3.2], rotation = [0, 180, 0], size = [3, 3], two_sided = true\n"};

std::filesystem::path nestedScene(const std::string& name, const std::array<int, 4>& order) {
  std::string scene = nestedPrefix;
  for (const int i : order) {
    scene += nestedMirrors[i];
  }
  return writeScene(name, scene);
}

// A clip plane or a winding left over from another pass would make pictures depend on the order of passes.
TEST(NestedMirrors, OrderOfPassesLeavesNoTrace) {
  const Options options = headless(nestedScene("nested", {0, 1, 2, 3}), size);
  Studio studio(options);
  const Image8 expected = studio.draw();
  for (const std::array<int, 4>& order : {std::array{3, 2, 1, 0}, std::array{1, 3, 0, 2}}) {
    studio.show(loadScene(nestedScene("nested_other", order)));
    EXPECT_EQ(difference(studio.fresh(), expected, 0).largest, 0);
  }
}

TEST(FacingMirrorsAtDepth32, MatchesTheTracer) {
  for (const char* scene : {"scenes/facing_mirrors.toml", "scenes/hard/depth_32.toml"}) {
    const std::filesystem::path file = sourceFile(scene);
    const Truth truth = trace(file, size, 32);
    EXPECT_GE(*std::ranges::max_element(truth.traced.mirrorDepth), 25);
    expectTruth(file, size, 32, truth);
  }
}

// The eye sees a small mirror before a white wall. It shows another behind the eye, which shows the wall and has the
// black background behind it.
std::filesystem::path mirrorInMirror(double degrees, const std::string& reflectance, const std::string& more = "") {
  writeQuad();
  const double distance = 1.0 / std::tan(glm::radians(0.5 * degrees));  // where the view is two metres high
  const double side = std::min(0.1 + 0.1 * distance, 1.0);
  const double otherSide = 12.0 + 0.3 * distance;
  const glm::dvec3 middle(0.03 * side, 0.02 * side, 0.0);
  return writeScene("angle_of_view_" + std::to_string(static_cast<int>(degrees)),
                    cameraText(middle + glm::dvec3(0, 0, distance), middle, {0.1, 1, 0}) + "vertical_fov = " +
                        text(degrees) + "\n" + objectText("quad.obj", {0, 0, -1}, {0, 0, 0}, 5000, {0, 0, 0}) +
                        "specular = [0, 0, 0]\nemission = [1, 1, 1]\n[[mirror]]\n" +
                        rectangleText({0, 0, 0}, {1, 2, 0}, side, side) + "reflectance = " + reflectance +
                        "\n[[mirror]]\n" + rectangleText({0, 0, 2 * distance + 3}, {-5, 180, 0}, otherSide, otherSide) +
                        "reflectance = " + reflectance + "\n" + more);
}

constexpr std::array anglesOfView{1.0, 170.0};

TEST(AnglesOfView, MatchTheTracer) {
  for (const double degrees : anglesOfView) {
    const auto file =
        mirrorInMirror(degrees, "[0.9, 0.8, 0.7]",
                       objectText("MODELS/torus_knot.obj", {0.4, 0.1, 0.05}, {20, 30, 0}, 0.5, {0.8, 0.3, 0.1}) +
                           objectText("MODELS/teapot.obj", {-0.5, -0.2, 0.05}, {0, 60, 0}, 0.4, {0.1, 0.4, 0.8}) +
                           "[[light]]\nposition = [0, 3, 1]\nintensity = 10\n");
    expectTruth(file, size, 6, trace(file, size, 6));
  }
}

// Where a pixel is wide, lookups read far beyond what is seen of an image.
TEST(AnglesOfView, ImagesOfImagesShowNoBackground) {
  for (const double degrees : anglesOfView) {
    QuietSession session(headless(mirrorInMirror(degrees, "[1, 1, 1]"), size,
                                  {{"reflection.max_depth", "12"}, {"reflection.min_pixels", "0"}}));
    for (const char* scale : {"0.25", "0.5", "1"}) {
      for (const char* samples : {"1", "4"}) {
        set(session, {{"reflection.scale", scale}, {"reflection.samples", samples}, {"view.samples", samples}});
        const auto isDark = [](const glm::vec3& pixel) { return pixel.r < 0.999f; };
        EXPECT_EQ(std::ranges::count_if(drawRadiance(session).pixels, isDark), 0)
            << degrees << " degrees, scale " << scale << ", " << samples << " samples";
      }
    }
  }
}

// A white room lit by ambient light alone. Two walls are mirrors that meet at an edge; the floor, the other walls and a
// block touch them. Any gap shows the black background behind.
std::filesystem::path seamScene(unsigned seed) {
  writeModel("touching.obj",
             "v -1.5 0 -1\nv 30 0 -1\nv 30 0 30\nv -1.5 0 30\nv -1.5 20 -1\nv 30 20 -1\nv 30 20 30\nv -1.5 20 30\n"
             "v 0.5 0 -1\nv 1 0 -1\nv 1 0 -0.5\nv 0.5 0 -0.5\nv 0.5 0.5 -1\nv 1 0.5 -1\nv 1 0.5 -0.5\nv 0.5 0.5 -0.5\n"
             "f 1 4 3 2\nf 5 6 7 8\nf 2 3 7 6\nf 3 4 8 7\n"
             "f 13 16 15 14\nf 9 13 14 10\nf 12 11 15 16\nf 9 12 16 13\nf 10 14 15 11\n");
  Random random(seed);
  const auto between = [&](double low, double high) { return random.uniform(low, high); };
  const glm::dvec3 eye(between(0.5, 3.5), between(0.3, 2.5), between(0.5, 3.5));
  const glm::dvec3 target(between(-1.0, 0.5), between(0.0, 0.7), between(-1.0, 0.5));
  return writeScene("seams", "[environment]\nambient = [1, 1, 1]\n" + cameraText(eye, target, {0.05, 1, 0}) + R"(
[settings] "reflection.max_depth" = 6
  "reflection.max_passes" = 5000, "reflection.min_pixels" = 0
[[object]] model = "touching.obj", color = [1, 1, 1]
[[mirror]] name = "wall", polygon = [[-1.5, 0, -1], [30, 0, -1], [30, 20, -1], [-1.5, 20, -1]]
  reflectance = [1, 1, 1]
[[mirror]] name = "side", polygon = [[-1.5, 0, 30], [-1.5, 0, -1], [-1.5, 20, -1], [-1.5, 20, 30]]
  reflectance = [1, 1, 1]
)");
}

constexpr PictureSize seamSize{640, 360};

// Counts pixels that show some of the background.
int darkPixels(Session& session, const std::string& samples, const std::string& imageSamples) {
  set(session, {{"view.samples", samples}, {"reflection.samples", imageSamples}});
  const auto isDark = [](const glm::vec3& pixel) { return pixel.r < 0.999f; };
  return static_cast<int>(std::ranges::count_if(drawRadiance(session).pixels, isDark));
}

TEST(SeamsOfMirrorsAndBodies, NoPixelShowsTheBackground) {
  for (unsigned view = 0; view < 5; ++view) {
    QuietSession session(headless(seamScene(view), seamSize));
    for (const std::string samples : {"1", "4"}) {
      for (const std::string imageSamples : {"1", "4"}) {
        EXPECT_LE(darkPixels(session, samples, imageSamples), samples == imageSamples ? 0 : 3)
            << samples << " and " << imageSamples << " samples, view " << view;
      }
    }
  }
}

// Draws two mirrors in one plane with a gap between them, a metre from the eye. They show a white wall behind it.
int darkPixelsBetween(double gapMetres) {
  writeQuad();
  const double h = 0.5 * gapMetres;
  const std::string mirror = "[[mirror]]\nreflectance = [1, 1, 1]\n";
  QuietSession session(headless(
      writeScene("gap", "[environment]\nambient = [1, 1, 1]\n" + cameraText({0, 0, 1}, {0, 0, 0}, {0.2718, 1, 0}) +
                            objectText("quad.obj", {0, 0, 2}, {0, 180, 0}, 50, {1, 1, 1}) + mirror +
                            polygonText({{-5, -5, 0}, {-h, -5, 0}, {-h, 5, 0}, {-5, 5, 0}}) + mirror +
                            polygonText({{h, -5, 0}, {5, -5, 0}, {5, 5, 0}, {h, 5, 0}})),
      seamSize));
  return darkPixels(session, "4", "4");
}

TEST(SeamsOfMirrorsAndBodies, OnlyRoundingGapsAreClosed) {
  const double pixel = 2.0 * std::tan(glm::radians(30.0)) / 360.0;
  EXPECT_EQ(darkPixelsBetween(pixel / 200), 0);
  EXPECT_GT(darkPixelsBetween(pixel), 300);
}

}  // namespace
}  // namespace speculum::scene_pictures
