// `speculum accuracy` and what uses its results, as scripts call them.
#include "accuracy/sweep_json.hpp"
#include "command_support.hpp"
#include "error_message.hpp"
#include "picture_support.hpp"
#include "platform/files.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_loader.hpp"
#include "scene_text.hpp"
#include "window/paced_subject.hpp"

namespace speculum {
namespace {

using namespace testing_support;
namespace fs = std::filesystem;

const std::string sweep = R"([[series]]
key = "reflection.max_depth"
values = [0, 1, 2, 3]
axis = "linear"
settings = { "reflection.samples" = 4, "view.samples" = 4 }
[[configuration]]
name = "half <scale>"
settings = { "reflection.scale" = 0.5 }
[[configuration]]
settings = { "reflection.update_interval" = 2 }
)";

class AccuracyCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    out_ = std::make_unique<TemporaryDirectory>();
    scene_ = writeScene("accuracy_command", corridorScene()).string();
    std::ofstream(out("sweep.toml")) << sweep;
  }
  static void TearDownTestSuite() { out_.reset(); }

  static std::string out(const std::string& name) { return (out_->path() / name).string(); }
  static ProcessResult measure() {
    return speculum({"accuracy", "--scene", scene_, "--out", out("report"), "--size", "64x36", "--sweep",
                     out("sweep.toml"), "--validation", "--set", "debug.check_finite=true"});
  }
  // Runs the command once for all tests.
  static const ProcessResult& measured() {
    static const ProcessResult result = measure();
    return result;
  }
  static ProcessResult render(std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "--scene", scene_, "--size", "64x36", "--out", out("p.png"), "--stats",
                               out("s.json"), "--sweep-results", out("report/results.json")});
    return speculum(more);
  }

  static inline std::string scene_;
  static inline std::unique_ptr<TemporaryDirectory> out_;
};

TEST_F(AccuracyCommand, ReportsErrorsOfItsPictures) {
  ASSERT_EQ(measured().exitCode, 0) << measured().output;
  const SweepResults results = readSweepResults(out("report/results.json"));
  EXPECT_EQ(results.width, 64);
  ASSERT_EQ(results.points.size(), 7u) << "base, half scale, interval 2, four depths";
  for (const SweepPoint& point : results.points) {
    EXPECT_GE(point.gpuMs.repeats, 15) << point.name;
    EXPECT_GT(point.gpuMs.minimum, 0.0) << point.name;
    EXPECT_LE(point.gpuMs.lowerQuartile, point.gpuMs.upperQuartile) << point.name;
  }
  const auto& depths = results.series.at(0).points;
  EXPECT_LT(results.points[depths[3]].mirrors->rmse, results.points[depths[0]].mirrors->rmse);
  // The figures can be computed again from the pictures beside them.
  const SweepPoint& point = results.points[depths[1]];
  succeed({"compare", out("report/" + results.truthPicture), out("report/" + point.picture), "--json", out("c.json")});
  EXPECT_NEAR(readJson(out("c.json"))["flip"].get<double>(), point.whole.flip, 1e-9);
  EXPECT_NEAR(readJson(out("c.json"))["rmse"].get<double>(), point.whole.rmse, 1e-9);
  EXPECT_TRUE(startsWith(readText(out("report/results.csv")), "name,settings,on_front"));
  EXPECT_TRUE(contains(readText(out("report/index.html")), "half \\u003cscale>"));
}

TEST_F(AccuracyCommand, SecondRunMeasuresNothing) {
  ASSERT_EQ(measured().exitCode, 0);
  const std::string first = readText(out("report/measurements/measurements.json"));
  ASSERT_EQ(measure().exitCode, 0);
  EXPECT_EQ(readText(out("report/measurements/measurements.json")), first);
}

