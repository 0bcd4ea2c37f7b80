#include "ui/inspector_fields.hpp"

#include <imgui.h>

#include <tuple>

#include "scene/scene_loader.hpp"
#include "ui/field_rows.hpp"

namespace speculum::panels {

namespace {

constexpr double farthest = 1e15;  // metres; docs/scene_format.md, Limits

// Draws a button between a vertex's numbers and its label.
bool vertexButton(PanelContext& ui, const char* label, const std::string& key, bool enabled, const char* about) {
  ImGui::SameLine(0.0f, ImGui::GetStyle().ItemInnerSpacing.x);
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(label, {ImGui::GetFrameHeight(), 0.0f});
  ImGui::EndDisabled();
  recordWidget(ui, "edit." + key);
  tip(about);
  return pressed;
}

// Draws one row. Returns true if anything was changed.
bool polygonVertex(PanelContext& ui, std::vector<glm::dvec3>& vertices, size_t i) {
  const std::string key = "polygon." + std::to_string(i);
  ImGui::PushID(static_cast<int>(i));
  const double low = -farthest;
  const double high = farthest;
  bool changed = ImGui::DragScalarN("##vertex", ImGuiDataType_Double, &vertices[i].x, 3, 0.01f, &low, &high, "%.6g",
                                    ImGuiSliderFlags_AlwaysClamp);
  recordWidget(ui, "edit." + key);
  tip("Metres. The polygon must stay planar and convex.");
  const glm::dvec3 middle = 0.5 * (vertices[i] + vertices[(i + 1) % vertices.size()]);
  if (vertexButton(ui, "+", key + ".add", true, "Adds a vertex halfway to the next one.")) {
    vertices.insert(vertices.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
    changed = true;
  } else if (vertexButton(ui, "-", key + ".remove", vertices.size() > 3, "Removes this vertex.")) {
    vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(i));
    changed = true;
  }
  ImGui::PopID();
  return changed;
}

// Edits the vertices of a polygon mirror, which become the mirror's once they are a valid polygon. Returns true if they
// did.
bool polygonRows(PanelContext& ui, Mirror& mirror) {
  PanelState::Polygon& polygon = ui.state.polygon;
  const int selected = ui.view.edit.selected.index;
  if (polygon.mirror != selected || polygon.taken != mirror.polygon) {
    polygon = {.vertices = mirror.polygon, .taken = mirror.polygon, .mirror = selected};
  }
  ImGui::TextDisabled("Vertices (m), counter-clockwise from the front");
  bool changed = false;
  for (size_t i = 0; i < polygon.vertices.size(); ++i) {
    changed = polygonVertex(ui, polygon.vertices, i) || changed;
  }
  if (changed) {
    polygon.problem = mirrorPolygonProblem(polygon.vertices);
    if (!polygon.problem) {
      mirror.polygon = polygon.taken = polygon.vertices;
    }
  }
  const bool applied = changed && !polygon.problem;
  if (polygon.problem) {
    coloredText(errorColor, "Not applied: " + *polygon.problem);
    if (button(ui, "Revert", "edit.polygon.reset", "Returns to the mirror's vertices.")) {
      polygon = {};
    }
  }
  return applied;
}

// Draws a button for each mirror that the node was picked through; a click selects it.
void throughButtons(PanelContext& ui) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Seen in:");
  for (size_t i = 0; i < ui.view.edit.through.size(); ++i) {
    const Selection mirror{Selection::Kind::mirror, ui.view.edit.through[i]};
    ImGui::SameLine();
    ImGui::PushID(static_cast<int>(i));  // a mirror may come twice
    if (ImGui::SmallButton(speculum::describe(*ui.view.edit.scene, mirror).c_str())) {
      ui.send(SelectNode{mirror});
    }
    recordWidget(ui, "edit.through." + std::to_string(i));
    ImGui::PopID();
    tip("Selects it.");
  }
}

void gizmoMode(PanelContext& ui) {
  for (const auto& [label, key, mode] :
       {std::tuple("Move", "edit.move", GizmoMode::move), std::tuple("Rotate", "edit.rotate", GizmoMode::turn),
        std::tuple("Scale", "edit.scale_handles", GizmoMode::scale)}) {
    if (ImGui::RadioButton(label, ui.view.edit.mode == mode)) {
      ui.send(SetGizmoMode{mode});
    }
    recordWidget(ui, key);
    tip("G switches between the handles. Hold Ctrl while dragging to snap.");
    ImGui::SameLine();
  }
  ImGui::NewLine();
}

}  // namespace

void selectedNode(PanelContext& ui) {
  const EditView& edit = ui.view.edit;
  if (!edit.selected) {
    ImGui::TextWrapped("Click an object, light or mirror in the picture, or choose it from the list.");
    return;
  }
  if (!edit.others.empty()) {
    ImGui::TextWrapped("%d more are selected. The fields show the first.", static_cast<int>(edit.others.size()));
  }
  if (!edit.through.empty()) {
    throughButtons(ui);
  }
  if (edit.selected.kind == Selection::Kind::mirror) {
    if (button(ui, "Look out of mirror", "edit.look_out", "Looks out of the mirror (Shift+B).")) {
      ui.send(LookFromMirror{MirrorSide::front});
    }
    ImGui::SameLine();
    if (button(ui, "Look from behind", "edit.look_behind", "Looks through the mirror at what it shows (B).")) {
      ui.send(LookFromMirror{MirrorSide::back});
    }
  }
  gizmoMode(ui);
  ImGui::PushItemWidth(-8.0f * ImGui::GetFontSize());
  const RecordWidget record = [&](const std::string& name) { recordWidget(ui, name); };
  SceneNode node = nodeOf(*edit.scene, edit.selected);
  bool edited = false;
  if (auto* object = std::get_if<Object>(&node)) {
    edited = fieldRows(*object, record);
  } else if (auto* light = std::get_if<PointLight>(&node)) {
    edited = fieldRows(*light, record);
  } else if (auto* mirror = std::get_if<Mirror>(&node)) {
    edited = fieldRows(*mirror, record, [&] { return polygonRows(ui, *mirror); });
  }
  ImGui::PopItemWidth();
  if (edited) {
    ui.state.editing = ImGui::IsAnyItemActive();
    ui.send(EditNode{edit.selected, std::move(node), ui.state.editing});
  }
}

}  // namespace speculum::panels
