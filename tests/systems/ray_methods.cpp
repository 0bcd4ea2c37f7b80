// Rays by ray queries and by shaders: the choice between them, its reason, their needs, and equal pictures of both.
#include "cli/stats.hpp"
#include "effect_scenes.hpp"
#include "faults/scarce_memory.hpp"
#include "log_capture.hpp"
#include "picture_support.hpp"
#include "scene_text.hpp"
#include "test_headers.hpp"

namespace speculum::ray_methods {
namespace {

using namespace testing_support;

constexpr PictureSize size{160, 90};
constexpr PictureSize small{48, 27};

const std::string room = effectFloor + R"([[object]] name = "pot", model = "MODELS/teapot.obj"
  position = [0.6, 0, 0.4], scale = [0.6, 0.6, -0.6], spin = [0, 40, 0]
)";
const std::string brightWall = wall + "casts_light = true\n";
const std::string brightSide = side + "casts_light = true\n";
const std::string ripplingPool = pool + ripple;
const std::string ball =
    "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [-0.4, 0.6, 0.9]\nscale = 0.4\n"
    "mirror = { reflectance = [0.9, 0.8, 0.6] }\n";

Options with(const std::filesystem::path& file, const std::string& rays, PictureSize drawn = size) {
  return headless(file, drawn, {{"effects.rays", rays}});
}

constexpr const char* withoutRayQueries = "the device has no ray queries (scripts/newer-mesa has a driver with them)";

bool hasRayQueries() {
  static const bool has = Device({}).caps().rayQueries;
  return has;
}

int64_t structuresAlive() {
  const std::map<std::string, int64_t> alive = liveObjects();
  const auto found = alive.find("VkAccelerationStructureKHR");
  return found == alive.end() ? 0 : found->second;
}

class RayMethods : public testing::TestWithParam<const char*> {};

TEST_P(RayMethods, FollowSettingAndDevice) {
  const std::string rays = GetParam();
  const std::filesystem::path file = writeScene("methods", room + shadowLight);
  const LogCapture log;
  QuietSession session(with(file, rays, small));
  runFrames(session, 3);
  const bool cpu = session.device().info().type == VK_PHYSICAL_DEVICE_TYPE_CPU;
  const bool hardware = hasRayQueries() && (rays == "hardware" || (rays == "auto" && !cpu));
  const nlohmann::ordered_json stats = frameStats(session)["rays"];
  EXPECT_EQ(stats["method"], hardware ? "hardware" : "software") << stats;
  EXPECT_EQ(stats["structures"] > 0, hardware) << stats;
  EXPECT_EQ(stats["bytes"] > 0, hardware) << stats;
  EXPECT_EQ(stats["structures"], structuresAlive());
  EXPECT_NE(stats["why"], "");
  EXPECT_EQ(occurrences(log.text(), "effects.rays = hardware: shaders trace the rays"),
            rays == "hardware" && !hardware ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(Values, RayMethods, testing::Values("auto", "hardware", "software"),
                         [](const auto& info) { return std::string(info.param); });

TEST(RayStructures, ExistOnlyWhileCalledFor) {
  const std::filesystem::path file = writeScene("called", room + shadowLight);
  QuietSession session(with(file, "hardware", small));
  set(session, {{"effects.shadows", "false"}});
  runFrames(session);
  EXPECT_EQ(structuresAlive(), 0);
  EXPECT_EQ(frameStats(session)["rays"]["method"], nullptr);
  set(session, {{"effects.shadows", "true"}});
  runFrames(session, 3);
  // Two meshes, the box of mirrors, and one for each frame in flight.
  EXPECT_EQ(structuresAlive(), hasRayQueries() ? 5 : 0);
  set(session, {{"effects.shadows", "false"}});
  runFrames(session, idleFramesKept + 3);
  EXPECT_EQ(structuresAlive(), 0);
  set(session, {{"effects.shadows", "true"}, {"effects.rays", "software"}});
  runFrames(session, 3);
  EXPECT_EQ(structuresAlive(), 0);
}

// Shaders trace scenes with transforms that single precision cannot invert.
TEST(RayStructures, ScaleBeyondSinglePrecisionNeedsShaders) {
  EXPECT_TRUE(RayStructures::canHold(evaluate(loadScene(writeScene("ordinary", room)), 0.0)));
  EXPECT_FALSE(RayStructures::canHold(evaluate(
      loadScene(writeScene("tiny", room + "[[object]]\nmodel = \"MODELS/sphere.obj\"\nscale = 1e-12\n")), 0.0)));
}

// Refuses all device memory while it lives.
struct NoMemory {
  NoMemory() { refuseMemory(1, UINT64_MAX); }
  ~NoMemory() { stopRefusingMemory(); }
};

// Without memory for acceleration structures, shaders trace the rays as with effects.rays = software.
TEST(RayStructures, MissingMemoryLeavesShaders) {
  if (!hasRayQueries()) {
    GTEST_SKIP() << withoutRayQueries;
  }
  const LogCapture log;
  QuietSession session(with(writeScene("scarce", room + shadowLight), "software", small));
  runFrames(session);
  const Image8 software = draw(session);
  draw(session);  // each frame in flight has a buffer for its picture, which must be there already
  set(session, {{"effects.rays", "hardware"}});
  const int before = refusedAllocations();
  {
    const NoMemory none;
    draw(session);
  }
  EXPECT_GT(refusedAllocations(), before);
  EXPECT_EQ(frameStats(session)["rays"]["method"], "software");
  EXPECT_EQ(session.picture().rgba, software.rgba);
  EXPECT_EQ(occurrences(log.text(), "there is no memory for acceleration structures"), 1);
  EXPECT_EQ(structuresAlive(), 0);
}

struct Case {
  const char* name;
  std::string scene;
  double time = 1.7;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

class BothMethods : public testing::TestWithParam<Case> {};

// Objects that stand on each other, in the light of a lamp at the height of their common plane.
std::string standing() {
  return room + "[[object]]\nmodel = \"MODELS/block.obj\"\nposition = [-1, 0.3, 0.6]\nscale = [0.5, 0.3, 0.5]\n" +
         "[[object]]\nmodel = \"MODELS/sphere.obj\"\nposition = [-1, 0.9, 0.6]\nscale = 0.3\n" +
         "[[light]]\nposition = [2.5, 0.02, 1]\nintensity = 9\ncasts_shadow = true\n" + shadowLight;
}

// Writes a wavy disc of 720 triangles 1 m long and 9 mm wide.
void writeSlivers() {
  std::ostringstream obj;
  obj << "v 0 0 0\n";
  constexpr int corners = 720;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * 3.14159265358979 * i / corners;
    obj << "v " << text(std::cos(angle)) << " " << text(0.05 * std::cos(5 * angle)) << " " << text(std::sin(angle))
        << "\n";
  }
  for (int i = 0; i < corners; ++i) {
    obj << "f 1 " << (i + 1) % corners + 2 << " " << i + 2 << "\n";
  }
  writeModel("slivers.obj", obj.str());
}
const std::string slivers =
    "[[object]]\nmodel = \"slivers.obj\"\nposition = [-0.6, 0.7, 0.6]\nrotation = [20, 0, 10]\nscale = 0.8\n";

TEST_P(BothMethods, DrawTheSamePicture) {
  if (!hasRayQueries()) {
    GTEST_SKIP() << withoutRayQueries;
  }
  const std::filesystem::path file = writeScene(GetParam().name, GetParam().scene);
  writeSlivers();
  const Image8 software = draw(with(file, "software"), GetParam().time);
  QuietSession session(with(file, "hardware"));
  session.draw(GetParam().time, true);
  ASSERT_EQ(frameStats(session)["rays"]["method"], "hardware");
  expectAlike(session.picture(), software, 2, std::string("rays_") + GetParam().name);
}

// Each frame in flight updates its own structure, builds it again after 60 updates, and keeps it while nothing moves.
TEST(BothMethods, AgreeWhileThingsMove) {
  if (!hasRayQueries()) {
    GTEST_SKIP() << withoutRayQueries;
  }
  const std::filesystem::path file = writeScene("moving", room + shadowLight + brightWall);
  QuietSession hardware(with(file, "hardware"));
  QuietSession software(with(file, "software"));
  constexpr int frames = 140;
  for (int i = 0; i <= frames; ++i) {
    const double time = i < 70 ? 0.05 * i : 3.5 + 0.02 * (i / 4);
    const bool compared = i % 35 == 0;
    hardware.draw(time, compared);
    hardware.finish();
    if (compared) {
      expectAlike(hardware.picture(), draw(software, time), 2, "rays_moving_" + std::to_string(i));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, BothMethods,
    testing::Values(Case{"shadows", room + shadowLight},
                    Case{"mirrors_in_mirrors", room + shadowLight + brightWall + brightSide + ripplingPool},
                    Case{"curved", room + shadowLight + brightWall + ball + ripplingPool},
                    Case{"rough", room + shadowLight + brightWall + brightSide + "roughness = 0.3\n"},
                    Case{"surfaces_that_touch", standing()}, Case{"slivers", room + shadowLight + brightWall + slivers},
                    Case{"far", effectsFarAway()},
                    Case{"grazing",
                         room + "[[light]]\nposition = [60, 0.35, -20]\nintensity = 9000\ncasts_shadow = true\n" +
                             brightWall},
                    Case{"eye_at_a_surface", "[camera]\nposition = [0, 0.001, 0]\ntarget = [1, 0.0008, -1]\n" +
                                                 room.substr(room.find("[[object]]")) + shadowLight + brightWall}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(ManyRays, AreWarnedOf) {
  const auto file = writeScene("many_rays", cameraText({0, 1, 3}, {0, 0, 0}) +
                                                objectText("MODELS/box.obj", {0, 0, 0}, {0, 0, 0}, 1, {1, 1, 1}) +
                                                "[[light]]\nposition = [0, 3, 3]\ncasts_shadow = true\n[[mirror]]\n" +
                                                rectangleText({0, 1, -1}, {0, 0, 0}, 2, 2) + "roughness = 0.3\n");
  struct Case {
    const char* samples;
    const char* rough;
    std::string says;
  };
  for (const auto& [samples, rough, says] :
       {Case{"1", "256", ""}, Case{"1", "1024", "2048 rays a sample"}, Case{"4", "1024", ""}}) {
    const LogCapture log;
    QuietSession session(headless(
        file, {4, 4}, {{"view.samples", samples}, {"reflection.samples", samples}, {"effects.rough_samples", rough}}));
    runFrames(session, 3);
    const std::string text = log.text();
    const size_t first = text.find("rays a sample");
    EXPECT_EQ(first == std::string::npos, says.empty()) << text;
    EXPECT_TRUE(contains(text, says));
    EXPECT_EQ(text.find("rays a sample", first == std::string::npos ? 0 : first + 1), std::string::npos) << "once";
  }
}

}  // namespace
}  // namespace speculum::ray_methods
