#include "app/frame_cost.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "frame/mesh_level.hpp"

namespace speculum {

namespace {

// Milliseconds for a picture's pixel, a pass, a triangle, a texel and each further sample of a texel.
constexpr std::array<double, 5> cpuPrices{8e-6, 0.3, 1e-4, 8e-5, 6e-5};
constexpr std::array<double, 5> gpuPrices{1e-7, 0.03, 2e-6, 2e-6, 5e-7};

// Standard deviations, relative.
constexpr double speedGuess = 1.0;    // of the device's speed at first
constexpr double priceGuess = 0.5;    // of each price besides
constexpr double speedDrift = 0.015;  // from frame to frame
constexpr double priceDrift = 0.004;
constexpr double frameNoise = 0.1;
constexpr double noiseMs = 0.2;
constexpr double speedJump = 0.3;  // after several surprises in a row

constexpr int surprisesOfAJump = 3;
constexpr double surprise = 1.5;      // deviations
constexpr double mostBelieved = 2.5;  // deviations: bounds the weight of a single disturbed frame
constexpr double leastFactor = 0.02;

double trianglesOf(const PlannedPass& pass, const Scene& scene, const SceneState& state) {
  double indices = 0.0;
  for (const int instance : pass.instances) {
    const Mesh& mesh = scene.meshes[static_cast<size_t>(state.instances[static_cast<size_t>(instance)].mesh)];
    const PartialInstance* part = partOf(pass.partial, instance);
    const int level = levelOf(pass, instance);
    indices += part         ? indexCount(part->ranges)
               : level >= 0 ? levelsOf(mesh).levels[static_cast<size_t>(level)].all.count
                            : static_cast<double>(mesh.indices.size());
  }
  return indices / 3.0;
}

}  // namespace

FrameWork workOf(const FramePlan& plan, const Scene& scene, const SceneState& state, const Settings& settings) {
  FrameWork work{.picturePixels = static_cast<double>(plan.width) * plan.height,
                 .passes = static_cast<double>(plan.passes.size()) + 1.0,
                 .mainTexels = static_cast<double>(plan.main.view.rect.area()),
                 .viewSamples = settings.view.samples,
                 .mirrorSamples = settings.reflection.samples};
  work.triangles = trianglesOf(plan.main, scene, state);
  for (const PlannedPass& pass : plan.passes) {
    work.triangles += trianglesOf(pass, scene, state);
    work.mirrorTexels += pass.areaPx;
  }
  return work;
}

FrameWork scaledWork(FrameWork work, const Settings& from, const Settings& to) {
  const auto squared = [](double ratio) { return ratio * ratio; };
  const double view = to.view.scale / from.view.scale;
  work.mainTexels *= squared(view);
  work.mirrorTexels *= squared(view * to.reflection.scale / from.reflection.scale);
  work.viewSamples = to.view.samples;
  work.mirrorSamples = to.reflection.samples;
  return work;
}

CostModel::CostModel(bool cpuDevice) : prices_(cpuDevice ? cpuPrices : gpuPrices) {
  factors_.fill(1.0);
  for (size_t i = 0; i < kinds; ++i) {
    covariance_[i].fill(speedGuess * speedGuess);
    covariance_[i][i] += priceGuess * priceGuess;
  }
}

CostModel::Vector CostModel::guess(const FrameWork& work) const {
  const double further = work.mainTexels * (work.viewSamples - 1) + work.mirrorTexels * (work.mirrorSamples - 1);
  Vector ms{work.picturePixels, work.passes, work.triangles, work.mainTexels + work.mirrorTexels, further};
  std::ranges::transform(ms, prices_, ms.begin(), std::multiplies());
  return ms;
}

double CostModel::predict(const FrameWork& work) const {
  const Vector ms = guess(work);
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
  const Vector observed = guess(work);
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
