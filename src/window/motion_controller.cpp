#include "window/motion_controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "plan/shadow_map.hpp"
#include "plan/traced_effects.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

constexpr double scaleStep = 0.95;
// Scales of the view at which other steps come before a lower resolution.
constexpr double sharpScale = 0.85;
constexpr double softScale = 0.7;
constexpr double blurredScale = 0.4;
// Smaller pictures are hardly faster: from a scale of 0.25 to 0.19 lavapipe draws the gallery in 0.95 of the time.
constexpr double leastScale = 0.25;
// Pixels of the smallest mirror image. Images shrink fast in mirrors that face each other, and each takes a pass
// however small it is. A larger limit would leave out mirrors that are seen directly.
constexpr double smallImage = 1000.0;
constexpr int smallShadowMap = 256;     // texels of a face's side
constexpr int smallEnvironment = 64;    // texels of a face's side
constexpr int environmentInterval = 8;  // frames

// Returns `settings` with the value of `limit` for each setting in which that is cheaper.
Settings lowered(Settings settings, const Settings& limit) {
  const ReflectionSettings before = settings.reflection;
  for (const SettingField& field : settingFields()) {
    if (isCheaper(field, limit, settings)) {
      copySetting(field, limit, settings);
    }
  }
  if (limit.reflection.method != ReflectionMethod::rays) {
    settings.reflection.method = limit.reflection.method;
  }
  lowerLimit(before, settings);
  settings.limit.samples = std::min(settings.limit.samples, limit.limit.samples);
  settings.limit.rays = settings.limit.rays && limit.limit.rays;
  return settings;
}

// Estimates the mean FLIP that lower settings add. Adds errors of different kinds as squares, like independent ones.
double addedError(const Settings& chosen, const Settings& lower, size_t mirrors) {
  double sum = 0.0;
  for (const SettingField& field : settingFields()) {
    if (field.error) {
      const double less = field.error(chosen, mirrors);
      const double more = field.error(lower, mirrors);
      sum += std::max(0.0, more * more - less * less);
    }
  }
  return std::sqrt(sum);
}

// Shares of the budget. Between roomToRaise and tooMuch the level stays, so that it does not change all the time.
constexpr double aim = 0.98;          // largest share that a level may take when it is lowered
constexpr double roomToRaise = 0.96;  // largest share that a better level may take
constexpr double tooMuch = 1.06;      // a frame beyond this share lowers the level
constexpr double farBelow = 0.85;     // a better level predicted to take less is tried at once

constexpr double leastPatience = 0.15;  // seconds
constexpr double mostPatience = 1.5;
constexpr double settled = 1.0;      // seconds at a better level after which raising it was no mistake
constexpr int mostPredictions = 60;  // frames

}  // namespace

