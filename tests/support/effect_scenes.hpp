#pragma once

#include "scene_text.hpp"

// Parts of scenes with effects, for pictures against the tracer and for both methods of tracing rays.
namespace speculum::testing_support {

// An eye before a floor.
inline const std::string effectFloor = R"(
[environment] background = [0.25, 0.3, 0.4], ambient = [0.05, 0.05, 0.06]
[camera] position = [0.3, 1.7, 3.6], target = [0, 0.6, 0]
[[object]] model = "MODELS/block.obj", position = [0, -0.1, 0], scale = [7, 0.1, 7]
)";
inline const std::string shadowLight = "[[light]]\nposition = [1.2, 2.6, 1.9]\nintensity = 14\ncasts_shadow = true\n";
inline const std::string wall = "[[mirror]]\nname = \"wall\"\nposition = [0, 1, -1.6]\nsize = [4, 2]\n";
inline const std::string side = "[[mirror]]\nposition = [-1.9, 1, 0]\nrotation = [0, 78, 0]\nsize = [2.4, 1.8]\n";
inline const std::string pool =
    "[[mirror]]\nname = \"pool\"\nposition = [0, 0.05, 1.2]\nrotation = [-90, 0, 0]\nsize = [3, 2]\n";
inline const std::string ripple = "ripple = { amplitude = 0.006, wavelength = 0.35, speed = 0.2 }\n";

// Shadows, bounced light and ripples 1e7 m from the origin.
inline std::string effectsFarAway() {
  const auto at = [](double x, double y, double z) { return text(glm::dvec3(1e7 + x, -3e6 + y, 2e6 + z)); };
  return "[environment]\nambient = [0.1, 0.1, 0.1]\nbackground = [0.2, 0.3, 0.4]\n[camera]\nposition = " +
         at(0.5, 1.5, 3.5) + "\ntarget = " + at(0, 0.5, 0) +
         "\n[[object]]\nmodel = \"MODELS/block.obj\"\nposition = " + at(0, -0.1, 0) +
         "\nscale = [7, 0.1, 7]\n[[object]]\nmodel = \"MODELS/teapot.obj\"\nposition = " + at(0.3, 0.1, 0.3) +
         "\n[[light]]\nposition = " + at(1.5, 2.5, 2) +
         "\nintensity = 12\ncasts_shadow = true\n[[mirror]]\nposition = " + at(0, 1, -1.5) +
         "\nsize = [4, 2]\ncasts_light = true\n[[mirror]]\nposition = " + at(-1, 0.03, 1) +
         "\nrotation = [-90, 0, 0]\nsize = [1.5, 1.5]\n" + ripple;
}

}  // namespace speculum::testing_support
