#include "ui/theme.hpp"

#include <imgui.h>

namespace speculum {

void applyTheme(Theme theme, float scale) {
  ImGuiStyle style;
  theme == Theme::light ? ImGui::StyleColorsLight(&style) : ImGui::StyleColorsDark(&style);
  style.WindowRounding = 6.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.Colors[ImGuiCol_WindowBg].w = 0.88f;
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace speculum
