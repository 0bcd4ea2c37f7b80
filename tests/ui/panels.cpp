// Commands that clicks on the panels send, and the state that panels keep.
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_versions.hpp>

#include "platform/process.hpp"
#include "platform/text.hpp"
#include "scene/scene_fields.hpp"
#include "settings/setting_fields.hpp"
#include "ui/panel_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

TEST_F(PanelTest, SettingsAreEditedAndReset) {
  EXPECT_FALSE(has("reset.view.exposure"));
  drag("view.exposure", 0.5, 60);
  EXPECT_GT(settings_.view.exposure, 1.5);
  drag("view.clear_color", 0.1, 60);
  ASSERT_TRUE(settings_.view.clearColor);
  const PixelRect slider = widget("view.exposure");
  const PixelRect arrow = widget("reset.view.exposure");
  EXPECT_EQ(arrow.y, slider.y);
  EXPECT_GT(arrow.x, slider.x + slider.width);
  EXPECT_LT(arrow.x + arrow.width, 12 + 420) << "within the panel";
  click("reset.view.exposure");
  EXPECT_EQ(settings_.view.exposure, 1.0);
  EXPECT_TRUE(settings_.view.clearColor) << "only one is reset";
  EXPECT_FALSE(has("reset.view.exposure"));
  click("reset.view.clear_color");
  EXPECT_FALSE(settings_.view.clearColor);
  click("view.exposure");
  commands_.clear();
  run(3);
  EXPECT_TRUE(commands_.empty()) << "nothing is sent unless something was done";
}

TEST_F(PanelTest, SavedClearColorIsTakenBack) {
  EXPECT_FALSE(has("view.scene_background"));
  settings_.view.clearColor = sceneSettings_.view.clearColor = glm::dvec3(0.5);
  EXPECT_FALSE(has("reset.view.clear_color")) << "it is the scene's";
  EXPECT_FALSE(clickFor<SetSettings>("view.scene_background").settings.view.clearColor);
  EXPECT_FALSE(has("view.scene_background"));
  click("reset.view.clear_color");
  EXPECT_TRUE(settings_.view.clearColor);
}

class ResetArrow : public PanelTest {
 protected:
  // A drag left the keyboard's focus on the slider; the arrow is to its right.
  void expectArrowResetsExposure() {
    EXPECT_NE(settings_.view.exposure, 1.0);
    tap(ImGuiKey_RightArrow);
    tap(ImGuiKey_RightArrow);
    tap(ImGuiKey_Space);
    EXPECT_EQ(settings_.view.exposure, 1.0);
  }
};

TEST_F(ResetArrow, IsReachedByKeyboard) {
  drag("view.exposure", 0.2, 60);
  expectArrowResetsExposure();
}

TEST_F(ResetArrow, OfACutRowIsReached) {
  const PixelRect row = widget("view.exposure");
  const float margin = std::floor(0.8f * ImGui::GetFontSize());
  resize(900, row.y + 3 + margin + panels::statusHeight());  // 3 pixels of it are in sight
  dragFrom(row.x + 0.2 * row.width, row.y + 1, 60);
  expectArrowResetsExposure();
}

// Says whether a widget's rectangle lies between two columns of the display.
bool within(const PixelRect& rect, int left, int right) {
  return rect.x >= left && rect.x + rect.width <= right;
}

TEST_F(PanelTest, PanelsOfBothEdgesDoNotOverlap) {
  scene_.mirrors[0].ripple = Ripple{.amplitude = 0.1};
  edit_.selected = {Selection::Kind::mirror, 0};
  windows_->toggleInspector();
  for (const float width : {900.0f, 560.0f, 500.0f}) {
    resize(width, 700);
    const float middle = windows_->freeRect().corner.x;
    EXPECT_GE(windows_->freeRect().size.x, 9.0f) << width;
    for (const char* name : {"screenshot", "bookmark.add", "view.clear_color", "panel.Accuracy", "settings.reset"}) {
      EXPECT_TRUE(within(widget(name), 10, static_cast<int>(middle))) << name << " at " << width;
    }
    for (const char* name :
         {"edit.redo", "edit.save_as", "edit.look_behind", "edit.position", "edit.ripple.wavelength"}) {
      EXPECT_TRUE(within(widget(name), static_cast<int>(middle) + 10, static_cast<int>(width) - 10))
          << name << " at " << width;
    }
    const PixelRect name = widget("edit.name");
    const int above = widget("edit.position").y - name.y - name.height;
    EXPECT_EQ(static_cast<float>(above) > ImGui::GetTextLineHeight(), width < 900.0f)
        << "beside three numbers there is no room for a label at " << width;
  }
}

// Says which windows that are shown, menus included but no tooltips, lie over each other.
std::string overlaps() {
  std::vector<const ImGuiWindow*> shown;
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
    const bool tooltip = (window->Flags & ImGuiWindowFlags_Tooltip) != 0;
    if (window->Active && !window->Hidden && !tooltip && !window->ParentWindow && window->Size.x > 1.0f &&
        std::string_view(window->Name).find("Debug##") == std::string_view::npos) {
      shown.push_back(window);
    }
  }
  std::string found;
  for (size_t i = 0; i < shown.size(); ++i) {
    for (size_t k = i + 1; k < shown.size(); ++k) {
      if (shown[i]->Rect().Overlaps(shown[k]->Rect())) {
        found += std::string(shown[i]->Name) + " and " + shown[k]->Name + "; ";
      }
    }
  }
  return found;
}

TEST_F(PanelTest, NoWindowLiesOverAnother) {
  windows_->toggleInspector();
  playback_.paused = true;
  playback_.cost = "Play (about 20 frames/s at 0.44 of the resolution)";
  status_.text = "Saved /home/somebody/Pictures/Speculum/gallery_2026-11-28_01-16-41.png";
  status_.picture = "6 of 64 pictures averaged, next one 30 %\napproximate: shadow outlines\nand what is rough";
  for (const char* window : {"Scenes", "Performance", "Accuracy", "Device", "Log", "Targets"}) {
    toggle(window);
    for (const auto& [width, height] : {std::pair(1280.0f, 720.0f), std::pair(640.0f, 480.0f),
                                        std::pair(495.0f, 700.0f), std::pair(360.0f, 600.0f)}) {
      resize(width, height);
      EXPECT_EQ(overlaps(), "") << width << " with " << window;
    }
    resize(900, 700);
  }
}

TEST_F(PanelTest, NarrowDisplaysHaveOneColumn) {
  windows_->toggleInspector();
  resize(495, 700);  // 38 sizes of the font
  EXPECT_EQ(widget("edit.add_mirror").x, widget("copy").x);
  const PixelRect add = widget("edit.add_mirror");
  EXPECT_TRUE(windows_->freeRect().size.x > 100.0f);
  windows_->toggleInspector();
  run(2);
  EXPECT_TRUE(windows_->inspectorCovers({static_cast<float>(add.x), static_cast<float>(add.y)}));
  EXPECT_FALSE(windows_->inspectorCovers({480.0f, 300.0f}));
  resize(900, 700);
  windows_->toggleInspector();
  EXPECT_GT(widget("edit.add_mirror").x, 450) << "back at its own edge";
}

// Returns the share of the display that windows cover, each window's part of another counted once.
double coveredShare() {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  constexpr int steps = 200;
  int covered = 0;
  for (int i = 0; i < steps * steps; ++i) {
    const ImVec2 p((i % steps + 0.5f) * display.x / steps, (i / steps + 0.5f) * display.y / steps);
    covered += std::ranges::any_of(ImGui::GetCurrentContext()->Windows, [&](const ImGuiWindow* window) {
      return window->Active && !window->Hidden && !window->ParentWindow && window->Rect().Contains(p) &&
             std::string_view(window->Name).find("Debug##") == std::string_view::npos;
    });
  }
  return static_cast<double>(covered) / (steps * steps);
}

class FirstClick : public PanelTest {
 protected:
  // Lays panels out at this scale of a monitor, with the program's font.
  void show(float width, float height, float scale) {
    ImGui::GetIO().FontGlobalScale = 15.0f * scale / 13.0f;
    resize(width, height);
    scene_ = loadScene(sourceFile("scenes/gallery.toml"));
    run(3);
  }
  void clickNode() {
    edit_.selected = {Selection::Kind::mirror, 0};
    windows_->openInspector();
    run(5);
  }
};

TEST_F(FirstClick, LeavesMostOfTheWindowToTheScene) {
  for (const auto& [width, height, scale] :
       {std::tuple(1280.0f, 720.0f, 1.0f), std::tuple(1280.0f, 720.0f, 2.0f), std::tuple(1600.0f, 900.0f, 1.25f),
        std::tuple(1024.0f, 768.0f, 1.0f), std::tuple(1366.0f, 768.0f, 1.5f), std::tuple(2560.0f, 1440.0f, 2.0f)}) {
    SCOPED_TRACE(testing::Message() << width << " x " << height << " at " << scale);
    show(width, height, scale);
    EXPECT_LT(coveredShare(), 0.44);
    clickNode();
    EXPECT_LT(coveredShare(), width == 1280.0f ? 0.33 : 0.4) << "menu bar and titles included";
    EXPECT_FALSE(contains(ImGui::SaveIniSettingsToMemory(), "Collapsed")) << "the user did not fold it";
    EXPECT_TRUE(has("edit.name")) << "the fields are in sight";
    windows_->toggleInspector();
    run(5);
    EXPECT_TRUE(has("time")) << "the main panel is back";
  }
}

TEST_F(FirstClick, FieldsOfTheNodeAreInSight) {
  show(1280, 720, 2.0f);
  clickNode();
  const auto inSight = [&](const std::string& name) {
    const PixelRect rect = widget(name);
    const ImRect& clip = ImGui::FindWindowByName(panels::inspectorTitle)->InnerClipRect;
    return rect.y >= clip.Min.y && rect.y + rect.height <= clip.Max.y;
  };
  EXPECT_TRUE(inSight("edit.quality"));
  hover("edit.quality");
  wheel(100);
  EXPECT_TRUE(inSight("edit.add_mirror"));
  edit_.selected = clickFor<SelectNode>("edit.node.1").node;
  EXPECT_TRUE(inSight("edit.add_mirror")) << "the list is in use";
  moveTo(300, 400);
  press();
  clickNode();
  EXPECT_TRUE(inSight("edit.quality"));
  show(1280, 720, 1.0f);
  hover("edit.name");
  wheel(100);
  edit_.selected = {Selection::Kind::mirror, 2};
  EXPECT_TRUE(inSight("edit.add_mirror") && inSight("edit.quality")) << "all has room";
}

TEST_F(FirstClick, FoldedPanelIsUnfoldedByAClick) {
  show(1280, 720, 1.0f);
  clickNode();
  EXPECT_FALSE(has("time"));
  moveTo(24, ImGui::GetFrameHeight() + 24);  // the arrow of its title
  press();
  EXPECT_TRUE(has("time") && has("edit.name")) << "as the user wishes";
  windows_->toggleInspector();
  EXPECT_TRUE(has("time"));
}

TEST_F(FirstClick, LargeDisplaysKeepBothPanels) {
  show(2560, 1440, 1.0f);
  clickNode();
  EXPECT_TRUE(has("time") && has("edit.name"));
}

TEST_F(PanelTest, SlowScenesOfferToPlay) {
  playback_.cost = "Play (about 20 frames/s at 0.44 of the resolution)";
  EXPECT_FALSE(has("play")) << "it plays";
  playback_.paused = true;
  EXPECT_TRUE(shows(playback_.cost));
  EXPECT_FALSE(clickFor<SetPaused>("play").paused);
  holdControl(true);
  tap(ImGuiKey_Tab);
  holdControl(false);
  run(2);
  EXPECT_STREQ(ImGui::GetCurrentContext()->NavWindow->RootWindow->Name, "Speculum") << "Space presses nothing unseen";
  ask(Prompt::recovery, "/home/scene.toml");
  EXPECT_FALSE(has("play")) << "a question comes first";
  ask(Prompt::none);
  playback_.cost.clear();
  EXPECT_FALSE(has("play"));
}

TEST_F(PanelTest, HeldWidgetsStayHeldWhenLabelsMove) {
  edit_.selected = {Selection::Kind::mirror, 0};
  windows_->toggleInspector();
  hover("edit.position", 0.2);
  hold(true);
  const ImGuiID held = ImGui::GetCurrentContext()->ActiveId;
  ASSERT_NE(held, 0u);
  resize(500, 700);
  EXPECT_EQ(ImGui::GetCurrentContext()->ActiveId, held);
  hold(false);
}

TEST_F(PanelTest, OlderWindowsFoldAndAClickUnfolds) {
  resize(900, 400);
  toggle("Performance");
  toggle("Log");
  ASSERT_TRUE(has("log.copy") && has("performance.copy"));
  toggle("Accuracy");
  EXPECT_TRUE(has("accuracy.measure") && has("log.copy"));
  EXPECT_FALSE(has("performance.copy"));
  const WindowRect free = windows_->freeRect();
  moveTo(free.corner.x + free.size.x + 12, free.corner.y + 18);  // the arrow of its title
  press();
  EXPECT_TRUE(has("performance.copy") && has("accuracy.measure"));
  EXPECT_FALSE(has("log.copy")) << "it was opened before the others";
  restart();
  resize(900, 700);
  EXPECT_TRUE(has("performance.copy") && has("accuracy.measure") && has("log.copy")) << "folding is not remembered";
}

TEST_F(PanelTest, TimeRowScrubsAndSteps) {
  drag("time", 0.05, 150);
  ASSERT_TRUE(sent<Seek>());
  EXPECT_GT(std::get<Seek>(commands_.back()).seconds, 5.0);
  EXPECT_LE(std::get<Seek>(commands_.back()).seconds, 20.0);
  EXPECT_EQ(clickFor<StepTime>("time.on").steps, 1);
  EXPECT_EQ(clickFor<StepTime>("time.back").steps, -1);
  EXPECT_TRUE(clickFor<SetPaused>("pause", 0.1).paused);
  drag("time.speed", 0.5, 30);
  EXPECT_GT(std::get<SetTimeSpeed>(commands_.back()).factor, 1.0);
}

