#include "ui/panel_windows.hpp"

#include <imgui.h>
#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <imgui_versions.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

#include "platform/files.hpp"
#include "platform/text.hpp"
#include "ui/input_map.hpp"

namespace speculum {

namespace {

constexpr const char* mainTitle = "Speculum";
constexpr float clickReach = 6.0f;  // pixels within which clicks repeat each other

constexpr std::string_view openWord = "open";
constexpr std::string_view closedWord = "closed";
constexpr std::string_view percentWord = "percent";
constexpr std::string_view themeWord = "theme";
constexpr std::string_view lightWord = "light";

std::filesystem::path choicesFile() {
  return userConfigDir() / "panels";
}

// Reads the saved choices; those that cannot be read have their defaults.
PanelChoices savedPanelChoices() {
  PanelChoices choices;
  std::istringstream lines(readTextIfAny(choicesFile(), 1u << 16));
  std::string word;
  std::string value;
  while (lines >> word >> value) {
    for (const PanelName& panel : rememberedPanels) {
      if (value == panel.name && (word == openWord || word == closedWord)) {
        choices.*panel.open = word == openWord;
      }
    }
    if (word == themeWord) {
      choices.theme = value == lightWord ? Theme::light : Theme::dark;
    }
    if (word == percentWord) {
      choices.percent = std::clamp(std::atoi(value.c_str()), 50, 300);
    }
  }
  return choices;
}

void savePanelChoices(const PanelChoices& choices) {
  std::string text = fmt::format("{} {}\n", percentWord, choices.percent);
  text += choices.theme == Theme::light ? fmt::format("{} {}\n", themeWord, lightWord) : "";
  for (const PanelName& panel : rememberedPanels) {
    const bool open = choices.*panel.open;
    const bool usual = open == PanelChoices().*panel.open;
    text += usual ? "" : fmt::format("{} {}\n", open ? openWord : closedWord, panel.name);
  }
  if (!storeFile(choicesFile(), text, Links::follow)) {
    spdlog::warn("{} cannot be written: the choices of the panel are not remembered", choicesFile().string());
  }
}

}  // namespace

PanelWindows::PanelWindows()
    : state_{.choices = savedPanelChoices()}, savedChoices_(state_.choices), pendingPercent_(state_.choices.percent) {}

// Opens no tooltip over the widget where a drag of the picture ended or that lies below a closed menu, until the
// pointer moves or a button is pressed. After a key, ImGui opens none either. Escape counts as a key that moves the
// focus: else a submenu that it closes would open again, because the pointer rests on its entry.
void PanelWindows::ignoreRestingPointer() {
  const ImGuiIO& io = ImGui::GetIO();
  const bool open = !ImGui::GetCurrentContext()->OpenPopupStack.empty();
  const bool closed = std::exchange(popupOpen_, open) && !open;
  if (closed || imgui::isPressed(ImGuiKey_Escape)) {
    imgui::focusIsHovered() = true;
  }
  for (int button = 0; button < ImGuiMouseButton_COUNT; ++button) {
    if (ImGui::IsMouseReleased(button) && !io.MouseDownOwned[button]) {
      imgui::focusIsHovered() = true;
    }
  }
}

// Alt alone goes to the menus, as in other programs. Dear ImGui goes to the title of the focused panel instead, and
// nowhere if no panel is focused: from 1.91.7 on it then does not even watch Alt.
void PanelWindows::goToMenusByAlt() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  const ImGuiIO& io = ImGui::GetIO();
  const bool leftWindow = ImGui::IsMousePosValid(&io.MousePos) != ImGui::IsMousePosValid(&io.MousePosPrev);
  const bool alone = focused_ && !io.KeyCtrl && !io.KeyShift && !io.KeySuper && io.InputQueueCharacters.empty() &&
                     !ImGui::IsAnyMouseDown() && !leftWindow;
  const bool wasDown = std::exchange(altDown_, io.KeyAlt);
  const bool tapped = alt_ && alone && !io.KeyAlt;
  alt_ = alone && io.KeyAlt && (alt_ || !wasDown);
  context.NavWindowingToggleLayer = context.NavWindowingToggleLayer && !ImGui::IsAnyMouseDown();
  ImGuiWindow* const bar = ImGui::FindWindowByName("##MainMenuBar");
  const bool free = context.ActiveId == 0 && context.OpenPopupStack.empty() && context.NavWindow != bar;
  if (tapped && free && bar && bar->WasActive) {
    ImGui::FocusWindow(bar);
    context.NavLayer = ImGuiNavLayer_Menu;
    ImGui::NavInitWindow(bar, true);
    imgui::showFocus();
  }
}

