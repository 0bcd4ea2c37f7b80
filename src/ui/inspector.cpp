// The window that edits the scene.
#include <imgui.h>
#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>
#include <imgui_versions.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <tuple>
#include <utility>

#include "edit/new_nodes.hpp"
#include "platform/text.hpp"
#include "scene/scene_loader.hpp"
#include "ui/panels.hpp"
#include "ui/pass_tree.hpp"

namespace speculum::panels {

namespace {

// Draws the list of all nodes. Returns true if it has the keyboard.
bool nodeList(PanelContext& ui) {
  const ShownEdit& edit = ui.input.edit;
  if (std::exchange(ui.state.focusNodes, false)) {
    ImGui::SetNextWindowFocus();
  }
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float height = std::clamp(0.25f * ImGui::GetContentRegionAvail().y, 3.5f * line, 7.5f * line);
  imgui::beginList("nodes", {0.0f, height}, ui.state.openedAt ? ImGuiWindowFlags_NoMouseInputs : 0);
  const bool focused = ImGui::IsWindowFocused();
  int* shown = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), -1);  // the row that was scrolled to
  *shown = edit.selected ? *shown : -1;
  int row = 0;
  for (const Selection& node : allNodes(*edit.scene)) {
    const bool selected = sameNode(node, edit.selected);
    const bool other =
        std::ranges::any_of(edit.others, [&](const Selection& selection) { return sameNode(selection, node); });
    ImGui::PushID(row);
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::Selectable(oneLine(describe(*edit.scene, node)).c_str(), selected || other)) {
      const bool entered = io.NavVisible && enterPressed();
      const bool toggles = !entered && (io.KeyShift || io.KeyCtrl);
      ui.send(toggles ? Command(ToggleNode{node}) : Command(SelectNode{node}));
      ui.state.focusFields = entered;
    }
    if (selected && std::exchange(*shown, row) != row) {
      ImGui::ScrollToBringRectIntoView(ImGui::GetCurrentWindow(), ImGui::GetCurrentContext()->LastItemData.Rect);
      if (io.NavVisible && ImGui::GetCurrentContext()->NavWindow == ImGui::GetCurrentWindow()) {
        focusItem();  // arrow keys and Enter go on from here
      }
    }
    recordWidget(ui, "edit.node." + std::to_string(row));
    ImGui::PopID();
    ++row;
  }
  ImGui::EndChild();
  return focused;
}

void modelChoice(PanelContext& ui) {
  const std::vector<std::filesystem::path>& models = ui.input.edit.models;
  std::optional<std::filesystem::path>& chosen = ui.state.model;
  if (std::exchange(ui.state.modelsOf, ui.input.edit.scene) != ui.input.edit.scene) {
    // Suggests a plain shape instead of the scene's first model, which often is a frame or a room.
    const auto plain = std::ranges::find(models, "sphere", [](const std::filesystem::path& m) { return m.stem(); });
    chosen = models.empty() ? std::nullopt : std::optional(plain != models.end() ? *plain : models.front());
  }
  ImGui::SetNextItemWidth(-FLT_MIN);
  const std::string preview = chosen ? oneLine(chosen->stem().string()) : "";
  const bool open = ImGui::BeginCombo("##model", preview.c_str(), ImGuiComboFlags_HeightLargest);
  recordWidget(ui, "edit.model");
  if (open) {
    if (ImGui::Selectable("File...")) {
      ui.send(AskWhatToAdd{});
    }
    recordWidget(ui, "edit.model.file");
    ImGui::Separator();
    for (size_t i = 0; i < models.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));  // models may have equal names
      const std::string name = oneLine(models[i].stem().string());
      if (ImGui::Selectable(name.c_str(), models[i] == chosen)) {
        chosen = models[i];
      }
      recordWidget(ui, "edit.model." + name);
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
}

void addButtons(PanelContext& ui) {
  commandButton(ui, "Add mirror", "edit.add_mirror", "Adds a mirror in the middle of the view, facing it.",
                AddMirror{});
  nextButton(ui, "Add light", "edit.add_light", "Adds a light in the middle of the view.", AddLight{});
  commandButton(ui, "Add object", "edit.add_object", "Adds an object with the chosen model in the middle of the view.",
                AddObject{ui.state.model.value_or("")}, ui.state.model.has_value());
  ImGui::SameLine();
  modelChoice(ui);
}