TEST_F(PanelTest, ButtonsSendTheirCommands) {
  scene_.bookmarks = {{.name = "door"}, {.name = "sky"}};
  camera_.bookmark = 1;
  clickFor<CopyCommandLine>("copy");
  EXPECT_FALSE(clickFor<TakeScreenshot>("screenshot").withPanel);
  clickFor<ResetCamera>("camera.reset");
  clickFor<AddBookmark>("bookmark.add");
  EXPECT_EQ(clickFor<RemoveBookmark>("bookmark.remove").index, 1u);
  click("bookmarks");
  EXPECT_EQ(clickFor<GoToBookmark>("bookmark.door").index, 0u);
  click("scene");
  EXPECT_EQ(clickFor<OpenScene>("scene.two").file, "/scenes/two.obj");
  browser_.loading = "two.obj";
  clickFor<CancelLoading>("loading.cancel");
}

TEST_F(PanelTest, MessageIsDismissedAndMovesNothing) {
  const PixelRect before = widget("time");
  message_ = "scene.toml: no such file";
  EXPECT_EQ(widget("time"), before);
  clickFor<DismissMessage>("message.dismiss");
  EXPECT_FALSE(has("message.dismiss")) << "even if its cause stays";
  const std::string problem = std::exchange(message_, "");
  has("time");
  message_ = problem;
  EXPECT_TRUE(has("message.dismiss")) << "it occurred again";
  click("message.dismiss");
  message_ = "another.toml: no such file";
  EXPECT_TRUE(has("message.dismiss"));
  message_ = problem;
  EXPECT_TRUE(has("message.dismiss")) << "another one was shown in between";
}

TEST_F(PanelTest, MessagesAreNoLargerThanTheirText) {
  windows_->toggleVisible();
  status_.text = "Nothing to undo";
  run(2);
  float right = 0.0f;
  float top = 700.0f;
  for (const ImDrawList* list : drawLists()) {
    for (const ImDrawVert& vertex : list->VtxBuffer) {
      right = std::max(right, vertex.pos.x);
      top = std::min(top, vertex.pos.y);
    }
  }
  EXPECT_LT(right, 200.0f);
  EXPECT_GT(right, 100.0f);
  EXPECT_GT(top, 660.0f);
}

TEST_F(PanelTest, StatusLinesAreAsHighAsText) {
  const auto height = [&](const char* text) {
    status_.picture = text;
    run(2);
    return ImGui::FindWindowByName("##status")->Size.y;
  };
  const float one = height("Picture 4 of 64");
  EXPECT_LT(one, 2.0f * ImGui::GetTextLineHeight());
  EXPECT_NEAR(height("Picture 4\nof 64"), one + ImGui::GetTextLineHeight(), 1.0f);
  const WindowRect free = windows_->freeRect();
  height("Picture 4 of 64");
  EXPECT_EQ(windows_->freeRect().size.y, free.size.y) << "panels do not move";
}

TEST_F(PanelTest, LongStatusLinesLieBelowThePanel) {
  for (int words = 0; words < 60; ++words) {
    status_.picture += "words ";
  }
  run(3);
  const ImGuiWindow* line = ImGui::FindWindowByName("##status");
  const ImGuiWindow* panel = ImGui::FindWindowByName("Speculum");
  ASSERT_TRUE(line && panel);
  EXPECT_GT(line->Size.y, 3.0f * ImGui::GetTextLineHeight());
  EXPECT_LE(panel->Pos.y + panel->Size.y, line->Pos.y);
}

TEST_F(PanelTest, StatusLinesFitSmallWindows) {
  status_.picture = "4 of 64 pictures averaged, next one 15 %; approximate: shadow outlines within a texel of the map";
  for (const auto& [width, height] :
       {std::pair(900.0f, 700.0f), std::pair(300.0f, 120.0f), std::pair(220.0f, 500.0f)}) {
    resize(width, height);  // the second folds the panel
    const ImGuiWindow* line = ImGui::FindWindowByName("##status");
    EXPECT_LE(line->Pos.x + line->Size.x, width);
  }
}

TEST_F(PanelTest, SamplesAreThoseOfTheDevice) {
  device_.samples = {1, 4};
  const auto choose = [&](int row) {
    click("view.samples");
    const PixelRect list = widget("view.samples");
    const float line = ImGui::GetTextLineHeightWithSpacing();
    moveTo(list.x + 20, list.y + list.height + (static_cast<float>(row) + 0.9f) * line);
    press();
    run(2);
  };
  choose(0);
  EXPECT_EQ(settings_.view.samples, 1);
  choose(1);
  EXPECT_EQ(settings_.view.samples, 4);
  choose(2);
  EXPECT_EQ(settings_.view.samples, 4) << "there are no more";
}

// The slider ends at 20 s at first.
TEST_F(PanelTest, LaterTimesCanBeTyped) {
  for (const double before : {0.0, 20.0, 45.0}) {
    playback_.time = before;
    holdControl(true);
    click("time", 0.2);
    holdControl(false);
    type("70");
    tap(ImGuiKey_Enter);
    ASSERT_TRUE(sent<Seek>());
    EXPECT_EQ(std::get<Seek>(commands_.back()).seconds, 70.0);
  }
}

TEST_F(PanelTest, EnterChoosesMenuEntries) {
  click("menu.File");
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_Enter);
  EXPECT_TRUE(sent<NewScene>() || sent<AskWhatToOpen>());
  EXPECT_FALSE(has("menu.New")) << "the menu closes";
}

TEST_F(PanelTest, EnterPressesWidgets) {
  drag("view.exposure", 0.2, 60);  // leaves the keyboard there
  tap(ImGuiKey_DownArrow);
  const ToneMap before = settings_.view.toneMap;
  tap(ImGuiKey_Enter);
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_Enter);
  EXPECT_NE(settings_.view.toneMap, before) << "the list opens, and the entry is chosen";
  click("view.wireframe");
  EXPECT_TRUE(settings_.view.wireframe);
  tap(ImGuiKey_UpArrow);
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_Enter);
  EXPECT_FALSE(settings_.view.wireframe);
}

TEST_F(PanelTest, EnterTypesIntoSliders) {
  drag("view.exposure", 0.2, 60);
  tap(ImGuiKey_UpArrow);
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_Enter);
  type("2.5");
  tap(ImGuiKey_Enter);
  EXPECT_EQ(settings_.view.exposure, 2.5);
}

TEST_F(PanelTest, AltGoesToTheMenus) {
  const auto tapAlt = [&](const auto& meanwhile) {
    holdAlt(true);
    run();
    meanwhile();
    holdAlt(false);
    run();
  };
  const auto clickPicture = [&] {
    moveTo(450, 600);
    press();
  };
  const auto opensMenu = [&] {
    tap(ImGuiKey_DownArrow);
    const bool open = has("menu.New");
    tap(ImGuiKey_Escape);
    tap(ImGuiKey_Escape);
    return open;
  };
  const auto nothing = [] {};
  tapAlt(nothing);
  EXPECT_TRUE(opensMenu()) << "of a panel";
  clickPicture();
  ASSERT_FALSE(ImGui::GetCurrentContext()->NavWindow);
  tapAlt(nothing);
  EXPECT_TRUE(opensMenu()) << "of the picture";
  for (const bool panel : {true, false}) {
    panel ? void(click("panel.Log")) : clickPicture();
    tapAlt([&] {
      holdControl(true);
      run();
      holdControl(false);
    });
    EXPECT_FALSE(opensMenu()) << "Alt alone";
    holdControl(true);
    run();
    tapAlt([&] { holdControl(false); });
    EXPECT_FALSE(opensMenu()) << "Control was held before";
    tapAlt([&] { setFocused(false); });
    setFocused(true);
    EXPECT_FALSE(opensMenu()) << "Alt+Tab leaves the window";
    tapAlt([&] { type("f"); });
    EXPECT_FALSE(opensMenu()) << "not a key with Alt";
    tapAlt(clickPicture);
    EXPECT_FALSE(opensMenu()) << "not a drag with Alt";
  }
  ask(Prompt::unsavedChanges);
  tapAlt(nothing);
  tap(ImGuiKey_DownArrow);
  EXPECT_FALSE(has("menu.New")) << "a prompt is open";
  EXPECT_TRUE(ImGui::GetTopMostPopupModal());
}

// Dear ImGui takes a button of the gamepad for Alt.
TEST_F(PanelTest, GamepadsDoNotGoToTheMenus) {
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableGamepad;
  io.BackendFlags |= ImGuiBackendFlags_HasGamepad;
  moveTo(450, 600);
  press();
  for (const bool down : {true, false}) {
#if IMGUI_VERSION_NUM < 18700
    io.NavInputs[ImGuiNavInput_Menu] = down ? 1.0f : 0.0f;
#else
    io.AddKeyEvent(ImGuiKey_GamepadFaceLeft, down);
#endif
    for (int i = 0; i < 3; ++i) {
      run();
      const ImGuiWindow* focused = ImGui::GetCurrentContext()->NavWindow;
      EXPECT_NE(focused ? std::string(focused->Name) : "", "##MainMenuBar") << down << ", frame " << i;
    }
  }
}

TEST_F(PanelTest, MenusSendTheirCommands) {
  browser_.recent = {"/scenes/two.obj"};
  edit_.undo = "change Exposure";
  click("menu.File");
  clickFor<AskWhatToOpen>("menu.Open...");
  click("menu.File");
  clickFor<NewScene>("menu.New");
  click("menu.File");
  click("menu.Open recent");
  EXPECT_EQ(clickFor<OpenScene>("menu./scenes/two.obj").file, "/scenes/two.obj");
  click("menu.Edit");
  clickFor<Undo>("menu.Undo change Exposure###Undo");
  edit_.models = {"/models/ball.obj"};
  click("menu.Edit");
  click("menu.Add object");
  EXPECT_EQ(clickFor<AddObject>("menu.ball").model, "/models/ball.obj");
  click("menu.View");
  EXPECT_EQ(clickFor<LookFromMirror>("menu.Look out of mirror").side, MirrorSide::front);
}

TEST_F(PanelTest, LongPathsLeaveTheFileMenuFree) {
  browser_.recent = {"/home/somebody/Documents/of several years/models/Speculum/first.toml",
                     "/home/somebody/Documents/of several years/models/Speculum/other.toml"};
  for (const float scale : {1.0f, 2.0f, 2.5f}) {
    ImGui::GetIO().FontGlobalScale = scale;
    resize(900, 700);
    click("menu.File");
    click("menu.Open recent");
    EXPECT_FALSE(sent<OpenScene>()) << scale;
    const ImGuiWindow* file = ImGui::FindWindowByName("##Menu_00");
    const ImGuiWindow* recent = ImGui::FindWindowByName("##Menu_01");
    ASSERT_TRUE(file && recent && recent->Active);
    EXPECT_GE(recent->Pos.x, file->Rect().Max.x - ImGui::GetStyle().ItemInnerSpacing.x - 1.0f) << scale;
    EXPECT_LE(recent->Rect().Max.x, 900.0f) << scale;
    moveTo(recent->Pos.x + 0.5 * recent->Size.x, recent->Pos.y + 0.75 * recent->Size.y);
    commands_.clear();
    press();
    EXPECT_EQ(only<OpenScene>().file, browser_.recent[1]) << scale;
  }
}

TEST_F(PanelTest, EscapeClosesTheSubmenuUnderWhoseEntryThePointerRests) {
  click("menu.Edit");
  hover("menu.Add object", 0.3);
  run(60);
  const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
  ASSERT_EQ(open.Size, 2);
  for (const int left : {1, 0}) {
    tap(ImGuiKey_Escape);
    run(60);
    EXPECT_EQ(open.Size, left);
  }
  click("menu.Edit");
  EXPECT_EQ(open.Size, 1) << "the pointer moved";
}

TEST_F(PanelTest, HelpShowsTheDemoOfTheWidgets) {
  click("menu.Help");
  click("help.widgets", 0.1);
  const ImGuiWindow* demo = ImGui::FindWindowByName("Dear ImGui Demo");
  ASSERT_TRUE(demo && demo->Active);
  click("menu.Help");
  click("help.widgets", 0.1);
  EXPECT_FALSE(demo->Active);
}

TEST_F(PanelTest, MenuSaysWhatIsFramed) {
  click("menu.View");
  EXPECT_TRUE(has("menu.Frame scene"));
  edit_.selected = {Selection::Kind::mirror, 0};
  EXPECT_TRUE(has("menu.Frame selection"));
}

TEST_F(PanelTest, FilesAreChosenFromOwnList) {
  std::filesystem::create_directory(config_.path() / "models");
  std::ofstream(config_.path() / "models" / "a.obj") << "v 0 0 0";
  std::ofstream(config_.path() / "notes.txt") << "no scene";
  ask(Prompt::open, config_.path());
  EXPECT_FALSE(has("open.notes.txt"));
  click("open.models");
  click("open.open");
  click("open.a.obj");
  EXPECT_FALSE(sent<OpenScene>()) << "one click only selects";
  click("open.open");
  EXPECT_TRUE(std::filesystem::equivalent(only<OpenScene>().file, config_.path() / "models" / "a.obj"));
}

TEST_F(PanelTest, DoubleClicksEnterFolders) {
  const std::filesystem::path folder = std::filesystem::canonical(config_.path());
  std::filesystem::create_directories(folder / "a" / "b");
  std::ofstream(folder / "a" / "x.toml") << "";
  for (const Prompt prompt : {Prompt::open, Prompt::saveAs}) {
    const std::string name = prompt == Prompt::open ? "" : "new.toml";
    ask(prompt, folder / name);
    click("open.a");
    EXPECT_FALSE(has("open.x.toml")) << "one click only selects";
    press();
    EXPECT_TRUE(has("open.x.toml"));
    EXPECT_EQ(windows_->state().files.typed, name) << "the second click chooses nothing in the new folder";
    click("open...");
    EXPECT_TRUE(has("open.x.toml")) << "one click only selects";
    press();
    EXPECT_TRUE(has("open.a")) << "up by one folder";
    EXPECT_EQ(windows_->state().files.typed, name);
    ask(Prompt::none);
  }
}

