#pragma once

#include "core/renderer.hpp"
#include "ui/shown.hpp"

namespace speculum {

std::string vulkanVersion(uint32_t version);

// Describes the renderer's device for the device panel.
ShownDevice shownDevice(const Renderer& renderer, const Device& device);

}  // namespace speculum
