#pragma once

#include <span>

#include "ui/ui_model.hpp"

namespace speculum::panels {

// The sections of the panel, each within the current ImGui window.
void message(const UiModel& model);
void scene(UiModel& model);
void time(UiModel& model);
void help(UiModel& model);
void settings(UiModel& model);
void passes(UiModel& model);
void effects(UiModel& model);
void device(UiModel& model);
void accuracy(UiModel& model);
// A window of its own, while something is loaded.
void loading(UiModel& model);

// What a key or a movement of the pointer does in the window.
struct KeyHelp {
  const char* keys;
  const char* what;
};
std::span<const KeyHelp> keyHelp();

// After each widget of a setting: notes its place and explains it.
void describe(UiModel& model, std::string_view key);
// After a widget: notes its place under `key` in the model.
void notePlace(UiModel& model, std::string_view key);

}  // namespace speculum::panels