TEST_F(AccuracyCommand, StoredSweepMeetsABudget) {
  ASSERT_EQ(measured().exitCode, 0);
  const SweepResults results = readSweepResults(out("report/results.json"));
  const auto chosen = [&](const std::string& bound) {
    const ProcessResult result = render({"--set", bound});
    EXPECT_EQ(result.exitCode, 0) << result.output;
    EXPECT_TRUE(contains(result.output, "quality: '"));
    return readJson(out("s.json"));
  };
  double bestFlip = 1.0;
  for (const SweepPoint& point : results.points) {
    bestFlip = std::min(bestFlip, point.whole.flip);
  }
  const nlohmann::json rich = chosen("quality.budget_ms=100000");
  EXPECT_EQ(rich["quality"]["flip"].get<double>(), bestFlip);
  EXPECT_TRUE(rich["quality"]["met"]);
  const nlohmann::json poor = chosen("quality.budget_ms=0.000001");
  EXPECT_FALSE(poor["quality"]["met"]);
  for (const SweepPoint& point : results.points) {
    if (point.name == poor["quality"]["point"].get<std::string>()) {
      for (const SettingChange& change : point.changes) {
        const nlohmann::json& value = poor["settings"][change.key];
        EXPECT_EQ(value.is_string() ? value.get<std::string>() : value.dump(), change.value) << change.key;
      }
    }
  }
  EXPECT_TRUE(chosen("quality.max_error=1")["quality"]["met"]);
}

TEST_F(AccuracyCommand, MistakesAreOneLineAndExitTwo) {
  EXPECT_TRUE(contains(mistake({"accuracy", "--scene", scene_, "--out", out("r"), "--sweep", out("absent.toml")}),
                       "absent.toml:1: file:"));
  std::ofstream(out("bad.toml")) << "[[configuration]]\nsettings = { \"reflection.scle\" = 1 }\n";
  EXPECT_TRUE(contains(mistake({"accuracy", "--scene", scene_, "--out", out("r"), "--sweep", out("bad.toml")}),
                       "did you mean 'reflection.scale'?"));
  EXPECT_FALSE(fs::exists(out("r"))) << "bad input leaves nothing behind";
  fs::create_directory(out("busy"));
  const auto lock = lockFolder(out("busy"));
  EXPECT_TRUE(contains(mistake({"accuracy", "--scene", scene_, "--out", out("busy"), "--sweep", out("sweep.toml")}),
                       "is in use (another command writes there"));
  std::ofstream(out("file")) << "x";
  mistake({"accuracy", "--scene", scene_, "--out", out("file"), "--sweep", out("sweep.toml")});
  EXPECT_TRUE(contains(mistake({"render", "--scene", scene_, "--out", out("p.png"), "--set", "quality.budget_ms=3"}),
                       "--sweep-results"));
  EXPECT_TRUE(contains(mistake({"render", "--scene", scene_, "--out", out("p.png"), "--set", "quality.budget_ms=3",
                                "--sweep-results", out("bad.toml")}),
                       "not JSON"));
}

// Ctrl-C ends a measurement at any frame.
TEST(PacedSubject, CancelLeavesTheSessionUnpaced) {
  struct Cancelled : PacedSubject {
    using PacedSubject::PacedSubject;
    void drawFrame(int frame, bool capture, bool whole) override {
      PacedSubject::drawFrame(frame, capture, whole);
      if (capture && frame == 4) {
        throw SweepCancelled();
      }
    }
  };
  Session session(headless(writeScene("cancelled", wallScene), {64, 36}));
  Settings settings = session.settings();
  settings.quality.motionMs = 0.01;
  const auto picture = [&] {
    session.restart();
    session.draw(0.0, true);
    return session.picture().rgba;
  };
  session.setSettings(settings);
  const std::vector<uint8_t> before = picture();
  Cancelled subject(session, MotionPath{.frames = 6});
  EXPECT_THROW(subject.pictures(settings), SweepCancelled);
  session.setSettings(settings);
  EXPECT_EQ(picture(), before);
}

