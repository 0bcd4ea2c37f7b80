// The tree of passes.
#include <imgui.h>
#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "platform/text.hpp"
#include "ui/panels.hpp"
#include "ui/pass_tree.hpp"

namespace speculum::panels {

namespace {

// Selects the last mirror of the path. The path is that of the last frame; an edit may have removed mirrors since.
void selectMirror(PanelContext& ui, const MirrorPath& path, bool inspect) {
  const Scene& scene = *ui.input.edit.scene;
  if (!path.empty() && static_cast<size_t>(path.back()) < scene.mirrorCount()) {
    ui.send(SelectNode{mirrorNode(scene, path.back()), inspect});
  }
}

std::string metres(const std::optional<double>& value) {
  return value ? significant(*value, 2) : "never";
}

void depthResolution(const PassRow& pass, ClipMethod inUse) {
  figure(pass.resolution ? metres(gapWith(*pass.resolution, inUse)) : "");
  if (!pass.resolution) {
    return;
  }
  std::string text = "Metres between surfaces seen at " + std::to_string(static_cast<int>(readoutAngle)) +
                     " degrees that depth keeps in order where the pass sees farthest, " +
                     metres(pass.resolution->distance) + " m from its eye.";
  for (const auto& [clip, name] : {std::pair(ClipMethod::clipDistance, "clip distance"),
                                   std::pair(ClipMethod::oblique, "oblique"), std::pair(ClipMethod::none, "none")}) {
    text +=
        std::string("\n") + name + ": " + metres(gapWith(*pass.resolution, clip)) + (clip == inUse ? "  (in use)" : "");
  }
  tip(text);
}

// Says whether the pointer is over the cell that is drawn. Nodes of trees span all columns in newer versions of ImGui.
bool isCellHovered() {
  const ImRect cell = ImGui::TableGetCellBgRect(ImGui::GetCurrentTable(), ImGui::TableGetColumnIndex());
  return ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(cell.Min, cell.Max);
}

// Draws text from the cell to the window's edge, over the empty cells to its right.
void textAcrossColumns(const std::string& text) {
  const ImVec2 corner = ImGui::GetWindowPos();
  const ImVec2 size = ImGui::GetWindowSize();
  const float top = corner.y + ImGui::GetFrameHeight();  // below the title
  ImGui::PushClipRect({ImGui::GetCursorScreenPos().x, top}, {corner.x + size.x, corner.y + size.y}, false);
  ImGui::PushTextWrapPos(size.x - ImGui::GetStyle().ScrollbarSize - ImGui::GetStyle().WindowPadding.x);
  ImGui::TextDisabled("%s", text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopClipRect();
}

// Takes the frame's passes, or their figures alone while the pointer is on the rows, which then keep their places.
void followPasses(PanelState::Rows& rows, const ShownFrame& frame) {
  if (!rows.held || frame.passes.empty()) {
    rows.passes = frame.passes;
    rows.skipped = frame.skipped;
    return;
  }
  for (PassRow& pass : rows.passes) {
    const auto now = std::ranges::find_if(frame.passes, [&](const PassRow& p) { return PassId(p) == PassId(pass); });
    now != frame.passes.end() ? void(pass = *now) : void(pass.timed = false);
  }
}

void skippedRows(PanelContext& ui, const TreeNode& node) {
  if (node.skipped.empty()) {
    return;
  }
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const bool open = ImGui::TreeNodeEx("###skipped", ImGuiTreeNodeFlags_SpanFullWidth);
  recordWidget(ui, "skipped in " + ui.state.passes.passes[static_cast<size_t>(node.pass)].name);
  ImGui::SameLine();
  textAcrossColumns(std::to_string(node.skipped.size()) + " without a pass");
  if (!open) {
    return;
  }
  ImGui::Indent(ImGui::GetTreeNodeToLabelSpacing());
  for (const int i : node.skipped) {
    const SkippedRow& skip = ui.state.passes.skipped[static_cast<size_t>(i)];
    const std::string name = pathEnd(skip.name);
    const std::string why = skip.reason + (skip.detail.empty() ? "" : " (" + skip.detail + ")");
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", thatFits(name).c_str());
    const bool nameHovered = ImGui::IsItemHovered();
    ImGui::TableNextColumn();
    textAcrossColumns(why);
    recordWidget(ui, "skipped." + skip.name);
    if (nameHovered || ImGui::IsItemHovered()) {
      showTip(skip.name + "\n" + why + "\nA click selects the mirror.");
      mirrorRow(ui, skip.path);
    }
  }
  ImGui::Unindent(ImGui::GetTreeNodeToLabelSpacing());
  ImGui::TreePop();
}

void passRow(PanelContext& ui, const TreeNode& node) {
  const PassRow& pass = ui.state.passes.passes[static_cast<size_t>(node.pass)];
  std::optional<MirrorPath>& target = ui.state.targets.path;
  const bool shown = hasTarget(pass) && target == pass.path;
  const bool leaf = node.children.empty() && node.skipped.empty();
  ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_SpanFullWidth | ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_DefaultOpen;
  flags |= leaf ? ImGuiTreeNodeFlags_Leaf : 0;
  flags |= shown ? ImGuiTreeNodeFlags_Selected : 0;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const float room = ImGui::GetContentRegionAvail().x - ImGui::GetTreeNodeToLabelSpacing();
  const std::string name = endsThatFit(pathEnd(pass.name), room, textWidth);
  const std::string id = fmt::format("{} {} {} {} {}", static_cast<int>(pass.kind), fmt::join(pass.path, ">"),
                                     pass.instance, pass.light, pass.face);
  const bool open = ImGui::TreeNodeEx(id.c_str(), flags, "%s", name.c_str());
  bool hovered = ImGui::IsItemHovered() || (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible);
  bool clicked = ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen();
  recordWidget(ui, "pass." + pass.name);
  const char* selects = pass.path.empty() ? "" : ", and selects the mirror";
  tip(pass.name + (hasTarget(pass) ? fmt::format("\nA click shows what it drew{}.", selects) : ""));
  const auto watchCell = [&] {
    const bool over = isCellHovered();
    hovered = hovered || over;
    clicked = clicked || (over && ImGui::IsMouseClicked(ImGuiMouseButton_Left));
  };
  ImGui::TableNextColumn();
  watchCell();
  figure(milliseconds(pass.gpuMs), pass.reused || !pass.timed);
  if (pass.reused) {
    tip("The image of an earlier frame is reused. The time is that of rendering it.");
  } else if (!pass.timed) {
    tip(std::isnan(pass.gpuMs) ? "Not timed yet." : "Time of an earlier frame.");
  }
  ImGui::TableNextColumn();
  watchCell();
  figure(std::to_string(pass.draws));
  ImGui::TableNextColumn();
  watchCell();
  figure(pass.areaPx > 0.0 ? fmt::format("{:.0f}", pass.areaPx) : "");
  ImGui::TableNextColumn();
  watchCell();
  depthResolution(pass, ui.settings.reflection.clip);
  if (hovered) {
    ui.output.hoveredPath = pass.path;
  }
  if (hasTarget(pass) && clicked) {
    target = shown ? std::nullopt : std::optional(pass.path);
    ui.state.choices.targets = !shown;
    selectMirror(ui, pass.path, false);  // the inspector would cover what it drew
  }
  if (!open) {
    return;
  }
  for (const TreeNode& child : node.children) {
    passRow(ui, child);
  }
  skippedRows(ui, node);
  ImGui::TreePop();
}

// Draws a row with the rest of the frame's time, so that the rows add up to it.
void restRow(PanelContext& ui) {
  const double rest = restOfPasses(ui.input.frame);
  if (std::isnan(rest)) {
    return;
  }
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetTreeNodeToLabelSpacing());
  ImGui::TextUnformatted("other work");
  recordWidget(
      ui, "passes.rest",
      "GPU time of the frame that no pass above took: for the panels, in each of the frames that drew a part of "
      "the picture, and for waiting between passes.");
  ImGui::TableNextColumn();
  figure(milliseconds(rest));
}

void header(PanelContext& ui) {
  static constexpr std::array<const char*, 5> about{
      "The main view and, below the view that each is seen in, the mirror images. A click orders them as in the scene.",
      "GPU time of the pass. Grey: of an earlier frame. A click puts the longest first, as they are now.",
      "Draw calls of the pass.",
      "Pixels that the pass draws: of the main view, or of a mirror's image as far as it is seen.",
      "Smallest distance in depth, in metres, between two surfaces that the pass still keeps in order."};
  ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
  for (int column = 0; column < static_cast<int>(about.size()); ++column) {
    ImGui::TableSetColumnIndex(column);
    const char* name = ImGui::TableGetColumnName(column);
    column > 0 ? figure(name) : ImGui::TextUnformatted(name);
    recordWidget(ui, "passes.head " + std::to_string(column), about[static_cast<size_t>(column)]);
    if (column <= 1 && ImGui::IsItemClicked()) {
      std::vector<PassRow> sorted = column == 1 ? ui.state.passes.passes : std::vector<PassRow>();
      std::ranges::stable_sort(sorted, {}, [](const PassRow& p) { return std::isnan(p.gpuMs) ? 0.0 : -p.gpuMs; });
      ui.state.passes.order.assign(sorted.begin(), sorted.end());
    }
  }
}

}  // namespace

void mirrorRow(PanelContext& ui, const MirrorPath& path) {
  ui.output.hoveredPath = path;
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
    selectMirror(ui, path, true);
  }
}

