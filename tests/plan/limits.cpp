// Plans for the largest work that a small scene file can ask for: time and memory stay small, and sizes are checked
// before the work.
#include <ctime>

#include "instrumented.hpp"
#include "plan/frame_plan.hpp"
#include "plan/scene_changes.hpp"
#include "platform/process.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "scene/scene_loader.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

const std::string camera = "[camera]\nposition = [0.1, 0.2, 0.3]\ntarget = [0, 0, -1]\n";
// Every limit that the settings have, as far out as it goes.
const std::string deep =
    "[settings]\nreflection = { max_depth = 32, max_passes = 1000000, min_pixels = 0, min_throughput = 0 }\n";

FramePlan textPlan(const std::string& text, const std::function<void(Settings&)>& change = {}) {
  const TemporaryFolder folder;
  const Scene scene = loadScene(folder.write("scene.toml", camera + text));
  Settings settings = settingsOf(scene);
  if (change) {
    change(settings);
  }
  const SceneState state = evaluate(scene, 0.0);
  SceneChanges changes;
  changes.update(scene, state);
  return planFrame({scene, state, settings, {640, 360}, {.changes = &changes}});
}

// docs/scene_format.md states the bounds, for a core of its own. One that shares its caches with busy neighbours was
// seen to take three times as long for the same plans. `work`: the share of the largest work that the text asks for.
void expectPlanned(const std::string& text, const std::string& kind, double work = 1.0) {
  ASSERT_LE(camera.size() + text.size(), 65'536u);
  const std::clock_t start = std::clock();  // other programs take none of it
  textPlan(text);
  EXPECT_LT(std::clock() - start, testing_support::instrumented * 30 * work * CLOCKS_PER_SEC) << kind;
  EXPECT_LT(peakResidentBytes(), testing_support::instrumented * (uint64_t{512} << 20)) << kind;
}

// Copies of an object, of which the full tests plan the most that there may be.
const double shareOfCopies = testing_support::fullTests() ? 1.0 : 0.1;

std::string copiesText(int most, const std::string& step) {
  return "copies = { count = " + std::to_string(static_cast<int>(shareOfCopies * most)) + ", step = " + step + " }\n";
}

// A room of mirrors in six lines.
TEST(PlanLimits, FewMirrorsPlanBoundedPasses) {
  std::string text = deep;
  for (const char* side :
       {"position = [0, 0, -3]", "position = [0, 0, 3]\nrotation = [0, 180, 0]",
        "position = [3, 0, 0]\nrotation = [0, -90, 0]", "position = [-3, 0, 0]\nrotation = [0, 90, 0]",
        "position = [0, 3, 0]\nrotation = [90, 0, 0]", "position = [0, -3, 0]\nrotation = [-90, 0, 0]"}) {
    text += std::string("[[mirror]]\nsize = [6, 6]\nreflectance = [1, 1, 1]\n") + side + "\n";
  }
  ASSERT_LE(text.size() + camera.size(), 700u);
  const FramePlan plan = textPlan(text);
  EXPECT_GT(plan.drawnMirrors().size(), 2000u);
  EXPECT_LE(plan.drawnMirrors().size(), 30'000u);
  EXPECT_GT(std::ranges::count(plan.skipped, "too many to plan", &SkippedMirror::detail), 0);
  expectPlanned(text, "six deep");
}

// Plans as many mirrors as 64 KiB of text can hold: all in one place, in a row, and anywhere.
TEST(PlanLimits, ThousandsOfMirrorsPlanInShortTime) {
  for (const char* kind : {"same", "row", "anywhere"}) {
    std::string text;
    for (int i = 0; text.size() < 65'000; ++i) {
      text += "[[mirror]]\nsize=[1,1]\n";
      if (kind[0] != 's') {
        text += kind[0] == 'r' ? "position=[0,0," + std::to_string(-1 - i) + "]\n"
                               : "position=[" + std::to_string(i % 37 - 18) + "," + std::to_string(i % 11 - 5) + "," +
                                     std::to_string(-2 - i % 53) + "]\n";
      }
    }
    expectPlanned(text, kind);
  }
}

// Each frame finds anew which mirrors of a plane cover which.
TEST(PlanLimits, MirrorsOfOnePlaneTakeShortTime) {
  testing_support::Random random(4);
  Scene scene;
  scene.camera.target = {0, 0, -1};
  for (int i = 0; i < 3000; ++i) {
    scene.mirrors.push_back(
        {.position = {random.uniform(-2, 2), random.uniform(-2, 2), -3}, .rotation = {0, 0, 7.0 * i}, .size = {3, 2}});
  }
  const std::clock_t start = std::clock();
  for (int frame = 0; frame < 3; ++frame) {
    evaluate(scene, frame);
  }
  EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC) << "pair by pair it takes several";
}

// Mirrors that show each other, as often as the settings allow.
TEST(PlanLimits, MirrorsInMirrorsPlanWithinTheBounds) {
  for (const int mirrors : testing_support::fullTests() ? std::vector{20, 200} : std::vector{20}) {
    std::string text = deep;
    for (int i = 0; i < mirrors; ++i) {
      const std::string angle = std::to_string(360.0 * i / mirrors);
      text += "[[mirror]]\ntwo_sided=true\nrotation=[0," + angle + "," + angle + "]\nsize=[9,9]\n";
    }
    expectPlanned(text, std::to_string(mirrors) + " through each other");
  }
  std::string text = deep;
  for (int i = 0; text.size() < 65'000; ++i) {
    text += "[[mirror]]\nsize=[9,9]\nposition=[0,0," + std::string(i % 2 == 0 ? "-" : "") + std::to_string(2 + i) +
            "]\nrotation=[0," + (i % 2 == 0 ? "0" : "180") + ",0]\n";
  }
  expectPlanned(text, "facing");
}

TEST(PlanLimits, LightsInMirrorsPlanWithinTheBounds) {
  std::string text = deep;
  for (int i = 0; i < 6; ++i) {
    text += "[[mirror]]\ntwo_sided=true\nrotation=[0," + std::to_string(60 * i) + ",9]\nsize=[9,9]\n";
  }
  while (text.size() < 65'000) {
    text += "[[light]]\nposition=[1,1,1]\n";
  }
  expectPlanned(text, "lights");
}

TEST(PlanLimits, MillionCopiesPlanWithinTheBounds) {
  const TemporaryFolder folder;
  const auto model = folder.write("t.obj", "v 0 0 -3\nv 1 0 -3\nv 0 1 -3\nf 1 2 3\n");
  std::string text = "[[object]]\nmodel = '" + model.string() + "'\n" + copiesText(999'900, "[0.000001, 0.000001, 0]") +
                     "[[mirror]]\nsize=[9,9]\nposition=[0,0,-9]\n";
  expectPlanned(text, "copies", shareOfCopies);
  for (int i = 0; i < 99; ++i) {
    text += "[[mirror]]\nsize=[0.5,0.5]\nposition=[" + std::to_string(i % 10 - 5) + "," + std::to_string(i / 10 - 5) +
            ",-8]\n";
  }
  expectPlanned(text, "copies in a hundred mirrors", shareOfCopies);
}

// Curved mirrors with environment maps and lights with shadow maps, each of which sees every object, in every effect.
TEST(PlanLimits, MapsOfManyObjectsPlanWithinTheBounds) {
  const TemporaryFolder folder;
  const auto model = folder.write("t.obj", "v 0 0 -3\nv 1 0 -3\nv 0 1 -3\nf 1 2 3\n");
  const std::string object =
      "[[object]]\nmodel = '" + model.string() + "'\n" + copiesText(900'000, "[0.001, 0.001, 0]");
  const std::string curved = "[settings]\neffects = { curved_lookup = 'environment' }\n" + object +
                             "[[object]]\nmodel='" + model.string() +
                             "'\ncopies = { count = 40, step = [0.1, 0, 0] }\nmirror = { reflectance = [1, 1, 1] }\n";
  expectPlanned(curved, "environment maps", shareOfCopies);
  std::string lights = "[settings]\neffects = { shadow_lookup = 'map' }\n" + object;
  for (int i = 0; i < 64; ++i) {
    lights += "[[light]]\nposition=[1," + std::to_string(i) + ",1]\ncasts_shadow=true\n";
  }
  expectPlanned(lights, "shadow maps", shareOfCopies);
}

TEST(PlanLimits, TooManyObjectsForMapsTraceShadows) {
  const TemporaryFolder folder;
  const auto model = folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const int lights : {1, 16}) {
    std::string text = "[settings]\neffects.shadow_lookup = 'map'\n[[object]]\nmodel = '" + model.string() +
                       "'\ncopies = { count = 210000, step = [0.00001, 0.000004, -0.001] }\n";
    for (int i = 0; i < lights; ++i) {
      text += "[[light]]\nposition = [" + std::to_string(i - 8) + ", 3, " + std::to_string(2 - i) +
              "]\ncasts_shadow = true\n";
    }
    const TracedEffects effects = textPlan(text).effects;
    EXPECT_EQ(effects.shadowMaps, lights == 1);
    EXPECT_EQ(effects.shadows, lights == 1 ? "light 0" : "light 0; traced: too many lights or objects for maps");
  }
}

TEST(PlanLimits, ShadowMapsOfCopiesPlanWithinTheBounds) {
  const TemporaryFolder folder;
  const auto model = folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::string text = deep + "effects.shadow_lookup = 'map'\n[[object]]\nmodel = '" + model.string() + "'\n" +
                     copiesText(999'900, "[0.00001, 0, 0]") + "spin = [1, 2, 3]\n";
  for (int i = 0; i < 16; ++i) {
    text += "[[light]]\nposition = [" + std::to_string(0.1 * i) + ", 0.5, " + std::to_string(0.1 * i) +
            "]\ncasts_shadow = true\norbit = { speed = 10 }\n";
  }
  for (int i = 0; i < 20; ++i) {
    text += "[[mirror]]\nsize = [2, 2]\nposition = [0, 0, " + std::to_string(-1 - i) + "]\n";
  }
  expectPlanned(text, "shadow maps", shareOfCopies);
}

// Each mirror shows all the copies, which look large and stand before most faces of the maps.
TEST(PlanLimits, AutomaticShadowMapSizesTakeShortTime) {
  const TemporaryFolder folder;
  const auto model = folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::string text =
      "[settings]\nreflection.max_depth = 1\neffects = { shadow_lookup = 'map', shadow_map_size = 'auto' }\n"
      "[[object]]\nmodel = '" +
      model.string() +
      "'\nscale = 40\nposition = [-15, -12, -10]\nrotation = [30, 35, 0]\n"
      "copies = { count = 4000, step = [0.001, 0, 0] }\n";
  for (int i = 0; i < 16; ++i) {
    text += "[[light]]\nposition = [" + std::to_string(0.3 * i - 2) + ", 3, " + std::to_string(2 - 0.2 * i) +
            "]\ncasts_shadow = true\n";
  }
  for (int i = 0; i < 64; ++i) {
    text += "[[mirror]]\nsize = [0.05, 0.05]\nposition = [" + std::to_string(0.07 * (i % 8) - 0.25) + ", " +
            std::to_string(0.07 * (i / 8) - 0.05) + ", -0.7]\n";
  }
  expectPlanned(text, "automatic sizes", 0.1);
}

}  // namespace
}  // namespace speculum
