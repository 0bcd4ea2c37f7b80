#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr double leastSpan = 20.0;  // seconds that the slider reaches

constexpr std::array<KeyHelp, 16> keys{{
    {"drag", "look around: about the target (orbit) or from where you are (fly)"},
    {"wheel", "nearer or farther"},
    {"W A S D", "forwards, left, back, right"},
    {"Q E", "down, up"},
    {"F", "look at the whole scene"},
    {"Space", "pause the animation and let it go on"},
    {".", "pause, 1/60 s onwards"},
    {",", "pause, 1/60 s back"},
    {"[", "half the speed of time"},
    {"]", "twice the speed of time"},
    {"F12", "save the window as a picture"},
    {"Shift+F12", "the same without the panel"},
    {"F11", "full screen and back"},
    {"Tab", "hide or show the panel"},
    {"F1", "this list"},
    {"Esc", "quit"},
}};

}  // namespace

std::span<const KeyHelp> keyHelp() {
  return keys;
}

void time(UiModel& model) {
  // Room for what comes: the slider reaches twice as far whenever the time has come to its end.
  const double span = leastSpan * std::exp2(std::ceil(std::log2(std::max(1.0, model.time / leastSpan))));
  float seconds = static_cast<float>(model.time);
  if (ImGui::SliderFloat("time", &seconds, 0.0f, static_cast<float>(span), "%.3f s", ImGuiSliderFlags_AlwaysClamp)) {
    model.seek = seconds;
  }
  notePlace(model, "time");
  tip("seconds of the animation");
  if (ImGui::Button("<")) {
    model.seek = model.time - timeStep;
    model.paused = true;
  }
  notePlace(model, "time.back");
  tip("pause, 1/60 s back");
  ImGui::SameLine();
  if (ImGui::Button(">")) {
    model.seek = model.time + timeStep;
    model.paused = true;
  }
  notePlace(model, "time.on");
  tip("pause, 1/60 s onwards");
  ImGui::SameLine();
  ImGui::Checkbox("pause", &model.paused);
  notePlace(model, "pause");
  tip("the animation stands still; so do frames, if nothing else changes");
  ImGui::SameLine();
  float speed = static_cast<float>(model.timeSpeed);
  ImGui::SetNextItemWidth(6.0f * ImGui::GetFontSize());
  if (ImGui::SliderFloat("speed", &speed, static_cast<float>(slowestTime), static_cast<float>(fastestTime), "%.3g x",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    model.timeSpeed = speed;
  }
  notePlace(model, "time.speed");
  tip("seconds of the animation a second");
}

void help(UiModel& model) {
  if (!model.help) {
    return;
  }
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowBgAlpha(1.0f);  // text over text cannot be read
  if (ImGui::Begin("Keys", &model.help, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg)) {
      for (const KeyHelp& key : keys) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(key.keys);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(key.what);
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace speculum::panels
