#include "simple_ui.hpp"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>
#include <imgui_versions.hpp>

#include <algorithm>

#include "image/image.hpp"

namespace speculum::examples {

namespace {

constexpr float mostTurn = 1.1f;  // radians; the camera stays before the mirror

DescriptorPoolHandle createPool(Device& device) {
  return device.create(vkCreateDescriptorPool,
                       {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                        .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                        .maxSets = 16,
                        .poolSizeCount = static_cast<uint32_t>(imgui::poolSizes.size()),
                        .pPoolSizes = imgui::poolSizes.data()},
                       "panel");
}

}  // namespace

SimpleUI::SimpleUI(Renderer& renderer, Window& window)
    : renderer_(renderer), pool_(createPool(renderer.device())), idle_(renderer.device()) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().FontGlobalScale = window.contentScale();
  ImGui_ImplGlfw_InitForVulkan(window.native(), true);
  Device& device = renderer.device();
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = device.instance();
  info.PhysicalDevice = device.physical();
  info.Device = device.get();
  info.QueueFamily = device.queueFamily();
  info.Queue = device.queue();
  info.PipelineCache = renderer.pipelineCache().get();
  info.DescriptorPool = pool_.get();
  info.MinImageCount = 2;
  info.ImageCount = std::max(renderer.displayImageCount(), 3u);
  info.CheckVkResultFn = [](VkResult result) { check(result, "the panel's drawing"); };
  imgui::initVulkan(info, renderer.displayFormat(), inRenderPass() ? renderer.overlayRenderPass() : VK_NULL_HANDLE);
  imgui::uploadFonts([&](const auto& record) { renderer.uploader().run(record); });
}

SimpleUI::~SimpleUI() {
  renderer_.device().waitIdle();
  ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void SimpleUI::build(UiState& state) {
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos({12.0f, 12.0f}, ImGuiCond_FirstUseEver);
  ImGui::Begin("Frame", nullptr, ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::Text("%.2f ms, %.0f frames per second", 1000.0f / io.Framerate, io.Framerate);
  ImGui::Text("%.2f ms on the GPU", renderer_.timings().gpuMs);
  glm::vec3 shown;  // sRGB, so that the picker shows the color that is drawn
  for (int i = 0; i < 3; ++i) {
    shown[i] = static_cast<float>(srgbEncode(state.clearColor[i]));
  }
  if (ImGui::ColorEdit3("Clear color", &shown.x, ImGuiColorEditFlags_NoInputs)) {
    for (int i = 0; i < 3; ++i) {
      state.clearColor[i] = static_cast<float>(srgbDecode(shown[i]));
    }
  }
  ImGui::Checkbox("Settings", &state.settings);
  if (state.settings && state.naive) {
    ImGui::Checkbox("Naive mirror", state.naive);
  }
  if (state.settings && state.depth) {
    ImGui::SliderInt("Depth", state.depth, 0, state.mostDepth);
  }
  ImGui::End();
  if (!io.WantCaptureMouse && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f)) {
    turn_ = std::clamp(turn_ - 0.005f * io.MouseDelta.x, -mostTurn, mostTurn);
  }
  ImGui::Render();
}

bool SimpleUI::inRenderPass() const {
  return imgui::needsRenderPass || renderer_.device().renderPath() == RenderPath::renderPass;
}

void SimpleUI::record(Frame& frame) const {
  const PassScope overlay = renderer_.beginOverlay(frame, inRenderPass());
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), overlay.commands());
}

}  // namespace speculum::examples
