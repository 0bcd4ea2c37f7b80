#pragma once

#include "ui/panels.hpp"

namespace speculum::panels {

// Draws rows for the fields of a node, from their descriptions in scene/scene_fields.hpp. Returns true if the user
// changed a field.
bool fieldRows(PanelContext& ui, SceneNode& node);

}  // namespace speculum::panels
