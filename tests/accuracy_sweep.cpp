// Sweeps without a GPU: statistics, the front, plans, and a run over a renderer that is the ray tracer itself.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "accuracy/fingerprint.hpp"
#include "accuracy/pareto.hpp"
#include "accuracy/sweep.hpp"
#include "image/color.hpp"
#include "reference/ray_tracer.hpp"
#include "scene/scene_loader.hpp"
#include "temporary_folder.hpp"

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

TEST(Statistics, LineOfLeastSquares) {
  const std::vector<Sample2d> exact = {{0, 1}, {1, -1}, {3, -5}};
  ASSERT_TRUE(fitLine(exact));
  EXPECT_NEAR(fitLine(exact)->slope, -2.0, 1e-12);
  EXPECT_NEAR(fitLine(exact)->offset, 1.0, 1e-12);
  const std::vector<Sample2d> noisy = {{0, 0}, {1, 2}, {2, 1}};
  EXPECT_NEAR(fitLine(noisy)->slope, 0.5, 1e-12);
  EXPECT_FALSE(fitLine({}));
  const std::vector<Sample2d> upright = {{1, 1}, {1, 2}};
  EXPECT_FALSE(fitLine(upright));
}

FrontCandidate candidate(double error, double ms, double spread) {
  return {error, {.median = ms, .minimum = ms - spread, .lowerQuartile = ms - spread, .upperQuartile = ms + spread}};
}

TEST(ParetoFront, HoldsWhatNothingBeats) {
  EXPECT_EQ(
      paretoFront(std::vector{candidate(0.3, 1, 0), candidate(0.2, 2, 0), candidate(0.25, 3, 0), candidate(0.1, 4, 0)}),
      (std::vector{0, 1, 3}));
  EXPECT_TRUE(paretoFront(std::vector<FrontCandidate>{}).empty());
}

TEST(ParetoFront, CheaperMeansBeyondTheSpread) {
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.6), candidate(0.2, 3, 0.6)}), (std::vector{0}));
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.4), candidate(0.2, 3, 0.4)}), (std::vector{1, 0}));
}

TEST(ParetoFront, OfEqualPicturesTheFirstStaysUnlessAnotherIsClearlyCheaper) {
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.1), candidate(0.1, 3, 0.1), candidate(0.1, 2.9, 0.1)}),
            (std::vector{1}));
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.6), candidate(0.1, 3, 0.6)}), (std::vector{0}));
  EXPECT_EQ(paretoFront(std::vector{candidate(0.1, 4, 0.6), candidate(0.1, 3, 0.6), candidate(0.2, 3.2, 0.1)}),
            (std::vector{2, 0}))
      << "what chance makes cheaper does not keep others out";
}

SweepPoint point(const std::string& name, double flip, double ms) {
  SweepPoint p{.name = name, .changes = {{"reflection.max_depth", name}}};
  p.whole.flip = flip;
  p.gpuMs = {.median = ms, .minimum = ms, .lowerQuartile = ms, .upperQuartile = ms, .repeats = 15};
  return p;
}

TEST(QualityBudget, ChoosesFromTheFrontAndSaysWhatIsGivenUp) {
  SweepResults results;
  results.points = {point("1", 0.3, 1.0), point("2", 0.2, 2.0), point("3", 0.25, 3.0), point("4", 0.1, 4.0)};
  EXPECT_FALSE(chooseForBudget(results, {}));
  EXPECT_FALSE(chooseForBudget({}, {.ms = 5.0}));
  const auto chosen = [&](const QualityBudget& budget) { return chooseForBudget(results, budget).value(); };
  EXPECT_EQ(chosen({.ms = 3.5}).point, 1);
  EXPECT_TRUE(chosen({.ms = 3.5}).met);
  EXPECT_NE(chosen({.ms = 3.5}).why.find("gives up 0.1 of mean FLIP against '4'"), std::string::npos)
      << chosen({.ms = 3.5}).why;
  EXPECT_EQ(chosen({.ms = 100.0}).point, 3);
  EXPECT_NE(chosen({.ms = 100.0}).why.find("gives up nothing"), std::string::npos);
  EXPECT_EQ(chosen({.ms = 0.5}).point, 0);
  EXPECT_FALSE(chosen({.ms = 0.5}).met);
  EXPECT_EQ(chosen({.error = 0.2}).point, 1);
  EXPECT_TRUE(chosen({.error = 0.2}).met);
  EXPECT_EQ(chosen({.error = 0.01}).point, 3);
  EXPECT_FALSE(chosen({.error = 0.01}).met);
  EXPECT_EQ(chosen({.ms = 4.0, .error = 0.25}).point, 1) << "the cheapest that is good enough";
  EXPECT_EQ(chosen({.ms = 2.0, .error = 0.15}).point, 1) << "time decides";
  EXPECT_FALSE(chosen({.ms = 2.0, .error = 0.15}).met);
}

