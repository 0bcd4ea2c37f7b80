#include "frame/memory_fit.hpp"

#include <algorithm>
#include <numeric>

#include "frame/image_reuse.hpp"
#include "frame/pass_range.hpp"
#include "frame/picture_offset.hpp"
#include "frame/shadow_map.hpp"

namespace speculum {

namespace {

constexpr uint64_t colorBytes = 8;     // RGBA16F
constexpr uint64_t depthBytes = 4;     // D32F
constexpr uint64_t sumBytes = 2 * 16;  // two images of RGBA32F
constexpr double smallestScale = 0.125;
constexpr uint64_t shadowPlaneBytes = 8;  // R32G32
constexpr double pixelsForRays = 4e5;
constexpr int smallestMap = 16;  // texels
constexpr int smallestShadowMap = 64;

uint64_t pixels(const PixelRect& rect) {
  return static_cast<uint64_t>(rect.area());
}

// Returns the pixels of the cached images.
uint64_t cachedPixels(const FramePlan& plan) {
  uint64_t sum = 0;
  for (const CachedImage& image : plan.cached) {
    sum += image.cacheIndex >= 0 ? pixels(image.view.rect) : 0;
  }
  return sum;
}

// Returns the most pixels of mirror images that exist at one time: each from its range of passes to its parent's.
uint64_t peakPixels(const FramePlan& plan, std::span<const PassRange> ranges) {
  uint64_t alive = cachedPixels(plan);
  uint64_t peak = alive;
  for (const PassRange& range : ranges) {
    for (size_t i = range.first; i < range.end; ++i) {
      alive += pixels(plan.passes[i].view.rect);
    }
    peak = std::max(peak, alive);
    for (size_t i = range.first; i < range.end; ++i) {
      for (const MirrorDraw& draw : plan.passes[i].mirrors) {
        alive -= draw.pass >= 0 ? pixels(plan.passes[draw.pass].view.rect) : 0;
      }
    }
  }
  return peak;
}

// Returns the bytes of the samples of the largest pass, whose radiance deferred shading keeps.
uint64_t shadedBytes(const FramePlan& plan, const Settings& settings) {
  uint64_t samples = pixels(plan.main.view.rect) * static_cast<uint64_t>(settings.view.samples);
  for (const PlannedPass& pass : plan.passes) {
    samples = std::max(samples, pixels(pass.view.rect) * static_cast<uint64_t>(settings.reflection.samples));
  }
  return plan.effects.any() ? std::min(samples, mostShadedSamples) * (bytesPerShadedSample + bytesPerRequest) : 0;
}

uint64_t mainBytes(const FramePlan& plan, const Settings& settings) {
  const auto samples = static_cast<uint64_t>(settings.view.samples);
  const uint64_t multisampled = samples > 1 ? samples * colorBytes : 0;
  return pixels(plan.main.view.rect) * (colorBytes + multisampled + samples * depthBytes);
}

// Returns the pixels of the depth images, which the ranges use one after the other.
uint64_t depthPixels(const FramePlan& plan, std::span<const PassRange> ranges) {
  RecycledVector<uint64_t> largest;
  for (const PassRange& range : ranges) {
    const RecycledVector<size_t> passes = largestFirst(plan, range);
    largest.resize(std::max(largest.size(), passes.size()), 0);
    for (size_t place = 0; place < passes.size(); ++place) {
      largest[place] = std::max(largest[place], pixels(plan.passes[passes[place]].view.rect));
    }
  }
  return std::accumulate(largest.begin(), largest.end(), uint64_t{0});
}

bool lower(Settings& settings, const FramePlan& plan, std::string& what) {
  ReflectionSettings& reflection = settings.reflection;
  if (reflection.samples > 1) {
    reflection.samples /= 2;
    what = "reflection.samples to " + std::to_string(reflection.samples);
  } else if (settings.view.samples > 1) {
    settings.view.samples /= 2;
    what = "view.samples to " + std::to_string(settings.view.samples);
  } else if (reflection.scale > smallestScale) {
    reflection.scale = std::max(smallestScale, reflection.scale / 2.0);
    what = "reflection.scale to " + settingValue(settings, "reflection.scale");
  } else if (!plan.maps.empty() && settings.effects.environmentSize > smallestMap) {
    settings.effects.environmentSize /= 2;
    what = "effects.environment_size to " + std::to_string(settings.effects.environmentSize);
  } else if (!plan.shadowMaps.empty() && settings.effects.shadowMapSize > smallestShadowMap) {
    settings.effects.shadowMapSize /= 2;
    what = "effects.shadow_map_size to " + std::to_string(settings.effects.shadowMapSize);
  } else {
    return false;
  }
  return true;
}

// Says whether a GPU draws the frame faster with rays in the place of mirror images: with one sample a pixel, once a
// mirror covers much of the picture (docs/scaling.md). More samples were not measured.
bool raysAreFaster(const FramePlan& plan, const Settings& settings) {
  return settings.view.samples == 1 && std::ranges::any_of(plan.passes, [](const PlannedPass& pass) {
           return pass.depth == 0 && pass.areaPx >= pixelsForRays;
         });
}

void leaveOutRays(Settings& settings, const Scene& scene) {
  EffectSettings& effects = settings.effects;
  effects.shadows =
      effects.shadows && effects.shadowLookup == ShadowLookup::map && shadowLights(scene).size() <= mostShadowMaps;
  effects.roughness = effects.roughness && effects.roughLookup == ReflectionSource::image;
  effects.ripple = effects.ripple && effects.rippleLookup == ReflectionSource::image;
  effects.castsLight = false;
  effects.curved = effects.curved && effects.curvedLookup == CurvedLookup::environment;
  settings.reflection.method = ReflectionMethod::raster;
}

std::string mebibytes(uint64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

}  // namespace

uint64_t environmentBytes(const FramePlan& plan) {
  uint64_t color = 0;
  uint64_t largest = 0;
  for (const EnvironmentMap& map : plan.maps) {
    const uint64_t texels = 6 * static_cast<uint64_t>(map.size) * static_cast<uint64_t>(map.size);
    color += texels * colorBytes;
    largest = std::max(largest, texels);
  }
  return color + largest * depthBytes;
}

uint64_t shadowBytes(const FramePlan& plan) {
  const glm::ivec2 extent = shadowExtent(plan.shadowMaps);
  const uint64_t layerBytes = hasShadowLayers(plan.shadowMaps) ? shadowPlaneBytes : 0;
  return static_cast<uint64_t>(extent.x) * static_cast<uint64_t>(extent.y) *
         (shadowPlaneBytes + depthBytes + layerBytes);
}

uint64_t targetBytes(const FramePlan& plan, const Settings& settings) {
  const auto imageSamples = static_cast<uint64_t>(settings.reflection.samples);
  const RecycledVector<PassRange> ranges = independentPasses(plan);
  const uint64_t sums = settings.view.accumulate > 1 ? sumBytes : 0;
  return mainBytes(plan, settings) + pixels(plan.main.view.rect) * sums +
         peakPixels(plan, ranges) * imageSamples * colorBytes + depthPixels(plan, ranges) * imageSamples * depthBytes +
         environmentBytes(plan) + shadowBytes(plan) + shadedBytes(plan, settings);
}

uint64_t sampleBytes(const FramePlan& plan, const Settings& settings) {
  Settings single = settings;
  single.view.samples = single.reflection.samples = 1;
  return targetBytes(plan, settings) - targetBytes(plan, single);
}

FittedPlan planWithin(const TargetLimits& limits, const Scene& scene, const SceneState& state, const Settings& settings,
                      int width, int height, FrameCache cache, int picture) {
  FittedPlan fitted{{}, pictureSettings(settings), {}};
  ReflectionSettings& reflection = fitted.settings.reflection;
  const double margins = reflection.updateInterval > 1 ? 2.0 * largestMargin * height : 0.0;
  const auto plan = [&] { fitted.plan = planFrame(scene, state, fitted.settings, width, height, cache, picture); };
  const auto say = [&](const std::string& what) { fitted.message += (fitted.message.empty() ? "" : "; ") + what; };
  const double largestScale = limits.largestSide / (settings.view.scale * (std::max(width, height) + margins));
  if (reflection.scale > largestScale) {
    reflection.scale = largestScale;
    say("mirror images of " + settingValue(settings, "reflection.scale") +
        " times the main view's size are larger than the device's " + std::to_string(limits.largestSide) +
        " pixels: lowered reflection.scale to " + settingValue(fitted.settings, "reflection.scale"));
  }
  const bool chooses = reflection.method == ReflectionMethod::automatic && !limits.cpu;
  if (reflection.method == ReflectionMethod::automatic && (!limits.cpu || !limits.tracesRays)) {
    reflection.method = ReflectionMethod::raster;
  }
  plan();
  if (chooses && limits.tracesRays && raysAreFaster(fitted.plan, fitted.settings)) {
    reflection.method = ReflectionMethod::rays;
    plan();
  }
  if (!limits.tracesRays && fitted.plan.effects.any()) {
    leaveOutRays(fitted.settings, scene);
    say("effects.* that trace rays, and reflection.method=rays, are left out: the device lacks geometryShader, storage "
        "buffers, or room in them for the scene");
    plan();
  }
  int& shadowMapSize = fitted.settings.effects.shadowMapSize;
  const int wantedSize = shadowMapSize;
  for (glm::ivec2 extent = shadowExtent(fitted.plan.shadowMaps); std::max(extent.x, extent.y) > limits.largestSide;
       extent /= 2) {
    shadowMapSize /= 2;
  }
  if (shadowMapSize < wantedSize) {
    say("shadow maps exceed the device's " + std::to_string(limits.largestSide) +
        " pixels: lowered effects.shadow_map_size to " + std::to_string(shadowMapSize));
    plan();
  }
  // The picture that stays shown was drawn with the samples that were asked for, or as many as fitted.
  uint64_t kept = 0;
  if (limits.keepsPicture && (settings.view.accumulate > 1 || settings.quality.stillPictures == 1)) {
    Settings before = settings;
    while (before.view.samples > 1 && mainBytes(fitted.plan, before) > limits.budgetBytes) {
      before.view.samples /= 2;
    }
    kept = mainBytes(fitted.plan, before);
  }
  const auto needed = [&] { return kept + targetBytes(fitted.plan, fitted.settings); };
  if (needed() > limits.budgetBytes && reflection.updateInterval == 1) {
    cache.images = {};
    plan();
  }
  const uint64_t wanted = needed();
  std::string what;
  std::string lowered;
  while (needed() > limits.budgetBytes && lower(fitted.settings, fitted.plan, what)) {
    lowered += (lowered.empty() ? "" : ", ") + what;
    plan();
  }
  if (!lowered.empty()) {
    say("targets of " + mebibytes(wanted) + " do not fit the device's " + mebibytes(limits.budgetBytes) + ": lowered " +
        lowered);
  }
  return fitted;
}

}  // namespace speculum