// Forgets the focused widget if its panel has it no more, so that arrow keys begin with the panel's first one: from the
// place of a lost one, Dear ImGui may find nothing. Call it after the last widget. Widgets that were just clicked are
// found in the next frame only.
void PanelWindows::forgetLostWidget() {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  ImGuiWindow* const window = context.NavWindow;
  const bool drawn = window && window->Active && !window->SkipItems && context.NavLayer == ImGuiNavLayer_Main;
  const ImGuiID lost = drawn && !context.NavIdIsAlive ? context.NavId : 0;
  if (lost != 0 && lost == lost_) {
    context.NavId = window->NavLastIds[ImGuiNavLayer_Main] = 0;
  }
  lost_ = lost;
}

UiOutput PanelWindows::build(const UiInput& input) {
  ignoreRestingPointer();
  goToMenusByAlt();
  imgui::pressByEnter(*ImGui::GetCurrentContext());
  PanelContext ui{.input = input, .state = state_, .settings = input.settings, .output = {}};
  state_.widgets.clear();
  state_.targets.pointed.reset();
  state_.targets.canvas.reset();
  const ImVec2 pointer = ImGui::GetIO().MousePos;
  if (state_.openedAt && glm::distance(*state_.openedAt, glm::vec2(pointer.x, pointer.y)) > clickReach) {
    state_.openedAt.reset();
  }
  panels::loading(ui);
  if (!state_.choices.inspector && std::exchange(foldedMain_, false)) {
    dock_.fold(mainTitle, false);
  }
  const float below = std::max(panels::statusHeight(), statusHeight_);
  dock_.beginFrame(visible_ ? ImGui::GetFrameHeight() : 0.0f, below, !visible_);
  if (visible_) {
    menuBar(ui);
    mainPanel(ui);
    sideWindows(ui);
    panels::besideTarget(ui, [&] { panels::passOutline(ui); });
    panels::help(ui);
    if (state_.widgetDemo) {
      ImGui::ShowDemoWindow(&state_.widgetDemo);
    }
    panels::inspector(ui, dock_);
    panels::playOffer(ui, freeRect(), below);
  }
  panels::besideTarget(ui, [&] { panels::editOverlay(input.edit.overlay, freeRect()); });
  panels::divider(ui, freeRect());
  panels::poster(ui, thumbnails_, freeRect());
  if (state_.choices != savedChoices_) {
    savedChoices_ = state_.choices;
    savePanelChoices(savedChoices_);
  }
  panels::message(ui, freeRect());
  panels::prompts(ui);
  forgetLostWidget();
  if (state_.editing && !ImGui::IsAnyItemActive()) {
    state_.editing = false;
    ui.send(EndEdit{});
  }
  ui.output.points = state_.choices.accuracy;
  ShownStatus status = input.status;
  if ((state_.choices.accuracy || state_.choices.inspector) && state_.showDifference) {
    ui.output.errorGain = state_.errorGain;
    status.picture += fmt::format("{}Error map, gain {}. A checkbox in Accuracy ends it.",
                                  status.picture.empty() ? "" : "\n", significant(state_.errorGain, 3));
  }
  if (visible_ || !input.status.savesPicture) {
    const WindowRect free = freeRect();
    statusHeight_ = panels::statusLine(status, visible_ ? std::max(statusWidth_, 18.0f * ImGui::GetFontSize()) : 0.0f,
                                       free.corner.x + free.size.x);
  }
  if (ui.settings != input.settings) {
    const bool continued = std::exchange(state_.setting, ImGui::IsAnyItemActive());
    ui.output.commands.insert(ui.output.commands.begin(), SetSettings{ui.settings, continued});
  } else if (!ImGui::IsAnyItemActive()) {
    state_.setting = false;
  }
  return std::move(ui.output);
}

