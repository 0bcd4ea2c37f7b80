// A | B and lessons in the panels.
#include "ui/panel_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class SplitPanels : public PanelTest {
 protected:
  SplitPanels() {
    split_.lessons = {{"/scenes/one.toml", "First", "Text one.", "this."},
                      {"/scenes/two.toml", "Second", "Text two.", "that."}};
  }
  void begin() {
    split_.on = true;
    split_.divider = 0.7;
    split_.halves[0].differs = {{"reflection.scale", "0.25"}};
    split_.halves[1].differs = {{"reflection.scale", "1.0"}, {"view.clear_color", ""}};
  }
};

TEST_F(SplitPanels, DividerIsDraggedAndLabelled) {
  EXPECT_FALSE(has("divider"));
  EXPECT_FALSE(has("split.a"));
  begin();
  EXPECT_TRUE(shows("reflection.scale = 0.25"));
  EXPECT_TRUE(shows("view.clear_color = the scene's"));
  EXPECT_FALSE(shows("FLIP"));
  EXPECT_FALSE(shows("GPU"));
  split_.halves[0].gpuMs = 3.214;
  split_.halves[0].error = 0.0312;
  split_.halves[0].picture = "Draft";
  EXPECT_TRUE(shows("GPU 3.21 ms"));
  EXPECT_FALSE(shows("for each of"));
  split_.halves[0].pictures = 64;
  EXPECT_TRUE(shows("GPU 3.21 ms for each of 64 pictures"));
  EXPECT_TRUE(shows("FLIP 0.0312 against B"));
  EXPECT_TRUE(shows("Draft"));
  split_.halves[0].ofReference = true;
  EXPECT_TRUE(shows("FLIP 0.0312 against the reference"));
  drag("divider", 0.5, 45, 0);
  double share = 0.0;
  for (const Command& command : commands_) {
    const auto* moved = std::get_if<MoveDivider>(&command);
    share = moved ? moved->share : share;
  }
  EXPECT_NEAR(share, 0.75, 0.01);
  windows_->toggleVisible();
  EXPECT_TRUE(shows("reflection.scale = 0.25")) << "without panels too";
}

TEST_F(SplitPanels, LabelsStayInPlaceWhileNumbersGrow) {
  begin();
  // Returns the place of the first letter and the number of lines of A's label.
  const auto placeWith = [&](const std::string& picture) {
    split_.halves[0].picture = picture;
    run(2);
    std::optional<glm::vec2> corner;
    std::set<float> lines;
    for (const ImDrawList* list : drawLists()) {
      for (const DrawnGlyph& glyph : glyphsOf(*list)) {
        const float x = list->VtxBuffer[glyph.vertex].pos.x;
        if (std::string_view(list->_OwnerName) == panels::dividerTitle && x < 0.7f * ImGui::GetIO().DisplaySize.x) {
          corner = corner.value_or(glm::vec2(x, glyph.lineTop));
          lines.insert(glyph.lineTop);
        }
      }
    }
    return std::pair(corner, lines.size());
  };
  const auto before = placeWith("9 of 64 pictures averaged, next one 5 %");
  ASSERT_TRUE(before.first);
  EXPECT_EQ(placeWith("18 of 64 pictures averaged, next one 85 %"), before);
}

TEST_F(SplitPanels, LabelsBreakBetweenWordsOnly) {
  resize(640, 480);
  begin();
  split_.halves[0].differs = split_.halves[1].differs = {{"reflection.scale", "1.0"}};
  std::set<std::string> lines;
  for (split_.divider = 0.5; split_.divider < 0.99; split_.divider += 0.01) {
    run(2);
    for (const ImDrawList* list : drawLists()) {
      std::map<float, std::string> found;  // by the top of the line
      for (const DrawnGlyph& glyph : glyphsOf(*list)) {
        const bool ofB = list->VtxBuffer[glyph.vertex].pos.x > split_.divider * ImGui::GetIO().DisplaySize.x;
        found[glyph.lineTop] += ofB && std::string_view(list->_OwnerName) == panels::dividerTitle ? glyph.letter : ' ';
      }
      for (const auto& [top, line] : found) {
        lines.insert(line.substr(line.find_last_of(' ') + 1));
      }
    }
  }
  EXPECT_TRUE(lines.contains("1.0")) << "some label is narrow";
  EXPECT_FALSE(lines.contains("0"));
}

TEST_F(SplitPanels, HalfIsChosenKeptOrLeft) {
  begin();
  EXPECT_TRUE(shows("Settings of B, the right half"));
  EXPECT_EQ(clickFor<ChooseHalf>("split.a", 0.1).half, 0);
  split_.chosen = 0;
  EXPECT_TRUE(shows("Settings of A, the left half"));
  clickFor<KeepHalf>("split.keep");
  clickFor<ToggleSplit>("split.end");
  click("menu.View");
  clickFor<ToggleSplit>("menu.End A | B");
  click("menu.View");
  clickFor<ChooseOtherHalf>("menu.Edit the other half's settings");
}

TEST_F(SplitPanels, LessonsAreOpenedAndWalkedThrough) {
  click("menu.Help");
  click("menu.Lessons");
  hover("lesson.0");
  run(3);
  ASSERT_TRUE(tooltip());
  for (const char* menu : {"##Menu_00", "##Menu_01"}) {
    EXPECT_FALSE(tooltip()->Rect().Overlaps(ImGui::FindWindowByName(menu)->Rect())) << menu;
  }
  const OpenScene opened = clickFor<OpenScene>("lesson.1");
  EXPECT_EQ(opened.file, "/scenes/two.toml");
  EXPECT_EQ(opened.lesson, 1u);
  EXPECT_FALSE(shows("Text two."));
  begin();
  const WindowRect free = windows_->freeRect();
  split_.lesson = 1;
  run(5);
  EXPECT_EQ(windows_->freeRect().corner.x, free.corner.x) << "both halves stay in sight";
  EXPECT_EQ(windows_->freeRect().size.x, free.size.x);
  const PixelRect next = widget("lesson.next");
  split_.lessons[1].text = std::string(400, 'w');
  EXPECT_TRUE(shows("ww"));
  EXPECT_EQ(widget("lesson.next").y, next.y) << "whatever the text's length";
  split_.lessons[1].text = "Text two.";
  toggle("Performance");
  toggle("Device");
  EXPECT_LT(windows_->freeRect().size.x, free.size.x);
  windows_->closeSidePanels();
  run(3);
  EXPECT_EQ(windows_->freeRect().size.x, free.size.x);
  EXPECT_TRUE(shows("2 of 2: Second"));
  EXPECT_TRUE(shows("Text two."));
  EXPECT_TRUE(shows("Look for: that."));
  click("lesson.next");
  EXPECT_FALSE(sent<OpenScene>()) << "it is the last one";
  EXPECT_EQ(clickFor<OpenScene>("lesson.previous").lesson, 0u);
}

}  // namespace
}  // namespace speculum
