// view.accumulate: means of pictures with sub-pixel offsets.
#include "accuracy/ground_truth.hpp"
#include "effect_scenes.hpp"
#include "image/image.hpp"
#include "picture_support.hpp"
#include "plan/pass_mask.hpp"
#include "plan/refined_tiles.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{48, 27};

Options shipped(const std::string& scene, int pictures) {
  return headless(sceneFile(scene), size, {{"view.accumulate", std::to_string(pictures)}});
}

Image8 shown(Session& session, int pictures) {
  set(session, {{"view.accumulate", std::to_string(pictures)}});
  return draw(session);
}

// Draws one picture of a mean by itself.
LinearImage single(Session& session, const SceneState& state, const Settings& mean, int picture) {
  const FramePlan plan = planFrame({session.scene(), state, mean, {size.width, size.height}, {}, picture});
  Settings alone = mean;
  alone.view.accumulate = 1;
  recordFrame(session, state, alone, plan);
  return session.radiance();
}

TEST(Accumulation, IsTheMeanOfItsPictures) {
  for (const int pictures : {3, 17}) {
    Options options = shipped(pictures == 3 ? "facing_mirrors" : "single_plane", pictures);
    set(options, {{"view.scale", pictures == 3 ? "1" : "0.5"}});
    QuietSession session(options);
    const SceneState state = evaluate(session.scene(), 0.0);
    const Settings mean = pictureSettings(session.settings());
    EXPECT_EQ(mean.view.samples, pictures == 3 ? 4 : 1);
    session.draw(0.0, true);
    const LinearImage accumulated = session.radiance();
    const Image8 display = toDisplay(accumulated, mean.view.displayCurve());
    EXPECT_EQ(difference(session.picture(), display, 1).over, 0) << "neither exposure nor tone curve changes the sum";
    if (pictures == 17) {
      continue;  // drawn at a lower scale and enlarged
    }
    std::vector<glm::dvec3> sum(accumulated.pixels.size(), glm::dvec3(0.0));
    for (int i = 0; i < pictures; ++i) {
      const LinearImage image = single(session, state, mean, i);
      for (size_t k = 0; k < sum.size(); ++k) {
        sum[k] += glm::dvec3(image.pixels[k]);
      }
    }
    for (size_t k = 0; k < sum.size(); ++k) {
      const glm::dvec3 off = glm::abs(sum[k] / double(pictures) - glm::dvec3(accumulated.pixels[k]));
      ASSERT_LE(std::max({off.r, off.g, off.b}), 1e-6 * (1.0 + sum[k].r + sum[k].g + sum[k].b)) << k;
    }
  }
}

TEST(Accumulation, BeginsWithThePictureItself) {
  QuietSession session(shipped("rough", 1));
  const LinearImage picture = drawRadiance(session);
  set(session, {{"view.accumulate", "5"}});
  session.draw(0.0, false, [] { return false; });
  EXPECT_EQ(session.lastFrame().pictures, 1);
  EXPECT_TRUE(session.radiance().pixels == picture.pixels);
}

TEST(Accumulation, CountsAllPicturesInItsFigures) {
  Options options = shipped("single_plane", 1);
  options.size = {96, 54};
  Session session(options);
  runFrames(session);
  const DrawnFrame one = session.lastFrame();
  EXPECT_EQ(one.pictures, 1);
  double oneMs = one.gpuMs;  // the least of some, because other programs only ever add to it
  for (int frame = 0; frame < 4; ++frame) {
    session.restart();
    runFrames(session);
    oneMs = std::min(oneMs, session.lastFrame().gpuMs);
  }
  shown(session, 5);
  session.finish();
  const DrawnFrame& five = session.lastFrame();
  EXPECT_EQ(five.pictures, 5);
  ASSERT_EQ(five.passes().size(), one.passes().size() + 1);
  for (size_t i = 0; i < one.passes().size(); ++i) {
    const bool displays = one.passes()[i].kind == PassKind::display;
    const size_t k = displays ? i + 1 : i;
    EXPECT_EQ(five.passes()[k].name, one.passes()[i].name);
    EXPECT_NEAR(five.passes()[k].draws, one.passes()[i].draws * (displays ? 1 : 5), 0.02 * five.passes()[k].draws)
        << "clusters may differ at the edge";
    EXPECT_NEAR(five.passes()[k].timing.triangles, 5.0 * one.passes()[i].timing.triangles,
                0.05 * five.passes()[k].timing.triangles + (displays ? 10 : 0));
  }
  EXPECT_EQ(five.passes()[one.passes().size() - 1].draws, 5u) << "of the pass that adds";
  EXPECT_GT(five.gpuMs, 2.0 * oneMs);
}

