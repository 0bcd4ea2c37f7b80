// The menus at the window's top, except the one that opens panels.
#include <imgui.h>
#include <spdlog/fmt/fmt.h>

#include <cfloat>

#include "platform/text.hpp"
#include "ui/input_map.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

void item(PanelContext& ui, const char* label, Command command, bool enabled = true, const char* keys = nullptr) {
  const char* shortcut = keys ? keys : keysOf(command);
  if (ImGui::MenuItem(label, shortcut, false, enabled)) {
    ui.send(std::move(command));
  }
  recordWidget(ui, std::string("menu.") + label);
}

void fileMenu(PanelContext& ui) {
  item(ui, "New", NewScene{});
  item(ui, "Open...", AskWhatToOpen{});
  // A list that does not fit beside this menu would cover it, so that the click that opens the list chose a file.
  const ImGuiStyle& style = ImGui::GetStyle();
  const float right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth() + style.DisplaySafeAreaPadding.x;
  const float frame = 2.0f * (style.WindowPadding.x + style.ItemSpacing.x + ImGui::GetFontSize());  // and a mark
  const float beside = ImGui::GetIO().DisplaySize.x - right - frame;
  const std::vector<std::filesystem::path>& recent = ui.input.browser.recent;
  if (menu(ui, "Open recent", !recent.empty())) {
    for (const std::filesystem::path& file : recent) {
      ImGui::PushID(file.string().c_str());  // cut names may repeat
      item(ui, endsThatFit(oneLine(file.string()), beside, textWidth).c_str(), OpenScene{file}, true, "");
      ImGui::PopID();
      tip(file.string());
    }
    ImGui::EndMenu();
  }
  ImGui::Separator();
  const ShownEdit& edit = ui.input.edit;
  item(ui, "Save", Save{}, edit.canSave());
  item(ui, "Save as...", AskWhereToSave{});
  ImGui::Separator();
  item(ui, "Save picture", TakeScreenshot{false});
  item(ui, "Save picture with panels", TakeScreenshot{true});
  const bool records = ui.input.recording;
  item(ui, records ? "Stop recording" : "Record frames", ToggleRecording{false});
  item(ui, "Record frames with panels", ToggleRecording{true}, !records);
  item(ui, "Copy command line", CopyCommandLine{});
  ImGui::Separator();
  item(ui, "Quit", Quit{});
}

void editMenu(PanelContext& ui) {
  const ShownEdit& edit = ui.input.edit;
  const auto labelled = [](const char* verb, const std::string& step) {
    return step.empty() ? std::string(verb) : std::string(verb) + " " + oneLine(step) + "###" + verb;
  };
  item(ui, labelled("Undo", edit.undo).c_str(), Undo{}, !edit.undo.empty());
  item(ui, labelled("Redo", edit.redo).c_str(), Redo{}, !edit.redo.empty());
  ImGui::Separator();
  const bool any = static_cast<bool>(edit.selected);
  item(ui, "Duplicate", DuplicateSelected{}, any);
  item(ui, "Delete", RemoveSelected{}, any);
  item(ui, "Move, rotate or scale", NextGizmoMode{}, any);
  ImGui::Separator();
  item(ui, "Add mirror", AddMirror{});
  item(ui, "Add light", AddLight{});
  if (menu(ui, "Add object")) {
    item(ui, "File...", AskWhatToAdd{});  // first, because the list may be longer than the window
    ImGui::Separator();
    for (const std::filesystem::path& model : edit.models) {
      ImGui::PushID(model.string().c_str());  // names may repeat
      item(ui, oneLine(model.stem().string()).c_str(), AddObject{model}, true, "");
      ImGui::PopID();
    }
    ImGui::EndMenu();
  }
  ImGui::Separator();
  item(ui, "Reset settings", ResetSettings{});
}

void viewMenu(PanelContext& ui) {
  item(ui, ui.input.edit.selected ? "Frame selection" : "Frame scene", FrameSelection{});
  item(ui, "Look from behind mirror", LookFromMirror{MirrorSide::back});
  item(ui, "Look out of mirror", LookFromMirror{MirrorSide::front});
  item(ui, "Reset camera", ResetCamera{});
  ImGui::Separator();
  item(ui, "Bookmark view", AddBookmark{});
  item(ui, "Next bookmark", GoToNextBookmark{}, !ui.input.edit.scene->bookmarks.empty());
  ImGui::Separator();
  const ShownSplit& split = ui.input.split;
  item(ui, split.on ? "End A | B" : "Compare settings (A | B)", ToggleSplit{});
  item(ui, "Compare with a simple mirror demo", ToggleSplit{SplitStart::naive});
  item(ui, "Compare with the picked point", ToggleSplit{SplitStart::point}, comparesPoint(ui));
  item(ui, "Edit the other half's settings", ChooseOtherHalf{}, split.on);
  ImGui::Separator();
  item(ui, ui.input.playback.paused ? "Play" : "Pause", TogglePaused{});
  item(ui, "Full screen", ToggleFullScreen{});
}

}  // namespace

bool menu(PanelContext& ui, const char* label, bool enabled) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ui.state.widgets.emplace_back(
      std::string("menu.") + label,
      PixelRect{static_cast<int>(corner.x), static_cast<int>(corner.y), static_cast<int>(ImGui::CalcTextSize(label).x),
                static_cast<int>(ImGui::GetTextLineHeight())});
  // Taller menus would cover the menu bar, so that the click that opens one chose the entry under it.
  const float others = ImGui::GetFrameHeight() + 2.0f * ImGui::GetStyle().DisplaySafeAreaPadding.y + 2.0f;
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {FLT_MAX, ImGui::GetIO().DisplaySize.y - others});
  return ImGui::BeginMenu(label, enabled);
}

void menus(PanelContext& ui) {
  for (const auto& [label, content] :
       {std::pair("File", &fileMenu), std::pair("Edit", &editMenu), std::pair("View", &viewMenu)}) {
    if (menu(ui, label)) {
      content(ui);
      ImGui::EndMenu();
    }
  }
}

// Shows the frame time at the right edge if a frame was drawn and there is room.
void frameTime(const PanelContext& ui) {
  const ShownFrame& frame = ui.input.frame;
  const double ms = frame.frameMs;
  if (ms <= 0.0) {
    return;
  }
  const char* still = ui.input.playback.paused ? "paused" : "still";
  const std::string rate = frame.still ? still : fmt::format("{:.{}f} FPS", 1000.0 / ms, ms > 100.0 ? 1 : 0);
  const std::string text = (frame.still ? "Frame " : "") + duration(ms) + "   " + rate;
  const float left = ImGui::GetWindowWidth() - ImGui::CalcTextSize(text.c_str()).x - ImGui::GetFontSize();
  if (left > ImGui::GetCursorPosX()) {
    ImGui::SetCursorPosX(left);
    ImGui::TextUnformatted(text.c_str());
  }
}

}  // namespace speculum::panels
