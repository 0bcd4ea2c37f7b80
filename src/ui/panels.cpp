#include "ui/panels.hpp"

#include <imgui.h>

#include <algorithm>

#include "image/image.hpp"
#include "ui/setting_help.hpp"

namespace speculum::panels {

namespace {

// 1, 2, 4 or 8 samples.
void samplesCombo(UiModel& model, const char* label, int& samples, std::string_view key) {
  static constexpr std::array<const char*, 4> names = {"1", "2", "4", "8"};
  int index = samples >= 8 ? 3 : samples >= 4 ? 2 : samples >= 2 ? 1 : 0;
  if (ImGui::Combo(label, &index, names.data(), static_cast<int>(names.size()))) {
    samples = 1 << index;
  }
  describe(model, key);
}

void slider(UiModel& model, const char* label, double& value, double low, double high, const char* format,
            std::string_view key) {
  float edited = static_cast<float>(value);
  if (ImGui::SliderFloat(label, &edited, static_cast<float>(low), static_cast<float>(high), format,
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    value = edited;
  }
  describe(model, key);
}

template <typename Enum>
void choiceCombo(UiModel& model, const char* label, Enum& value, std::span<const char* const> names,
                 std::string_view key) {
  int index = static_cast<int>(value);
  if (ImGui::Combo(label, &index, names.data(), static_cast<int>(names.size()))) {
    value = static_cast<Enum>(index);
  }
  describe(model, key);
}

// The colour is linear in the settings and sRGB in the widget, as people know it from other programs.
void clearColor(UiModel& model) {
  const glm::dvec3 linear = model.settings.view.clearColor.value_or(glm::dvec3(model.sceneBackground));
  std::array<float, 3> encoded{};
  for (int i = 0; i < 3; ++i) {
    encoded[i] = static_cast<float>(srgbEncode(std::clamp(linear[i], 0.0, 1.0)));
  }
  if (ImGui::ColorEdit3("clear color", encoded.data())) {
    model.settings.view.clearColor = glm::dvec3(srgbDecode(encoded[0]), srgbDecode(encoded[1]), srgbDecode(encoded[2]));
  }
  describe(model, "view.clear_color");
  if (model.sceneSky && !model.settings.view.clearColor) {
    ImGui::TextDisabled("the scene's sky is shown; a colour replaces it");
  }
}

void reflectionSettings(UiModel& model) {
  ReflectionSettings& r = model.settings.reflection;
  static constexpr std::array<const char*, 3> clips = {"clip distance", "oblique", "none"};
  slider(model, "scale", r.scale, 0.125, 4.0, "%.3f", "reflection.scale");
  samplesCombo(model, "samples##reflection", r.samples, "reflection.samples");
  ImGui::SliderInt("max depth", &r.maxDepth, 0, 32, "%d", ImGuiSliderFlags_AlwaysClamp);
  describe(model, "reflection.max_depth");
  slider(model, "min pixels", r.minPixels, 0.0, 10000.0, "%.1f", "reflection.min_pixels");
  slider(model, "min throughput", r.minThroughput, 0.0, 1.0, "%.5f", "reflection.min_throughput");
  ImGui::SliderInt("max passes", &r.maxPasses, 1, 256, "%d", ImGuiSliderFlags_AlwaysClamp);
  describe(model, "reflection.max_passes");
  ImGui::SliderInt("update interval", &r.updateInterval, 1, 16, "%d", ImGuiSliderFlags_AlwaysClamp);
  describe(model, "reflection.update_interval");
  ImGui::Checkbox("keep what is unchanged", &r.skipUnchanged);
  describe(model, "reflection.skip_unchanged");
  slider(model, "mesh error", r.meshError, 0.0, 16.0, "%.2f", "reflection.mesh_error");
  choiceCombo(model, "clip", r.clip, clips, "reflection.clip");
}

void viewSettings(UiModel& model) {
  static constexpr std::array<const char*, 2> curves = {"clamp", "ACES"};
  static constexpr std::array<const char*, 2> filters = {"bilinear", "trilinear"};
  ViewSettings& v = model.settings.view;
  clearColor(model);
  samplesCombo(model, "samples##view", v.samples, "view.samples");
  slider(model, "exposure", v.exposure, 0.01, 100.0, "%.2f", "view.exposure");
  choiceCombo(model, "tone curve", v.toneMap, curves, "view.tone_map");
  choiceCombo(model, "texture filter", v.textureFilter, filters, "view.texture_filter");
  ImGui::Checkbox("wireframe", &v.wireframe);
  describe(model, "view.wireframe");
  ImGui::Checkbox("draw continuously", &v.continuous);
  describe(model, "view.continuous");
}

}  // namespace

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
    viewSettings(model);
  }
  if (ImGui::CollapsingHeader("Reflections", ImGuiTreeNodeFlags_DefaultOpen)) {
    reflectionSettings(model);
  }
  model.resetSettings = ImGui::Button("settings of the scene");
  tip("every setting back to what the scene and the command line have it at");
}

}  // namespace speculum::panels
