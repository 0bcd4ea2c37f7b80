// Tests that planning reuses the memory of earlier frames.
#include <thread>

#include "frame/memory_fit.hpp"
#include "frame/scene_changes.hpp"
#include "fuzz/heap_watch.hpp"
#include "geometry/recycled_memory.hpp"
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
    const FrameCache cache{last.plan.cached, last.plan.maps, last.plan.shadowMaps, &main, &changes_};
    const size_t before = fuzz::allocations();
    last_ = planWithin({.budgetBytes = UINT64_MAX, .largestSide = 16384}, scene_, state, settings_, 640, 360, cache);
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
  all[2].reflection.meshError = 1.0;
  all[2].view.meshError = 1.0;
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

TEST(RecycledMemory, FreedBlocksAreReused) {
  void* const block = recycled::allocate(100);
  recycled::deallocate(block, 100);
  EXPECT_EQ(recycled::allocate(120), block) << "both sizes round up to 128 bytes";
  void* const other = recycled::allocate(100);
  EXPECT_NE(other, block) << "it is in use";
  recycled::deallocate(other, 100);
  recycled::deallocate(block, 120);
  void* const larger = recycled::allocate(300);
  EXPECT_TRUE(larger != block && larger != other) << "the freed blocks are too small";
  recycled::deallocate(larger, 300);
}

TEST(RecycledMemory, BlocksOfAnySizeKeepTheirContents) {
  for (int round = 0; round < 2; ++round) {
    std::vector<RecycledVector<char>> all;
    for (const size_t size : {1, 7, 8, 9, 1000, 1 << 20, (1 << 20) + 1}) {
      all.emplace_back(size, static_cast<char>(size + round));
    }
    for (const RecycledVector<char>& bytes : all) {
      EXPECT_TRUE(std::ranges::all_of(bytes, [&](char c) { return c == static_cast<char>(bytes.size() + round); }));
    }
  }
  EXPECT_THROW(RecyclingAllocator<double>().allocate(SIZE_MAX / 4), std::bad_array_new_length);
}

TEST(RecycledMemory, BlocksMayBeFreedByAnotherThread) {
  RecycledVector<int> numbers(1000, 7);
  std::thread([&] { numbers = RecycledVector<int>(1000, 8); }).join();
  EXPECT_EQ(numbers, RecycledVector<int>(1000, 8)) << "the thread that allocated it has ended";
}

TEST(RecycledMemory, CachesABoundedNumberOfBytes) {
  std::thread([] {
    const auto allocationsOf = [](size_t blocks) {
      const size_t before = fuzz::allocations();
      std::vector<void*> all(blocks);
      std::ranges::generate(all, [] { return recycled::allocate(1 << 20); });
      std::ranges::for_each(all, [](void* block) { recycled::deallocate(block, 1 << 20); });
      return fuzz::allocations() - before - 1;  // 1: `all`
    };
    EXPECT_EQ(allocationsOf(16), 16u);
    EXPECT_EQ(allocationsOf(16), 0u);
    EXPECT_EQ(allocationsOf(17), 1u);
    EXPECT_EQ(allocationsOf(16), 15u) << "the 17th block emptied the cache";
  }).join();
}

TEST(RecycledMemory, BlocksMayBeFreedWhileTheThreadEnds) {
  std::thread([] {
    // It is destroyed last, after the cache.
    static thread_local RecycledVector<int> numbers;
    numbers.assign(1000, 7);
    RecycledVector<int>(10, 7).clear();
  }).join();
}

}  // namespace
}  // namespace speculum::test
