#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ui/panels.hpp"

namespace speculum::panels {

namespace {

constexpr double leastSpan = 20.0;  // seconds that the slider reaches

constexpr std::array<KeyHelp, 35> keys{{
    {"drag", "look around: about the target (orbit) or from where you are (fly)"},
    {"drag middle or right", "move sideways and up or down"},
    {"wheel", "nearer or farther"},
    {"W A S D", "forwards, left, back, right"},
    {"Q E", "down, up"},
    {"F", "look at the selected thing, or at the whole scene"},
    {"B", "look from behind the selected mirror, or the one that fills most of the picture"},
    {"Shift+B", "look out of that mirror"},
    {"M", "bookmark the view; saved with the scene"},
    {"Shift+M", "go to the next bookmark"},
    {"Space", "pause the animation and let it go on"},
    {".", "pause, 1/60 s onwards"},
    {",", "pause, 1/60 s back"},
    {"[", "half the speed of time"},
    {"]", "twice the speed of time"},
    {"F12", "save the window as a picture"},
    {"Shift+F12", "the same without the panel"},
    {"F10", "record the window as numbered pictures, and end it"},
    {"Shift+F10", "the same without the panel"},
    {"click", "select what is there, in mirrors too; again: the mirror it is seen in"},
    {"Shift+click", "add what stands there to what is selected, or take it out: all move, turn, copy and go together"},
    {"G", "handles that move, handles that turn (Ctrl while dragging: steps)"},
    {"N Shift+N", "select the next thing, the one before"},
    {"F2", "inspector: everything in the scene, with its numbers"},
    {"Ctrl+D", "duplicate what is selected"},
    {"Del", "delete it"},
    {"Ctrl+Z", "undo"},
    {"Ctrl+Shift+Z", "redo, as Ctrl+Y"},
    {"Ctrl+S", "save the scene"},
    {"Ctrl+Shift+S", "save it as another file"},
    {"F11", "full screen and back"},
    {"Tab", "hide or show the panel"},
    {"F1", "this list"},
    {"Esc", "stop dragging; close what is on top; deselect; dismiss the message"},
    {"Ctrl+Q", "quit"},
}};

// Groups of the keys, in their order; those of a column stand below each other.
struct KeyGroup {
  const char* name;
  size_t count;
  bool columnEnds;
};
constexpr std::array<KeyGroup, 5> groups{
    {{"view", 10, false}, {"time", 5, false}, {"pictures", 4, true}, {"edit", 11, false}, {"window", 5, false}}};

constexpr std::array<KeyHelp, 9> gamepad{{
    {"left stick", "forwards, back, left, right"},
    {"triggers", "down, up"},
    {"right stick", "look around"},
    {"direction pad", "into the panel, where A presses and B leaves"},
    {"A, B", "look at the selected thing, or at the whole scene; orbit or fly"},
    {"Y, X", "look from behind a mirror; look out of it"},
    {"bumpers", "pause, 1/60 s back or onwards"},
    {"sticks pressed", "left: the scene's camera, right: save the window as a picture"},
    {"Start, Back", "pause the animation; hide or show the panel"},
}};

constexpr const char* layoutHelp =
    "W A S D Q E are meant by their place on an American keyboard, all others by what is printed on them;\n"
    "what is printed on one of the six, as , and . with Dvorak, is where an American keyboard has it.";

void helpTable(const char* title, std::span<const KeyHelp> rows) {
  ImGui::TextDisabled("%s", title);
  const float em = ImGui::GetFontSize();
  const float keysWidth = 11.5f * em;
  const float textWidth =
      std::clamp(0.5f * ImGui::GetIO().DisplaySize.x - keysWidth - 4.0f * em, 12.0f * em, 30.0f * em);
  constexpr ImGuiTableFlags flags =
      ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_NoHostExtendX;
  if (!ImGui::BeginTable(title, 2, flags)) {
    return;
  }
  ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, keysWidth);
  ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, textWidth);
  for (const KeyHelp& row : rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(row.keys);
    ImGui::TableNextColumn();
    ImGui::TextWrapped("%s", row.what);
  }
  ImGui::EndTable();
  ImGui::Spacing();
}

// In two columns side by side.
void keyTables() {
  ImGui::BeginGroup();
  size_t begin = 0;
  for (const KeyGroup& group : groups) {
    helpTable(group.name, std::span(keys).subspan(begin, group.count));
    begin += group.count;
    if (group.columnEnds) {
      ImGui::EndGroup();
      ImGui::SameLine(0.0f, 2.0f * ImGui::GetFontSize());
      ImGui::BeginGroup();
    }
  }
  helpTable("gamepad", gamepad);
  ImGui::EndGroup();
}

}  // namespace

std::span<const KeyHelp> keyHelp() {
  return keys;
}

std::span<const KeyHelp> gamepadHelp() {
  return gamepad;
}

void time(UiModel& model) {
  // Room for what comes: the slider reaches twice as far whenever the time has come to its end.
  const double span = leastSpan * std::exp2(std::ceil(std::log2(std::max(1.0, model.time / leastSpan))));
  float seconds = static_cast<float>(model.time);
  if (ImGui::SliderFloat("time", &seconds, 0.0f, static_cast<float>(span), "%.3f s", ImGuiSliderFlags_AlwaysClamp)) {
    model.seek = seconds;
  }
  notePlace(model, "time");
  tip("seconds of the animation");
  if (ImGui::Button("<")) {
    model.seek = model.time - timeStep;
    model.paused = true;
  }
  notePlace(model, "time.back");
  tip("pause, 1/60 s back");
  ImGui::SameLine();
  if (ImGui::Button(">")) {
    model.seek = model.time + timeStep;
    model.paused = true;
  }
  notePlace(model, "time.on");
  tip("pause, 1/60 s onwards");
  ImGui::SameLine();
  ImGui::Checkbox("pause", &model.paused);
  notePlace(model, "pause");
  tip("the animation stands still; so do frames, if nothing else changes");
  ImGui::SameLine();
  float speed = static_cast<float>(model.timeSpeed);
  ImGui::SetNextItemWidth(6.0f * ImGui::GetFontSize());
  if (ImGui::SliderFloat("speed", &speed, static_cast<float>(slowestTime), static_cast<float>(fastestTime), "%.3g x",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp)) {
    model.timeSpeed = speed;
  }
  notePlace(model, "time.speed");
  tip("seconds of the animation a second");
}

void help(UiModel& model) {
  if (!model.help) {
    return;
  }
  ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Appearing, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowBgAlpha(1.0f);  // text over text cannot be read
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, ImGui::GetIO().DisplaySize);
  if (ImGui::Begin(helpTitle, &model.help, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    keyTables();
    ImGui::TextDisabled("%s", layoutHelp);
  }
  ImGui::End();
}

}  // namespace speculum::panels
