#include "plan/support.hpp"
#include "plan/target_memory.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using testing_support::wall;

FramePlan rangePlan(std::vector<Mirror> mirrors, int maxDepth) {
  Settings settings;
  settings.reflection.maxDepth = maxDepth;
  return testing_support::planOf(testing_support::sceneWith(std::move(mirrors)), settings);
}

void expectWhole(const FramePlan& plan, const RecycledVector<ConcurrentPasses>& ranges) {
  size_t next = 0;
  for (const ConcurrentPasses& range : ranges) {
    EXPECT_EQ(range.first, next);
    EXPECT_GT(range.end, range.first);
    next = range.end;
  }
  EXPECT_EQ(next, plan.drawnMirrors().size());
}

TEST(ConcurrentPasses, MirrorsSideBySideShareOneRange) {
  const FramePlan plan =
      rangePlan({wall({-2, 0, -5}, 0, {1, 1}), wall({0, 0, -5}, 0, {2, 2}), wall({2, 0, -5}, 0, {1.5, 1})}, 1);
  ASSERT_EQ(plan.drawnMirrors().size(), 3u);
  const auto ranges = independentPasses(plan);
  ASSERT_EQ(ranges.size(), 1u);
  expectWhole(plan, ranges);
  const auto order = largestFirst(plan, ranges[0]);
  for (size_t i = 1; i < order.size(); ++i) {
    EXPECT_GE(plan.drawnMirrors()[order[i - 1]].view.rect.area(), plan.drawnMirrors()[order[i]].view.rect.area());
  }
}

TEST(ConcurrentPasses, RangesHoldNoPassWithItsImages) {
  const FramePlan plan =
      rangePlan({wall({-1, 0, -2}, 70, {3, 2}), wall({1, 0, -2}, -70, {3, 2}), wall({0, 0, -5}, 0, {1, 2})}, 4);
  ASSERT_GT(plan.drawnMirrors().size(), 6u);
  const auto ranges = independentPasses(plan);
  expectWhole(plan, ranges);
  EXPECT_LT(ranges.size(), plan.drawnMirrors().size());
  for (const ConcurrentPasses& range : ranges) {
    for (size_t i = range.first; i < range.end; ++i) {
      for (const MirrorDraw& draw : plan.drawnMirrors()[i].mirrors) {
        EXPECT_LT(draw.pass, static_cast<int>(range.first)) << "pass " << i;
      }
    }
  }
}

TEST(ConcurrentPasses, RangesCoverAtMostOnePicture) {
  // Each mirror covers more than half of the picture; the second is beside and behind the first.
  const FramePlan plan = rangePlan({wall({-1, 0, -3}, 0, {6, 4}), wall({3, 0, -5}, 0, {8, 8})}, 1);
  ASSERT_EQ(plan.drawnMirrors().size(), 2u);
  ASSERT_GT(plan.drawnMirrors()[0].view.rect.area() + plan.drawnMirrors()[1].view.rect.area(), 640 * 360);
  EXPECT_EQ(independentPasses(plan).size(), 2u);
}

TEST(ConcurrentPasses, MemoryIncludesDepthOfTheLargestRange) {
  Settings settings;
  settings.reflection.samples = 1;
  settings.view.samples = 1;
  const FramePlan one = rangePlan({wall({-2, 0, -5}, 0, {1, 1})}, 1);
  const FramePlan two = rangePlan({wall({-2, 0, -5}, 0, {1, 1}), wall({2, 0, -5}, 0, {1, 1})}, 1);
  ASSERT_EQ(two.drawnMirrors().size(), 2u);
  const auto added = static_cast<uint64_t>(two.drawnMirrors()[1].view.rect.area());
  EXPECT_EQ(targetBytes(two, settings) - targetBytes(one, settings), added * 4 * (8 + 4))
      << "four samples a pixel, as planned";
}

}  // namespace
}  // namespace speculum
