// Curved mirrors that look up environment maps, against the ray tracer: larger faces and the correction by a box lower
// the error. effects_ledger.cpp tests their cost and its release.
#include "plan/reuse_support.hpp"
#include "truth_support.hpp"

namespace speculum::environment_pictures {
namespace {

using namespace testing_support;

constexpr PictureSize size{240, 180};

std::string block(const char* position, const char* scale, const char* color, const char* copies = "") {
  return std::string("[[object]]\nmodel = \"MODELS/block.obj\"\nspecular = [0, 0, 0]\nposition = ") + position +
         "\nscale = " + scale + "\ncolor = " + color + "\n" + copies;
}

// A room with a pattern on its floor, ceiling and walls, and a ball off its middle. There are no highlights, because a
// map shows them as seen from its centre. `rest` is added to the scene.
std::filesystem::path room(const std::string& name, const std::string& rest = "") {
  const char* alongX = "copies = { count = 7, step = [0.8, 0, 0] }\n";
  const char* alongZ = "copies = { count = 7, step = [0, 0, 0.8] }\n";
  return writeScene(
      "environment_" + name,
      R"(
[environment] background = [0.25, 0.3, 0.4], ambient = [0.2, 0.2, 0.2]
[camera] position = [-0.6, 1.3, 2.4], target = [0.3, 1.1, 0.2], vertical_fov = 36
[settings] "reflection.max_depth" = 1
[[object]] name = "ball", model = "MODELS/sphere.obj", position = [0.3, 1.1, 0.2], scale = 1.2
  mirror = { reflectance = [0.9, 0.9, 0.9] }
[[light]] position = [-1, 2.6, 1], intensity = 18, glow = 0
)" + block("[0, -0.2, 0]", "[6.4, 0.2, 6.4]", "[0.5, 0.5, 0.5]") +
          block("[-2.4, 0, 0]", "[0.4, 0.002, 6]", "[0.05, 0.05, 0.05]", alongX) +
          block("[0, 3, 0]", "[6.4, 0.2, 6.4]", "[0.8, 0.8, 0.7]") +
          block("[-3.1, 0, 0]", "[0.2, 3, 6.4]", "[0.7, 0.2, 0.1]", "copies = { count = 2, step = [6.2, 0, 0] }\n") +
          block("[0, 0, -3.1]", "[6.4, 3, 0.2]", "[0.1, 0.3, 0.7]", "copies = { count = 2, step = [0, 0, 6.2] }\n") +
          block("[-2.4, 0.5, -2.999]", "[0.4, 2, 0.002]", "[0.9, 0.8, 0.2]", alongX) +
          block("[-2.4, 0.5, 2.999]", "[0.4, 2, 0.002]", "[0.1, 0.1, 0.1]", alongX) +
          block("[2.999, 0.5, -2.4]", "[0.002, 2, 0.4]", "[0.9, 0.9, 0.9]", alongZ) +
          block("[-2.999, 0.5, -2.4]", "[0.002, 2, 0.4]", "[0.1, 0.6, 0.1]", alongZ) + rest);
}

Options mapped(const std::filesystem::path& file, SettingList more = {}) {
  Options options = headless(
      file, size, {{"effects.curved_lookup", "environment"}, {"view.samples", "1"}, {"reflection.samples", "1"}});
  set(options, more);
  return options;
}

TEST(EnvironmentMaps, LargerFacesAndTheBoxReduceError) {
  const std::filesystem::path file = room("error");
  const Truth truth = trace(file, size, 1);
  QuietSession session(mapped(file, {{"effects.curved", "false"}}));
  std::vector<bool> ball;
  const Image8 without = draw(session);
  for (size_t i = 0; i < without.rgba.size(); i += 4) {
    const auto differs = [&](size_t channel) {
      return std::abs(without.rgba[channel] - truth.picture.rgba[channel]) > 4;
    };
    ball.push_back(differs(i) || differs(i + 1) || differs(i + 2));
  }
  ASSERT_GT(std::ranges::count(ball, true), 4000);
  const auto measured = [&](int faces, const char* box) {
    set(session, {{"effects.curved", "true"},
                  {"effects.environment_size", std::to_string(faces)},
                  {"effects.environment_box", box}});
    const double e = rootMeanSquare(drawRadiance(session), truth.traced.image, ball);
    std::printf("faces of %4d texels, box %-5s: RMSE %.4f\n", faces, box, e);
    return e;
  };
  double before = 1.0;
  for (const int faces : {16, 32, 64, 128, 256}) {
    const double e = measured(faces, "true");
    EXPECT_LT(e, 0.85 * before);
    before = e;
  }
  EXPECT_LT(before, 0.2 * measured(256, "false"));
  EXPECT_LT(measured(64, "true"), 0.5 * measured(64, "false"));
}

// A ball before the sky looks up nothing but the background, which is exact.
TEST(EnvironmentMaps, ShowTheSkyExactly) {
  const std::filesystem::path file = writeScene("environment_sky", R"(
[environment] sky = { zenith = [0.1, 0.2, 0.9], horizon = [0.9, 0.8, 0.6], ground = [0.2, 0.15, 0.1] }
[camera] position = [1e5, 1.2, 3], target = [1e5, 1, 0]
[[object]] model = "MODELS/sphere.obj", position = [1e5, 1, 0], scale = 1.6
  mirror = { reflectance = [0.9, 0.8, 0.7], fresnel = "schlick", base_color = [0.1, 0, 0] }
[[light]] position = [1e5, 4, 3], intensity = 9, glow = 0
)");
  expectAlike(draw(mapped(file, {{"effects.environment_size", "16"}})), trace(file, size, 1).picture, 2,
              "environment_sky");
}

// A planar mirror in a map reflects the background, whose color differs from that behind the mirror. The map sees all
// of the floor along the same directions as the ball does, but for its horizon.
TEST(EnvironmentMaps, ShowPlanarMirrorsBeforeTheSky) {
  const std::filesystem::path file = writeScene("environment_mirror", R"(
[environment] sky = { zenith = [0.1, 0.2, 0.9], horizon = [0.9, 0.8, 0.6], ground = [0.2, 0.15, 0.1] }
  ambient = [1, 1, 1]
[camera] position = [0, 1.6, 4], target = [0, 1, 0]
[settings] "reflection.max_depth" = 1
[[object]] model = "MODELS/sphere.obj", position = [0, 1, 0], scale = 1.6
  mirror = { reflectance = [0.9, 0.8, 0.7] }
[[mirror]] position = [0, -2, 0], rotation = [-90, 0, 0], size = [4000, 4000], reflectance = [0.3, 0.9, 0.5]
  base_color = [0.5, 0.1, 0]
)");
  const Image8 picture = draw(mapped(file, {{"effects.environment_box", "false"}}));
  const PictureAgreement agreement = difference(picture, trace(file, size, 1).picture, 3);
  EXPECT_LE(agreement.share(), 0.02) << agreement.over << " pixels, up to " << agreement.largest;
}

// Where rays light the layer under a reflection, the reflection is added to it afterwards: once, though both sides of
// the sheet have the same depth.
TEST(EnvironmentMaps, ReflectionsAreAddedOnce) {
  std::ofstream(sceneDirectory() / "sheet.obj")
      << "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\nf 3 2 1\nf 4 3 1\n";
  const std::filesystem::path file = writeScene("environment_sheet", R"(
[environment] sky = { zenith = [0.1, 0.2, 0.6], horizon = [0.5, 0.4, 0.3], ground = [0.1, 0.1, 0.05] }
[camera] position = [0, 1.6, 4], target = [0, 0.6, 0]
[[object]] model = "sheet.obj", position = [0, 1, 0]
  mirror = { reflectance = [0.5, 0.5, 0.5], base_color = [0.2, 0.2, 0.2] }
[[light]] position = [1, 3, 2], intensity = 10, casts_shadow = true
)");
  QuietSession session(mapped(file, {}));
  const Image8 rays = draw(session);
  set(session, {{"effects.shadows", "false"}});
  expectAlike(rays, draw(session), 2, "environment_sheet");
}

TEST(EnvironmentMaps, ShowTheBackgroundAtADepthLimit) {
  const std::filesystem::path file = room("limit");
  QuietSession session(mapped(file, {{"reflection.max_depth", "0"}}));
  const Image8 environment = draw(session);
  set(session, {{"effects.curved_lookup", "traced"}});
  expectAlike(environment, draw(session), 2, "environment_limit");
}

TEST(EnvironmentMaps, ListTheirFaces) {
  QuietSession session(mapped(room("faces")));
  const std::vector<std::string> names = drawnMaps("environment of ", session);
  ASSERT_EQ(names.size(), 6u);
  EXPECT_EQ(names[0], "environment of object 'ball' +x");
  EXPECT_EQ(names[5], "environment of object 'ball' -z");
}

// Faces, like the main view, have no path of mirrors, but are no parents of mirror passes.
TEST(EnvironmentMaps, AreNoParentsOfMirrorPasses) {
  Session session(mapped(room("parents", "[[mirror]]\nposition = [-0.9, 1.4, -2.9]\nsize = [1, 1]\n")));
  draw(session);
  const nlohmann::ordered_json passes = frameStats(session).at("passes");
  for (const auto& pass : passes) {
    EXPECT_GT(pass["draws"], 0) << pass["name"];
  }
  const auto mirror = std::ranges::find_if(passes, [](const auto& p) { return p.at("depth") == 0; });
  ASSERT_NE(mirror, passes.end());
  EXPECT_EQ(passes.at(mirror->at("parent").get<size_t>()).at("name"), "main view");
}

// Draws moving scenes with and without reuse: the bytes are the same.
TEST(EnvironmentMaps, ReuseChangesNoByte) {
  const std::filesystem::path file = writeScene("environment_skipping", R"(
[environment] background = [0.25, 0.3, 0.4], ambient = [0.2, 0.2, 0.2]
[camera] position = [-0.6, 1.3, 2.4], target = [0.3, 1.1, 0.2]
[[object]] model = "MODELS/sphere.obj", position = [0.3, 1.1, 0.2], mirror = {}
[[object]] model = "MODELS/teapot.obj", position = [-1.2, 0, 0], mirror = { base_color = [0.2, 0, 0] }
[[object]] model = "MODELS/king.obj", position = [1.4, 0, 1], spin = [0, 90, 0]
[[light]] position = [1, 2, 1.5], intensity = 9, casts_shadow = true
[[mirror]] name = "wall", position = [0, 1.4, -2.98], size = [4, 2], casts_light = true
)");
  Options options = mapped(file, {{"effects.environment_size", "32"}});
  options.size = {80, 60};
  QuietSession session(options);
  for (const char* interval : {"1", "3"}) {
    set(session, {{"effects.environment_interval", interval}, {"reflection.skip_unchanged", "true"}});
    session.restart();
    int captures = 0;
    std::vector<std::vector<uint8_t>> pictures;
    const std::vector<double> times = {0.0, 0.0, 0.1, 0.2, 0.2, 0.2, 0.2, 0.0};
    for (const double time : times) {
      captures += static_cast<int>(drawnMaps("environment of ", session, time).size()) / 6;
      pictures.push_back(session.picture().rgba);
    }
    if (std::string(interval) == "1") {
      set(session, {{"reflection.skip_unchanged", "false"}});
      session.restart();
      std::map<double, std::vector<uint8_t>> rendered;
      for (size_t i = 0; i < times.size(); ++i) {
        if (!rendered.count(times[i])) {
          EXPECT_EQ(drawnMaps("environment of ", session, times[i]).size(), 12u);
          rendered[times[i]] = session.picture().rgba;
        }
        EXPECT_EQ(rendered[times[i]], pictures[i]) << "frame " << i;
      }
      EXPECT_EQ(captures, 8) << "two maps in the four frames in which the king had turned";
    } else {
      EXPECT_LT(captures, 8);
      // Nothing moves now. Every map becomes due, and the mirror that shows the maps is rendered after them.
      session.restart();
      drawnMaps("environment of ", session, 0.2);
      EXPECT_EQ(pictures[6], session.picture().rgba);
    }
  }
}

}  // namespace
}  // namespace speculum::environment_pictures
