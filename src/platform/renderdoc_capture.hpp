#pragma once

#include <filesystem>
#include <functional>

namespace speculum {

// Calls `draw` and writes the Vulkan calls that it makes into a file for RenderDoc. RenderDoc must have been loaded
// when the Vulkan instance was created. Throws std::runtime_error if RenderDoc is not loaded or cannot write the file.
void captureWithRenderDoc(const std::filesystem::path& file, const std::function<void()>& draw);

}  // namespace speculum
