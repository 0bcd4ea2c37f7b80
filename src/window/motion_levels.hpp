#pragma once

#include <span>
#include <string>
#include <vector>

#include "settings/settings.hpp"

namespace speculum {

// Settings that a moving picture can be drawn with.
struct MotionLevel {
  Settings settings;
  double error = 0.0;  // mean FLIP, about
};

// Returns levels for a picture of a scene with the settings `chosen`, each cheaper than the one before: these settings,
// the front of the scene's measured sweep (most accurate first; may be empty), then steps in an order that holds for
// most scenes (docs/window.md). No setting of a level has better quality than that of the first. `sampleCounts` are
// those that the device has, as VkSampleCountFlags.
std::vector<MotionLevel> motionLevels(const Scene& scene, const Settings& chosen, std::span<const MotionLevel> front,
                                      unsigned sampleCounts);

// Describes what a level gives up, such as "0.5 scale, 1 sample (estimated error 0.05 FLIP)", or "full quality".
std::string motionText(const Settings& chosen, const MotionLevel& level);

// Describes what a still picture of a scene approximates with these settings, and how closely; empty if it is exact as
// docs/picture.md defines it. Effects with noise are exact if their mean is.
std::string stillText(const Scene& scene, const Settings& settings);

}  // namespace speculum
