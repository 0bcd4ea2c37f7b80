#include <imgui.h>

#include "ui/panels.hpp"

namespace speculum::panels {

void log(PanelContext& ui) {
  PanelState& state = ui.state;
  ImGui::SetNextItemWidth(11.0f * ImGui::GetFontSize());
  ImGui::InputTextWithHint("##filter", "Filter", state.logFilter.data(), state.logFilter.size());
  recordWidget(ui, "log.filter", "Shows only lines that contain this.");
  const float levels = 7.0f * ImGui::GetFontSize();
  continueRow("", levels);
  int least = state.logLevel - LogLevel::info;
  ImGui::SetNextItemWidth(levels);
  ImGui::Combo("##least", &least, "info\0warning\0error\0");
  tip("Shows only lines of this level and above.");
  state.logLevel = static_cast<LogLevel>(LogLevel::info + least);
  const std::vector<LogLine> lines = ui.input.log.lines(state.logLevel, state.logFilter.data());
  continueRow("Copy");
  if (button(ui, "Copy", "log.copy", "Copies the lines below.")) {
    ui.send(CopyText{logText(lines)});
  }
  nextButton(ui, "Clear", "log.clear", "", ClearLog{});
  ImGui::Separator();
  ImGui::BeginChild("lines");
  for (const LogLine& line : lines) {
    if (line.level <= LogLevel::info) {
      wrappedText(line.text);
    } else {
      coloredText(line.level >= LogLevel::err ? errorColor : warningColor, line.text);
    }
  }
  // Follows the newest line unless the user has scrolled up.
  if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) {
    ImGui::SetScrollHereY(1.0f);
  }
  ImGui::EndChild();
}

}  // namespace speculum::panels