TEST(QualityBudget, WithoutTimestampsTheFrameCounts) {
  SweepPoint p = point("1", 0.3, 0.0);
  p.gpuMs = {};
  p.frameMs.median = 5.0;
  EXPECT_DOUBLE_EQ(costMs(p), 5.0);
}

SweepContext contextOf(bool mirrors, bool animated) {
  SweepContext context;
  context.mirrors = mirrors;
  context.animated = animated;
  return context;
}

class SweepFiles : public testing::Test {
 protected:
  std::string problem(const std::string& text) {
    try {
      readSweepPlan(folder_.write("sweep.toml", text), SweepContext());
    } catch (const InputError& error) {
      return std::string(error.what()).substr((folder_ / "").string().size());
    }
    return "nothing";
  }
  TemporaryFolder folder_;
};

TEST_F(SweepFiles, PlanFromAFile) {
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
theory = -1.5
)");
  const SweepPlan plan = readSweepPlan(file, SweepContext());
  EXPECT_EQ(plan.name, "mine.toml");
  EXPECT_EQ(plan.repeats, 20);
  EXPECT_TRUE(plan.configurations[0].changes.empty()) << "the base comes first";
  EXPECT_EQ(plan.configurations[1].name, "cheap");
  EXPECT_EQ(settingsText(plan.configurations[1].changes), "reflection.scale=0.5 reflection.clip=none");
  ASSERT_EQ(plan.configurations.size(), 7u) << "1 base, 1 named, 4 of the grid, 1 of the series that is new";
  ASSERT_EQ(plan.series.size(), 1u);
  EXPECT_EQ(plan.series[0].series.x, (std::vector{0.0, 1.0, 2.0}));
  EXPECT_EQ(plan.series[0].theory, PlannedSeries::Theory::fixed);
  EXPECT_EQ(plan.series[0].series.axis, SweepSeries::Axis::linear);
}

TEST_F(SweepFiles, MistakesNameTheLine) {
  EXPECT_EQ(problem("repeats = 3"), "sweep.toml:1: repeats: is 3 (an integer 15 .. 1000 is needed)");
  EXPECT_NE(
      problem("[[configuraton]]").find("sweep.toml:1: configuraton: is not a known key (did you mean 'configuration'?"),
      std::string::npos)
      << problem("[[configuraton]]");
  EXPECT_NE(problem("[[configuration]]\nsettings = { \"reflection.scale\" = 9 }").find("(0.125 .. 4)"),
            std::string::npos);
  EXPECT_NE(problem("[[configuration]]\nsettings = { \"reflection.scale\" = [1, 2] }").find("several values"),
            std::string::npos);
  EXPECT_NE(problem("[[configuration]]\nsettings = { \"quality.budget_ms\" = 1 }").find("cannot be swept"),
            std::string::npos);
  EXPECT_NE(problem("[[grid]]\nsettings = { \"reflection.scale\" = [] }").find("is empty"), std::string::npos);
  EXPECT_NE(problem("[[series]]\nkey = \"reflection.scale\"\nvalues = [1, 0.5]").find("sweep.toml:3"),
            std::string::npos);
  EXPECT_NE(problem("[[series]]\nvalues = [1, 2]").find("key"), std::string::npos);
  EXPECT_NE(problem("nonsense").find("sweep.toml:1: toml"), std::string::npos);
  EXPECT_THROW(readSweepPlan(folder_ / "absent.toml", SweepContext()), InputError);
}

TEST(SweepPlans, BuiltInOnesAreWhatTheDeviceAndTheSceneAllow) {
  const SweepContext context = contextOf(true, true);
  const SweepPlan quick = sweepPlan("quick", context);
  const SweepPlan full = sweepPlan("full", context);
  EXPECT_GT(full.configurations.size(), quick.configurations.size());
  EXPECT_GE(quick.repeats, 15);
  bool interval = false;
  for (const SweepConfiguration& configuration : full.configurations) {
    for (const SettingChange& change : configuration.changes) {
      interval = interval || change.key == "reflection.update_interval";
      EXPECT_FALSE(change.key.ends_with("samples") && (change.value == "2" || change.value == "8"))
          << configuration.name;
    }
  }
  EXPECT_TRUE(interval);
  const auto coarse = std::find_if(full.series.begin(), full.series.end(), [](const PlannedSeries& planned) {
    return planned.series.key == "reflection.scale" && planned.series.x.front() < 1.0;
  });
  ASSERT_NE(coarse, full.series.end());
  EXPECT_LT(coarse->fitUpTo, 1.0) << "at scale 1 nothing is resampled";
  for (const PlannedSeries& planned : full.series) {
    for (size_t i = 0; i < planned.series.x.size(); ++i) {
      const Settings settings = settingsWith(context.base, full.configurations[planned.series.points[i]].changes);
      EXPECT_DOUBLE_EQ(std::stod(settingValue(settings, planned.series.key)), planned.series.x[i]);
    }
  }
  const SweepPlan still = sweepPlan("quick", contextOf(false, false));
  for (const SweepConfiguration& configuration : still.configurations) {
    EXPECT_EQ(settingsText(configuration.changes).find("max_depth"), std::string::npos)
        << "no mirror, nothing to vary: " << configuration.name;
  }
}

