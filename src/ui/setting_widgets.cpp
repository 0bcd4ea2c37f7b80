#include "ui/setting_widgets.hpp"

#include <imgui.h>

#include <algorithm>
#include <bit>

#include "image/color.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

struct Widget {
  const SettingField& field;
  Settings& settings;
  const glm::dvec3& background;

  ImGuiSliderFlags flags() const {
    return ImGuiSliderFlags_AlwaysClamp | (field.slider->logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  }

  bool operator()(const NumberSetting& number) const {
    double& value = number.value.of(settings);
    if (!field.slider) {
      return ImGui::InputDouble(field.label, &value, 0.0, 0.0, "%.4f", ImGuiInputTextFlags_EnterReturnsTrue);
    }
    float edited = static_cast<float>(value);
    const bool changed = ImGui::SliderFloat(field.label, &edited, static_cast<float>(field.slider->low),
                                            static_cast<float>(field.slider->high), field.slider->format, flags());
    value = changed ? edited : value;
    return changed;
  }

  // Unchecked means "auto": the device's value.
  bool operator()(const AutomaticSetting& number) const {
    std::optional<double>& value = number.value.of(settings);
    bool zero = value == 0.0;
    const bool changed = ImGui::Checkbox(field.label, &zero);
    if (changed) {
      value = zero ? std::optional(0.0) : std::nullopt;
    }
    return changed;
  }

  bool operator()(const IntegerSetting& integer) const {
    int& value = integer.value.of(settings);
    if (!integer.powersOfTwo) {
      const SettingSlider slider = *field.slider;
      return ImGui::SliderInt(field.label, &value, static_cast<int>(slider.low), static_cast<int>(slider.high),
                              slider.format, flags());
    }
    std::vector<std::string> names;
    for (int power = integer.low; power <= integer.high; power *= 2) {
      names.push_back(std::to_string(power));
    }
    int index = std::countr_zero(static_cast<unsigned>(value)) - std::countr_zero(static_cast<unsigned>(integer.low));
    const bool changed = choice(field.label, index, names);
    value = integer.low << index;
    return changed;
  }

  bool operator()(const BooleanSetting& boolean) const {
    return ImGui::Checkbox(field.label, &boolean.value.of(settings));
  }

  bool operator()(const ChoiceSetting& setting) const {
    std::vector<std::string> names(setting.names.begin(), setting.names.end());
    for (std::string& name : names) {
      std::ranges::replace(name, '_', ' ');
    }
    int index = setting.get(settings);
    const bool changed = choice(field.label, index, names);
    setting.set(settings, index);
    return changed;
  }

  bool operator()(const ColorSetting& color) const {
    std::optional<glm::dvec3>& value = color.value.of(settings);
    glm::dvec3 linear = value.value_or(background);
    const bool changed = colorEdit(field.label, linear);
    value = changed ? linear : value;
    return changed;
  }

  bool operator()(const TextSetting&) const { return false; }
};

}  // namespace

bool choice(const char* label, int& index, std::span<const std::string> names) {
  const int before = index;
  if (ImGui::BeginCombo(label, names[index].c_str())) {
    for (int i = 0; i < static_cast<int>(names.size()); ++i) {
      if (ImGui::Selectable(names[i].c_str(), i == index)) {
        index = i;
      }
    }
    ImGui::EndCombo();
  }
  return index != before;
}

bool colorEdit(const char* label, glm::dvec3& linear, int flags) {
  glm::vec3 encoded;
  for (int i = 0; i < 3; ++i) {
    encoded[i] = static_cast<float>(srgbEncode(std::clamp(linear[i], 0.0, 1.0)));
  }
  const bool changed = ImGui::ColorEdit3(label, &encoded.x, flags);
  for (int i = 0; changed && i < 3; ++i) {
    linear[i] = srgbDecode(encoded[i]);
  }
  return changed;
}

bool settingWidget(const SettingField& field, Settings& settings, const glm::dvec3& background) {
  ImGui::PushID(field.key.data(), field.key.data() + field.key.size());
  const bool changed = std::visit(Widget{field, settings, background}, field.kind);
  ImGui::PopID();
  return changed;
}

void settingRows(PanelContext& ui, std::string_view prefix) {
  for (const SettingField& field : settingFields()) {
    const bool needed = !field.needs || settingValue(ui.settings, field.needs->key) == field.needs->value;
    if (needed && field.key.starts_with(prefix) && !std::holds_alternative<TextSetting>(field.kind)) {
      settingWidget(field, ui.settings, glm::dvec3(ui.view.settings.background));
      describe(ui, field.key);
    }
  }
}

}  // namespace speculum::panels