std::vector<MotionLevel> motionLevels(const Scene& scene, const Settings& chosen, std::span<const MotionLevel> front,
                                      unsigned sampleCounts) {
  const AskedEffects rays = askedEffects(scene, chosen.effects);
  const int mostSamples = mostAsked(scene, chosen).samples;
  const auto asksFor = [&](ReflectionMethod method) {
    return std::ranges::any_of(scene.mirrors, [&](const Mirror& mirror) { return mirror.quality.method == method; });
  };
  std::vector<MotionLevel> levels{{chosen}};
  const auto add = [&](Settings settings, double error) {
    if (chosen.view.wireframe) {
      settings.view.scale = chosen.view.scale;  // lines would become as thick as the pixels
      settings.reflection.scale = chosen.reflection.scale;
    }
    if (!sameMainView(settings, levels.back().settings)) {
      levels.push_back({settings, error});
    }
  };
  for (const MotionLevel& point : front) {
    add(lowered(chosen, point.settings), point.error);
  }
  const MotionLevel measured = levels.back();
  const auto step = [&](const auto& change) {
    Settings limit = levels.back().settings;
    change(limit);
    const Settings settings = lowered(levels.back().settings, limit);
    add(settings, std::hypot(measured.error, addedError(measured.settings, settings, scene.mirrors.size())));
  };
  const auto scaleTo = [&](double least) {
    for (double scale = levels.back().settings.view.scale * scaleStep; scale >= least; scale *= scaleStep) {
      step([&](Settings& s) { s.view.scale = scale; });
    }
  };
  const auto passesTo = [&](int most) { step([&](Settings& s) { s.reflection.maxPasses = most; }); };
  using E = EffectSettings;
  const auto replace = [&](bool used, const auto& change) {
    if (used) {
      step([&](Settings& s) { change(s.effects); });
    }
  };
  const auto shadowMapsTo = [&](int size) {
    replace(rays.shadows && !rays.castsLight, [&](E& effects) { effects.shadowMapSize = size; });
  };
  step([&](Settings& s) {
    if (s.reflection.method == ReflectionMethod::rays) {
      s.reflection.method = ReflectionMethod::raster;
    }
    s.limit.rays = !asksFor(ReflectionMethod::rays);
  });
  replace(rays.shadows || rays.castsLight || rays.curved, [](E& effects) { effects.perSample = false; });
  replace(rays.shadows && !rays.castsLight, [](E& effects) { effects.shadowLookup = ShadowLookup::map; });
  for (const bool ofMirrors : {true, false}) {
    for (const int count : {4, 2, 1}) {
      if ((sampleCounts & static_cast<unsigned>(count)) != 0) {
        step([&](Settings& s) {
          (ofMirrors ? s.reflection.samples : s.view.samples) = count;
          s.limit.samples = ofMirrors && mostSamples > count ? count : s.limit.samples;
        });
      }
    }
  }
  replace(rays.ripple, [](E& effects) { effects.rippleLookup = ReflectionSource::image; });
  replace(rays.curved, [](E& effects) {
    effects.curvedLookup = CurvedLookup::environment;
    effects.environmentSize = smallEnvironment;
    effects.environmentInterval = environmentInterval;
  });
  // Shadow maps hold no shadows of light that mirrors cast. Scenes with such light are slow, so their maps are small at
  // once.
  replace(rays.castsLight, [](E& effects) {
    effects.castsLight = false;
    effects.shadowLookup = ShadowLookup::map;
    effects.shadowMapSize = smallShadowMap;
  });
  replace(rays.rough, [](E& effects) { effects.roughSamples = 16; });
  replace(rays.rough, [](E& effects) { effects.roughSamples = 4; });
  replace(rays.rough, [](E& effects) { effects.roughLookup = ReflectionSource::image; });
  // For each millisecond saved, fewer and larger images add the least error: images in images are small and dark.
  passesTo(std::max(8, 2 * static_cast<int>(std::min<size_t>(scene.mirrors.size(), 1000))));
  step([](Settings& s) { s.reflection.minPixels = smallImage; });
  scaleTo(sharpScale);
  scaleTo(softScale);
  passesTo(32);
  passesTo(24);
  passesTo(16);
  shadowMapsTo(512);
  scaleTo(blurredScale);
  passesTo(12);
  passesTo(8);
  shadowMapsTo(smallShadowMap);
  scaleTo(leastScale);
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
  const EffectSettings& effects = settings.effects;
  add(chosen.reflection.method == ReflectionMethod::rays && reflection.method != ReflectionMethod::rays,
      "mirrors from images");
  add(effects.castsLight != chosen.effects.castsLight, "no light off mirrors");
  add(effects.shadowLookup != chosen.effects.shadowLookup && effects.shadowLookup == ShadowLookup::map,
      "shadows from maps");
  add(effects.curvedLookup != chosen.effects.curvedLookup, "curved mirrors from maps");
  add(effects.rippleLookup != chosen.effects.rippleLookup, "ripples from images");
  const bool images = effects.roughLookup != chosen.effects.roughLookup;
  add(images, "rough mirrors from images");
  add(!images && effects.roughSamples != chosen.effects.roughSamples,
      fmt::format("{} rays a pixel of rough mirrors", roughRays(effects, settings.view.samples)));
  add(effects.perSample != chosen.effects.perSample && text.empty(), "rays once a pixel");
  const auto samples = [](int count) { return fmt::format("{} {}", count, count == 1 ? "sample" : "samples"); };
  add(settings.view.scale != chosen.view.scale, fmt::format("{:.2g} scale", settings.view.scale));
  add(settings.view.samples != chosen.view.samples, samples(settings.view.samples));
  add(reflection.scale != chosen.reflection.scale, fmt::format("mirrors at {:.2g} scale", reflection.scale));
  add(reflection.samples != chosen.reflection.samples && reflection.samples != settings.view.samples,
      "mirrors with " + samples(reflection.samples));
  add(settings.limit != chosen.limit && reflection == chosen.reflection, "mirrors below their own quality");
  add(reflection.maxDepth != chosen.reflection.maxDepth, fmt::format("depth {}", reflection.maxDepth));
  add(reflection.maxPasses != chosen.reflection.maxPasses,
      fmt::format("at most {} mirror images", reflection.maxPasses));
  add(reflection.minPixels != chosen.reflection.minPixels,
      fmt::format("mirror images from {:.0f} pixels on", reflection.minPixels));
  add(reflection.updateInterval != chosen.reflection.updateInterval,
      fmt::format("mirrors every {} frames", reflection.updateInterval));
  return text.empty() ? "full quality" : text + fmt::format(" (estimated error {:.1g} FLIP)", level.error);
}

