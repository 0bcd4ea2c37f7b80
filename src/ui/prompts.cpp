// The prompts about unsaved changes and for the file to save to.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "platform/files.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;

// Width of fields, which leaves room for the prompt's border in a narrow window.
float fieldWidth() {
  const float em = ImGui::GetFontSize();
  return std::clamp(ImGui::GetIO().DisplaySize.x - 3.0f * em, 8.0f * em, 34.0f * em);
}

bool beginPrompt(const char* title) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  return ImGui::BeginPopupModal(title, nullptr, flags);
}

#if IMGUI_VERSION_NUM < 18700
constexpr ImGuiKey keypadEnter = ImGuiKey_KeyPadEnter;
#else
constexpr ImGuiKey keypadEnter = ImGuiKey_KeypadEnter;
#endif

bool enterPressed() {
  const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false); };
  return !ImGui::IsWindowAppearing() && (pressed(ImGuiKey_Enter) || pressed(keypadEnter));
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
  const EditView& edit = ui.view.edit;
  ImGui::TextUnformatted("Save the changes before closing this scene?");
  ImGui::TextDisabled("%s", (edit.saveFile ? *edit.saveFile : edit.scene->file.stem()).c_str());
  ImGui::Spacing();
  if (edit.saveFile) {
    answerButton(ui, "Save", "ask.save", Save{});
    ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
  }
  answerButton(ui, "Save as...", "ask.save_as", AskWhereToSave{});
  if (!edit.saveFile) {
    ImGui::SetItemDefaultFocus();
  }
  ImGui::SameLine();
  answerButton(ui, "Discard", "ask.discard", DiscardChanges{});
  ImGui::SameLine();
  answerButton(ui, "Cancel", "ask.cancel", CancelPrompt{});
}

void saveAs(PanelContext& ui) {
  ImGui::SetNextItemWidth(fieldWidth());
  if (ImGui::IsWindowAppearing()) {
    ui.state.saveAs = ui.view.edit.proposedFile.string();
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::InputText("##file", &ui.state.saveAs, ImGuiInputTextFlags_AutoSelectAll);
  recordWidget(ui, "edit.file");
  if (!ui.view.edit.note.empty()) {
    coloredText(errorColor, ui.view.edit.note);
  }
  ImGui::TextDisabled("Opens with the scene's own camera. M keeps a view as a bookmark.");
  const size_t commands = ui.output.commands.size();
  answerButton(ui, "Save", "where.save", SaveAs{ui.state.saveAs});
  ImGui::SameLine();
  answerButton(ui, "Cancel", "where.cancel", CancelPrompt{});
  if (ui.output.commands.size() == commands && enterPressed()) {
    ui.send(SaveAs{ui.state.saveAs});
    ImGui::CloseCurrentPopup();  // if saving fails it opens again, with the keyboard in the field
  }
}

void recovery(PanelContext& ui) {
  ImGui::TextUnformatted("Speculum ended with unsaved changes. Open the copy that it kept?");
  ImGui::TextDisabled("%s", ui.view.edit.proposedFile.c_str());
  ImGui::Spacing();
  answerButton(ui, "Open", "recovery.open", OpenScene{ui.view.edit.proposedFile});
  ImGui::SetItemDefaultFocus();
  ImGui::SameLine();
  answerButton(ui, "Ignore", "recovery.ignore", CancelPrompt{});
}

void enter(PanelState::Files& files, const std::filesystem::path& folder) {
  std::error_code none;
  files = {.folder = withoutLinks(folder), .entries = {}, .typed = {}};
  for (const auto& entry : std::filesystem::directory_iterator(files.folder, none)) {
    const std::filesystem::path& file = entry.path();
    const bool hidden = file.filename().string().starts_with('.');
    if (!hidden && (entry.is_directory(none) || file.extension() == ".toml" || file.extension() == ".obj")) {
      files.entries.push_back(entry);
    }
  }
  std::ranges::sort(files.entries, {}, [](const std::filesystem::directory_entry& entry) {
    std::error_code none;
    return std::pair(!entry.is_directory(none), entry.path().filename());
  });
}

void openFile(PanelContext& ui) {
  PanelState::Files& files = ui.state.files;
  const float em = ImGui::GetFontSize();
  if (ImGui::IsWindowAppearing()) {
    enter(files, ui.view.edit.proposedFile);
    ImGui::SetKeyboardFocusHere();
  }
  std::optional<std::filesystem::path> chosen;
  ImGui::SetNextItemWidth(fieldWidth());
  if (ImGui::InputTextWithHint("##typed", "Scene or model", &files.typed, ImGuiInputTextFlags_EnterReturnsTrue)) {
    chosen = files.folder / files.typed;
  }
  recordWidget(ui, "open.typed");
  ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + fieldWidth());
  ImGui::TextDisabled("%s", files.folder.c_str());
  ImGui::PopTextWrapPos();
  const float others = 8.0f * ImGui::GetFrameHeightWithSpacing();  // height of the menus and of the other rows
  ImGui::BeginChild("files", {fieldWidth(), std::min(20.0f * em, ImGui::GetIO().DisplaySize.y - others)}, true);
  if (ImGui::Selectable("..")) {
    chosen = files.folder.parent_path();
  }
  for (const std::filesystem::directory_entry& entry : files.entries) {
    std::error_code none;
    const bool folder = entry.is_directory(none);
    const std::string name = entry.path().filename().string();
    if (ImGui::Selectable((name + (folder ? "/" : "")).c_str(), name == files.typed,
                          ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups)) {
      files.typed = name;
      chosen = ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) ? std::optional(entry.path()) : chosen;
    }
    recordWidget(ui, "open." + name);
  }
  ImGui::EndChild();
  if (button(ui, "Open", "open.open", "", !files.typed.empty())) {
    chosen = files.folder / files.typed;
  }
  ImGui::SameLine();
  answerButton(ui, "Cancel", "open.cancel", CancelPrompt{});
  if (!chosen) {
    return;
  }
  if (isFolder(*chosen)) {
    return enter(files, *chosen);
  }
  ui.send(OpenScene{*chosen});
  ImGui::CloseCurrentPopup();
}

}  // namespace

void prompts(PanelContext& ui) {
  for (const auto& [prompt, title, content] :
       {std::tuple(Prompt::unsavedChanges, "Unsaved changes", &unsavedChanges),
        std::tuple(Prompt::saveAs, "Save as", &saveAs), std::tuple(Prompt::open, "Open", &openFile),
        std::tuple(Prompt::recovery, "Unsaved changes of the last session", &recovery)}) {
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
