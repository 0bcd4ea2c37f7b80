// Traced effects against the ray tracer: exact ones pixel by pixel, approximate ones along their settings.
#include "compare/image_metrics.hpp"
#include "effect_scenes.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "made_pictures.hpp"
#include "plan/reuse_support.hpp"
#include "sampling.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{240, 136};
constexpr PictureSize small{112, 63};

// A room corner with two objects on a floor; `rest` adds lights and mirrors.
std::filesystem::path corner(const std::string& name, const std::string& rest) {
  return writeScene(name, effectFloor + R"([[object]] model = "MODELS/torus_knot.obj"
  position = [-0.7, 0.9, 0.2], scale = 0.55, color = [0.8, 0.3, 0.2], specular = [0.2, 0.2, 0.2], shininess = 60
[[object]] name = "pot", model = "MODELS/teapot.obj", position = [0.8, 0.1, 0.4], scale = [0.6, 0.6, -0.6]
)" + rest);
}

const std::string plainLight = "[[light]]\nposition = [-1.6, 2, 1.2]\nintensity = 5\ncolor = [0.6, 0.7, 1]\n";

const std::string byRays = "[settings]\n\"reflection.method\" = \"rays\"\n";

// With as many samples, at the size `small`.
TraceResult traceSmall(const std::filesystem::path& file, const TraceOptions& samples) {
  Tracing tracing = tracingOf(file, small, 3);
  tracing.options.samples = samples.samples;
  tracing.options.roughSamples = samples.roughSamples;
  return tracing.result();
}

// Root of the mean squared error in radiance within the mirrors.
double mirrorError(const LinearImage& drawn, const TraceResult& traced) {
  return rootMeanSquare(drawn, traced.image, {traced.mirrorDepth.begin(), traced.mirrorDepth.end()});
}

struct Case {
  const char* name;
  std::string rest;
  const char* effects;  // effects that the scene calls for
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

std::string tracedEffectsOf(const Options& options, double time) {
  const Scene scene = loadScene(options.scene);
  const SceneState state = evaluate(scene, time);
  const Settings settings = settingsOf(scene);
  std::string names;
  const FramePlan plan = planFrame({scene, state, settings, {options.size.width, options.size.height}});
  for (const Effect& effect : effectsOf(scene, state, settings, plan)) {
    const bool traced = effect.name == "shadows" || effect.name == "ripple" || effect.name == "casts_light" ||
                        effect.name == "curved" || effect.name == "roughness";
    names += effect.calledFor && traced ? effect.name + " " : "";
  }
  return names;
}

const std::string nearBall = "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [0.2, 0.6, 1.2]\nscale = 0.4\n";

// A teapot that no mirror shows and a knot that only mirrors show.
const std::string ghosts =
    "[[object]]\nmodel = \"MODELS/teapot.obj\"\nposition = [-0.9, 0.1, -0.7]\nscale = 0.5\nvisible = \"eye\"\n"
    "[[object]]\nmodel = \"MODELS/torus_knot.obj\"\nposition = [1.3, 0.6, -0.6]\nscale = 0.4\nvisible = \"mirrors\"\n";

// All cases have these models.
class ExactEffects : public testing::TestWithParam<Case> {
 protected:
  static void SetUpTestSuite() {
    const Options options = truthOptions(corner("effects_models", nearBall), size, 3);
    studio_ = std::make_unique<Studio>(options);
  }
  static void TearDownTestSuite() { studio_.reset(); }

