// Skipping hidden mirrors, clusters and unread parts of mirror images does not change pictures.
#include <nlohmann/json.hpp>

#include "cli/stats.hpp"
#include "picture_support.hpp"
#include "plan/occluder_shapes.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "studio.hpp"
#include "test_headers.hpp"

namespace speculum::skipping_pictures {
namespace {

using namespace testing_support;

constexpr PictureSize size{160, 90};
constexpr int cells = 3;          // along each side of the floor
constexpr double cellSide = 3.0;  // metres

// Rooms on a lattice, with walls between most of them and a mirror on each side of some walls.
std::filesystem::path roomsScene() {
  std::ostringstream toml;
  toml << R"(
[environment] sky = { zenith = [0.1, 0.2, 0.5], horizon = [0.6, 0.5, 0.4], ground = [0.1, 0.1, 0.1] }
  ambient = [0.3, 0.3, 0.3]
[camera] position = [1.5, 1.5, 1.5], target = [1.5, 1.4, -4], vertical_fov = 70
[settings] "reflection.max_passes" = 4000
[[object]] model = "MODELS/tile.obj", position = [4.5, -0.02, 4.5], scale = [9, 1, 9], color = [0.3, 0.25, 0.2]
)";
  Random random(3);
  const auto uniform = [&](double low, double high) { return random.uniform(low, high); };
  for (int line = 0; line <= cells; ++line) {
    for (int cell = 0; cell < cells; ++cell) {
      for (const bool alongX : {true, false}) {
        if (line > 0 && line < cells && uniform(0, 1) < 0.3) {
          continue;
        }
        const double across = line * cellSide;
        const double middle = (cell + 0.5) * cellSide;
        const auto place = [&](double a, double y, double b) {
          toml << "position = [" << (alongX ? a : b) << ", " << y << ", " << (alongX ? b : a) << "]\n";
        };
        toml << "[[object]]\nname = \"wall " << line << cell << alongX << "\"\nmodel = \"MODELS/box.obj\"\n";
        place(middle, 0.0, across);
        toml << "scale = [" << (alongX ? cellSide : 0.1) << ", 2.6, " << (alongX ? 0.1 : cellSide) << "]\ncolor = ["
             << uniform(0.2, 0.9) << ", " << uniform(0.2, 0.9) << ", " << uniform(0.2, 0.9) << "]\n";
        for (const double side : {-1.0, 1.0}) {
          if (uniform(0, 1) < 0.6) {
            const double yaw = alongX ? (side > 0 ? 0 : 180) : (side > 0 ? 90 : -90);
            toml << "[[mirror]]\n";
            place(middle + uniform(-0.5, 0.5), uniform(1.2, 1.5), across + side * 0.06);
            toml << "rotation = [0.0, " << yaw << ", " << uniform(-8, 8) << "]\nsize = [" << uniform(0.6, 1.6) << ", "
                 << uniform(0.5, 1.4) << "]\nreflectance = [0.9, 0.9, 0.85]\n";
            toml << (uniform(0, 1) < 0.3 ? "base_color = [0.1, 0.05, 0.02]\n" : "");
          }
        }
      }
    }
  }
  for (int i = 0; i < 6; ++i) {
    toml << "[[object]]\nmodel = \"MODELS/pawn.obj\"\nposition = [" << uniform(1, 8) << ", 0, " << uniform(1, 8)
         << "]\nscale = 2\n";
  }
  toml << "[[light]]\nposition = [4.5, 2.4, 4.5]\nintensity = 20\n";
  return writeScene("rooms", toml.str());
}

Image8 pictureWith(Session& session, const Settings& settings) {
  session.setSettings(settings);
  return draw(session);
}

nlohmann::ordered_json statsWith(Session& session, const Settings& settings) {
  session.setSettings(settings);
  runFrames(session);
  return frameStats(session);
}

TEST(Skipping, CameraCutsShowWhatDrawingEverythingShows) {
  QuietSession session(headless(roomsScene(), size));
  Random random(11);
  const auto uniform = [&](double low, double high) { return random.uniform(low, high); };
  const int cuts = fullTests() ? 1000 : 12;
  long hidden = 0;
  size_t passes = 0;
  size_t passesOfAll = 0;
  int differing = 0;  // pixels, if objects are drawn whole
  for (int cut = 0; cut < cuts; ++cut) {
    const double side = cells * cellSide;
    const glm::dvec3 eye(uniform(0.05, side), uniform(0.2, cut % 4 == 0 ? 5.0 : 2.4), uniform(0.05, side));
    const glm::dvec3 target(uniform(0.0, side), uniform(0.2, 2.2), uniform(0.0, side));
    session.setCamera(lookAt(eye, target, {0, 1, 0}, uniform(30, 100), 0.001));
    Settings settings = session.settings();
    settings.reflection.maxDepth = 2 + cut % 2;
    settings.view.samples = settings.reflection.samples = cut % 3 == 0 ? 4 : 1;
    // Thousands of large images with 4 samples would take 15 GB.
    const double most = settings.view.samples == 1 ? 2.0 : 1.0;
    settings.reflection.scale = cut % 5 == 3 ? 0.5 : cut % 5 == 4 ? most : 1.0;
    settings.debug.skipHidden = settings.debug.cullClusters = true;
    const Image8 skipping = pictureWith(session, settings);
    hidden += std::ranges::count(session.lastFrame().plan.skipped, SkipReason::hidden, &SkippedMirror::reason);
    passes += session.lastFrame().plan.drawnMirrors().size();
    settings.debug.skipHidden = settings.debug.maskPasses = false;
    const Image8 all = pictureWith(session, settings);
    passesOfAll += session.lastFrame().plan.drawnMirrors().size();
    ASSERT_EQ(skipping.rgba, all.rgba) << "cut " << cut;
    if (cut % 4 == 0) {
      settings.debug.cullClusters = false;
      differing += difference(all, pictureWith(session, settings), 0).over;
    }
    settings.debug.maskPasses = true;
    session.setSettings(settings);
  }
  // With other triangles in its draw, lavapipe may round a triangle's color differently. Along outlines, backs may be
  // nearer than fronts by rounding, in any color.
  EXPECT_LT(differing, cuts) << "of 14 400 each, in a quarter of them";
  EXPECT_GT(hidden, cuts);
  EXPECT_LT(passes, passesOfAll);
  std::printf("%d cuts, %ld hidden mirrors, %zu passes for %zu; parts of objects: %d pixels differ\n", cuts, hidden,
              passes, passesOfAll, differing);
}

// Three mirrors meet in a corner, and the image of one has twice the resolution. Along its edges it is read a few
// texels beyond them, where it shows the others.
TEST(Skipping, MasksReachBeyondTheImagesThatShowThem) {
  QuietSession session(headless(writeScene("corner", R"([environment]
background = [0.8, 0.1, 0.4]
[[mirror]]
polygon = [[0.97334338336639559, 2.3574790383861086, -1.2862845012753470], [0.15408369572388, -1.3826467940933118, -2.4439858105188015], [-0.27379392510832606, -2.4591214733643119, 1.3365175084277792], [0.54546576253418944, 1.281004359115109, 2.4942188176712339]]
[[mirror]]
polygon = [[0.15408369572388, -1.3826467940933118, -2.4439858105188015], [-0.42951311742126658, 2.4401746480022317, -1.4215128370171166], [-0.85739073825347267, 1.3636999687312319, 2.3589904819294638], [-0.27379392510832606, -2.4591214733643119, 1.3365175084277792]]
reflectance = [0.6, 0.6, 0.76]
two_sided = true
[[mirror]]
polygon = [[0.97334338336639559, 2.3574790383861086, -1.286284501275347], [-0.42951311742126658, 2.4401746480022317, -1.4215128370171166], [0.15408369572388, -1.3826467940933118, -2.4439858105188015]]
base_color = [0.17, 0.22, 0.4]
quality = { scale = 2 }
[camera]
position = [0.085095282971913044, 1.1097201629776134, 0.65532960305834675]
target = [-0.30603561351554165, -1.6629344509679911, -0.1011446305787041]
up = [-1.6943106966158621, 0.83877125147564291, -2.1982582417355419]
vertical_fov = 89.917016879310893
)"),
                                {160, 90},
                                {{"view.samples", "1"},
                                 {"reflection.samples", "1"},
                                 {"reflection.max_depth", "3"},
                                 {"reflection.max_passes", "1000"}}));
  const Image8 masked = draw(session);
  set(session, {{"debug.mask_passes", "false"}});
  EXPECT_EQ(difference(masked, draw(session), 0).over, 0);
}

// 12 mirrors that each show parts of one or two shells, which have 4 704 triangles and are no solids.
std::filesystem::path smallMirrorsScene() {
  std::ostringstream toml;
  toml << "[camera]\nposition = [0, 0, 6]\ntarget = [0, 0, 0]\nvertical_fov = 40\n[[light]]\nposition = [2, 4, 5]\n"
          "intensity = 90\n";
  for (int i = 0; i < 6; ++i) {
    toml << "[[object]]\nmodel = \"MODELS/ammonite.obj\"\nposition = [" << (i % 3 - 1) * 2.6 << ", "
         << (i / 3 - 0.5) * 2.6 << ", " << -1.0 + 0.2 * i << "]\nrotation = [0, " << 25 * i << ", 0]\n"
         << "scale = 3.2\n";
  }
  for (int i = 0; i < 12; ++i) {
    toml << "[[mirror]]\nposition = [" << (i % 4 - 1.5) * 1.6 << ", " << (i / 4 - 1) * 1.2
         << ", -6]\nsize = [0.5, 0.3]\n";
  }
  return writeScene("small_mirrors", toml.str());
}

TEST(Skipping, SmallMirrorsDrawSmallPartsOfObjects) {
  QuietSession session(headless(smallMirrorsScene(), {320, 180}));
  const auto mirrorTriangles = [&](const nlohmann::ordered_json& stats) {
    double triangles = 0.0;
    for (const auto& pass : stats["passes"]) {
      triangles += pass["depth"].is_null() ? 0.0 : pass["triangles"].get<double>();
    }
    return triangles;
  };
  for (const int samples : {1, 4}) {
    Settings settings = session.settings();
    settings.reflection.samples = settings.view.samples = samples;
    settings.reflection.skipUnchanged = false;  // drawn twice, to be counted
    settings.debug.cullClusters = true;
    const Image8 parts = pictureWith(session, settings);
    const double drawn = mirrorTriangles(statsWith(session, settings));
    settings.debug.cullClusters = false;
    EXPECT_EQ(parts.rgba, pictureWith(session, settings).rgba) << samples << " samples";
    EXPECT_LT(drawn, 0.9 * mirrorTriangles(statsWith(session, settings)));
  }
}

// Two objects of one random shape before six mirrors of random size, and a mirror behind the eye that shows all of them
// once more.
std::filesystem::path shapeScene(Random& random, std::mt19937& shapes) {
  writeModel("shape.obj", randomShape(shapes).obj());
  std::ostringstream toml;
  toml << "[environment]\nambient = [0.4, 0.4, 0.4]\nbackground = [0.2, 0.5, 0.7]\n"
       << cameraText({0, 0, 4}, random.inBox(0.5)) << "[[light]]\nposition = [1, 3, 6]\nintensity = 20\n"
       << "[[mirror]]\n"
       << rectangleText({0, 0, 6}, {random.uniform(-10, 10), 180, 0}, 6, 4);
  for (int i = 0; i < 2; ++i) {
    toml << objectText("shape.obj", random.inBox(1.0), random.inBox(180.0), random.uniform(0.5, 1.5), {0.8, 0.4, 0.2});
  }
  for (int i = 0; i < 6; ++i) {
    const double side = std::exp(random.uniform(std::log(0.02), std::log(1.0)));
    toml << "[[mirror]]\n"
         << rectangleText(random.inBox(1.5) - glm::dvec3(0, 0, 4), {0, random.uniform(-40, 40), 0}, side,
                          side * random.uniform(0.3, 1));
  }
  return writeScene("shape", toml.str());
}

TEST(Skipping, RandomShapesHideNothingThatIsSeen) {
  Random random(12);
  std::mt19937 shapes(12);
  const int scenes = fullTests() ? 2000 : 12;
  long hidden = 0;
  for (int i = 0; i < scenes; ++i) {
    Studio studio(headless(shapeScene(random, shapes), size));
    studio.settings.reflection.maxDepth = 2;
    studio.settings.view.samples = studio.settings.reflection.samples = i % 3 == 0 ? 4 : 1;
    const Image8 skipping = studio.fresh();
    hidden += std::ranges::count(studio.plan.skipped, SkipReason::hidden, &SkippedMirror::reason);
    studio.settings.debug.skipHidden = false;
    const Image8 all = studio.fresh();
    if (skipping.rgba != all.rgba) {
      ADD_FAILURE() << "scene " << i;
      writeEvidence(skipping, all, "shape_" + std::to_string(i));
    }
  }
  EXPECT_GT(hidden, scenes / 2);
}

// Solids and others, some mirrored, before a wall mirror and cut by one in the floor. The eye is in one of them in
// every fifth scene.
std::filesystem::path solidScene(Random& random, int number) {
  std::ostringstream toml;
  toml << "[environment]\nambient = [0.4, 0.4, 0.4]\nbackground = [0.2, 0.5, 0.7]\n[[light]]\n"
          "position = [1, 3, 2]\nintensity = 20\ncasts_shadow = true\n[[mirror]]\n"
       << rectangleText({0, 0, 0}, {-90, 0, 0}, 6, 6) << "[[mirror]]\n"
       << rectangleText({0, 1, -2}, {0, random.uniform(-10, 10), 0}, 4, 2);
  const std::array models{"sphere", "queen", "torus_knot_upright", "vase", "moebius", "teapot", "ammonite"};
  glm::dvec3 eye(random.uniform(-1, 1), random.uniform(0.1, 2), 3);
  for (int i = 0; i < 6; ++i) {
    const bool inside = number % 5 == 0 && i == 0;
    const glm::dvec3 position(random.uniform(-1.5, 1.5), random.uniform(-0.5, 1), random.uniform(-1.5, 1.5));
    const double side = random.uniform(0.8, 2.0);
    toml << "[[object]]\nmodel = \"MODELS/" << (inside ? "sphere" : random.pick(models))
         << ".obj\"\nposition = " << text(position) << "\nrotation = " << text(random.inBox(180.0)) << "\nscale = ["
         << (i % 2 == 0 ? -side : side) << ", " << side << ", " << side * random.uniform(0.5, 1.5)
         << "]\ncolor = " << random.vec(0.2, 0.9) << "\n";
    eye = inside ? position + glm::dvec3(0, 0.1 * side, 0) : eye;
  }
  toml << cameraText(eye, random.inBox(0.5) + glm::dvec3(0, 0.5, 0));
  return writeScene("solids", toml.str());
}

TEST(Skipping, BacksOfSolidsAreNotSeen) {
  Random random(13);
  const int scenes = fullTests() ? 2000 : 6;
  for (int i = 0; i < scenes; ++i) {
    Studio studio(headless(solidScene(random, i), size, {{"effects.shadow_lookup", "map"}}));
    studio.settings.view.samples = studio.settings.reflection.samples = i % 2 == 0 ? 4 : 1;
    const Image8 fronts = studio.fresh();
    studio.settings.debug.cullClusters = false;
    const Image8 all = studio.fresh();
    // Along outlines, a back may be nearer than the front by rounding.
    const PictureAgreement agreement = difference(fronts, all, 24);
    if (agreement.over > 4) {
      ADD_FAILURE() << "scene " << i << ": " << agreement.over << " of 14 400 pixels";
      writeEvidence(fronts, all, "solids_" + std::to_string(i));
    }
  }
}

// In scenes of many triangles the shaders of objects read uniform buffers; in others, vertex shaders hand the values
// on. The scene of many triangles has them far away and too small to be seen.
TEST(Skipping, FarTrianglesChangeNoBytesOfOthers) {
  Random random(17);
  for (int i = 0; i < 8; ++i) {
    std::string toml =
        "[environment]\nambient = " + random.vec(0.0, 0.5) +
        "\n[settings]\neffects.shadows = false\n[camera]\nposition = [0, 1.5, 4]\ntarget = " + text(random.inBox(1.0)) +
        "\n[[mirror]]\n" + rectangleText({0, 1, -2}, {0, 5, 0}, 4, 3) + "base_color = " + random.vec(0.0, 0.5) + "\n";
    for (int light = 0; light < 1 + i % 4; ++light) {
      toml += "[[light]]\nposition = " + text(3.0 * random.inBox(1.0)) + "\nintensity = 20\n";
    }
    for (const char* model : {"tile", "box", "torus_knot"}) {
      toml += std::string("[[object]]\nmodel = \"MODELS/") + model + ".obj\"\nposition = " + text(random.inBox(1.0)) +
              "\nrotation = " + text(random.inBox(180.0)) + "\ncolor = " + random.vec(0.2, 0.9) +
              "\nspecular = " + random.vec(0.0, 0.9) + "\nemission = " + random.vec(0.0, 0.1) + "\n";
    }
    const std::string far =
        "[[object]]\nmodel = \"MODELS/torus_knot.obj\"\nposition = [0, 1000, 0]\nscale = 0.001\n"
        "copies = { count = 10, step = [1, 0, 0] }\n";
    std::array<Image8, 2> pictures;
    for (const bool isMany : {false, true}) {
      Studio studio(headless(writeScene("few", toml + (isMany ? far : "")), size));
      studio.settings.view.samples = studio.settings.reflection.samples = i % 2 == 0 ? 4 : 1;
      pictures[isMany] = studio.fresh();
    }
    EXPECT_TRUE(pictures[0].rgba == pictures[1].rgba) << "scene " << i;
  }
}

TEST(Skipping, SolidsShadeFewerFragments) {
  QuietSession session(headless(sceneFile("gallery"), size));
  const auto fragments = [&](bool culls) {
    Settings settings = session.settings();
    settings.debug.cullClusters = culls;
    settings.reflection.skipUnchanged = false;
    const nlohmann::ordered_json stats = statsWith(session, settings);
    double sum = 0.0;
    for (const auto& pass : stats["passes"]) {
      sum += pass["fragments"].is_number() ? pass["fragments"].get<double>() : 0.0;
    }
    return sum;
  };
  const double all = fragments(false);
  if (all == 0.0) {
    GTEST_SKIP() << "the device counts no fragments";
  }
  EXPECT_LT(fragments(true), 0.9 * all);
}

TEST(Skipping, MaskDoesNotChangeCachedImages) {
  Options options = headless(roomsScene(), size, {{"reflection.update_interval", "3"}});
  std::map<bool, std::vector<std::vector<uint8_t>>> pictures;
  for (const bool masked : {true, false}) {
    QuietSession session(options);
    Settings settings = session.settings();
    settings.debug.maskPasses = masked;
    for (int frame = 0; frame < 6; ++frame) {
      const glm::dvec3 eye(1.4 + 0.01 * frame, 1.5, 1.6);
      session.setCamera(lookAt(eye, {1.2, 1.3, 0.0}, {0, 1, 0}, 60, 0.001));
      pictures[masked].push_back(pictureWith(session, settings).rgba);
    }
  }
  EXPECT_TRUE(pictures[true] == pictures[false]);
}

// Swarms of lights about a few places: before and behind a turned quad, in its plane or next to it, and in bodies. Two
// mirrors show all of that once more, and their bases are lit too.
std::string swarmScene(Random& random) {
  const glm::dvec3 rotation = random.inBox(180.0);
  const glm::dmat3 turn = rotationFromDegrees(rotation);
  const glm::dvec3 center = random.inBox(random.chance(0.8) ? 1.0 : 1e5);
  const auto at = [&](double x, double y, double z) { return center + turn * glm::dvec3(x, y, z); };
  std::ostringstream scene;
  scene << "[environment]\nambient = [0.05, 0.05, 0.05]\nbackground = [0.1, 0.2, 0.3]\n"
        << cameraText(at(random.uniform(-1, 1), 0.3, 2.6), at(0.1, 0.1, 0))
        << objectText("quad.obj", center, rotation, random.uniform(1.0, 3.0), {0.7, 0.6, 0.5})
        << "specular = [0.3, 0.3, 0.3]\n"
        << objectText("MODELS/box.obj", at(-0.6, 0.3, 0.2), random.inBox(180.0), 0.5, {0.8, 0.4, 0.2})
        << objectText("MODELS/torus_knot.obj", at(0.6, 0.2, 0.5), random.inBox(180.0), 0.4, {0.2, 0.5, 0.8});
  for (const double x : {-1.0, 1.0}) {
    scene << "[[mirror]]\nbase_color = [0.4, 0.5, 0.2]\nreflectance = [0.6, 0.6, 0.6]\n"
          << rectangleText(at(0.8 * x, -0.4, 0.3), rotation, 0.9, 0.6)
          << (random.chance(0.3) ? "ripple = { amplitude = 0.01, wavelength = 0.4 }\n" : "");
  }
  for (int swarm = 0; swarm < 5; ++swarm) {
    const double height =
        std::stod(random.pick(std::array{"0", "1e-7", "-1e-7", "1e-3", "-0.01", "-0.3", "0.8", "-3"}));
    const glm::dvec3 place(random.uniform(-1, 1), random.uniform(-1, 1), height);
    const double reach = std::stod(random.pick(std::array{"0", "0", "1e-6", "0.01", "0.3", "2"}));
    const bool shadows = random.chance(0.1);
    for (size_t i = 2 + random.index(20); i > 0; --i) {
      const glm::dvec3 light = place + random.inBox(reach) * glm::dvec3(1, 1, random.chance(0.5) ? 1 : 0);
      scene << "[[light]]\nposition = " << text(at(light.x, light.y, light.z))
            << "\nintensity = 0.2\nradius = 0.01\nglow = " << random.index(2)
            << "\ncasts_shadow = " << (shadows && i % 8 == 0 ? "true\n" : "false\n");
      if (random.chance(0.2)) {
        scene << "orbit = { center = " << text(at(place.x, place.y, place.z)) << ", axis = " << text(random.direction())
              << ", speed = 300 }\n";
      }
    }
  }
  return scene.str();
}

TEST(Skipping, LightsBelowSurfacesAddNothing) {
  writeQuad();
  Random random(14);
  const int scenes = fullTests() ? 1000 : 16;
  for (int i = 0; i < scenes; ++i) {
    const std::filesystem::path file = writeScene("swarm", swarmScene(random));
    Studio studio(headless(file, {96, 54}, {{"effects.rays", "software"}}));
    studio.settings.reflection.method = i % 4 == 1 ? ReflectionMethod::rays : ReflectionMethod::automatic;
    studio.settings.effects.shadowLookup = i % 4 == 2 ? ShadowLookup::map : ShadowLookup::automatic;
    studio.settings.view.samples = studio.settings.reflection.samples = i % 3 == 0 ? 4 : 1;
    studio.settings.view.exposure = i % 2 == 0 ? 1.0 : 1e6;
    studio.settings.reflection.skipUnchanged = false;
    for (studio.time = 0.0; studio.time < 0.5; studio.time += 0.4) {
      studio.settings.debug.skipLights = true;
      const Image8 skipping = studio.fresh();
      studio.settings.debug.skipLights = false;
      const Image8 all = studio.fresh();
      if (skipping.rgba != all.rgba) {
        ADD_FAILURE() << "scene " << i << " at " << studio.time << " s";
        writeEvidence(skipping, all, "swarm_" + std::to_string(i));
      }
    }
  }
}

// Shaders that add 0.001 to the picture for each light that a surface asks, on any device.
void writeCountingShaders(const std::filesystem::path& directory) {
  writeShaders(directory, "shading.glsl", "");
  std::string text = readText(directory / "shading.glsl");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("branches && height", "false && height");
  replace("return min(irradiance", "return 0.001 + min(irradiance");
  std::ofstream(directory / "shading.glsl") << text;
}

// 144 dark lights, in turn behind a wall and before it: half of the groups are behind it, in whatever order the lights
// are listed, and whichever of them have glyphs within the view.
TEST(Skipping, LightsBelowSurfacesAreNotAsked) {
  writeQuad();
  std::ostringstream scene;
  scene << "[environment]\nambient = [0, 0, 0]\n"
        << cameraText({0, 0, -1}, {0, 0, 0}) << objectText("quad.obj", {0, 0, 0}, {0, 180, 0}, 20.0, {0.5, 0.5, 0.5})
        << "[[mirror]]\n"
        << rectangleText({-0.5, 0, -0.1}, {0, 180, 0}, 0.2, 0.2);
  for (int i = 0; i < 144; ++i) {
    scene << "[[light]]\nposition = [" << i % 12 - 5 << ", " << i / 12 - 5 << ", " << (i % 2 == 0 ? 8 : -8)
          << "]\nintensity = 1e-6\nglow = " << (i % 10 == 0 ? 1 : 0) << "\n";
  }
  TemporaryDirectory shaders;
  writeCountingShaders(shaders.path());
  for (const std::string method : {"raster", "rays"}) {
    Options options = headless(writeScene("dark_lights", scene.str()), {32, 18}, {{"reflection.method", method}});
    options.shaderDir = shaders.path();
    QuietSession session(options);
    Settings settings = session.settings();
    for (const bool skips : {true, false}) {
      settings.debug.skipLights = skips;
      // 72 lights make it 0.072, which the screen shows as 76, and 144 make it 106.
      EXPECT_NEAR(pictureWith(session, settings).at(4, 9)[1], skips ? 76 : 106, 4) << method;
    }
  }
}

// A tilted mirror, in a closed room or under a sky. In the room, walls and floor fill its image.
std::filesystem::path tiltedScene(bool closed) {
  return writeScene(closed ? "tilted_closed" : "tilted_sky", std::string(R"(
[environment] sky = { zenith = [0.1, 0.2, 0.5], horizon = [0.6, 0.5, 0.4], ground = [0.1, 0.1, 0.1] }
  ambient = [0.3, 0.3, 0.3]
[camera] position = [0, 1.6, 1.5], target = [0.2, 1.6, -1.5]
[[mirror]] position = [0.2, 1.6, -1.5], rotation = [5, 10, 30], size = [3.2, 1.8]
[[object]] model = "MODELS/box.obj", position = [-1, 0, 4.2], scale = [0.8, 1.6, 0.8], color = [0.8, 0.4, 0.2]
[[light]] position = [0, 2.9, 1], intensity = 20, glow = 0
)") + (closed ? R"([[object]] model = "MODELS/room.obj", position = [0, 0, 2], scale = 1.0
)"
              : ""));
}

