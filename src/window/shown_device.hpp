#pragma once

#include "core/renderer.hpp"
#include "ui/shown.hpp"

namespace speculum {

// Returns a Vulkan version as text, such as "1.3.0".
std::string vulkanVersion(uint32_t version);

// Describes the renderer's device for the device panel.
ShownDevice shownDevice(const Renderer& renderer, const Device& device);

}  // namespace speculum
