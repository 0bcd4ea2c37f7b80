#include <imgui.h>

#include <algorithm>
#include <string_view>

#include "ui/input_map.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr const char* layoutHelp =
    "W A S D Q E: by position, as on a US keyboard. All other keys: by what is printed on them.";
constexpr float keysEms = 11.5f;  // widths of the columns, in sizes of the font
constexpr float helpEms = 30.0f;
constexpr float leastHelpEms = 14.0f;
constexpr float gapEms = 2.0f;

void helpTable(const char* title, std::span<const Shortcut> rows, float textWidth) {
  ImGui::TextDisabled("%s", title);
  constexpr ImGuiTableFlags flags =
      ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoHostExtendX;
  if (!ImGui::BeginTable(title, 2, flags)) {
    return;
  }
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, keysEms * ImGui::GetFontSize());
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
  const float em = ImGui::GetFontSize();
  const float menus = ImGui::GetFrameHeight();
  const ImVec2 room(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y - menus);
  const float width = room.x - 2.0f * ImGui::GetStyle().WindowPadding.x - ImGui::GetStyle().ScrollbarSize;
  const float least = (keysEms + leastHelpEms) * em;
  const bool two = width >= 2.0f * least + gapEms * em;
  const float column = two ? 0.5f * (width - gapEms * em) : width;
  const float text = std::clamp(column - (keysEms + 1.0f) * em, 4.0f * em, helpEms * em);
  ImGui::SetNextWindowPos({0.5f * room.x, menus + 0.5f * room.y}, ImGuiCond_Appearing, {0.5f, 0.5f});
  ImGui::SetNextWindowBgAlpha(1.0f);  // opaque, because it lies over other text
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, room);
  if (ImGui::Begin(helpTitle, &ui.state.help, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    const ImVec2 size = ImGui::GetWindowSize();
    const ImVec2 corner = ImGui::GetWindowPos();
    const WindowRect fit = fitWindow({{corner.x, corner.y - menus}, {size.x, size.y}}, {room.x, room.y});
    ImGui::SetWindowPos({fit.corner.x, fit.corner.y + menus});
    for (const bool right : {false, true}) {
      if (right && two) {
        ImGui::SameLine(0.0f, gapEms * em);
      }
      ImGui::BeginGroup();
      for (const ShortcutGroup& group : shortcutGroups()) {
        const std::string_view name = group.name;
        if ((name == "Edit" || name == "Capture") == right) {
          helpTable(group.name, group.shortcuts, text);
        }
      }
      if (right) {
        helpTable("Gamepad", gamepadHelp(), text);
      }
      ImGui::EndGroup();
      recordWidget(ui, right ? "help.right" : "help.left");
    }
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + (two ? 2.0f : 1.0f) * (keysEms * em + text));
    ImGui::TextDisabled("%s", layoutHelp);
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

}  // namespace speculum::panels
