// The tree of passes, and the outline of the mirror that is pointed at in it.
#include <imgui.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "ui/panels.hpp"
#include "ui/pass_tree.hpp"

namespace speculum::panels {

namespace {

std::string metres(const std::optional<double>& value) {
  return value ? fmt::format("{:.2g}", *value) : "never";
}

void depthResolution(const PassView& pass, ClipMethod inUse) {
  ImGui::TextUnformatted(pass.resolution ? metres(gapWith(*pass.resolution, inUse)).c_str() : "");
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

void skippedRows(PanelContext& ui, const PassNode& node) {
  if (node.skipped.empty()) {
    return;
  }
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string title = std::to_string(node.skipped.size()) + " without a pass###skipped";
  const bool open = ImGui::TreeNodeEx(title.c_str(), ImGuiTreeNodeFlags_SpanFullWidth);
  recordWidget(ui, "skipped in " + ui.view.frame.passes[static_cast<size_t>(node.pass)].name);
  if (!open) {
    return;
  }
  for (const int i : node.skipped) {
    const SkippedView& skip = ui.view.frame.skipped[static_cast<size_t>(i)];
    const std::string name = pathEnd(skip.name);
    const std::string why = skip.reason + (skip.detail.empty() ? "" : " (" + skip.detail + ")");
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name.c_str());
    const bool nameHovered = ImGui::IsItemHovered();
    ImGui::TableNextColumn();
    textAcrossColumns(why);
    recordWidget(ui, "skipped." + skip.name);
    if (nameHovered || ImGui::IsItemHovered()) {
      ui.output.hoveredSkipped = skip.path;
      ImGui::SetTooltip("%s\n%s", skip.name.c_str(), why.c_str());
    }
  }
  ImGui::TreePop();
}

void passRow(PanelContext& ui, const PassNode& node) {
  const PassView& pass = ui.view.frame.passes[static_cast<size_t>(node.pass)];
  std::optional<std::vector<int>>& target = ui.state.targets.path;
  const bool shown = hasTarget(pass) && target == pass.path;
  const bool leaf = node.children.empty() && node.skipped.empty();
  ImGuiTreeNodeFlags flags =
      ImGuiTreeNodeFlags_SpanFullWidth | ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_DefaultOpen;
  flags |= leaf ? ImGuiTreeNodeFlags_Leaf : 0;
  flags |= shown ? ImGuiTreeNodeFlags_Selected : 0;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const std::string name = pathEnd(pass.name);
  const std::string id = pass.name + "/" + std::to_string(node.pass);
  const bool open = ImGui::TreeNodeEx(id.c_str(), flags, "%s", name.c_str());
  if (ImGui::IsItemHovered() || (ImGui::IsItemFocused() && ImGui::GetIO().NavVisible)) {
    ui.state.hoveredPass = node.pass;
  }
  recordWidget(ui, "pass." + pass.name);
  if (hasTarget(pass)) {
    tip(pass.name + "\nA click shows what it drew.");
  }
  if (hasTarget(pass) && ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) {
    target = shown ? std::nullopt : std::optional(pass.path);
    ui.state.choices.targets = !shown;
  }
  ImGui::TableNextColumn();
  if (pass.framesAgo > 0 && !ui.view.frame.still) {
    ImGui::TextDisabled("%s", milliseconds(pass.gpuMs).c_str());
    tip("The image of an earlier frame is reused.");
  } else {
    ImGui::TextUnformatted(milliseconds(pass.gpuMs).c_str());
  }
  ImGui::TableNextColumn();
  ImGui::Text("%u", pass.draws);
  ImGui::TableNextColumn();
  ImGui::Text("%.0f", pass.areaPx);
  ImGui::TableNextColumn();
  depthResolution(pass, ui.settings.reflection.clip);
  if (!open) {
    return;
  }
  for (const PassNode& child : node.children) {
    passRow(ui, child);
  }
  skippedRows(ui, node);
  ImGui::TreePop();
}

// Draws a light line over a wider dark one, which shows on any picture.
template <typename Draw>
void inTwoTones(const Draw& draw) {
  const float line = std::max(1.0f, 0.14f * ImGui::GetFontSize());
  draw(IM_COL32(0, 0, 0, 190), 2.5f * line);
  draw(IM_COL32(255, 196, 40, 255), line);
}

void skippedOutline(const PanelContext& ui) {
  if (ui.output.hoveredSkipped.empty() || ui.output.hoveredSkipped != ui.view.frame.outlinedSkipped) {
    return;
  }
  const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
  const auto onScreen = [&](const glm::dvec2& p) {
    return ImVec2(static_cast<float>(p.x) / pixels.x, static_cast<float>(p.y) / pixels.y);
  };
  inTwoTones([&](ImU32 color, float thickness) {
    for (const PixelLine& line : ui.view.frame.skippedOutline) {
      ImGui::GetBackgroundDrawList()->AddLine(onScreen(line.a), onScreen(line.b), color, thickness);
    }
  });
}

}  // namespace

void passOutline(const PanelContext& ui) {
  skippedOutline(ui);
  if (ui.state.hoveredPass < 0) {
    return;
  }
  const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
  std::vector<ImVec2> corners;
  for (const glm::vec2& corner : ui.view.frame.passes[static_cast<size_t>(ui.state.hoveredPass)].outline) {
    corners.emplace_back(corner.x / pixels.x, corner.y / pixels.y);
  }
  const int count = static_cast<int>(corners.size());
  inTwoTones([&](ImU32 color, float thickness) {
    ImGui::GetBackgroundDrawList()->AddPolyline(corners.data(), count, color, ImDrawFlags_Closed, thickness);
  });
}

void passes(PanelContext& ui) {
  const FrameView& frame = ui.view.frame;
  if (!ImGui::CollapsingHeader("Passes", ImGuiTreeNodeFlags_DefaultOpen)) {
    return;
  }
  ImGui::TextWrapped("CPU %s   GPU %s   Memory %s MiB", duration(frame.cpuMs).c_str(), duration(frame.gpuMs).c_str(),
                     mebibytes(frame.deviceBytes).c_str());
  constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
  if (!ImGui::BeginTable("passes", 5, flags)) {
    return;
  }
  const float figure = 4.0f * ImGui::GetFontSize();
  ImGui::TableSetupColumn("Pass", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("GPU ms", ImGuiTableColumnFlags_WidthFixed, figure);
  ImGui::TableSetupColumn("Draws", ImGuiTableColumnFlags_WidthFixed, 0.7f * figure);
  ImGui::TableSetupColumn("Pixels", ImGuiTableColumnFlags_WidthFixed, figure);
  ImGui::TableSetupColumn("Depth m", ImGuiTableColumnFlags_WidthFixed, figure);
  ImGui::TableHeadersRow();
  ImGui::PushStyleVar(ImGuiStyleVar_IndentSpacing, 0.3f * ImGui::GetFontSize());
  for (const PassNode& node : passTree(frame.passes, frame.skipped)) {
    passRow(ui, node);
  }
  ImGui::PopStyleVar();
  ImGui::EndTable();
}

}  // namespace speculum::panels
