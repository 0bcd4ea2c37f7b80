#pragma once

#include <array>
#include <span>
#include <string_view>

namespace speculum {

enum class Theme { dark, light };

// Open windows and sections of the main panel, theme and size of the panels; saved beside the layout in
// userConfigDir().
struct PanelChoices {
  bool inspector = false;
  bool scenes = false;
  bool performance = false;
  bool targets = false;
  bool device = false;
  bool log = false;
  bool accuracy = false;
  bool passes = false;
  bool viewSection = true;
  bool reflectionsSection = true;
  bool effectsSection = false;
  Theme theme = Theme::dark;
  int percent = 100;  // of the size for the monitor's scale, 50 .. 300

  bool operator==(const PanelChoices&) const = default;
};

struct PanelName {
  std::string_view name;  // in the file and on the screen
  bool PanelChoices::*open;
  const char* about = "";
};
inline constexpr std::array<PanelName, 11> rememberedPanels{
    {{"Inspector", &PanelChoices::inspector, "Selects, moves, adds and deletes objects, lights and mirrors (F2)."},
     {"Scenes", &PanelChoices::scenes, "Pictures of the scenes; a click opens one."},
     {"Performance", &PanelChoices::performance, "Times of the last frames and their passes, as graphs."},
     {"Targets", &PanelChoices::targets, "What each pass drew: color, depth and mask."},
     {"Device", &PanelChoices::device, "The GPU, its features and its memory."},
     {"Log", &PanelChoices::log, "Messages of the program and of the validation layer."},
     {"Accuracy", &PanelChoices::accuracy, "Measures the time and the error of settings, and chooses the best."},
     {"Passes", &PanelChoices::passes, "What each frame renders and what it costs, and why a mirror has no image."},
     {"View", &PanelChoices::viewSection},
     {"Reflections", &PanelChoices::reflectionsSection},
     {"Effects", &PanelChoices::effectsSection}}};
inline constexpr std::span<const PanelName> panelNames = std::span(rememberedPanels).first(8);  // windows

// Reads the saved choices; those that cannot be read have their defaults.
PanelChoices savedPanelChoices();
void savePanelChoices(const PanelChoices& choices);

}  // namespace speculum
