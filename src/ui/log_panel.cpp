#include <imgui.h>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

ImVec4 colorOf(LogLevel level) {
  switch (level) {
    case LogLevel::info:
      break;
    case LogLevel::warning:
      return {0.85f, 0.60f, 0.10f, 1.0f};
    case LogLevel::error:
      return {0.92f, 0.38f, 0.28f, 1.0f};
  }
  return ImGui::GetStyleColorVec4(ImGuiCol_Text);
}

}  // namespace

void log(UiModel& model) {
  UiLog& log = model.log;
  ImGui::SetNextItemWidth(11.0f * ImGui::GetFontSize());
  ImGui::InputTextWithHint("##filter", "filter", log.filter.data(), log.filter.size());
  notePlace(model, "log.filter");
  tip("only lines that contain this");
  ImGui::SameLine();
  int least = static_cast<int>(log.least);
  ImGui::SetNextItemWidth(7.0f * ImGui::GetFontSize());
  ImGui::Combo("##least", &least, "info\0warning\0error\0");
  tip("only lines of this level and above");
  log.least = static_cast<LogLevel>(least);
  ImGui::SameLine();
  model.copyLog = ImGui::Button("copy");
  notePlace(model, "log.copy");
  tip("the lines below, into the clipboard");
  ImGui::SameLine();
  if (ImGui::Button("clear")) {
    log.history->clear();
  }
  notePlace(model, "log.clear");
  ImGui::Separator();
  ImGui::BeginChild("lines");
  for (const LogLine& line : shownLog(model)) {
    ImGui::PushStyleColor(ImGuiCol_Text, colorOf(line.level));
    ImGui::TextWrapped("%s", line.text.c_str());
    ImGui::PopStyleColor();
  }
  // Follows the newest line unless somebody reads above it.
  if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) {
    ImGui::SetScrollHereY(1.0f);
  }
  ImGui::EndChild();
}

}  // namespace speculum::panels
