#include <imgui.h>

#include <algorithm>
#include <string_view>

#include "ui/input_map.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr const char* layoutHelp =
    "W A S D Q E go by their place on an American keyboard, all other keys by what is printed on them.\n"
    "A shortcut printed on one of those six, as , and . with Dvorak, stays where an American keyboard has it.";

void helpTable(const char* title, std::span<const Shortcut> rows) {
  ImGui::TextDisabled("%s", title);
  const float em = ImGui::GetFontSize();
  const float keysWidth = 11.5f * em;
  const float textWidth =
      std::clamp(0.5f * ImGui::GetIO().DisplaySize.x - keysWidth - 4.0f * em, 12.0f * em, 30.0f * em);
  constexpr ImGuiTableFlags flags =
      ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoHostExtendX;
  if (!ImGui::BeginTable(title, 2, flags)) {
    return;
  }
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, keysWidth);
  ImGui::TableSetupColumn("help", ImGuiTableColumnFlags_WidthFixed, textWidth);
  for (const Shortcut& row : rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.keys);
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", row.help);
  }
  ImGui::EndTable();
  ImGui::Spacing();
}

}  // namespace

void help(PanelContext& ui) {
  if (!ui.state.help) {
    return;
  }
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowBgAlpha(1.0f);  // opaque, because it lies over other text
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, ImGui::GetIO().DisplaySize);
  if (ImGui::Begin(helpTitle, &ui.state.help, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    for (const bool right : {false, true}) {
      if (right) {
        ImGui::SameLine(0.0f, 2.0f * ImGui::GetFontSize());
      }
      ImGui::BeginGroup();
      for (const ShortcutGroup& group : shortcutGroups()) {
        if ((std::string_view(group.name) == "Edit") == right) {
          helpTable(group.name, group.shortcuts);
        }
      }
      if (right) {
        helpTable("Gamepad", gamepadHelp());
      }
      ImGui::EndGroup();
    }
    ImGui::TextDisabled("%s", layoutHelp);
  }
  ImGui::End();
}

}  // namespace speculum::panels
