#include "ui/panels.hpp"

#include <imgui.h>
#include <imgui_internal.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <imgui_versions.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "platform/text.hpp"
#include "scene/model_files.hpp"
#include "settings/setting_fields.hpp"

namespace speculum::panels {

namespace {

constexpr ImGuiWindowFlags fixedWindow = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
constexpr double leastSpan = 20.0;  // seconds that the slider reaches

void bookmarks(PanelContext& ui) {
  const std::vector<Bookmark>& bookmarks = ui.input.edit.scene->bookmarks;
  const int shown = ui.input.camera.bookmark;
  ImGui::SetNextItemWidth(10.0f * ImGui::GetFontSize());
  const bool open = ImGui::BeginCombo("##bookmarks", shown >= 0 ? oneLine(bookmarks[shown].name).c_str() : "Bookmarks");
  recordWidget(ui, "bookmarks");
  if (open) {
    for (size_t i = 0; i < bookmarks.size(); ++i) {
      if (ImGui::Selectable(oneLine(bookmarks[i].name).c_str(), static_cast<int>(i) == shown)) {
        ui.send(GoToBookmark{i});
      }
      recordWidget(ui, "bookmark." + bookmarks[i].name);
    }
    ImGui::EndCombo();
  }
  tip("Views that are saved with the scene. Shift+M goes to the next one.");
  nextButton(ui, "Bookmark view", "bookmark.add", "Saves the camera's position and direction with the scene (M).",
             AddBookmark{});
  if (shown >= 0) {
    nextButton(ui, "Remove", "bookmark.remove", "Removes the bookmark from the scene.",
               RemoveBookmark{static_cast<size_t>(shown)});
  }
}

void sceneChoice(PanelContext& ui) {
  const ShownScenes& browser = ui.input.browser;
  const SceneEntry& shown = browser.scenes[browser.shown];
  const std::string name = oneLine(shown.name);
  const std::string label = labelFor("Scene", textWidth(name) + 2.0f * ImGui::GetFrameHeight());
  const bool open = ImGui::BeginCombo(label.c_str(), name.c_str(), ImGuiComboFlags_HeightLargest);
  recordWidget(ui, "scene");
  if (!open) {
    return tip(shown.file.string() + "\nWindow > Scenes shows pictures of all scenes.");
  }
  for (size_t i = 0; i < browser.scenes.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));  // names may repeat
    if (ImGui::Selectable(oneLine(browser.scenes[i].name).c_str(), i == browser.shown) && i != browser.shown) {
      ui.send(OpenScene{browser.scenes[i].file});
    }
    ImGui::PopID();
    recordWidget(ui, "scene." + browser.scenes[i].name);
  }
  ImGui::EndCombo();
}

void cameraMode(PanelContext& ui) {
  for (const auto& [label, mode, about] : {std::tuple("Orbit", CameraMode::orbit, "Dragging orbits about the target."),
                                           std::tuple("Fly", CameraMode::fly, "Dragging looks around.")}) {
    if (ImGui::RadioButton(label, ui.input.camera.mode == mode)) {
      ui.send(SetCameraMode{mode});
    }
    tip(about);
    continueRow("Reset camera");
  }
  commandButton(ui, "Reset camera", "camera.reset", "Returns to the scene's camera.", ResetCamera{});
}

