// Pictures with reflection.update_interval above 1: exact while nothing moves, close to fresh ones when the camera
// does.
#include "plan/reuse_support.hpp"
#include "sampling.hpp"

namespace speculum::cached_pictures {
namespace {

using namespace testing_support;

constexpr PictureSize size{320, 180};
constexpr PictureSize small{160, 90};
constexpr PictureSize tiny{64, 36};
constexpr double frameSeconds = 1.0 / 30.0;

// A mirror fills the view and shows objects behind the camera, which turns about the mirror's middle. The objects are
// large and have no fine textures, so that errors come from wrong positions and not from filtering once more. `mirror`
// holds further keys of the mirror.
std::filesystem::path wallScene(const std::string& name, const std::string& mirror = "") {
  return writeScene(name, R"(
[environment] sky = { zenith = [0.1, 0.2, 0.5], horizon = [0.6, 0.5, 0.4], ground = [0.1, 0.1, 0.1] }
  ambient = [0.2, 0.2, 0.2]
[camera] position = [0, 1, 3], target = [0, 1, -2], orbit_speed = 20
[[object]] model = "MODELS/torus_knot.obj", position = [-1.6, 1.2, 5], scale = 4, color = [0.8, 0.5, 0.1]
[[object]] model = "MODELS/teapot.obj", position = [1.8, 0.2, 6.5], scale = 3
[[object]] model = "MODELS/sphere.obj", position = [0.6, 3.4, 9], scale = 2.5, color = [0.1, 0.5, 0.2]
[[light]] position = [2, 5, 2], intensity = 40
[[mirror]] name = "wall", position = [0, 1, -2], size = [60, 60], reflectance = [0.9, 0.9, 0.9]
)" + mirror);
}

Options withInterval(const std::filesystem::path& scene, int interval, PictureSize pictureSize = small) {
  return headless(scene, pictureSize,
                  {{"reflection.update_interval", std::to_string(interval)}, {"reflection.skip_unchanged", "false"}});
}

class StillScene : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(StillScene, IntervalChangesNoByte) {
  const auto& [name, scale] = GetParam();
  Options options = withInterval(sceneFile(name), 1, tiny);
  set(options, {{"reflection.scale", scale}, {"view.samples", scale == "1" ? "4" : "1"}});
  QuietSession session(options);
  const Image8 expected = draw(session, 1.0);
  for (const int interval : fullTests() ? std::vector{2, 5} : std::vector{3}) {
    set(session, {{"reflection.update_interval", std::to_string(interval)}});
    session.restart();
    int skipped = 0;
    for (int frame = 0; frame < interval + 2; ++frame) {
      ASSERT_EQ(draw(session, 1.0).rgba, expected.rgba) << "interval " << interval << ", frame " << frame;
      skipped +=
          static_cast<int>(std::ranges::count(session.lastFrame().plan.passes, PassSource::reused, &Pass::source));
    }
    EXPECT_GT(skipped, 0);
  }
}

std::vector<std::tuple<std::string, std::string>> stillScenes() {
  if (fullTests()) {
    return {{"gallery", "1"},        {"many_mirrors", "1"},     {"facing_mirrors", "1"},         {"gallery", "0.5"},
            {"many_mirrors", "0.5"}, {"facing_mirrors", "0.5"}, {"../tests/golden/effects", "1"}};
  }
  return {{"facing_mirrors", "0.5"}, {"../tests/golden/effects", "1"}};
}

INSTANTIATE_TEST_SUITE_P(Scenes, StillScene, testing::ValuesIn(stillScenes()));

struct Lookup {
  const char* name;
  const char* samples;
  const char* viewSamples;
  const char* scale;
  const char* mirror;
};
std::ostream& operator<<(std::ostream& out, const Lookup& lookup) {
  return out << lookup.name;
}

class MovingCamera : public testing::TestWithParam<Lookup> {
 protected:
  SettingList settings(int interval) const {
    return {{"reflection.update_interval", std::to_string(interval)},
            {"reflection.samples", GetParam().samples},
            {"view.samples", GetParam().viewSamples},
            {"reflection.scale", GetParam().scale}};
  }
};

// Measured with lavapipe over all frames: 0.25 of the stale picture's error (own sample, layers), 0.27 (average,
// double), 0.33 (single), 0.40 (half). Right after a fresh image the share is larger: little has moved, while filtering
// the image once more adds its usual error.
TEST_P(MovingCamera, ReprojectionIsCloserThanStaleImages) {
  Options options = headless(wallScene(std::string("moving_") + GetParam().name, GetParam().mirror), size, settings(4));
  QuietSession session(options);
  set(options, settings(1));
  QuietSession fresh(options);
  LinearImage stale;  // the whole picture is the mirror: without reprojection it would stay as it is
  int reprojected = 0;
  double error = 0.0;
  double staleError = 0.0;
  for (int frame = 0; frame < 6; ++frame) {
    const LinearImage drawn = drawRadiance(session, frame * frameSeconds);
    const LinearImage expected = drawRadiance(fresh, frame * frameSeconds);
    if (mirrorPasses(session.sceneRenderer()) > 0) {
      // A rendered image has a margin beyond the border of the picture, which must not change the picture.
      EXPECT_LT(rootMeanSquare(drawn, expected), 0.0017) << "frame " << frame;
      stale = expected;
      continue;
    }
    ++reprojected;
    error += rootMeanSquare(drawn, expected);
    staleError += rootMeanSquare(stale, expected);
    EXPECT_LT(rootMeanSquare(drawn, expected), 0.65 * rootMeanSquare(stale, expected)) << "frame " << frame;
  }
  EXPECT_EQ(reprojected, 3);
  EXPECT_LT(error, 0.45 * staleError);
}

INSTANTIATE_TEST_SUITE_P(Lookups, MovingCamera,
                         testing::Values(Lookup{"own_sample", "4", "4", "1", ""}, Lookup{"single", "1", "1", "1", ""},
                                         Lookup{"average", "4", "1", "1", ""}, Lookup{"half", "4", "4", "0.5", ""},
                                         Lookup{"double", "1", "4", "2", ""},
                                         Lookup{"layers", "4", "4", "1", "base_color = [0.2, 0.1, 0.1]"}),
                         [](const auto& info) { return info.param.name; });

std::vector<std::vector<uint8_t>> sequence(Session& session) {
  std::vector<std::vector<uint8_t>> pictures;
  for (int frame = 0; frame < 5; ++frame) {
    pictures.push_back(draw(session, frame * frameSeconds).rgba);
  }
  return pictures;
}

TEST(CachedPictures, RestartedSequencesHaveTheSameBytes) {
  for (const char* scale : fullTests() ? std::vector{"1", "0.5"} : std::vector{"0.5"}) {
    Options options = withInterval(roomScene(), 3, tiny);
    options.settings.emplace_back("reflection.scale", scale);
    QuietSession session(options);
    const auto first = sequence(session);
    session.restart();
    EXPECT_TRUE(sequence(session) == first);
    // Something else in between, with targets of other sizes.
    set(session, {{"reflection.scale", "1.5"}, {"reflection.samples", "1"}});
    sequence(session);
    set(session, {{"reflection.scale", scale}, {"reflection.samples", "4"}});
    session.restart();
    EXPECT_TRUE(sequence(session) == first);
  }
}

TEST(CachedPictures, BothRenderPathsDrawTheSameBytes) {
  expectSameOnBothPaths(withInterval(roomScene(), 3, tiny), {0.0, 0.03, 0.07, 0.1, 0.13});
}

TEST(CachedPictures, ChangedSettingsShowAtOnce) {
  QuietSession session(withInterval(roomScene(), 50, tiny));
  QuietSession fresh(withInterval(roomScene(), 1, tiny));
  for (const auto& [key, value] : {std::pair("view.clear_color", "0.9,0.1,0.1"), std::pair("reflection.samples", "1"),
                                   std::pair("reflection.max_depth", "1")}) {
    session.draw(0.0, false);
    set(session, {{key, value}});
    set(fresh, {{key, value}});
    fresh.restart();
    EXPECT_EQ(draw(session, 0.0).rgba, draw(fresh, 0.0).rgba) << key;
  }
}

TEST(CachedPictures, TimeMayPauseAndRunBackwards) {
  QuietSession session(withInterval(roomScene(), 4));
  QuietSession fresh(withInterval(roomScene(), 1));
  std::map<int, LinearImage> expected;
  for (const int frame : {-1, 0, 1, 2, 3}) {
    expected[frame] = drawRadiance(fresh, frame * frameSeconds);
  }
  for (const int frame : {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -1, 0, 1}) {
    EXPECT_LT(rootMeanSquare(drawRadiance(session, frame * frameSeconds), expected[frame]), 0.034)
        << "at frame " << frame;
  }
}

TEST(CachedPictures, StatsListReusedMirrorsAndMergePasses) {
  QuietSession session(withInterval(roomScene(), 4));
  std::vector<nlohmann::ordered_json> frames;
  std::vector<std::vector<PassId>> passes;
  size_t ran = 0;
  for (int frame = 0; frame < 8; ++frame) {
    runFrames(session);
    frames.push_back(frameStats(session));
    passes.push_back(passIds(session));
    ran += frames.back()["passes"].size();
  }
  EXPECT_GE(unchangedMirrors(frames.back()), 1);
  const nlohmann::ordered_json merged = mergeStats(frames, passes);
  size_t counted = 0;
  for (const auto& pass : merged["passes"]) {
    counted += pass.value("frames", frames.size());
    EXPECT_TRUE(pass["gpu_ms"].contains("median")) << pass["name"];
    if (pass["depth"].is_null()) {
      EXPECT_FALSE(pass.contains("frames")) << pass["name"];
    } else {
      EXPECT_EQ(pass["frames"], pass["path"][0] == "floor" ? 2 : 3) << pass["path"];
    }
  }
  EXPECT_EQ(counted, ran) << "every pass that ran is in one row";
  EXPECT_EQ(merged["passes"].size(), frames[0]["passes"].size());
  EXPECT_EQ(merged["passes"].back()["name"], "display");
}

}  // namespace
}  // namespace speculum::cached_pictures
