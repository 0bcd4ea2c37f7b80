// The prompts about unsaved changes and for the file to save to.
#include <imgui.h>
#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>
#include <imgui_versions.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "edit/scene_writer.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/model_files.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

bool enterPressed() {
  return !ImGui::IsWindowAppearing() &&
         (imgui::isPressed(ImGuiKey_Enter, false) || imgui::isPressed(imgui::keypadEnter, false));
}

void focusItem() {
  ImGui::SetFocusID(ImGui::GetItemID(), ImGui::GetCurrentWindow());
  imgui::showFocus();
}

namespace {

using Focus = PanelState::Files::Focus;

constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings;

// Width of fields, which leaves room for the prompt's border in a narrow window.
float fieldWidth() {
  const float em = ImGui::GetFontSize();
  return std::clamp(ImGui::GetIO().DisplaySize.x - 3.0f * em, 8.0f * em, 34.0f * em);
}

bool beginPrompt(const char* title, bool recenter) {
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), recenter ? ImGuiCond_Always : ImGuiCond_Appearing,
                          ImVec2(0.5f, 0.5f));
  return ImGui::BeginPopupModal(title, nullptr, flags);
}

// Returns whether it was pressed.
bool answerButton(PanelContext& ui, const char* label, std::string_view key, Command command) {
  const bool pressed = ImGui::Button(label);
  if (pressed) {
    ui.send(std::move(command));
  }
  recordWidget(ui, key);
  return pressed;
}

// Gives the last item the keyboard when its prompt opens, and shows that it has it.
void focusAnswer() {
  ImGui::SetItemDefaultFocus();
  if (ImGui::IsItemFocused()) {
    imgui::showFocus();
  }
}

void unsavedChanges(PanelContext& ui) {
  const ShownEdit& edit = ui.input.edit;
  const float before = ImGui::CalcTextSize("Save the changes before ?").x;
  ImGui::Text("Save the changes before %s?", thatFits(edit.afterPrompt, fieldWidth() - before).c_str());
  ImGui::TextDisabled("%s", (edit.saveFile ? *edit.saveFile : edit.scene->file.stem()).string().c_str());
  if (ui.output.refusedEdit) {
    coloredText(warningColor, "The vertices that were typed are not applied: they cannot be saved.");
  }
  ImGui::Spacing();
  if (edit.saveFile) {
    answerButton(ui, "Save", "ask.save", Save{});
    focusAnswer();
    ImGui::SameLine();
  }
  answerButton(ui, "Save as...", "ask.save_as", AskWhereToSave{});
  if (!edit.saveFile) {
    focusAnswer();
  }
  ImGui::SameLine();
  answerButton(ui, "Discard", "ask.discard", DiscardChanges{});
  ImGui::SameLine();
  answerButton(ui, "Cancel", "ask.cancel", CancelPrompt{});
}

// Lists what can be chosen in a folder: folders, and scenes or models or both.
void list(PanelState::Files& files, const std::filesystem::path& folder, Prompt prompt) {
  std::error_code none;
  files.listed = folder;
  files.entries.clear();
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const std::filesystem::path& file = entry.path();
    const bool hidden = file.filename().string().starts_with('.');
    const bool fits =
        isModelFile(file) ? prompt != Prompt::saveAs : prompt != Prompt::addObject && file.extension() == ".toml";
    if (!hidden && (entry.is_directory(none) || fits)) {
      files.entries.push_back(entry);
    }
  }
  std::ranges::sort(files.entries, {}, [](const std::filesystem::directory_entry& entry) {
    std::error_code none;
    return std::pair(!entry.is_directory(none), entry.path().filename());
  });
}

std::string textOf(const std::filesystem::path& file) {
  return utf8(file.filename().string());
}

// Returns the file that is named. The name of a listed one may not be UTF-8, as what stands in the field is.
std::filesystem::path named(const PanelState::Files& files) {
  const auto listed = std::ranges::find(files.entries, files.typed, &textOf);
  return files.folder / (listed != files.entries.end() ? listed->path().filename() : typedPath(files.typed));
}

// Begins the state of a prompt: the name stands in the field and is relative to `folder`.
void enter(PanelState::Files& files, const std::filesystem::path& folder, const std::filesystem::path& name = {}) {
  files = {};
  files.folder = withoutLinks(folder);
  files.typed = textOf(name);
}

