#include "ui/simple_ui.hpp"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "core/platform.hpp"
#include "ui/panels.hpp"

namespace speculum {

namespace {

constexpr float fontPixels = 15.0f;

DescriptorPoolHandle createPool(Device& device) {
  const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 64};
  const VkDescriptorPoolCreateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                        .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                                        .maxSets = size.descriptorCount,
                                        .poolSizeCount = 1,
                                        .pPoolSizes = &size};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device.get(), &info, nullptr, &pool), "vkCreateDescriptorPool for the panel");
  device.setName(pool, "panel");
  return DescriptorPoolHandle(device.get(), pool);
}

}  // namespace

SimpleUI::Context::Context() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM < 18700
  io.KeyMap[ImGuiKey_Tab] = -1;  // hides the panel instead of walking through it, as the arrow keys do as well
#endif
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NavEnableGamepad;
  // The layout is the person's, not the working directory's.
  std::error_code error;
  std::filesystem::create_directories(userConfigDir(), error);
  iniFile = (userConfigDir() / "layout.ini").string();
  io.IniFilename = error ? nullptr : iniFile.c_str();
}

SimpleUI::Context::~Context() {
  ImGui::DestroyContext();
}

// The two halves of the backend, shut down in reverse.
struct SimpleUI::Backend {
  explicit Backend(Window& window) { ImGui_ImplGlfw_InitForVulkan(window.native(), true); }
  ~Backend() {
    if (vulkan) {
      ImGui_ImplVulkan_Shutdown();
    }
    ImGui_ImplGlfw_Shutdown();
  }
  bool vulkan = false;
};

SimpleUI::SimpleUI(Renderer& renderer, Window& window)
    : renderer_(renderer),
      theme_(savedTheme()),
      scale_(window.contentScale()),
      pool_(createPool(renderer.device())),
      backend_(std::make_unique<Backend>(window)) {
  applyLook(theme_, scale_);
  ImFontConfig font;
  font.SizePixels = fontPixels * scale_;
  ImGui::GetIO().Fonts->AddFontDefault(&font);
  initVulkan();
}

SimpleUI::~SimpleUI() {
  renderer_.waitIdle();
}

void SimpleUI::initVulkan() {
  Device& device = renderer_.device();
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = device.instance();
  info.PhysicalDevice = device.physical();
  info.Device = device.get();
  info.QueueFamily = device.queueFamily();
  info.Queue = device.queue();
  info.DescriptorPool = pool_.get();
  info.MinImageCount = 2;
  info.ImageCount = renderer_.displayImageCount();
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = [](VkResult result) { check(result, "the panel's drawing"); };
#if IMGUI_VERSION_NUM >= 19000
  info.RenderPass = renderer_.overlayRenderPass();
  ImGui_ImplVulkan_Init(&info);
  backend_->vulkan = true;
#else
  ImGui_ImplVulkan_Init(&info, renderer_.overlayRenderPass());
  backend_->vulkan = true;
  renderer_.uploader().run([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
#endif
}

void SimpleUI::build(UiModel& model) {
  // Between frames: what is laid out already keeps its sizes and colours.
  if (chosenTheme_ != theme_) {
    theme_ = chosenTheme_;
    applyLook(theme_, scale_);
    saveTheme(theme_);
  }
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  model.widgets.clear();
  model.debugArea.reset();
  model.resetCamera = false;
  model.resetSettings = false;
  model.seek.reset();
  model.copyCommand = false;
  model.accuracy.measure = false;
  model.accuracy.cancel = false;
  model.accuracy.apply = -1;
  model.cancelLoading = false;
  panels::loading(model);
  if (visible_) {
    buildPanel(model);
    buildDebugView(model);
    buildAccuracy(model);
    panels::help(model);
    if (showDemoWindow_) {
      ImGui::ShowDemoWindow(&showDemoWindow_);
    }
  }
  ImGui::Render();
}

void SimpleUI::buildPanel(UiModel& model) {
  const float scale = ImGui::GetFontSize() / fontPixels;
  ImGui::SetNextWindowPos(ImVec2(12.0f * scale, 12.0f * scale), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(420.0f * scale, 660.0f * scale), ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Speculum")) {
    ImGui::PushItemWidth(-9.0f * ImGui::GetFontSize());  // the rest is for the labels
    ImGui::Text("%.2f ms/frame (%.1f FPS)", model.frameMs, model.frameMs > 0.0 ? 1000.0 / model.frameMs : 0.0);
    panels::message(model);
    panels::scene(model);
    ImGui::Checkbox("Settings", &showSettings_);
    ImGui::SameLine();
    ImGui::Checkbox("Accuracy", &showAccuracy_);
    panels::notePlace(model, "accuracy");
    ImGui::SameLine();
    ImGui::Checkbox("ImGui demo window", &showDemoWindow_);
    themeChoice(model);
    if (showSettings_) {
      panels::settings(model);
    }
    panels::passes(model);
    panels::effects(model);
    panels::device(model);
    ImGui::PopItemWidth();
  }
  ImGui::End();
}

void SimpleUI::themeChoice(UiModel& model) {
  int theme = static_cast<int>(theme_);
  ImGui::TextUnformatted("theme");
  for (const auto& [name, place, value] :
       {std::tuple("dark", "theme.dark", Theme::dark), std::tuple("light", "theme.light", Theme::light)}) {
    ImGui::SameLine();
    ImGui::RadioButton(name, &theme, static_cast<int>(value));
    panels::notePlace(model, place);
  }
  chosenTheme_ = static_cast<Theme>(theme);
}

void SimpleUI::buildAccuracy(UiModel& model) {
  model.accuracy.open = showAccuracy_;
  if (!showAccuracy_) {
    return;
  }
  const float scale = ImGui::GetFontSize() / fontPixels;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const ImVec2 size(430.0f * scale, 540.0f * scale);
  ImGui::SetNextWindowPos(ImVec2(std::max(12.0f * scale, display.x - size.x - 12.0f * scale), 12.0f * scale),
                          ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(size, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Accuracy", &showAccuracy_)) {
    panels::accuracy(model);
  }
  ImGui::End();
}

// The window is a frame without a background: the renderer draws the image below it, because this version of ImGui's
// Vulkan backend draws no textures but its font.
void SimpleUI::buildDebugView(UiModel& model) {
  if (model.debugPass < 0) {
    return;
  }
  bool open = true;
  const float scale = ImGui::GetFontSize() / fontPixels;
  ImGui::SetNextWindowPos(ImVec2(430.0f * scale, 12.0f * scale), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(420.0f * scale, 290.0f * scale), ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Offscreen image", &open, ImGuiWindowFlags_NoBackground)) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
    model.debugArea = PixelRect{static_cast<int>(corner.x * pixels.x), static_cast<int>(corner.y * pixels.y),
                                static_cast<int>(room.x * pixels.x), static_cast<int>(room.y * pixels.y)};
  }
  ImGui::End();
  if (!open) {
    model.debugPass = -1;
  }
}

void SimpleUI::record(const PassScope& scope) {
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), scope.commands());
}

bool SimpleUI::wantsMouse() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool SimpleUI::wantsKeyboard() const {
  return ImGui::GetIO().WantTextInput;
}

bool SimpleUI::wantsSpace() const {
  return visible_ && ImGui::GetIO().NavVisible;
}

bool SimpleUI::wantsFrames() const {
  return wantsKeyboard() || ImGui::IsAnyMouseDown();
}

}  // namespace speculum
