// Parts of the panels that stand alone: shortened names, the histories of frames and log lines, the tree of passes.
#include "platform/text.hpp"
#include "test_headers.hpp"
#include "ui/frame_history.hpp"
#include "ui/log_history.hpp"
#include "ui/pass_tree.hpp"

namespace speculum {
namespace {

// Ten units a byte.
float widthOf(std::string_view text) {
  return 10.0f * static_cast<float>(text.size());
}

TEST(Elide, FittingTextStays) {
  EXPECT_EQ(endsThatFit("left > right", 120.0f, widthOf), "left > right");
  EXPECT_EQ(endsThatFit("", 0.0f, widthOf), "");
}

TEST(Elide, BothEndsStay) {
  EXPECT_EQ(endsThatFit("shadow map of lamp +x", 139.0f, widthOf), "shado...mp +x");
  EXPECT_EQ(endsThatFit("shadow map of lamp +x", 50.0f, widthOf), "s...x");
  EXPECT_EQ(endsThatFit("left", 40.0f, widthOf), "left");
  EXPECT_EQ(endsThatFit("left", 39.0f, widthOf), "...");
  EXPECT_EQ(endsThatFit("left", 0.0f, widthOf), "...");
}

TEST(Elide, LongTextsTakeFewMeasurements) {
  int measured = 0;
  const auto counted = [&](std::string_view text) { return ++measured, widthOf(text); };
  EXPECT_EQ(endsThatFit(std::string(100'000, 'a'), 1000.0f, counted).size(), 100u);
  EXPECT_LT(measured, 50);
  EXPECT_EQ(shortened(std::string(100'000, 'a'), 100).size(), 100u);
}

TEST(Elide, CharactersAreNotCut) {
  EXPECT_EQ(endsThatFit("\u00e4\u00e4 > \u00e4\u00e4", 80.0f, widthOf), "\u00e4...\u00e4");
  EXPECT_EQ(endsThatFit("\u00e4\u00e4 > \u00e4\u00e4", 60.0f, widthOf), "\u00e4...");
  EXPECT_EQ(endsThatFit("\u00e4\u00e4 > \u00e4\u00e4", 40.0f, widthOf), "...");
  EXPECT_EQ(endsThatFit("\x84\x84\x84\x84", 30.0f, widthOf), "...") << "no UTF-8";
}

TEST(Elide, LinesBreakAtSpacesOnly) {
  EXPECT_EQ(brokenAtSpaces("about 0.2. Space pauses", 100.0f, widthOf), "about 0.2.\nSpace\npauses");
  EXPECT_EQ(brokenAtSpaces("about 0.2. Space pauses", 90.0f, widthOf), "about\n0.2.\nSpace\npauses");
  EXPECT_EQ(brokenAtSpaces("about 0.2", 90.0f, widthOf), "about 0.2");
  EXPECT_EQ(brokenAtSpaces("a word\nof 3", 60.0f, widthOf), "a word\nof 3") << "lines are counted anew";
  EXPECT_EQ(brokenAtSpaces("reflections of", 50.0f, widthOf), "reflections\nof");
  EXPECT_EQ(brokenAtSpaces("next one 30 %; more", 110.0f, widthOf), "next one\n30 %; more");
}

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

TEST(FrameHistory, DraftsAreKeptApart) {
  FrameHistory history;
  history.add(1, 800.0, 1.0);
  history.add(2, 50.0, 1.0, true);
  history.add(3, 60.0, 1.0, true);
  history.addGpu(1, 700.0, Passes{});
  EXPECT_TRUE(history.lowered());
  EXPECT_EQ(history.series(FrameHistory::Figure::frame), (std::vector<float>{50.0f, 60.0f}));
  history.add(4, 900.0, 1.0);
  EXPECT_EQ(history.frames(), 2u);
  EXPECT_EQ(history.series(FrameHistory::Figure::gpu).front(), 700.0f);
  history.clear();
  EXPECT_EQ(history.frames(), 0u);
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

TEST(FrameHistory, PassesThatStopLeaveTheList) {
  FrameHistory history;
  history.add(1, 1.0, 1.0);
  history.addGpu(1, 1.0, Passes{{"old", 1.0}});
  for (uint64_t number = 2; number <= FrameHistory::recent + 1; ++number) {
    EXPECT_EQ(history.passNames().front(), "old") << "its turn may come again";
    history.add(number, 1.0, 1.0);
    history.addGpu(number, 1.0, Passes{{"new", 1.0}});
    history.add(100 + number, 1.0, 1.0);
    history.addGpu(100 + number, 1.0, Passes{});  // whose passes were not timed
  }
  EXPECT_EQ(history.passNames(), std::vector<std::string>{"new"});
}

TEST(FrameHistory, RestartsOnceItIsNotPaused) {
  FrameHistory history;
  history.add(1, 1.0, 1.0);
  history.setPaused(true);
  history.restart();
  EXPECT_EQ(history.frames(), 1u);
  history.setPaused(false);
  EXPECT_EQ(history.frames(), 0u) << "its frames belong to earlier settings";
  history.add(2, 1.0, 1.0);
  history.restart();
  EXPECT_EQ(history.frames(), 0u);
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
            "frame,frame ms,CPU ms,GPU ms,\"mirror \"\"a\"\", b ms\",main view ms\n"
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

TEST(LogHistory, KeepsTheLatestLines) {
  LogHistory log;
  for (size_t i = 0; i < LogHistory::longest + 3; ++i) {
    log.add(LogLevel::info, std::to_string(i));
  }
  ASSERT_EQ(log.lines().size(), LogHistory::longest);
  EXPECT_EQ(log.lines().front().text, "3");
  log.clear();
  EXPECT_TRUE(log.lines().empty());
}

TEST(LogHistory, FiltersByLevelAndText) {
  LogHistory log;
  log.add(LogLevel::info, "GPU 0");
  log.add(LogLevel::warn, "Validation: one");
  log.add(LogLevel::err, "validation: two");
  EXPECT_EQ(log.lines().size(), 3u);
  EXPECT_EQ(log.lines(LogLevel::warn).size(), 2u);
  EXPECT_EQ(logText(log.lines(LogLevel::info, "VALIDATION")), "warning: Validation: one\nerror: validation: two\n");
  EXPECT_EQ(logText(log.lines(LogLevel::err, "gpu")), "");
}

TEST(PassTree, MirrorsHangBelowTheirParents) {
  // In the order of recording: children before their parent.
  const std::vector<PassRow> passes = {
      {{.path = {0, 1}}, "mirror a > b"},      {{.path = {0}}, "mirror a"},
      {{.path = {1, 0}}, "mirror b > a"},      {{.path = {1}}, "mirror b"},
      {{.kind = PassKind::main}, "main view"}, {{.kind = PassKind::display}, "display"}};
  const std::vector<SkippedRow> skipped = {{"c", {2}, "hidden"},
                                           {"a > c", {0, 2}, "outside"},
                                           {"a > b > a", {0, 1, 0}, "max_depth"},
                                           {"d > a", {3, 0}, "outside"}};
  const std::vector<TreeNode> roots = passTree(passes, skipped);
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_EQ(roots[1].pass, 5);
  EXPECT_TRUE(roots[1].children.empty());
  const TreeNode& main = roots[0];
  EXPECT_EQ(main.pass, 4);
  EXPECT_EQ(main.skipped, std::vector<int>{0});
  ASSERT_EQ(main.children.size(), 2u);
  EXPECT_EQ(main.children[0].pass, 1);
  EXPECT_EQ(main.children[0].skipped, std::vector<int>{1});
  ASSERT_EQ(main.children[0].children.size(), 1u);
  EXPECT_EQ(main.children[0].children[0].pass, 0);
  EXPECT_EQ(main.children[0].children[0].skipped, std::vector<int>{2});
  ASSERT_EQ(main.children[1].children.size(), 1u);
  EXPECT_EQ(main.children[1].children[0].pass, 2);
}

TEST(PassTree, IsEmptyWithoutPasses) {
  EXPECT_TRUE(passTree({}, {}).empty());
}

TEST(PassTree, ReusedImagesAreNotListedTwice) {
  const std::vector<PassRow> passes = {{{.path = {0}}, "mirror a"}, {{.kind = PassKind::main}, "main view"}};
  const std::vector<SkippedRow> skipped = {{"a", {0}, "unchanged"}, {"b", {1}, "hidden"}};
  const std::vector<TreeNode> roots = passTree(passes, skipped);
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_EQ(roots[0].skipped, std::vector<int>{1});
}

TEST(MirrorCost, SumsPassesOrSaysWhyNone) {
  ShownFrame frame;
  const auto pass = [&](MirrorPath path, double ms, double pixels) {
    PassRow row{{.path = std::move(path)}};
    row.gpuMs = ms;
    row.timed = !std::isnan(ms);
    row.areaPx = pixels;
    frame.passes.push_back(row);
  };
  pass({2}, 12.5, 4000.0);
  EXPECT_EQ(mirrorCost(frame, 2), "1 pass, 4000 pixels, 12.5 ms on the GPU, 100 % of all passes");
  pass({1, 2}, NAN, 300.0);
  pass({2, 1}, 7.0, 1.0);
  EXPECT_EQ(mirrorCost(frame, 2), "2 passes, 4300 pixels, 12.5 ms on the GPU");
  frame.passes[0].timed = false;
  EXPECT_EQ(mirrorCost(frame, 2), "2 passes, 4300 pixels") << "its time is of an earlier frame";
  frame.passes[0].reused = frame.passes[1].reused = true;
  EXPECT_EQ(mirrorCost(frame, 2), "2 passes, 4300 pixels, reused");
  frame.passes.push_back({{.kind = PassKind::main}});
  frame.skipped = {{.path = {0, 3}, .reason = "hidden"}, {.path = {3}, .reason = "seen from behind"}};
  EXPECT_EQ(mirrorCost(frame, 3), "No pass: seen from behind");
  EXPECT_EQ(mirrorCost(frame, 4), "No pass");
  frame.skipped.push_back({.path = {5, 4}, .reason = "drawn by rays", .byRays = true});
  EXPECT_EQ(mirrorCost(frame, 4), "Drawn by rays");
}

TEST(MirrorCost, TimeIsTheMedianOfTheLastFrames) {
  ShownFrame frame;
  frame.passes = {{{.path = {0}}, "mirror wall"}, {{.kind = PassKind::main}, "main view"}};
  frame.passes[0].timed = frame.passes[1].timed = true;
  for (const auto& [number, ms] : {std::pair(1, 10.0), std::pair(2, 12.0), std::pair(3, 50.0)}) {
    frame.history.add(number, 60.0, 1.0);
    frame.history.addGpu(number, 200.0,
                         std::vector{std::pair<std::string, double>("mirror wall", ms), {"main view", 2.0 * ms}});
    frame.passes[0].gpuMs = ms;
    frame.passes[1].gpuMs = 4.0 * ms;
  }
  EXPECT_EQ(mirrorCost(frame, 0), "1 pass, 0 pixels, 12.0 ms on the GPU, 33 % of all passes") << "waiting is no pass";
  frame.history.setPaused(true);
  EXPECT_EQ(mirrorCost(frame, 0), "1 pass, 0 pixels, 50.0 ms on the GPU, 20 % of all passes")
      << "the history may be of other frames";
  frame.passes[1].gpuMs = 1e5;
  EXPECT_EQ(mirrorCost(frame, 0), "1 pass, 0 pixels, 50.0 ms on the GPU, under 1 % of all passes");
  frame.passes[1].timed = false;
  EXPECT_EQ(mirrorCost(frame, 0), "1 pass, 0 pixels, 50.0 ms on the GPU") << "the sum is not known";
  frame.passes[1].reused = true;
  EXPECT_EQ(mirrorCost(frame, 0), "1 pass, 0 pixels, 50.0 ms on the GPU, 100 % of all passes");
}

TEST(RestOfPasses, IsWhatTheFrameTookBesides) {
  ShownFrame frame;
  frame.passes.resize(2);
  frame.passes[0].gpuMs = 20.0;
  frame.passes[1].gpuMs = 5.0;
  frame.passes[1].timed = true;
  EXPECT_TRUE(std::isnan(restOfPasses(frame)));
  frame.timedGpuMs = 12.0;
  EXPECT_EQ(restOfPasses(frame), 7.0) << "the other is of an earlier frame";
  frame.timedGpuMs = 4.9;
  EXPECT_EQ(restOfPasses(frame), 0.0) << "rounding";
}

}  // namespace
}  // namespace speculum
