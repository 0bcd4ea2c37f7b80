#pragma once

#include <array>
#include <string_view>

namespace speculum {

// Which windows of the panel are open, and how large everything is in them; kept beside the layout in userConfigDir().
struct PanelChoices {
  bool scenes = false;
  bool performance = false;
  bool targets = false;
  bool device = false;
  bool log = false;
  bool accuracy = false;
  int percent = 100;  // of the size that the monitor's scale asks for, 50 .. 300

  bool operator==(const PanelChoices&) const = default;
};

struct PanelName {
  std::string_view name;  // in the file and for people
  bool PanelChoices::*open;
};
inline constexpr std::array<PanelName, 6> panelNames{{{"Scenes", &PanelChoices::scenes},
                                                      {"Performance", &PanelChoices::performance},
                                                      {"Targets", &PanelChoices::targets},
                                                      {"Device", &PanelChoices::device},
                                                      {"Log", &PanelChoices::log},
                                                      {"Accuracy", &PanelChoices::accuracy}}};

// What cannot be read is left at what it is without a file.
PanelChoices savedPanelChoices();
void savePanelChoices(const PanelChoices& choices);

}  // namespace speculum