  static inline std::unique_ptr<Studio> studio_;
};

TEST_P(ExactEffects, EqualTheRayTracer) {
  constexpr double time = 1.7;
  const std::filesystem::path file = corner("effects_" + std::string(GetParam().name), GetParam().rest);
  EXPECT_EQ(tracedEffectsOf(truthOptions(file, size, 3), time), GetParam().effects);
  studio_->settings.reflection.method = settingsOf(loadScene(file)).reflection.method;
  expectTruth(*studio_, file, trace(file, size, 3, time), time);
}

INSTANTIATE_TEST_SUITE_P(
    Corner, ExactEffects,
    testing::Values(
        Case{"shadows", shadowLight + plainLight, "shadows "},
        Case{"shadows_in_mirrors", shadowLight + wall + side, "shadows "},
        Case{"shadow_of_a_light_behind_the_eye",
             "[[light]]\nposition = [0.5, 2.2, 5]\nintensity = 30\ncasts_shadow = true\n" + wall, "shadows "},
        Case{"shadows_on_backs_and_layers",
             shadowLight + wall + "base_color = [0.3, 0.2, 0.1]\nreflectance = [0.3, 0.3, 0.3]\n" + side +
                 "back_color = [0.4, 0.5, 0.4]\n[[mirror]]\nposition = [1.7, 1, 0.6]\nrotation = [0, 120, 0]\n"
                 "size = [1, 1]\nback_color = [0.5, 0.4, 0.4]\n",
             "shadows "},
        Case{"bounced_light", plainLight + wall + "casts_light = true\n", "casts_light "},
        Case{"bounced_light_with_shadows",
             shadowLight + wall + "casts_light = true\nfresnel = \"schlick\"\nreflectance = [0.6, 0.7, 0.8]\n" + side +
                 "casts_light = true\ntwo_sided = true\n",
             "shadows casts_light "},
        Case{"ripples", plainLight + pool + ripple, "ripple "},
        Case{"ripples_and_shadows_in_mirrors",
             shadowLight + wall + pool + ripple + "fresnel = \"schlick\"\nreflectance = [0.1, 0.1, 0.1]\n" +
                 "base_color = [0.05, 0.2, 0.25]\n",
             "shadows ripple "},
        Case{"curved_mirror",
             plainLight + wall + nearBall + "mirror = { reflectance = [0.9, 0.8, 0.6], base_color = [0.1, 0, 0] }\n",
             "curved "},
        Case{"all_mirrors_by_rays",
             shadowLight + wall + "casts_light = true\n" + side + "fresnel = \"schlick\"\ntwo_sided = true\n" + pool +
                 ripple + byRays,
             "shadows ripple casts_light "},
        Case{"visibility",
             shadowLight + "visible = \"eye\"\nradius = 0.15\n" + plainLight +
                 "visible = \"mirrors\"\nradius = 0.15\n" + wall + side + nearBall + "visible = \"mirrors\"\n" + ghosts,
             "shadows "},
        Case{"visibility_by_rays",
             shadowLight + "visible = \"eye\"\nradius = 0.15\n" + plainLight +
                 "visible = \"mirrors\"\nradius = 0.15\n" + wall + side + nearBall +
                 "visible = \"eye\"\nmirror = {}\n" + ghosts + byRays,
             "shadows curved "},
        Case{"curved_mirror_with_all",
             shadowLight + plainLight + wall + "casts_light = true\n" + pool + ripple +
                 "[[object]]\nmodel = \"MODELS/torus_knot.obj\"\nposition = [0.2, 0.7, 1.2]\nscale = 0.4\n"
                 "mirror = { reflectance = [0.2, 0.2, 0.2], fresnel = \"schlick\" }\n",
             "shadows ripple casts_light curved "}),
    [](const auto& info) { return std::string(info.param.name); });

// A picture of linear shares without symmetry, some of them 0 and 1.
std::string mapKey() {
  writePng(sceneDirectory() / "map.png",
           madePicture(5, 4, [](int x, int y) { return glm::ivec4(60 * x, 85 * y, x == y ? 0 : 255, 255); }));
  return "reflectance_map = \"map.png\"\n";
}

TEST(ReflectanceMap, EqualsTheTracer) {
  const std::string map = mapKey();
  const std::string pentagon =
      "[[mirror]]\npolygon = [[-2, 0.2, -1], [0, 0, -1.6], [1, 0.5, -1.9], [0.4, 2, -1.72], [-1.4, 1.8, -1.18]]\n" +
      map;
  const std::vector<std::filesystem::path> files{
      corner("map", plainLight + wall + map + side + map + "two_sided = true\nfresnel = \"schlick\"\n"),
      corner("map_base", plainLight + wall + map + "base_color = [0.4, 0.3, 0.2]\n"),
      corner("map_polygon", plainLight + pentagon + "base_color = [0.1, 0.3, 0.2]\n"),
      corner("map_shadows", shadowLight + wall + map + "base_color = [0.4, 0.3, 0.2]\n" + side),
      corner("map_ripples", plainLight + pool + ripple + map + wall),
      corner("map_casts_light", shadowLight + wall + map + "casts_light = true\n"),
      corner("map_rays", shadowLight + wall + map + side + map + "two_sided = true\n" + byRays)};
  for (const std::filesystem::path& file : files) {
    expectTruth(file, size, 3, trace(file, size, 3, 1.7), 1.7);
  }
}

TEST(ReflectanceMap, WithSamplesEqualsTheTracer) {
  const std::filesystem::path file = corner("map_samples", plainLight + wall + mapKey() + side + mapKey());
  Options options = truthOptions(file, size, 3);
  set(options, {{"view.samples", "4"}, {"reflection.samples", "4"}});
  Tracing tracing = tracingOf(file, size, 3);
  tracing.options.samples = 16;
  EXPECT_LT(difference(draw(options), toDisplay(tracing.result().image), 40).share(), 0.02);
}

// A mirror that fills the view reflects nothing but a white background.
TEST(ReflectanceMap, IsUprightSeenFromTheFront) {
  const std::filesystem::path file = writeScene("map_upright", R"([environment] background = [1, 1, 1]
[camera] position = [0, 0, 1], target = [0, 0, 0], vertical_fov = 90
[[mirror]] size = [2, 2], reflectance = [0.5, 1, 1]
)" + mapKey());
  const LinearImage picture = tracingOf(file, {5, 5}, 1).result().image;
  EXPECT_NEAR(picture.pixels[2].r, 0.5 * 120 / 255.0, 1e-3) << "the value in the file is the share";
  EXPECT_LT(picture.pixels[0].r, picture.pixels[4].r) << "red grows to the right";
  EXPECT_LT(picture.pixels[0].g, picture.pixels[20].g) << "green grows downwards";
}

TEST(ReflectanceMap, IsATexture) {
  const auto load = [](const std::string& keys) {
    return loadScene(writeScene("map_effect", R"([camera] position = [0.3, 1.7, 3.6], target = [0, 0.6, 0]
[[object]] model = "MODELS/torus_knot.obj", position = [-0.7, 0.9, 0.2], scale = 0.55
)" + wall + keys));
  };
  const auto called = [&](const std::string& keys) {
    const Scene scene = load(keys);
    const SceneState state = evaluate(scene, 0.0);
    return drawsTextures(scene, state, Settings(), planFrame({scene, state, Settings(), {size.width, size.height}}));
  };
  EXPECT_TRUE(called(mapKey()));
  EXPECT_FALSE(called(""));
  const Scene scene = load(mapKey());
  Settings without;
  without.effects.textures = false;
  EXPECT_EQ(opticsOf(scene.mirrors[0], without.effects).map, -1);
}

class MirrorsByRays : public testing::TestWithParam<const char*> {};

TEST_P(MirrorsByRays, EqualTheRayTracer) {
  const std::filesystem::path file = sceneFile(GetParam());
  Options options = truthOptions(file, {160, 90}, 4);
  set(options, {{"reflection.method", "rays"}});
  Studio studio(options);
  expectTruth(studio, file, trace(file, {160, 90}, 4));
  EXPECT_TRUE(studio.plan.drawnMirrors().empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, MirrorsByRays,
                         testing::ValuesIn(fullTests()
                                               ? std::vector{"gallery", "facing_mirrors", "hard/far_from_origin",
                                                             "hard/corner", "hard/nested", "hard/eye_at_the_mirror",
                                                             "hard/behind_the_mirror"}
                                               : std::vector{"facing_mirrors", "hard/far_from_origin", "hard/corner",
                                                             "hard/behind_the_mirror"}),
                         [](const auto& info) {
                           const std::string name = info.param;
                           return name.substr(name.find('/') + 1);
                         });

// Far from the origin the same rays are traced.
TEST(ExactEffects, EqualTheTracerFarFromOrigin) {
  const std::filesystem::path file = writeScene("effects_far", effectsFarAway());
  expectTruth(file, size, 3, trace(file, size, 3));
}

// Roads of up to 100 km under a light with shadows, some of them mirrors by rays. Rounding of weights must not move
// what is shaded along the road.
TEST(ExactEffects, LongThinTrianglesEqualTheTracer) {
  Random random(3);
  for (int i = 0; i < 8; ++i) {
    const double length = std::pow(10.0, random.uniform(2.0, 5.0));
    std::ostringstream road;
    for (const auto& [x, z] : {std::pair{-3, -1}, {3, -1}, {3, 1}, {-3, 1}}) {
      road << "v " << x << " 0 " << z * length << ' ' << 0.5 + 0.1 * x << ' ' << 0.5 - 0.4 * z << " 0.6\n";
    }
    road << "f 4 3 2 1\n";
    const std::string name = "road_" + std::to_string(i);
    writeModel(name + ".obj", road.str());
    const std::filesystem::path file = writeScene(
        name, "[environment]\nbackground = [0.3, 0.5, 0.8]\nambient = [0.1, 0.1, 0.1]\n" +
                  cameraText({0, 1.6, 4}, {0, 0.6, 0}) +
                  objectText("MODELS/block.obj", {0, 0, 0}, {0, 30, 0}, 0.8, {0.8, 0.5, 0.3}) +
                  objectText(name + ".obj", {0, -0.01, 0}, {0, random.uniform(0, 90), 0}, 1.0, {0.7, 0.7, 0.7}) +
                  (random.chance(0.4) ? "mirror = {}\n" : "") +
                  "[[light]]\nposition = [1, 3, 2]\nintensity = 15\ncasts_shadow = true\n");
    expectTruth(file, small, 2, trace(file, small, 2));
  }
}

// Smooth columns seen from 1 km, lit from behind: rays from facets that the light lies behind leave the column again
// within centimetres, through the next facet.
TEST(ExactEffects, EdgesSeenFromFarLeakNoLight) {
  std::ostringstream prism;
  for (int i = 0; i < 6; ++i) {
    const double turn = glm::radians(60.0 * i);
    prism << "v " << std::sin(turn) << " -40 " << std::cos(turn) << "\nv " << std::sin(turn) << " 40 " << std::cos(turn)
          << "\n";
  }
  prism << "s 1\n";
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    prism << "f " << 2 * i + 1 << ' ' << 2 * next + 1 << ' ' << 2 * next + 2 << ' ' << 2 * i + 2 << "\n";
  }
  writeModel("prism.obj", prism.str());
  std::string scene = "[environment]\nbackground = [0.3, 0.5, 0.8]\nambient = [0.1, 0.1, 0.1]\n" +
                      cameraText({0, 0, 1000}, {0, 0, 0}) +
                      "vertical_fov = 1\n[[light]]\nposition = [60, 0, -30]\nintensity = 6e4\ncasts_shadow = true\n";
  for (int i = -1; i <= 1; ++i) {
    scene += objectText("prism.obj", {0.85 * i, 0, 0}, {0, 8.0 * i - 17.0, 1}, 0.35, {0.8, 0.7, 0.6});
  }
  const std::filesystem::path file = writeScene("columns_from_far", scene);
  constexpr PictureSize tall{60, 400};
  expectTruth(file, tall, 1, trace(file, tall, 1));
}

// Rays at every sample smooth the edges of shadows and of what curved mirrors show, which lowers the mean error against
// the tracer.
TEST(ExactEffects, RaysAtEverySampleReduceError) {
  const std::filesystem::path file = corner("effects_samples", shadowLight + nearBall + "mirror = {}\n");
  const TraceResult reference = traceSmall(file, {.samples = 16});
  QuietSession session(headless(file, small));
  const auto error = [&](const char* perSample) {
    set(session, {{"effects.per_sample", perSample}, {"reflection.max_depth", "3"}});
    return rootMeanSquare(drawRadiance(session), reference.image);
  };
  const double once = error("false");
  const double each = error("true");
  std::printf("RMSE with a ray a pixel %.5f, a ray a sample %.5f\n", once, each);
  EXPECT_LT(each, 0.8 * once);
}

// Centres of pixels at a rough floor's horizon may lie beyond it. Such pixels must not show the floor's back.
TEST(RoughFloor, ShowsNoBackAtTheHorizon) {
  const auto floor = [](const std::string& name, const std::string& back) {
    return writeScene(name,
                      "[environment]\nbackground = [0.2, 0.3, 0.4]\n[camera]\nposition = [0, 1.5, 0]\n"
                      "target = [0, 1.45, -1]\n[[mirror]]\nsize = [2000, 2000]\nrotation = [-90, 0, 0]\n"
                      "roughness = 0.4\nback_color = " +
                          back + "\n");
  };
  const Image8 black = draw(headless(floor("floor_black", "[0, 0, 0]"), size));
  const Image8 white = draw(headless(floor("floor_white", "[9, 9, 9]"), size));
  EXPECT_EQ(black.rgba, white.rgba);
}

// The floor goes on behind the wall, so that pixels of their seam have centres there and samples in front. From there a
// ray would meet the wall once more. So does one ray in thousands elsewhere, from a microfacet that is tilted far.
TEST(RoughFloor, MeetsAWallWithoutDarkPixels) {
  QuietSession session(
      headless(writeScene("floor_and_wall",
                          "[environment]\nbackground = [0.5, 0.5, 0.5]\n[camera]\nposition = [2.5, 1.8, 5]\n"
                          "target = [0, 0.8, 0]\n[[mirror]]\nsize = [8, 8]\nrotation = [-90, 0, 0]\nroughness = 0.15\n"
                          "reflectance = [0.8, 0.8, 0.8]\n[[mirror]]\nposition = [0, 1.5, -3]\nsize = [6, 3]\n"
                          "reflectance = [0.9, 0.9, 0.9]\n"),
               size, {{"effects.rough_samples", "256"}}));
  const LinearImage picture = drawRadiance(session);
  const auto darkest = std::ranges::min_element(picture.pixels, {}, [](const auto& pixel) { return pixel[0]; });
  EXPECT_NEAR((*darkest)[0], 0.5 * 0.8 * 0.9, 0.001);
}

// Many microfacets of a steep view face away. Those that replace them must not change the mean direction, whether the
// floor is seen directly or by rays in a mirror, which follow one microfacet each.
TEST(RoughFloor, SteepViewKeepsTheMean) {
  const std::string floor =
      "[environment]\nsky = { zenith = [1, 1, 1], horizon = [0, 0, 0], ground = [0, 0, 0] }\n[camera]\n"
      "position = [0, 1, 0]\ntarget = [0, 0.55, -1]\nvertical_fov = 20\n[[mirror]]\nsize = [2000, 2000]\n"
      "rotation = [-90, 0, 0]\nroughness = 0.7\nreflectance = [1, 1, 1]\n";
  const std::string smooth = "[[mirror]]\nposition = [0, 0, -1]\nsize = [20, 20]\nreflectance = [1, 1, 1]\n";
  const auto mean = [](const LinearImage& image) {
    double sum = 0.0;
    for (const auto& pixel : image.pixels) {
      sum += pixel[0];
    }
    return sum / static_cast<double>(image.pixels.size());
  };
  for (const bool inAMirror : {false, true}) {
    const std::filesystem::path file =
        writeScene(inAMirror ? "steep_floor_in_a_mirror" : "steep_floor", floor + (inAMirror ? smooth + byRays : ""));
    QuietSession session(
        headless(file, small, {{"effects.rough_samples", "64"}, {"view.accumulate", inAMirror ? "64" : "1"}}));
    const double drawn = mean(drawRadiance(session));
    const double traced = mean(traceSmall(file, {.samples = 4, .roughSamples = 64}).image);
    std::printf("mean radiance %.5f, traced %.5f\n", drawn, traced);
    EXPECT_NEAR(drawn, traced, 0.002 * traced) << (inAMirror ? "in a mirror" : "directly");
  }
}

// A green mirror lets no red light through.
TEST(ExactEffects, ThroughputIsPerChannel) {
  const std::filesystem::path file =
      corner("effects_throughput", plainLight +
                                       "[[mirror]]\nposition = [0, 1, -1.6]\nsize = [4, 2]\n"
                                       "reflectance = [1, 0.1, 0.1]\n" +
                                       pool + ripple + "reflectance = [0.1, 1, 0.1]\n");
  Truth truth = trace(file, size, 4);
  truth.tracing.options.minThroughput = 0.3;
  truth.traced = truth.tracing.result();
  truth.picture = toDisplay(truth.traced.image);
  Options options = truthOptions(file, size, 4);
  set(options, {{"reflection.min_throughput", "0.3"}});
  expectAlike(draw(options), truth.picture, 2, "effects_throughput", notBackground(truth.traced));
}

std::string randomMirror(Random& random, const std::string& placed) {
  std::ostringstream out;
  out << "[[mirror]]\n" << placed << "reflectance = " << random.vec(0.4, 1) << "\n";
  const auto flag = [&](double probability, const std::string& line) {
    if (random.chance(probability)) {
      out << line << "\n";
    }
  };
  flag(0.4, "casts_light = true");
  flag(0.4, "two_sided = true");
  flag(0.4, "fresnel = \"schlick\"");
  flag(0.4, "base_color = " + random.vec(0, 0.5));
  flag(0.5, "back_color = " + random.vec(0, 0.5));
  if (random.chance(0.4)) {
    out << "ripple = { amplitude = " << random.uniform(0.001, 0.006) << ", wavelength = " << random.uniform(0.3, 0.8)
        << ", speed = " << random.uniform(-0.5, 0.5) << " }\n";
  }
  return out.str();
}

std::filesystem::path randomScene(unsigned seed) {
  Random random(seed + 5000);
  std::ostringstream out;
  for (int i = 0; i < 2; ++i) {
    out << "[[light]]\nposition = [" << random.uniform(-2, 2) << ", " << random.uniform(1.5, 3) << ", "
        << random.uniform(-1, 2.5) << "]\ncolor = " << random.vec(0.2, 1) << "\nintensity = " << random.uniform(3, 12)
        << "\ncasts_shadow = " << (random.chance(0.7) ? "true" : "false") << "\n";
  }
  out << "[[object]]\nmodel = \"" << writeRandomMesh(seed) << "\"\nposition = [" << random.uniform(-1, 1) << ", 0.6, "
      << random.uniform(0.8, 1.6) << "]\nscale = [" << random.uniform(0.3, 0.7) << ", -0.6, 0.5]\n";
  if (random.chance(0.5)) {
    out << "mirror = { reflectance = " << random.vec(0.3, 1) << ", base_color = " << random.vec(0, 0.3) << " }\n";
  }
  std::ostringstream back;
  back << "position = [0, 1, " << random.uniform(-2, -1) << "]\nsize = [4, 2]\n";
  std::ostringstream beside;
  beside << "position = [" << random.uniform(-2.2, 2.2) << ", 1, 0]\nrotation = [0, " << random.uniform(-180, 180)
         << ", 10]\nsize = [1.5, 1.2]\n";
  out << randomMirror(random, back.str()) << randomMirror(random, beside.str())
      << randomMirror(random, "position = [0, 0.05, 1.3]\nrotation = [-90, 0, 0]\nsize = [3, 1.5]\n");
  return corner("effects_random_" + std::to_string(seed), out.str());
}

class RandomEffects : public testing::TestWithParam<unsigned> {};

TEST_P(RandomEffects, EqualTheRayTracer) {
  const std::filesystem::path file = randomScene(GetParam());
  expectTruth(file, size, 3, trace(file, size, 3, 2.5), 2.5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomEffects, testing::ValuesIn(sampledSeeds(25, 7)),
                         testing::PrintToStringParamName());

class RoughMirror : public testing::Test {
 protected:
  std::filesystem::path file_ = corner("effects_rough", plainLight + wall + "roughness = 0.35\n");

  // Traced once for all tests.
  const TraceResult& reference() const {
    static const TraceResult traced = traceSmall(file_, {.samples = 1, .roughSamples = 1024});
    return traced;
  }

  double error(const SettingList& settings) {
    session_.setSettings(usual_);
    set(session_, settings);
    return mirrorError(drawRadiance(session_), reference());
  }

  QuietSession session_{truthOptions(file_, small, 3)};
  const Settings usual_ = session_.settings();
};

// 8 times as many rays lower the RMSE by a factor of at least 1.8. Theory says 8^0.5, until the reference's own noise
// dominates.
TEST_F(RoughMirror, MoreRaysReduceError) {
  const double two = error({{"effects.rough_samples", "2"}});
  const double sixteen = error({{"effects.rough_samples", "16"}});
  const double most = error({{"effects.rough_samples", "128"}});
  std::printf("RMSE with 2, 16, 128 rays: %.5f %.5f %.5f\n", two, sixteen, most);
  EXPECT_LT(sixteen, two / 1.8);
  EXPECT_LT(most, sixteen / 1.8);
}

// A mirror whose microfacets turn by 1e-4, seen at an angle of view of 1 degree, blurs an edge over pixels.
TEST(FaintRoughness, BlursWhatIsSeenFromFar) {
  const std::filesystem::path file = writeScene(
      "faint_roughness",
      "[environment]\nbackground = [0.1, 0.1, 0.1]\nambient = [1, 1, 1]\n" + cameraText({0, 0, 0}, {0, 0, -10}) +
          "vertical_fov = 1\n[[mirror]]\nposition = [0, 0, -10]\nsize = [4, 4]\nroughness = 0.0125\n" +
          "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = [0.5, -5, 10]\nrotation = [0, 0, 3]\n"
          "scale = [1, 10, 1]\n");
  QuietSession session(truthOptions(file, small, 3));
  set(session, {{"effects.rough_samples", "256"}});
  const double error = mirrorError(drawRadiance(session), traceSmall(file, {.samples = 1, .roughSamples = 1024}));
  std::printf("RMSE %.5f\n", error);
  EXPECT_LT(error, 0.004);
}

// A blurred image of the smooth mirror is far nearer to the truth than a smooth mirror. With as many lookups as rays
// it is worse than tracing, because it lacks what the smooth mirror does not show.
TEST_F(RoughMirror, ImageLookupLiesBetweenSmoothAndTraced) {
  const double smooth = error({{"effects.roughness", "false"}});
  const double few = error({{"effects.rough_lookup", "image"}, {"effects.rough_samples", "4"}});
  const double image = error({{"effects.rough_lookup", "image"}, {"effects.rough_samples", "64"}});
  const double traced = error({{"effects.rough_samples", "64"}});
  std::printf("RMSE smooth %.5f, image 4 %.5f, image 64 %.5f, traced 64 %.5f\n", smooth, few, image, traced);
  EXPECT_LT(image, few);
  EXPECT_LT(image, 0.5 * smooth);
  EXPECT_LT(traced, image);
}

// With effects.per_sample each sample looks up microfacets of its own.
TEST(RoughMirrorWithShadows, LooksUpMoreAtEverySample) {
  const std::filesystem::path file = corner("effects_rough_samples", shadowLight + wall + "roughness = 0.35\n");
  QuietSession session(headless(file, small));
  TraceResult smooth = traceSmall(file, {.samples = 1});
  const auto noise = [&](const char* perSample) {
    set(session, {{"effects.per_sample", perSample}, {"effects.rough_lookup", "image"}});
    const auto drawn = [&](const char* lookups) {
      set(session, {{"effects.rough_samples", lookups}});
      return drawRadiance(session);
    };
    smooth.image = drawn("256");
    return mirrorError(drawn("2"), smooth);
  };
  const double pixel = noise("false");
  const double samples = noise("true");
  std::printf("RMSE of 2 lookups a pixel %.5f, at each of 4 samples %.5f\n", pixel, samples);
  EXPECT_LT(samples, 0.75 * pixel);
}

// Ripples that look up the smooth mirror's image are nearer to the truth than a smooth mirror.
TEST(RippledMirror, ImageLookupLiesBetweenSmoothAndTraced) {
  const std::filesystem::path file = corner("effects_ripple", plainLight + pool + ripple);
  const TraceResult truth = traceSmall(file, {.samples = 16});
  QuietSession session(truthOptions(file, small, 3));
  const Settings usual = session.settings();
  const auto error = [&](const SettingList& settings) {
    session.setSettings(usual);
    set(session, settings);
    const double e = mirrorError(drawRadiance(session), truth);
    EXPECT_EQ(session.lastFrame().plan.effects.ripple.has_value(), settings[0].first != "effects.ripple");
    return e;
  };
  const double smooth = error({{"effects.ripple", "false"}});
  const double image = error({{"effects.ripple_lookup", "image"}});
  const double traced = error({{"effects.ripple_lookup", "traced"}});
  std::printf("RMSE smooth %.5f, image %.5f, traced %.5f\n", smooth, image, traced);
  // Tracing errs by what one sample a pixel misses.
  EXPECT_LT(image - traced, 0.5 * (smooth - traced));
  EXPECT_LT(traced, image);
}

// With an effect switched off, the scene is drawn as if it did not have it.
TEST(Effects, CanBeSwitchedOff) {
  const std::string all = shadowLight + plainLight + wall + "casts_light = true\nroughness = 0.2\n" + pool + ripple;
  const std::string none = "[[light]]\nposition = [1.2, 2.6, 1.9]\nintensity = 14\n" + plainLight + wall + pool;
  Options options = truthOptions(corner("effects_off", all), size, 3);
  set(options, {{"effects.shadows", "false"},
                {"effects.roughness", "false"},
                {"effects.ripple", "false"},
                {"effects.casts_light", "false"}});
  const Image8 off = draw(options);
  EXPECT_EQ(off.rgba, draw(truthOptions(corner("effects_none", none), size, 3)).rgba);
}

// Effects without rays can be switched off where they are seen directly, in a mirror and by rays in a curved mirror.
TEST(Effects, EffectsWithoutRaysCanBeSwitchedOff) {
  const auto panel = [](const std::string& name, const std::string& material) {
    const std::filesystem::path file = sceneDirectory() / (name + ".obj");
    std::ofstream(sceneDirectory() / (name + ".mtl")) << "newmtl m\nKd 0.8 0.7 0.3\n" << material;
    std::ofstream(file) << "mtllib " << name << ".mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                        << "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    return "[[object]]\nmodel = \"" + file.string() + "\"\nposition = [-0.4, 0.1, 0.8]\n";
  };
  Image8 texture(2, 2);
  for (size_t i = 0; i < texture.rgba.size(); ++i) {
    texture.rgba[i] = static_cast<uint8_t>(37 * i % 256);
  }
  writePng(sceneDirectory() / "squares.png", texture);
  const std::string ball = "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [0.3, 1.2, 1]\nscale = 0.3\n";
  const std::string pot =
      "[environment]\nbackground = [0.25, 0.3, 0.4]\n[camera]\nposition = [0.3, 1.7, 3.6]\n"
      "target = [0, 0.6, 0]\n[[object]]\nmodel = \"MODELS/teapot.obj\"\nposition = [0.9, 0.1, 0.4]\n";
  const std::string light = "[[light]]\nposition = [-0.9, 1.3, 1]\nradius = 0.1\nintensity = 5\n";
  const std::string schlick = "fresnel = \"schlick\"\n";
  const std::string dim = "reflectance = [0.5, 0.6, 0.7]\n";
  const std::string all = pot + light + "glow = 3\n" + wall + dim + schlick +
                          panel("textured", "map_Kd squares.png\n") + ball +
                          "mirror = { reflectance = [0.5, 0.6, 0.7], fresnel = \"schlick\" }\n";
  const std::string none = pot + light + "glow = 0\n" + wall + dim + panel("plain", "") + ball +
                           "mirror = { reflectance = [0.5, 0.6, 0.7] }\n";
  const std::filesystem::path expected = writeScene("switched_none", none);
  QuietSession session(truthOptions(writeScene("switched_off", all), small, 3));
  QuietSession plain(truthOptions(expected, small, 3));
  const auto drawn = [](Session& of, const std::string& key, const std::string& value) {
    set(of, {{key, value}});
    return draw(of);
  };
  const std::vector<std::string> effects = {"effects.fresnel", "effects.transparency", "effects.textures",
                                            "effects.glyphs"};
  for (const char* lookup : {"traced", "environment"}) {
    Image8 last = drawn(session, "effects.curved_lookup", lookup);
    for (const std::string& key : effects) {
      const Image8 off = drawn(session, key, "false");
      EXPECT_NE(off.rgba, last.rgba) << key;
      last = off;
    }
    EXPECT_EQ(last.rgba, drawn(plain, "effects.curved_lookup", lookup).rgba) << lookup;
    for (const std::string& key : effects) {
      set(session, {{key, "true"}});
    }
  }
  expectTruth(expected, size, 3, trace(expected, size, 3));
}

}  // namespace
}  // namespace speculum