TEST_F(PanelTest, FilesMayHaveNamesThatAreNotUtf8) {
  const std::filesystem::path folder = std::filesystem::canonical(config_.path());
  std::ofstream(folder / "w\xff.toml") << "";
  ask(Prompt::saveAs, folder / "w\xff.toml");
  EXPECT_EQ(windows_->state().files.typed, "w\u00ff.toml");
  EXPECT_EQ(clickFor<SaveAs>("where.save").file, folder / "w\xff.toml");
  ask(Prompt::none);
  ask(Prompt::saveAs, folder / "w\xff.toml");
  type("a");
  EXPECT_EQ(windows_->state().files.typed, "a");
  ask(Prompt::none);
  ask(Prompt::open, folder);
  click("open.w\xff.toml");
  EXPECT_EQ(windows_->state().files.typed, "w\u00ff.toml");
  EXPECT_EQ(clickFor<OpenScene>("open.open").file, folder / "w\xff.toml");
}

TEST_F(PanelTest, PathsHaveABoundedLength) {
  std::string deep;
  for (int i = 0; i < 10'000; ++i) {
    deep += "a/";
  }
  for (const Prompt prompt : {Prompt::open, Prompt::saveAs}) {
    ask(prompt, config_.path() / "");
    type(deep);
    EXPECT_LT(windows_->state().files.typed.size(), 4096u);
    ask(Prompt::none);
  }
}

TEST_F(PanelTest, ListsShowEveryCharacterOfNames) {
  browser_.scenes[1].name = "wall##2";
  scene_.mirrors[0].name = "##hidden\nbelow";
  scene_.bookmarks = {{.name = "##view"}};
  click("scene");
  EXPECT_TRUE(shows("wall#\\x232"));
  click("scene.wall##2");
  windows_->toggleInspector();
  EXPECT_TRUE(shows("'#\\x23hidden\\x0abelow'"));
  camera_.bookmark = 0;
  EXPECT_TRUE(shows("#\\x23view"));
}

TEST_F(PanelTest, LongTextsHaveShortTips) {
  windows_->toggleInspector();
  edit_.undo = std::string(20'000, 'u');
  hover("edit.undo");
  run(60);
  EXPECT_TRUE(tooltip());
}

TEST_F(PanelTest, FoldedPanelsAreNotCovered) {
  const PixelRect first = widget("scene");
  const float top = windows_->freeRect().corner.y;
  const ImGuiWindow* panel = ImGui::FindWindowByName("Speculum");
  moveTo(first.x + 4, panel->Pos.y + 8);  // the arrow of its title
  press();
  run(3);
  EXPECT_FALSE(has("scene")) << "collapsed";
  EXPECT_GE(windows_->freeRect().corner.y, panel->Pos.y + panel->Size.y);
  EXPECT_GT(windows_->freeRect().corner.y, top);
}

TEST_F(PanelTest, EnterOnFoldersKeepsTheKeyboard) {
  const std::filesystem::path folder = std::filesystem::canonical(config_.path());
  std::filesystem::create_directories(folder / "outer" / "inner" / "empty");
  std::ofstream(folder / "outer" / "inner" / "scene.toml") << "";
  for (const Prompt prompt : {Prompt::open, Prompt::saveAs}) {
    ask(prompt, folder / (prompt == Prompt::saveAs ? "new.toml" : ""));
    commands_.clear();
    for (const char* name : {"outer", "inner"}) {  // in the field
      type(name);
      tap(ImGuiKey_Enter);
      EXPECT_EQ(windows_->state().files.folder.filename(), name);
      run(2);
      EXPECT_TRUE(ImGui::GetIO().WantTextInput) << "the next name is typed";
    }
    tap(ImGuiKey_DownArrow);
    tap(ImGuiKey_DownArrow);
    tap(ImGuiKey_Enter);  // in the list, on "empty" below ".."
    EXPECT_EQ(windows_->state().files.folder, folder / "outer" / "inner" / "empty");
    EXPECT_FALSE(ImGui::GetIO().WantTextInput);
    tap(ImGuiKey_Enter);  // on "..", the only entry
    EXPECT_TRUE(has("open.empty"));
    tap(ImGuiKey_DownArrow);
    EXPECT_TRUE(commands_.empty());
    tap(ImGuiKey_Enter);
    if (prompt == Prompt::open) {
      EXPECT_EQ(only<OpenScene>().file, folder / "outer" / "inner" / "scene.toml");
    } else {
      EXPECT_TRUE(commands_.empty()) << "a name is chosen, nothing is saved";
      EXPECT_EQ(windows_->state().files.typed, "scene.toml");
    }
    ask(Prompt::none);
  }
}

TEST_F(PanelTest, ListFollowsTheTypedFolder) {
  const UserFolders home{"HOME"};
  const std::filesystem::path folder = environment("HOME");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "ring.obj") << "v 0 0 0";
  ask(Prompt::open, config_.path());
  EXPECT_FALSE(has("open.ring.obj"));
  type("~/");
  EXPECT_TRUE(has("open.ring.obj"));
  type("none.obj");
  click("open.open");
  EXPECT_FALSE(sent<OpenScene>());
  EXPECT_EQ(windows_->state().files.problem, "There is no file " + (folder / "none.obj").string());
  click("open.ring.obj");
  EXPECT_EQ(windows_->state().files.problem, "");
  click("open.open");
  EXPECT_TRUE(std::filesystem::equivalent(only<OpenScene>().file, folder / "ring.obj"));
}

TEST_F(PanelTest, MistypedNamesAreTypedAgain) {
  std::ofstream(config_.path() / "room.toml") << "";
  ask(Prompt::open, config_.path() / "");
  type("roof");
  tap(ImGuiKey_Enter);
  EXPECT_NE(windows_->state().files.problem, "");
  EXPECT_TRUE(ImGui::GetIO().WantTextInput);
  type("room");
  EXPECT_EQ(windows_->state().files.typed, "room") << "what was there is replaced";
  commands_.clear();
  tap(ImGuiKey_Enter);
  EXPECT_EQ(only<OpenScene>().file.filename(), "room.toml") << "scenes are opened by their names";
}

TEST_F(PanelTest, RefusedFilesMoveNoPrompt) {
  const auto expectStays = [&](const char* title, const auto& refuse) {
    const ImGuiWindow& prompt = *ImGui::FindWindowByName(title);
    const ImVec2 corner = prompt.Pos, size = prompt.Size;
    refuse();
    for (int i = 0; i < 4; ++i) {
      run();
      EXPECT_TRUE(prompt.Active && !prompt.Hidden) << title << ", frame " << i;
      EXPECT_EQ(glm::vec4(prompt.Pos.x, prompt.Pos.y, prompt.Size.x, prompt.Size.y),
                glm::vec4(corner.x, corner.y, size.x, size.y))
          << title << ", frame " << i;
    }
    EXPECT_TRUE(ImGui::GetIO().WantTextInput) << title << ": another name is typed";
  };
  ask(Prompt::saveAs, config_.path() / "room.toml");
  for (const char* why : {"it comes with the program", "it has three lines\nof which each\nis shown"}) {
    const auto refuse = [&] { edit_.note = (config_.path() / "room.toml").string() + ": not saved: " + why; };
    click("where.save");
    expectStays("Save as", refuse);
    EXPECT_TRUE(shows("not saved"));
    click("where.save");
    expectStays("Save as", refuse);
    tap(ImGuiKey_Enter);
    expectStays("Save as", refuse);
  }
  ask(Prompt::none);
  ask(Prompt::open, config_.path() / "");
  type("roof.toml");
  hover("open.open");
  expectStays("Open", [&] { press(); });
  EXPECT_TRUE(shows("There is no file"));
}

TEST_F(PanelTest, AnsweredPromptsCloseAtOnce) {
  ask(Prompt::recovery, "/home/scene.toml");
  edit_.prompt = Prompt::saveAs;
  run();
  EXPECT_FALSE(ImGui::FindWindowByName("Unsaved changes of the last session")->Active);
  EXPECT_TRUE(ImGui::FindWindowByName("Save as")->Active);
  edit_.prompt = Prompt::none;
  run();
  EXPECT_FALSE(ImGui::FindWindowByName("Save as")->Active);
  EXPECT_FALSE(ImGui::GetTopMostPopupModal());
}

TEST_F(PanelTest, EnterPressesWidgetsOfPrompts) {
  edit_.ownFile = config_.path() / "own" / "scene.toml";
  ask(Prompt::saveAs, config_.path() / "new.toml");
  click("where.models", 0.05);
  ASSERT_FALSE(windows_->state().copyModels);
  tap(ImGuiKey_UpArrow);
  tap(ImGuiKey_DownArrow);
  commands_.clear();
  tap(ImGuiKey_Enter);
  EXPECT_TRUE(windows_->state().copyModels);
  EXPECT_TRUE(commands_.empty()) << "nothing is saved";
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_RightArrow);
  tap(ImGuiKey_Enter);
  EXPECT_TRUE(sent<CancelPrompt>() && !sent<SaveAs>());
}

TEST_F(PanelTest, ListScrollsToTypedNames) {
  for (int i = 0; i < 60; ++i) {
    std::ofstream(config_.path() / ("room " + std::to_string(i) + ".toml")) << "";
  }
  std::ofstream(config_.path() / "studio.toml") << "";
  for (const auto& [prompt, field] : {std::pair(Prompt::open, "open.typed"), std::pair(Prompt::saveAs, "edit.file")}) {
    ask(prompt, config_.path() / "");
    const int below = widget(field).y + 600;
    EXPECT_GT(widget("open.studio.toml").y, below);
    type("stu");
    EXPECT_LT(widget("open.studio.toml").y, below);
    ask(Prompt::none);
  }
}

TEST_F(PanelTest, SavingListsFoldersAndScenes) {
  std::filesystem::create_directory(config_.path() / "mine");
  std::ofstream(config_.path() / "mine" / "old.toml") << "";
  std::ofstream(config_.path() / "mine" / "ring.obj") << "";
  ask(Prompt::saveAs, config_.path() / "new.toml");
  click("open.mine");
  press();
  EXPECT_EQ(windows_->state().files.typed, "new.toml");
  EXPECT_FALSE(has("open.ring.obj"));
  click("open.old.toml");
  EXPECT_EQ(clickFor<SaveAs>("where.save").file, config_.path() / "mine" / "old.toml");
  ask(Prompt::none);
}

TEST_F(PanelTest, SavingElsewhereOffersToCopyModels) {
  edit_.ownFile = config_.path() / "own" / "scene.toml";
  ask(Prompt::saveAs, config_.path() / "new.toml");
  EXPECT_TRUE(clickFor<SaveAs>("where.save").copyModels) << "unless they are left where they are";
  ask(Prompt::saveAs, config_.path() / "new.toml");
  click("where.models", 0.05);
  EXPECT_FALSE(clickFor<SaveAs>("where.save").copyModels);
  ask(Prompt::none);
  ask(Prompt::saveAs, edit_.ownFile);
  EXPECT_FALSE(has("where.models")) << "in its own folder everything stays";
  EXPECT_FALSE(clickFor<SaveAs>("where.save").copyModels);
}

TEST_F(PanelTest, KeptChangesSayTheirAge) {
  using namespace std::chrono_literals;
  const std::filesystem::path copy = config_.path() / "scene.toml";
  std::ofstream(copy) << "#";
  for (const auto& [age, text] :
       {std::pair(5s, "kept just now in"), std::pair(65s, "kept 1 minute ago in"),
        std::pair(10'805s, "kept 3 hours ago in"), std::pair(176'400s, "kept 2 days ago in")}) {
    std::filesystem::last_write_time(copy, std::filesystem::file_time_type::clock::now() - age);
    ask(Prompt::recovery, copy);
    EXPECT_TRUE(shows(text)) << text;
    ask(Prompt::none);
  }
}

TEST_F(PanelTest, PromptsShowWhatEnterPresses) {
  edit_.saveFile = "/home/scene.toml";
  for (const Prompt prompt : {Prompt::unsavedChanges, Prompt::recovery}) {
    click("panel.Log");  // a click hides the focus
    EXPECT_FALSE(imgui::focusIsShown());
    ask(prompt, "/home/scene.toml");
    run(2);
    EXPECT_TRUE(imgui::focusIsShown());
    tap(ImGuiKey_Enter);
    EXPECT_TRUE(prompt == Prompt::recovery ? sent<OpenScene>() : sent<Save>());
    ask(Prompt::none);
  }
}

TEST_F(PanelTest, KeptChangesAreOpenedDiscardedOrLeft) {
  ask(Prompt::recovery, "/home/scene.toml");
  EXPECT_EQ(clickFor<OpenScene>("recovery.open").file, "/home/scene.toml");
  ask(Prompt::recovery, "/home/scene.toml");
  clickFor<DiscardChanges>("recovery.discard");
  ask(Prompt::recovery, "/home/scene.toml");
  clickFor<CancelPrompt>("recovery.later");
}

TEST_F(PanelTest, SavingShowsItsFolderOnce) {
  const std::filesystem::path folder = config_.path() / "none";
  std::filesystem::create_directory(config_.path() / "mine");
  ask(Prompt::saveAs, folder / "new.toml");
  EXPECT_EQ(windows_->state().files.typed, "new.toml");
  EXPECT_TRUE(shows(folder.string()));
  const std::string text = shownText();
  const size_t first = text.find(config_.path().string());
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(text.find(config_.path().string(), first + 1), std::string::npos) << "no other folder";
  EXPECT_FALSE(has("open.mine")) << "the folder of the file, which saving makes";
  click("open...");
  press();
  EXPECT_TRUE(has("open.mine"));
  EXPECT_EQ(clickFor<SaveAs>("where.save").file, config_.path() / "new.toml");
}

TEST_F(PanelTest, PromptsStayCentered) {
  ask(Prompt::recovery, "/home/scene.toml");
  const int left = widget("recovery.open").x;
  resize(1300, 900);
  EXPECT_NEAR(widget("recovery.open").x, left + 200, 1);
}

TEST_F(PanelTest, PromptsFitNarrowWindows) {
  resize(300, 500);
  for (const auto& [prompt, field] : {std::pair(Prompt::open, "open.typed"), std::pair(Prompt::saveAs, "edit.file")}) {
    ask(prompt, config_.path());
    EXPECT_GE(widget(field).x, 0);
    EXPECT_LT(widget(field).x + widget(field).width, 300);
    ask(Prompt::none);
  }
  edit_.saveFile = "/home/somebody/Documents/Speculum/a room with a mirror and a window.toml";
  for (const auto& [prompt, title] : {std::pair(Prompt::recovery, "Unsaved changes of the last session"),
                                      std::pair(Prompt::unsavedChanges, "Unsaved changes")}) {
    ask(prompt, "/home/somebody/.config/speculum/unsaved/1/gallery.toml");
    EXPECT_LE(ImGui::FindWindowByName(title)->ContentSize.x, 290.0f) << title;
    ask(Prompt::none);
  }
}