std::string stillText(const Scene& scene, const Settings& settings, ShadowLookup planned) {
  const EffectSettings& effects = settings.effects;
  const AskedEffects asked = askedEffects(scene, effects);
  std::string text;
  const auto add = [&](bool applies, const std::string& words) {
    text += applies ? (text.empty() ? "" : ", ") + words : "";
  };
  // A face is 90 degrees wide, so a texel is 2 / size of the distance.
  const ShadowLookup lookup = effects.shadowLookup == ShadowLookup::automatic ? planned : effects.shadowLookup;
  add(asked.shadows && lookup == ShadowLookup::map && !asked.castsLight && fitsShadowMaps(scene),
      effects.shadowMapSize == 0 ? "shadow outlines within about a pixel"
                                 : fmt::format("shadow outlines within a texel of the map, 1/{} of the distance from "
                                               "the light",
                                               effects.shadowMapSize / 2));
  add(asked.curved && effects.curvedLookup == CurvedLookup::environment,
      fmt::format("curved mirrors from maps of {} texels a side", effects.environmentSize));
  add((asked.ripple && effects.rippleLookup == ReflectionSource::image) ||
          (asked.rough && effects.roughLookup == ReflectionSource::image),
      "ripples and blur only of what a smooth mirror shows");
  const auto isGrainy = [&](const MeshPart& part) {
    return isTransparent(part.material, effects) && part.material.cutoff < 0.0;
  };
  add(std::ranges::any_of(scene.meshes, [&](const Mesh& mesh) { return std::ranges::any_of(mesh.parts, isGrainy); }),
      "grain of transparent materials");
  return text;
}

// Returns the first level from `first` on that is predicted to take no more than the share `aim` of the budget, else
// the last level. Estimates the levels' work from `work`, which was planned at level_.
size_t MotionController::fittingLevel(std::span<const MotionLevel> levels, size_t first, const FrameWork& work) const {
  const auto fits = [&](const MotionLevel& level) {
    return model_.predict(scaledWork(work, levels[level_].settings, level.settings)) <= aim * budgetMs_;
  };
  const auto found = std::find_if(levels.begin() + static_cast<std::ptrdiff_t>(first), levels.end(), fits);
  return std::min(static_cast<size_t>(found - levels.begin()), levels.size() - 1);
}

std::optional<size_t> MotionController::tryLevel(Try why, size_t level) {
  try_ = why;
  return level_ = level;
}

size_t MotionController::begin(std::span<const MotionLevel> levels, double budgetMs, double seconds) {
  budgetMs_ = budgetMs;
  before_ = std::min(level_, levels.size() - 1);
  begins_ = !std::exchange(moving_, true);
  if (begins_) {
    predicted_.clear();
    patience_ = leastPatience;
    sinceChange_ = 0.0;
    raised_ = refused_ = false;
  }
  sinceChange_ += seconds;
  return *tryLevel(begins_ ? Try::afterStanding : Try::current, before_);
}

std::optional<size_t> MotionController::next(std::span<const MotionLevel> levels, const FrameWork& work) {
  std::optional<size_t> another;
  if (try_ == Try::afterStanding) {
    const size_t fitting = fittingLevel(levels, 0, work);
    another = fitting < level_ ? tryLevel(Try::current, fitting) : nextFromCurrent(levels, work);
  } else if (try_ == Try::current) {
    another = nextFromCurrent(levels, work);
  } else if (try_ == Try::lower) {
    another = lower(levels, work);
  } else if (try_ == Try::higher && model_.predict(work) > roomToRaise * budgetMs_) {
    refused_ = true;
    sinceChange_ = 0.0;
    another = tryLevel(Try::back, before_);
  }
  if (!another) {
    choose();
  }
  return another;
}

std::optional<size_t> MotionController::nextFromCurrent(std::span<const MotionLevel> levels, const FrameWork& work) {
  const Settings& settings = levels[level_].settings;
  const int interval =
      std::max({work.interval, settings.reflection.updateInterval, settings.effects.environmentInterval});
  predicted_.push_back(model_.predict(work));
  while (predicted_.size() > static_cast<size_t>(std::min(interval, mostPredictions))) {
    predicted_.pop_front();
  }
  if (predicted_.back() > tooMuch * budgetMs_) {
    return lower(levels, work);
  }
  if (begins_ || level_ == 0 || std::ranges::max(predicted_) > roomToRaise * budgetMs_) {
    return std::nullopt;
  }
  const double promised = model_.predict(scaledWork(work, settings, levels[level_ - 1].settings));
  const bool waited = sinceChange_ >= patience_ || (promised <= farBelow * budgetMs_ && !refused_);
  return waited && promised <= roomToRaise * budgetMs_ ? tryLevel(Try::higher, level_ - 1) : std::nullopt;
}

std::optional<size_t> MotionController::lower(std::span<const MotionLevel> levels, const FrameWork& work) {
  const bool fits = model_.predict(work) <= tooMuch * budgetMs_ || level_ + 1 == levels.size();
  return fits ? std::nullopt : tryLevel(Try::lower, fittingLevel(levels, level_ + 1, work));
}

// Takes the level that was planned last.
void MotionController::choose() {
  if (level_ == before_) {
    return;
  }
  if (level_ > before_) {
    const bool mistake = raised_ && sinceChange_ < settled;
    patience_ = mistake ? std::min(2.0 * patience_, mostPatience) : leastPatience;
  }
  raised_ = level_ < before_ && !begins_;
  refused_ = false;
  sinceChange_ = 0.0;
  predicted_.clear();
}

}  // namespace speculum
