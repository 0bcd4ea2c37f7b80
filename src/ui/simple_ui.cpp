#include "ui/simple_ui.hpp"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_vulkan.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <tuple>
#include <utility>

#include "platform/folders.hpp"
#include "ui/glfw_input.hpp"
#include "ui/panels.hpp"

namespace speculum {

namespace {

constexpr float fontPixels = 15.0f;
constexpr float edgeReach = 4.0f;  // screen coordinates around a window that belong to it, as in ImGui

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
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  io.ConfigDragClickToInputText = true;
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
  explicit Backend(Window& window) {
    ImGui_ImplGlfw_InitForVulkan(window.native(), false);
    input.emplace(window.native());
  }
  ~Backend() {
    shutdownVulkan();
    input.reset();
    ImGui_ImplGlfw_Shutdown();
  }
  void shutdownVulkan() {
    if (std::exchange(vulkan, false)) {
      ImGui_ImplVulkan_Shutdown();
    }
  }
  std::optional<GlfwInput> input;
  bool vulkan = false;
};

SimpleUI::SimpleUI(Renderer& renderer, Window& window)
    : renderer_(renderer),
      window_(window),
      theme_(savedTheme()),
      choices_(savedPanelChoices()),
      backend_(std::make_unique<Backend>(window)) {
  dock_.remember();
}

SimpleUI::~SimpleUI() {
  renderer_.waitIdle();
}

void SimpleUI::setThumbnails(std::vector<Image8> pictures) {
  thumbnails_ = Thumbnails(std::move(pictures));
  scale_ = 0.0f;
}

// Between frames: what is laid out already keeps its sizes and colours.
void SimpleUI::prepareLook() {
  const float scale = window_.contentScale() * static_cast<float>(choices_.percent) / 100.0f;
  if (scale == scale_ && chosenTheme_ == theme_) {
    return;
  }
  if (chosenTheme_ != theme_) {
    theme_ = chosenTheme_;
    saveTheme(theme_);
  }
  applyLook(theme_, scale);
  if (scale == scale_) {
    return;
  }
  scale_ = scale;
  renderer_.waitIdle();
  backend_->shutdownVulkan();
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  ImFontConfig font;
  font.SizePixels = std::floor(fontPixels * scale_);
  atlas.AddFontDefault(&font);
  thumbnails_.addTo(atlas);
  initVulkan();
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
  prepareLook();
  ImGui_ImplVulkan_NewFrame();
  backend_->input->newFrame();
  ImGui::NewFrame();
  model.widgets.clear();
  model.debugArea.reset();
  model.resetCamera = false;
  model.goToBookmark.reset();
  model.bookmarkView = false;
  model.removeBookmark = false;
  model.resetSettings = false;
  model.seek.reset();
  model.copyCommand = false;
  model.copyHistory = false;
  model.copyLog = false;
  model.hoveredPass = -1;
  model.hoveredSkipped = -1;
  model.targets.pointed.reset();
  model.passClicked = false;
  model.accuracy.measure = false;
  model.accuracy.cancel = false;
  model.accuracy.apply = -1;
  model.cancelLoading = false;
  model.screenshot = false;
  panels::loading(model);
  dock_.beginFrame(panels::statusHeight(), !visible_);
  if (visible_) {
    buildPanel(model);
    buildWindows(model);
    panels::passOutline(model);
    panels::help(model);
    if (showDemoWindow_) {
      ImGui::ShowDemoWindow(&showDemoWindow_);
    }
  }
  panels::edit(model, visible_ ? &dock_ : nullptr);
  if (visible_ || !model.status.withPanelOnly) {
    panels::statusLine(model, visible_ ? std::max(statusWidth_, 20.0f * ImGui::GetFontSize()) : 0.0f);
  }
  ImGui::Render();
}

void SimpleUI::buildPanel(UiModel& model) {
  if (dock_.begin("Speculum", nullptr, PanelDock::Edge::left, {28.0f, 0.0f})) {
    ImGui::PushItemWidth(-10.5f * ImGui::GetFontSize());  // the rest is for the labels
    ImGui::Text("%.2f ms/frame (%.1f FPS)", model.frameMs, model.frameMs > 0.0 ? 1000.0 / model.frameMs : 0.0);
    const float width = ImGui::GetWindowWidth();
    const char* hint = "F1: keys   Tab: hide";
    ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(hint).x);
    ImGui::TextDisabled("%s", hint);
    panels::message(model);
    panels::scene(model);
    panelChoices(model);
    panels::settings(model);
    panels::passes(model);
    panels::effects(model);
    ImGui::PopItemWidth();
    statusWidth_ = width;
  }
  ImGui::End();
}

// The windows beside the panel, and what is said about the panel itself.
void SimpleUI::panelChoices(UiModel& model) {
  constexpr int columns = 3;
  if (ImGui::BeginTable("panels", columns, ImGuiTableFlags_SizingStretchSame)) {
    for (const PanelName& panel : panelNames) {
      ImGui::TableNextColumn();
      ImGui::Checkbox(panel.name.data(), &(choices_.*panel.open));
      panels::notePlace(model, "panel." + std::string(panel.name));
      panels::tip(panel.about);
    }
    ImGui::EndTable();
  }
  const bool open = ImGui::CollapsingHeader("Window");
  panels::notePlace(model, "section.window");
  if (open) {
    themeChoice(model);
    ImGui::SliderInt("size", &pendingPercent_, 50, 300, "%d %%", ImGuiSliderFlags_AlwaysClamp);
    panels::notePlace(model, "window.size");
    panels::tip("of text and widgets, of what the monitor's scale asks for; remembered");
    if (!ImGui::IsItemActive()) {
      choices_.percent = pendingPercent_;
    }
    presentMode(model);
    if (ImGui::Button("reset layout")) {
      dock_.reset();
    }
    panels::notePlace(model, "window.reset");
    panels::tip("all windows back to the edges, as large as at first");
    ImGui::Checkbox("ImGui demo window", &showDemoWindow_);
  }
}