TEST_F(PanelTest, ModelsWithoutASceneCanBeSaved) {
  click("menu.File");
  click("menu.Save");
  EXPECT_FALSE(sent<Save>());
  edit_.isNew = true;
  clickFor<Save>("menu.Save");
}

TEST_F(PanelTest, GalleryOpensScenes) {
  toggle("Scenes");
  EXPECT_EQ(clickFor<OpenScene>("gallery.two").file, "/scenes/two.obj");
  click("gallery.one");
  EXPECT_FALSE(sent<OpenScene>()) << "it is shown";
}

TEST_F(PanelTest, OpeningShowsTheTitleAlsoWithoutAThumbnail) {
  const auto overlayText = [&] {
    run(2);
    std::string text;
    for (const DrawnGlyph& glyph : glyphsOf(*ImGui::GetBackgroundDrawList())) {
      text += glyph.letter;
    }
    return text;
  };
  EXPECT_EQ(overlayText(), "");
  browser_.poster = true;
  EXPECT_EQ(overlayText(), "One");
  browser_.shown = 1;
  EXPECT_EQ(overlayText(), "two.obj");
}

TEST_F(PanelTest, GalleryScrollsToTheShownScene) {
  browser_.scenes.resize(40, {"more", "", "/scenes/more.toml"});
  browser_.scenes.push_back({"saved", "", "/scenes/saved.toml"});
  toggle("Scenes");
  EXPECT_GT(widget("gallery.saved").y, 700);
  browser_.shown = 40;
  run(3);
  EXPECT_LT(widget("gallery.saved").y, 700);
  hover("gallery.saved");
  wheel(20.0);
  EXPECT_GT(widget("gallery.saved").y, 700) << "once";
}

TEST_F(PanelTest, OpenWindowsAreRemembered) {
  toggle("Scenes");
  const PixelRect before = widget("gallery.two");
  restart();
  EXPECT_EQ(widget("gallery.two"), before);
  toggle("Scenes");
  restart();
  EXPECT_FALSE(has("gallery.two"));
  for (const bool open : {true, false}) {
    windows_->toggleInspector();
    run(3);
    restart();
    EXPECT_EQ(has("edit.add_mirror"), open) << "as other windows";
  }
  click("section.view");
  restart();
  EXPECT_FALSE(has("view.exposure")) << "as sections of the main panel";
  EXPECT_TRUE(has("reflection.scale"));
}

TEST_F(PanelTest, LayoutIsKeptInTheUsersFolder) {
  const PixelRect before = widget("time");
  dragFrom(200, 42, 130, 80);
  const PixelRect moved = widget("time");
  EXPECT_EQ(moved.x - before.x, 130);
  EXPECT_EQ(moved.y - before.y, 80);
  toggle("Performance");
  const PixelRect pause = widget("performance.pause");
  moveTo(pause.x + 4, pause.y - 18);  // the arrow of its title
  press();
  EXPECT_FALSE(has("performance.pause")) << "collapsed";
  toggle("Log");
  stop();
  EXPECT_TRUE(std::filesystem::exists(iniFile_));
  start();
  EXPECT_EQ(widget("time"), moved);
  EXPECT_FALSE(has("performance.pause")) << "still";
  EXPECT_TRUE(has("log.copy")) << "the other is not";
}

// Sections of panels, of windows and tables of Dear ImGui, and of nobody, with numbers of every size.
std::string hostileLayout(std::mt19937& random) {
  const auto pick = [&](const std::vector<std::string>& from) { return from[random() % from.size()]; };
  const auto number = [&] {
    return pick({"-5",
                 "0",
                 "1e9",
                 "1000000000",
                 "2147483648",
                 "-2147483649",
                 "99999999999999999999",
                 "nan",
                 "-nan",
                 "inf",
                 "-inf",
                 "1e38",
                 "-1e38",
                 "1e-40",
                 "33000",
                 "-900",
                 "12",
                 "0x7fffffff",
                 "",
                 std::string(500, '9')});
  };
  std::string text;
  for (size_t sections = random() % 12; sections > 0; --sections) {
    text += pick({"[Table][0x" + number() + "," + number() + "]", "[Table][0x12345678," + number() + "]",
                  "[Window][Speculum]", "[Window][Log]", "[Panel][Log]", "[Panel][Speculum]", "[Panel][Inspector]",
                  "[Panel][]", "[Panel][", "[Panel]", "[][]", "", "[Panel][" + std::string(3000, 'n') + "]"}) +
            "\n";
    for (size_t lines = random() % 8; lines > 0; --lines) {
      text +=
          pick({"Pos", "Size", "Display", "Collapsed", "RefScale", "Column 0  Width", "Column " + number() + " Sort"}) +
          pick({"=", "=", "=", " "}) + number() + pick({",", ",", ",", " "}) + number() + "\n";
    }
  }
  return random() % 8 == 0 ? text + "Pos=" + std::string(1 << 20, '7') + "\n" + text : text;
}

TEST_F(PanelTest, HostileLayoutsLeavePanelsReachable) {
  windows_->toggleInspector();
  toggle("Log");
  std::mt19937 random(1);
  for (int i = 0; i < 60; ++i) {
    stop();
    const std::string layout = hostileLayout(random);
    std::ofstream(iniFile_) << layout;
    start();
    for (const char* name : {"Speculum", "Log", "Inspector"}) {
      const ImGuiWindow* window = ImGui::FindWindowByName(name);
      ASSERT_TRUE(window && window->Active);
      const ImRect title = window->TitleBarRect();
      EXPECT_TRUE(title.Min.x <= 890 && title.Max.x >= 10 && title.Min.y <= 690 && title.Min.y >= 18) << layout;
      EXPECT_TRUE(title.GetWidth() >= 12 && title.GetWidth() <= 900) << layout;
      EXPECT_TRUE(window->SizeFull.y >= 12 && window->SizeFull.y <= 700) << layout;
    }
  }
}

TEST_F(PanelTest, WindowsReturnFromATinyDisplay) {
  windows_->toggleInspector();
  toggle("Performance");
  toggle("Log");
  const PixelRect list = widget("edit.add_mirror");
  const PixelRect copy = widget("log.copy");
  const PixelRect csv = widget("performance.copy");
  EXPECT_LT(list.y + list.height, csv.y);
  EXPECT_LT(csv.y + csv.height, copy.y);
  EXPECT_LT(copy.y + copy.height, 700);
  resize(300, 200);
  resize(900, 700);
  EXPECT_EQ(widget("log.copy"), copy);
  dragFrom(copy.x - 100, copy.y - 16, -100, -100);  // its title
  const PixelRect moved = widget("log.copy");
  EXPECT_EQ(moved.x, copy.x - 100);
  resize(500, 300);
  EXPECT_LT(widget("log.copy").x, 500);
  EXPECT_LT(widget("log.copy").y, 300);
  resize(900, 700);
  EXPECT_EQ(widget("log.copy"), moved) << "what a tiny window forced is forgotten";
  resize(1050, 700);
  EXPECT_EQ(widget("performance.copy").x, csv.x + 150) << "docked windows follow the edge";
  resize(900, 700);
  click("menu.Window");
  click("window.reset");
  EXPECT_FALSE(has("log.copy") || has("edit.add_mirror")) << "all are closed";
  toggle("Log");
  EXPECT_GT(widget("log.copy").x, moved.x + 50);
}

TEST_F(PanelTest, ThemeAndSizeAreChosenAndRemembered) {
  click("menu.Window");
  click("theme.light", 0.1);
  EXPECT_EQ(windows_->state().choices.theme, Theme::light);
  click("menu.Window");
  drag("window.size", 0.2, 40);
  EXPECT_GT(windows_->state().choices.percent, 110);
  const int percent = windows_->state().choices.percent;
  run(2);
  restart();
  EXPECT_EQ(windows_->state().choices.theme, Theme::light);
  EXPECT_EQ(windows_->state().choices.percent, percent);
}

TEST_F(PanelTest, TallMenusLeaveTheMenuBarFree) {
  ImGui::GetIO().FontGlobalScale = 2.5f;
  resize(1280, 500);
  const float bar = ImGui::GetFrameHeight();
  click("menu.Window");
  run(3);
  const ImGuiWindow* menu = ImGui::FindWindowByName("##Menu_00");
  ASSERT_TRUE(menu && menu->Active);
  EXPECT_GE(menu->Pos.y, bar - 1.0f);
  EXPECT_GT(menu->ScrollMax.y, 0.0f) << "it would not fit otherwise";
}

TEST_F(PanelTest, PresentModesAreThoseOffered) {
  device_.presentModes = {"fifo", "immediate"};
  click("menu.Window");
  EXPECT_TRUE(shows("VSync (fifo)") && shows("No VSync (immediate)"));
  EXPECT_EQ(clickFor<SetPresentMode>("present.immediate", 0.1).index, 1u);
}

TEST_F(PanelTest, LogIsFilteredCopiedAndCleared) {
  log_.add(LogLevel::info, "the quick brown fox");
  log_.add(LogLevel::err, "a lazy dog");
  toggle("Log");
  EXPECT_EQ(clickFor<CopyText>("log.copy").text, "info: the quick brown fox\nerror: a lazy dog\n");
  click("log.filter");
  type("dog");
  EXPECT_EQ(clickFor<CopyText>("log.copy").text, "error: a lazy dog\n");
  clickFor<ClearLog>("log.clear");
}

TEST_F(PanelTest, HistoryIsPausedClearedAndCopied) {
  frame_.history.add(4, 1.0, 0.5);
  toggle("Performance");
  EXPECT_TRUE(has("graph.Frame"));
  EXPECT_TRUE(shows("1 frame") && !shows("1 frames"));
  EXPECT_EQ(clickFor<CopyText>("performance.copy").text, frame_.history.csv());
  EXPECT_TRUE(clickFor<PauseHistory>("performance.pause", 0.1).paused);
  clickFor<ClearHistory>("performance.clear");
}

class ManyPasses : public PanelTest {
 protected:
  ManyPasses() {
    std::vector<std::pair<std::string, double>> passes = {
        {"mirror b > c > a", 1.0}, {"mirror b > a", 1.0}, {"mirror a", 1.0}, {"mirror b", 1.0}, {"main view", 1.0}};
    for (int i = 0; i < 40; ++i) {
      passes.emplace_back("mirror m" + std::to_string(i), 1.0);
    }
    frame_.history.add(4, 1.0, 0.5);
    frame_.history.addGpu(4, 3.0, passes);
    toggle("Performance");
    resize(1280, 720);
  }
};

TEST_F(ManyPasses, HeadStaysInSight) {
  const PixelRect head = widget("performance.head 1");
  const PixelRect row = widget("name.CPU");
  moveTo(row.x + 4, row.y + 4);
  wheel(-1.0);
  EXPECT_LT(widget("name.CPU").y, row.y) << "scrolled";
  EXPECT_EQ(widget("performance.head 1").y, head.y);
}

TEST_F(ManyPasses, GraphsLeaveRoomForPasses) {
  const int high = widget("graph.GPU").height;
  ImGui::GetIO().FontGlobalScale = 2.0f;
  run(5);
  const ImGuiWindow* window = ImGui::FindWindowByName("Performance");
  ASSERT_TRUE(window);
  const PixelRect last = widget("name.main view");
  EXPECT_LT(static_cast<float>(last.y + last.height), window->Pos.y + window->Size.y) << "without scrolling";
  ImGui::GetIO().FontGlobalScale = 1.0f;
  frame_.history.clear();
  run(5);
  EXPECT_GT(widget("graph.GPU").height, high) << "they use the room that is left";
}

TEST_F(ManyPasses, OnlyTheTableScrolls) {
  toggle("Scenes");
  toggle("Targets");
  run(5);
  const ImGuiWindow* window = ImGui::FindWindowByName("Performance");
  ASSERT_TRUE(window);
  EXPECT_EQ(window->ScrollMax.y, 0.0f);
}

TEST_F(ManyPasses, MirrorsInMirrorsStandBelowThem) {
  const PixelRect direct = widget("name.mirror a");
  const PixelRect parent = widget("name.mirror b");
  const PixelRect nested = widget("name.mirror b > a");
  EXPECT_GT(nested.y, parent.y);
  EXPECT_GT(nested.x, parent.x);
  EXPECT_EQ(direct.x, parent.x);
  EXPECT_EQ(widget("name.mirror b > c > a").x, parent.x) << "its parent did not run: the whole path";
  EXPECT_TRUE(shows("b > c > a"));
}

TEST_F(ManyPasses, HeadFitsAtTwiceTheTextSize) {
  for (const float textSize : {1.0f, 2.0f}) {
    ImGui::GetIO().FontGlobalScale = textSize;
    run(5);
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    const ImGuiTable* times = nullptr;
    for (int i = 0; i < context.Tables.GetMapSize(); ++i) {
      const ImGuiTable* table = const_cast<ImGuiContext&>(context).Tables.TryGetMapData(i);
      times = table != nullptr && table->ColumnsCount == 4 && table->FreezeRowsRequest == 1 ? table : times;
    }
    ASSERT_TRUE(times);
    for (int column = 0; column < 4; ++column) {
      const PixelRect head = widget("performance.head " + std::to_string(column));
      EXPECT_GE(static_cast<float>(head.x), times->Columns[column].WorkMinX - 1.0f) << column << " at " << textSize;
      EXPECT_LE(static_cast<float>(head.x + head.width), times->Columns[column].WorkMaxX + 1.0f)
          << column << " at " << textSize;
    }
  }
}

TEST_F(PanelTest, PassesShowNamesOfTwoWordsInFull) {
  frame_.passes = {{{.kind = PassKind::main}, "main view"},
                   {{.path = {0}}, "mirror floor"},
                   {{.path = {0, 1}}, "mirror floor > wall mirror"}};
  resize(1280, 720);
  toggle("Passes");
  EXPECT_TRUE(shows("wall mirror"));
}