void PanelWindows::mainPanel(PanelContext& ui) {
  if (dock_.begin(mainTitle, nullptr, PanelDock::Edge::left, panels::modestEms({28.0f, 0.0f}))) {
    ImGui::PushItemWidth(-10.5f * ImGui::GetFontSize());  // the rest is for the labels
    panels::scene(ui);
    windowChoices(ui);
    panels::splitChoice(ui);
    panels::settings(ui);
    panels::effects(ui);
    ImGui::PopItemWidth();
  }
  statusWidth_ = ImGui::GetWindowWidth();  // also of a folded panel
  ImGui::End();
}

void PanelWindows::menuBar(PanelContext& ui) {
  if (!ImGui::BeginMainMenuBar()) {
    return;
  }
  panels::menus(ui);
  if (panels::menu(ui, "Window")) {
    windowMenu(ui);
    ImGui::EndMenu();
  }
  if (panels::menu(ui, "Help")) {
    ImGui::MenuItem("Keys", keysOf(ToggleHelp{}), &state_.help);
    panels::lessonMenu(ui);
    ImGui::MenuItem("Dear ImGui demo", nullptr, &state_.widgetDemo);
    panels::recordWidget(ui, "help.widgets");
    ImGui::EndMenu();
  }
  panels::frameTime(ui);
  ImGui::EndMainMenuBar();
}

void PanelWindows::windowMenu(PanelContext& ui) {
  for (const PanelName& panel : panelNames) {
    const char* keys = panel.open == &PanelChoices::inspector ? keysOf(ToggleInspector{}) : nullptr;
    ImGui::MenuItem(panel.name.data(), keys, &(state_.choices.*panel.open));
    panels::tip(panel.about);
  }
  ImGui::Separator();
  for (const auto& [name, place, theme] :
       {std::tuple("Dark theme", "theme.dark", Theme::dark), std::tuple("Light theme", "theme.light", Theme::light)}) {
    if (ImGui::MenuItem(name, nullptr, state_.choices.theme == theme)) {
      state_.choices.theme = theme;
    }
    panels::recordWidget(ui, place);
  }
  ImGui::SliderInt("Text size", &pendingPercent_, 50, 300, "%d %%", ImGuiSliderFlags_AlwaysClamp);
  panels::recordWidget(ui, "window.size");
  if (!ImGui::IsItemActive()) {
    state_.choices.percent = pendingPercent_;
  }
  ImGui::Separator();
  presentModes(ui);
  ImGui::Separator();
  if (ImGui::MenuItem("Reset layout")) {
    dock_.reset();
    state_.help = false;
    for (const PanelName& panel : rememberedPanels) {
      state_.choices.*panel.open = PanelChoices().*panel.open;
    }
  }
  panels::recordWidget(ui, "window.reset");
  if (ImGui::MenuItem("Hide panels", keysOf(TogglePanel{}))) {
    ui.send(TogglePanel{});
  }
}

void PanelWindows::windowChoices(PanelContext& ui) {
  const int columns = static_cast<int>(ImGui::GetContentRegionAvail().x / (7.7f * ImGui::GetFontSize()));
  if (ImGui::BeginTable("panels", std::clamp(columns, 1, 3), ImGuiTableFlags_SizingStretchSame)) {
    for (const PanelName& panel : panelNames) {
      ImGui::TableNextColumn();
      ImGui::Checkbox(panel.name.data(), &(state_.choices.*panel.open));
      panels::recordWidget(ui, "panel." + std::string(panel.name), panel.about);
    }
    ImGui::EndTable();
  }
}

