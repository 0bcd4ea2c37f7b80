// Sweeps without a GPU: statistics, the front, plans, and a run over a renderer that is the ray tracer itself.
#include <ctime>
#include <nlohmann/json.hpp>

#include "accuracy/pareto.hpp"
#include "accuracy/sweep.hpp"
#include "accuracy/sweep_json.hpp"
#include "accuracy/sweep_planner.hpp"
#include "accuracy/sweep_store.hpp"
#include "error_message.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/process.hpp"
#include "reference/ray_tracer.hpp"
#include "scene/fingerprint.hpp"
#include "scene/scene_loader.hpp"
#include "settings/setting_fields.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

namespace fs = std::filesystem;

TEST(Statistics, QuartilesInterpolateBetweenOrderStatistics) {
  const Spread spread = spreadOf({4.0, 1.0, 3.0, 2.0});
  EXPECT_DOUBLE_EQ(spread.median, 2.5);
  EXPECT_DOUBLE_EQ(spread.lowerQuartile, 1.75);
  EXPECT_DOUBLE_EQ(spread.upperQuartile, 3.25);
  EXPECT_DOUBLE_EQ(spread.minimum, 1.0);
  EXPECT_EQ(spread.repeats, 4);
  EXPECT_DOUBLE_EQ(spreadOf({7.0}).upperQuartile, 7.0);
  EXPECT_EQ(spreadOf({}).repeats, 0);
}

SweepPoint candidate(double error, double ms, double spread) {
  SweepPoint point;
  point.whole.flip = error;
  point.frameMs = {.median = ms, .minimum = ms - spread, .lowerQuartile = ms - spread, .upperQuartile = ms + spread};
  return point;
}

TEST(ParetoFront, HoldsUndominatedPoints) {
  EXPECT_EQ(
      paretoFront(std::vector{candidate(0.3, 1, 0), candidate(0.2, 2, 0), candidate(0.25, 3, 0), candidate(0.1, 4, 0)}),
      (std::vector{0, 1, 3}));
  EXPECT_TRUE(paretoFront({}).empty());
}

TEST(ParetoFront, CheaperMeansBeyondTheSpread) {
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.6), candidate(0.2, 3, 0.6)}), (std::vector{0}));
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.4), candidate(0.2, 3, 0.4)}), (std::vector{1, 0}));
}

TEST(ParetoFront, FirstOfEqualsStaysUnlessClearlyDearer) {
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.1), candidate(0.1, 3, 0.1), candidate(0.1, 2.9, 0.1)}),
            (std::vector{1}));
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.6), candidate(0.1, 3, 0.6)}), (std::vector{0}));
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.6), candidate(0.1, 3, 0.6), candidate(0.2, 3.2, 0.1)}),
            (std::vector{2, 0}))
      << "what chance makes cheaper does not keep others out";
}

TEST(ParetoFront, FewestChangesStandForEqualErrors) {
  SweepPoint changed = candidate(0.1, 4, 0.6);
  changed.changes = {{"view.samples", "4"}};
  EXPECT_EQ(paretoFront({changed, candidate(0.1, 4, 0.6)}), (std::vector{1}));
}

TEST(ParetoFront, LeavesOutPointsWithoutTheError) {
  std::vector points{candidate(0.1, 4, 0.6), candidate(0.2, 1, 0.1)};
  points[0].flicker = 0.5;
  EXPECT_EQ(paretoFront(points, &SweepPoint::flicker), (std::vector{0}));
}

SweepPoint point(const std::string& name, double flip, double ms) {
  SweepPoint p{.name = name, .changes = {{"reflection.max_depth", name}}};
  p.whole.flip = flip;
  p.gpuMs = {.median = ms, .minimum = ms, .lowerQuartile = ms, .upperQuartile = ms, .repeats = 15};
  return p;
}