void historyButtons(PanelContext& ui) {
  const ShownEdit& edit = ui.input.edit;
  const bool any = static_cast<bool>(edit.selected);
  commandButton(ui, "Duplicate", "edit.duplicate", "Ctrl+D", DuplicateSelected{}, any);
  nextButton(ui, "Delete", "edit.delete", "Del", RemoveSelected{}, any);
  nextButton(ui, "Undo", "edit.undo", "Ctrl+Z   " + edit.undo, Undo{}, !edit.undo.empty());
  nextButton(ui, "Redo", "edit.redo", "Ctrl+Shift+Z   " + edit.redo, Redo{}, !edit.redo.empty());
  commandButton(ui, "Save", "edit.save", "Ctrl+S   " + (edit.saveFile ? edit.saveFile->string() : "Asks for a file"),
                Save{}, edit.canSave());
  nextButton(ui, "Save as...", "edit.save_as", "Ctrl+Shift+S", AskWhereToSave{});
  const char* state = edit.unsaved ? "unsaved changes" : edit.isNew ? "not saved yet" : "saved";
  continueRow(state);
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", state);
}

// Draws a button for each mirror that the node was picked through; a click selects it.
void throughButtons(PanelContext& ui) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Seen in:");
  for (size_t i = 0; i < ui.input.edit.through.size(); ++i) {
    const Selection mirror = mirrorNode(*ui.input.edit.scene, ui.input.edit.through[i]);
    const std::string name = oneLine(speculum::describe(*ui.input.edit.scene, mirror));
    continueRow(name.c_str());
    ImGui::PushID(static_cast<int>(i));  // a mirror may come twice
    if (ImGui::SmallButton(name.c_str())) {
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
    if (ImGui::RadioButton(label, ui.input.edit.mode == mode)) {
      ui.send(SetGizmoMode{mode});
    }
    if (std::exchange(ui.state.focusFields, false)) {
      focusItem();
      ImGui::SetScrollHereY();
    }
    recordWidget(ui, key, "G switches between the handles. Hold Ctrl while dragging to snap.");
    ImGui::SameLine();
  }
  ImGui::NewLine();
}

// Draws a row for a key of a mirror's own quality: a box, then the setting's widget, which shows the settings' value in
// grey while the box is not checked. A change of the value checks it. Returns true if the user changed anything.
template <typename T>
bool qualityRow(PanelContext& ui, const std::string& name, std::optional<T>& own, T ReflectionSettings::*member) {
  const std::string key = "reflection." + name;
  const std::optional<T> before = own;
  bool on = own.has_value();
  ImGui::PushID(name.c_str());
  ImGui::Checkbox("##own", &on);
  recordWidget(ui, "edit.quality." + name, "Checked: this mirror's own value. Else that of the settings.");
  ImGui::SameLine();
  Settings shown = ui.settings;
  T& value = shown.reflection.*member;
  value = on ? own.value_or(value) : value;
  const ImGuiStyle& style = ImGui::GetStyle();
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, style.Alpha * (on ? 1.0f : style.DisabledAlpha));
  settingWidget(ui, *findSettingField(key), shown);
  ImGui::PopStyleVar();
  on = on || value != ui.settings.reflection.*member;
  recordWidget(ui, "edit.quality." + name + ".value", settingHelp(key));
  ImGui::PopID();
  own = on ? std::optional(value) : std::nullopt;
  return own != before;
}

// Draws what the mirror costs, how wrong it is, and its own quality. Returns true if the user changed that.
bool mirrorQuality(PanelContext& ui, MirrorQuality& quality) {
  using R = ReflectionSettings;
  const int mirror = ui.input.edit.selected.index;
  // Two lines, so that the widgets below stay in their places when the text becomes shorter.
  const float below = ImGui::GetCursorPosY() + 2.0f * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y;
  dimmedText(mirrorCost(ui.input.frame, mirror));
  recordWidget(ui, "edit.mirror_cost",
               "Its images in the last frame, also those seen in other mirrors. The time is the median of the last "
               "frames, as in Performance.");
  ImGui::SetCursorPosY(std::max(below, ImGui::GetCursorPosY()));
  ImGui::Checkbox("Show its error", &ui.state.showDifference);
  recordWidget(ui, "edit.mirror_error",
               "Compares the still picture with the traced reference, and shows where it differs. The number is the "
               "mean within the mirror's outline, with what stands before it.");
  if (ui.state.showDifference) {
    const std::vector<double>& errors = ui.input.accuracy.mirrorErrors;
    const bool known = static_cast<size_t>(mirror) < errors.size();
    ImGui::SameLine();
    wrappedText(!known                       ? ui.input.accuracy.difference
                : std::isnan(errors[mirror]) ? "not in view"
                                             : fmt::format("{:.4f} mean FLIP", errors[mirror]));
  }
  const bool open = ImGui::CollapsingHeader(quality == MirrorQuality() ? "Quality: as the settings###quality"
                                                                       : "Quality: its own###quality");
  recordWidget(ui, "edit.quality", "Makes this mirror cheaper, or sharper, than the others.");
  if (!open) {
    return false;
  }
  ImGui::PushItemWidth(-10.5f * ImGui::GetFontSize());
  bool edited = qualityRow(ui, "scale", quality.scale, &R::scale);
  edited |= qualityRow(ui, "samples", quality.samples, &R::samples);
  edited |= qualityRow(ui, "update_interval", quality.updateInterval, &R::updateInterval);
  edited |= qualityRow(ui, "method", quality.method, &R::method);
  ImGui::PopItemWidth();
  return edited;
}