TEST_F(PanelTest, PerformanceRowsSelectTheirMirrors) {
  frame_.passes = {{{.path = {1}}, "mirror wall"}};
  frame_.history.add(4, 1.0, 0.5);
  frame_.history.addGpu(4, 3.0, std::vector<std::pair<std::string, double>>{{"mirror wall", 2.0}});
  toggle("Performance");
  const Selection wall{Selection::Kind::mirror, 1};
  EXPECT_EQ(clickFor<SelectNode>("name.mirror wall", 0.1).node, wall);
  EXPECT_EQ(output_.hoveredPath, MirrorPath{1});
}

TEST_F(PanelTest, TooltipsLeaveDraggedSlidersInSight) {
  hover("view.exposure", 0.3);
  EXPECT_TRUE(tooltip());
  hold(true);
  EXPECT_FALSE(tooltip());
  hold(false);
}

TEST_F(PanelTest, TooltipsLieOverNothingThatTheyExplain) {
  edit_.selected = {Selection::Kind::mirror, 0};
  windows_->toggleInspector();
  for (const auto& [width, height] : {std::pair(1280.0f, 720.0f), std::pair(900.0f, 700.0f)}) {
    resize(width, height);
    int shown = 0;
    for (const auto& [name, rect] : std::vector(windows_->state().widgets)) {
      const ImRect item(static_cast<float>(rect.x), static_cast<float>(rect.y), static_cast<float>(rect.x + rect.width),
                        static_cast<float>(rect.y + rect.height));
      if (name.starts_with("edit.node.")) {
        continue;  // has none, and may lie below the end of its list, under other widgets
      }
      moveTo(item.Min.x + 0.3 * item.GetWidth(), item.GetCenter().y);
      run(3);  // a tooltip has the size of the one before it at first
      const ImGuiWindow* window = ImGui::GetCurrentContext()->HoveredWindow;
      if (window && window->InnerClipRect.Contains(item) && tooltip()) {
        EXPECT_FALSE(tooltip()->Rect().Overlaps(item))
            << name << " at " << width << ": " << item.Min.y << " .. " << item.Max.y << ", the tooltip "
            << tooltip()->Rect().Min.y << " .. " << tooltip()->Rect().Max.y;
        ++shown;
      }
    }
    EXPECT_GT(shown, 12) << width;
  }
}

TEST_F(PanelTest, TooltipsDoNotTouchTheirPanel) {
  resize(1280, 720);
  hover("view.exposure", 0.3);
  ASSERT_TRUE(tooltip());
  EXPECT_GE(tooltip()->Rect().Min.x, ImGui::FindWindowByName("Speculum")->Rect().Max.x + 4.0f);
  toggle("Accuracy");
  hover("accuracy.measure");
  ASSERT_TRUE(tooltip());
  EXPECT_LE(tooltip()->Rect().Max.x, ImGui::FindWindowByName("Accuracy")->Rect().Min.x - 4.0f);
}

// Every slider of a setting in the main panel.
TEST_F(PanelTest, SlidersMoveWithEachPressOfAnArrow) {
  settings_.effects.roughSamples = settings_.view.accumulate = settings_.quality.stillPictures = 1;
  resize(900, 2400);
  click("section.effects");
  int sliders = 0;
  std::mt19937 random(9);
  std::discrete_distribution<int> low{1.0, 1.0};
  const auto shares = [&](std::mt19937& from) { return low(from) == 0 ? 0.02 : 0.25; };
  for (const SettingField& field : settingFields()) {
    if (!field.slider || !has(std::string(field.key))) {
      continue;
    }
    ++sliders;
    click(std::string(field.key), shares(random));
    tap(ImGuiKey_DownArrow);
    tap(ImGuiKey_UpArrow);
    tap(ImGuiKey_Space);
    ASSERT_TRUE(ImGui::IsAnyItemActive()) << field.key;
    const auto value = [&] { return std::stod(settingValue(settings_, field.key)); };
    for (int press = 0; press < 4; ++press) {
      const double before = value();
      tap(ImGuiKey_RightArrow);
      EXPECT_GT(value(), before) << field.key;
    }
    const double before = value();
    tap(ImGuiKey_LeftArrow);
    EXPECT_LT(value(), before) << field.key;
    tap(ImGuiKey_Space);
  }
  EXPECT_GT(sliders, 8);
}

TEST_F(PanelTest, ArrowsAloneChangeNothing) {
  std::mt19937 random(3);
  resize(900, 2400);
  windows_->toggleInspector();
  commands_.clear();
  for (int press = 0; press < 80; ++press) {
    constexpr std::array keys{ImGuiKey_DownArrow, ImGuiKey_UpArrow, ImGuiKey_LeftArrow, ImGuiKey_RightArrow,
                              ImGuiKey_DownArrow};
    tap(keys[random() % keys.size()]);
  }
  EXPECT_TRUE(commands_.empty());
}

TEST_F(PanelTest, TooltipsAreThePointersOnly) {
  click("view.exposure");
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_UpArrow);
  run(60);
  ASSERT_TRUE(ImGui::GetIO().NavVisible);
  EXPECT_FALSE(tooltip()) << "it would cover the next rows";
}

TEST_F(PanelTest, TooltipsStayClosedWhereAMenuWas) {
  click("menu.View");
  hover("menu.Reset camera", 0.2);
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  const auto covers = [&](const PixelRect& rect) {
    return rect.contains(static_cast<int>(pointer.x), static_cast<int>(pointer.y));
  };
  moveTo(pointer.x, pointer.y);
  press();
  EXPECT_TRUE(sent<ResetCamera>());
  run(30);
  EXPECT_FALSE(tooltip());
  bool below = false;  // a widget with a tooltip is there
  for (const auto& [name, rect] : windows_->state().widgets) {
    below = below || covers(rect);
  }
  EXPECT_TRUE(below);
}

TEST_F(PanelTest, TooltipsSayWhatWasMeasuredHere) {
  resize(900, 800);
  hover("reflection.scale", 0.3);
  EXPECT_FALSE(has("Here mirror images take")) << "not timed";
  frame_.passes = {{{.path = {0}}, "mirror wall"}, {{.kind = PassKind::main}, "main view"}};
  frame_.passes[0].gpuMs = 12.0;
  frame_.passes[1].gpuMs = 30.0;
  frame_.passes[0].timed = frame_.passes[1].timed = true;
  frame_.timedGpuMs = 50.0;
  accuracy_.prices["reflection.scale"] = "\nMeasured in this view:\n1.0: 7 ms";
  EXPECT_TRUE(shows("Here mirror images take 12.0 ms of a frame's 50.0 ms on the GPU."));
  EXPECT_TRUE(shows("1.0: 7 ms"));
  accuracy_.otherView = true;
  EXPECT_FALSE(has("1.0: 7 ms"));
  hover("view.samples", 0.3);
  EXPECT_TRUE(shows("Here the main view takes 30.0 ms of a frame's 50.0 ms on the GPU."));
}

TEST_F(PanelTest, HeaderShowsTheLastPictureWhilePaused) {
  frame_.frameMs = 14000.0;
  frame_.still = true;
  EXPECT_TRUE(shows("Frame 14.00 s still")) << "nothing moves";
  playback_.paused = true;
  EXPECT_TRUE(shows("Frame 14.00 s paused"));
  frame_.frameMs = 20.0;
  frame_.still = false;
  EXPECT_TRUE(shows("20.0 ms 50 FPS"));
  resize(260, 400);
  EXPECT_FALSE(has("50 FPS")) << "it would lie over the menus";
  EXPECT_TRUE(shows("FileEditViewWindowHelp"));
}

TEST_F(PanelTest, MenusShowTheirShortcuts) {
  click("menu.File");
  for (const char* entry : {"New Ctrl+N", "Open... Ctrl+O", "Save Ctrl+S", "Save as... Ctrl+Shift+S", "Quit Ctrl+Q"}) {
    EXPECT_TRUE(shows(entry)) << entry;
  }
  for (const auto& [name, entry] :
       {std::pair("menu.Edit", "Undo Ctrl+Z"), std::pair("menu.Edit", "Redo Ctrl+Shift+Z"),
        std::pair("menu.Edit", "Duplicate Ctrl+D"), std::pair("menu.Edit", "Delete Del"),
        std::pair("menu.View", "Frame scene F"), std::pair("menu.View", "Look out of mirror Shift+B"),
        std::pair("menu.View", "Pause Space"), std::pair("menu.Window", "Inspector F2"),
        std::pair("menu.Help", "Keys F1")}) {
    moveTo(widget(name).x + 2, widget(name).y + 2);
    run(2);
    EXPECT_TRUE(shows(entry)) << entry;
  }
}

TEST_F(PanelTest, LongNamesAreCutAtTheirEnds) {
  frame_.passes = {{{.kind = PassKind::main}, "main view"},
                   {{.path = {0}}, "mirror wall"},
                   {{.path = {0, 1}}, "mirror wall > door of the long corridor behind the kitchen"}};
  frame_.passes[1].gpuMs = 1570.0;
  resize(900, 1800);
  toggle("Passes");
  EXPECT_TRUE(shows("door"));
  EXPECT_FALSE(has("behind the kitchen"));
  EXPECT_TRUE(shows("1570")) << "numbers are never cut";
}

TEST_F(PanelTest, ButtonsSayWhatOtherProgramsSay) {
  frame_.effects.resize(2);
  frame_.effects[0].calledFor = true;
  resize(900, 1800);
  for (const char* label : {"Reset settings", "Copy command line", "Effects (1 in use)", "Mirror resolution",
                            "Reuse unchanged images", "Clear color"}) {
    EXPECT_TRUE(shows(label)) << label;
  }
  edit_.selected = {Selection::Kind::mirror, 0};
  windows_->toggleInspector();
  toggle("Accuracy");
  for (const char* label : {"GPU budget", "Move", "Rotate", "Scale"}) {
    EXPECT_TRUE(shows(label)) << label;
  }
}

TEST_F(PanelTest, EscapeClosesTheKeysOnly) {
  windows_->toggleInspector();
  run(3);
  windows_->toggleHelp();
  run(3);
  EXPECT_TRUE(windows_->closeHelp());
  EXPECT_FALSE(windows_->state().help);
  EXPECT_FALSE(windows_->closeHelp());
  EXPECT_TRUE(windows_->state().choices.inspector);
  windows_->toggleVisible();
  windows_->toggleInspector();
  windows_->toggleInspector();
  EXPECT_TRUE(windows_->visible());
}

TEST_F(PanelTest, KeysFitOnePage) {
  windows_->toggleHelp();
  resize(1109, 644);  // 1280x720 pixels, as far as this smaller font and its spacing allow
  const ImGuiWindow* keys = ImGui::FindWindowByName(panels::helpTitle);
  ASSERT_TRUE(keys);
  EXPECT_EQ(keys->ScrollMax.y, 0.0f);
  EXPECT_TRUE(shows("Walk through the panel's widgets"));
}

TEST_F(PanelTest, KeysFitNarrowWindows) {
  windows_->toggleHelp();
  EXPECT_EQ(widget("help.left").y, widget("help.right").y);
  resize(400, 700);
  EXPECT_EQ(widget("help.left").x, widget("help.right").x);
  EXPECT_GT(widget("help.right").y, widget("help.left").y);
  EXPECT_LT(widget("help.right").x + widget("help.right").width, 400);
}

TEST_F(PanelTest, LabelsOfDragsStayBesidePanels) {
  windows_->toggleInspector();
  resize(1280, 700);
  const WindowRect picture = windows_->freeRect();
  const glm::vec2 end = picture.corner + picture.size;
  edit_.overlay.label = "X 1.000 m";
  edit_.overlay.labelAt = end - 5.0f;
  run();
  const ImVector<ImDrawVert>& vertices = ImGui::GetBackgroundDrawList()->VtxBuffer;
  EXPECT_GT(vertices.Size, 0);
  for (const ImDrawVert& vertex : vertices) {
    EXPECT_LE(vertex.pos.x, end.x + 1.0f);
    EXPECT_LE(vertex.pos.y, end.y + 1.0f);
  }
}

TEST_F(PanelTest, HandlesAreNotDrawnOverATarget) {
  edit_.overlay.outline = {{{0.0, 350.0}, {900.0, 350.0}}, {{450.0, 0.0}, {450.0, 700.0}}};
  toggle("Targets");
  ASSERT_TRUE(windows_->state().targets.canvas);
  const WindowRect canvas = *windows_->state().targets.canvas;
  const ImDrawList& list = *ImGui::GetBackgroundDrawList();
  int lines = 0;
  for (const ImDrawCmd& part : list.CmdBuffer) {
    const bool beside = part.ClipRect.z <= canvas.corner.x || part.ClipRect.x >= canvas.corner.x + canvas.size.x ||
                        part.ClipRect.w <= canvas.corner.y || part.ClipRect.y >= canvas.corner.y + canvas.size.y;
    lines += part.ElemCount > 0;
    EXPECT_TRUE(beside || part.ElemCount == 0);
  }
  EXPECT_GT(lines, 0);
  EXPECT_TRUE(ImGui::GetForegroundDrawList()->VtxBuffer.empty()) << "nothing of it lies over other windows";
}

class Inspector : public PanelTest {
 protected:
  Inspector() {
    edit_.models = {"/models/ball.obj", "/models/vase.obj"};
    stop();
    std::ofstream(iniFile_) << "[Panel][Inspector]\nSize=325,1700\n";  // has room for all fields
    start();
    resize(900, 1000);
    windows_->toggleInspector();
    run(3);
  }
  void select(const Selection& node) {
    edit_.selected = node;
    run(3);
  }
  void selectMirror(int index) { select({Selection::Kind::mirror, index}); }
  // Types a number of a row after a click at a part of its width.
  void typeNumber(const std::string& row, double part, const std::string& number) {
    appliesEdits_ = true;
    click(row, part);
    holdControl(true);
    tap(ImGuiKey_A);
    holdControl(false);
    type(number);
    tap(ImGuiKey_Enter);
    run(2);
    appliesEdits_ = false;
  }
};

TEST_F(Inspector, ListIsLowInLowWindows) {
  const int high = widget("edit.add_mirror").y;
  resize(900, 350);
  EXPECT_LT(widget("edit.add_mirror").y, high) << "fields of the selected node come into sight";
}

