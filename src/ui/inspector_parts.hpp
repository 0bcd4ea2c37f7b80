#pragma once

#include "ui/ui_model.hpp"

namespace speculum::panels {

// What the inspector is made of, within its window.
void selectedThing(UiModel& model);
// Windows over all others, while something is asked.
void questions(UiModel& model);

}  // namespace speculum::panels