void passes(PanelContext& ui) {
  const ShownFrame& frame = ui.input.frame;
  PanelState::Rows& rows = ui.state.passes;
  const bool pointed = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  if (!pointed) {
    rows.step = ui.input.edit.undo;
  } else if (rows.step != ui.input.edit.undo) {
    rows.step.reset();  // an edit may have given a mirror the index of another
  }
  rows.held = pointed && rows.step;
  followPasses(rows, frame);
  wrappedText("GPU " + duration(frame.timedGpuMs > 0.0 ? frame.timedGpuMs : frame.gpuMs) + "   Memory " +
              mebibytes(frame.deviceBytes) + " MiB");
  tip("GPU time of the last picture whose passes were timed, the sum of the rows below; if none was, of the last "
      "picture. Timing slows a frame.");
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  const bool narrow = ImGui::GetContentRegionAvail().x < 22.0f * ImGui::GetFontSize();  // too narrow for all figures
  const ImGuiTableColumnFlags further = narrow ? ImGuiTableColumnFlags_Disabled : ImGuiTableColumnFlags_None;
  if (!ImGui::BeginTable("passes", 5, flags)) {
    return;
  }
  ImGui::TableSetupColumn("Pass", ImGuiTableColumnFlags_WidthStretch);
  figureColumn("GPU ms", 3.5f);
  figureColumn("Draws", 2.8f);
  figureColumn("Pixels", 4.5f, further);
  figureColumn("Depth gap", 4.4f, further);
  header(ui);
  ImGui::PushStyleVar(ImGuiStyleVar_IndentSpacing, 0.3f * ImGui::GetFontSize());
  for (const TreeNode& node : passTree(rows.passes, rows.skipped, rows.order)) {
    passRow(ui, node);
  }
  restRow(ui);
  ImGui::PopStyleVar();
  ImGui::EndTable();
}

}  // namespace speculum::panels
