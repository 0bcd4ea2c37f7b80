#include "ui/panel_windows.hpp"

#include <imgui.h>
#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace speculum {

PanelWindows::PanelWindows()
    : state_{.choices = savedPanelChoices()}, savedChoices_(state_.choices), pendingPercent_(state_.choices.percent) {}

UiOutput PanelWindows::build(const UiView& view) {
  PanelContext ui{.view = view, .state = state_, .settings = view.settings.current, .output = {}};
  state_.widgets.clear();
  state_.hoveredPass = -1;
  state_.targets.pointed.reset();
  panels::loading(ui);
  dock_.beginFrame(panels::statusHeight(), !visible_);
  if (visible_) {
    mainPanel(ui);
    sideWindows(ui);
    panels::passOutline(ui);
    panels::help(ui);
    if (showDemoWindow_) {
      ImGui::ShowDemoWindow(&showDemoWindow_);
    }
  }
  panels::editOverlay(view.edit.overlay);
  if (visible_) {
    panels::inspector(ui, dock_);
  }
  panels::message(ui, dock_.freeRect());
  panels::prompts(ui);
  if (state_.editing && !ImGui::IsAnyItemActive()) {
    state_.editing = false;
    ui.send(EndEdit{});
  }
  if (visible_ || !view.status.withPanelOnly) {
    panels::statusLine(view.status, visible_ ? std::max(statusWidth_, 20.0f * ImGui::GetFontSize()) : 0.0f);
  }
  const bool difference = state_.choices.accuracy && state_.showDifference;
  if (difference != view.accuracy.showsDifference) {
    ui.send(ShowDifference{difference});
  }
  if (ui.settings != view.settings.current) {
    ui.output.commands.insert(ui.output.commands.begin(), SetSettings{ui.settings});
  }
  return std::move(ui.output);
}

void PanelWindows::mainPanel(PanelContext& ui) {
  if (dock_.begin("Speculum", nullptr, PanelDock::Edge::left, {28.0f, 0.0f})) {
    ImGui::PushItemWidth(-10.5f * ImGui::GetFontSize());  // the rest is for the labels
    const double ms = ui.view.frame.frameMs;
    const std::string rate =
        ui.view.frame.still ? "paused" : fmt::format("{:.{}f} FPS", 1000.0 / ms, ms > 100.0 ? 1 : 0);
    ImGui::Text("%s   %s", panels::duration(ms).c_str(), ms > 0.0 ? rate.c_str() : "");
    const float width = ImGui::GetWindowWidth();
    const char* hint = "F1: keys   Tab: hide";
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(hint).x);
    ImGui::TextDisabled("%s", hint);
    panels::scene(ui);
    windowChoices(ui);
    panels::settings(ui);
    panels::passes(ui);
    panels::effects(ui);
    ImGui::PopItemWidth();
    statusWidth_ = width;
  }
  ImGui::End();
}

void PanelWindows::windowChoices(PanelContext& ui) {
  if (ImGui::BeginTable("panels", 3, ImGuiTableFlags_SizingStretchSame)) {
    for (const PanelName& panel : panelNames) {
      ImGui::TableNextColumn();
      ImGui::Checkbox(panel.name.data(), &(state_.choices.*panel.open));
      panels::recordWidget(ui, "panel." + std::string(panel.name));
      panels::tip(panel.about);
    }
    ImGui::EndTable();
  }
  const bool open = ImGui::CollapsingHeader("Window");
  panels::recordWidget(ui, "section.window");
  if (!open) {
    return;
  }
  themeChoice(ui);
  ImGui::SliderInt("size", &pendingPercent_, 50, 300, "%d %%", ImGuiSliderFlags_AlwaysClamp);
  panels::recordWidget(ui, "window.size");
  panels::tip("Size of text and widgets, relative to the monitor's scale");
  if (!ImGui::IsItemActive()) {
    state_.choices.percent = pendingPercent_;
  }
  presentModes(ui);
  if (panels::button(ui, "Reset layout", "window.reset", "All windows back to the edges, in their original size")) {
    dock_.reset();
  }
  ImGui::Checkbox("ImGui demo window", &showDemoWindow_);
}

