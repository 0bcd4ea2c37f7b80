// Plans of what a small file can ask for: in time and memory that stay small, and checked before the work.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>

#include "frame/frame_plan.hpp"
#include "scene/scene_loader.hpp"
#include "temporary_folder.hpp"

namespace speculum {
namespace {

const std::string camera = "[camera]\nposition = [0.1, 0.2, 0.3]\ntarget = [0, 0, -1]\n";

FramePlan planOf(const std::string& text, const std::function<void(Settings&)>& change = {}) {
  const TemporaryFolder folder;
  const Scene scene = loadScene(folder.write("scene.toml", camera + text));
  Settings settings = settingsOf(scene);
  if (change) {
    change(settings);
  }
  return planFrame(scene, evaluate(scene, 0.0), settings, 640, 360);
}

// A room of mirrors in six lines, with every limit that the settings have as far out as it goes.
TEST(PlanLimits, FewMirrorsPlanBoundedPasses) {
  std::string text =
      "[settings]\nreflection = { max_depth = 32, max_passes = 1000000, min_pixels = 0, min_throughput = 0 }\n";
  for (const char* side :
       {"position = [0, 0, -3]", "position = [0, 0, 3]\nrotation = [0, 180, 0]",
        "position = [3, 0, 0]\nrotation = [0, -90, 0]", "position = [-3, 0, 0]\nrotation = [0, 90, 0]",
        "position = [0, 3, 0]\nrotation = [90, 0, 0]", "position = [0, -3, 0]\nrotation = [-90, 0, 0]"}) {
    text += std::string("[[mirror]]\nsize = [6, 6]\nreflectance = [1, 1, 1]\n") + side + "\n";
  }
  ASSERT_LE(text.size() + camera.size(), 700u);
  const FramePlan plan = planOf(text);
  EXPECT_GT(plan.passes.size(), 2000u);
  EXPECT_LE(plan.passes.size(), 30'000u);
  EXPECT_TRUE(std::any_of(plan.skipped.begin(), plan.skipped.end(),
                          [](const SkippedMirror& skipped) { return skipped.detail == "too many to plan"; }));
}

// As many mirrors as 64 KiB name, in a row, beside each other and anywhere.
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
    const auto start = std::chrono::steady_clock::now();
    planOf(text);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10)) << kind;
  }
}

}  // namespace
}  // namespace speculum