TEST(Skipping, MirrorPassesDrawOnlyWhatIsSeen) {
  for (const bool closed : {false, true}) {
    QuietSession session(headless(tiltedScene(closed), {640, 360}));
    for (const int samples : {1, 4}) {
      Settings settings;
      settings.reflection.samples = samples;
      const nlohmann::ordered_json masked = statsWith(session, settings)["passes"][0];
      settings.debug.maskPasses = false;
      const nlohmann::ordered_json whole = statsWith(session, settings)["passes"][0];
      ASSERT_TRUE(masked["samples_drawn"].is_number()) << "the device counts no samples";
      const double seen = masked["area_px"].get<double>() * samples;
      EXPECT_GT(seen, 20000.0 * samples);
      // Texels beside the mirror are drawn too where its image has other samples than the picture.
      EXPECT_LE(masked["samples_drawn"].get<double>(), (samples == settings.view.samples ? 1.15 : 1.18) * seen)
          << closed << samples;
      EXPECT_GE(masked["samples_drawn"].get<double>(), seen) << closed << samples;
      EXPECT_GT(whole["samples_drawn"].get<double>(), 1.4 * seen) << closed << samples;
    }
  }
}

// Rebuilds the tree of passes from their figures alone.
TEST(Skipping, FiguresOfPassesNameTheParent) {
  QuietSession session(headless(roomsScene(), size,
                                {{"reflection.update_interval", "2"},
                                 {"reflection.skip_unchanged", "false"},
                                 {"reflection.max_depth", "3"},
                                 {"debug.skip_hidden", "false"}}));
  session.setCamera(lookAt({1.4, 1.5, 1.6}, {1.2, 1.3, 0.0}, {0, 1, 0}, 100, 0.001));
  std::vector<nlohmann::ordered_json> frames;
  std::vector<std::vector<PassId>> passes;
  for (int frame = 0; frame < 4; ++frame) {
    frames.push_back(statsWith(session, session.settings()));
    passes.push_back(passIds(session));
  }
  frames.push_back(mergeStats(frames, passes));
  int mirrors = 0;
  for (const nlohmann::ordered_json& frame : frames) {
    for (const auto& pass : frame["passes"]) {
      if (pass["depth"].is_null()) {
        EXPECT_TRUE(pass["parent"].is_null());
        continue;
      }
      ++mirrors;
      nlohmann::ordered_json path = frame["passes"][pass["parent"].get<size_t>()]["path"];
      path.push_back(pass["mirror"]);
      EXPECT_EQ(path, pass["path"]);
    }
  }
  EXPECT_GT(mirrors, 8);
  EXPECT_LT(frames[1]["passes"].size(), frames.back()["passes"].size()) << "some images were reused";
}

