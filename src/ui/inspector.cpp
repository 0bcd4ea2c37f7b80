// The window that edits the scene.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cfloat>
#include <utility>

#include "ui/inspector_fields.hpp"

namespace speculum::panels {

namespace {

void nodeList(PanelContext& ui) {
  const EditView& edit = ui.view.edit;
  if (std::exchange(ui.state.focusNodes, false)) {
    ImGui::SetNextWindowFocus();
  }
  ImGui::BeginChild("nodes", ImVec2(0.0f, 7.5f * ImGui::GetTextLineHeightWithSpacing()), true);
  int* shown = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), -1);  // the row that was scrolled to
  int row = 0;
  for (const Selection& node : allNodes(*edit.scene)) {
    const bool selected = sameNode(node, edit.selected);
    const bool other = std::any_of(edit.others.begin(), edit.others.end(),
                                   [&](const Selection& selection) { return sameNode(selection, node); });
    ImGui::PushID(row);
    if (ImGui::Selectable(describe(*edit.scene, node).c_str(), selected || other)) {
      const ImGuiIO& io = ImGui::GetIO();
      ui.send(io.KeyShift || io.KeyCtrl ? Command(ToggleNode{node}) : Command(SelectNode{node}));
    }
    if (selected && std::exchange(*shown, row) != row) {
      ImGui::SetScrollHereY();
    }
    recordWidget(ui, "edit.node." + std::to_string(row));
    ImGui::PopID();
    ++row;
  }
  ImGui::EndChild();
}

void modelChoice(PanelContext& ui) {
  const std::vector<std::filesystem::path>& models = ui.view.edit.models;
  std::optional<std::filesystem::path>& chosen = ui.state.model;
  if (std::exchange(ui.state.modelsOf, ui.view.edit.scene) != ui.view.edit.scene) {
    chosen = models.empty() ? std::nullopt : std::optional(models.front());
  }
  constexpr const char* fileName = "a file ...";
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool open =
      ImGui::BeginCombo("##model", chosen ? chosen->stem().c_str() : fileName, ImGuiComboFlags_HeightLargest);
  recordWidget(ui, "edit.model");
  if (open) {
    for (size_t i = 0; i <= models.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));  // names may repeat
      const auto model = i < models.size() ? std::optional(models[i]) : std::nullopt;
      const std::string name = model ? model->stem().string() : fileName;
      if (ImGui::Selectable(name.c_str(), model == chosen)) {
        chosen = model;
      }
      recordWidget(ui, "edit.model." + (model ? name : "file"));
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  if (!chosen) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##model file", "OBJ file, absolute or from the scene's folder", &ui.state.modelFile);
    recordWidget(ui, "edit.model_file");
  }
}

void addButtons(PanelContext& ui) {
  if (button(ui, "Add mirror", "edit.add_mirror", "In the middle of the view, facing it")) {
    ui.send(AddMirror{});
  }
  ImGui::SameLine();
  if (button(ui, "Add light", "edit.add_light", "In the middle of the view")) {
    ui.send(AddLight{});
  }
  const bool named = ui.state.model || !ui.state.modelFile.empty();
  if (button(ui, "Add object", "edit.add_object",
             "In the middle of the view: a model of the scene, one that comes with the program, or a file", named)) {
    ui.send(AddObject{ui.state.model.value_or(ui.state.modelFile)});
  }
  ImGui::SameLine();
  modelChoice(ui);
}

void historyButtons(PanelContext& ui) {
  constexpr const char* scope = "\n(objects, lights, mirrors and bookmarks; settings have a reset arrow each)";
  const EditView& edit = ui.view.edit;
  const auto action = [&](const char* label, const char* key, const std::string& tip, bool enabled, Command command) {
    if (button(ui, label, key, tip.c_str(), enabled)) {
      ui.send(std::move(command));
    }
  };
  const bool any = static_cast<bool>(edit.selected);
  action("Duplicate", "edit.duplicate", "Ctrl+D", any, DuplicateSelected{});
  ImGui::SameLine();
  action("Delete", "edit.delete", "Del", any, RemoveSelected{});
  ImGui::SameLine();
  action("Undo", "edit.undo", "Ctrl+Z   " + edit.undo + scope, !edit.undo.empty(), Undo{});
  ImGui::SameLine();
  action("Redo", "edit.redo", "Ctrl+Shift+Z   " + edit.redo + scope, !edit.redo.empty(), Redo{});
  action("Save", "edit.save", "Ctrl+S   " + edit.scene->file.string(), edit.unsaved || edit.unsavedSettings, Save{});
  ImGui::SameLine();
  action("Save as ...", "edit.save_as", "Ctrl+Shift+S", true, AskWhereToSave{});
  ImGui::SameLine();
  ImGui::TextDisabled("%s", edit.unsaved ? "unsaved changes" : edit.unsavedSettings ? "unsaved settings" : "saved");
}

}  // namespace

void inspector(PanelContext& ui, PanelDock& dock) {
  if (!ui.state.inspector) {
    return;
  }
  if (ui.state.focusNodes) {
    ImGui::SetNextWindowFocus();
  }
  ImGui::SetNextWindowBgAlpha(1.0f);
  if (dock.begin(inspectorTitle, &ui.state.inspector, PanelDock::Edge::right, {25.0f, 46.0f})) {
    nodeList(ui);
    addButtons(ui);
    historyButtons(ui);
    ImGui::Separator();
    selectedNode(ui);
  }
  ImGui::End();
}

}  // namespace speculum::panels