// Scenes of none to two mirrors, of which the second may stand where no path of light needs it.
TEST(LeftOutConfigurations, DrawTheBytesOfOneThatIsKept) {
  for (const int mirrors : {0, 1, 2}) {
    std::string toml = wallScene.substr(0, wallScene.find("[[mirror]]"));
    for (int i = 0; i < mirrors; ++i) {
      toml += "[[mirror]]\n" + rectangleText({0.7 * i, 1.0, -1.5}, {0, 10.0 * i, 0}, 0.6, 0.9) + "\n";
    }
    Session session(headless(writeScene("left_out", toml), {64, 36}));
    SweepPlan plan = viewSweep(sweepContext(session));
    plan.repeats = 1;
    const Settings base = session.settings();
    const SceneState state = evaluate(session.scene(), 0.0);
    SessionSubject subject(session, 0.0);
    const TemporaryDirectory folder;
    SweepStore store(folder.path());
    const SweepScene scene{.scene = session.scene(),
                           .stateOf = [&](int) { return state; },
                           .truth = {.width = 64, .height = 36, .samples = 1, .floorSamples = 0}};
    SweepResults results;
    ASSERT_TRUE(runSweep(plan, base, scene, subject, store, results, {}));
    std::set<std::vector<uint8_t>> kept;
    std::vector<std::pair<std::string, std::vector<uint8_t>>> leftOut;
    for (const SweepConfiguration& configuration : plan.configurations) {
      const bool isPoint = std::ranges::count(results.points, configuration.name, &SweepPoint::name) > 0;
      const std::vector<uint8_t> bytes = subject.pictures(settingsWith(base, configuration.changes)).at(0).rgba;
      if (isPoint) {
        kept.insert(bytes);
      } else {
        leftOut.emplace_back(configuration.name, bytes);
      }
    }
    EXPECT_EQ(std::ssize(leftOut), results.leftOut);
    EXPECT_EQ(results.leftOut > 0, mirrors > 0) << mirrors;
    EXPECT_GT(results.points.size(), 1u);
    for (const auto& [name, bytes] : leftOut) {
      EXPECT_TRUE(kept.contains(bytes)) << name << " with " << mirrors << " mirrors";
    }
  }
}

const std::string path = R"([[view]]
time = 0
position = [-0.3, 1, 1.4]
target = [0, 1, -2]
[[view]]
time = 0.2
position = [0.3, 1.1, 1.4]
target = [0, 1, -2]
up = [0.1, 1, 0]
vertical_fov = 70
)";

