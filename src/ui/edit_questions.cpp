// The questions about what is not saved, and for the file to save to.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/inspector_parts.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

void centerNext() {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
}

bool enterPressed() {
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false); };
  return !ImGui::IsWindowAppearing() && (pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter));
}

void answerButton(UiModel& model, const char* label, const char* key, EditAction action) {
  // Dear ImGui presses what has the keyboard with the space bar only.
  const bool pressed = ImGui::Button(label);
  if (pressed || (ImGui::IsItemFocused() && enterPressed())) {
    model.edit.action = action;
    ImGui::CloseCurrentPopup();
  }
  notePlace(model, std::string("edit.") + key);
}

}  // namespace

void questions(UiModel& model) {
  UiEdit& edit = model.edit;
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;
  if (edit.asksSave && !ImGui::IsPopupOpen("Unsaved changes")) {
    ImGui::OpenPopup("Unsaved changes");
  }
  centerNext();
  if (ImGui::BeginPopupModal("Unsaved changes", nullptr, flags)) {
    ImGui::Text("The scene has changes that are not saved.");
    ImGui::TextDisabled("%s", edit.file.c_str());
    ImGui::Spacing();
    answerButton(model, "Save", "ask.save", EditAction::save);
    ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    answerButton(model, "Save as ...", "ask.save_as", EditAction::askWhere);
    ImGui::SameLine();
    answerButton(model, "Discard", "ask.discard", EditAction::discard);
    ImGui::SameLine();
    answerButton(model, "Cancel", "ask.cancel", EditAction::stay);
    if (!edit.asksSave) {
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }
  if (edit.asksWhere && !ImGui::IsPopupOpen("Save scene as")) {
    ImGui::OpenPopup("Save scene as");
  }
  centerNext();
  if (ImGui::BeginPopupModal("Save scene as", nullptr, flags)) {
    ImGui::SetNextItemWidth(34.0f * ImGui::GetFontSize());
    if (ImGui::IsWindowAppearing()) {
      ImGui::SetKeyboardFocusHere();
    }
    ImGui::InputText("##file", &edit.saveAs, ImGuiInputTextFlags_AutoSelectAll);
    notePlace(model, "edit.file");
    if (!edit.note.empty()) {
      ImGui::TextWrapped("%s", edit.note.c_str());
    }
    answerButton(model, "Save", "where.save", EditAction::saveAs);
    ImGui::SameLine();
    answerButton(model, "Cancel", "where.cancel", EditAction::stay);
    if (edit.action == EditAction::none && enterPressed()) {
      edit.action = EditAction::saveAs;
    }
    if (!edit.asksWhere) {
      ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
  }
}

}  // namespace speculum::panels
