// The prompts about unsaved changes and for the file to save to.
#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;

bool beginPrompt(const char* title) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  return ImGui::BeginPopupModal(title, nullptr, flags);
}

bool enterPressed() {
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false); };
  return !ImGui::IsWindowAppearing() && (pressed(ImGuiKey_Enter) || pressed(ImGuiKey_KeyPadEnter));
}

void answerButton(PanelContext& ui, const char* label, std::string_view key, Command command) {
  // Dear ImGui presses the focused button with the space bar only; this adds Enter.
  const bool pressed = ImGui::Button(label);
  recordWidget(ui, key);
  if (pressed || (ImGui::IsItemFocused() && enterPressed())) {
    ui.send(std::move(command));
    ImGui::CloseCurrentPopup();
  }
}

void unsavedChanges(PanelContext& ui) {
  ImGui::Text("The scene has unsaved changes.");
  ImGui::TextDisabled("%s", ui.view.edit.scene->file.c_str());
  ImGui::Spacing();
  answerButton(ui, "Save", "ask.save", Save{});
  ImGui::SetItemDefaultFocus();
  ImGui::SameLine();
  answerButton(ui, "Save as ...", "ask.save_as", AskWhereToSave{});
  ImGui::SameLine();
  answerButton(ui, "Discard", "ask.discard", DiscardChanges{});
  ImGui::SameLine();
  answerButton(ui, "Cancel", "ask.cancel", CancelPrompt{});
}

void saveAs(PanelContext& ui) {
  ImGui::SetNextItemWidth(34.0f * ImGui::GetFontSize());
  if (ImGui::IsWindowAppearing()) {
    ui.state.saveAs = ui.view.edit.proposedFile.string();
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::InputText("##file", &ui.state.saveAs, ImGuiInputTextFlags_AutoSelectAll);
  recordWidget(ui, "edit.file");
  if (!ui.view.edit.note.empty()) {
    ImGui::TextWrapped("%s", ui.view.edit.note.c_str());
  }
  const size_t commands = ui.output.commands.size();
  answerButton(ui, "Save", "where.save", SaveAs{ui.state.saveAs});
  ImGui::SameLine();
  answerButton(ui, "Cancel", "where.cancel", CancelPrompt{});
  if (ui.output.commands.size() == commands && enterPressed()) {
    ui.send(SaveAs{ui.state.saveAs});
  }
}

}  // namespace

void prompts(PanelContext& ui) {
  for (const auto& [prompt, title, content] : {std::tuple(Prompt::unsavedChanges, "Unsaved changes", &unsavedChanges),
                                               std::tuple(Prompt::saveAs, "Save scene as", &saveAs)}) {
    const bool asked = ui.view.edit.prompt == prompt;
    if (asked && !ImGui::IsPopupOpen(title)) {
      ImGui::OpenPopup(title);
    }
    if (beginPrompt(title)) {
      asked ? content(ui) : ImGui::CloseCurrentPopup();
      ImGui::EndPopup();
    }
  }
}

}  // namespace speculum::panels
