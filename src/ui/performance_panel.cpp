#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "ui/panels.hpp"
#include "ui/pass_tree.hpp"

namespace speculum::panels {

namespace {

constexpr size_t fewest = 60;       // least number of frames across a graph
constexpr float largeGraph = 3.2f;  // height in sizes of the font, if there is room
constexpr float smallGraph = 1.6f;  // height of a pass's graph

// Draws a graph from 0 up; frames without a figure leave a gap.
void graph(const char* name, std::vector<float> values, float height) {
  const double p95 = percentile(values, 0.95);
  const float top = std::isnan(p95) ? 1.0f : static_cast<float>(1.4 * p95);
  values.insert(values.begin(), std::max(fewest, values.size()) - values.size(), NAN);
  ImGui::PushID(name);
  ImGui::PlotLines("##graph", values.data(), static_cast<int>(values.size()), 0, nullptr, 0.0f, std::max(top, 1e-3f),
                   {ImGui::GetContentRegionAvail().x, height});
  ImGui::PopID();
}

// Draws one row: name, median, p95 and the graph. A nested pass is indented and shows the end of its path; other rows
// show the whole name.
void row(PanelContext& ui, const std::string& name, const std::vector<float>& values, float height, int depth = 0) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const float indent = 0.8f * ImGui::GetFontSize() * static_cast<float>(depth);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
  ImGui::TextUnformatted(thatFits(depth > 0 ? pathEnd(name) : pathText(name)).c_str());
  const auto pass = std::ranges::find(ui.input.frame.passes, name, &PassRow::name);
  const bool ofMirror = pass != ui.input.frame.passes.end() && !pass->path.empty();
  recordWidget(ui, "name." + name, name + (ofMirror ? "\nA click selects the mirror." : ""));
  if (ofMirror && ImGui::IsItemHovered()) {
    mirrorRow(ui, pass->path);
  }
  for (const double share : {0.5, 0.95}) {
    ImGui::TableNextColumn();
    figure(milliseconds(percentile(values, share)));
  }
  ImGui::TableNextColumn();
  graph(name.c_str(), values, height);
  recordWidget(ui, "graph." + name);
}

// Draws the rows of passes, each followed by the rows of the passes that are seen in it.
void passRows(PanelContext& ui, const std::vector<std::string>& names, std::span<const TreeNode> branches, float height,
              int depth = 0) {
  for (const TreeNode& branch : branches) {
    const std::string& name = names[static_cast<size_t>(branch.pass)];
    row(ui, name, ui.input.frame.history.filledSeries(name), height, depth);
    passRows(ui, names, branch.children, height, depth + 1);
  }
}

constexpr float fixedRows = 3.0f;  // rows above those of passes

// Returns how high graphs are: 0: as a line of text; 1: as high as wished, if all rows then fit into the room.
float graphShare(float room, float passes) {
  const float em = ImGui::GetFontSize();
  const float line = ImGui::GetTextLineHeight() + 2.0f * ImGui::GetStyle().CellPadding.y;
  const float spare = room - (1.0f + fixedRows + passes) * line;
  return std::clamp(spare / ((fixedRows * (largeGraph - 1.0f) + passes * (smallGraph - 1.0f)) * em), 0.0f, 1.0f);
}

bool beginRows(PanelContext& ui, const char* id) {
  const float em = ImGui::GetFontSize();
  // The table scrolls by itself, so that its head stays. It is low enough for the lowest docked window, which would
  // scroll as well.
  const ImVec2 size(0.0f, std::max(ImGui::GetContentRegionAvail().y, 6.0f * em));
  if (!ImGui::BeginTable(id, 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_ScrollY,
                         size)) {
    return false;
  }
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthStretch, 2.0f);
  figureColumn("Median", 3.2f);
  figureColumn("p95", 3.2f);
  ImGui::TableSetupColumn("Graph", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int column = 0; column < 4; ++column) {
    ImGui::TableNextColumn();
    const char* name = ImGui::TableGetColumnName(column);
    column == 0 ? ImGui::TextUnformatted(name) : figure(name);
    recordWidget(ui, "performance.head " + std::to_string(column),
                 column == 3   ? "The newest frame is at the right."
                 : column == 1 ? "Most frames do not time their passes, because that makes a frame slower."
                               : "");
  }
  return true;
}

}  // namespace

void performance(PanelContext& ui) {
  const FrameHistory& history = ui.input.frame.history;
  bool paused = history.paused();
  if (ImGui::Checkbox("Pause", &paused)) {
    ui.send(PauseHistory{paused});
  }
  recordWidget(ui, "performance.pause");
  ImGui::SameLine();
  commandButton(ui, "Clear", "performance.clear", "", ClearHistory{});
  continueRow("Copy as CSV");
  if (button(ui, "Copy as CSV", "performance.copy", "Copies all figures of the frames below.")) {
    ui.send(CopyText{history.csv()});
  }
  const std::string frames = std::to_string(history.frames()) + (history.lowered() ? " draft" : "") +
                             (history.frames() == 1 ? " frame" : " frames");
  continueRow(frames.c_str());
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", frames.c_str());
  const std::vector<std::string> names = history.passNames();
  const float share = graphShare(ImGui::GetContentRegionAvail().y, static_cast<float>(names.size()));
  const auto height = [&](float most) { return std::lerp(1.0f, most, share) * ImGui::GetFontSize(); };
  if (!beginRows(ui, "times")) {
    return;
  }
  row(ui, "Frame", history.series(FrameHistory::Figure::frame), height(largeGraph));
  row(ui, "CPU", history.series(FrameHistory::Figure::cpu), height(largeGraph));
  row(ui, "GPU", history.series(FrameHistory::Figure::gpu), height(largeGraph));
  passRows(ui, names, passTree(names), height(smallGraph));
  ImGui::EndTable();
}

}  // namespace speculum::panels