// Views in all directions about a few nodes, many of which show none.
struct ViewsOfLittle {
  explicit ViewsOfLittle(RenderPath path = RenderPath::automatic)
      : session([&] {
          Options options = headless(writeScene("little", R"(
[environment] background = [0.21, 0.4, 0.017], ambient = [0.3, 0.3, 0.3]
[camera] position = [0, 0, 0], target = [0, 0, 1]
[[object]] model = "MODELS/box.obj", position = [0, 0, -3]
[[light]] position = [0, 3, 0], intensity = 9, glow = 2
[[mirror]] position = [3, 0, 0], rotation = [0, -90, 0], size = [1, 1]
)"),
                                     {64, 36});
          options.renderPath = path;
          return options;
        }()) {}

  // Draws the view, and returns what the display and the main view show.
  std::pair<std::vector<uint8_t>, std::vector<glm::vec3>> draw(bool whole) {
    Settings settings = session.settings();
    settings.debug.checkFinite = whole;
    session.setSettings(settings);
    const Image8 picture = testing_support::draw(session);
    return {picture.rgba, session.radiance().pixels};
  }

  // Says whether the last frame drew into the display image.
  bool drewDisplay() { return session.sceneRenderer().passes().back().draws > 0; }

  QuietSession session;
};

TEST(Skipping, ViewsOfNothingAreNotDrawn) {
  for (const RenderPath path : {RenderPath::dynamic, RenderPath::renderPass}) {
    ViewsOfLittle views(path);
    Random random(7);
    std::array<int, 2> found{};
    for (int view = 0; view < 40; ++view) {
      Settings settings = views.session.settings();
      settings.view.exposure = random.uniform(0.1, 3.0);
      settings.view.toneMap = random.chance(0.5) ? ToneMap::aces : ToneMap::clamp;
      settings.view.samples = random.chance(0.5) ? 4 : 1;
      settings.view.scale = random.chance(0.3) ? 0.5 : 1.0;
      if (random.chance(0.5)) {
        settings.view.clearColor = {random.uniform(0.0, 1.5), random.uniform(0.0, 0.01), random.uniform(0.0, 1.0)};
      }
      views.session.setSettings(settings);
      views.session.setCamera(lookAt({0, 0, 0}, random.direction(), {0, 1, 0}, 40, 0.01));
      const auto whole = views.draw(true);
      EXPECT_TRUE(views.drewDisplay());
      EXPECT_EQ(views.draw(false), whole) << "view " << view;
      ++found[views.drewDisplay()];
    }
    EXPECT_GE(found[false], 8);
    EXPECT_GE(found[true], 8);
  }
}

