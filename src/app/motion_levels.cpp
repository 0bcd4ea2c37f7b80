#include "app/motion_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace speculum {

namespace {

constexpr double scaleStep = 0.9;
constexpr double blurredScale = 0.4;  // below it, losing reflections is seen less than losing detail
constexpr double leastScale = 0.125;

Settings lowered(Settings settings, const Settings& limit) {
  ViewSettings& view = settings.view;
  ReflectionSettings& reflection = settings.reflection;
  view.scale = std::min(view.scale, limit.view.scale);
  view.samples = std::min(view.samples, limit.view.samples);
  view.meshError = std::max(view.meshError, limit.view.meshError);
  reflection.scale = std::min(reflection.scale, limit.reflection.scale);
  reflection.samples = std::min(reflection.samples, limit.reflection.samples);
  reflection.maxDepth = std::min(reflection.maxDepth, limit.reflection.maxDepth);
  reflection.updateInterval = std::max(reflection.updateInterval, limit.reflection.updateInterval);
  reflection.meshError = std::max(reflection.meshError, limit.reflection.meshError);
  return settings;
}

// Return the mean FLIP that each setting adds, on average over the shipped scenes without traced effects
// (docs/window.md).
double scaleError(double scale) {
  return 0.055 * std::pow(1.0 / scale - 1.0, 0.62);
}
double viewSampleError(int samples) {
  return 0.025 / samples;
}
double mirrorSampleError(int samples) {
  return 0.009 / samples;
}
double depthError(int depth) {
  return depth == 0 ? 0.2 : 0.08 / depth;
}
double viewMeshError(double texels) {
  return 0.012 * texels;
}
double mirrorMeshError(double texels) {
  return 0.003 * texels;
}

// Adds errors of different kinds as squares, like independent ones.
double addedError(const Settings& chosen, const Settings& lower) {
  const auto added = [](double less, double more) { return std::max(0.0, more * more - less * less); };
  const ReflectionSettings& a = chosen.reflection;
  const ReflectionSettings& b = lower.reflection;
  const double sum = added(scaleError(chosen.view.scale), scaleError(lower.view.scale)) +
                     added(viewSampleError(chosen.view.samples), viewSampleError(lower.view.samples)) +
                     added(mirrorSampleError(a.samples), mirrorSampleError(b.samples)) +
                     added(a.maxDepth == b.maxDepth ? depthError(b.maxDepth) : 0.0, depthError(b.maxDepth)) +
                     added(viewMeshError(chosen.view.meshError), viewMeshError(lower.view.meshError)) +
                     added(mirrorMeshError(a.meshError), mirrorMeshError(b.meshError));
  return std::sqrt(sum);
}

}  // namespace

std::vector<MotionLevel> motionLevels(const Settings& chosen, std::span<const MotionLevel> front, unsigned sampleCounts,
                                      bool simplifies) {
  std::vector<MotionLevel> levels{{chosen}};
  const auto add = [&](const Settings& settings, double error) {
    if (!sameMainView(settings, levels.back().settings)) {
      levels.push_back({settings, error});
    }
  };
  for (const MotionLevel& point : front) {
    Settings settings = lowered(chosen, point.settings);
    if (!simplifies) {
      settings.reflection.meshError = chosen.reflection.meshError;
      settings.view.meshError = chosen.view.meshError;
    }
    add(settings, point.error);
  }
  const MotionLevel measured = levels.back();
  const auto step = [&](const auto& change) {
    Settings limit = levels.back().settings;
    change(limit);
    const Settings settings = lowered(levels.back().settings, limit);
    add(settings, std::hypot(measured.error, addedError(measured.settings, settings)));
  };
  const auto scaleTo = [&](double least) {
    for (double scale = levels.back().settings.view.scale * scaleStep; scale >= least; scale *= scaleStep) {
      step([&](Settings& s) { s.view.scale = scale; });
    }
  };
  const auto simplify = [&](double mirrors, double view) {
    if (simplifies) {
      step([&](Settings& s) {
        s.reflection.meshError = mirrors;
        s.view.meshError = view;
      });
    }
  };
  simplify(0.5, 0.0);
  for (const auto& samples : {+[](Settings& s) -> int& { return s.reflection.samples; },
                              +[](Settings& s) -> int& { return s.view.samples; }}) {
    for (const int count : {4, 2, 1}) {
      if ((sampleCounts & static_cast<unsigned>(count)) != 0) {
        step([&](Settings& s) { samples(s) = count; });
      }
    }
  }
  scaleTo(blurredScale);
  simplify(2.0, 1.0);
  step([](Settings& s) { s.reflection.maxDepth = 2; });
  scaleTo(leastScale);
  simplify(2.0, 2.0);
  step([](Settings& s) { s.reflection.maxDepth = 1; });
  return levels;
}

std::string motionText(const Settings& chosen, const MotionLevel& level) {
  const Settings& settings = level.settings;
  const ReflectionSettings& reflection = settings.reflection;
  std::string text;
  const auto add = [&](bool differs, const std::string& words) {
    if (differs) {
      text += (text.empty() ? "" : ", ") + words;
    }
  };
  const auto samples = [](int count) { return fmt::format("{} {}", count, count == 1 ? "sample" : "samples"); };
  add(settings.view.scale != chosen.view.scale, fmt::format("{:.2g} scale", settings.view.scale));
  add(settings.view.samples != chosen.view.samples, samples(settings.view.samples));
  add(reflection.scale != chosen.reflection.scale, fmt::format("mirrors at {:.2g} scale", reflection.scale));
  add(reflection.samples != chosen.reflection.samples && reflection.samples != settings.view.samples,
      "mirrors with " + samples(reflection.samples));
  add(reflection.maxDepth != chosen.reflection.maxDepth, fmt::format("depth {}", reflection.maxDepth));
  add(reflection.updateInterval != chosen.reflection.updateInterval,
      fmt::format("mirrors every {} frames", reflection.updateInterval));
  const double mirrors = reflection.meshError != chosen.reflection.meshError ? reflection.meshError : 0.0;
  const double view = settings.view.meshError != chosen.view.meshError ? settings.view.meshError : 0.0;
  add(mirrors > 0.0 || view > 0.0, fmt::format("meshes within {:.2g} texels", std::max(mirrors, view)));
  return text.empty() ? "full quality" : text + fmt::format(", FLIP about {:.1g}", level.error);
}

}  // namespace speculum
