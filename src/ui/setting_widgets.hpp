#pragma once

#include "frame/setting_fields.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

// The widget that a setting's description asks for. True if it changed the value. `background` (linear) is shown for a
// colour that is not set. Texts have no widget.
bool settingWidget(const SettingField& field, Settings& settings, const glm::dvec3& background);

// A row for each setting whose key begins with `prefix`, but for those whose need is not met.
void settingRows(PanelContext& ui, std::string_view prefix);

}  // namespace speculum::panels
