#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/panels.hpp"

namespace speculum::panels {

constexpr double leastSpan = 20.0;  // seconds that the slider reaches

void time(PanelContext& ui) {
  const PlaybackView& playback = ui.view.playback;
  // The slider's range doubles whenever the time reaches its end.
  const double span = leastSpan * std::exp2(std::ceil(std::log2(std::max(1.0, playback.time / leastSpan))));
  float seconds = static_cast<float>(playback.time);
  if (ImGui::SliderFloat("Time", &seconds, 0.0f, static_cast<float>(span), "%.3f s", ImGuiSliderFlags_AlwaysClamp)) {
    ui.send(Seek{seconds});
  }
  recordWidget(ui, "time", "Time of the animation. Drag, or Ctrl+click to type; Space pauses.");
  commandButton(ui, "<", "time.back", "Steps back by 1/60 s. Key: comma.", StepTime{-1});
  ImGui::SameLine();
  commandButton(ui, ">", "time.on", "Steps forward by 1/60 s. Key: period.", StepTime{1});
  ImGui::SameLine();
  bool paused = playback.paused;
  if (ImGui::Checkbox("Pause", &paused)) {
    ui.send(SetPaused{paused});
  }
  recordWidget(ui, "pause", "Pauses the animation (Space). The picture then becomes exact.");
  const float width = 6.0f * ImGui::GetFontSize();
  continueRow("Speed", width);
  float speed = static_cast<float>(playback.speed);
  ImGui::SetNextItemWidth(width);
  if (ImGui::SliderFloat("Speed", &speed, static_cast<float>(slowestTime), static_cast<float>(fastestTime), "%.3g x",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    ui.send(SetTimeSpeed{speed});
  }
  recordWidget(ui, "time.speed", "Speed of the animation. Keys: [ halves it, ] doubles it.");
}

}  // namespace speculum::panels