// The mean hides a wrong value in one picture, so pictures are checked before they are summed.
TEST(Accumulation, EveryPictureIsCheckedBeforeSumming) {
  const std::filesystem::path shaders = sceneDirectory() / "shaders";
  std::filesystem::create_directories(shaders);
  writeShaders(shaders, "scene_shading.glsl", "  color.r = view.picture == 2u ? -0.01 : color.r;\n");
  Options options = shipped("no_mirror", 4);
  options.shaderDir = shaders;
  Session session(options);
  runFrames(session);
  EXPECT_EQ(session.device().validationMessages(), 0);
  EXPECT_GT(session.sceneRenderer().finiteWatch().count(), 100u);
}

TEST(Accumulation, FinishedMeanIsShownWithoutDrawing) {
  QuietSession session(shipped("single_plane", 4));
  const Image8 picture = shown(session, 4);
  const SceneState state = evaluate(session.scene(), 0.0);
  const Settings settings = pictureSettings(session.settings());
  const FramePlan plan = planFrame({session.scene(), state, settings, {size.width, size.height}, {}, 4});
  EXPECT_TRUE(plan.drawnMirrors().empty());
  recordFrame(session, state, settings, plan);
  EXPECT_EQ(session.sceneRenderer().passes().size(), 1u);
  EXPECT_EQ(session.picture().rgba, picture.rgba);
  const FramePlan late = planFrame({session.scene(), state, settings, {size.width, size.height}, {}, 2});
  Frame frame = session.renderer().beginFrame().value();
  EXPECT_THROW(session.sceneRenderer().record(frame, state, settings, late), std::logic_error);
  session.renderer().endFrame(frame);
}

// Draws picture `number` of a mean, `step` tiles in each frame; 0: all in one. Stops before tile `end`, or before the
// last one, where `end` is given.
void drawTiles(Session& session, int number, size_t step, size_t end = SIZE_MAX) {
  const SceneState state = evaluate(session.scene(), 1.0);
  const Settings mean = pictureSettings(session.settings());
  FrameCache cache = session.sceneRenderer().cache(state);
  cache.main = nullptr;
  FramePlan plan =
      planFrame({session.scene(), state, mean, {session.size().width, session.size().height}, cache, number});
  const size_t count = tileCount(plan);
  const size_t stop = end == SIZE_MAX ? count : std::min(end, count - 1);
  for (size_t first = 0; first < stop; first += step == 0 ? count : step) {
    if (step > 0) {
      plan.tiles = {first, std::min(first + step, stop)};
    }
    recordFrame(session, state, mean, plan);
  }
}

Options inTiles(const std::string& scene) {
  return headless(sceneFile(scene), {130, 70}, {{"view.accumulate", "16"}, {"debug.check_finite", "false"}});
}

class Tiles : public testing::TestWithParam<const char*> {};

