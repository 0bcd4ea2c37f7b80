#pragma once

#include "core/renderer.hpp"
#include "ui/views.hpp"

namespace speculum {

// Describes the renderer's device for the device panel.
DeviceView deviceView(const Renderer& renderer, const Device& device);

}  // namespace speculum