TEST(SweepPlans, TheWindowsTakesADozenConfigurations) {
  const SweepPlan plan = viewSweep(contextOf(true, true));
  EXPECT_GE(plan.configurations.size(), 10u);
  EXPECT_LE(plan.configurations.size(), 16u);
  EXPECT_TRUE(plan.series.empty());
  EXPECT_EQ(viewSweep(contextOf(false, false)).configurations.size(), 2u);
}

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
    planner.series({.series = {.key = "reflection.max_depth", .name = "depth", .axis = SweepSeries::Axis::linear},
                    .theory = PlannedSeries::Theory::depth},
                   {"0", "1", "2", "3", "4", "12"}, SweepPlanner::Changes{});
    plan_ = planner.plan;
  }

  SweepScene sweepScene(const std::string& identity = "one") const {
    return {.scene = scene_, .state = state_, .width = 48, .height = 27, .identity = identity, .truthSamples = 16};
  }

  Settings base_;
  Scene scene_;
  SceneState state_;
  SweepPlan plan_;
};

// Renders by ray tracing, 16 samples a pixel, so that the depth of recursion is the only error.
class TracingSubject : public SweepSubject {
 public:
  TracingSubject(const Scene& scene, const SceneState& state) : tracer_(scene, state) {}

  std::vector<Image8> pictures(const Settings& settings) override {
    ++drawn;
    const auto result = tracer_.render(
        {.width = 48, .height = 27, .samples = 16, .maxDepth = settings.reflection.maxDepth, .minThroughput = 0.0});
    return std::vector<Image8>(static_cast<size_t>(settings.reflection.updateInterval),
                               toDisplay(result->image, settings.view.exposure, settings.view.toneMap));
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

TEST_F(SmallSweep, ErrorFallsWithDepthAsTheThroughputBeyondDoes) {
  TracingSubject subject(scene_, state_);
  SweepStore store;
  SweepResults results;
  ASSERT_TRUE(runSweep(plan_, base_, sweepScene(), subject, store, results, {}));
  ASSERT_EQ(results.series.size(), 1u);
  const SweepSeries& series = results.series[0];
  for (size_t i = 1; i < series.points.size(); ++i) {
    EXPECT_LE(results.points[series.points[i]].mirrors->rmse, results.points[series.points[i - 1]].mirrors->rmse);
  }
  EXPECT_LT(results.points[series.points.back()].whole.flip, 0.01) << "depth 12 is nearly the truth";
  ASSERT_TRUE(series.fit);
  EXPECT_LT(series.fit->slope, std::log(0.8)) << "each bounce lets 0.8 through, and some rays leave the mirrors";
  EXPECT_NEAR(series.fit->slope, series.theorySlope, 0.35 * std::abs(series.theorySlope));
  EXPECT_GT(results.floorWhole.flip, 0.0);
  EXPECT_GT(results.truthMs, 0.0);
  EXPECT_EQ(results.points[0].gpuMs.repeats, 15);
  const bool front = std::any_of(results.points.begin(), results.points.end(), [](auto& p) { return p.onFront; });
  EXPECT_TRUE(front);
}

TEST_F(SmallSweep, GoesOnWhereItStopped) {
  const fs::path folder = folder_ / "store";
  SweepResults whole;
  {
    TracingSubject subject(scene_, state_);
    SweepStore store(folder_ / "other");
    ASSERT_TRUE(runSweep(plan_, base_, sweepScene(), subject, store, whole, {}));
  }
  {
    TracingSubject subject(scene_, state_);
    SweepStore store(folder);
    SweepResults results;
    const auto untilHalfTimed = [](const SweepStatus& status) {
      return status.stage != "times" || status.fraction < 0.5;
    };
    ASSERT_FALSE(runSweep(plan_, base_, sweepScene(), subject, store, results, untilHalfTimed));
    EXPECT_TRUE(results.points.empty());
  }
  TracingSubject subject(scene_, state_);
  SweepStore store(folder);
  SweepResults results;
  bool traced = false;
  const auto watch = [&](const SweepStatus& status) {
    traced = traced || (status.stage == "ground truth" && status.fraction < 1.0);
    return true;
  };
  ASSERT_TRUE(runSweep(plan_, base_, sweepScene(), subject, store, results, watch));
  EXPECT_FALSE(traced);
  EXPECT_EQ(subject.drawn, 0);
  const int all = 15 * static_cast<int>(plan_.configurations.size());
  EXPECT_GT(subject.timed, 0);
  EXPECT_LE(subject.timed, all / 2 + 1);
  for (size_t i = 0; i < results.points.size(); ++i) {
    EXPECT_EQ(results.points[i].whole.rmse, whole.points[i].whole.rmse) << "stored and traced anew are one";
    EXPECT_EQ(results.points[i].gpuMs.repeats, 15);
  }
}

TEST_F(SmallSweep, MeasuresAnewWhatDependsOnOtherThings) {
  const fs::path folder = folder_ / "store";
  SweepResults results;
  TracingSubject subject(scene_, state_);
  SweepStore store(folder);
  ASSERT_TRUE(runSweep(plan_, base_, sweepScene(), subject, store, results, {}));
  const int drawn = subject.drawn;
  ASSERT_TRUE(runSweep(plan_, base_, sweepScene("another build"), subject, store, results, {}));
  EXPECT_EQ(subject.drawn, 2 * drawn);
}

TEST_F(SmallSweep, BrokenFilesOfTheStoreAreMeasuredAgain) {
  const fs::path folder = folder_ / "store";
  SweepResults first;
  {
    TracingSubject subject(scene_, state_);
    SweepStore store(folder);
    ASSERT_TRUE(runSweep(plan_, base_, sweepScene(), subject, store, first, {}));
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::ofstream(entry.path()) << "{ \"broken";
  }
  TracingSubject subject(scene_, state_);
  SweepStore store(folder);
  SweepResults results;
  ASSERT_TRUE(runSweep(plan_, base_, sweepScene(), subject, store, results, {}));
  EXPECT_EQ(subject.drawn, static_cast<int>(plan_.configurations.size()));
  EXPECT_EQ(results.points[0].whole.flip, first.points[0].whole.flip);
}

TEST_F(SmallSweep, ResultsSurviveTheirFile) {
  TracingSubject subject(scene_, state_);
  SweepStore store(folder_ / "store");
  SweepResults results{.scene = "a \"scene\"", .title = "t", .sweep = "quick", .device = "d", .driver = "v"};
  results.base = {{"view.samples", "4"}, {"reflection.scale", "1.0"}};
  ASSERT_TRUE(runSweep(plan_, base_, sweepScene(), subject, store, results, {}));
  const std::string text = sweepJson(results).dump();
  const SweepResults read = readSweepResults(folder_.write("results.json", text));
  EXPECT_EQ(sweepJson(read).dump(), text);
  const std::string csv = sweepCsv(results);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<long>(results.points.size()) + 1);
  const auto columns = [&](size_t from) {
    return std::count(csv.begin() + from, csv.begin() + csv.find('\n', from), ',');
  };
  EXPECT_EQ(columns(0), columns(csv.find('\n') + 1));
}

// get<int>() would make something of each.
TEST_F(SmallSweep, ResultsHoldIntegersThatAreSome) {
  TracingSubject subject(scene_, state_);
  SweepStore store(folder_ / "store");
  SweepResults results;
  ASSERT_TRUE(runSweep(plan_, base_, sweepScene(), subject, store, results, {}));
  nlohmann::ordered_json json = sweepJson(results);
  for (const char* value : {"1e300", "-1e300", "0.5", "2147483648", "18446744073709551615", "\"1\"", "[]"}) {
    json["ground_truth"]["threads"] = nlohmann::ordered_json::parse(value);
    const fs::path file = folder_.write("results.json", json.dump());
    try {
      readSweepResults(file);
      ADD_FAILURE() << value;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), file.string() +
                                  ": ground_truth.threads: missing or of another kind "
                                  "(a results.json of speculum accuracy is needed)");
    }
  }
  json["ground_truth"]["threads"] = 2;
  json["settings"] = "nested";
  std::string text = json.dump();
  text.replace(text.find("\"nested\""), 8, std::string(5000, '[') + std::string(5000, ']'));
  EXPECT_THROW(readSweepResults(folder_.write("results.json", text)), InputError);
}

TEST_F(SweepFiles, ResultsThatAreNoneAreNamed) {
  const auto says = [&](const std::string& text) -> std::string {
    try {
      readSweepResults(folder_.write("r.json", text));
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  };
  EXPECT_NE(says("no").find("r.json: not JSON"), std::string::npos);
  EXPECT_NE(says("{}").find("r.json: scene: missing or of another kind"), std::string::npos);
  EXPECT_NE(says("[1]").find("r.json: scene"), std::string::npos);
  EXPECT_THROW(readSweepResults(folder_ / "absent.json"), InputError);
}

TEST(Fingerprints, TellContentApart) {
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
