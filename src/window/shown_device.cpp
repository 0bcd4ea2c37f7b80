#include "window/shown_device.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>

#include "session/session_subject.hpp"

namespace speculum {

namespace {

std::string kindName(VkPhysicalDeviceType type) {
  constexpr std::array names{"other", "integrated GPU", "discrete GPU", "virtual GPU", "CPU"};  // in Vulkan's order
  return names[static_cast<size_t>(type)];
}

FeatureRow feature(const char* name, bool present, const char* without) {
  return {name, present, present ? "yes" : without};
}

}  // namespace

std::string vulkanVersion(uint32_t version) {
  return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                     VK_API_VERSION_PATCH(version));
}

ShownDevice shownDevice(const Renderer& renderer, const Device& device) {
  const DeviceInfo& info = device.info();
  const DeviceCaps& caps = device.caps();
  ShownDevice view{.name = info.name,
                   .kind = kindName(info.type),
                   .driver = info.driver,
                   .vulkan = vulkanVersion(info.apiVersion),
                   .renderPath = std::string(renderPathName(device.renderPath())),
                   .samples = sampleCountsOf(device)};
  view.features = {feature("dynamic rendering", caps.dynamicRendering, "render passes are used"),
                   feature("timestamps", caps.timestampValidBits > 0, "no times of passes"),
                   feature("pipeline statistics", caps.pipelineStatistics, "no triangles and fragments"),
                   feature("precise occlusion", caps.countsSamples, "samples drawn are not counted"),
                   feature("geometry shaders", caps.primitiveId, "no effect that traces rays"),
                   feature("sample shading", caps.sampleRateShading, "samples share a shading"),
                   feature("depth clamp", caps.depthClamp, "the near plane cuts"),
                   feature("wireframe", caps.fillModeNonSolid, "no wireframe"),
                   feature("wide lines", caps.wideLines, "wireframe is one pixel wide"),
                   feature("anisotropic filter", caps.anisotropy, "textures are filtered trilinearly"),
                   feature("dynamic polygon mode", caps.dynamicPolygonMode, "wireframe has pipelines of its own"),
                   feature("ray queries", caps.rayQueries, "shaders trace all rays"),
                   feature("memory budget", caps.memoryBudget, "the size of the heaps is used")};
  if (!renderer.headless()) {
    view.features.push_back(
        feature("UNORM surface", !renderer.copiesDisplay(), "sRGB only: pictures are copied into it"));
  }
  const std::vector<PresentMode> modes = renderer.presentModes();
  for (const PresentMode mode : modes) {
    view.presentModes.emplace_back(presentModeName(mode));
  }
  const auto mode = std::ranges::find(modes, renderer.presentMode());
  view.presentMode = static_cast<size_t>(mode - modes.begin());
  return view;
}

}  // namespace speculum