TEST_F(Inspector, ListSelectsAndToggles) {
  EXPECT_EQ(clickFor<SelectNode>("edit.node.1").node, (Selection{Selection::Kind::mirror, 1}));
  holdShift(true);
  EXPECT_EQ(clickFor<ToggleNode>("edit.node.0").node, (Selection{Selection::Kind::mirror, 0}));
  holdShift(false);
  holdControl(true);
  clickFor<ToggleNode>("edit.node.0");
}

// Says whether the keyboard's focus is in the list of nodes.
bool focusInList() {
  return contains(ImGui::GetCurrentContext()->NavWindow->Name, "nodes");
}

TEST_F(Inspector, ArrowsLeaveTheList) {
  EXPECT_TRUE(focusInList()) << "F2 opened it";
  for (int i = 0; i < 100 && focusInList(); ++i) {
    tap(ImGuiKey_DownArrow);
  }
  commands_.clear();
  tap(ImGuiKey_Space);
  EXPECT_TRUE(sent<AddMirror>()) << "the button below the list";
}

TEST_F(Inspector, ArrowsGoOnAfterTheFocusedFieldIsGone) {
  selectMirror(0);
  click("edit.two_sided");
  select({});
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_Space);
  EXPECT_TRUE(ImGui::GetCurrentContext()->NavIdIsAlive) << "a widget that is drawn";
  EXPECT_TRUE(imgui::focusIsShown());
}

TEST_F(Inspector, EnterOnARowGoesToItsFields) {
  tap(ImGuiKey_DownArrow);
  selectMirror(1);  // by N
  commands_.clear();
  tap(ImGuiKey_Enter);
  EXPECT_EQ(only<SelectNode>().node, (Selection{Selection::Kind::mirror, 1})) << "the focus follows the selection";
  run(2);
  appliesEdits_ = true;
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_DownArrow);
  tap(ImGuiKey_Enter);
  type("1.75");
  tap(ImGuiKey_Enter);
  EXPECT_EQ(scene_.mirrors[1].position.x, 1.75) << "below the kind of handles and the name";
}

TEST_F(Inspector, ClicksOnRowsLeaveTheKeyboardAlone) {
  click("edit.node.1");
  selectMirror(1);
  run(2);
  EXPECT_FALSE(ImGui::GetIO().NavVisible) << "Space would press the row instead of pausing";
}

TEST_F(Inspector, ClickedRowsStayUnderThePointer) {
  scene_.objects.resize(40);
  for (const char* row : {"edit.node.1", "edit.node.4", "edit.node.2"}) {
    const int top = widget(row).y;
    edit_.selected = clickFor<SelectNode>(row).node;
    run(2);
    EXPECT_EQ(widget(row).y, top) << row;
  }
}

TEST_F(Inspector, ListShowsWhatIsSelectedAgain) {
  scene_.objects.resize(40);
  selectMirror(0);
  const int top = widget("edit.node.0").y;
  hover("edit.node.3");
  wheel(-20.0);
  EXPECT_LT(widget("edit.node.0").y, top);
  select({});
  selectMirror(0);
  EXPECT_NEAR(widget("edit.node.0").y, top, 2) << "the whole row is in sight, without the list's padding above";
}

TEST_F(Inspector, ClickAfterItOpenedIsThePictures) {
  const PixelRect node = widget("edit.node.1");
  windows_->toggleInspector();
  moveTo(node.x + 20, node.y + 5);
  windows_->openInspector();
  run(3);
  commands_.clear();
  press();
  EXPECT_FALSE(sent<SelectNode>());
  moveTo(node.x + 40, node.y + 5);
  press();
  EXPECT_TRUE(sent<SelectNode>()) << "the pointer has moved";
}

TEST_F(Inspector, PlacesThatItWouldCoverAreKnown) {
  const PixelRect node = widget("edit.node.1");
  const glm::vec2 over(node.x + 20, node.y + 5);
  EXPECT_FALSE(windows_->inspectorCovers(over)) << "it is open";
  windows_->toggleInspector();
  run(2);
  EXPECT_TRUE(windows_->inspectorCovers(over));
  EXPECT_FALSE(windows_->inspectorCovers({node.x - 40, node.y}));
}

TEST_F(Inspector, NodesAreAddedOfTheChosenModel) {
  clickFor<AddMirror>("edit.add_mirror");
  clickFor<AddLight>("edit.add_light");
  EXPECT_EQ(clickFor<AddObject>("edit.add_object").model, "/models/ball.obj");
  click("edit.model");
  click("edit.model.vase");
  EXPECT_EQ(clickFor<AddObject>("edit.add_object").model, "/models/vase.obj");
  click("edit.model");
  EXPECT_LT(widget("edit.model.file").y, widget("edit.model.ball").y) << "in sight above a long list";
  clickFor<AskWhatToAdd>("edit.model.file");
}

TEST_F(PanelTest, ObjectsAreAddedFromFiles) {
  const std::filesystem::path folder = std::filesystem::canonical(config_.path());
  std::ofstream(folder / "own.obj") << "";
  std::ofstream(folder / "room.toml") << "";
  click("menu.Edit");
  click("menu.Add object");
  clickFor<AskWhatToAdd>("menu.File...");
  ask(Prompt::addObject, folder);
  EXPECT_FALSE(has("open.room.toml"));
  click("open.own.obj");
  EXPECT_EQ(clickFor<AddObject>("open.open").model, folder / "own.obj");
}

TEST_F(Inspector, ModelsThatLieOnTheirBacksAreStoodUp) {
  scene_.meshes = {Mesh{.center = {0, 0, 2}, .halfExtent = {1, 0.5, 2}, .radius = 3}};
  scene_.objects = {Object{.name = "chair", .mesh = 0, .position = {3, 0.5, 0}}};
  scene_.file = "chair.obj";
  edit_.selected = {Selection::Kind::object, 0};
  run(4);
  for (const char* name : {"scene.stand_up", "edit.stand_up"}) {
    const auto object = std::get<Object>(clickFor<EditNode>(name).node);
    EXPECT_EQ(object.up, UpAxis::z);
    EXPECT_EQ(object.position, glm::dvec3(3, 0, 2)) << "it stands where it lay";
  }
  scene_.objects[0].up = UpAxis::z;
  EXPECT_FALSE(has("edit.stand_up"));
  scene_.objects[0].up = UpAxis::y;
  scene_.meshes[0].center = {0, 0.5, 2};
  EXPECT_FALSE(has("edit.stand_up")) << "it stands on y = 0";
}

TEST_F(Inspector, HistoryButtonsNeedSomethingToDo) {
  for (const char* name : {"edit.delete", "edit.undo", "edit.save"}) {
    EXPECT_TRUE(click(name).empty()) << name;
  }
  edit_.undo = "move mirror 'left'";
  edit_.unsaved = true;
  selectMirror(0);
  clickFor<RemoveSelected>("edit.delete");
  clickFor<DuplicateSelected>("edit.duplicate");
  clickFor<Undo>("edit.undo");
  clickFor<Save>("edit.save");
  clickFor<AskWhereToSave>("edit.save_as");
}

TEST_F(Inspector, DraggedNumbersAreOneContinuedEdit) {
  selectMirror(0);
  drag("edit.position", 0.1, 40);
  ASSERT_TRUE(sent<EditNode>());
  const auto& first = std::get<EditNode>(commands_.front());
  EXPECT_TRUE(first.continued);
  EXPECT_GT(std::get<Mirror>(first.node).position.x, scene_.mirrors[0].position.x);
  EXPECT_TRUE(sent<EndEdit>());
  EXPECT_NE(std::get<Mirror>(clickFor<EditNode>("edit.two_sided", 0.1).node).twoSided, scene_.mirrors[0].twoSided);
}

TEST_F(Inspector, CameraHasNumbers) {
  scene_.camera = {.position = {0, 0, 1}, .target = {0, 0, 0}};
  run(2);
  click("edit.camera");
  for (const char* row : {"position", "target", "up", "vertical_fov", "near", "orbit_speed"}) {
    EXPECT_TRUE(has(std::string("edit.camera.") + row)) << row;
  }
  drag("edit.camera.target", 0.1, 40);
  ASSERT_TRUE(sent<EditCamera>());
  const auto& first = std::get<EditCamera>(commands_.front());
  EXPECT_TRUE(first.continued);
  EXPECT_GT(first.camera.target.x, 0.0);
  EXPECT_TRUE(sent<EndEdit>());
  clickFor<TakeView>("edit.camera.take");
  commands_.clear();
  typeNumber("edit.camera.up", 0.38, "0");
  EXPECT_FALSE(sent<EditCamera>());
  EXPECT_TRUE(shows("Not applied: up: has no direction"));
  click("edit.camera.reset");
  EXPECT_FALSE(shows("Not applied"));
}

TEST_F(Inspector, ClickedNumbersAreTyped) {
  selectMirror(0);
  const glm::dvec3 before = scene_.mirrors[0].position;
  typeNumber("edit.position", 0.33, "1.75");
  EXPECT_EQ(scene_.mirrors[0].position, glm::dvec3(before.x, 1.75, before.z)) << "what was there is replaced";
}

TEST_F(Inspector, CopiesAreNamedInWords) {
  scene_.objects.resize(1);
  scene_.objects[0].copies.count = 2;
  resize(900, 1400);
  select({Selection::Kind::object, 0});
  EXPECT_TRUE(shows("Number of copies") && shows("Step between copies (m)"));
}

TEST_F(Inspector, SphereIsSuggested) {
  edit_.models = {"/models/frame.obj", "/models/sphere.obj"};
  const Scene other = scene_;
  edit_.scene = &other;
  EXPECT_EQ(clickFor<AddObject>("edit.add_object").model, "/models/sphere.obj");
}

TEST_F(Inspector, ColorsHaveASwatch) {
  selectMirror(0);
  const PixelRect row = widget("edit.reflectance");
  bool found = false;
  for (int x = row.x; x < row.x + row.width && !found; x += 4) {
    moveTo(x, row.y + row.height / 2);
    found = shows("Opens a picker.");
  }
  EXPECT_TRUE(found);
  press();
  EXPECT_TRUE(shows("sRGB"));
  EXPECT_FALSE(shows("before exposure")) << "it is a share of the light";
}

// Says how often the panels show the text.
int timesShown(const std::string& shown, const std::string& text) {
  int times = 0;
  for (size_t at = shown.find(text); at != std::string::npos; at = shown.find(text, at + 1)) {
    ++times;
  }
  return times;
}

TEST_F(Inspector, ColorsSayThatTheyAreLinear) {
  scene_.objects.at(0).color = scene_.objects[0].specular = glm::dvec3(0.5);
  scene_.objects[0].mirror = ObjectMirror();
  const auto inSight = [&](const char* window, const std::string& name) {
    if (!has(name)) {
      return false;
    }
    const PixelRect rect = widget(name);
    const ImRect clip = ImGui::FindWindowByName(window)->InnerClipRect;
    return clip.Contains(ImVec2(float(rect.x), float(rect.y))) &&
           clip.Contains(ImVec2(float(rect.x), float(rect.y + rect.height)));
  };
  const auto colorsOf = [&]<typename Node>(const Node&, const std::string& prefix) {
    int count = 0;
    forEachField<Node>([&](const auto& field) {
      // The switch of a value that can be off has the field's name.
      constexpr bool switched = IsOptional<typename std::decay_t<decltype(field)>::Value>::value;
      count += field.color && inSight("Inspector", prefix + std::string(field.key) + (switched ? ".value" : ""));
    });
    return count;
  };
  resize(1280, 1800);
  for (const Selection& node : {Selection{Selection::Kind::mirror, 0}, Selection{Selection::Kind::object, 0},
                                Selection{Selection::Kind::light, 0}}) {
    select(node);
    const int colors = inSight("Speculum", "view.clear_color") +
                       colorsOf(Mirror(), "edit.") * (node.kind == Selection::Kind::mirror) +
                       colorsOf(PointLight(), "edit.") * (node.kind == Selection::Kind::light) +
                       (colorsOf(Object(), "edit.") + colorsOf(ObjectMirror(), "edit.mirror.")) *
                           (node.kind == Selection::Kind::object);
    EXPECT_GE(colors, 2);
    EXPECT_EQ(timesShown(shownText(), "linear)"), colors) << static_cast<int>(node.kind);
  }
}

TEST_F(Inspector, ReflectanceIsTypedAsInTheFile) {
  scene_.mirrors[0].reflectance = glm::dvec3(0.731, 0.5, 0.5);
  selectMirror(0);
  EXPECT_TRUE(shows("Reflectance (tint, linear)") && shows("Diffuse color")) << "which of both is the tint";
  EXPECT_TRUE(shows("0.731"));
  typeNumber("edit.reflectance", 0.05, "0.404");
  EXPECT_DOUBLE_EQ(scene_.mirrors[0].reflectance.r, 0.404);
}

TEST_F(Inspector, MirrorsSayWhatIsCurved) {
  selectMirror(0);
  EXPECT_TRUE(shows("For a curved one add an object"));
}

TEST_F(Inspector, CurvedMirrorsExplainTheirTint) {
  ASSERT_FALSE(scene_.objects.empty());
  scene_.objects[0].mirror = ObjectMirror();
  select({Selection::Kind::object, 0});
  hover("edit.mirror.reflectance", 0.2);
  EXPECT_TRUE(shows("Reflectance (tint, linear)") && shows("Share of light reflected"));
}

TEST_F(Inspector, MirrorsHaveAQualityOfTheirOwn) {
  selectMirror(0);
  EXPECT_FALSE(has("edit.quality.scale"));
  click("edit.quality", 0.1);
  run(3);
  const auto quality = [&](const EditNode& edit) { return std::get<Mirror>(edit.node).quality; };
  settings_.reflection.samples = 4;
  settings_.reflection.scale = 0.75;
  for (const char* key : {"scale", "samples", "update_interval", "method"}) {
    const std::string row = std::string("edit.quality.") + key;
    EXPECT_TRUE(has(row) && has(row + ".value")) << key;
    const EditNode edit = clickFor<EditNode>(row);
    EXPECT_EQ(edit.target, (Selection{Selection::Kind::mirror, 0}));
    EXPECT_NE(quality(edit), MirrorQuality()) << key;
  }
  EXPECT_EQ(quality(clickFor<EditNode>("edit.quality.scale")), MirrorQuality{.scale = 0.75}) << "that of the settings";
  EXPECT_EQ(quality(clickFor<EditNode>("edit.quality.samples")), MirrorQuality{.samples = 4});
  scene_.mirrors[0].quality = {.scale = 1.0, .samples = 2};
  run(3);
  EXPECT_EQ(quality(clickFor<EditNode>("edit.quality.samples")), MirrorQuality{.scale = 1.0}) << "as the settings";
  appliesEdits_ = true;
  const PixelRect slider = widget("edit.quality.scale.value");
  dragFrom(slider.x + 0.3 * slider.width, slider.y + 0.5 * slider.height, -0.2 * slider.width);
  EXPECT_LT(scene_.mirrors[0].quality.scale, 1.0);
  EXPECT_EQ(scene_.mirrors[0].quality.samples, 2);
  EXPECT_EQ(settings_.reflection.scale, 0.75) << "the settings stay";
}