TEST_F(AccuracyCommand, MovementHasErrorAndFlicker) {
  // Images that are moved to where a new view sees them cannot show that the lamp has moved in them.
  const std::string scene = writeScene("movement", corridorScene(corridorNodes + R"(
[[light]] position = [0.6, 1, 0], radius = 0.25, glow = 5, orbit = { center = [0, 1, 0], axis = [0, 1, 0], speed = 400 }
)"))
                                .string();
  std::ofstream(out("path.toml")) << path;
  std::ofstream(out("moving.toml"))
      << "[[grid]]\nsettings = { \"reflection.update_interval\" = [1, 4] }\n"
         "[[configuration]]\nname = \"paced\"\nsettings = { \"quality.motion_ms\" = 0.01 }\n";
  const std::string text = succeed({"accuracy", "--scene", scene, "--size", "64x36", "--motion", out("path.toml"),
                                    "--frames", "6", "--set", "view.samples=4", "--set", "reflection.samples=4",
                                    "--sweep", out("moving.toml"), "--validation", "--out", out("m")});
  EXPECT_TRUE(contains(text, "flicker"));
  const SweepResults results = readSweepResults(out("m/results.json"));
  EXPECT_EQ(results.motion, (SweepMotion{out("path.toml"), 6, 30.0}));
  ASSERT_EQ(results.points.size(), 3u);
  const SweepPoint& base = results.points[0];
  const auto named = [&](const std::string& part) {
    return *std::ranges::find_if(results.points, [&](auto& p) { return contains(p.name, part); });
  };
  EXPECT_GT(base.flicker.value(), 0.0);
  EXPECT_GT(named("Update interval").flicker.value(), base.flicker.value());
  EXPECT_GT(named("paced").whole.flip, base.whole.flip);
  EXPECT_EQ(base.frames.size(), 6u);
  // Each frame is the one that a window draws there: the first has no image of a frame before.
  succeed({"render", "--scene", scene, "--size", "64x36", "--camera", "-0.3,1,1.4:0,1,-2", "--set", "view.samples=4",
           "--set", "reflection.samples=4", "--out", out("first.png")});
  succeed({"compare", out("first.png"), out("m/" + base.frames[0]), "--max-diff", "0"});
  EXPECT_TRUE(contains(mistake({"render", "--scene", scene, "--out", out("p.png"), "--set", "quality.budget_ms=3",
                                "--sweep-results", out("m/results.json")}),
                       "measured in motion"));
}

TEST_F(AccuracyCommand, BudgetOfMotionLeavesStillPictures) {
  const auto measured = [&](const std::string& folder, const std::vector<std::string>& more) {
    std::vector<std::string> command = {
        "accuracy", "--scene",           scene_,  "--size",   "64x36", "--sweep", out("sweep.toml"),
        "--set",    "view.accumulate=2", "--out", out(folder)};
    command.insert(command.end(), more.begin(), more.end());
    succeed(command);
    return readSweepResults(out(folder + "/results.json"));
  };
  const SweepResults usual = measured("usual", {});
  const SweepResults budgeted = measured("budgeted", {"--set", "quality.motion_ms=0.01"});
  ASSERT_EQ(budgeted.points.size(), usual.points.size());
  for (size_t i = 0; i < usual.points.size(); ++i) {
    EXPECT_EQ(budgeted.points[i].whole.flip, usual.points[i].whole.flip) << usual.points[i].name;
  }
}

TEST_F(AccuracyCommand, StandingStillHasNoFlicker) {
  const std::string view = path.substr(0, path.find("[[view]]", 1));
  std::ofstream(out("still.toml")) << view << "[[view]]\ntime = 1" << view.substr(view.find("\nposition"));
  succeed({"accuracy", "--scene", scene_, "--size", "64x36", "--motion", out("still.toml"), "--frames", "3", "--sweep",
           out("sweep.toml"), "--out", out("still")});
  for (const SweepPoint& point : readSweepResults(out("still/results.json")).points) {
    EXPECT_EQ(point.flicker, 0.0) << point.name;
    EXPECT_GT(point.whole.flip, 0.0) << point.name;
  }
}

TEST(MotionPaths, CameraGoesStraightFromViewToView) {
  const TemporaryDirectory folder;
  std::ofstream(folder.path() / "path.toml") << path;
  Options options;
  options.motion = (folder.path() / "path.toml").string();
  options.time = 3.0;
  options.frames = 9;
  Scene scene = loadScene(writeScene("motion_paths", corridorScene()));
  const MotionPath moved = motionPath(options, scene);
  ASSERT_EQ(moved.cameras.size(), 9u);
  const auto isNear = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) < 1e-12; };
  EXPECT_TRUE(isNear(moved.cameras[0].eye, {-0.3, 1.0, 1.4}));
  EXPECT_TRUE(isNear(moved.cameras[3].eye, {0.0, 1.05, 1.4})) << "halfway, after 0.1 s";
  EXPECT_TRUE(isNear(moved.cameras[8].eye, {0.3, 1.1, 1.4})) << "stands after the last view";
  EXPECT_NEAR(moved.cameras[8].verticalFov, glm::radians(70.0), 1e-12);
  EXPECT_DOUBLE_EQ(moved.timeOf(3), 3.1);
  EXPECT_EQ(stateOf(scene, moved, 3).camera, moved.cameras[3]);
  options.motion = "scene";
  EXPECT_TRUE(contains(messageOf<UsageError>([&] { motionPath(options, scene); }), "nothing in the scene moves"));
  scene.camera.orbitSpeed = 90.0;
  EXPECT_TRUE(motionPath(options, scene).cameras.empty());
  EXPECT_EQ(stateOf(scene, motionPath(options, scene), 3).camera, evaluate(scene, 3.1).camera);
  options.size = {4096, 4096};
  EXPECT_TRUE(contains(messageOf<UsageError>([&] { motionPath(options, scene); }),
                       "--frames: 9 of 4096x4096 are too many (at most 2 of this size)"));
}

