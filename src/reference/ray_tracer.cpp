#include "reference/ray_tracer.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <numbers>
#include <stdexcept>

#include "reference/path_tracer.hpp"

namespace speculum {

namespace {

constexpr int tileSize = 16;

int gridSize(int samples) {
  const int side = static_cast<int>(std::lround(std::sqrt(std::max(samples, 0))));
  if (side < 1 || side * side != samples) {
    throw std::invalid_argument("the number of samples must be a square (1, 4, 9, 16 ...), not " +
                                std::to_string(samples));
  }
  return side;
}

void check(const TraceOptions& options) {
  if (options.width < 1 || options.height < 1) {
    throw std::invalid_argument("a picture needs a width and a height of at least 1 pixel");
  }
  if (options.roughSamples < 1) {
    throw std::invalid_argument("rough mirrors need at least 1 sample");
  }
  gridSize(options.samples);
}

// Returns the position of sample `k` in the pixel, 0 .. 1.
glm::dvec2 samplePosition(const TraceOptions& options, int side, int k) {
  if (options.lattice) {
    // Fibonacci lattice about the pixel's centre.
    const double fromMiddle = k - 0.5 * (options.samples - 1);
    return {0.5 + fromMiddle / options.samples, glm::fract(0.5 + fromMiddle * (std::numbers::phi - 1.0))};
  }
  return {(k % side + 0.5) / side, (k / side + 0.5) / side};
}

}  // namespace

Ray RayTracer::cameraRay(const TraceOptions& options, double x, double y) const {
  const double tangent = std::tan(0.5 * camera_.verticalFov);
  const glm::dvec3 view((2.0 * x / options.width - 1.0) * tangent * options.width / options.height,
                        (1.0 - 2.0 * y / options.height) * tangent, -1.0);
  return {glm::dvec3(0.0), glm::normalize(glm::transpose(camera_.worldToView) * view)};
}

void RayTracer::tile(const Environment& environment, const TraceOptions& options, int x0, int y0,
                     TraceResult& result) const {
  const int side = gridSize(options.samples);
  for (int y = y0; y < std::min(y0 + tileSize, options.height); ++y) {
    for (int x = x0; x < std::min(x0 + tileSize, options.width); ++x) {
      const size_t i = static_cast<size_t>(y) * options.width + x;
      PathTracer tracer(world_, environment, options, time_,
                        MicrofacetSampler(static_cast<uint32_t>(x), static_cast<uint32_t>(y)));
      glm::dvec3 sum(0.0);
      for (int k = 0; k < options.samples; ++k) {
        const glm::dvec2 at = samplePosition(options, side, k);
        sum += tracer.radiance(cameraRay(options, x + at.x, y + at.y));
      }
      result.image.pixels[i] = glm::vec3(sum / static_cast<double>(options.samples));
      const MirrorChain chain = tracer.followMirrors(cameraRay(options, x + 0.5, y + 0.5));
      result.mirrorDepth[i] = static_cast<uint8_t>(chain.count);
      result.backgroundMask[i] = chain.background;
    }
  }
}

RayTracer::RayTracer(const Scene& scene, const SceneState& state)
    : world_(scene), camera_(state.camera), time_(state.time) {
  world_.place(state);
}

std::optional<TraceResult> RayTracer::render(const TraceOptions& options, const Progress& progress) const {
  check(options);
  const Environment environment = world_.scene().environment.cleared(options.clearColor);
  const size_t pixels = static_cast<size_t>(options.width) * options.height;
  TraceResult result{LinearImage(options.width, options.height), std::vector<uint8_t>(pixels),
                     std::vector<uint8_t>(pixels)};
  const int columns = (options.width + tileSize - 1) / tileSize;
  const int tiles = columns * ((options.height + tileSize - 1) / tileSize);
  std::atomic<bool> cancelled = false;
  std::mutex reporting;
  int done = 0;
  tbb::parallel_for(tbb::blocked_range<int>(0, tiles, 1), [&](const tbb::blocked_range<int>& range) {
    for (int t = range.begin(); t < range.end() && !cancelled; ++t) {
      tile(environment, options, t % columns * tileSize, t / columns * tileSize, result);
      const std::lock_guard lock(reporting);
      ++done;
      if (progress && !cancelled && !progress(static_cast<double>(done) / tiles)) {
        cancelled = true;
      }
    }
  });
  return cancelled ? std::nullopt : std::optional(std::move(result));
}

glm::dvec3 RayTracer::radiance(const TraceOptions& options, const glm::dvec3& origin,
                               const glm::dvec3& direction) const {
  check(options);
  const Environment environment = world_.scene().environment.cleared(options.clearColor);
  PathTracer tracer(world_, environment, options, time_, MicrofacetSampler(0, 0));
  return tracer.radiance({origin - camera_.eye, glm::normalize(direction)});
}

}  // namespace speculum
