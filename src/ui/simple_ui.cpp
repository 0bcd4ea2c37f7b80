#include "ui/simple_ui.hpp"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>
#include <imgui_internal.h>
#include <spdlog/spdlog.h>
#include <imgui_versions.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <filesystem>
#include <mutex>
#include <utility>

#include "platform/files.hpp"
#include "platform/process.hpp"
#include "ui/foreign_glyphs.hpp"
#include "ui/glfw_input.hpp"

namespace speculum {

namespace {

constexpr float fontPixels = 15.0f;
constexpr float edgeReach = 4.0f;  // screen coordinates around a window that belong to it, as in ImGui

DescriptorPoolHandle createPool(Device& device) {
  return device.create(vkCreateDescriptorPool,
                       {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                        .flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                        .maxSets = 16,
                        .poolSizeCount = static_cast<uint32_t>(imgui::poolSizes.size()),
                        .pPoolSizes = imgui::poolSizes.data()},
                       "panel");
}

// Returns the file of the panels' layout, in the user's folder and not in the working directory.
std::filesystem::path layoutFile() {
  return userConfigDir() / "layout.ini";
}

void addFont(ImFontAtlas& atlas, float pixels) {
  static const std::string file = systemFont().string();
  if (!file.empty() && atlas.AddFontFromFileTTF(file.c_str(), pixels, nullptr, ForeignGlyphs::own())) {
    return;
  }
  static std::once_flag warned;
  std::call_once(warned, [] { spdlog::warn("no font was found: install fonts-dejavu-core for a readable one"); });
  ImFontConfig builtIn;
  builtIn.SizePixels = pixels;
  atlas.AddFontDefault(&builtIn);
}

// Sets colors and sizes. `scale`: screen coordinates that stand for one at 96 dots an inch.
void applyTheme(Theme theme, float scale) {
  ImGuiStyle style;
  theme == Theme::light ? ImGui::StyleColorsLight(&style) : ImGui::StyleColorsDark(&style);
  style.WindowRounding = 6.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.FrameBorderSize = theme == Theme::light ? 1.0f : 0.0f;  // light frames are white on white
  style.Colors[ImGuiCol_WindowBg].w = 0.94f;
  style.Colors[ImGuiCol_PopupBg].w = 1.0f;
  style.Colors[ImGuiCol_TitleBgCollapsed].w = 0.94f;  // else only the picture would be seen there
  style.Colors[ImGuiCol_ModalWindowDimBg] = {0.0f, 0.0f, 0.0f, 0.4f};
  style.Colors[ImGuiCol_PlotHistogram] = style.Colors[ImGuiCol_SliderGrab];  // progress bars have text over them
  // These colors are transparent, because values are drawn over them.
  style.Colors[ImGuiCol_SliderGrab].w = 0.5f;
  style.Colors[ImGuiCol_SliderGrabActive].w = 0.6f;
  style.Colors[ImGuiCol_HeaderHovered].w = 0.4f;
  style.Colors[ImGuiCol_HeaderActive].w = 0.5f;
  const float disabled = theme == Theme::light ? 0.33f : 0.68f;
  style.Colors[ImGuiCol_TextDisabled] = {disabled, disabled, disabled, 1.0f};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace

SimpleUI::Context::Context() {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.ConfigDragClickToInputText = true;
  io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard | ImGuiConfigFlags_NavEnableGamepad;
  io.IniFilename = nullptr;  // Dear ImGui would replace links and wait for the other end of pipes
}

SimpleUI::Context::~Context() {
  ImGui::DestroyContext();
}

// The two halves of the backend, shut down in reverse.
struct SimpleUI::Backend {
  explicit Backend(Window& window) : input(window) {
    ImGui_ImplGlfw_InitForVulkan(window.native(), false);
    input.readWindow();
  }
  ~Backend() {
    shutdownVulkan();
    ImGui_ImplGlfw_Shutdown();
  }
  void shutdownVulkan() {
    if (std::exchange(vulkan, false)) {
      ImGui_ImplVulkan_Shutdown();
    }
  }
  GlfwInput input;
  bool vulkan = false;
};

SimpleUI::SimpleUI(Renderer& renderer, Window& window)
    : renderer_(renderer),
      window_(window),
      glyphs_(std::make_unique<ForeignGlyphs>()),
      backend_(std::make_unique<Backend>(window)),
      idle_(renderer.device()) {
  windows_.rememberLayout();
  const std::string layout = readTextIfAny(layoutFile(), 1u << 16);
  ImGui::LoadIniSettingsFromMemory(layout.data(), layout.size());
}

SimpleUI::~SimpleUI() {
  saveLayout();
}

void SimpleUI::saveLayout() {
  size_t bytes = 0;
  const char* layout = ImGui::SaveIniSettingsToMemory(&bytes);
  storeFile(layoutFile(), std::string_view(layout, bytes), Links::follow);
  ImGui::GetIO().WantSaveIniSettings = false;
}

void SimpleUI::setThumbnails(std::vector<Image8> pictures) {
  windows_.thumbnails().setPictures(std::move(pictures));
  scale_ = 0.0f;
}

void SimpleUI::setPoster(const Image8& picture) {
  if (windows_.thumbnails().setPoster(picture)) {
    scale_ = 0.0f;
  }
}

float SimpleUI::scale() const {
  constexpr float largest = 9.0f;  // beyond it the font's texture might exceed what devices have
  const float chosen = static_cast<float>(windows_.state().choices.percent) / 100.0f * settingScale_;
  return std::min(window_.contentScale() * chosen, largest);
}

// Returns the pixels of a screen coordinate, in eighths. Under Wayland it is the monitor's scale, elsewhere 1. The
// exact quotient changes while a window is resized, and another scale means other letters.
float SimpleUI::density() const {
  const auto size = static_cast<float>(std::max(window_.size().width, 1u));
  const float quotient = static_cast<float>(window_.framebufferExtent().width) / size;
  return std::max(std::round(8.0f * quotient) / 8.0f, 1.0f);
}

// Call between frames, because a frame that is laid out keeps its sizes and colors.
void SimpleUI::prepareTheme() {
  const float pixels = std::floor(fontPixels * scale());
  const float scale = this->scale() / density();
  const Theme theme = windows_.state().choices.theme;
  const bool newGlyphs = glyphs_->takeNew();
  if (scale == scale_ && pixels == letters_ && theme == theme_ && !newGlyphs) {
    return;
  }
  theme_ = theme;
  applyTheme(theme, scale);
  const bool sameScale = std::exchange(scale_, scale) == scale;
  if (std::exchange(letters_, pixels) == pixels && sameScale && !newGlyphs) {
    return;
  }
  renderer_.waitIdle();
  backend_->shutdownVulkan();
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  addFont(atlas, pixels);
  glyphs_->addTo(atlas, pixels);
  ImGui::GetIO().FontGlobalScale = 1.0f / density();
  windows_.thumbnails().addTo(atlas);
  initVulkan();
}

void SimpleUI::noteGlyphs(const UiInput& input) {
  glyphs_->noteNames(input);
  glyphs_->noteFiles(windows_.state().files);
}

void SimpleUI::initVulkan() {
  pool_ = createPool(renderer_.device());
  Device& device = renderer_.device();
  ImGui_ImplVulkan_InitInfo info{};
  info.Instance = device.instance();
  info.PhysicalDevice = device.physical();
  info.Device = device.get();
  info.QueueFamily = device.queueFamily();
  info.Queue = device.queue();
  info.PipelineCache = renderer_.pipelineCache().get();
  info.DescriptorPool = pool_.get();
  info.MinImageCount = 2;
  info.ImageCount = std::max(renderer_.displayImageCount(), 2 * framesInFlight);  // a frame may record two parts
  info.CheckVkResultFn = [](VkResult result) { check(result, "the panel's drawing"); };
  const VkRenderPass renderPass = inRenderPass() ? renderer_.overlayRenderPass() : VK_NULL_HANDLE;
  backend_->vulkan = true;  // from here on there is something to shut down, even if ImGui_ImplVulkan_Init() fails
  imgui::initVulkan(info, renderer_.displayFormat(), renderPass);
  imgui::uploadFonts([&](const auto& record) { renderer_.uploader().run(record); });
}

void SimpleUI::push(const InputEvent& event) {
  if (event.kind == InputEvent::Kind::text && event.code <= IM_UNICODE_CODEPOINT_MAX) {
    glyphs_->note(static_cast<ImWchar>(event.code));
  } else if (event.kind == InputEvent::Kind::focus) {
    windows_.setFocused(event.down);
  }
  backend_->input.push(event);
}

UiOutput SimpleUI::build(const UiInput& input) {
  settingScale_ = static_cast<float>(input.settings.ui.scale);
  noteGlyphs(input);
  prepareTheme();
  ImGui_ImplVulkan_NewFrame();
  backend_->input.newFrame();
  ImGui::NewFrame();
  UiOutput output = windows_.build(input);
  ImGui::Render();
  if (ImGui::GetIO().WantSaveIniSettings) {
    saveLayout();
  }
  return output;
}

bool SimpleUI::inRenderPass() const {
  return imgui::needsRenderPass || renderer_.device().renderPath() == RenderPath::renderPass;
}

void SimpleUI::record(Frame& frame, Part part) {
  const PassScope scope = renderer_.beginOverlay(frame, inRenderPass());
  ImDrawData& data = *ImGui::GetDrawData();
  const std::string_view shown = part == Part::divider ? panels::dividerTitle : panels::statusTitle;
  // Dear ImGui's vectors may not be copied while they are empty, so this container must not move its elements.
  std::deque<std::pair<ImDrawList*, ImVector<ImDrawCmd>>> leftOut;
  for (int i = 0; part != Part::all && i < data.CmdListsCount; ++i) {
    if (data.CmdLists[i]->_OwnerName != shown) {
      auto& [list, commands] = leftOut.emplace_back();
      list = data.CmdLists[i];
      list->CmdBuffer.swap(commands);
    }
  }
  // The backend sizes its buffers by these totals. It destroys a buffer that is too small before it makes a larger one,
  // and once more at its end if there was no memory for that; buffers of this size are never replaced.
  data.TotalVtxCount = std::max(data.TotalVtxCount, 100'000);
  data.TotalIdxCount = std::max(data.TotalIdxCount, 200'000);
  ImGui_ImplVulkan_RenderDrawData(&data, scope.commands());
  for (auto& [list, commands] : leftOut) {
    list->CmdBuffer.swap(commands);
  }
}

void SimpleUI::readWindow() {
  backend_->input.readWindow();
}

// Uses the windows of the last frame, because the pointer may have moved since.
bool SimpleUI::takesPointer(double x, double y) const {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  if (!context.OpenPopupStack.empty() || (context.ActiveId != 0 && ImGui::IsAnyMouseDown())) {
    return true;
  }
  const ImVec2 point(static_cast<float>(x), static_cast<float>(y));
  return std::ranges::any_of(context.Windows, [&](const ImGuiWindow* window) {
    ImRect reach = window->OuterRectClipped;
    reach.Expand((window->Flags & ImGuiWindowFlags_NoResize) == 0 ? edgeReach : 0.0f);
    return window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_NoMouseInputs) == 0 &&
           reach.Contains(point);
  });
}

bool SimpleUI::holdsEscape() const {
  return !ImGui::GetCurrentContext()->OpenPopupStack.empty() || ImGui::IsAnyItemActive();
}

bool SimpleUI::holdsWidget() const {
  return ImGui::IsAnyItemActive();
}

bool SimpleUI::wantsKeyboard() const {
  return ImGui::GetIO().WantTextInput;
}

bool SimpleUI::navigating() const {
  return windows_.visible() && ImGui::GetIO().NavVisible;
}

bool SimpleUI::menuOpen() const {
  return windows_.visible() && !ImGui::GetCurrentContext()->OpenPopupStack.empty();
}

bool SimpleUI::hasEvents() const {
  return backend_->input.waiting();
}

bool SimpleUI::wantsFrames() const {
  return wantsKeyboard() || ImGui::IsAnyMouseDown() || hasEvents();
}

}  // namespace speculum
