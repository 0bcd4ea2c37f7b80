#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "platform/text.hpp"
#include "ui/panels.hpp"

namespace speculum {

float statusAlpha(double age) {
  return static_cast<float>(std::clamp(statusSeconds - age, 0.0, 1.0));
}

namespace panels {

constexpr float lines = 2.0f;       // lines of text that are kept free
constexpr float mostWidth = 0.75f;  // of the display
constexpr const char* pictureHelp =
    "Moving, Draft: what is left out until nothing moves and the whole picture is drawn.\n"
    "Averaged: how many of the pictures are drawn whose mean is shown.\n"
    "Approximate: what the settings leave out of the whole picture too.\n"
    "Estimated FLIP: how different it should look without that, 0 (not at all) to 1.";

float statusHeight() {
  return std::floor(lines * ImGui::GetTextLineHeightWithSpacing() + 2.0f * ImGui::GetStyle().FramePadding.y);
}

float statusLine(const ShownStatus& status, float width, float right) {
  const std::string picture = width > 0.0f ? status.picture : "";
  const float alpha = picture.empty() ? statusAlpha(status.age) : 1.0f;
  if ((status.text.empty() && picture.empty()) || alpha <= 0.0f) {
    return 0.0f;
  }
  std::string shown = status.text + (status.text.empty() || picture.empty() ? "" : "\n") + picture;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float margin = std::floor(0.8f * ImGui::GetFontSize());
  // Paths cannot wrap, so the line may be wider than the panel.
  const float text = ImGui::CalcTextSize(shown.c_str()).x + 3.0f * ImGui::GetStyle().FramePadding.x;
  const float least = std::min(width, display.x - 2.0f * margin);
  const float most = std::max(least, std::min(mostWidth * display.x, right - 2.0f * margin));
  const float across = std::clamp(text, least, most);
  const ImVec2 padding = ImGui::GetStyle().FramePadding;
  shown = brokenAtSpaces(shown, across - 2.0f * padding.x, textWidth);
  const float height =
      std::ceil(ImGui::CalcTextSize(shown.c_str(), nullptr, false, across - 2.0f * padding.x).y + 3.0f * padding.y);
  ImGui::SetNextWindowPos({margin, std::max(display.y - height - 0.5f * margin, 0.0f)});
  ImGui::SetNextWindowSize({across, height});
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, alpha);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImGui::GetStyle().FramePadding);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});  // a line of text is lower than the style's
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                     ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (ImGui::Begin(statusTitle, nullptr, flags)) {
    ImGui::TextWrapped("%s", shown.c_str());
    const ImVec2 corner = ImGui::GetWindowPos();
    if (!picture.empty() && !ImGui::GetIO().WantCaptureMouse &&
        ImGui::IsMouseHoveringRect(corner, {corner.x + across, corner.y + height}, false)) {
      showTip(pictureHelp);
    }
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
  return height;
}

}  // namespace panels
}  // namespace speculum
