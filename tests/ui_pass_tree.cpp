#include "test_headers.hpp"
#include "ui/mirror_cost.hpp"
#include "ui/pass_tree.hpp"

namespace speculum {
namespace {

TEST(PassTree, MirrorsHangBelowTheirParents) {
  // In the order of recording: children before their parent.
  const std::vector<PassView> passes = {
      {{.path = {0, 1}}, "mirror a > b"},      {{.path = {0}}, "mirror a"},
      {{.path = {1, 0}}, "mirror b > a"},      {{.path = {1}}, "mirror b"},
      {{.kind = PassKind::main}, "main view"}, {{.kind = PassKind::display}, "display"}};
  const std::vector<SkippedView> skipped = {{"c", {2}, "hidden"},
                                            {"a > c", {0, 2}, "outside"},
                                            {"a > b > a", {0, 1, 0}, "max_depth"},
                                            {"d > a", {3, 0}, "outside"}};
  const std::vector<PassBranch> roots = passTree(passes, skipped);
  ASSERT_EQ(roots.size(), 2u);
  EXPECT_EQ(roots[1].pass, 5);
  EXPECT_TRUE(roots[1].children.empty());
  const PassBranch& main = roots[0];
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
  const std::vector<PassView> passes = {{{.path = {0}}, "mirror a"}, {{.kind = PassKind::main}, "main view"}};
  const std::vector<SkippedView> skipped = {{"a", {0}, "unchanged"}, {"b", {1}, "hidden"}};
  const std::vector<PassBranch> roots = passTree(passes, skipped);
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_EQ(roots[0].skipped, std::vector<int>{1});
}

TEST(MirrorCost, SumsPassesOrSaysWhyNone) {
  FrameView frame;
  const auto pass = [&](std::vector<int> path, double ms, double texels) {
    PassView row{{.path = std::move(path)}};
    row.gpuMs = ms;
    row.timed = !std::isnan(ms);
    row.areaPx = texels;
    frame.passes.push_back(row);
  };
  pass({2}, 12.5, 4000.0);
  EXPECT_EQ(mirrorCost(frame, 2), "1 pass, 4000 texels, 12.5 ms on the GPU");
  pass({1, 2}, NAN, 300.0);
  pass({2, 1}, 7.0, 1.0);
  EXPECT_EQ(mirrorCost(frame, 2), "2 passes, 4300 texels, 12.5 ms on the GPU");
  frame.passes[0].timed = false;
  EXPECT_EQ(mirrorCost(frame, 2), "2 passes, 4300 texels") << "its time is of an earlier frame";
  frame.passes[0].reused = frame.passes[1].reused = true;
  EXPECT_EQ(mirrorCost(frame, 2), "2 passes, 4300 texels, reused");
  frame.passes.push_back({{.kind = PassKind::main}});
  frame.skipped = {{.path = {0, 3}, .reason = "hidden"}, {.path = {3}, .reason = "seen from behind"}};
  EXPECT_EQ(mirrorCost(frame, 3), "No pass: seen from behind");
  EXPECT_EQ(mirrorCost(frame, 4), "No pass");
}

}  // namespace
}  // namespace speculum
