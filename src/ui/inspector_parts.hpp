#pragma once

#include "ui/ui_model.hpp"

namespace speculum::panels {

// A button that asks for something; greyed out while there is nothing to do. Its place is noted as "edit.KEY".
void actionButton(UiModel& model, const char* label, const char* key, EditAction action, bool enabled,
                  const std::string& tip);
// What the inspector is made of, within its window.
void selectedThing(UiModel& model);
// Windows over all others, while something is asked.
void questions(UiModel& model);

}  // namespace speculum::panels
