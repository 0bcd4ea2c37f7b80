// Figures of as many passes as a plan may have.
#include "cli/stats.hpp"

#include <ctime>

#include "instrumented.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

TEST(Stats, ManyPassesTakeShortTime) {
  std::vector<RecordedPass> recorded;
  nlohmann::ordered_json frame = {{"totals", nlohmann::ordered_json::object()}};
  for (int i = 0; i < 25'000; ++i) {
    recorded.emplace_back().path = {i / 1000, i % 1000, i % 7};
    frame["passes"].push_back({{"gpu_ms", 1.0}});
  }
  const std::vector<PassId> ids(recorded.begin(), recorded.end());
  const std::clock_t start = std::clock();  // other programs take none of it
  PictureSums sums;
  for (int picture = 0; picture < 2; ++picture) {
    sums.beginPicture();
    sums.add(recorded, FrameTimings());
  }
  EXPECT_EQ(sums.passes().size(), recorded.size());
  EXPECT_EQ(mergeStats({frame, frame}, {ids, ids})["passes"].size(), recorded.size());
  EXPECT_LT(std::clock() - start, testing_support::instrumented * CLOCKS_PER_SEC);
}

}  // namespace
}  // namespace speculum
