#pragma once

#include "frame/setting_fields.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

// Draws a drop-down list. Returns true if the user chose another of `names`.
bool choice(const char* label, int& index, std::span<const std::string> names);
// Linear numbers, as files have them, up to `most`, and a swatch that opens a picker.
bool colorEdit(const char* label, glm::dvec3& linear, double most);

// The widget that a setting's description asks for. True if it changed the value. `background` (linear) is shown for a
// color that is not set; of counts of samples only those of the device are offered. Texts have no widget.
bool settingWidget(const SettingField& field, Settings& settings, const glm::dvec3& background,
                   std::span<const int> samples);

// Draws a row for each setting whose key begins with `prefix`, except those whose need is not met.
void settingRows(PanelContext& ui, std::string_view prefix);

}  // namespace speculum::panels
