#include "session/frame_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "scene/material_mirrors.hpp"

namespace speculum {

namespace {

// Milliseconds for a texel without lighting, a pass, a triangle, a lit texel, each further sample of a texel, and a
// ray.
constexpr std::array<double, 6> cpuPrices{8e-6, 0.3, 1e-4, 3e-5, 3e-5, 1e-3};
constexpr std::array<double, 6> gpuPrices{1e-7, 0.03, 2e-6, 2e-6, 5e-7, 1e-5};
constexpr size_t rayKind = 5;
constexpr double hybridRays = 0.1;  // share of the points for which hybrid shadows trace rays

// Relative standard deviations.
constexpr double speedSpread = 1.0;   // of the device's speed at first
constexpr double priceSpread = 0.5;   // of each price, in addition
constexpr double raySpread = 1.5;     // of a ray's price instead, which depends on scene and hardware
constexpr double speedDrift = 0.015;  // from frame to frame
constexpr double priceDrift = 0.004;
constexpr double frameNoise = 0.1;
constexpr double noiseMs = 0.2;
constexpr double speedJump = 0.3;  // drift of speed after surprisesOfAJump

constexpr int surprisesOfAJump = 3;
constexpr double surprise = 1.5;      // deviations
constexpr double mostBelieved = 2.5;  // deviations: bounds the weight of a single disturbed frame
constexpr double leastFactor = 0.02;

double trianglesOf(const Pass& pass, const Scene& scene, const SceneState& state) {
  double indices = 0.0;
  for (const int instance : pass.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(state.instances[static_cast<size_t>(instance)].mesh)];
    const PartialInstance* part = partOf(pass.partial, instance);
    indices += part ? indexCount(part->ranges) : static_cast<double>(mesh.indices.size());
  }
  return indices / 3.0;
}

// Adds the rays of a pass with this number of texels, each of `samples` samples.
void addRays(FrameWork& work, const Pass& pass, double texels, int samples, const FramePlan& plan, const Scene& scene,
             const SceneState& state, const EffectSettings& settings) {
  const TracedEffects& effects = plan.effects;
  const double points = settings.perSample ? samples : 1.0;  // of a texel that rays start from
  const auto toLights = static_cast<double>(effects.raysToLights(scene));
  const double reflected = points * (1.0 + toLights);
  work.lightRays += texels * points * toLights * (effects.hybridShadows ? hybridRays : effects.shadowMaps ? 0.0 : 1.0);
  for (const MirrorDraw& draw : pass.mirrors) {
    if (draw.byRays && !draw.back) {
      const MirrorOptics optics = opticsOf(scene.mirror(static_cast<size_t>(draw.mirror)), settings);
      const bool rough = optics.alpha > 0.0;
      const double area = screenArea(toClip(pass.view, plan.projection, draw.polygon), pass.view.pictureSize.x,
                                     pass.view.pictureSize.y);
      // Every sample sends rays, whatever effects.per_sample is.
      const double rays = area * (1.0 + toLights) * (rough ? roughRays(settings, samples) : samples);
      (rough ? work.roughRays : optics.ripple ? work.rippleRays : work.smoothRays) += rays;
    }
  }
  for (const int i : pass.instances) {
    const InstanceState& instance = state.instances[static_cast<size_t>(i)];
    if (effects.curvedRays && curvedMirrorOf(scene, instance)) {
      const double distance = glm::length(instance.center - pass.view.eye);
      const double radius =
          instance.radius / std::max(distance, 1e-9) * 0.5 * plan.projection.focal * pass.view.pictureSize.y;
      work.curvedRays += std::min(std::numbers::pi * radius * radius, texels) * reflected;
    }
  }
}

}  // namespace

FrameWork workOf(const FramePlan& plan, const Scene& scene, const SceneState& state, const Settings& settings) {
  FrameWork work{.displayTexels = plan.encodes ? 0.0 : static_cast<double>(plan.width) * plan.height,
                 .mainTexels = static_cast<double>(plan.main().view.rect.area()),
                 .viewSamples = settings.view.samples,
                 .interval = mostAsked(scene, settings).updateInterval,
                 .mirrorSamples = 1.0 * settings.reflection.samples};
  double further = 0.0;  // samples beyond those of the settings
  for (const Pass& pass : plan.passes) {
    const PassKind kind = pass.id.kind;
    if (!pass.drawn() && kind != PassKind::main) {
      continue;
    }
    ++work.passes;
    work.triangles += trianglesOf(pass, scene, state);
    if (kind == PassKind::shadow) {
      work.shadowTexels += static_cast<double>(pass.view.rect.area());
      continue;
    }
    const double texels = kind == PassKind::main ? work.mainTexels : pass.areaPx;
    addRays(work, pass, texels, kind == PassKind::main ? work.viewSamples : pass.quality.samples, plan, scene, state,
            settings.effects);
    if (kind == PassKind::mirror) {
      ++work.mirrorPasses;
      work.mirrorTexels += pass.areaPx;
      further += pass.areaPx * (pass.quality.samples - settings.reflection.samples);
    } else if (kind == PassKind::environment) {
      work.mapTexels += pass.areaPx;
    }
  }
  work.mirrorSamples += work.mirrorTexels > 0.0 ? further / work.mirrorTexels : 0.0;
  return work;
}