TEST_F(Inspector, DraggedQualityBecomesItsOwn) {
  appliesEdits_ = true;
  selectMirror(0);
  click("edit.quality", 0.1);
  run(3);
  const PixelRect slider = widget("edit.quality.scale.value");
  dragFrom(slider.x + 0.3 * slider.width, slider.y + 0.5 * slider.height, -0.2 * slider.width);
  EXPECT_LT(scene_.mirrors[0].quality.scale.value_or(1.0), 1.0);
  EXPECT_EQ(settings_.reflection.scale, sceneSettings_.reflection.scale) << "the settings stay";
  click("edit.quality.scale", 0.5);
  EXPECT_FALSE(scene_.mirrors[0].quality.scale);
}

TEST_F(Inspector, MirrorsShowTheirError) {
  selectMirror(1);
  EXPECT_FALSE(output_.errorGain);
  click("edit.mirror_error", 0.1);
  run(2);
  EXPECT_TRUE(output_.errorGain);
  accuracy_.difference = "Tracing the reference: 40 %";
  run(2);
  EXPECT_TRUE(shows("Tracing the reference: 40 %"));
  accuracy_.mirrorErrors = {std::nan(""), 0.0123};
  run(2);
  EXPECT_TRUE(shows("0.0123 mean FLIP"));
  selectMirror(0);
  EXPECT_TRUE(shows("not in view"));
}

TEST_F(Inspector, MirrorsAreLookedFromAndSeenThrough) {
  edit_.through = {1, 0};
  selectMirror(0);
  EXPECT_EQ(clickFor<LookFromMirror>("edit.look_behind").side, MirrorSide::back);
  EXPECT_EQ(clickFor<LookFromMirror>("edit.look_out").side, MirrorSide::front);
  EXPECT_TRUE(has("edit.mirror_cost"));
  EXPECT_EQ(clickFor<SelectNode>("edit.through.0").node, (Selection{Selection::Kind::mirror, 1}));
  EXPECT_EQ(clickFor<SetGizmoMode>("edit.rotate", 0.1).mode, GizmoMode::turn);
  EXPECT_EQ(clickFor<SetGizmoMode>("edit.scale_handles", 0.1).mode, GizmoMode::scale);
  select({Selection::Kind::light, 0});
  EXPECT_FALSE(has("edit.look_out") || has("edit.mirror_cost"));
}

TEST_F(Inspector, TooltipsStayClosedAfterDragsOfThePicture) {
  selectMirror(0);
  const WindowRect picture = windows_->freeRect();
  moveTo(picture.corner.x + 0.5 * picture.size.x, picture.corner.y + 0.5 * picture.size.y);
  hold(true);
  hover("edit.mirror_cost");
  EXPECT_FALSE(tooltip());
  hold(false);
  EXPECT_FALSE(tooltip());
  hover("edit.mirror_cost", 0.8);
  EXPECT_TRUE(tooltip());
}

TEST_F(Inspector, OnlyValidPolygonsAreApplied) {
  Mirror sail;
  sail.name = "sail";
  sail.polygon = {{-0.8, 0.5, -1}, {0.8, 0.5, -1}, {0.8, 1.6, -1}, {-0.8, 1.6, -1}};
  scene_.mirrors = {sail};
  selectMirror(0);
  const std::vector<glm::dvec3>& polygon = scene_.mirrors[0].polygon;
  const auto& problem = windows_->state().polygon.problem;
  typeNumber("edit.polygon.2", 0.17, "0.55");
  EXPECT_EQ(polygon[2], glm::dvec3(0.55, 1.6, -1.0)) << problem.value_or("");
  const std::vector<glm::dvec3> narrowed = polygon;
  typeNumber("edit.polygon.2", 0.83, "-0.5");
  EXPECT_EQ(polygon, narrowed);
  EXPECT_TRUE(output_.refusedEdit);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->find("the polygon is not planar (its corners must"), 0u) << *problem;
  typeNumber("edit.polygon.3", 0.83, "-0.5");
  EXPECT_FALSE(problem) << "both upper vertices are nearer now";
  EXPECT_FALSE(output_.refusedEdit);
  EXPECT_EQ(polygon[2], glm::dvec3(0.55, 1.6, -0.5));
  typeNumber("edit.polygon.1", 0.17, "-2");
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->find("the polygon is not convex"), 0u) << *problem;
  click("edit.polygon.reset");
  EXPECT_FALSE(problem);
  click("edit.polygon.1.add");
  const std::vector<glm::dvec3> five = std::get<Mirror>(only<EditNode>().node).polygon;
  ASSERT_EQ(five.size(), 5u);
  EXPECT_EQ(five[2], 0.5 * (five[1] + five[3]));
  scene_.mirrors[0].polygon = five;
  EXPECT_EQ(std::get<Mirror>(clickFor<EditNode>("edit.polygon.0.remove").node).polygon.size(), 4u);
}

TEST_F(PanelTest, PromptsAnswerByButtonsAndEnter) {
  edit_.prompt = Prompt::unsavedChanges;
  edit_.saveFile = "/home/scene.toml";
  EXPECT_TRUE(has("ask.save"));
  clickFor<DiscardChanges>("ask.discard");
  edit_.saveFile.reset();
  EXPECT_FALSE(has("ask.save")) << "only to another file";
  clickFor<AskWhereToSave>("ask.save_as");
  ask(Prompt::saveAs, "/home/scene.toml");
  EXPECT_EQ(windows_->state().files.typed, "scene.toml");
  type("/other");
  EXPECT_EQ(windows_->state().files.typed, "/other") << "the name is selected";
  commands_.clear();
  tap(ImGuiKey_Enter);
  EXPECT_EQ(only<SaveAs>().file, "/other");
  clickFor<CancelPrompt>("where.cancel");
  ask(Prompt::none);
  EXPECT_FALSE(has("where.cancel"));
}

class AccuracyWindow : public PanelTest {
 protected:
  AccuracyWindow() {
    accuracy_.points = {{"cheap", 0.1, 1.0, 0.9, 1.1}, {"exact", 0.001, 8.0, 7.0, 9.0}, {"bad", 0.2, 9.0, 8.0, 9.5}};
    accuracy_.front = {0, 1};
    toggle("Accuracy");
  }
};

TEST_F(AccuracyWindow, TextsOfRowsStandOnOneLine) {
  scene_.mirrors[0].ripple = Ripple{.amplitude = 0.1};
  edit_.selected = {Selection::Kind::mirror, 0};
  edit_.through = {1};
  windows_->toggleInspector();
  for (const char* window : {"Scenes", "Performance", "Device", "Log", "Targets"}) {
    toggle(window);
    for (const float width : {1280.0f, 640.0f}) {
      resize(width, 1200);
      EXPECT_EQ(textsOffTheirLine(), "") << width << " with " << window;
    }
    resize(900, 700);
  }
}

TEST_F(AccuracyWindow, PointsLieOverNoAxisTitle) {
  for (const float scale : {1.0f, 2.0f}) {
    ImGui::GetIO().FontGlobalScale = scale;
    resize(1280, 720);
    const PixelRect plot = widget("accuracy.plot");
    const double em = ImGui::GetFontSize();
    for (const PointRow& point : accuracy_.points) {
      const PixelRect place = widget("accuracy.point " + point.name);
      EXPECT_GE(place.y, plot.y + em) << point.name << " at " << scale;
      EXPECT_LE(place.y + place.height, plot.y + plot.height - 2.2 * em) << point.name << " at " << scale;
    }
  }
}

TEST_F(AccuracyWindow, LegendExplainsColorsAndBars) {
  EXPECT_TRUE(shows("Orange: none is more accurate in its time."));
  EXPECT_TRUE(shows("Bars: the middle half of the times"));
}

TEST_F(AccuracyWindow, PointsAndSliderApplySettings) {
  EXPECT_EQ(clickFor<ApplyPoint>("accuracy.point exact").point, 1);
  accuracy_.current = 1;
  click("accuracy.slider", 0.05);
  ASSERT_TRUE(sent<ApplyPoint>());
  EXPECT_EQ(std::get<ApplyPoint>(commands_.front()).point, 0);
}

TEST_F(AccuracyWindow, OwnSettingsComeBack) {
  click("accuracy.back");
  EXPECT_FALSE(sent<SetSettings>()) << "no point was picked";
  accuracy_.own.emplace().view.exposure = 2.0;
  EXPECT_EQ(clickFor<SetSettings>("accuracy.back").settings, *accuracy_.own);
  commands_.clear();
  click("accuracy.back");
  EXPECT_FALSE(sent<SetSettings>()) << "they are there";
}

TEST_F(AccuracyWindow, PickedPointIsComparedWithOwnSettings) {
  const auto compares = [&](const std::string& place) {
    commands_.clear();
    if (startsWith(place, "menu.")) {
      click("menu.View");
    }
    click(place, 0.3);
    tap(ImGuiKey_Escape);
    const auto* sent = commands_.empty() ? nullptr : std::get_if<ToggleSplit>(&commands_.front());
    return sent && sent->start == SplitStart::point;
  };
  for (const std::string place : {"accuracy.compare", "menu.Compare with the picked point"}) {
    accuracy_.current = 1;
    accuracy_.own.reset();
    split_.on = false;
    EXPECT_FALSE(compares(place)) << place << ", no point was picked";
    accuracy_.own.emplace().view.exposure = 2.0;
    EXPECT_TRUE(compares(place)) << place;
    accuracy_.current = -1;
    EXPECT_FALSE(compares(place)) << place << ", the settings were changed since";
    accuracy_.current = 1;
    split_.on = true;
    EXPECT_FALSE(compares(place)) << place << ", A | B is on";
  }
}

TEST_F(AccuracyWindow, SliderNamesPointsOffTheFront) {
  EXPECT_TRUE(shows("off the front"));
  accuracy_.current = 2;
  EXPECT_TRUE(shows("off the front"));
  accuracy_.current = 1;
  EXPECT_TRUE(shows("2 of 2"));
  EXPECT_FALSE(has("off the front"));
}

TEST_F(AccuracyWindow, PlotLeavesRoomForTheSlider) {
  resize(1280, 360);
  const PixelRect slider = widget("accuracy.slider");
  EXPECT_LT(slider.y + slider.height, 350) << "without scrolling";
}

TEST_F(AccuracyWindow, GreyPointsSayWhy) {
  hover("accuracy.point exact");
  EXPECT_TRUE(shows("mean FLIP"));
  EXPECT_FALSE(has("Grey:"));
  hover("accuracy.point bad");
  EXPECT_TRUE(shows("Grey: a point at least as accurate takes no longer"));
}

TEST_F(AccuracyWindow, FiguresAreOfOnePicture) {
  EXPECT_TRUE(shows("mean FLIP of one picture"));
  EXPECT_TRUE(shows("GPU ms of one picture"));
  const PixelRect plot = widget("accuracy.plot");
  moveTo(plot.x + 40, plot.y + plot.height + 10);  // the text below
  EXPECT_TRUE(shows("Both axes are logarithmic."));
  EXPECT_TRUE(shows("One picture: in full quality, as measured."));
}

TEST_F(AccuracyWindow, PointsThatABoundChoseAreNotGrey) {
  const auto greyVertices = [] {
    int count = 0;
    for (const ImDrawList* list : drawLists()) {
      count += static_cast<int>(
          std::ranges::count(list->VtxBuffer, IM_COL32(130, 150, 180, 200), [](const ImDrawVert& v) { return v.col; }));
    }
    return count;
  };
  EXPECT_GT(greyVertices(), 0);
  accuracy_.chosen = 2;
  accuracy_.current = 2;
  hover("accuracy.point bad");
  EXPECT_EQ(greyVertices(), 0);
  EXPECT_FALSE(has("Grey:"));
  EXPECT_TRUE(shows("Green: a bound chose it by its median"));
}

TEST_F(AccuracyWindow, SaysPurposeAndTimeOfMeasuring) {
  EXPECT_FALSE(has("The view has changed since."));
  accuracy_.otherView = true;
  EXPECT_TRUE(shows("The view has changed since."));
  accuracy_ = {};
  for (const char* step : {"Finds the settings that are the most accurate within a time", "traces", "draws",
                           "measures the times", "Of its 7 steps the first 4 give rough figures"}) {
    EXPECT_TRUE(shows(step)) << step;
  }
  accuracy_.measuring = true;
  accuracy_.stage = "Tracing the reference (1 of 7)";
  accuracy_.secondsLeft = 90.0;
  EXPECT_TRUE(shows("Tracing the reference (1 of 7)"));
  EXPECT_TRUE(shows("About 90 s left"));
  accuracy_.secondsLeft = 340.0;
  EXPECT_TRUE(shows("About 6 min left"));
}

TEST_F(AccuracyWindow, NothingMovesWhenAStepBegins) {
  accuracy_.measuring = true;
  accuracy_.secondsLeft = 10.0;
  const int bound = widget("quality.budget_ms").y;
  accuracy_.secondsLeft = 0.0;
  EXPECT_EQ(widget("quality.budget_ms").y, bound);
}

TEST_F(AccuracyWindow, BoundsBeginWhereSettingsWereMeasured) {
  accuracy_.current = 2;
  click("quality.max_error", 0.1);
  EXPECT_NEAR(settings_.quality.maxError, 0.2, 1e-9);
  accuracy_.current = -1;
  accuracy_.points[0].ms = 123.4;
  click("quality.budget_ms", 0.1);
  EXPECT_NEAR(settings_.quality.budgetMs, 130.0, 1e-9) << "the fastest of the front fits";
}