void PanelWindows::themeChoice(PanelContext& ui) {
  ImGui::TextUnformatted("theme");
  for (const auto& [name, place, theme] :
       {std::tuple("dark", "theme.dark", Theme::dark), std::tuple("light", "theme.light", Theme::light)}) {
    ImGui::SameLine();
    if (ImGui::RadioButton(name, state_.choices.theme == theme)) {
      state_.choices.theme = theme;
    }
    panels::recordWidget(ui, place);
  }
}

void PanelWindows::presentModes(PanelContext& ui) {
  const DeviceView& device = ui.view.device;
  for (size_t i = 0; i < device.presentModes.size(); ++i) {
    const std::string& name = device.presentModes[i];
    if (i > 0) {
      ImGui::SameLine();
    }
    if (ImGui::RadioButton(name.c_str(), device.presentMode == i)) {
      ui.send(SetPresentMode{i});
    }
    panels::recordWidget(ui, "present." + name);
    panels::tip(
        "fifo waits for the screen and never tears; mailbox shows the newest picture at each refresh;\n"
        "immediate shows pictures at once and may tear");
  }
}

void PanelWindows::sideWindows(PanelContext& ui) {
  const auto window = [&](const char* name, bool& open, const glm::vec2& ems, const auto& content) {
    if (open) {
      ImGui::SetNextWindowBgAlpha(1.0f);  // opaque, because figures over the picture are hard to read
      if (dock_.begin(name, &open, PanelDock::Edge::right, ems)) {
        content();
      }
      ImGui::End();
    }
  };
  PanelChoices& choices = state_.choices;
  window("Scenes", choices.scenes, {24.2f, 46.5f}, [&] { panels::gallery(ui, thumbnails_); });
  window("Performance", choices.performance, {27.0f, 22.0f}, [&] { panels::performance(ui); });
  window("Accuracy", choices.accuracy, {27.0f, 36.0f}, [&] { panels::accuracy(ui); });
  window("Device", choices.device, {27.0f, 30.0f}, [&] { panels::device(ui); });
  window("Log", choices.log, {27.0f, 14.0f}, [&] { panels::log(ui); });
  targetsWindow(ui);
  if (choices != savedChoices_) {
    savedChoices_ = choices;
    savePanelChoices(choices);
  }
}

// The window has no background, because the renderer draws the target below it: this version of ImGui's Vulkan backend
// draws no texture but its font.
void PanelWindows::targetsWindow(PanelContext& ui) {
  bool& open = state_.choices.targets;
  if (open) {
    constexpr ImGuiWindowFlags flags =
        ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
    if (dock_.begin("Targets", &open, PanelDock::Edge::right, {27.0f, 22.0f}, flags)) {
      panels::targets(ui);
    }
    ImGui::End();
  }
  if (!open) {
    state_.targets.path.reset();
    ui.output.target.reset();
  }
}

void PanelWindows::toggleHelp() {
  state_.help = !state_.help;
  visible_ = visible_ || state_.help;
}

void PanelWindows::toggleInspector() {
  state_.inspector = !state_.inspector;
  state_.focusNodes = state_.inspector;
  visible_ = visible_ || state_.inspector;
}

bool PanelWindows::closeTop() {
  const auto close = [&](const ImGuiWindow& window) {
    const std::string_view name = window.Name;
    const auto panel =
        std::find_if(panelNames.begin(), panelNames.end(), [&](const PanelName& p) { return p.name == name; });
    bool* open = name == panels::helpTitle        ? &state_.help
                 : name == panels::inspectorTitle ? &state_.inspector
                 : panel != panelNames.end()      ? &(state_.choices.*panel->open)
                 : name == "Dear ImGui Demo"      ? &showDemoWindow_
                                                  : nullptr;
    return open && window.Active && !window.Hidden && std::exchange(*open, false);
  };
  const ImVector<ImGuiWindow*>& windows = ImGui::GetCurrentContext()->WindowsFocusOrder;  // the last one is the top
  for (int i = windows.Size - 1; visible_ && i >= 0; --i) {
    if (close(*windows[i])) {
      return true;
    }
  }
  return false;
}

}  // namespace speculum
