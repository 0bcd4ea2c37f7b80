#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_versions.hpp>

#include <algorithm>
#include <cmath>

#include "image/image.hpp"
#include "settings/setting_fields.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr double brightest = 65504.0;  // largest value in 16-bit float targets

// Draws the widget that a setting's description asks for. A setting that is a text has none.
struct Widget {
  const SettingField& field;
  Settings& settings;
  glm::dvec3 background;         // linear; shown for a color that is not set
  std::span<const int> samples;  // that the device has; no others are offered

  ImGuiSliderFlags flags() const {
    return ImGuiSliderFlags_AlwaysClamp | (field.slider->logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  }

  std::string label() const { return labelFor(field.label, 5.0f * ImGui::GetFontSize()); }

  // Moves the slider by its last digit if an arrow key did not move it: Dear ImGui moves a slider by a share of its
  // length, which is less than a digit at the low end of 1 .. 1024. Returns the value.
  template <typename T>
  T moveByKey(T& value, T before) const {
    const int steps = imgui::isPressed(ImGuiKey_RightArrow) - imgui::isPressed(ImGuiKey_LeftArrow);
    if (value == before && ImGui::IsItemActive() && steps != 0) {
      const double step = std::pow(10.0, -ImParseFormatPrecision(field.slider->format, 0));
      value = static_cast<T>(std::clamp(value + steps * step, field.slider->low, field.slider->high));
      ImGui::GetCurrentContext()->SliderCurrentAccum = 0.0f;  // else Dear ImGui adds up what it did not move
    }
    return value;
  }

  void operator()(const NumberSetting& number) const {
    double& value = number.value.of(settings);
    if (!field.slider) {
      if (ImGui::InputDouble(label().c_str(), &value, 0.0, 0.0, "%.4f", ImGuiInputTextFlags_EnterReturnsTrue)) {
        value = std::clamp(value, number.low, number.high);
      }
      return;
    }
    const float before = static_cast<float>(value);
    float edited = before;
    ImGui::SliderFloat(label().c_str(), &edited, static_cast<float>(field.slider->low),
                       static_cast<float>(field.slider->high), field.slider->format, flags());
    if (moveByKey(edited, before) != before) {
      value = std::round(1e6 * edited) / 1e6;  // files show the digits that the slider does
    }
  }

  // Unchecked means "auto": the device's value.
  void operator()(const AutomaticSetting& number) const {
    std::optional<double>& value = number.value.of(settings);
    bool zero = value == 0.0;
    if (ImGui::Checkbox(field.label, &zero)) {
      value = zero ? std::optional(0.0) : std::nullopt;
    }
  }

  void operator()(const IntegerSetting& integer) const {
    int& value = integer.value.of(settings);
    if (!integer.powersOfTwo) {
      const int before = value;
      ImGui::SliderInt(label().c_str(), &value, static_cast<int>(field.slider->low),
                       static_cast<int>(field.slider->high), field.slider->format, flags());
      moveByKey(value, before);
      return;
    }
    const bool ofDevice = field.key.ends_with(".samples");
    std::vector<int> powers;
    std::vector<std::string> names;
    if (integer.automatic) {
      powers.push_back(0);
      names.emplace_back("auto");
    }
    for (int power = integer.low; power <= integer.high; power *= 2) {
      const bool offered = !ofDevice || std::ranges::count(samples, power) > 0;
      if (offered || power == value) {
        powers.push_back(power);
        names.push_back(std::to_string(power) + (offered ? "" : " (not on this device)"));
      }
    }
    int index = static_cast<int>(std::ranges::find(powers, value) - powers.begin());
    choice(field.label, index, names);
    value = powers[static_cast<size_t>(index)];
  }

  void operator()(const BooleanSetting& boolean) const { ImGui::Checkbox(field.label, &boolean.value.of(settings)); }

  void operator()(const ChoiceSetting& setting) const {
    std::vector<std::string> names(setting.names.begin(), setting.names.end());
    for (std::string& name : names) {
      std::ranges::replace(name, '_', ' ');
    }
    int index = setting.get(settings);
    choice(field.label, index, names);
    setting.set(settings, index);
  }

  void operator()(const ColorSetting& color) const {
    std::optional<glm::dvec3>& value = color.value.of(settings);
    glm::dvec3 linear = value.value_or(background);
    if (colorEdit(field.label, linear, brightest)) {
      value = linear;
    }
  }

  void operator()(const TextSetting&) const {}
};

}  // namespace

