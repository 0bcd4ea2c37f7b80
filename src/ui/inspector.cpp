// The window that edits the scene.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <utility>

#include "ui/gizmo_overlay.hpp"
#include "ui/inspector_parts.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

void actionButton(UiModel& model, const char* label, const char* key, EditAction action, bool enabled,
                  const std::string& tip) {
  ImGui::BeginDisabled(!enabled);
  if (ImGui::Button(label)) {
    model.edit.action = action;
  }
  ImGui::EndDisabled();
  notePlace(model, std::string("edit.") + key);
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    ImGui::SetTooltip("%s", tip.c_str());
  }
}

namespace {

void thingList(UiModel& model) {
  UiEdit& edit = model.edit;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  if (std::exchange(edit.focus, false)) {
    ImGui::SetNextWindowFocus();
  }
  ImGui::BeginChild("things", ImVec2(0.0f, 7.5f * line), true);
  int* shown = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), -1);  // what was scrolled to
  for (size_t i = 0; i < edit.things.size(); ++i) {
    const auto& [thing, name] = edit.things[i];
    const bool selected = sameThing(thing, edit.selected);
    const bool other = std::any_of(edit.others.begin(), edit.others.end(),
                                   [&, &thing = thing](const Selection& o) { return sameThing(o, thing); });
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(name.c_str(), selected || other)) {
      const ImGuiIO& io = ImGui::GetIO();
      if (io.KeyShift || io.KeyCtrl) {
        edit.toggled = thing;
      } else {
        edit.selected = thing;
      }
    }
    if (selected && std::exchange(*shown, static_cast<int>(i)) != static_cast<int>(i)) {
      ImGui::SetScrollHereY();
    }
    notePlace(model, "edit.thing." + std::to_string(i));
    ImGui::PopID();
  }
  ImGui::EndChild();
}

void modelChoice(UiModel& model) {
  UiEdit& edit = model.edit;
  const auto count = static_cast<int>(edit.models.size());
  const auto name = [&](int i) { return i < count ? edit.models[static_cast<size_t>(i)].c_str() : "a file ..."; };
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool open = ImGui::BeginCombo("##model", name(edit.model), ImGuiComboFlags_HeightLargest);
  notePlace(model, "edit.model");
  if (open) {
    for (int i = 0; i <= count; ++i) {
      ImGui::PushID(i);  // names may repeat
      if (ImGui::Selectable(name(i), i == edit.model)) {
        edit.model = i;
      }
      notePlace(model, std::string("edit.model.") + (i < count ? name(i) : "file"));
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  if (edit.model == count) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##model file", "OBJ file, absolute or from the scene's folder", &edit.modelFile);
    notePlace(model, "edit.model_file");
  }
}

void addButtons(UiModel& model) {
  const UiEdit& edit = model.edit;
  actionButton(model, "add mirror", "add_mirror", EditAction::addMirror, true, "where the view looks, facing it");
  ImGui::SameLine();
  actionButton(model, "add light", "add_light", EditAction::addLight, true, "where the view looks");
  const bool named = edit.model < static_cast<int>(edit.models.size()) || !edit.modelFile.empty();
  actionButton(model, "add object", "add_object", EditAction::addObject, named,
               "where the view looks: a model of the scene, one that comes with the program, or a file");
  ImGui::SameLine();
  modelChoice(model);
}

constexpr const char* undoneIs = "\n(things and bookmarks; settings go back by the arrows at their lines' ends)";

void historyButtons(UiModel& model) {
  const UiEdit& edit = model.edit;
  const bool any = static_cast<bool>(edit.selected);
  actionButton(model, "duplicate", "duplicate", EditAction::duplicate, any, "Ctrl+D");
  ImGui::SameLine();
  actionButton(model, "delete", "delete", EditAction::remove, any, "Del");
  ImGui::SameLine();
  actionButton(model, "undo", "undo", EditAction::undo, !edit.undo.empty(), "Ctrl+Z   " + edit.undo + undoneIs);
  ImGui::SameLine();
  actionButton(model, "redo", "redo", EditAction::redo, !edit.redo.empty(), "Ctrl+Shift+Z   " + edit.redo + undoneIs);
  actionButton(model, "save", "save", EditAction::save, edit.unsaved || edit.unsavedSettings, "Ctrl+S   " + edit.file);
  ImGui::SameLine();
  actionButton(model, "save as ...", "save_as", EditAction::askWhere, true, "Ctrl+Shift+S");
  ImGui::SameLine();
  ImGui::TextDisabled("%s", edit.unsaved ? "unsaved changes" : edit.unsavedSettings ? "unsaved settings" : "saved");
}

void inspector(UiModel& model, PanelDock& dock) {
  if (model.edit.focus) {
    ImGui::SetNextWindowFocus();
  }
  ImGui::SetNextWindowBgAlpha(1.0f);
  if (dock.begin(inspectorTitle, &model.edit.open, PanelDock::Edge::right, {25.0f, 46.0f})) {
    thingList(model);
    addButtons(model);
    historyButtons(model);
    ImGui::Separator();
    selectedThing(model);
  }
  ImGui::End();
}

}  // namespace

void inspectorButton(UiModel& model) {
  if (ImGui::Button("inspector")) {
    model.edit.open = !model.edit.open;
  }
  notePlace(model, "edit.open");
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("F2: select, move, turn, add and delete what the scene is made of");
  }
}

void edit(UiModel& model, PanelDock* dock) {
  model.edit.edited = false;
  model.edit.action = EditAction::none;
  model.edit.toggled.reset();
  drawOverlay(model.edit.overlay);
  if (model.edit.open && dock) {
    inspector(model, *dock);
  }
  questions(model);
  model.edit.held = model.edit.selected && ImGui::IsAnyItemActive();
}

}  // namespace speculum::panels