TEST(QualityBudget, ChoosesPointsWithAReason) {
  SweepResults results;
  results.points = {point("1", 0.3, 1.0), point("2", 0.2, 2.0), point("3", 0.25, 3.0), point("4", 0.1, 4.0)};
  EXPECT_FALSE(chooseForBudget(results, {}));
  EXPECT_FALSE(chooseForBudget({}, {.ms = 5.0}));
  const auto chosen = [&](const QualityBudget& budget) { return chooseForBudget(results, budget).value(); };
  EXPECT_EQ(chosen({.ms = 3.5}).point, 1);
  EXPECT_TRUE(chosen({.ms = 3.5}).met);
  EXPECT_TRUE(contains(chosen({.ms = 3.5}).why, "the most accurate is '4' with 0.1 in 4 ms"));
  EXPECT_EQ(chosen({.ms = 100.0}).point, 3);
  EXPECT_TRUE(contains(chosen({.ms = 100.0}).why, "the most accurate of"));
  results.points[3].gpuMs.median = 10400.0;
  EXPECT_TRUE(contains(chosen({.ms = 3.5}).why, "in 10.4 s"));
  results.points[3].gpuMs.median = 4.0;
  EXPECT_EQ(chosen({.ms = 0.5}).point, 0);
  EXPECT_FALSE(chosen({.ms = 0.5}).met);
  EXPECT_TRUE(chosen({.ms = 0.5}).why.ends_with("; no measured point fits 0.5 ms"));
  EXPECT_EQ(chosen({.error = 0.2}).point, 1);
  EXPECT_TRUE(chosen({.error = 0.2}).met);
  EXPECT_EQ(chosen({.error = 0.01}).point, 3);
  EXPECT_FALSE(chosen({.error = 0.01}).met);
  EXPECT_EQ(chosen({.ms = 4.0, .error = 0.25}).point, 1) << "the cheapest that is good enough";
  EXPECT_EQ(chosen({.ms = 2.0, .error = 0.15}).point, 1) << "time decides";
  EXPECT_FALSE(chosen({.ms = 2.0, .error = 0.15}).met);
}

// Faster points may be missing from the front because their times spread widely.
TEST(QualityBudget, PointsOffTheFrontAreChosenToo) {
  SweepResults results;
  results.points = {point("slow", 0.02, 757.0), point("fast", 0.04, 465.0), point("draft", 0.2, 400.0)};
  for (SweepPoint& p : results.points) {
    p.gpuMs.lowerQuartile -= 200.0;
    p.gpuMs.upperQuartile += 200.0;
  }
  ASSERT_EQ(paretoFront(results.points), std::vector<int>{0});
  const auto chosen = [&](const QualityBudget& budget) { return chooseForBudget(results, budget).value(); };
  EXPECT_EQ(chosen({.ms = 600.0}).point, 1);
  EXPECT_TRUE(chosen({.ms = 600.0}).met);
  EXPECT_EQ(chosen({.error = 0.05}).point, 1);
  EXPECT_EQ(chosen({.ms = 420.0, .error = 0.05}).point, 2);
  EXPECT_EQ(chosen({.ms = 100.0}).point, 2);
  EXPECT_FALSE(chosen({.ms = 100.0}).met);
}

TEST(QualityBudget, FrameTimeReplacesMissingTimestamps) {
  SweepPoint p = point("1", 0.3, 0.0);
  p.gpuMs = {};
  p.frameMs.median = 5.0;
  EXPECT_DOUBLE_EQ(costMs(p), 5.0);
}

SweepContext contextOf(bool mirrors, bool animated) {
  return {.mirrors = mirrors, .animated = animated};
}

class SweepFiles : public testing::Test {
 protected:
  std::string problem(const std::string& text) {
    const fs::path file = folder_.write("sweep.toml", text);
    return messageOf<InputError>([&] { readSweepPlan(file, SweepContext()); }).substr((folder_ / "").string().size());
  }
  // Returns the message about `text` as a results.json, without the file's name.
  std::string readProblem(const std::string& text) {
    const fs::path file = folder_.write("r.json", text);
    return messageOf<InputError>([&] { readSweepResults(file); }).substr(file.string().size() + 2);
  }
  TemporaryFolder folder_;
};

TEST_F(SweepFiles, PlanIsReadFromFile) {
  const fs::path file = folder_.write("mine.toml", R"(repeats = 20
[[configuration]]
name = "cheap"
settings = { "reflection.scale" = 0.5, "reflection.clip" = "none" }
[[grid]]
settings = { "reflection.max_depth" = [1, 2], "view.tone_map" = ["aces", "clamp"] }
[[series]]
key = "reflection.max_depth"
values = [0, 1, 2]
axis = "linear"
)");
  const SweepPlan plan = readSweepPlan(file, SweepContext());
  EXPECT_EQ(plan.name, "mine.toml");
  EXPECT_EQ(plan.repeats, 20);
  EXPECT_TRUE(plan.configurations[0].changes.empty()) << "the base comes first";
  EXPECT_EQ(plan.configurations[1].name, "cheap");
  EXPECT_EQ(settingsText(plan.configurations[1].changes), "reflection.scale=0.5 reflection.clip=none");
  ASSERT_EQ(plan.configurations.size(), 7u) << "1 base, 1 named, 4 of the grid, 1 of the series that is new";
  ASSERT_EQ(plan.series.size(), 1u);
  EXPECT_EQ(plan.series[0].x, (std::vector{0.0, 1.0, 2.0}));
  EXPECT_EQ(plan.series[0].axis, SweepSeries::Axis::linear);
}