TEST_P(Tiles, ChangeNoByte) {
  QuietSession session(inTiles(GetParam()));
  drawTiles(session, 0, 0);
  const LinearImage first = session.radiance();
  const size_t passes = session.sceneRenderer().passes().size();
  drawTiles(session, 1, 0);
  const LinearImage second = session.radiance();
  for (const size_t step : {48, 7}) {
    drawTiles(session, 0, step);
    EXPECT_TRUE(session.radiance().pixels == first.pixels) << step;
    EXPECT_EQ(session.sceneRenderer().passes().size(), passes);
    drawTiles(session, 1, 20, 60);
    EXPECT_TRUE(session.radiance().pixels == first.pixels) << "an unfinished picture is not shown";
    drawTiles(session, 1, step);
    EXPECT_TRUE(session.radiance().pixels == second.pixels) << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Tiles,
                         testing::ValuesIn(fullTests()
                                               ? std::vector{"gallery", "facing_mirrors", "mirror_ball", "shadows"}
                                               : std::vector{"facing_mirrors", "mirror_ball"}));

TEST(UnfinishedTiles, AreNotShownAndCanBeDropped) {
  QuietSession session(inTiles("facing_mirrors"));
  set(session, {{"view.accumulate", "1"}});
  const LinearImage draft = drawRadiance(session, 1.0);
  set(session, {{"view.accumulate", "16"}});
  drawTiles(session, 0, 0);
  const LinearImage whole = session.radiance();
  set(session, {{"view.accumulate", "1"}});
  session.draw(1.0, false);
  set(session, {{"view.accumulate", "16"}});
  for (int i = 0; i < 3; ++i) {
    drawTiles(session, 0, 20, 60);
    EXPECT_TRUE(session.radiance().pixels == draft.pixels) << "the picture before stays";
  }
  drawTiles(session, 0, 20);
  EXPECT_TRUE(session.radiance().pixels == whole.pixels);
  drawTiles(session, 1, 20, 40);
  set(session, {{"view.accumulate", "1"}});
  EXPECT_TRUE(drawRadiance(session, 1.0).pixels == draft.pixels);
}

// Several samples a pixel; mirrors read the images of others sample by sample, or averaged at another render scale.
TEST(MultisampledTiles, ChangeNoByte) {
  for (const char* scale : {"1", "0.5"}) {
    Options options = inTiles("facing_mirrors");
    set(options, {{"view.accumulate", "1"}, {"view.samples", "4"}, {"reflection.samples", "4"}});
    set(options, {{"reflection.scale", scale}});
    QuietSession session(options);
    drawTiles(session, 0, 0);
    const LinearImage whole = session.radiance();
    for (const size_t step : {31, 9}) {
      session.restart();
      drawTiles(session, 0, step);
      EXPECT_TRUE(session.radiance().pixels == whole.pixels) << scale << " " << step;
      drawTiles(session, 0, step);
      EXPECT_TRUE(session.radiance().pixels == whole.pixels) << scale << ": unchanged images are shown again";
    }
  }
}

// Shadow and environment maps of scenes that move.
class MapTiles : public testing::TestWithParam<const char*> {};

TEST_P(MapTiles, ChangeNothingAndAreReusedOnceComplete) {
  Options options = inTiles(GetParam());
  set(options, {{"view.accumulate", "1"}, {"view.samples", "1"}, {"reflection.samples", "1"}});
  set(options, {{"effects.shadow_lookup", "map"}, {"effects.curved_lookup", "environment"}});
  QuietSession session(options);
  const LinearImage later = drawRadiance(session, 1.0);
  const LinearImage early = drawRadiance(session, 0.0);
  EXPECT_FALSE(later.pixels == early.pixels);
  drawTiles(session, 0, 2, 4);
  EXPECT_TRUE(drawRadiance(session, 0.0).pixels == early.pixels) << "maps of two times are not reused";
  drawTiles(session, 0, 5);
  EXPECT_TRUE(session.radiance().pixels == later.pixels);
}

INSTANTIATE_TEST_SUITE_P(Scenes, MapTiles, testing::Values("shadows", "mirror_ball"));

// The rays of a small rough mirror count as if it filled the picture: with many, the commands of a picture are
// submitted in parts. It adds too little to be seen, so bytes and figures stay the same.
class LongDraws : public testing::TestWithParam<std::tuple<const char*, const char*>> {
 protected:
  static std::unique_ptr<QuietSession> start(const char* roughSamples) {
    const auto& [samples, curvedLookup] = GetParam();
    const std::string scene = effectFloor + shadowLight + wall + "casts_light = true\n" + side + pool + ripple +
                              "[[mirror]]\nposition = [1.5, 1.2, 0]\nsize = [0.2, 0.2]\nroughness = 0.3\n"
                              "reflectance = [1e-30, 1e-30, 1e-30]\n"
                              "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [-0.4, 0.6, 0.9]\nscale = 0.4\n"
                              "mirror = { reflectance = [0.9, 0.8, 0.6] }\n";
    return std::make_unique<QuietSession>(headless(writeScene("long_draws", scene), {160, 90},
                                                   {{"view.samples", samples},
                                                    {"reflection.samples", samples},
                                                    {"effects.rough_samples", roughSamples},
                                                    {"effects.per_sample", "true"},
                                                    {"reflection.min_throughput", "0"},
                                                    {"effects.curved_lookup", curvedLookup},
                                                    {"effects.environment_size", "64"}}));
  }
};

TEST_P(LongDraws, AreDividedWithoutATrace) {
  const auto whole = start("4");
  const auto divided = start("4096");
  for (const char* checks : {"false", "true"}) {
    SCOPED_TRACE(checks);
    for (Session* session : {whole.get(), divided.get()}) {
      set(*session, {{"debug.check_finite", checks}});
      session->restart();
    }
    const Image8 picture = draw(*whole);
    EXPECT_EQ(draw(*divided).rgba, picture.rgba);
    const std::vector<TimedPass> expected = whole->lastFrame().passes();
    const std::vector<TimedPass>& passes = divided->lastFrame().passes();
    // A draw of its own may average the samples of the main view.
    EXPECT_LE(whole->renderer().timings().passes.size(), expected.size() + 1) << "undivided";
    EXPECT_GT(divided->renderer().timings().passes.size(), passes.size() + 1);
    ASSERT_EQ(passes.size(), expected.size());
    for (size_t i = 0; i < passes.size(); ++i) {
      EXPECT_EQ(passes[i].name, expected[i].name);
      EXPECT_EQ(passes[i].draws, expected[i].draws) << passes[i].name;
      // With several samples a part may write beyond its edge, see tileRects().
      if (divided->settings().view.samples == 1) {
        EXPECT_EQ(passes[i].timing.samples, expected[i].timing.samples) << passes[i].name;
      }
      EXPECT_EQ(passes[i].timing.gpuMs > 0.0, expected[i].timing.gpuMs > 0.0) << passes[i].name;
    }
  }
  for (Session* session : {whole.get(), divided.get()}) {
    set(*session, {{"debug.check_finite", "false"}});
    session->restart();
    drawTiles(*session, 0, session == divided.get() ? 50 : 0);
  }
  EXPECT_TRUE(divided->radiance().pixels == whole->radiance().pixels) << "in frames with tiles";
}

// Unless all run, each value comes once.
std::vector<std::tuple<const char*, const char*>> longDraws() {
  std::vector<std::tuple<const char*, const char*>> values = {{"1", "traced"}, {"4", "environment"}};
  if (fullTests()) {
    values.insert(values.end(), {{"1", "environment"}, {"4", "traced"}});
  }
  return values;
}

INSTANTIATE_TEST_SUITE_P(Values, LongDraws, testing::ValuesIn(longDraws()));

// A mean that is drawn on where it has not converged: at each texel it is the whole mean of the pictures up to where
// its tile stopped, whatever the mirrors show, and whether or not what has converged is left out of passes.
struct RefinedScene {
  const char* name;
  SettingList settings;
  // Steps. A rough mirror is noisy, and scenes with detail everywhere have an error above 0.5 steps in nearly all tiles
  // after 32 pictures, measured against the mean of 256.
  const char* limit = "0.5";
  int pictures = 33;  // of the whole mean, in full tests
};

class RefinedMeans : public testing::TestWithParam<RefinedScene> {};

TEST_P(RefinedMeans, AreWholeMeansUpToWhereTheyStopped) {
  const int all = fullTests() ? GetParam().pictures : 17;
  Options options = inTiles(GetParam().name);
  options.size = fullTests() ? options.size : PictureSize{90, 50};
  set(options, {{"view.accumulate", std::to_string(all)}});
  set(options, GetParam().settings);
  QuietSession session(options);
  std::map<int, LinearImage> whole;
  session.draw(0.0, false, [&] {
    const int pictures = session.lastFrame().pictures;
    if (decidesTiles(pictures) || pictures == all) {
      whole[pictures] = session.radiance();
    }
    return true;
  });
  const auto samples = [&] {
    session.finish();
    double sum = 0.0;
    std::ranges::for_each(session.lastFrame().passes(), [&](const TimedPass& p) { sum += p.timing.samples; });
    return sum;
  };
  const double wholeSamples = samples();
  const SettingList stops{{"view.accumulate_error", GetParam().limit}};
  set(session, stops);
  std::map<int, std::shared_ptr<const RefinedTiles>> decisions;
  session.draw(0.0, true, [&] {
    if (const auto& refined = session.lastFrame().plan.refined) {
      decisions[refined->decidedAfter] = refined;
    }
    return true;
  });
  EXPECT_LT(samples(), wholeSamples);
  const LinearImage mean = session.radiance();
  const Image8 picture = session.picture();
  ASSERT_FALSE(decisions.empty());
  int stopped = 0;
  for (int y = 0; y < mean.height; ++y) {
    for (int x = 0; x < mean.width; ++x) {
      int pictures = all;
      for (const auto& [after, refined] : decisions) {
        const int tile = y / refinedSide * refined->grid().x + x / refinedSide;
        pictures = refined->tiles[static_cast<size_t>(tile)] == 0 ? std::min(pictures, after) : pictures;
      }
      stopped += pictures < all;
      const glm::vec3 off = glm::abs(mean.at(x, y) - whole[pictures].at(x, y));
      ASSERT_LE(std::max({off.r, off.g, off.b}), 1e-5f * (1.0f + glm::length(mean.at(x, y))))
          << x << ", " << y << " of " << pictures << " pictures";
    }
  }
  EXPECT_GT(stopped, 0);
  EXPECT_LT(stopped, mean.width * mean.height);
  set(session, {{"debug.mask_passes", "false"}});
  EXPECT_EQ(draw(session).rgba, picture.rgba);
  if (fullTests() || std::string_view(GetParam().name) == "shadows") {
    options.renderPath = RenderPath::renderPass;
    set(options, stops);
    QuietSession other(options);
    EXPECT_EQ(draw(other).rgba, picture.rgba) << "the same on both render paths";
  }
}

std::vector<RefinedScene> refinedScenes() {
  std::vector<RefinedScene> scenes{{"shadows", {{"effects.shadow_lookup", "map"}}},
                                   {"facing_mirrors", {{"reflection.scale", "0.5"}}},
                                   {"rough", {{"effects.rough_lookup", "image"}}, "2"}};
  if (fullTests()) {
    scenes.insert(scenes.end(), {{"gallery", {}, "2"},
                                 {"mirror_ball", {}, "2"},
                                 {"gallery", {}, "0.5", 65},
                                 {"facing_mirrors", {{"reflection.scale", "2"}, {"reflection.max_depth", "6"}}},
                                 {"pool", {{"effects.ripple_lookup", "image"}}}});
  }
  return scenes;
}

INSTANTIATE_TEST_SUITE_P(Scenes, RefinedMeans, testing::ValuesIn(refinedScenes()),
                         [](const auto& info) { return std::string(info.param.name) + std::to_string(info.index); });

// A picture that has converged everywhere is complete, and is shown without further pictures.
TEST(Accumulation, EndsWhereEverythingHasConverged) {
  QuietSession session(headless(
      writeScene("flat",
                 "[environment]\nbackground = [0.2, 0.3, 0.4]\n[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\n"),
      size, {{"view.accumulate", "64"}, {"view.accumulate_error", "0.25"}}));
  int frames = 0;
  session.draw(0.0, true, [&] { return ++frames > 0; });
  EXPECT_EQ(frames, 17) << "sixteen pictures, and the mean again";
  session.finish();
  EXPECT_EQ(session.lastFrame().pictures, 16);
  EXPECT_EQ(session.lastFrame().passes().back().kind, PassKind::display);
  const Image8 picture = session.picture();
  set(session, {{"view.accumulate_error", "0"}});
  EXPECT_EQ(draw(session).rgba, picture.rgba);
}

// Rough mirrors trace other rays in each picture, so that the mean is as smooth as with more rays a pixel.
TEST(Accumulation, RoughMirrorsDrawNewRandomNumbers) {
  for (const char* lookup : {"traced", "image"}) {
    QuietSession session(headless(writeScene("rough", wallScene + "roughness = 0.3\n"), {32, 18},
                                  {{"effects.rough_lookup", lookup}, {"effects.rough_samples", "16"}}));
    shown(session, 16);  // 256 rays a pixel
    const LinearImage truth = session.radiance();
    const auto error = [&](int rays, int pictures) {
      set(session, {{"effects.rough_samples", std::to_string(rays)}});
      shown(session, pictures);
      return rootMeanSquare(session.radiance(), truth);
    };
    const double one = error(1, 16);
    EXPECT_LT(one, 0.7 * error(1, 4)) << lookup;
    EXPECT_GT(one, 1.5 * error(4, 16)) << lookup << ": what is left is the noise of rays";
  }
}

// Errors of means against the tracer, with every effect that it traces. "plain0" is a corner of plainScene(0).
class AccumulationTruth : public testing::TestWithParam<std::string> {};

TEST_P(AccumulationTruth, FallsToTheNoiseFloor) {
  const bool plain = GetParam().starts_with("plain");
  writeQuad();
  const PictureSize extent = plain ? PictureSize{192, 108} : size;
  const unsigned seed = GetParam().back() - '0';
  Options options =
      plain ? headless(writeScene("plain", plainScene(seed, PlainMirrors::corner)), extent) : shipped(GetParam(), 1);
  set(options, {{"reflection.max_passes", "100000"},
                {"reflection.min_pixels", "0"},
                {"reflection.min_throughput", "0"},
                {"reflection.max_depth", fullTests() ? "32" : "2"},
                {"effects.shadow_lookup", "traced"},
                {"view.samples", "1"},
                {"reflection.samples", "1"}});
  if (GetParam() == "mirror_maze") {
    set(options, {{"reflection.method", "rays"}});  // the number of images grows as a power of the depth
  }
  QuietSession session(options);
  // Traced at the positions at which the pictures are drawn: what is left is not for want of samples.
  const std::optional<GroundTruth> truth = traceGroundTruth(session.scene(), evaluate(session.scene(), 0.0),
                                                            {.width = extent.width,
                                                             .height = extent.height,
                                                             .samples = 64,
                                                             .floorSamples = 81,
                                                             .settings = session.settings()},
                                                            {});
  double before = INFINITY;
  for (const int pictures : {1, 4, 16, 64}) {
    const double flip = errorsAgainst(*truth, shown(session, pictures), session.settings()).whole.flip;
    if (!plain) {
      EXPECT_LT(flip, 0.75 * before) << pictures;
    }
    before = flip;
  }
  EXPECT_LE(before, 1.1 * truth->floor.whole.flip) << "of a 9x9 grid";
}

INSTANTIATE_TEST_SUITE_P(Scenes, AccumulationTruth, testing::ValuesIn([] {
                           std::vector<std::string> names =
                               fullTests() ? sceneNames() : std::vector<std::string>{"shadows"};
                           names.insert(names.end(), {"plain0", "plain1", "plain2"});
                           return names;
                         }()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace speculum
