#include "ui/panels.hpp"

#include <imgui.h>

#include "ui/setting_help.hpp"
#include "ui/setting_widgets.hpp"

namespace speculum::panels {

void describe(UiModel& model, std::string_view key) {
  notePlace(model, key);
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s", settingHelp(key).c_str());
  }
  if (!differs(model.settings, model.sceneSettings, key)) {
    return;
  }
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::GetFrameHeight());
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0.0f);
  if (ImGui::ArrowButton(("reset " + std::string(key)).c_str(), ImGuiDir_Left)) {
    resetSetting(model.settings, model.sceneSettings, key);
  }
  ImGui::PopStyleVar();
  notePlace(model, "reset." + std::string(key));
  if (ImGui::IsItemHovered()) {
    const std::string value = settingValue(model.sceneSettings, key);
    ImGui::SetTooltip("back to the scene's: %s", value.empty() ? "background and sky" : value.c_str());
  }
}

void tip(const char* text) {
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("%s", text);
  }
}

void notePlace(UiModel& model, std::string_view key) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 size = ImGui::GetItemRectSize();
  model.widgets.emplace_back(key, PixelRect{static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(size.x),
                                            static_cast<int>(size.y)});
}

void message(const UiModel& model) {
  if (!model.message.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.92f, 0.38f, 0.28f, 1.0f));
    ImGui::TextWrapped("%s", model.message.c_str());
    ImGui::PopStyleColor();
  }
}

namespace {

void bookmarks(UiModel& model) {
  const int shown = model.bookmark;
  ImGui::SetNextItemWidth(10.0f * ImGui::GetFontSize());
  const bool open = ImGui::BeginCombo("##bookmarks", shown >= 0 ? model.bookmarks[shown].c_str() : "bookmarks");
  notePlace(model, "bookmarks");
  if (open) {
    for (int i = 0; i < static_cast<int>(model.bookmarks.size()); ++i) {
      if (ImGui::Selectable(model.bookmarks[i].c_str(), i == shown)) {
        model.goToBookmark = i;
      }
      notePlace(model, "bookmark." + model.bookmarks[i]);
    }
    ImGui::EndCombo();
  }
  tip("views that the scene keeps; Shift+M: the next one");
  ImGui::SameLine();
  model.bookmarkView = ImGui::Button("bookmark view");
  notePlace(model, "bookmark.add");
  tip("keeps where the camera stands and looks; saved with the scene");
  if (shown >= 0) {
    ImGui::SameLine();
    model.removeBookmark = ImGui::Button("remove");
    notePlace(model, "bookmark.remove");
  }
}

}  // namespace

void scene(UiModel& model) {
  const bool open = ImGui::BeginCombo("scene", model.scenes[model.scene].c_str(), ImGuiComboFlags_HeightLargest);
  notePlace(model, "scene");
  if (open) {
    for (int i = 0; i < static_cast<int>(model.scenes.size()); ++i) {
      ImGui::PushID(i);  // names may repeat
      if (ImGui::Selectable(model.scenes[i].c_str(), i == model.scene)) {
        model.scene = i;
      }
      ImGui::PopID();
      notePlace(model, "scene." + model.scenes[i]);
    }
    ImGui::EndCombo();
  }
  if (!open) {
    tip((model.scenePaths[static_cast<size_t>(model.scene)] + "\nScenes has pictures of them").c_str());
  }
  int mode = static_cast<int>(model.cameraMode);
  ImGui::RadioButton("orbit", &mode, static_cast<int>(CameraMode::orbit));
  tip("dragging turns about what is looked at");
  ImGui::SameLine();
  ImGui::RadioButton("fly", &mode, static_cast<int>(CameraMode::fly));
  tip("dragging turns the head");
  model.cameraMode = static_cast<CameraMode>(mode);
  ImGui::SameLine();
  model.resetCamera = ImGui::Button("reset camera");
  tip("to where the scene has it");
  bookmarks(model);
  time(model);
  model.copyCommand = ImGui::Button("copy command line");
  notePlace(model, "copy");
  tip("the call of speculum render that draws this view to the same bytes, with unsaved changes from a copy of the "
      "scene");
  ImGui::SameLine();
  inspectorButton(model);
  ImGui::SameLine();
  model.screenshot = ImGui::Button("screenshot");
  notePlace(model, "screenshot");
  tip("F12: save the window as a picture; Shift+F12: without the panel");
}

void settings(UiModel& model) {
  if (ImGui::CollapsingHeader("View", ImGuiTreeNodeFlags_DefaultOpen)) {
    settingRows(model, "view.");
    if (model.sceneSky && !model.settings.view.clearColor) {
      ImGui::TextDisabled("The scene's sky is shown; a clear color replaces it.");
    }
  }
  if (ImGui::CollapsingHeader("Reflections", ImGuiTreeNodeFlags_DefaultOpen)) {
    settingRows(model, "reflection.");
  }
  model.resetSettings = ImGui::Button("Reset settings");
  tip("every setting back to what the scene and the command line have it at");
}

}  // namespace speculum::panels
