#include <imgui.h>

#include "ui/panels.hpp"
#include "ui/setting_widgets.hpp"

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
  if (!ImGui::BeginTable("effects", 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  for (const char* column : {"effect", "called for by", "draws", "MiB", "pipelines"}) {
    ImGui::TableSetupColumn(column);
  }
  ImGui::TableHeadersRow();
  for (const EffectView& effect : ui.view.frame.effects) {
    const bool on = effect.calledFor;
    ImGui::TableNextRow();
    for (const std::string& text :
         {effect.name, effect.why, on ? std::to_string(effect.draws) : std::string(),
          on ? mebibytes(effect.bytes) : std::string(), on ? std::to_string(effect.pipelines) : std::string()}) {
      ImGui::TableNextColumn();
      on ? ImGui::TextWrapped("%s", text.c_str()) : ImGui::TextDisabled("%s", text.c_str());
    }
  }
  ImGui::EndTable();
}

}  // namespace speculum::panels
