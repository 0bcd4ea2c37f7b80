#pragma once

#include "ui/panels.hpp"

namespace speculum::panels {

// Fields of the selected node, within the inspector's window.
void selectedNode(PanelContext& ui);

}  // namespace speculum::panels