// Draws the field, which takes no more than the longest path. Returns true if Enter was pressed in it.
bool typedField(PanelState::Files& files, const char* id, const char* hint) {
  std::array<char, 4096> text{};
  files.typed.copy(text.data(), text.size() - 1);
  const bool entered = ImGui::InputTextWithHint(
      id, hint, text.data(), text.size(), ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  files.typed = text.data();
  return entered;
}

// Gives the field the keyboard if that is due. Call it before the field is drawn.
void focusField(PanelState::Files& files) {
  if (files.focus == Focus::field) {
    files.focus = Focus::none;
    ImGui::SetKeyboardFocusHere();
  }
}

// Height that the list leaves to a message below it, so that the prompt keeps its size and its place.
float messageHeight(const std::string& message) {
  return message.empty()
             ? 0.0f
             : ImGui::CalcTextSize(message.c_str(), nullptr, false, fieldWidth()).y + ImGui::GetStyle().ItemSpacing.y;
}

struct ChosenRow {
  std::filesystem::path file;
  bool folder = false;
  bool opens = false;  // by a double click or Enter, else it was clicked once
};

// Draws the list of a folder, above the message. If the name was `edited` in this frame, scrolls to the first entry
// that begins with it.
std::optional<ChosenRow> fileList(PanelContext& ui, const std::filesystem::path& folder, float height, bool edited,
                                  const std::string& message) {
  PanelState::Files& files = ui.state.files;
  std::error_code none;
  const std::filesystem::path shown = named(files);
  const std::string begun = shown.filename().string();
  bool scrolls = edited && !begun.empty();
  if (folder != files.listed) {
    list(files, folder, ui.input.edit.prompt);
    files.modelsOutside =
        modelsOutside(*ui.input.edit.scene, folder).size() + mapsOutside(*ui.input.edit.scene, folder).size();
  }
  const float width = fieldWidth();
  ImGui::TextDisabled("%s", files.listed.string().c_str());
  std::optional<ChosenRow> chosen;
  if (edited) {
    files.marked.clear();
  }
  const float others = 8.0f * ImGui::GetFrameHeightWithSpacing();  // height of the menus and of the other rows
  const float most = std::min(height, ImGui::GetIO().DisplaySize.y - others);
  imgui::beginList("files", {width, std::max(most - messageHeight(message), ImGui::GetFrameHeight())});
  const auto row = [&](const std::string& name, const std::string& label, const std::filesystem::path& file,
                       bool isFolder, bool first) {
    constexpr auto rowFlags = ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups;
    if (ImGui::Selectable(oneLine(label).c_str(), file == shown || file == files.marked, rowFlags) ||
        (ImGui::IsItemFocused() && enterPressed())) {
      files.marked = file;
      chosen = {file, isFolder, enterPressed() || ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)};
    }
    if (first && files.focus == Focus::list) {
      files.focus = Focus::none;
      focusItem();
    }
    recordWidget(ui, "open." + name);
  };
  row("..", "..", files.listed.parent_path(), true, files.entries.empty());
  for (size_t i = 0; i < files.entries.size(); ++i) {
    const std::filesystem::path& file = files.entries[i].path();
    const std::string name = file.filename().string();
    const bool isFolder = files.entries[i].is_directory(none);
    row(name, name + (isFolder ? "/" : ""), file, isFolder, i == 0);
    if (scrolls && name.starts_with(begun)) {
      ImGui::SetScrollHereY();
      scrolls = false;
    }
  }
  ImGui::EndChild();
  return chosen;
}

void saveAs(PanelContext& ui) {
  PanelState::Files& files = ui.state.files;
  ImGui::SetNextItemWidth(fieldWidth());
  if (ImGui::IsWindowAppearing()) {
    const std::filesystem::path& proposed = ui.input.edit.proposedFile;
    enter(files, proposed.parent_path(), proposed);
    files.folder = proposed.parent_path();  // with its links, because the suggested folder is known by that path
  }
  const std::string& note = ui.input.edit.note;
  files.focus = !note.empty() && std::exchange(files.note, note) != note ? Focus::field : files.focus;
  focusField(files);
  const bool entered = typedField(files, "##file", "");
  const bool edited = ImGui::IsItemEdited();
  recordWidget(ui, "edit.file");
  // The list's folder is where the file goes, so it is listed as empty until saving makes it.
  const std::filesystem::path folder = withoutLinks(named(files).parent_path());
  const auto chosen = fileList(ui, folder, 12.0f * ImGui::GetFontSize(), edited, note);
  if (chosen && (chosen->opens || !chosen->folder)) {
    files.typed = textOf(chosen->folder ? named(files) : chosen->file);
    files.folder = chosen->folder ? chosen->file : folder;
    files.focus = chosen->folder && enterPressed() ? Focus::list : files.focus;
  }
  if (!note.empty()) {
    coloredText(errorColor, note);
  }
  const bool moves = files.modelsOutside > 0 && folder != withoutLinks(ui.input.edit.ownFile).parent_path();
  if (moves) {
    ImGui::Checkbox("Copy the models here too", &ui.state.copyModels);
    recordWidget(ui, "where.models", "With materials and textures, into 'models' beside the scene; else they stay.");
  }
  ImGui::TextDisabled("Opens with the scene's own camera. M keeps a view as a bookmark.");
  const SaveAs answer{named(files), moves && ui.state.copyModels};
  bool sent = answerButton(ui, "Save", "where.save", answer);
  ImGui::SameLine();
  answerButton(ui, "Cancel", "where.cancel", CancelPrompt{});
  // Dear ImGui 1.89.4 to 1.90.1 count the field in which Enter was pressed as such a widget.
  const bool pressesWidget = ImGui::GetCurrentContext()->NavActivateId != 0 && !entered;
  const bool enters = !chosen && !pressesWidget && enterPressed();
  if (enters && isFolder(named(files))) {
    enter(files, named(files), ui.input.edit.proposedFile);
  } else if (enters) {
    ui.send(answer);
    sent = true;
  }
  if (sent) {
    files.note.clear();  // a further refusal gives the field the keyboard again, whatever its text
  }
}

