// A | B: the divider with its labels, the choice of a half, and lessons.
#include <imgui.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "platform/text.hpp"
#include "ui/input_map.hpp"
#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr ImGuiWindowFlags dividerWindow = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                           ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav |
                                           ImGuiWindowFlags_NoBackground;
constexpr std::array names = {"A", "B"};
constexpr size_t mostDiffering = 6;  // settings that a label lists
constexpr ImU32 lightInk = IM_COL32(255, 255, 255, 255);
constexpr ImU32 darkInk = IM_COL32(0, 0, 0, 170);
constexpr ImU32 chosenInk = IM_COL32(255, 196, 40, 255);

std::string labelOf(const ShownSplit& split, size_t half) {
  const ShownSplit::Half& shown = split.halves[half];
  std::string label = names[half];
  label += split.chosen == static_cast<int>(half) ? " (its settings are in the panel)" : "";
  for (size_t i = 0; i < std::min(shown.differs.size(), mostDiffering); ++i) {
    const SettingChange& change = shown.differs[i];
    label += "\n" + change.key + " = " + (change.value.empty() ? "the scene's" : change.value);
  }
  if (shown.differs.size() > mostDiffering) {
    label += fmt::format("\nand {} more", shown.differs.size() - mostDiffering);
  }
  label += shown.differs.empty() ? "\nsame settings" : "";
  if (shown.gpuMs > 0.0) {
    label += "\nGPU " + duration(shown.gpuMs);
    label += shown.pictures > 1 ? fmt::format(" for each of {} pictures", shown.pictures) : "";
  }
  if (shown.error) {
    label += fmt::format("\nFLIP {} against {}", significant(*shown.error, 3),
                         shown.ofReference ? "the reference" : names[1 - half]);
  }
  return label + (shown.picture.empty() ? "" : "\n" + shown.picture);
}

// Draws a half's label at the left of its part of the picture, where numbers that grow move no text.
void label(ImDrawList& list, const ShownSplit& split, size_t half, float x, const WindowRect& picture) {
  const float em = ImGui::GetFontSize();
  const float room = half == 0 ? x - picture.corner.x : picture.corner.x + picture.size.x - x;
  const float width = std::min(room - 3.0f * em, 32.0f * em);
  if (width < 1.5f * em) {
    return;
  }
  const bool narrow = width < 7.0f * em;
  const std::string text = narrow ? names[half] : brokenAtSpaces(labelOf(split, half), width, textWidth);
  const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width);
  const ImVec2 low((half == 0 ? picture.corner.x : x) + em, picture.corner.y + em);
  const ImVec2 reach(0.4f * em, 0.3f * em);
  list.AddRectFilled({low.x - reach.x, low.y - reach.y}, {low.x + size.x + reach.x, low.y + size.y + reach.y}, darkInk,
                     0.3f * em);
  const bool chosen = split.chosen == static_cast<int>(half);
  list.AddText(nullptr, 0.0f, low, chosen ? chosenInk : lightInk, text.c_str(), nullptr, width);
}

}  // namespace

void divider(PanelContext& ui, const WindowRect& picture) {
  const ShownSplit& split = ui.input.split;
  if (!split.on) {
    return;
  }
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float em = ImGui::GetFontSize();
  const float x = std::round(static_cast<float>(split.divider) * display.x);
  const float reach = std::floor(0.4f * em);
  ImGui::SetNextWindowPos({x - reach, 0.0f});
  ImGui::SetNextWindowSize({2.0f * reach, display.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
  ImGui::Begin(dividerTitle, nullptr, dividerWindow);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("divider", {2.0f * reach, display.y});
  recordWidget(ui, "divider");
  if (ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 0.0f)) {
    ui.send(MoveDivider{ImGui::GetIO().MousePos.x / display.x});
  }
  if (ImGui::IsItemActive() || ImGui::IsItemHovered()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRectFullScreen();
  const float middle = picture.corner.y + 0.5f * picture.size.y;
  list.AddLine({x, 0.0f}, {x, display.y}, darkInk, std::max(3.0f, 0.25f * em));
  list.AddLine({x, 0.0f}, {x, display.y}, lightInk, std::max(1.0f, 0.1f * em));
  list.AddCircleFilled({x, middle}, reach, lightInk);
  list.AddCircle({x, middle}, reach, darkInk);
  label(list, split, 0, x, picture);
  label(list, split, 1, x, picture);
  list.PopClipRect();
  ImGui::End();
}

void splitChoice(PanelContext& ui) {
  const ShownSplit& split = ui.input.split;
  if (!split.on) {
    return;
  }
  coloredText(warningColor, split.chosen == 0 ? "Settings of A, the left half" : "Settings of B, the right half");
  for (int half = 0; half < 2; ++half) {
    if (ImGui::RadioButton(names[static_cast<size_t>(half)], split.chosen == half)) {
      ui.send(ChooseHalf{half});
    }
    recordWidget(ui, half == 0 ? "split.a" : "split.b", "The panels show and change the settings of this half (X).");
    ImGui::SameLine();
  }
  commandButton(ui, "Keep", "split.keep", "Ends A | B. The scene takes these settings, as a step that can be undone.",
                KeepHalf{});
  nextButton(ui, "End A | B", "split.end", "The scene has the settings from before (C or Esc).", ToggleSplit{});
}

void lessonMenu(PanelContext& ui) {
  const std::vector<ShownSplit::LessonEntry>& lessons = ui.input.split.lessons;
  if (!menu(ui, "Lessons", !lessons.empty())) {
    return;
  }
  for (size_t i = 0; i < lessons.size(); ++i) {
    if (ImGui::MenuItem(lessons[i].title.c_str(), nullptr, ui.input.split.lesson == i)) {
      ui.send(OpenScene{lessons[i].scene, i});
    }
    recordWidget(ui, fmt::format("lesson.{}", i), lessons[i].text);
  }
  ImGui::EndMenu();
}

void lesson(PanelContext& ui) {
  const std::vector<ShownSplit::LessonEntry>& lessons = ui.input.split.lessons;
  const size_t shown = *ui.input.split.lesson;
  const auto step = [&](const char* label, const char* key, size_t to) {
    const bool exists = to < lessons.size();
    commandButton(ui, label, key, exists ? lessons[to].title : "",
                  OpenScene{exists ? lessons[to].scene : std::filesystem::path(), to}, exists);
  };
  // Above the texts, so that the buttons stay in their places.
  step("Previous lesson", "lesson.previous", shown - 1);
  continueRow("Next lesson");
  step("Next lesson", "lesson.next", shown + 1);
  coloredText(warningColor, fmt::format("{} of {}: {}", shown + 1, lessons.size(), lessons[shown].title));
  wrappedText(lessons[shown].text);
  ImGui::Spacing();
  wrappedText("Look for: " + lessons[shown].lookFor);
}

}  // namespace speculum::panels