// Scrolls to the fields of a node that was selected elsewhere than in the list, unless they are high in the window.
void scrollToFields(PanelContext& ui, bool inList) {
  const Selection& selected = ui.input.edit.selected;
  const bool changed = !sameNode(std::exchange(ui.state.fieldsOf, selected), selected);
  if (changed && selected && !inList && ImGui::GetCursorPosY() > 0.6f * ImGui::GetWindowHeight()) {
    ImGui::SetScrollFromPosY(ImGui::GetCursorPosY() - ImGui::GetScrollY(), 0.0f);
  }
}

// Draws the scene's camera. Numbers that give no view stay in the panel, with the reason.
void cameraRows(PanelContext& ui) {
  const CameraSpec& taken = ui.input.edit.scene->camera;
  std::optional<PanelState::RefusedCamera>& refused = ui.state.refusedCamera;
  if (refused && refused->taken != taken) {
    refused.reset();
  }
  const bool open = ImGui::CollapsingHeader("Camera");
  recordWidget(ui, "edit.camera", "The view with which the scene opens, and to which Reset camera returns.");
  if (!open) {
    return;
  }
  commandButton(ui, "Take this view", "edit.camera.take",
                "Makes the window's view the scene's camera. If the camera orbited, it stands still.", TakeView{});
  CameraSpec camera = refused ? refused->camera : taken;
  ImGui::PushItemWidth(-9.2f * ImGui::GetFontSize());
  if (fieldRows(ui, camera)) {
    if (cameraProblem(camera)) {
      refused = {camera, taken};
    } else {
      refused.reset();
      ui.state.editing = ImGui::IsAnyItemActive();
      ui.send(EditCamera{camera, ui.state.editing});
    }
  }
  ImGui::PopItemWidth();
  if (refused) {
    ui.output.refusedEdit = true;
    coloredText(errorColor, "Not applied: " + *cameraProblem(refused->camera));
    if (button(ui, "Revert", "edit.camera.reset", "Returns to the scene's camera.")) {
      refused.reset();
    }
  }
}

void selectedNode(PanelContext& ui) {
  const ShownEdit& edit = ui.input.edit;
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
  SceneNode node = nodeOf(*edit.scene, edit.selected);
  bool edited = false;
  if (edit.selected.kind == Selection::Kind::mirror) {
    commandButton(ui, "Look out of mirror", "edit.look_out", "Looks out of the mirror (Shift+B).",
                  LookFromMirror{MirrorSide::front});
    nextButton(ui, "Look from behind", "edit.look_behind",
               "Looks at the mirror's back from behind, or at the wall that it hangs on (B).",
               LookFromMirror{MirrorSide::back});
    edited = mirrorQuality(ui, std::get<Mirror>(node).quality);
  }
  if (edit.selected.kind == Selection::Kind::object) {
    standUpButton(ui, edit.selected, "edit.stand_up");
  }
  gizmoMode(ui);
  ImGui::PushItemWidth(-9.2f * ImGui::GetFontSize());
  edited = fieldRows(ui, node) || edited;
  ImGui::PopItemWidth();
  if (edit.selected.kind == Selection::Kind::mirror) {
    dimmedText(
        "A mirror is flat. For a curved one add an object, such as a sphere, and check Mirror among its fields.");
  }
  if (edited) {
    ui.state.editing = ImGui::IsAnyItemActive();
    ui.send(EditNode{edit.selected, std::move(node), ui.state.editing});
  }
}

}  // namespace

void standUpButton(PanelContext& ui, const Selection& object, const std::string& name) {
  const Scene& scene = *ui.input.edit.scene;
  const SceneNode node = nodeOf(scene, object);
  if (const Object* lying = std::get_if<Object>(&node); lying && liesOnBack(scene, *lying)) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("It seems to lie on its back.");
    nextButton(ui, "Stand it up", name, "Makes the model's Z axis point up.", EditNode{object, stoodUp(scene, *lying)});
  }
}

void inspector(PanelContext& ui, PanelDock& dock) {
  if (!ui.state.choices.inspector) {
    return;
  }
  if (ui.state.focusNodes) {
    ImGui::SetNextWindowFocus();
  }
  ImGui::SetNextWindowBgAlpha(1.0f);
  if (dock.begin(inspectorTitle, &ui.state.choices.inspector, PanelDock::Edge::right, modestEms(inspectorEms),
                 ui.state.openedAt ? ImGuiWindowFlags_NoMouseInputs : 0)) {
    const bool inList = nodeList(ui);
    addButtons(ui);
    historyButtons(ui);
    ImGui::Separator();
    cameraRows(ui);
    scrollToFields(ui, inList);
    selectedNode(ui);
  }
  ImGui::End();
}

}  // namespace speculum::panels
