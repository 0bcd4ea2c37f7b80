#include <imgui.h>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

// Returns how to call for an effect that is switched on, if the inspector does that.
std::string howToAsk(EffectKind kind) {
  switch (kind) {
    case EffectKind::shadows:
      return " (Inspector, light: Casts shadow)";
    case EffectKind::roughness:
      return " (Inspector, mirror: Roughness)";
    case EffectKind::ripple:
      return " (Inspector, mirror: Ripple)";
    case EffectKind::castsLight:
      return " (Inspector, mirror: Casts light)";
    case EffectKind::curved:
      return " (Inspector, object: Mirror)";
    default:
      return "";
  }
}

}  // namespace

void effects(PanelContext& ui) {
  int called = 0;
  for (const EffectRow& effect : ui.input.frame.effects) {
    called += effect.calledFor;
  }
  const std::string title = "Effects (" + std::to_string(called) + " in use)###effects";
  if (!section(ui, "effects", title, ui.state.choices.effectsSection)) {
    return;
  }
  settingRows(ui, "effects.");
  if (!ui.input.frame.rays.empty()) {
    wrappedText(ui.input.frame.rays);
  }
  const float em = ImGui::GetFontSize();
  const bool narrow = ImGui::GetContentRegionAvail().x < 22.0f * em;  // then figures would leave no room for words
  const ImGuiTableColumnFlags figures =
      ImGuiTableColumnFlags_WidthFixed | (narrow ? ImGuiTableColumnFlags_Disabled : ImGuiTableColumnFlags_None);
  if (!ImGui::BeginTable("effects", 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
    return;
  }
  ImGui::TableSetupColumn("Effect", ImGuiTableColumnFlags_WidthFixed, 7.0f * em);
  ImGui::TableSetupColumn("Needed by", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("Draws", figures, 3.4f * em);
  ImGui::TableSetupColumn("MiB", figures, 3.4f * em);
  ImGui::TableHeadersRow();
  for (const EffectRow& effect : ui.input.frame.effects) {
    const bool on = effect.calledFor;
    ImGui::TableNextRow();
    for (const std::string& text :
         {effect.name, effect.why + (on || effect.switchedOff ? "" : howToAsk(effect.kind)),
          on ? std::to_string(effect.draws) : std::string(), on ? mebibytes(effect.bytes) : std::string()}) {
      ImGui::TableNextColumn();
      if (!on) {
        dimmedText(text);
      } else {
        wrappedText(text);
        tip(std::to_string(effect.pipelines) + (effect.pipelines == 1 ? " pipeline" : " pipelines"));
      }
    }
  }
  ImGui::EndTable();
}

}  // namespace speculum::panels