void PanelWindows::presentModes(PanelContext& ui) {
  const ShownDevice& device = ui.input.device;
  for (size_t i = 0; i < device.presentModes.size(); ++i) {
    const std::string& name = device.presentModes[i];
    const std::string label = name == "fifo"      ? "VSync (fifo)"
                              : name == "mailbox" ? "VSync, newest picture (mailbox)"
                                                  : "No VSync (" + name + ")";
    if (ImGui::MenuItem(label.c_str(), nullptr, device.presentMode == i)) {
      ui.send(SetPresentMode{i});
    }
    panels::recordWidget(
        ui, "present." + name,
        "With VSync the picture never tears; without, pictures are shown at once and may tear. Waiting for the screen "
        "limits FPS to its refresh rate; showing the newest picture draws more than is seen.");
  }
}

void PanelWindows::sideWindows(PanelContext& ui) {
  const auto window = [&](const char* name, bool& open, const glm::vec2& ems, const auto& content, int flags = 0,
                          PanelDock::Edge edge = PanelDock::Edge::right) {
    if (open) {
      ImGui::SetNextWindowBgAlpha(1.0f);  // opaque, because figures over the picture are hard to read
      if (dock_.begin(name, &open, edge, ems, flags)) {
        content();
      }
      ImGui::End();
    }
  };
  PanelChoices& choices = state_.choices;
  bool lesson = ui.input.split.lesson.has_value();
  // At the left edge, so that both halves stay in sight.
  window(
      "Lesson", lesson, {28.0f, 24.0f}, [&] { panels::lesson(ui); }, 0, PanelDock::Edge::left);
  if (!lesson && ui.input.split.lesson) {
    ui.send(ToggleSplit{});
  }
  window("Scenes", choices.scenes, {24.2f, 46.5f}, [&] { panels::gallery(ui, thumbnails_); });
  window("Performance", choices.performance, {27.0f, 30.0f}, [&] { panels::performance(ui); });
  window("Accuracy", choices.accuracy, {27.0f, 40.0f}, [&] { panels::accuracy(ui); });
  window("Passes", choices.passes, {29.0f, 30.0f}, [&] { panels::passes(ui); });
  window("Device", choices.device, {27.0f, 30.0f}, [&] { panels::device(ui); });
  window("Log", choices.log, {27.0f, 14.0f}, [&] { panels::log(ui); });
  // Without a background, because the renderer draws the target below it: this version of ImGui's Vulkan backend draws
  // no texture but its font.
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
  window(
      "Targets", choices.targets, {27.0f, 22.0f}, [&] { panels::targets(ui); }, flags);
  if (!choices.targets) {
    state_.targets.path.reset();
    ui.output.target.reset();
  }
}

void PanelWindows::setFocused(bool focused) {
  focused_ = focused;
  alt_ = false;
}

void PanelWindows::toggleHelp() {
  state_.help = !state_.help;
  visible_ = visible_ || state_.help;
}

void PanelWindows::toggleInspector() {
  bool& open = state_.choices.inspector;
  open = !open;
  state_.focusNodes = open;
  visible_ = visible_ || open;
}

// Opens the inspector, which ignores the pointer until the pointer moves: a further click at the same place is for the
// picture. The main panel folds while the inspector is open, unless both leave half of the display.
void PanelWindows::openInspector() {
  if (!std::exchange(state_.choices.inspector, true)) {
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    state_.openedAt = glm::vec2(pointer.x, pointer.y);
    const float left = dock_.freeRect().size.x - panels::inspectorEms.x * ImGui::GetFontSize();
    foldedMain_ = left < 0.5f * ImGui::GetIO().DisplaySize.x && !dock_.fold(mainTitle, true);
  }
}

void PanelWindows::closeSidePanels() {
  for (const PanelName& panel : panelNames) {
    state_.choices.*panel.open = false;
  }
}

bool PanelWindows::inspectorCovers(const glm::vec2& place) const {
  return visible_ && !state_.choices.inspector &&
         dock_.wouldCover(panels::inspectorTitle, PanelDock::Edge::right, panels::modestEms(panels::inspectorEms),
                          place);
}

WindowRect PanelWindows::freeRect() const {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  return visible_ ? dock_.freeRect() : WindowRect{{0.0f, 0.0f}, {display.x, display.y}};
}

}  // namespace speculum
