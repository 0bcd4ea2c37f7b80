#pragma once

#include <array>
#include <string_view>

#include "ui/theme.hpp"

namespace speculum {

// Open windows, theme and size of the panels; saved beside the layout in userConfigDir().
struct PanelChoices {
  bool scenes = false;
  bool performance = false;
  bool targets = false;
  bool device = false;
  bool log = false;
  bool accuracy = false;
  Theme theme = Theme::dark;
  int percent = 100;  // of the size for the monitor's scale, 50 .. 300

  bool operator==(const PanelChoices&) const = default;
};

struct PanelName {
  std::string_view name;  // in the file and on the screen
  bool PanelChoices::*open;
  const char* about;
};
inline constexpr std::array<PanelName, 6> panelNames{
    {{"Scenes", &PanelChoices::scenes, "pictures of the scenes; a click loads one"},
     {"Performance", &PanelChoices::performance, "times of the last frames as graphs"},
     {"Targets", &PanelChoices::targets, "what each pass drew: color, depth, mask"},
     {"Device", &PanelChoices::device, "the GPU, what it can do, its memory"},
     {"Log", &PanelChoices::log, "what the program and the validation layer said"},
     {"Accuracy", &PanelChoices::accuracy, "measures error against milliseconds, walks between them"}}};

// Reads the saved choices; those that cannot be read have their defaults.
PanelChoices savedPanelChoices();
void savePanelChoices(const PanelChoices& choices);

}  // namespace speculum
