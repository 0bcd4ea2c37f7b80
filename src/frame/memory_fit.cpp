#include "frame/memory_fit.hpp"

#include <algorithm>
#include <array>
#include <bit>
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

// Samples of the targets of a plan, each with at most `most` a pixel.
struct Samples {
  int most = static_cast<int>(kSamples.high);

  uint64_t of(const PixelRect& rect, int samples) const {
    return pixels(rect) * static_cast<uint64_t>(std::min(samples, most));
  }
  uint64_t of(const Pass& pass) const { return of(pass.view.rect, pass.quality.samples); }
};

// Returns the samples of the cached images.
uint64_t cachedSamples(const FramePlan& plan, const Samples& samples) {
  uint64_t sum = 0;
  for (const CachedImage& image : plan.cached) {
    sum += image.cacheIndex >= 0 ? samples.of(image.view.rect, image.samples) : 0;
  }
  return sum;
}

// Returns the most samples of mirror images that exist at one time: each from its range of passes to its parent's.
uint64_t peakSamples(const FramePlan& plan, std::span<const PassRange> ranges, const Samples& samples) {
  uint64_t alive = cachedSamples(plan, samples);
  uint64_t peak = alive;
  for (const PassRange& range : ranges) {
    for (size_t i = range.first; i < range.end; ++i) {
      alive += samples.of(plan.passes[i]);
    }
    peak = std::max(peak, alive);
    for (size_t i = range.first; i < range.end; ++i) {
      for (const MirrorDraw& draw : plan.passes[i].mirrors) {
        alive -= draw.pass >= 0 ? samples.of(plan.passes[draw.pass]) : 0;
      }
    }
  }
  return peak;
}

// Returns the bytes of the samples of the largest pass, whose radiance deferred shading keeps.
uint64_t shadedBytes(const FramePlan& plan, const Settings& settings, const Samples& all) {
  uint64_t samples = all.of(plan.main().view.rect, settings.view.samples);
  for (const Pass& pass : plan.drawnMirrors()) {
    samples = std::max(samples, all.of(pass));
  }
  return plan.effects.any() ? std::min(samples, mostShadedSamples) * (bytesPerShadedSample + bytesPerRequest) : 0;
}

uint64_t mainBytes(const FramePlan& plan, int sampleCount) {
  const auto samples = static_cast<uint64_t>(sampleCount);
  const uint64_t multisampled = samples > 1 ? samples * colorBytes : 0;
  return pixels(plan.main().view.rect) * (colorBytes + multisampled + samples * depthBytes);
}

// Returns the samples of the depth images, which the ranges use one after the other: some for each sample count.
uint64_t depthSamples(const FramePlan& plan, std::span<const PassRange> ranges, const Samples& samples) {
  std::array<RecycledVector<uint64_t>, 4> largest;  // by the logarithm of the count
  for (const PassRange& range : ranges) {
    std::array<size_t, 4> places{};
    for (const size_t i : largestFirst(plan, range)) {
      const int count = std::countr_zero(static_cast<unsigned>(plan.passes[i].quality.samples));
      const size_t place = places[count]++;
      largest[count].resize(std::max(largest[count].size(), place + 1), 0);
      largest[count][place] = std::max(largest[count][place], samples.of(plan.passes[i]));
    }
  }
  uint64_t sum = 0;
  for (const RecycledVector<uint64_t>& images : largest) {
    sum = std::accumulate(images.begin(), images.end(), sum);
  }
  return sum;
}

// Makes mirror images at most so large. Returns what the message says of it.
std::string lowerScale(Settings& settings, double scale) {
  Settings largest;
  settings.limit.scale = largest.reflection.scale = scale;
  const bool own = settings.reflection.scale < scale;
  settings.reflection.scale = std::min(settings.reflection.scale, scale);
  return (own ? "quality.scale to " : "reflection.scale to ") + settingValue(largest, "reflection.scale");
}

// `most`: that any mirror asks for.
bool lower(Settings& settings, const ReflectionSettings& most, const FramePlan& plan, std::string& what) {
  ReflectionSettings& reflection = settings.reflection;
  if (most.samples > 1) {
    settings.limit.samples = most.samples / 2;
    what = reflection.samples < most.samples ? "quality.samples to " : "reflection.samples to ";
    what += std::to_string(settings.limit.samples);
    reflection.samples = std::min(reflection.samples, settings.limit.samples);
  } else if (settings.view.samples > 1) {
    settings.view.samples /= 2;
    what = "view.samples to " + std::to_string(settings.view.samples);
  } else if (most.scale > smallestScale) {
    what = lowerScale(settings, std::max(smallestScale, most.scale / 2.0));
  } else if (!cubesOf(plan.cubes, PassKind::environment).empty() && settings.effects.environmentSize > smallestMap) {
    settings.effects.environmentSize /= 2;
    what = "effects.environment_size to " + std::to_string(settings.effects.environmentSize);
  } else if (!cubesOf(plan.cubes, PassKind::shadow).empty() && settings.effects.shadowMapSize > smallestShadowMap) {
    settings.effects.shadowMapSize /= 2;
    what = "effects.shadow_map_size to " + std::to_string(settings.effects.shadowMapSize);
  } else {
    return false;
  }
  return true;
}