TEST(MotionPaths, MistakesNameTheLine) {
  const TemporaryDirectory folder;
  const Scene scene = loadScene(writeScene("motion_paths", corridorScene()));
  Options options;
  options.motion = (folder.path() / "path.toml").string();
  options.fps = 4.0;
  const auto problem = [&](const std::string& text) {
    std::ofstream(options.motion) << text;
    return messageOf<InputError>([&] { motionPath(options, scene); }).substr(folder.path().string().size() + 1);
  };
  const std::string first = path.substr(0, path.find("[[view]]", 1));  // of four lines
  EXPECT_EQ(problem(""),
            "path.toml:1: view: stands 0 times (2 to 10000 [[view]] with time, position and target are needed)");
  EXPECT_TRUE(contains(problem(first), "stands 1 times"));
  EXPECT_TRUE(contains(problem(first + first), "path.toml:6: view[1].time: is not after")) << problem(first + first);
  EXPECT_TRUE(contains(problem("[[vew]]"), "path.toml:1: vew: is not a known key (did you mean 'view'?"));
  EXPECT_TRUE(contains(problem("[[view]]\ntime = 0\nposition = [0, 0]\n"), "path.toml:3: view[0].position"));
  EXPECT_TRUE(contains(problem("[[view]]\ntime = nan\n"), "path.toml:2: view[0].time"));
  EXPECT_TRUE(contains(problem("[[view]]\ntime = 0\nposition = [0, 0, 0]\ntarget = [0, 0, 0]\n"),
                       "path.toml:1: view: target: has no direction"));
  EXPECT_TRUE(contains(problem(first + "[[view]]\ntime = 0.5\nposition = [-0.3, 1, -6]\ntarget = [0, 1, -2]\n"
                                       "up = [0, -1, 0]\n"),
                       "path.toml:1: after"))
      << "upside down: up vanishes halfway";
  EXPECT_TRUE(contains(problem("nonsense"), "path.toml:1: toml"));
}

TEST_F(AccuracyCommand, MovementsAreChecked) {
  const std::vector<std::string> command = {"accuracy", "--scene", scene_, "--out", out("bad")};
  const auto refused = [&](std::vector<std::string> more) {
    more.insert(more.begin(), command.begin(), command.end());
    return mistake(more);
  };
  EXPECT_TRUE(contains(refused({"--frames", "4"}), "--motion"));
  EXPECT_TRUE(contains(refused({"--fps", "4"}), "--motion"));
  EXPECT_TRUE(contains(refused({"--motion", out("absent.toml")}), "absent.toml:1: file:"));
  EXPECT_TRUE(contains(refused({"--motion", "scene", "--frames", "1"}), "--frames"));
  EXPECT_TRUE(contains(refused({"--motion", ""}), "--motion: an empty name"));
  EXPECT_TRUE(contains(refused({"--sweep", ""}), "--sweep: an empty name"));
  EXPECT_FALSE(fs::exists(out("bad"))) << "bad input leaves nothing behind";
}

TEST_F(AccuracyCommand, BenchesTheReference) {
  EXPECT_TRUE(contains(succeed({"bench", "--reference", "--json", out("b.json")}), "million rays per second"));
  const nlohmann::json json = readJson(out("b.json"));
  EXPECT_GT(json["triangles"], 90000);
  EXPECT_GT(json["rays_per_second"], 0.0);
}

}  // namespace
}  // namespace speculum
