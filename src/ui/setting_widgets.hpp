#pragma once

#include "frame/setting_fields.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

// A list to choose from. True if the user chose another of `names`.
bool choice(const char* label, int& index, std::span<const std::string> names);
// Colours are linear in the program and sRGB in the widget, as users know them from other programs. `flags` are Dear
// ImGui's.
bool colorEdit(const char* label, glm::dvec3& linear, int flags = 0);

// The widget that a setting's description asks for. True if it changed the value. `background` (linear) is shown for a
// colour that is not set. Texts have no widget.
bool settingWidget(const SettingField& field, Settings& settings, const glm::dvec3& background);

// A row for each setting whose key begins with `prefix`, but for those whose need is not met.
void settingRows(PanelContext& ui, std::string_view prefix);

}  // namespace speculum::panels
