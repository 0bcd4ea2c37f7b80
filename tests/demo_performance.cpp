// The graphs of times and their CSV.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "demo_window_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class PerformancePanel : public DemoWindow {
 protected:
  PerformancePanel() { click("panel.Performance"); }

  std::vector<std::vector<std::string>> copied() {
    click("performance.copy");
    std::istringstream text(demo_->window().clipboard());
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(text, line);) {
      rows.emplace_back();
      std::istringstream fields(line);
      for (std::string field; std::getline(fields, field, ',');) {
        rows.back().push_back(field);
      }
    }
    return rows;
  }
};

TEST_F(PerformancePanel, CopiesTheTimesOfFrames) {
  run(20);
  const auto rows = copied();
  ASSERT_GT(rows.size(), 20u);
  const std::vector<std::string> names{"frame",          "frame ms",           "CPU ms",
                                       "GPU ms",         "\"mirror wall ms\"", "\"main view ms\"",
                                       "\"display ms\"", "\"overlay ms\""};
  EXPECT_EQ(rows[0], names);
  // The GPU's figures of the newest frames are still to come.
  int complete = 0;
  for (size_t i = 2; i + 2 < rows.size(); ++i) {
    EXPECT_EQ(std::stoi(rows[i][0]), std::stoi(rows[i - 1][0]) + 1);
    if (rows[i].size() < names.size() || rows[i][3].empty()) {
      continue;
    }
    ++complete;
    EXPECT_GT(std::stod(rows[i][1]), 0.0);
    EXPECT_GT(std::stod(rows[i][2]), 0.0);
    double passes = 0.0;
    for (size_t pass = 4; pass < names.size(); ++pass) {
      passes += std::stod(rows[i][pass]);
    }
    EXPECT_LE(passes, std::stod(rows[i][3]) + 0.001) << "what is checked for being finite is not in the passes";
    EXPECT_GT(passes, 0.3 * std::stod(rows[i][3]));
  }
  EXPECT_GT(complete, 15);
  const FrameTimings latest = demo_->renderer().timings();
  const auto again = copied();
  const auto row =
      std::find_if(again.begin() + 1, again.end(), [&](const auto& r) { return r[0] == std::to_string(latest.frame); });
  ASSERT_NE(row, again.end());
  EXPECT_NEAR(std::stod((*row)[3]), latest.gpuMs, 1e-4);
  EXPECT_NEAR(std::stod((*row)[4]), latest.passes.at(0).gpuMs, 1e-4);
  expectQuiet();
}

TEST_F(PerformancePanel, PassesAreTimedOnlyWhileThePanelIsThereToShowThem) {
  EXPECT_FALSE(demo_->renderer().timings().passes.empty());
  press("Tab");
  run(4);
  EXPECT_TRUE(demo_->renderer().timings().passes.empty());
  EXPECT_GT(demo_->renderer().timings().gpuMs, 0.0);
  press("Tab");
  run(4);
  EXPECT_FALSE(demo_->renderer().timings().passes.empty());
  expectQuiet();
}

TEST_F(PerformancePanel, GraphsGoOnUntilTheyArePaused) {
  const auto newest = [&] { return std::stoi(copied().back()[0]); };
  const int before = newest();
  run(5);
  EXPECT_GT(newest(), before + 4);
  click("performance.pause");
  EXPECT_TRUE(demo_->model().history.paused());
  const int paused = newest();
  run(5);
  EXPECT_EQ(newest(), paused);
  // The graph of the frames' times is drawn: it has the colour of lines.
  const PixelRect graph = widget("graph.frame");
  const Pixels pixels = picture();
  int lines = 0;
  for (int y = graph.y; y < graph.y + graph.height; ++y) {
    for (int x = graph.x; x < graph.x + graph.width; ++x) {
      const uint8_t* p = &pixels.rgba[4 * (static_cast<size_t>(y) * pixels.extent.width + x)];
      lines += p[0] > 110 && p[1] > 110 && p[2] > 110;
    }
  }
  EXPECT_GT(lines, 10);
  click("performance.clear");
  EXPECT_EQ(demo_->model().history.frames(), 0u);
  click("performance.pause");
  EXPECT_GT(demo_->model().history.frames(), 0u);
  expectQuiet();
}

}  // namespace
}  // namespace speculum
