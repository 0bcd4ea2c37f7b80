#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "settings/settings.hpp"

namespace speculum {

// A view of a scene with two sets of settings, shown side by side, and what it teaches.
struct Lesson {
  std::filesystem::path scene;
  std::string title;
  std::string text;                                   // one paragraph
  std::string lookFor;                                // one sentence
  std::optional<Bookmark> camera;                     // replaces the scene's; without a name
  double time = 0.0;                                  // seconds of animation
  std::array<std::vector<SettingEntry>, 2> settings;  // left and right, on top of the scene's

  // Returns the settings of a half, 0 or 1, on top of those of the scene.
  Settings settingsOf(int half, Settings ofScene) const;
};

// Reads the TOML file of a lesson, which docs/window.md describes. Throws InputError.
Lesson readLesson(const std::filesystem::path& file);

// Reads the lessons that come with the program, in the order of their files' names. Leaves out a file that cannot be
// read, with a warning.
std::vector<Lesson> shippedLessons();

}  // namespace speculum
