#pragma once

#include <imgui.h>
#include <imgui_impl_vulkan.h>
#include <imgui_internal.h>

#include <array>

// What Dear ImGui 1.86 to 1.92 name or do in different ways, by the newest way.
namespace speculum::imgui {

// Before 1.90, the Vulkan backend draws within a VkRenderPass only.
constexpr bool needsRenderPass = IMGUI_VERSION_NUM < 19000;

#if IMGUI_VERSION_NUM >= 18700
constexpr ImGuiKey keypadEnter = ImGuiKey_KeypadEnter;
inline bool isPressed(ImGuiKey key, bool repeat = true) {
  return ImGui::IsKeyPressed(key, repeat);
}
#else
constexpr ImGuiKey keypadEnter = ImGuiKey_KeyPadEnter;
inline bool isPressed(ImGuiKey key, bool repeat = true) {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), repeat);
}
#endif

// Whether the widget with the keyboard's focus is the hovered one, whatever is under the pointer; and whether a frame is
// drawn around it.
#if IMGUI_VERSION_NUM >= 19140
inline bool& focusIsHovered() {
  return ImGui::GetCurrentContext()->NavHighlightItemUnderNav;
}
inline bool focusIsShown() {
  return ImGui::GetCurrentContext()->NavCursorVisible;
}
inline void showFocus() {
  ImGui::GetCurrentContext()->NavCursorVisible = true;
}
#else
inline bool& focusIsHovered() {
  return ImGui::GetCurrentContext()->NavDisableMouseHover;
}
inline bool focusIsShown() {
  return !ImGui::GetCurrentContext()->NavDisableHighlight;
}
inline void showFocus() {
  ImGui::GetCurrentContext()->NavDisableHighlight = false;
}
#endif

// Enter presses the focused widget, as the space bar does; later versions do so themselves. Texts and numbers are edited
// instead. Call it between ImGui::NewFrame() and the first widget.
template <typename Context>
void pressByEnter(Context& context) {
  if constexpr (requires { context.NavActivateInputId; }) {
    if (context.NavActivateInputId != 0 && context.ActiveId == 0) {
      context.NavActivateId = context.NavActivateDownId = context.NavActivateInputId;
    }
  }
}

// What the backend's descriptor pool, which must allow freeing, has to hold at least. Newer backends keep pictures and
// samplers apart.
inline constexpr std::array poolSizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 16},
                                      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 16},
                                      VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_SAMPLER, 8}};

// Begins a child window with a border, into which the arrow keys lead.
inline void beginList(const char* name, const ImVec2& size, ImGuiWindowFlags flags = 0) {
#if IMGUI_VERSION_NUM >= 19090
  constexpr ImGuiChildFlags border = 1;  // its name differs
  ImGui::BeginChild(name, size, border | ImGuiChildFlags_NavFlattened, flags);
#else
  ImGui::BeginChild(name, size, true, flags | ImGuiWindowFlags_NavFlattened);
#endif
}

// Starts the Vulkan backend for targets of the format. `renderPass` is null where it draws by dynamic rendering. Pipelines
// have one sample.
inline void initVulkan(ImGui_ImplVulkan_InitInfo info, VkFormat format, VkRenderPass renderPass) {
#if IMGUI_VERSION_NUM >= 19240
  auto& pipeline = info.PipelineInfoMain;
#else
  auto& pipeline = info;
#endif
  pipeline.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
#if IMGUI_VERSION_NUM >= 19000
  info.UseDynamicRendering = !renderPass;
#endif
#if IMGUI_VERSION_NUM >= 19030
  pipeline.PipelineRenderingCreateInfo = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                          .colorAttachmentCount = 1,
                                          .pColorAttachmentFormats = &format};
  pipeline.RenderPass = renderPass;
  ImGui_ImplVulkan_Init(&info);
#else
#if IMGUI_VERSION_NUM >= 19000
  info.ColorAttachmentFormat = format;
#else
  static_cast<void>(format);
#endif
  ImGui_ImplVulkan_Init(&info, renderPass);
#endif
}

// Puts the fonts' texture on the GPU; later backends do so themselves. `run` records and submits commands:
// run([](VkCommandBuffer) { ... }).
template <typename Run>
void uploadFonts([[maybe_unused]] const Run& run) {
#if IMGUI_VERSION_NUM < 19000
  run([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
  ImGui::GetIO().Fonts->ClearTexData();
#endif
}

// Pictures in the fonts' texture, in rectangles that are reserved before the texture is uploaded.
#if IMGUI_VERSION_NUM >= 19198
inline auto atlasTexture(const ImFontAtlas& atlas) {
  return atlas.TexRef;
}
inline int reserveInAtlas(ImFontAtlas& atlas, int width, int height) {
  return atlas.AddCustomRect(width, height);
}
// Returns the first texel of a row of a reserved rectangle: four bytes a texel.
inline unsigned char* atlasTexels(ImFontAtlas& atlas, int id, int row) {
  ImFontAtlasRect rect;
  atlas.GetCustomRect(id, &rect);
  return static_cast<unsigned char*>(atlas.TexData->GetPixelsAt(rect.x, rect.y + row));
}
inline void atlasCorners(const ImFontAtlas& atlas, int id, ImVec2& low, ImVec2& high) {
  ImFontAtlasRect rect;
  atlas.GetCustomRect(id, &rect);
  low = rect.uv0;
  high = rect.uv1;
}
#else
inline auto atlasTexture(const ImFontAtlas& atlas) {
  return atlas.TexID;
}
inline int reserveInAtlas(ImFontAtlas& atlas, int width, int height) {
  return atlas.AddCustomRectRegular(width, height);
}
inline unsigned char* atlasTexels(ImFontAtlas& atlas, int id, int row) {
  unsigned char* texels = nullptr;
  int width = 0;
  atlas.GetTexDataAsRGBA32(&texels, &width, nullptr);
  const ImFontAtlasCustomRect& rect = *atlas.GetCustomRectByIndex(id);
  return texels + 4 * (static_cast<size_t>(rect.Y + row) * width + rect.X);
}
inline void atlasCorners(const ImFontAtlas& atlas, int id, ImVec2& low, ImVec2& high) {
  auto& writable = const_cast<ImFontAtlas&>(atlas);
  atlas.CalcCustomRectUV(writable.GetCustomRectByIndex(id), &low, &high);
}
#endif

}  // namespace speculum::imgui