void timeControls(PanelContext& ui) {
  const ShownPlayback& playback = ui.input.playback;
  // The slider's range doubles whenever the time reaches its end. A time that is typed may lie beyond it.
  const double spans = playback.time / leastSpan;
  const double span = leastSpan * (spans < 1.0 ? 1.0 : std::exp2(std::floor(std::log2(spans)) + 1.0));
  float seconds = static_cast<float>(playback.time);
  if (ImGui::SliderFloat("Time", &seconds, 0.0f, static_cast<float>(span), "%.3f s")) {
    ui.send(Seek{std::max(seconds, 0.0f)});
  }
  recordWidget(ui, "time", "Time of the animation. Drag, or Ctrl+click to type; Space pauses.");
  commandButton(ui, "<", "time.back", "Steps back by 1/60 s. Key: comma.", StepTime{-1});
  ImGui::SameLine();
  commandButton(ui, ">", "time.on", "Steps forward by 1/60 s. Key: period.", StepTime{1});
  ImGui::SameLine();
  bool paused = playback.paused;
  if (ImGui::Checkbox("Pause", &paused)) {
    ui.send(SetPaused{paused});
  }
  recordWidget(
      ui, "pause",
      "Pauses the animation (Space). The picture then converges, and the line below says what it approximates.");
  const float width = 6.0f * ImGui::GetFontSize();
  continueRow("Speed", width);
  float speed = static_cast<float>(playback.speed);
  ImGui::SetNextItemWidth(width);
  if (ImGui::SliderFloat("Speed", &speed, static_cast<float>(slowestTime), static_cast<float>(fastestTime), "%.3g x",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    ui.send(SetTimeSpeed{speed});
  }
  recordWidget(ui, "time.speed", "Speed of the animation. Keys: [ halves it, ] doubles it.");
}

// Returns a text with the time of the passes that a setting acts on, from the last frame whose passes were timed.
std::string measuredHere(const ShownFrame& frame, std::string_view key) {
  const SettingField& field = *findSettingField(key);
  if (field.changes >= FramePart::display || std::holds_alternative<ColorSetting>(field.kind)) {
    return "";
  }
  const bool mirrors = key.starts_with("reflection.");
  double ms = 0.0;
  for (const PassRow& pass : frame.passes) {
    const bool counts = pass.kind == (mirrors ? PassKind::mirror : PassKind::main) && pass.timed && !pass.reused;
    ms += counts ? pass.gpuMs : 0.0;
  }
  const bool known = ms > 0.0 && (mirrors || key.starts_with("view."));
  return known ? std::string("\nHere ") + (mirrors ? "mirror images take " : "the main view takes ") + duration(ms) +
                     " of a frame's " + duration(frame.timedGpuMs) + " on the GPU."
               : "";
}

}  // namespace

void describe(PanelContext& ui, std::string_view key) {
  const ShownAccuracy& accuracy = ui.input.accuracy;
  const auto price = accuracy.prices.find(key);
  const bool priced = price != accuracy.prices.end() && !accuracy.otherView;
  const std::vector<int>& samples = ui.input.device.samples;
  const bool limited = key.ends_with(".samples") && !samples.empty();
  const std::string range = limited ? fmt::format("{} on this device", fmt::join(samples, " ")) : "";
  recordWidget(ui, key, settingHelp(key, range) + measuredHere(ui.input.frame, key) + (priced ? price->second : ""));
  const Settings& ofScene = ui.input.sceneSettings;
  const SettingField& field = *findSettingField(key);
  if (sameSetting(field, ui.settings, ofScene)) {
    return;
  }
  // The keyboard does not move along a line that the window's edge cuts.
  if (ImGui::IsItemDeactivated()) {
    ImGui::ScrollToBringRectIntoView(ImGui::GetCurrentWindow(), ImGui::GetCurrentContext()->LastItemData.Rect);
  }
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::GetFrameHeight());
  ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0.0f);
  if (ImGui::ArrowButton(("reset " + std::string(key)).c_str(), ImGuiDir_Left)) {
    copySetting(field, ofScene, ui.settings);
  }
  ImGui::PopStyleVar();
  recordWidget(ui, "reset." + std::string(key));
  if (ImGui::IsItemHovered()) {
    const std::string value = settingValue(ofScene, key);
    showTip("Reset to " + (value.empty() ? "the scene's background" : value));
  }
}