// Says how long ago a file was written; empty if there is none.
std::string ageOf(const std::filesystem::path& file) {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  if (error) {
    return "";
  }
  const auto age = std::filesystem::file_time_type::clock::now() - written;
  const auto minutes = std::chrono::duration_cast<std::chrono::minutes>(age).count();
  if (minutes < 1) {
    return "just now ";
  }
  const auto [count, unit] = minutes < 60     ? std::pair(minutes, "minute")
                             : minutes < 1440 ? std::pair(minutes / 60, "hour")
                                              : std::pair(minutes / 1440, "day");
  return fmt::format("{} {}{} ago ", count, unit, count == 1 ? "" : "s");
}

void recovery(PanelContext& ui) {
  ImGui::TextUnformatted("Speculum ended with unsaved changes. Open the copy that it kept?");
  const std::filesystem::path& copy = ui.input.edit.proposedFile;
  const std::filesystem::path& own = ui.input.edit.ownFile;
  ImGui::TextDisabled("%s", (own.empty() ? copy.filename() : own).string().c_str());
  ImGui::TextDisabled("kept %sin %s", ageOf(copy).c_str(), copy.parent_path().string().c_str());
  ImGui::Spacing();
  answerButton(ui, "Open", "recovery.open", OpenScene{ui.input.edit.proposedFile});
  focusAnswer();
  ImGui::SameLine();
  answerButton(ui, "Discard", "recovery.discard", DiscardChanges{});
  ImGui::SameLine();
  answerButton(ui, "Ask again later", "recovery.later", CancelPrompt{});
}

void openFile(PanelContext& ui) {
  PanelState::Files& files = ui.state.files;
  const bool adds = ui.input.edit.prompt == Prompt::addObject;
  if (ImGui::IsWindowAppearing()) {
    enter(files, ui.input.edit.proposedFile);
  }
  focusField(files);
  ImGui::SetNextItemWidth(fieldWidth());
  bool opens = typedField(files, "##typed", adds ? "Model" : "Scene or model");
  const bool edited = ImGui::IsItemEdited();
  if (edited) {
    files.problem.clear();
  }
  recordWidget(ui, "open.typed");
  std::filesystem::path folder;
  for (const std::filesystem::path& part : withoutLinks(named(files).parent_path())) {
    if (!isFolder(folder / part)) {
      break;
    }
    folder /= part;
  }
  const auto chosen = fileList(ui, folder, 20.0f * ImGui::GetFontSize(), edited, files.problem);
  if (chosen) {
    files.typed = chosen->file == files.listed.parent_path() ? ".." : textOf(chosen->file);
    files.folder = files.listed;
    files.problem.clear();
    opens = chosen->opens;
  }
  if (!files.problem.empty()) {
    coloredText(errorColor, files.problem);
  }
  opens = button(ui, adds ? "Add" : "Open", "open.open", "", !files.typed.empty()) || opens;
  ImGui::SameLine();
  answerButton(ui, "Cancel", "open.cancel", CancelPrompt{});
  std::filesystem::path file = named(files);
  std::error_code none;
  if (!opens) {
    return;
  }
  if (isFolder(file)) {
    enter(files, file);
    files.focus = chosen && enterPressed() ? Focus::list : files.focus;
    return;
  }
  std::filesystem::path scene = file;
  scene += ".toml";
  if (!adds && !std::filesystem::exists(file, none) && std::filesystem::exists(scene, none) && !isFolder(scene)) {
    file = std::move(scene);
  }
  if (!std::filesystem::exists(file, none)) {
    files.problem = "There is no file " + file.string();
    files.focus = Focus::field;
    return;
  }
  ui.send(adds ? Command(AddObject{file}) : Command(OpenScene{file}));
}

}  // namespace

void prompts(PanelContext& ui) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  const glm::vec2 display(size.x, size.y);
  const bool resized = std::exchange(ui.state.promptDisplay, display) != display;
  for (const auto& [prompt, title, content] :
       {std::tuple(Prompt::unsavedChanges, "Unsaved changes", &unsavedChanges),
        std::tuple(Prompt::saveAs, "Save as", &saveAs), std::tuple(Prompt::open, "Open", &openFile),
        std::tuple(Prompt::addObject, "Add object", &openFile),
        std::tuple(Prompt::recovery, "Unsaved changes of the last session", &recovery)}) {
    const bool asked = ui.input.edit.prompt == prompt;
    if (asked && !ImGui::IsPopupOpen(title)) {
      ImGui::OpenPopup(title);
    } else if (!asked && ImGui::IsPopupOpen(title)) {
      ImGui::ClosePopupToLevel(0, true);
    }
    if (beginPrompt(title, resized)) {
      ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + fieldWidth());
      content(ui);
      ImGui::PopTextWrapPos();
      ImGui::EndPopup();
    }
  }
}

}  // namespace speculum::panels
