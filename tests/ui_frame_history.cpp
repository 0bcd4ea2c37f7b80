#include "test_headers.hpp"
#include "ui/frame_history.hpp"

namespace speculum {
namespace {

using Passes = std::vector<std::pair<std::string, double>>;
constexpr double unknown = NAN;

TEST(FrameHistory, KeepsTheLastFrames) {
  FrameHistory history;
  for (uint64_t number = 1; number <= FrameHistory::longest + 7; ++number) {
    history.add(number, static_cast<double>(number), 1.0);
  }
  EXPECT_EQ(history.frames(), FrameHistory::longest);
  const std::vector<float> frames = history.series(FrameHistory::Figure::frame);
  EXPECT_EQ(frames.front(), 8.0f);
  EXPECT_EQ(frames.back(), 307.0f);
}

TEST(FrameHistory, GpuFiguresJoinTheirFrames) {
  FrameHistory history;
  history.add(1, unknown, 1.0);
  history.add(2, 10.0, 2.0);
  history.addGpu(1, 5.0, Passes{{"mirror a", 2.0}, {"main view", 3.0}});
  history.addGpu(1, 99.0, Passes{{"mirror b", 9.0}});
  history.addGpu(7, 99.0, Passes{{"mirror b", 9.0}});
  const std::vector<float> gpu = history.series(FrameHistory::Figure::gpu);
  EXPECT_EQ(gpu[0], 5.0f);
  EXPECT_TRUE(std::isnan(gpu[1]));
  EXPECT_EQ(history.passNames(), (std::vector<std::string>{"mirror a", "main view"}));
  EXPECT_EQ(history.passSeries("mirror a")[0], 2.0f);
  EXPECT_TRUE(std::isnan(history.passSeries("mirror a")[1]));
  EXPECT_TRUE(std::isnan(history.passSeries("none")[0]));
}

TEST(FrameHistory, PassesWithoutFramesAreDropped) {
  FrameHistory history;
  history.add(1, 1.0, 1.0);
  history.addGpu(1, 1.0, Passes{{"old", 1.0}});
  for (uint64_t number = 2; number <= FrameHistory::longest + 1; ++number) {
    history.add(number, 1.0, 1.0);
    history.addGpu(number, 1.0, Passes{{"new", 1.0}, {"new", 2.0}});
  }
  EXPECT_EQ(history.passNames(), std::vector<std::string>{"new"});
  EXPECT_EQ(history.passSeries("new").back(), 3.0f) << "passes of one name add up";
}

TEST(FrameHistory, PausedItStaysAsItIs) {
  FrameHistory history;
  history.add(1, 1.0, 1.0);
  history.setPaused(true);
  history.add(2, 1.0, 1.0);
  history.addGpu(1, 1.0, Passes{{"main view", 1.0}});
  EXPECT_EQ(history.frames(), 1u);
  EXPECT_TRUE(history.passNames().empty());
}

TEST(FrameHistory, CsvHasHeaderAndFrameLines) {
  FrameHistory history;
  history.add(4, unknown, 0.5);
  history.add(5, 16.25, 0.75);
  history.addGpu(5, 8.0, Passes{{"mirror \"a\", b", 2.0}, {"main view", 3.5}});
  EXPECT_EQ(history.csv(),
            "frame,frame ms,CPU ms,GPU ms,\"mirror \"\"a\"\", b ms\",\"main view ms\"\n"
            "4,,0.5000,,,\n"
            "5,16.2500,0.7500,8.0000,2.0000,3.5000\n");
  history.clear();
  EXPECT_EQ(history.csv(), "frame,frame ms,CPU ms,GPU ms\n");
}

TEST(FrameHistory, PercentilesAreOfWhatIsKnown) {
  std::vector<float> values;
  for (int i = 100; i >= 1; --i) {
    values.push_back(static_cast<float>(i));
    values.push_back(NAN);
  }
  EXPECT_EQ(percentile(values, 0.5), 50.0);
  EXPECT_EQ(percentile(values, 0.95), 95.0);
  EXPECT_EQ(percentile(values, 1.0), 100.0);
  EXPECT_EQ(percentile(values, 0.0), 1.0);
  EXPECT_TRUE(std::isnan(percentile(std::vector<float>{NAN}, 0.5)));
}

}  // namespace
}  // namespace speculum
