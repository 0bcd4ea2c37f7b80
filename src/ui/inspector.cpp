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
  ImGui::BeginChild("nodes", ImVec2(0.0f, 7.5f * ImGui::GetTextLineHeightWithSpacing()), true,
                    ui.state.openedAt ? ImGuiWindowFlags_NoMouseInputs : 0);
  int* shown = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), -1);  // the row that was scrolled to
  int row = 0;
  for (const Selection& node : allNodes(*edit.scene)) {
    const bool selected = sameNode(node, edit.selected);
    const bool other =
        std::ranges::any_of(edit.others, [&](const Selection& selection) { return sameNode(selection, node); });
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
    // A plain shape, rather than the frame or room that scenes begin with.
    const auto plain = std::ranges::find(models, "sphere", [](const std::filesystem::path& m) { return m.stem(); });
    chosen = models.empty() ? std::nullopt : std::optional(plain != models.end() ? *plain : models.front());
  }
  constexpr const char* fileName = "File...";
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
    ImGui::InputTextWithHint("##model file", "OBJ file", &ui.state.modelFile);
    recordWidget(ui, "edit.model_file");
  }
}

void addButtons(PanelContext& ui) {
  if (button(ui, "Add mirror", "edit.add_mirror", "Adds a mirror in the middle of the view, facing it.")) {
    ui.send(AddMirror{});
  }
  ImGui::SameLine();
  if (button(ui, "Add light", "edit.add_light", "Adds a light in the middle of the view.")) {
    ui.send(AddLight{});
  }
  const bool named = ui.state.model || !ui.state.modelFile.empty();
  if (button(ui, "Add object", "edit.add_object", "Adds the model beside in the middle of the view.", named)) {
    ui.send(AddObject{ui.state.model.value_or(ui.state.modelFile)});
  }
  ImGui::SameLine();
  modelChoice(ui);
}

void historyButtons(PanelContext& ui) {
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
  action("Undo", "edit.undo", "Ctrl+Z   " + edit.undo, !edit.undo.empty(), Undo{});
  ImGui::SameLine();
  action("Redo", "edit.redo", "Ctrl+Shift+Z   " + edit.redo, !edit.redo.empty(), Redo{});
  action("Save", "edit.save", "Ctrl+S   " + edit.scene->file.string(), edit.unsaved, Save{});
  ImGui::SameLine();
  action("Save as...", "edit.save_as", "Ctrl+Shift+S", true, AskWhereToSave{});
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s", edit.unsaved ? "unsaved changes" : "saved");
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
  if (dock.begin(inspectorTitle, &ui.state.inspector, PanelDock::Edge::right, inspectorEms,
                 ui.state.openedAt ? ImGuiWindowFlags_NoMouseInputs : 0)) {
    nodeList(ui);
    addButtons(ui);
    historyButtons(ui);
    ImGui::Separator();
    selectedNode(ui);
  }
  ImGui::End();
}

}  // namespace speculum::panels