FrameWork scaledWork(FrameWork work, const Settings& from, const Settings& to) {
  const auto squared = [](double ratio) { return ratio * ratio; };
  const double view = to.view.scale / from.view.scale;
  if (work.displayTexels == 0.0 && mayEncode(from.view) && !mayEncode(to.view)) {
    work.displayTexels = work.mainTexels;
  }
  work.mainTexels *= squared(view);
  work.mirrorTexels *= squared(view * to.reflection.scale / from.reflection.scale);
  const double kept = std::min(work.mirrorPasses, static_cast<double>(to.reflection.maxPasses));
  const double passes = work.passes - work.mirrorPasses + kept;
  work.triangles *= passes / std::max(work.passes, 1.0);
  work.passes = passes;
  work.mirrorPasses = kept;
  const auto points = [](const Settings& settings) { return settings.effects.perSample ? settings.view.samples : 1.0; };
  const double rays = squared(view) * points(to) / points(from);
  const EffectSettings& effects = to.effects;
  const auto share = [](ShadowLookup lookup) {
    return lookup == ShadowLookup::traced ? 1.0 : lookup == ShadowLookup::map ? 0.0 : hybridRays;
  };
  // If shadows were looked up in maps, all rays to lights were for light that mirrors cast, and these rays stay.
  const ShadowLookup before = from.effects.shadowLookup;
  const bool stay = (before == effects.shadowLookup && from.effects.castsLight == effects.castsLight) ||
                    (before != ShadowLookup::traced && effects.castsLight) ||
                    effects.shadowLookup == ShadowLookup::automatic;
  work.lightRays *= stay ? rays : rays * share(effects.shadowLookup) / std::max(share(before), hybridRays);
  const double sampleRays = squared(view) * to.view.samples / from.view.samples;
  work.rippleRays *= effects.rippleLookup == ReflectionSource::image ? 0.0 : sampleRays;
  // If `from` did not call for rays, the counted rays are those of single mirrors with a method of their own, and stay.
  const bool images =
      to.reflection.method == ReflectionMethod::raster && from.reflection.method != to.reflection.method;
  work.smoothRays *= images || !to.limit.rays ? 0.0 : sampleRays;
  work.curvedRays *= effects.curvedLookup == CurvedLookup::environment ? 0.0 : rays;
  work.roughRays *=
      effects.roughLookup == ReflectionSource::image
          ? 0.0
          : squared(view) * roughRays(effects, to.view.samples) / roughRays(from.effects, from.view.samples);
  work.viewSamples = to.view.samples;
  const double samples = work.mirrorSamples * to.reflection.samples / from.reflection.samples;
  work.mirrorSamples = std::min(std::max(samples, 1.0), 1.0 * to.limit.samples);
  return work;
}

CostModel::CostModel(bool cpuDevice) : typicalPrices_(cpuDevice ? cpuPrices : gpuPrices) {
  factors_.fill(1.0);
  for (size_t i = 0; i < kinds; ++i) {
    covariance_[i].fill(speedSpread * speedSpread);
    const double price = i == rayKind ? raySpread : priceSpread;
    covariance_[i][i] += price * price;
  }
}

CostModel::Vector CostModel::typicalMs(const FrameWork& work) const {
  const double further = work.mainTexels * (work.viewSamples - 1) + work.mirrorTexels * (work.mirrorSamples - 1);
  Vector ms{work.displayTexels + work.shadowTexels,
            work.passes,
            work.triangles,
            work.mainTexels + work.mirrorTexels + work.mapTexels,
            further,
            work.lightRays + work.rippleRays + work.smoothRays + work.curvedRays + work.roughRays};
  std::ranges::transform(ms, typicalPrices_, ms.begin(), std::multiplies());
  return ms;
}

double CostModel::predict(const FrameWork& work) const {
  const Vector ms = typicalMs(work);
  return std::inner_product(ms.begin(), ms.end(), factors_.begin(), 0.0);
}

void CostModel::learn(const FrameWork& work, double ms) {
  const auto widen = [&](double speed, double price) {
    for (size_t i = 0; i < kinds; ++i) {
      for (size_t j = 0; j < kinds; ++j) {
        covariance_[i][j] += speed * speed * factors_[i] * factors_[j];
      }
      covariance_[i][i] += price * price * factors_[i] * factors_[i];
    }
  };
  widen(speedDrift, priceDrift);
  const Vector observed = typicalMs(work);
  const double predicted = predict(work);
  const double noise = frameNoise * predicted + noiseMs;
  const auto spread = [&] {  // covariance times `observed`
    Vector product;
    for (size_t i = 0; i < kinds; ++i) {
      product[i] = std::inner_product(observed.begin(), observed.end(), covariance_[i].begin(), 0.0);
    }
    return product;
  };
  Vector gain = spread();
  const auto variance = [&] {
    return std::inner_product(observed.begin(), observed.end(), gain.begin(), noise * noise);
  };
  const double deviations = (ms - predicted) / std::sqrt(variance());
  const int direction = deviations > surprise ? 1 : deviations < -surprise ? -1 : 0;
  surprises_ = direction * surprises_ > 0 ? surprises_ + direction : direction;
  if (std::abs(surprises_) >= surprisesOfAJump) {
    widen(speedJump, 0.0);
    gain = spread();
  }
  const double sum = variance();
  const double most = mostBelieved * std::sqrt(sum);
  const double error = std::clamp(ms - predicted, -most, most);
  for (size_t i = 0; i < kinds; ++i) {
    factors_[i] = std::max(factors_[i] + gain[i] / sum * error, leastFactor);
    for (size_t j = 0; j < kinds; ++j) {
      covariance_[i][j] -= gain[i] * gain[j] / sum;
    }
  }
}

}  // namespace speculum