bool isAutomatic(const Mirror& mirror, const Settings& settings) {
  return reflectionOf(mirror.quality, settings).method == ReflectionMethod::automatic;
}

// Says whether a GPU draws the frame faster with rays in the place of mirror images: with one sample a pixel, once a
// mirror covers much of the picture (docs/scaling.md). More samples were not measured. Only mirrors count that are
// automatic by `asked`.
bool raysAreFaster(const FramePlan& plan, const Scene& scene, const Settings& asked) {
  return asked.view.samples == 1 && std::ranges::any_of(plan.drawnMirrors(), [&](const Pass& pass) {
           return pass.depth == 0 && pass.areaPx >= pixelsForRays &&
                  isAutomatic(scene.mirrors[pass.view.path[0]], asked);
         });
}

// Sets what automatic mirrors are drawn by.
void setAutomatic(Settings& settings, const Settings& asked, ReflectionMethod method) {
  settings.limit.automatic = method;
  if (asked.reflection.method == ReflectionMethod::automatic) {
    settings.reflection.method = method;
  }
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
  settings.limit.rays = false;
}

uint64_t bytesWith(const FramePlan& plan, const Settings& settings, const Samples& samples) {
  const RecycledVector<PassRange> ranges = independentPasses(plan);
  const uint64_t sums = settings.view.accumulate > 1 ? sumBytes : 0;
  return mainBytes(plan, std::min(settings.view.samples, samples.most)) + pixels(plan.main().view.rect) * sums +
         peakSamples(plan, ranges, samples) * colorBytes + depthSamples(plan, ranges, samples) * depthBytes +
         environmentBytes(plan) + shadowBytes(plan) + shadedBytes(plan, settings, samples);
}

std::string mebibytes(uint64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

}  // namespace

uint64_t environmentBytes(const FramePlan& plan) {
  uint64_t color = 0;
  uint64_t largest = 0;
  for (const Cube& map : cubesOf(plan.cubes, PassKind::environment)) {
    const uint64_t texels = 6 * static_cast<uint64_t>(map.size) * static_cast<uint64_t>(map.size);
    color += texels * colorBytes;
    largest = std::max(largest, texels);
  }
  return color + largest * depthBytes;
}

uint64_t shadowBytes(const FramePlan& plan) {
  const glm::ivec2 extent = shadowExtent(plan);
  const uint64_t layerBytes = hasShadowLayers(plan) ? shadowPlaneBytes : 0;
  return static_cast<uint64_t>(extent.x) * static_cast<uint64_t>(extent.y) *
         (shadowPlaneBytes + depthBytes + layerBytes);
}

uint64_t targetBytes(const FramePlan& plan, const Settings& settings) {
  return bytesWith(plan, settings, {});
}

uint64_t sampleBytes(const FramePlan& plan, const Settings& settings) {
  return targetBytes(plan, settings) - bytesWith(plan, settings, {.most = 1});
}

FittedPlan planWithin(const TargetLimits& limits, const Scene& scene, const SceneState& state, const Settings& settings,
                      int width, int height, FrameCache cache, int picture) {
  FittedPlan fitted{{}, pictureSettings(settings), {}};
  const ReflectionSettings most = mostAsked(scene, fitted.settings);
  const double margins = most.updateInterval > 1 ? 2.0 * largestMargin * height : 0.0;
  const auto plan = [&] { fitted.plan = planFrame(scene, state, fitted.settings, width, height, cache, picture); };
  const auto say = [&](const std::string& what) { fitted.message += (fitted.message.empty() ? "" : "; ") + what; };
  const double largestScale = limits.largestSide / (settings.view.scale * (std::max(width, height) + margins));
  if (most.scale > largestScale) {
    Settings asked;
    asked.reflection.scale = most.scale;
    say("mirror images of " + settingValue(asked, "reflection.scale") +
        " times the main view's size are larger than the device's " + std::to_string(limits.largestSide) +
        " pixels: lowered " + lowerScale(fitted.settings, largestScale));
  }
  if (!limits.cpu || !limits.tracesRays) {
    setAutomatic(fitted.settings, settings, ReflectionMethod::raster);
  }
  plan();
  if (!limits.cpu && limits.tracesRays && raysAreFaster(fitted.plan, scene, pictureSettings(settings))) {
    setAutomatic(fitted.settings, settings, ReflectionMethod::rays);
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
  for (glm::ivec2 extent = shadowExtent(fitted.plan); std::max(extent.x, extent.y) > limits.largestSide; extent /= 2) {
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
    int samples = settings.view.samples;
    while (samples > 1 && mainBytes(fitted.plan, samples) > limits.budgetBytes) {
      samples /= 2;
    }
    kept = mainBytes(fitted.plan, samples);
  }
  const auto needed = [&] { return kept + targetBytes(fitted.plan, fitted.settings); };
  if (needed() > limits.budgetBytes && most.updateInterval == 1) {
    cache.images = {};
    plan();
  }
  const uint64_t wanted = needed();
  std::string what;
  std::string lowered;
  while (needed() > limits.budgetBytes &&
         lower(fitted.settings, mostAsked(scene, fitted.settings), fitted.plan, what)) {
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