TEST_F(SweepFiles, MistakesNameTheLine) {
  EXPECT_EQ(problem("repeats = 3"), "sweep.toml:1: repeats: is 3 (an integer 15 .. 1000 is needed)");
  EXPECT_TRUE(contains(problem("[[configuraton]]"),
                       "sweep.toml:1: configuraton: is not a known key (did you mean 'configuration'?"));
  EXPECT_TRUE(contains(problem("[[configuration]]\nsettings = { \"reflection.scale\" = 9 }"), "(0.125 .. 4)"));
  EXPECT_TRUE(contains(problem("[[configuration]]\nsettings = { \"reflection.scale\" = [1, 2] }"), "several values"));
  EXPECT_TRUE(contains(problem("[[configuration]]\nsettings = { \"quality.budget_ms\" = 1 }"), "cannot be swept"));
  EXPECT_TRUE(contains(problem("[[grid]]\nsettings = { \"reflection.scale\" = [] }"), "is empty"));
  EXPECT_TRUE(contains(problem("[[series]]\nkey = \"reflection.scale\"\nvalues = [1, 0.5]"), "sweep.toml:3"));
  EXPECT_TRUE(contains(problem("[[series]]\nvalues = [1, 2]"), "key"));
  EXPECT_TRUE(contains(problem("nonsense"), "sweep.toml:1: toml"));
  EXPECT_TRUE(contains(problem(""), "sweep.toml:1: configuration: is missing"));
  EXPECT_THROW(readSweepPlan(folder_ / "absent.toml", SweepContext()), InputError);
  EXPECT_NO_THROW(SweepPlanner("own", {.interval = 16}));
  EXPECT_THROW(SweepPlanner("own", {.interval = 17}), std::invalid_argument) << "a mirror's own interval";
}

TEST(SweepPlans, BuiltInPlansFitDeviceAndScene) {
  const SweepContext context = contextOf(true, true);
  const SweepPlan quick = sweepPlan("quick", context);
  const SweepPlan full = sweepPlan("full", context);
  EXPECT_GT(full.configurations.size(), quick.configurations.size());
  EXPECT_GE(quick.repeats, 15);
  bool interval = false;
  std::set<std::string> filters;
  for (const SweepConfiguration& configuration : full.configurations) {
    for (const SettingChange& change : configuration.changes) {
      interval = interval || change.key == "reflection.update_interval";
      if (change.key == "view.texture_filter") {
        filters.insert(change.value);
      }
      EXPECT_FALSE(change.key.ends_with("samples") && (change.value == "2" || change.value == "8"))
          << configuration.name;
    }
  }
  EXPECT_TRUE(interval);
  EXPECT_EQ(filters, (std::set<std::string>{"nearest", "trilinear", "anisotropic"})) << "bilinear is in use";
  for (const SweepSeries& series : full.series) {
    for (size_t i = 0; i < series.x.size(); ++i) {
      const Settings settings = settingsWith(context.base, full.configurations[series.points[i]].changes);
      EXPECT_DOUBLE_EQ(std::stod(settingValue(settings, series.key)), series.x[i]);
    }
  }
  const SweepPlan still = sweepPlan("quick", contextOf(false, false));
  for (const SweepConfiguration& configuration : still.configurations) {
    EXPECT_FALSE(contains(settingsText(configuration.changes), "max_depth"))
        << "no mirror, nothing to vary: " << configuration.name;
  }
}

TEST(SweepPlans, WindowMeasuresADozenConfigurations) {
  const SweepPlan plan = viewSweep(contextOf(true, true));
  EXPECT_GE(plan.configurations.size(), 10u);
  EXPECT_LE(plan.configurations.size(), 16u);
  EXPECT_TRUE(plan.series.empty());
  EXPECT_EQ(viewSweep(contextOf(false, false)).configurations.size(), 2u);
}

// Renders by ray tracing, 16 samples a pixel, so that the depth of recursion is the only error.
class TracingSubject : public SweepSubject {
 public:
  TracingSubject(const Scene& scene, const SceneState& state) : tracer_(scene, state) {}

  std::vector<Image8> pictures(const Settings& settings) override {
    ++drawn;
    const auto result = tracer_.render(
        {.width = 48, .height = 27, .samples = 16, .maxDepth = settings.reflection.maxDepth, .minThroughput = 0.0});
    return std::vector<Image8>(static_cast<size_t>(settings.reflection.updateInterval),
                               toDisplay(result->image, settings.view.displayCurve()));
  }
  FrameCost cost(const Settings& settings) override {
    ++timed;
    const double ms = 1.0 + settings.reflection.maxDepth + 0.01 * (timed % 3);
    return {ms, 0.1, ms + 1.0};
  }
  int drawn = 0;
  int timed = 0;