bool choice(const char* label, int& index, std::span<const std::string> names) {
  const int before = index;
  float widest = 0.0f;
  for (const std::string& name : names) {
    widest = std::max(widest, textWidth(name));
  }
  const float width = widest + ImGui::GetFrameHeight() + 2.0f * ImGui::GetStyle().FramePadding.x;
  if (ImGui::BeginCombo(labelFor(label, width).c_str(), names[index].c_str())) {
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
      if (ImGui::Selectable(names[i].c_str(), i == index)) {
        index = i;
      }
    }
    ImGui::EndCombo();
  }
  return index != before;
}

bool colorEdit(const char* label, glm::dvec3& linear, double most) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const double least = 0.0;
  glm::vec3 picked;
  for (int i = 0; i < 3; ++i) {
    picked[i] = static_cast<float>(srgbEncode(std::clamp(linear[i], 0.0, 1.0)));
  }
  const float swatch = ImGui::GetFrameHeight() + style.ItemInnerSpacing.x;
  std::string words = label;  // "Color (linear)", "Reflectance (tint, linear)"
  words.ends_with(')') ? words.insert(words.size() - 1, ", linear") : words.append(" (linear)");
  const std::string shown = labelFor(words, swatch + 9.5f * ImGui::GetFontSize());
  ImGui::BeginGroup();
  ImGui::PushID(label);
  ImGui::SetNextItemWidth(ImGui::CalcItemWidth() - swatch);
  bool changed = ImGui::DragScalarN("##numbers", ImGuiDataType_Double, &linear.x, 3, 0.002f, &least, &most, "%.3f",
                                    ImGuiSliderFlags_AlwaysClamp);
  ImGui::SameLine(0.0f, style.ItemInnerSpacing.x);
  if (ImGui::ColorButton("##swatch", {picked.x, picked.y, picked.z, 1.0f}, ImGuiColorEditFlags_NoTooltip)) {
    ImGui::OpenPopup("picker");
  }
  tip("Opens a picker. It shows display colors (sRGB); the numbers beside it are linear.");
  if (ImGui::BeginPopup("picker")) {
    // A color of at most 1 is a share of light, such as a reflectance.
    ImGui::TextUnformatted(most > 1.0 ? "sRGB, before exposure and tone curve" : "sRGB");
    if (ImGui::ColorPicker3("##picker", &picked.x, ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_Float)) {
      for (int i = 0; i < 3; ++i) {
        linear[i] = std::round(srgbDecode(picked[i]) * 1e4) / 1e4;
      }
      changed = true;
    }
    ImGui::EndPopup();
  }
  ImGui::SameLine(0.0f, style.ItemInnerSpacing.x);
  ImGui::TextUnformatted(shown.c_str(), ImGui::FindRenderedTextEnd(shown.c_str()));
  ImGui::PopID();
  ImGui::EndGroup();
  return changed;
}

void settingWidget(const PanelContext& ui, const SettingField& field, Settings& settings) {
  const glm::dvec3& background = ui.input.edit.scene->environment.background;
  std::visit(Widget{field, settings, background, ui.input.device.samples}, field.kind);
}

void settingRows(PanelContext& ui, std::string_view prefix) {
  const Environment& environment = ui.input.edit.scene->environment;
  for (const SettingField& field : settingFields()) {
    const bool needed =
        !field.needs || (settingValue(ui.settings, field.needs->key) == field.needs->value) != field.needs->isOther;
    if (needed && field.key.starts_with(prefix) && !std::holds_alternative<TextSetting>(field.kind)) {
      ImGui::PushID(field.key.data(), field.key.data() + field.key.size());
      settingWidget(ui, field, ui.settings);
      ImGui::PopID();
      describe(ui, field.key);
      if (field.key == "view.clear_color" && environment.sky && !ui.settings.view.clearColor) {
        dimmedText("Not in use: the scene has a sky. A color that you choose replaces it.");
      }
      if (field.key == "view.clear_color" && ui.settings.view.clearColor &&
          button(ui, "Use the scene's background", "view.scene_background",
                 "Shows the scene's sky or background again.")) {
        ui.settings.view.clearColor.reset();
      }
    }
  }
}

}  // namespace speculum::panels