void showTip(const std::string& about) {
  const std::string text = shortened(about, 4000);  // Dear ImGui refuses what it cannot index by 16 bits
  const float em = ImGui::GetFontSize();
  const ImGuiWindow* owner = ImGui::GetCurrentWindow();
  while ((owner->Flags & ImGuiWindowFlags_ChildWindow) && !(owner->Flags & ImGuiWindowFlags_ChildMenu)) {
    owner = owner->ParentWindow;
  }
  ImRect window = owner->Rect();
  window.Expand(0.4f * em);
  const ImRect item(ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
  const ImVec2 padding = ImGui::GetStyle().WindowPadding;
  const ImVec2 letters = ImGui::CalcTextSize(text.c_str(), nullptr, false, 30.0f * em);
  const ImVec2 size(letters.x + 2.0f * padding.x, letters.y + 2.0f * padding.y);
  const ImVec2 room(ImGui::GetIO().DisplaySize.x - size.x, ImGui::GetIO().DisplaySize.y - size.y);
  ImVec2 place(item.Min.x, item.Max.y <= room.y ? item.Max.y : item.Min.y - size.y);
  if (window.Max.x <= room.x || window.Min.x >= size.x) {
    place = {window.Max.x <= room.x ? window.Max.x : window.Min.x - size.x, item.Min.y};
  }
  ImGui::SetNextWindowPos({std::max(std::min(place.x, room.x), 0.0f), std::max(std::min(place.y, room.y), 0.0f)});
  ImGui::SetNextWindowSize(size);  // in its first frame too, and when the text changes
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(padding.x + 30.0f * em);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void tip(const std::string& text) {
  // A widget with the keyboard's focus counts as hovered, but its tooltip would cover the next widgets.
  // The flag is also set after a drag of the picture.
  const bool byKeyboard = imgui::focusIsHovered();
  // Nor may a tooltip cover the value of a slider that is dragged.
  const bool held = ImGui::IsItemActive();
  if (!byKeyboard && !held && ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
    showTip(text);
  }
}

void recordWidget(PanelContext& ui, std::string_view key, const std::string& about) {
  const ImVec2 low = ImGui::GetItemRectMin();
  const ImVec2 size = ImGui::GetItemRectSize();
  ui.state.widgets.emplace_back(key, PixelRect{static_cast<int>(low.x), static_cast<int>(low.y),
                                               static_cast<int>(size.x), static_cast<int>(size.y)});
  if (!about.empty()) {
    tip(about);
  }
}

bool section(PanelContext& ui, std::string_view key, const std::string& label, bool& open) {
  ImGui::SetNextItemOpen(open);
  open = ImGui::CollapsingHeader(label.c_str());
  recordWidget(ui, "section." + std::string(key));
  return open;
}

bool button(PanelContext& ui, const char* label, std::string_view key, const std::string& about, bool enabled) {
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(label);
  ImGui::EndDisabled();
  recordWidget(ui, key, about);
  return pressed;
}

void commandButton(PanelContext& ui, const char* label, std::string_view key, const std::string& about, Command command,
                   bool enabled) {
  if (button(ui, label, key, about, enabled)) {
    ui.send(std::move(command));
  }
}

void nextButton(PanelContext& ui, const char* label, std::string_view key, const std::string& about, Command command,
                bool enabled) {
  continueRow(label);
  commandButton(ui, label, key, about, std::move(command), enabled);
}

float textWidth(std::string_view text) {
  return ImGui::CalcTextSize(text.data(), text.data() + text.size()).x;
}

void figure(const std::string& text, bool dimmed) {
  const float space = ImGui::GetContentRegionAvail().x - textWidth(text);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(space, 0.0f));
  dimmed ? ImGui::TextDisabled("%s", text.c_str()) : ImGui::TextUnformatted(text.c_str());
}

void figureColumn(const char* head, float ems, int flags) {
  const float width = std::max(ems * ImGui::GetFontSize(), std::ceil(textWidth(head)));
  ImGui::TableSetupColumn(head, ImGuiTableColumnFlags_WidthFixed | flags, width);
}

void continueRow(const char* label, float further) {
  ImGui::SameLine();
  const float width = ImGui::CalcTextSize(label).x + 2.0f * ImGui::GetStyle().FramePadding.x + further;
  if (ImGui::GetContentRegionAvail().x < width) {
    ImGui::NewLine();
  }
}

std::string labelFor(const std::string& label, float width) {
  const std::string id = "###" + label;  // one id for both kinds of label, so that a widget in use keeps its focus
  const ImGuiStyle& style = ImGui::GetStyle();
  const float item = ImGui::CalcItemWidth();
  const float room = ImGui::GetContentRegionAvail().x - item - style.ItemInnerSpacing.x;
  if (item >= width && room >= ImGui::CalcTextSize(label.c_str()).x) {
    return label + id;
  }
  ImGui::TextUnformatted(label.c_str());
  ImGui::SetNextItemWidth(-(ImGui::GetFrameHeight() + style.ItemSpacing.x));  // the rest is for the reset button
  return id;
}

std::string thatFits(const std::string& text, std::optional<float> room) {
  return endsThatFit(text, room.value_or(ImGui::GetContentRegionAvail().x), textWidth);
}

void wrappedText(const std::string& text) {
  ImGui::TextWrapped("%s", brokenAtSpaces(text, ImGui::GetContentRegionAvail().x, textWidth).c_str());
}

void dimmedText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  wrappedText(text);
  ImGui::PopStyleColor();
}

std::string mebibytes(uint64_t bytes) {
  return fmt::format("{:.1f}", static_cast<double>(bytes) / (1024.0 * 1024.0));
}

glm::vec3 onTheme(const glm::vec3& color) {
  const bool light = ImGui::GetStyleColorVec4(ImGuiCol_Text).x < 0.5f;
  return color * (light ? 0.6f : 1.0f);
}

void coloredText(const glm::vec3& color, const std::string& text) {
  const glm::vec3 shown = onTheme(color);
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(shown.r, shown.g, shown.b, 1.0f));
  wrappedText(text);
  ImGui::PopStyleColor();
}

