#include <imgui.h>

#include <bit>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

void effectSwitch(UiModel& model, const char* label, bool& on, std::string_view key) {
  ImGui::Checkbox(label, &on);
  describe(model, key);
}

void environmentMaps(UiModel& model, EffectSettings& e) {
  int lookup = static_cast<int>(e.curvedLookup);
  ImGui::Combo("curved look-up", &lookup, "traced\0environment map\0");
  e.curvedLookup = static_cast<CurvedLookup>(lookup);
  describe(model, "effects.curved_lookup");
  if (e.curvedLookup != CurvedLookup::environment) {
    return;
  }
  int power = std::bit_width(static_cast<unsigned>(e.environmentSize)) - 1;
  ImGui::SliderInt("map size", &power, 4, 10, std::to_string(e.environmentSize).c_str(), ImGuiSliderFlags_AlwaysClamp);
  e.environmentSize = 1 << power;
  describe(model, "effects.environment_size");
  ImGui::SliderInt("map interval", &e.environmentInterval, 1, 60, "%d", ImGuiSliderFlags_AlwaysClamp);
  describe(model, "effects.environment_interval");
  effectSwitch(model, "map of a box", e.environmentBox, "effects.environment_box");
}

void switches(UiModel& model) {
  EffectSettings& e = model.settings.effects;
  effectSwitch(model, "shadows", e.shadows, "effects.shadows");
  effectSwitch(model, "ripples", e.ripple, "effects.ripple");
  effectSwitch(model, "bounced light", e.castsLight, "effects.casts_light");
  effectSwitch(model, "roughness", e.roughness, "effects.roughness");
  effectSwitch(model, "curved mirrors", e.curved, "effects.curved");
  environmentMaps(model, e);
  effectSwitch(model, "Fresnel", e.fresnel, "effects.fresnel");
  effectSwitch(model, "textures", e.textures, "effects.textures");
  effectSwitch(model, "glowing lights", e.glyphs, "effects.glyphs");
  effectSwitch(model, "rays at every sample", e.perSample, "effects.per_sample");
  int lookup = static_cast<int>(e.roughLookup);
  ImGui::Combo("rough look-up", &lookup, "traced\0image\0");
  e.roughLookup = static_cast<RoughLookup>(lookup);
  describe(model, "effects.rough_lookup");
  ImGui::SliderInt("rough samples", &e.roughSamples, 1, 256, "%d",
                   ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
  describe(model, "effects.rough_samples");
}

std::string mebibytes(uint64_t bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", static_cast<double>(bytes) / (1024.0 * 1024.0));
  return text;
}

}  // namespace

void effects(UiModel& model) {
  int called = 0;
  for (const UiEffect& effect : model.effects) {
    called += effect.calledFor;
  }
  const std::string title = "Effects (" + std::to_string(called) + " called for)###effects";
  if (!ImGui::CollapsingHeader(title.c_str())) {
    return;
  }
  switches(model);
  if (!ImGui::BeginTable("effects", 5, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
    return;
  }
  for (const char* column : {"effect", "called for by", "draws", "MiB", "pipelines"}) {
    ImGui::TableSetupColumn(column);
  }
  ImGui::TableHeadersRow();
  for (const UiEffect& effect : model.effects) {
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
