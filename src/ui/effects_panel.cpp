#include <imgui.h>

#include "ui/panels.hpp"

namespace speculum::panels {

void effects(PanelContext& ui) {
  int called = 0;
  for (const EffectView& effect : ui.view.frame.effects) {
    called += effect.calledFor;
  }
  const std::string title = "Effects (" + std::to_string(called) + " in use)###effects";
  if (!ImGui::CollapsingHeader(title.c_str())) {
    return;
  }
  settingRows(ui, "effects.");
  if (!ui.view.frame.rays.empty()) {
    ImGui::TextWrapped("%s", ui.view.frame.rays.c_str());
  }
  if (!ImGui::BeginTable("effects", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
    return;
  }
  const float em = ImGui::GetFontSize();
  ImGui::TableSetupColumn("Effect", ImGuiTableColumnFlags_WidthFixed, 7.0f * em);
  ImGui::TableSetupColumn("Needed by", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("Draws", ImGuiTableColumnFlags_WidthFixed, 3.4f * em);
  ImGui::TableSetupColumn("MiB", ImGuiTableColumnFlags_WidthFixed, 3.4f * em);
  ImGui::TableHeadersRow();
  for (const EffectView& effect : ui.view.frame.effects) {
    const bool on = effect.calledFor;
    ImGui::TableNextRow();
    for (const std::string& text : {effect.name, effect.why, on ? std::to_string(effect.draws) : std::string(),
                                    on ? mebibytes(effect.bytes) : std::string()}) {
      ImGui::TableNextColumn();
      ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetColorU32(on ? ImGuiCol_Text : ImGuiCol_TextDisabled));
      ImGui::TextWrapped("%s", text.c_str());
      ImGui::PopStyleColor();
      if (on) {
        tip(std::to_string(effect.pipelines) + " pipelines");
      }
    }
  }
  ImGui::EndTable();
}

}  // namespace speculum::panels
