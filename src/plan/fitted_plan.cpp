#include "plan/fitted_plan.hpp"

#include <algorithm>

#include "plan/image_reuse.hpp"
#include "plan/refined_tiles.hpp"
#include "plan/shadow_map.hpp"
#include "plan/target_memory.hpp"

namespace speculum {

namespace {

constexpr double smallestScale = 0.125;  // of mirror images
constexpr double pixelsForRays = 4e5;    // texels of a mirror image, see raysAreFaster()
constexpr int smallestMap = 16;          // texels
constexpr int smallestShadowMap = 64;    // texels

// Bounds the scale of mirror images. Returns the words for the message, such as "reflection.scale to 0.5".
std::string lowerScale(Settings& settings, double scale) {
  Settings largest;
  settings.limit.scale = largest.reflection.scale = scale;
  const bool own = settings.reflection.scale < scale;
  settings.reflection.scale = std::min(settings.reflection.scale, scale);
  return (own ? "quality.scale to " : "reflection.scale to ") + settingValue(largest, "reflection.scale");
}

// Lowers one setting by one step and writes the words for the message to `what`; returns false if nothing can be
// lowered. `most`: the largest values that any mirror asks for.
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
  } else if (const int size = shadowMapSize(plan); size > smallestShadowMap) {
    settings.effects.shadowMapSize = size / 2;
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
// mirror covers much of the picture (docs/performance.md). More samples were not measured. Only mirrors whose method is
// automatic in `asked` count.
bool raysAreFaster(const FramePlan& plan, const Scene& scene, const Settings& asked) {
  return asked.view.samples == 1 && std::ranges::any_of(plan.drawnMirrors(), [&](const Pass& pass) {
           return depthOf(pass.view.path) == 0 && pass.areaPx >= pixelsForRays &&
                  isAutomatic(scene.mirror(pass.view.path[0]), asked);
         });
}

// What shadows cost on a device, in rays to lights of a picture with one sample a pixel.
struct ShadowPrices {
  double texel;           // of a map
  double face;            // a map's pass
  double severalSamples;  // a ray where a pixel has several samples
};

// On a CPU those of session/frame_cost.cpp. On a GPU they fit an H200, which traces by shaders: in the gallery and in
// `shadows` at 1280x720, with 1 and 4 samples and maps of 3 sizes, the way that they call faster was so in all 12
// cases.
constexpr ShadowPrices cpuPrices{1.0 / 125.0, 300.0, 1.0};
constexpr ShadowPrices gpuPrices{1.0, 1e5, 5.0};

// Says whether shadow maps should take less time than traced shadows. A lookup takes about a tenth of a ray. Counts all
// faces of maps that are read, as if each frame drew them, and no layers, so that the answer does not depend on what
// earlier frames drew.
bool mapsAreFaster(const FramePlan& plan, const Scene& scene, const Settings& settings, bool cpu) {
  constexpr double lookup = 0.1;  // in rays
  const ShadowPrices& prices = cpu ? cpuPrices : gpuPrices;
  const double lights = static_cast<double>(shadowLights(scene).size());
  double maps = 0.0;  // in rays
  double rays = 0.0;
  for (const Pass& pass : plan.passes) {
    if (pass.isLayer) {
      continue;
    }
    const double texels = pass.id.kind == PassKind::mirror ? pass.areaPx : static_cast<double>(pass.view.rect.area());
    if (pass.id.kind == PassKind::shadow) {
      maps += pass.source == PassSource::unread ? 0.0 : prices.texel * texels + prices.face;
    } else {
      const bool each = cpu && settings.effects.perSample;
      maps += lookup * texels * lights;
      rays += texels * lights * (pass.quality.samples == 1 ? 1.0 : each ? pass.quality.samples : prices.severalSamples);
    }
  }
  return maps < rays;
}

// Sets the method by which automatic mirrors are drawn.
void setAutomatic(Settings& settings, const Settings& asked, ReflectionMethod method) {
  settings.limit.automatic = method;
  if (asked.reflection.method == ReflectionMethod::automatic) {
    settings.reflection.method = method;
  }
}

void replaceRays(Settings& settings, const Scene& scene) {
  EffectSettings& effects = settings.effects;
  effects.shadows = effects.shadows && fitsShadowMaps(scene);
  effects.shadowLookup = ShadowLookup::map;
  effects.roughLookup = effects.rippleLookup = ReflectionSource::image;
  effects.curvedLookup = CurvedLookup::environment;
  effects.castsLight = false;
  settings.reflection.method = ReflectionMethod::raster;
  settings.limit.rays = false;
}

std::string mebibytes(uint64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

// The steps of planWithin().
class PlanFitter {
 public:
  PlanFitter(const TargetLimits& limits, const FrameRequest& request)
      : limits_(limits),
        asked_(request),
        chosen_(request.settings),
        fitted_{{}, pictureSettings(chosen_), {}, limits.whyNoRays.empty()} {}

  FittedPlan fit() {
    boundImages();
    const bool automaticShadows = lookup() == ShadowLookup::automatic;
    chooseShadows();
    chooseReflections();
    if (automaticShadows && fitted_.traces && fitted_.plan.effects.shadows) {
      chooseShadowsByPrice();
    }
    boundShadowMaps();
    fitMemory();
    if ((automaticShadows || replacesRays_) && fitted_.plan.effects.shadows) {
      fitted_.plan.effects.shadows->append(replacesRays_ ? "; without rays: " : "; auto: ")
          .append(lookup() == ShadowLookup::map      ? "map"  // settingValue() allocates
                  : lookup() == ShadowLookup::hybrid ? "hybrid"
                                                     : "traced");
    }
    return std::move(fitted_);
  }

 private:
  void plan() {
    asked_.settings = fitted_.settings;
    fitted_.plan = planFrame(asked_);
  }

  void say(const std::string& what) { fitted_.message += (fitted_.message.empty() ? "" : "; ") + what; }
  ShadowLookup& lookup() { return fitted_.settings.effects.shadowLookup; }

  void boundImages() {
    const ReflectionSettings most = mostAsked(asked_.scene, fitted_.settings);
    const double margins = most.updateInterval > 1 ? 2.0 * largestMargin * asked_.size.y : 0.0;
    const double largestScale =
        limits_.largestSide / (chosen_.view.scale * (std::max(asked_.size.x, asked_.size.y) + margins));
    if (most.scale > largestScale) {
      Settings largest;
      largest.reflection.scale = most.scale;
      say("mirror images of " + settingValue(largest, "reflection.scale") +
          " times the main view's size are larger than the device's " + std::to_string(limits_.largestSide) +
          " pixels: lowered " + lowerScale(fitted_.settings, largestScale));
    }
  }

  void chooseShadows() {
    if (lookup() == ShadowLookup::automatic) {
      lookup() = ShadowLookup::map;
    } else if (lookup() == ShadowLookup::hybrid && !limits_.hybridShadows) {
      lookup() = fitted_.traces ? ShadowLookup::traced : ShadowLookup::map;
      say("effects.shadow_lookup=hybrid is replaced by " + settingValue(fitted_.settings, "effects.shadow_lookup") +
          ": the device draws no lines or has no sampleRateShading");
    }
  }

  // Chooses the fastest lookup, or for a mean of pictures the fastest exact one: maps err alike in all of them.
  void chooseShadowsByPrice() {
    const bool maps =
        fitted_.plan.effects.shadowMaps && mapsAreFaster(fitted_.plan, asked_.scene, fitted_.settings, limits_.cpu);
    if (maps && chosen_.view.accumulate == 1) {
      return;
    }
    lookup() = maps && limits_.cpu && limits_.hybridShadows ? ShadowLookup::hybrid : ShadowLookup::traced;
    plan();
  }

  // Makes the first plan.
  void chooseReflections() {
    if (!limits_.cpu || !fitted_.traces) {
      setAutomatic(fitted_.settings, chosen_, ReflectionMethod::raster);
    }
    plan();
    if (!limits_.cpu && fitted_.traces && raysAreFaster(fitted_.plan, asked_.scene, pictureSettings(chosen_))) {
      setAutomatic(fitted_.settings, chosen_, ReflectionMethod::rays);
      plan();
    }
    if (!fitted_.traces && fitted_.plan.effects.any()) {
      replacesRays_ = true;
      replaceRays(fitted_.settings, asked_.scene);
      say("effects.* show images and maps instead of rays, without light that mirrors cast and shadows of too many "
          "lights or objects: " +
          limits_.whyNoRays);
      plan();
    }
  }

  void boundShadowMaps() {
    int size = shadowMapSize(fitted_.plan);
    glm::ivec2 extent = shadowExtent(fitted_.plan);
    for (; std::max(extent.x, extent.y) > limits_.largestSide; extent /= 2) {
      size /= 2;
    }
    if (size < shadowMapSize(fitted_.plan)) {
      say("shadow maps exceed the device's " + std::to_string(limits_.largestSide) +
          " pixels: lowered effects.shadow_map_size to " + std::to_string(size));
      fitted_.settings.effects.shadowMapSize = size;
      plan();
    }
  }

  // Returns the bytes of the picture that stays shown: it was drawn with the samples that were asked for, or as many as
  // fitted.
  uint64_t keptBytes() const {
    int samples = chosen_.view.samples;
    while (samples > 1 && mainBytes(fitted_.plan, samples) > limits_.budgetBytes) {
      samples /= 2;
    }
    const bool keeps = limits_.keepsPicture && (chosen_.view.accumulate > 1 || chosen_.quality.stillPictures == 1);
    return keeps ? mainBytes(fitted_.plan, samples) : 0;
  }

  void fitMemory() {
    const uint64_t kept = keptBytes();
    const auto needed = [&] { return kept + targetBytes(fitted_.plan, fitted_.settings); };
    if (needed() > limits_.budgetBytes && mostAsked(asked_.scene, fitted_.settings).updateInterval == 1) {
      asked_.cache.images = {};
      plan();
    }
    const uint64_t wanted = needed();
    std::string what;
    std::string lowered;
    while (needed() > limits_.budgetBytes &&
           lower(fitted_.settings, mostAsked(asked_.scene, fitted_.settings), fitted_.plan, what)) {
      lowered += (lowered.empty() ? "" : ", ") + what;
      plan();
    }
    if (!lowered.empty()) {
      say("targets of " + mebibytes(wanted) + " do not fit the device's " + mebibytes(limits_.budgetBytes) +
          ": lowered " + lowered);
    }
  }

  const TargetLimits& limits_;
  bool replacesRays_ = false;
  FrameRequest asked_;      // of the last plan
  const Settings& chosen_;  // of the request
  FittedPlan fitted_;
};

}  // namespace

FittedPlan planWithin(const TargetLimits& limits, const FrameRequest& request) {
  return PlanFitter(limits, request).fit();
}

}  // namespace speculum
