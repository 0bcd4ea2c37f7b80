#pragma once

#include <span>

#include "ui/panel_dock.hpp"
#include "ui/thumbnails.hpp"
#include "ui/ui_model.hpp"

namespace speculum::panels {

inline constexpr const char* helpTitle = "Keys";
inline constexpr const char* inspectorTitle = "Inspector";

// The sections of the panel, each within the current ImGui window.
void message(const UiModel& model);
void scene(UiModel& model);
void gallery(UiModel& model, const Thumbnails& thumbnails);
void time(UiModel& model);
void help(UiModel& model);
void settings(UiModel& model);
void passes(UiModel& model);
// Around the mirror that is pointed at, of a pass or skipped, in the picture behind all windows.
void passOutline(const UiModel& model);
void effects(UiModel& model);
void performance(UiModel& model);
void device(UiModel& model);
// Leaves its lower part to the picture below: the renderer draws the target there.
void targets(UiModel& model);
bool hasTarget(const UiPass& pass);  // that can be looked at
void log(UiModel& model);
void accuracy(UiModel& model);
// A window of its own, while something is loaded.
void loading(UiModel& model);

// What is drawn over the picture, the window that edits the scene, unless `dock` is null, and questions about saving
// it.
void edit(UiModel& model, PanelDock* dock);
void inspectorButton(UiModel& model);

// At the lower left edge of the display, over nothing else: PanelDock keeps its place free. `width`: pixels, of the
// panel; 0 while that is hidden, and the line is as large as its text.
float statusHeight();  // pixels
void statusLine(const UiModel& model, float width);

// What a key or a movement of the pointer does in the window.
struct KeyHelp {
  const char* keys;
  const char* what;
};
std::span<const KeyHelp> keyHelp();
std::span<const KeyHelp> gamepadHelp();

// After each widget of a setting: notes its place, explains it, and at the line's end offers the scene's value if the
// setting has another. The place of that button is noted as "reset." and the key.
void describe(UiModel& model, std::string_view key);
// After a widget: what it does, while the pointer is on it.
void tip(const char* text);
// After a widget: notes its place under `key` in the model.
void notePlace(UiModel& model, std::string_view key);

}  // namespace speculum::panels