void loading(PanelContext& ui) {
  const ShownScenes& browser = ui.input.browser;
  if (browser.loading.empty()) {
    return;
  }
  const ImGuiIO& io = ImGui::GetIO();
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos(ImVec2(0.5f * io.DisplaySize.x, io.DisplaySize.y - unit - statusHeight()), ImGuiCond_Always,
                          ImVec2(0.5f, 1.0f));
  ImGui::SetNextWindowSize(ImVec2(26.0f * unit, 0.0f));
  if (ImGui::Begin("Loading", nullptr, fixedWindow)) {
    ImGui::Text("Loading %s", browser.loading.c_str());
    ImGui::ProgressBar(static_cast<float>(browser.loaded), ImVec2(-5.0f * unit, 0.0f));
    ImGui::SameLine();
    commandButton(ui, "Cancel", "loading.cancel", "", CancelLoading{});
  }
  ImGui::End();
}

// Draws the message over the picture, so that no panel moves.
void message(PanelContext& ui, const WindowRect& picture) {
  std::string& dismissed = ui.state.dismissedMessage;
  if (ui.input.message != dismissed) {
    dismissed.clear();
  }
  if (ui.input.message.empty() || ui.input.message == dismissed) {
    return;
  }
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({picture.corner.x + 0.5f * picture.size.x, picture.corner.y + em}, ImGuiCond_Always,
                          {0.5f, 0.0f});
  ImGui::SetNextWindowSize({std::clamp(picture.size.x - 2.0f * em, 20.0f * em, 40.0f * em), 0.0f});
  ImGui::SetNextWindowBgAlpha(1.0f);
  if (ImGui::Begin("Message", nullptr, fixedWindow)) {
    coloredText(errorColor, ui.input.message);
    if (button(ui, "Dismiss", "message.dismiss", "Until it occurs again.")) {
      dismissed = ui.input.message;
      ui.send(DismissMessage{});
    }
  }
  ImGui::End();
}

glm::vec2 modestEms(const glm::vec2& ems) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const glm::vec2 room = glm::vec2(display.x, display.y) / ImGui::GetFontSize();
  const float width = std::min(ems.x, std::max(18.0f, 0.42f * room.x));
  return {width, std::min(ems.y, std::max(12.0f, room.x * room.y / 75.0f))};
}

void playOffer(PanelContext& ui, const WindowRect& picture, float below) {
  const ShownPlayback& playback = ui.input.playback;
  const float em = ImGui::GetFontSize();
  const float room = std::min(picture.size.x - ImGui::CalcTextSize(playback.cost.c_str()).x, picture.size.y - below);
  if (!playback.paused || playback.cost.empty() || room < 4.0f * em || ui.input.edit.prompt != Prompt::none) {
    return;
  }
  ImGui::SetNextWindowPos({picture.corner.x + 0.5f * picture.size.x, picture.corner.y + picture.size.y - below - em},
                          ImGuiCond_Always, {0.5f, 1.0f});
  constexpr ImGuiWindowFlags flags = fixedWindow | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("##play", nullptr, flags)) {
    commandButton(ui, playback.cost.c_str(), "play",
                  "Plays the animation (Space) with as much quality as this device has time for.", SetPaused{false});
  }
  ImGui::End();
}

std::string milliseconds(double ms) {
  return std::isnan(ms) ? "-" : fmt::format("{:.{}f}", ms, ms < 10.0 ? 2 : ms < 100.0 ? 1 : 0);
}

std::string duration(double ms) {
  return ms >= 1000.0 ? fmt::format("{:.2f} s", ms / 1000.0) : milliseconds(ms) + " ms";
}

void scene(PanelContext& ui) {
  sceneChoice(ui);
  if (const Scene* opened = ui.input.edit.scene; opened && isModelFile(opened->file)) {
    standUpButton(ui, {Selection::Kind::object, 0}, "scene.stand_up");
  }
  cameraMode(ui);
  bookmarks(ui);
  timeControls(ui);
  commandButton(ui, "Copy command line", "copy",
                "Copies a speculum render call that draws this view. Unsaved changes go into a copy of the scene.",
                CopyCommandLine{});
  nextButton(ui, "Save picture", "screenshot", "Saves the picture as a PNG file (F12); Shift+F12 adds the panels.",
             TakeScreenshot{false});
}

void settings(PanelContext& ui) {
  if (section(ui, "view", "View", ui.state.choices.viewSection)) {
    settingRows(ui, "view.");
    settingRows(ui, "quality.motion_ms");
    settingRows(ui, "quality.still_");
    settingRows(ui, "ui.");
  }
  if (section(ui, "reflections", "Reflections", ui.state.choices.reflectionsSection)) {
    settingRows(ui, "reflection.");
  }
  commandButton(ui, "Reset settings", "settings.reset", "Returns to the settings that the scene was opened with.",
                ResetSettings{});
}

}  // namespace speculum::panels
