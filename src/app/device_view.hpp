#pragma once

#include "core/renderer.hpp"
#include "ui/views.hpp"

namespace speculum {

std::string vulkanVersion(uint32_t version);

// Describes the renderer's device for the device panel.
DeviceView deviceView(const Renderer& renderer, const Device& device);

}  // namespace speculum