TEST_F(AccuracyWindow, BoundsNeedMeasuredPoints) {
  accuracy_ = {};
  EXPECT_TRUE(shows("Measure this view first."));
  click("quality.budget_ms", 0.1);
  EXPECT_EQ(settings_.quality.budgetMs, 0.0) << "a guess would choose settings as soon as there are points";
  accuracy_.measuring = true;
  EXPECT_FALSE(has("Measure this view first."));
  EXPECT_TRUE(shows("Being measured"));
  accuracy_.measuring = false;
  settings_.quality.maxError = 0.9;
  EXPECT_TRUE(shows("Measure this view first.")) << "a scene may set a bound";
}

TEST_F(AccuracyWindow, NameOfPointIsShownInFull) {
  accuracy_.points[1].name = "reflection scale 0.5, max depth 4, samples 4, view samples 4";
  accuracy_.current = 1;
  resize(1280, 720);
  for (const float textSize : {1.0f, 2.0f}) {
    ImGui::GetIO().FontGlobalScale = textSize;
    const PixelRect slider = widget("accuracy.slider");
    const std::string below = shownText(static_cast<float>(slider.y + slider.height) - 4.0f);
    EXPECT_TRUE(contains(below, "reflectionscale0.5,maxdepth4,samples4,viewsamples4")) << textSize;
  }
}

TEST_F(AccuracyWindow, MeasurementIsStartedAndCancelled) {
  clickFor<MeasureAccuracy>("accuracy.measure");
  accuracy_.measuring = true;
  accuracy_.stage = "tracing";
  EXPECT_FALSE(has("accuracy.measure"));
  clickFor<CancelMeasurement>("accuracy.cancel");
}

TEST_F(AccuracyWindow, DifferenceEndsWithTheWindow) {
  click("accuracy.difference", 0.05);
  EXPECT_TRUE(run(2).errorGain && output_.points);
  EXPECT_TRUE(shows("Error map, gain 10. A checkbox in Accuracy ends it."));
  toggle("Accuracy");
  EXPECT_FALSE(run(2).errorGain || output_.points);
  EXPECT_FALSE(shows("Error map"));
  edit_.selected = {};
  toggle("Inspector");
  EXPECT_TRUE(shows("Error map")) << "which the inspector shows too";
}

TEST_F(AccuracyWindow, GainIsInTheLegend) {
  resize(900, 1000);
  click("accuracy.difference", 0.05);
  EXPECT_TRUE(shows("FLIP from 0, left, to 0.1 and more (gain 10)"));
  for (const double by : {30.0, 60.0}) {
    drag("accuracy.gain", 0.05, by);
    const double gain = run(2).errorGain.value();
    EXPECT_GT(gain, 1.1);
    EXPECT_TRUE(shows("to " + significant(1.0 / gain, 3) + " and more (gain " + significant(gain, 3) + ")"));
  }
}

TEST_F(AccuracyWindow, PickedPointsAreShownAlone) {
  accuracy_.current = 1;
  EXPECT_TRUE(shows("a still view shows the mean of several pictures"));
  accuracy_.alone = true;
  EXPECT_TRUE(shows("Shown as measured, as one picture: mean FLIP 0.001"));
}

class TargetsWindow : public PanelTest {
 protected:
  TargetsWindow() {
    const PassRow mirror{{.path = {0}}, "mirror wall"};
    const PassRow main{{.kind = PassKind::main}, "main view"};
    frame_.passes = {mirror, main};
    frame_.skipped = {{.name = "mirror door", .path = {1}, .reason = "backface"}};
    frame_.target = {.complete = true, .size = {900, 700}};
    resize(900, 1800);  // all windows are in view
    toggle("Passes");
  }
  const std::optional<TargetRequest>& target() const { return output_.target; }
};

TEST_F(TargetsWindow, ShowsTheMainViewZoomsAndPans) {
  toggle("Targets");
  run(3);
  ASSERT_TRUE(target() && target()->drawn);
  EXPECT_TRUE(target()->path.empty());
  const PixelRect canvas = widget("targets.canvas");
  EXPECT_EQ(target()->display.zoom, 0.0) << "fits whatever size the target has when it is drawn";
  EXPECT_NEAR(windows_->state().targets.shownZoom, std::min(canvas.width / 900.0, canvas.height / 700.0), 1e-6);
  click("targets.one");
  EXPECT_EQ(target()->display.zoom, 1.0);
  const glm::dvec2 before = windows_->state().targets.center;
  drag("targets.canvas", 0.5, -20, -10);
  EXPECT_NEAR(windows_->state().targets.center.x - before.x, 20.0, 1e-6);
  EXPECT_NEAR(windows_->state().targets.center.y - before.y, 10.0, 1e-6);
  wheel(1.0);
  EXPECT_GT(target()->display.zoom, 1.1);
  ASSERT_TRUE(target()->display.probe) << "the pointer is on it";
  click("targets.depth", 0.1);
  EXPECT_EQ(target()->display.kind, TargetKind::depth);
  EXPECT_FALSE(target()->display.probe);
  click("targets.mask", 0.1);
  EXPECT_FALSE(target()->drawn) << "the panel draws it";
  click("targets.fit");
  EXPECT_EQ(windows_->state().targets.zoom, 0.0);
  toggle("Targets");
  EXPECT_FALSE(target());
}

TEST_F(TargetsWindow, OpensOnTheSelectedMirror) {
  edit_.selected = {Selection::Kind::mirror, 0};
  toggle("Targets");
  ASSERT_TRUE(target());
  EXPECT_EQ(target()->path, MirrorPath{0});
}

TEST_F(TargetsWindow, PassesAreSteppedThrough) {
  const PassRow inner{{.path = {0, 1}}, "mirror wall > door"};
  const PassRow display{{.kind = PassKind::display}, "display"};
  frame_.passes = {inner, frame_.passes[0], frame_.passes[1], display};
  toggle("Targets");
  click("targets.next");
  EXPECT_TRUE(target()->path.empty()) << "the main view has the last target";
  for (const MirrorPath& path : {MirrorPath{0}, MirrorPath{0, 1}, MirrorPath{0, 1}}) {
    click("targets.previous");
    EXPECT_EQ(target()->path, path);
  }
  click("targets.next");
  EXPECT_EQ(target()->path, MirrorPath{0});
}

TEST_F(TargetsWindow, NothingIsCutWhereTextIsLarge) {
  frame_.passes[1].name = "mirror door of the long corridor behind the kitchen > mirror wall opposite";
  toggle("Targets");
  click("targets.depth", 0.1);
  for (PassRow& pass : frame_.passes) {
    pass.gpuMs = 123.4;
    pass.areaPx = 1280.0 * 1000.0;
  }
  for (const float scale : {1.0f, 2.0f}) {
    ImGui::GetIO().FontGlobalScale = scale;
    for (const float width : {900.0f, 1280.0f, 1920.0f}) {
      resize(width, 2400);
      EXPECT_EQ(cutTexts(), "") << width << " at " << scale;
    }
  }
}

TEST_F(TargetsWindow, NewTargetsAreDrawnAtOnce) {
  frame_.target = {};
  toggle("Targets");
  EXPECT_TRUE(target() && target()->drawn) << "else the picture would be seen in its place";
}

TEST_F(TargetsWindow, IncompleteTargetsAreAnnounced) {
  frame_.target.complete = false;
  frame_.target.share = 0.459;
  toggle("Targets");
  hover("targets.canvas");
  EXPECT_TRUE(shows("Being drawn with the next picture: 45 %"));
  ASSERT_TRUE(target() && target()->drawn);
  EXPECT_FALSE(target()->display.probe);
  frame_.target.complete = true;
  EXPECT_FALSE(shows("Being drawn with the next picture"));
  EXPECT_TRUE(target()->display.probe);
}

TEST_F(TargetsWindow, ClickedPassOpensAndClosesIt) {
  const SelectNode& select = clickFor<SelectNode>("pass.mirror wall", 0.3);
  EXPECT_EQ(select.node, (Selection{Selection::Kind::mirror, 0})) << "as a click in Performance does";
  EXPECT_FALSE(select.inspect) << "what it drew stays in sight";
  run(2);
  ASSERT_TRUE(target());
  EXPECT_EQ(target()->path, MirrorPath{0});
  EXPECT_EQ(output_.hoveredPath, MirrorPath{0});
  frame_.passes.erase(frame_.passes.begin());
  run(2);
  EXPECT_TRUE(target()->path.empty()) << "the main view takes the place of a pass that is gone";
  hover("pass.main view");
  const PixelRect name = widget("pass.main view");
  moveTo(name.x + name.width + 2.0 * ImGui::GetFontSize(), name.y + name.height / 2.0);  // on its time
  commands_.clear();
  press();
  EXPECT_FALSE(sent<SelectNode>());
  run(2);
  EXPECT_FALSE(target());
}

TEST_F(TargetsWindow, RowsAddUpToTheFrame) {
  EXPECT_FALSE(has("passes.rest"));
  frame_.passes[1].gpuMs = 20.0;
  frame_.passes[1].timed = true;
  frame_.timedGpuMs = 50.0;
  EXPECT_TRUE(has("passes.rest"));
  EXPECT_TRUE(shows("other work"));
}

// Passes of mirrors that come and go, recorded in any order.
class ChangingPasses : public PanelTest {
 protected:
  static constexpr int most = 7;
  ChangingPasses() {
    resize(900, 1200);
    toggle("Passes");
    setPasses((1 << most) - 1);
  }
  // Shows the passes of the mirrors in `mirrors`, a bit each.
  void setPasses(int mirrors) {
    frame_.passes = {{{.kind = PassKind::main}, "main view"}};
    for (int mirror = 0; mirror < most; ++mirror) {
      if ((mirrors >> mirror & 1) != 0) {
        PassRow pass{{.path = {mirror}}, "mirror " + std::to_string(mirror)};
        pass.gpuMs = std::uniform_real_distribution(0.1, 9.0)(random_);
        pass.timed = true;
        frame_.passes.push_back(pass);
      }
    }
    std::shuffle(frame_.passes.begin(), frame_.passes.end(), random_);
    run(2);
  }
  // Names of the rows from top to bottom.
  std::vector<std::string> rows() {
    std::map<int, std::string> byPlace;
    run(2);
    for (const auto& [name, rect] : windows_->state().widgets) {
      if (name.starts_with("pass.")) {
        byPlace[rect.y] = name;
      }
    }
    std::vector<std::string> names;
    for (const auto& [place, name] : byPlace) {
      names.push_back(name);
    }
    return names;
  }
  std::mt19937 random_{5};
};

TEST_F(ChangingPasses, OrderIsThatOfTheScene) {
  const std::vector<std::string> first = rows();
  ASSERT_EQ(first.size(), static_cast<size_t>(most) + 1);
  EXPECT_TRUE(std::ranges::is_sorted(first.begin() + 1, first.end()));
  for (int i = 0; i < 12; ++i) {
    const int shown = std::uniform_int_distribution(1, (1 << most) - 1)(random_);
    setPasses(shown);
    std::vector<std::string> expected = first;
    std::erase_if(expected, [&](const std::string& name) {
      return name != "pass.main view" && (shown >> (name.back() - '0') & 1) == 0;
    });
    EXPECT_EQ(rows(), expected);
  }
}

TEST_F(ChangingPasses, RowsUnderThePointerStay) {
  const std::vector<std::string> first = rows();
  hover("pass.mirror 3", 0.3);
  for (int i = 0; i < 12; ++i) {
    setPasses(std::uniform_int_distribution(1, (1 << most) - 1)(random_));
    EXPECT_EQ(rows(), first);
  }
  setPasses(1);
  moveTo(600, 1100);
  EXPECT_EQ(rows().size(), 2u) << "the pointer has left";
  hover("pass.mirror 0", 0.3);
  for (const char* step : {"delete mirror", ""}) {
    edit_.undo = step;
    setPasses(7);
    EXPECT_EQ(rows().size(), 4u) << "an edit may have given a mirror the place of another";
    setPasses(1);
    EXPECT_EQ(rows().size(), 2u);
  }
}

TEST_F(ChangingPasses, AreSortedOnlyOnDemand) {
  const std::vector<std::string> inScene = rows();
  const auto slowestFirst = [&] {
    std::vector<PassRow> passes = frame_.passes;
    std::erase_if(passes, [](const PassRow& pass) { return pass.kind == PassKind::main; });
    std::ranges::sort(passes, std::greater(), &PassRow::gpuMs);
    std::vector<std::string> names = {"pass.main view"};
    for (const PassRow& pass : passes) {
      names.push_back("pass." + pass.name);
    }
    return names;
  };
  click("passes.head 1");
  const std::vector<std::string> sorted = rows();
  EXPECT_EQ(sorted, slowestFirst());
  moveTo(600, 1100);
  for (int i = 0; i < 6; ++i) {
    setPasses((1 << most) - 1);
    EXPECT_EQ(rows(), sorted) << "times change, rows do not";
  }
  click("passes.head 1");
  EXPECT_EQ(rows(), slowestFirst());
  click("passes.head 0");
  EXPECT_EQ(rows(), inScene);
}

TEST_F(TargetsWindow, TooltipsLeaveTheirRowInSight) {
  for (const char* row : {"pass.mirror wall", "pass.main view"}) {
    hover(row, 0.3);
    ASSERT_TRUE(tooltip());
    const PixelRect rect = widget(row);
    const ImVec2 corner(static_cast<float>(rect.x), static_cast<float>(rect.y));
    const ImVec2 end(corner.x + static_cast<float>(rect.width), corner.y + static_cast<float>(rect.height));
    EXPECT_FALSE(tooltip()->Rect().Overlaps(ImRect(corner, end)));
  }
}

TEST_F(TargetsWindow, PointedSkippedMirrorsAreReported) {
  click("skipped in main view", 0.1);
  hover("skipped.mirror door", 0.1);
  EXPECT_EQ(output_.hoveredPath, MirrorPath{1});
  const Selection door{Selection::Kind::mirror, 1};
  EXPECT_EQ(clickFor<SelectNode>("skipped.mirror door", 0.1).node, door);
  moveTo(700, 600);  // under the pointer rows stay as they are
  frame_.skipped[0].path = {7};
  click("skipped.mirror door", 0.1);
  EXPECT_FALSE(sent<SelectNode>()) << "it was deleted since the last frame";
  moveTo(700, 600);
  EXPECT_TRUE(output_.hoveredPath.empty());
}

}  // namespace
}  // namespace speculum
