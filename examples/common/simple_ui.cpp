#include "simple_ui.hpp"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>

#include <algorithm>

namespace speculum::examples {

namespace {

constexpr float mostTurn = 1.1f;  // radians; the camera stays before the mirror

DescriptorPoolHandle createPool(Device& device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};  // the font
  return device.create(vkCreateDescriptorPool,
                       {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                        .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                        .maxSets = 1,
                        .poolSizeCount = 1,
                        .pPoolSizes = &size},
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
  info.DescriptorPool = pool_.get();
  info.MinImageCount = 2;
  info.ImageCount = std::max(renderer.displayImageCount(), 3u);
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = [](VkResult result) { check(result, "the panel's drawing"); };
#if IMGUI_VERSION_NUM >= 19030
  info.RenderPass = renderer.overlayRenderPass();
  ImGui_ImplVulkan_Init(&info);
#else
  ImGui_ImplVulkan_Init(&info, renderer.overlayRenderPass());
#endif
#if IMGUI_VERSION_NUM < 19000
  // Later backends upload the font themselves.
  renderer.uploader().run([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
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
  ImGui::ColorEdit3("Clear color", &state.clearColor.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
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

void SimpleUI::record(const PassScope& overlay) const {
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), overlay.commands());
}

}  // namespace speculum::examples
