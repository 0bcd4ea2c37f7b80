#include "ui/theme.hpp"

#include <imgui.h>

namespace speculum {

void applyTheme(Theme theme, float scale) {
  ImGuiStyle style;
  theme == Theme::light ? ImGui::StyleColorsLight(&style) : ImGui::StyleColorsDark(&style);
  style.WindowRounding = 6.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.FrameBorderSize = theme == Theme::light ? 1.0f : 0.0f;  // white on white
  style.Colors[ImGuiCol_WindowBg].w = 0.94f;
  style.Colors[ImGuiCol_PopupBg].w = 1.0f;
  style.Colors[ImGuiCol_ModalWindowDimBg] = {0.0f, 0.0f, 0.0f, 0.4f};
  style.Colors[ImGuiCol_PlotHistogram] = style.Colors[ImGuiCol_SliderGrab];  // progress, with text over it
  const float disabled = theme == Theme::light ? 0.33f : 0.68f;
  style.Colors[ImGuiCol_TextDisabled] = {disabled, disabled, disabled, 1.0f};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace speculum