 private:
  RayTracer tracer_;
};

// Two facing mirrors beside a lit ball, 48x27: depth matters.
class SmallSweep : public SweepFiles {
 protected:
  SmallSweep()
      : scene_(loadScene(folder_.write("scene.toml", R"([environment]
background = [0.1, 0.2, 0.4]
[camera]
position = [0.4, 0.2, 0.7]
target = [0, 0, -1]
[[light]]
position = [0.3, 0.5, 0.2]
glow = 3
radius = 0.1
[[mirror]]
position = [0, 0, -1]
size = [2, 2]
reflectance = [0.8, 0.8, 0.8]
[[mirror]]
position = [0, 0, 1]
rotation = [0, 180, 0]
size = [2, 2]
reflectance = [0.8, 0.8, 0.8]
)"))),
        state_(evaluate(scene_, 0.0)) {
    SweepPlanner planner("test", contextOf(true, false));
    planner.series({.key = "reflection.max_depth", .name = "depth", .axis = SweepSeries::Axis::linear},
                   {"0", "1", "2", "3", "4", "12"}, SweepPlanner::Changes{});
    plan_ = planner.plan;
  }

  struct Run {
    bool finished = false;
    SweepResults results;
    int drawn = 0;  // pictures
    int timed = 0;  // frames
  };
  // Runs the sweep with the store in `folder`.
  Run run(const fs::path& folder, const SweepProgress& progress = {}, const std::string& identity = "one") {
    TracingSubject subject(scene_, state_);
    SweepStore store(folder);
    const SweepScene scene{.scene = scene_,
                           .stateOf = [&](int) { return state_; },
                           .truth = {.width = 48, .height = 27, .samples = 16, .floorSamples = 25},
                           .identity = identity};
    Run result;
    result.finished = runSweep(plan_, Settings(), scene, subject, store, result.results, progress);
    result.drawn = subject.drawn;
    result.timed = subject.timed;
    return result;
  }

  Scene scene_;
  SceneState state_;
  SweepPlan plan_;
};

TEST_F(SmallSweep, ErrorFallsAsTheThroughputBeyondDepth) {
  const SweepResults results = run(folder_ / "store").results;
  ASSERT_EQ(results.series.size(), 1u);
  const SweepSeries& series = results.series[0];
  for (size_t i = 1; i < series.points.size(); ++i) {
    EXPECT_LE(results.points[series.points[i]].mirrors->rmse, results.points[series.points[i - 1]].mirrors->rmse);
  }
  EXPECT_LT(results.points[series.points.back()].whole.flip, 0.01) << "depth 12 is nearly the truth";
  EXPECT_LT(results.points[series.points[3]].mirrors->rmse,
            std::pow(0.8, 3) * results.points[series.points[0]].mirrors->rmse)
      << "each bounce lets 0.8 through, and some rays leave the mirrors";
  EXPECT_GT(results.floor.whole.flip, 0.0);
  EXPECT_GT(results.truthMs, 0.0);
  EXPECT_EQ(results.points[0].gpuMs.repeats, 15);
  EXPECT_TRUE(std::ranges::any_of(results.points, [](auto& p) { return p.onFront; }));
}

// Renders frames of a movement by ray tracing, and each picture again for as many frames as the update interval has.
class MovingSubject : public SweepSubject {
 public:
  MovingSubject(const SweepScene& scene) : scene_(scene) {}

  std::vector<Image8> pictures(const Settings& settings) override {
    std::vector<Image8> pictures;
    for (int frame = 0; frame < scene_.frames; ++frame) {
      if (drawn == most) {
        throw SweepCancelled();
      }
      ++drawn;
      const RayTracer tracer(scene_.scene, scene_.stateOf(frame - frame % settings.reflection.updateInterval));
      const auto result =
          tracer.render({.width = 48, .height = 27, .samples = 16, .maxDepth = 64, .minThroughput = 0.0});
      pictures.push_back(toDisplay(result->image, settings.view.displayCurve()));
    }
    return pictures;
  }
  FrameCost cost(const Settings& settings) override { return {4.0 / settings.reflection.updateInterval, 0.1, 5.0}; }
  int drawn = 0;
  int most = -1;  // frames after which it cancels; -1: never

 private:
  const SweepScene& scene_;
};

class SmallMotion : public SmallSweep {
 protected:
  // Runs a sweep over update intervals, with the camera moving by `step` metres a frame.
  SweepResults move(double step, const SweepProgress& progress = {}, int most = -1) {
    SweepPlanner planner("motion", {.motion = true});
    planner.grid({{"reflection.update_interval", {"1", "2", "4"}}});
    planner.plan.repeats = 1;
    const SweepScene scene{.scene = scene_,
                           .stateOf =
                               [&](int frame) {
                                 SceneState state = state_;
                                 state.camera.eye.x += step * frame;
                                 return state;
                               },
                           .frames = 6,
                           .truth = {.width = 48, .height = 27, .samples = 16, .floorSamples = 25},
                           .identity = std::to_string(step)};
    MovingSubject subject(scene);
    subject.most = most;
    SweepStore store(folder_ / "motion");
    SweepResults results{.motion = SweepMotion{"scene", 6, 30.0}};
    finished_ = runSweep(planner.plan, Settings(), scene, subject, store, results, progress);
    drawn_ = subject.drawn;
    return results;
  }

  bool finished_ = false;
  int drawn_ = 0;
};

TEST_F(SmallMotion, OldImagesFlicker) {
  const SweepResults results = move(0.02);
  ASSERT_EQ(results.points.size(), 3u);
  EXPECT_EQ(results.points[0].whole.flip, 0.0) << "every frame is its own reference";
  EXPECT_EQ(results.points[0].flicker, 0.0);
  EXPECT_GT(results.points[1].flicker.value(), 0.01);
  EXPECT_GT(results.points[1].whole.flip, 0.005);
  EXPECT_GT(results.points[2].whole.flip, results.points[1].whole.flip);
  EXPECT_GT(results.floor.flicker.value(), 0.0) << "the reference's own noise changes with the view";
  EXPECT_LT(results.floor.flicker.value(), 0.5 * results.points[1].flicker.value());
  EXPECT_EQ(results.truthFrames.size(), 6u);
  for (const std::string& file : results.points[2].frames) {
    EXPECT_TRUE(fs::is_regular_file(folder_ / "motion" / file));
  }
  const std::vector<std::string>& frames = results.points[2].frames;
  ASSERT_EQ(frames.size(), 6u);
  const auto picture = [&](int i) { return readImage8(folder_ / "motion" / frames[i]).rgba; };
  EXPECT_EQ(picture(0), picture(3));
  EXPECT_NE(picture(3), picture(4));
}

TEST_F(SmallMotion, StandingStillHasNoFlicker) {
  const SweepResults results = move(0.0);
  EXPECT_EQ(results.points.size(), 1u) << "all intervals draw the same frames";
  EXPECT_EQ(results.points[0].flicker, 0.0);
  EXPECT_EQ(results.floor.flicker, 0.0);
  EXPECT_GT(results.floor.whole.flip, 0.0);
}

TEST_F(SmallMotion, InterruptedMotionContinues) {
  move(0.02, [](const SweepStatus& status) { return status.stage != "reference" || status.fraction < 0.6; });
  EXPECT_FALSE(finished_);
  bool traced = false;
  double least = 1.0;
  move(0.02, [&](const SweepStatus& status) {
    traced = traced || status.stage == "reference";
    least = status.stage == "reference" && std::fmod(6.0 * status.fraction, 1.0) > 0.01
                ? std::min(least, status.fraction)
                : least;
    return true;
  });
  EXPECT_TRUE(finished_);
  EXPECT_TRUE(traced);
  EXPECT_GT(least, 0.45) << "references of the first frames are stored";
  EXPECT_EQ(drawn_, 18);
  const SweepResults again = move(0.02);
  EXPECT_EQ(drawn_, 0);
  EXPECT_GT(again.floor.flicker.value(), 0.0) << "stored references have their noise floor";
}

TEST_F(SmallMotion, CancelledConfigurationIsDrawnAgain) {
  move(0.02, {}, 9);
  EXPECT_FALSE(finished_);
  EXPECT_EQ(drawn_, 9);
  move(0.02);
  EXPECT_TRUE(finished_);
  EXPECT_EQ(drawn_, 12) << "the first configuration was complete";
}

TEST_F(SmallMotion, ResultsSurviveTheirFile) {
  const SweepResults results = move(0.02);
  const std::string text = sweepJson(results).dump();
  const SweepResults read = readSweepResults(folder_.write("results.json", text));
  EXPECT_EQ(sweepJson(read).dump(), text);
  EXPECT_EQ(read.motion, results.motion);
  EXPECT_EQ(read.points[1].flicker, results.points[1].flicker);
  EXPECT_TRUE(contains(sweepCsv(results), ",flicker\r\n"));
}

TEST(SweepPlans, MotionVariesWhatPaceTrades) {
  SweepContext context = contextOf(true, true);
  EXPECT_THROW(SweepPlanner("own", context).add({{"quality.motion_ms", "5"}}), std::invalid_argument);
  EXPECT_THROW(sweepPlan("motion", context), InputError) << "a file's name without --motion";
  context.motion = true;
  const auto names = [&] {
    std::string text;
    for (const SweepConfiguration& configuration : sweepPlan("motion", context).configurations) {
      text += settingsText(configuration.changes) + "\n";
    }
    return text;
  };
  for (const char* part :
       {"reflection.update_interval=4", "view.scale=0.25", "quality.motion_ms=15", "view.samples=1"}) {
    EXPECT_TRUE(contains(names(), part)) << part;
  }
  context.mirrors = false;
  EXPECT_FALSE(contains(names(), "reflection."));
}

TEST_F(SmallSweep, InterruptedSweepContinues) {
  const SweepResults whole = run(folder_ / "other").results;
  const Run interrupted = run(
      folder_ / "store", [](const SweepStatus& status) { return status.stage != "times" || status.fraction < 0.5; });
  EXPECT_FALSE(interrupted.finished);
  EXPECT_TRUE(interrupted.results.points.empty());
  bool traced = false;
  const Run rest = run(folder_ / "store", [&](const SweepStatus& status) {
    traced = traced || (status.stage == "reference" && status.fraction < 1.0);
    return true;
  });
  ASSERT_TRUE(rest.finished);
  EXPECT_FALSE(traced);
  EXPECT_EQ(rest.drawn, 0);
  EXPECT_GT(rest.timed, 0);
  EXPECT_LE(rest.timed, 15 * static_cast<int>(plan_.configurations.size()) / 2 + 1);
  for (size_t i = 0; i < whole.points.size(); ++i) {
    EXPECT_EQ(rest.results.points[i].whole.rmse, whole.points[i].whole.rmse) << "stored and traced anew are equal";
    EXPECT_EQ(rest.results.points[i].gpuMs.repeats, 15);
  }
}

// The tracer looks at the depth alone: settings of any other kind make no difference.
TEST_F(SmallSweep, LeavesOutWhatDrawsTheSame) {
  std::mt19937 random(11);
  SweepPlanner planner("test", contextOf(true, false));
  planner.series({.key = "reflection.scale", .name = "flat"}, {"0.5", "1", "2"}, SweepPlanner::Changes{});
  planner.series({.key = "reflection.max_depth", .name = "depth"}, {"1", "2", "4"},
                 SweepPlanner::Changes{{"view.samples", "1"}});
  for (int i = 0; i < 12; ++i) {
    const auto pick = [&](std::vector<std::string> values) { return values[random() % values.size()]; };
    planner.add({{"reflection.max_depth", pick({"1", "2"})},
                 {"view.samples", pick({"1", "4"})},
                 {"reflection.clip", pick({"none", "oblique"})},
                 {"effects.shadows", pick({"true", "false"})}});
  }
  plan_ = planner.plan;
  const Run measured = run(folder_ / "store");
  const SweepResults& results = measured.results;
  ASSERT_EQ(results.points.size(), 3u) << "depths 1, 2 and 4";
  EXPECT_EQ(results.leftOut + 3, std::ssize(plan_.configurations));
  EXPECT_EQ(measured.timed, 3 * 15) << "only points are timed";
  EXPECT_EQ(results.points[0].name, "base") << "the first of equals stays";
  ASSERT_EQ(results.series.size(), 2u);
  EXPECT_EQ(results.series[0].points, (std::vector{0, 0, 0})) << "the base stands for all resolutions";
  for (size_t i = 0; i < 3; ++i) {
    const SweepPoint& point = results.points[results.series[1].points[i]];
    EXPECT_EQ(settingsWith(Settings(), point.changes).reflection.maxDepth, std::vector({1, 2, 4})[i]);
  }
  EXPECT_EQ(run(folder_ / "store").results.points.size(), 3u) << "from the store too";
}

TEST(SweepPlans, NamesAreTheWordsOfThePanels) {
  std::set<std::string> labels;
  SweepPlanner planner("test", contextOf(true, false));
  for (const SettingField& field : settingFields()) {
    if (!field.subject && !field.key.starts_with("quality.") && !field.key.starts_with("debug.") &&
        !field.key.starts_with("ui.")) {
      EXPECT_TRUE(labels.insert(field.label).second) << field.label << " would be two settings";
      const auto* truth = std::get_if<BooleanSetting>(&field.kind);
      if (truth) {
        const bool usual = truth->get(Settings());
        const int index = planner.add({{std::string(field.key), usual ? "false" : "true"}});
        EXPECT_EQ(planner.plan.configurations[index].name, std::string(field.label) + (usual ? " off" : " on"));
      }
    }
  }
  const auto nameOf = [&](const SweepPlanner::Changes& changes) {
    return planner.plan.configurations[planner.add(changes)].name;
  };
  EXPECT_EQ(nameOf({{"reflection.scale", "0.05e1"}, {"reflection.samples", "1"}, {"view.samples", "1"}}),
            "Mirror resolution 0.5, Mirror samples 1, Samples 1");
  EXPECT_EQ(nameOf({{"reflection.scale", "2"}}), "Mirror resolution 2");
  EXPECT_EQ(nameOf({{"reflection.min_throughput", "0.05"}}), "Min. throughput 0.05");
  EXPECT_EQ(nameOf({{"effects.shadow_lookup", "map"}}), "Shadow lookup map");
}

TEST_F(SmallSweep, ChangedIdentityMeasuresAnew) {
  const int drawn = run(folder_ / "store").drawn;
  EXPECT_GT(drawn, 0);
  EXPECT_EQ(run(folder_ / "store", {}, "another build").drawn, drawn);
}

TEST_F(SmallSweep, BrokenFilesAreMeasuredAgain) {
  const SweepResults first = run(folder_ / "store").results;
  for (const auto& entry : fs::directory_iterator(folder_ / "store")) {
    std::ofstream(entry.path()) << "{ \"broken";
  }
  const Run again = run(folder_ / "store");
  EXPECT_EQ(again.drawn, static_cast<int>(plan_.configurations.size()));
  EXPECT_EQ(again.results.points[0].whole.flip, first.points[0].whole.flip);
}

// A folder from elsewhere: names and links that lead to a file of the user's.
TEST_F(SweepFiles, StoresStayInTheirFolder) {
  const fs::path secret = folder_ / "secret.png";
  writePng(secret, Image8(2, 2));
  const std::string before = readText(secret);
  const fs::path store = folder_ / "store";
  fs::create_directories(store / "below");
  writePng(store / "own.png", Image8(2, 2));
  fs::create_symlink("../secret.png", store / "link.png");
  fs::create_symlink("..", store / "up");
  fs::create_symlink("own.png", store / "alias.png");
  fs::create_symlink("store", folder_ / "other name");
  const std::vector<std::string> outside{
      "../secret.png",     "below/../../secret.png",
      "link.png",          "up/secret.png",
      secret.string(),     "./../secret.png",
      "../store/link.png", "up/up/" + folder_.path().filename().string() + "/secret.png"};
  const std::vector<std::string> inside{"own.png", "alias.png", "below/../own.png", "../store/own.png"};
  {
    SweepStore written(store);
    const auto add = [&](const std::string& key, const std::string& picture, const std::string& map) {
      written.at(key) = {.errors = ErrorFigures(), .picture = picture, .heatMap = map};
    };
    for (size_t i = 0; i < outside.size(); ++i) {
      add("a" + std::to_string(i), outside[i], "own.png");
      add("b" + std::to_string(i), "own.png", outside[i]);
    }
    for (size_t i = 0; i < inside.size(); ++i) {
      add("c" + std::to_string(i), inside[i], inside[i]);
    }
    written.save();
  }
  SweepStore read(folder_ / "other name");
  for (size_t i = 0; i < outside.size(); ++i) {
    EXPECT_FALSE(read.at("a" + std::to_string(i)).errors) << outside[i];
    EXPECT_FALSE(read.at("b" + std::to_string(i)).errors) << outside[i];
  }
  for (size_t i = 0; i < inside.size(); ++i) {
    EXPECT_TRUE(read.at("c" + std::to_string(i)).errors) << inside[i];
  }
  EXPECT_THROW(read.keepPicture("link.png", Image8(1, 1)), FileError);
  for (const std::string name : {"truth-a.json", "truth-b.exr", "truth-c-mirrors.png", "measurements.json"}) {
    fs::remove(store / name);
    fs::create_symlink("../secret.png", store / name);
  }
  for (const char* key : {"a", "b", "c"}) {
    EXPECT_THROW(read.keepTruth(key, GroundTruth{.image = LinearImage(1, 1), .mirrors = PixelMask{}}), FileError)
        << key;
  }
  EXPECT_THROW(read.save(), FileError);
  EXPECT_THROW(SweepStore{store}, FileError);
  EXPECT_EQ(readText(secret), before);
}

TEST_F(SmallSweep, ResultsSurviveTheirFile) {
  SweepResults results = run(folder_ / "store").results;
  results.scene = "a \"scene\"";
  results.base = {{"view.samples", "4"}, {"reflection.scale", "1.0"}};
  const std::string text = sweepJson(results).dump();
  const SweepResults read = readSweepResults(folder_.write("results.json", text));
  EXPECT_EQ(sweepJson(read).dump(), text);
  const std::string csv = sweepCsv(results);
  EXPECT_EQ(std::ranges::count(csv, '\n'), static_cast<long>(results.points.size()) + 1);
  const auto columns = [&](size_t from) {
    return std::count(csv.begin() + from, csv.begin() + csv.find('\n', from), ',');
  };
  EXPECT_EQ(columns(0), columns(csv.find('\n') + 1));
}

TEST_F(SmallSweep, ResultsRefuseNumbersThatAreNoInt) {
  nlohmann::ordered_json json = sweepJson(run(folder_ / "store").results);
  for (const char* value : {"1e300", "-1e300", "0.5", "2147483648", "18446744073709551615", "\"1\"", "[]"}) {
    json["ground_truth"]["threads"] = nlohmann::ordered_json::parse(value);
    EXPECT_EQ(readProblem(json.dump()),
              "ground_truth.threads: missing or of another kind (a results.json of speculum accuracy is needed)")
        << value;
  }
  json["ground_truth"]["threads"] = 2;
  for (const char* axis : {"5", "\"other\""}) {
    nlohmann::ordered_json wrong = json;
    wrong["series"][0]["axis"] = nlohmann::ordered_json::parse(axis);
    EXPECT_TRUE(startsWith(readProblem(wrong.dump()), "series[0].axis:")) << axis;
  }
  json["settings"] = "nested";
  std::string text = json.dump();
  text.replace(text.find("\"nested\""), 8, std::string(5000, '[') + std::string(5000, ']'));
  EXPECT_THROW(readSweepResults(folder_.write("deep.json", text)), InputError);
}

TEST_F(SweepFiles, ManyKeysAreRefusedInShortTime) {
  std::string json = "{\"points\": [{\"settings\": {";
  std::string toml = "[[grid]]\n[grid.settings]\n";
  for (int i = 0; i < 100'000; ++i) {
    json += "\"" + std::to_string(i) + "\": 1,";
    toml += "k" + std::to_string(i) + " = 1\n";
  }
  const std::clock_t start = std::clock();
  EXPECT_EQ(readProblem(json + "\"a\": 1}}]}"),
            "an object has more than 10000 members (a results.json of speculum accuracy is needed)");
  EXPECT_TRUE(contains(problem(toml), "has 100000 keys")) << problem(toml).substr(0, 200);
  EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC);
}

TEST_F(SweepFiles, FirstWrongElementEndsTheFile) {
  nlohmann::ordered_json json = sweepJson({});
  json["points"] = std::vector<int>(2'000'000);
  const std::string text = json.dump();
  json = {};
  const uint64_t before = peakResidentBytes();
  EXPECT_TRUE(startsWith(readProblem(text), "points[0].name:"));
  EXPECT_LT(peakResidentBytes() - before, uint64_t{256} << 20);
}

TEST_F(SweepFiles, OtherFilesAreNoResults) {
  EXPECT_TRUE(startsWith(readProblem("no"), "not JSON"));
  EXPECT_TRUE(startsWith(readProblem("{}"), "scene: missing or of another kind "));
  EXPECT_TRUE(startsWith(readProblem("[1]"), "scene"));
  EXPECT_THROW(readSweepResults(folder_ / "absent.json"), InputError);
}

TEST(Fingerprint, ScenesAreTheSameWhereverSaved) {
  const TemporaryFolder folder;
  const auto fingerprintOf = [&](const std::string& name, const std::string& text) {
    Fingerprint fingerprint;
    addScene(fingerprint, loadScene(folder.write(name, text)));
    return fingerprint.hex();
  };
  folder.write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto scene = [](const std::string& title, const std::string& model, const std::string& x) {
    return "title = \"" + title + "\"\n[camera]\nposition = [0, 1, 5]\ntarget = [0, 1, 0]\n[[object]]\nmodel = \"" +
           model + "\"\nposition = [" + x + ", 0, 0]\n";
  };
  const std::string first = fingerprintOf("a.toml", scene("a", "box.obj", "1"));
  EXPECT_EQ(fingerprintOf("copies/b.toml", "# saved elsewhere\n" + scene("b", "../box.obj", "1.0")), first);
  EXPECT_NE(fingerprintOf("c.toml", scene("a", "box.obj", "2")), first);
}

TEST(Fingerprint, TellsContentApart) {
  const auto of = [](std::initializer_list<std::string_view> parts) {
    Fingerprint fingerprint;
    for (const std::string_view part : parts) {
      fingerprint.add(part);
    }
    return fingerprint.hex();
  };
  EXPECT_EQ(of({"ab", "c"}), of({"ab", "c"}));
  EXPECT_NE(of({"ab", "c"}), of({"a", "bc"}));
  EXPECT_EQ(of({}), "cbf29ce484222325");
}

}  // namespace
}  // namespace speculum
