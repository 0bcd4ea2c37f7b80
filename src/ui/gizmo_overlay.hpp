#pragma once

#include "ui/edit_model.hpp"

namespace speculum {

// Outline and handles over the picture and below the panel, within the current ImGui frame.
void drawOverlay(const UiOverlay& overlay);

}  // namespace speculum