void SimpleUI::buildWindows(UiModel& model) {
  const auto window = [&](const char* name, bool& open, const glm::vec2& ems, const auto& content) {
    if (open) {
      ImGui::SetNextWindowBgAlpha(1.0f);  // figures over the picture cannot be read
      if (dock_.begin(name, &open, PanelDock::Edge::right, ems)) {
        content();
      }
      ImGui::End();
    }
  };
  window("Scenes", choices_.scenes, {24.2f, 46.5f}, [&] { panels::gallery(model, thumbnails_); });
  window("Performance", choices_.performance, {27.0f, 22.0f}, [&] { panels::performance(model); });
  model.accuracy.open = choices_.accuracy;
  window("Accuracy", choices_.accuracy, {27.0f, 36.0f}, [&] { panels::accuracy(model); });
  window("Device", choices_.device, {27.0f, 30.0f}, [&] { panels::device(model); });
  window("Log", choices_.log, {27.0f, 14.0f}, [&] { panels::log(model); });
  buildTargets(model);
  if (choices_ != savedChoices_) {
    savedChoices_ = choices_;
    savePanelChoices(choices_);
  }
}

void SimpleUI::presentMode(UiModel& model) {
  if (model.presentModes.empty()) {
    return;
  }
  for (int i = 0; i < static_cast<int>(model.presentModes.size()); ++i) {
    const std::string& name = model.presentModes[static_cast<size_t>(i)];
    if (i > 0) {
      ImGui::SameLine();
    }
    ImGui::RadioButton(name.c_str(), &model.presentMode, i);
    panels::notePlace(model, "present." + name);
    panels::tip(
        "fifo waits for the screen and never tears; mailbox shows the newest picture at each refresh and draws on;\n"
        "immediate shows pictures at once and may tear");
  }
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

// The window is a frame without a background: the renderer draws the image below it, because this version of ImGui's
// Vulkan backend draws no textures but its font.
void SimpleUI::buildTargets(UiModel& model) {
  // A pass that is clicked opens the window and clicked again closes it; opened by itself it shows the main view.
  if (model.passClicked) {
    choices_.targets = model.debugPass >= 0;
  }
  if (choices_.targets && model.debugPass < 0) {
    const auto main = std::find_if(model.passes.begin(), model.passes.end(),
                                   [](const UiPass& pass) { return pass.kind == PassKind::main; });
    model.debugPass = main != model.passes.end() ? static_cast<int>(main - model.passes.begin()) : -1;
  }
  if (choices_.targets) {
    constexpr ImGuiWindowFlags flags =
        ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
    if (dock_.begin("Targets", &choices_.targets, PanelDock::Edge::right, {27.0f, 22.0f}, flags)) {
      panels::targets(model);
    }
    ImGui::End();
  }
  if (!choices_.targets) {
    model.debugPass = -1;
    model.debugArea.reset();
  }
}

void SimpleUI::record(const PassScope& scope) {
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), scope.commands());
}

// Of the frame before the event: the pointer may have come from elsewhere since.
bool SimpleUI::takesPointer(double x, double y) const {
  const ImGuiContext& context = *ImGui::GetCurrentContext();
  if (!context.OpenPopupStack.empty() || (context.ActiveId != 0 && ImGui::IsAnyMouseDown())) {
    return true;
  }
  const ImVec2 point(static_cast<float>(x), static_cast<float>(y));
  return std::any_of(context.Windows.begin(), context.Windows.end(), [&](const ImGuiWindow* window) {
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

bool SimpleUI::closeTop(UiModel& model) {
  const auto close = [&](const ImGuiWindow& window) {
    const std::string_view name = window.Name;
    const auto panel =
        std::find_if(panelNames.begin(), panelNames.end(), [&](const PanelName& p) { return p.name == name; });
    bool* open = name == panels::helpTitle        ? &model.help
                 : name == panels::inspectorTitle ? &model.edit.open
                 : panel != panelNames.end()      ? &(choices_.*panel->open)
                 : name == "Dear ImGui Demo"      ? &showDemoWindow_
                                                  : nullptr;
    return open && window.Active && !window.Hidden && std::exchange(*open, false);
  };
  const ImVector<ImGuiWindow*>& windows = ImGui::GetCurrentContext()->WindowsFocusOrder;  // the last one is the top
  for (int i = windows.Size - 1; i >= 0; --i) {
    if (close(*windows[i])) {
      return true;
    }
  }
  return false;
}

bool SimpleUI::wantsKeyboard() const {
  return ImGui::GetIO().WantTextInput;
}

bool SimpleUI::navigating() const {
  return visible_ && ImGui::GetIO().NavVisible;
}

bool SimpleUI::wantsFrames() const {
  return wantsKeyboard() || ImGui::IsAnyMouseDown() || backend_->input->waiting();
}

}  // namespace speculum
