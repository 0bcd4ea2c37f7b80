// Planning takes its memory from frames before.
#include <cstdlib>
#include <new>

#include "frame/frame_plan.hpp"
#include "frame/scene_changes.hpp"
#include "scene/scene_loader.hpp"
#include "scene/scene_state.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"

namespace {

size_t allocations = 0;  // by operator new

void* allocate(size_t bytes) {
  ++allocations;
  if (void* const block = std::malloc(std::max<size_t>(bytes, 1))) {
    return block;
  }
  throw std::bad_alloc();
}

}  // namespace

// Not inlined, or GCC takes free() for a mistake.
[[gnu::noinline]] void* operator new(size_t bytes) {
  return allocate(bytes);
}
[[gnu::noinline]] void operator delete(void* block) noexcept {
  std::free(block);
}
[[gnu::noinline]] void operator delete(void* block, size_t) noexcept {
  std::free(block);
}

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
    FramePlan last = std::move(plan_);
    const MainImage main{settings_, last.mainContent};
    const size_t before = allocations;
    plan_ = planFrame(scene_, state, settings_, 640, 360, {last.cached, last.maps, last.shadowMaps, &main, &changes_});
    last = {};
    return allocations - before;
  }

 private:
  const Scene& scene_;
  Settings settings_;
  SceneChanges changes_;
  FramePlan plan_;
};

std::vector<Settings> settingsToPlan(const Settings& shipped) {
  std::vector<Settings> all(4, shipped);
  all[1].reflection.skipUnchanged = true;
  all[1].reflection.updateInterval = 3;
  all[2].effects.shadowLookup = ShadowLookup::map;
  all[2].effects.curvedLookup = CurvedLookup::environment;
  all[2].reflection.skipUnchanged = true;
  all[2].reflection.meshError = 1.0;
  all[2].view.meshError = 1.0;
  all[3].reflection.method = ReflectionMethod::automatic;
  all[3].reflection.minPixels = 2000.0;
  all[3].reflection.maxPasses = 6;
  all[3].reflection.maxDepth = 2;
  return all;
}

TEST(Planning, AllocatesNothingAfterAFewFrames) {
  for (const auto& file : std::filesystem::directory_iterator(sourceDir() / "scenes")) {
    if (file.path().extension() != ".toml") {
      continue;
    }
    const Scene scene = loadScene(file.path());
    for (const Settings& settings : settingsToPlan(settingsOf(scene))) {
      Planning planning(scene, settings);
      constexpr int frames = 6;  // of a movement that is repeated
      size_t later = 0;          // allocations
      for (int frame = 0; frame < 4 * frames; ++frame) {
        const size_t now = planning.plan(0.2 * (frame % frames));
        later += frame < 2 * frames ? 0 : now;
      }
      EXPECT_EQ(later, 0u) << file.path();
    }
  }
}

}  // namespace
}  // namespace speculum::test
