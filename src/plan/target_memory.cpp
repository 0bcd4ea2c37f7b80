#include "plan/target_memory.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "plan/shadow_map.hpp"

namespace speculum {

namespace {

double area(const Pass& pass) {
  return static_cast<double>(pass.view.rect.area());
}

bool showsImageOf(const Pass& pass, size_t first) {
  return std::ranges::any_of(pass.mirrors,
                             [&](const MirrorDraw& draw) { return draw.pass >= static_cast<int>(first); });
}

uint64_t pixels(const PixelRect& rect) {
  return static_cast<uint64_t>(rect.area());
}

// Samples of the targets of a plan, each with at most `most` a pixel.
struct Samples {
  int most = static_cast<int>(samplesRange.high);

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
uint64_t peakSamples(const FramePlan& plan, std::span<const ConcurrentPasses> ranges, const Samples& samples) {
  uint64_t alive = cachedSamples(plan, samples);
  uint64_t peak = alive;
  for (const ConcurrentPasses& range : ranges) {
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

// Returns the samples of the depth images, which the ranges use one after the other. Each sample count has depth images
// of its own.
uint64_t depthSamples(const FramePlan& plan, std::span<const ConcurrentPasses> ranges, const Samples& samples) {
  std::array<RecycledVector<uint64_t>, 4> largest;  // samples of each image, by the logarithm of the sample count
  for (const ConcurrentPasses& range : ranges) {
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

uint64_t bytesWith(const FramePlan& plan, const Settings& settings, const Samples& samples) {
  const RecycledVector<ConcurrentPasses> ranges = independentPasses(plan);
  const uint64_t sums = settings.view.accumulate > 1 ? sumBytes : 0;
  return mainBytes(plan, std::min(settings.view.samples, samples.most)) + pixels(plan.main().view.rect) * sums +
         peakSamples(plan, ranges, samples) * colorBytes + depthSamples(plan, ranges, samples) * depthBytes +
         environmentBytes(plan) + shadowBytes(plan) + shadedBytes(plan, settings, samples);
}

}  // namespace

RecycledVector<ConcurrentPasses> independentPasses(const FramePlan& plan) {
  RecycledVector<ConcurrentPasses> ranges;
  double covered = 0.0;  // pixels that the last range covers
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    const Pass& pass = plan.passes[i];
    if (pass.id.kind != PassKind::mirror || !pass.drawn()) {
      continue;
    }
    const double picture = pass.view.pictureSize.x * pass.view.pictureSize.y;
    if (ranges.empty() || showsImageOf(pass, ranges.back().first) || covered + area(pass) > picture) {
      ranges.push_back({i, i});
      covered = 0.0;
    }
    ranges.back().end = i + 1;
    covered += area(pass);
  }
  return ranges;
}

RecycledVector<size_t> largestFirst(const FramePlan& plan, const ConcurrentPasses& range) {
  RecycledVector<size_t> passes(range.end - range.first);
  std::iota(passes.begin(), passes.end(), range.first);
  std::ranges::sort(passes, {}, [&](size_t i) { return std::pair(-area(plan.passes[i]), i); });
  return passes;
}

uint64_t mainBytes(const FramePlan& plan, int sampleCount) {
  const auto samples = static_cast<uint64_t>(sampleCount);
  const uint64_t multisampled = samples > 1 ? samples * colorBytes : 0;
  const uint64_t output = plan.encodes ? 0 : colorBytes;
  return pixels(plan.main().view.rect) * (output + multisampled + samples * depthBytes);
}

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

}  // namespace speculum
