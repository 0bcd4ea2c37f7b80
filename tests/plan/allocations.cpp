// Tests that planning reuses the memory of earlier frames.
#include <thread>

#include "fuzz/heap_watch.hpp"
#include "plan/fitted_plan.hpp"
#include "plan/scene_changes.hpp"
#include "sampling.hpp"
#include "scene/scene_loader.hpp"
#include "scene/scene_state.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"

namespace speculum::test {
namespace {

// Plans frames one after the other, as the window does.
class Planning {
 public:
  Planning(const Scene& scene, const Settings& settings) : scene_(scene), settings_(settings) {}

  // Returns the number of allocations.
  size_t plan(double time) {
    const SceneState state = evaluate(scene_, time);
    changes_.update(scene_, state);
    FittedPlan last = std::move(last_);
    const MainImage main{last.settings, last.plan.mainContent};
    const FrameCache cache{last.plan.cached, last.plan.cubes, &main, &changes_};
    const size_t before = fuzz::allocations();
    last_ =
        planWithin({.budgetBytes = UINT64_MAX, .largestSide = 16384}, {scene_, state, settings_, {640, 360}, cache});
    last = {};
    return fuzz::allocations() - before;
  }

 private:
  const Scene& scene_;
  Settings settings_;
  SceneChanges changes_;
  FittedPlan last_;
};

std::vector<Settings> settingsToPlan(const Settings& shipped) {
  std::vector<Settings> all(4, shipped);
  all[1].reflection.skipUnchanged = true;
  all[1].reflection.updateInterval = 3;
  all[2].effects.shadowLookup = ShadowLookup::map;
  all[2].effects.curvedLookup = CurvedLookup::environment;
  all[2].reflection.skipUnchanged = true;
  all[3].reflection.method = ReflectionMethod::automatic;
  all[3].reflection.minPixels = 2000.0;
  all[3].reflection.maxPasses = 6;
  all[3].reflection.maxDepth = 2;
  return all;
}

TEST(Planning, AllocatesNothingAfterAFewFrames) {
  size_t scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(sourceDir() / "scenes")) {
    if (file.path().extension() != ".toml") {
      continue;
    }
    ++scenes;
    const Scene scene = loadScene(file.path());
    const std::vector<Settings> all = settingsToPlan(settingsOf(scene));
    for (size_t i = 0; i < all.size(); ++i) {
      // Every second scene with the first and the third settings, the others with the rest.
      if (!testing_support::fullTests() && (scenes + i) % 2 == 0) {
        continue;
      }
      constexpr int frames = 6;  // of a movement that is repeated
      size_t atFirst = 0;        // allocations
      size_t later = 0;
      // A new thread caches no memory yet.
      std::thread([&] {
        Planning planning(scene, all[i]);
        for (int frame = 0; frame < 4 * frames; ++frame) {
          const size_t now = planning.plan(0.2 * (frame % frames));
          (frame < 2 * frames ? atFirst : later) += now;
        }
      }).join();
      EXPECT_GT(atFirst, 0u) << file.path() << ", settings " << i;
      EXPECT_EQ(later, 0u) << file.path() << ", settings " << i;
    }
  }
  EXPECT_GE(scenes, 10u);
}

}  // namespace
}  // namespace speculum::test