// The shader rounds these colors otherwise than exact curves do.
TEST(Skipping, ViewsOfNothingRoundAsTheShaderDoes) {
  ViewsOfLittle views;
  views.session.setCamera(lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 40, 0.01));
  for (const auto& [toneMap, exposure, color] :
       {std::tuple(ToneMap::aces, 2.18, 0.046630859375), std::tuple(ToneMap::clamp, 0.84, 0.69921875),
        std::tuple(ToneMap::clamp, 2.31, 0.35791015625)}) {
    Settings settings = views.session.settings();
    settings.view.toneMap = toneMap;
    settings.view.exposure = exposure;
    settings.view.clearColor = {color, color, color};
    for (const int samples : {1, 4}) {
      settings.view.samples = samples;
      settings.view.scale = samples == 4 ? 0.5 : 1.0;
      views.session.setSettings(settings);
      const auto whole = views.draw(true);
      EXPECT_EQ(views.draw(false), whole) << exposure;
      EXPECT_TRUE(views.drewDisplay()) << "one texel everywhere";
    }
  }
}

// What is asked for after a view of nothing: the same picture again, beside another one, a target.
TEST(Skipping, ViewsOfNothingAreShownAgain) {
  ViewsOfLittle views;
  Session& session = views.session;
  session.setCamera(lookAt({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 40, 0.01));
  const auto nothing = views.draw(false);
  EXPECT_FALSE(views.drewDisplay());
  EXPECT_TRUE(session.sceneRenderer().hasGaps());
  const DrawnFrame frame = session.lastFrame();
  FramePlan again = frame.plan;
  again.main().source = PassSource::reused;
  recordFrame(session, frame.state, frame.settings, again);
  EXPECT_EQ(session.picture().rgba, nothing.first);
  const TargetDisplay target{.pass = 0, .area = {0, 0, 64, 36}, .kind = TargetKind::color, .zoom = 1.0};
  recordFrame(session, frame.state, frame.settings, again, target);
  EXPECT_EQ(session.picture().rgba, nothing.first) << "a target that was not drawn is not shown";
  recordFrame(session, frame.state, frame.settings, frame.plan, target);
  EXPECT_EQ(session.picture().rgba, nothing.first);
  EXPECT_FALSE(session.sceneRenderer().hasGaps());

  // The other half of A | B shows the box.
  SceneRenderer other(session.renderer(), session.scene());
  views.draw(false);
  const DrawnFrame flat = session.lastFrame();
  session.setCamera(lookAt({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 40, 0.01));
  const auto box = views.draw(true).first;
  const DrawnFrame drawn = session.lastFrame();
  for (const bool right : {false, true}) {
    Frame first = session.renderer().beginFrame().value();
    other.record(first, flat.state, flat.settings, flat.plan);
    session.renderer().endFrame(first);
    Frame second = session.renderer().beginFrame().value();
    second.capture = true;
    session.sceneRenderer().record(second, drawn.state, drawn.settings, drawn.plan, {}, true,
                                   SplitDisplay{other, right, 20});
    session.renderer().endFrame(second);
    const Image8 picture = session.picture();
    for (size_t i = 0; i < picture.rgba.size(); ++i) {
      const bool ofBox = (i / 4 % 64 >= 20) == right;
      ASSERT_EQ(picture.rgba[i], (ofBox ? box : nothing.first)[i]) << i << right;
    }
  }
  session.renderer().waitIdle();
}

}  // namespace
}  // namespace speculum::skipping_pictures
