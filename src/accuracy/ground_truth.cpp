#include "accuracy/ground_truth.hpp"

#include <tbb/task_arena.h>

#include <chrono>

#include "image/image.hpp"
#include "reference/ray_tracer.hpp"

namespace speculum {

namespace {

constexpr int truthDepth = 64;

// Returns the mask without the pixels at a mirror's border, whose error comes from the main view.
std::vector<uint8_t> interior(const std::vector<uint8_t>& mask, int width, int height) {
  std::vector<uint8_t> inner(mask.size(), 0);
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      bool all = true;
      for (int k = 0; k < 9; ++k) {
        all = all && mask[static_cast<size_t>(y + k / 3 - 1) * width + x + k % 3 - 1] != 0;
      }
      inner[static_cast<size_t>(y) * width + x] = all;
    }
  }
  return inner;
}

}  // namespace

std::optional<GroundTruth> traceGroundTruth(const Scene& scene, const SceneState& state, const TruthRequest& request,
                                            const FractionCallback& progress) {
  const RayTracer tracer(scene, state);
  TraceOptions options{.width = request.width,
                       .height = request.height,
                       .samples = request.samples,
                       .lattice = request.lattice,
                       .maxDepth = truthDepth,
                       .minThroughput = 0.0,
                       .clearColor = request.settings.view.clearColor};
  const double total = request.samples + request.floorSamples;
  const auto start = std::chrono::steady_clock::now();
  std::optional<TraceResult> trace =
      tracer.render(options, [&](double part) { return !progress || progress(part * request.samples / total); });
  if (!trace) {
    return std::nullopt;
  }
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - start;
  GroundTruth truth{.ms = spent.count(), .threads = tbb::this_task_arena::max_concurrency()};
  truth.mirrors = {request.width, request.height, interior(trace->mirrorDepth, request.width, request.height)};
  truth.image = std::move(trace->image);
  if (request.floorSamples == 0) {
    return truth;
  }
  options.samples = request.floorSamples;
  options.lattice = false;
  const std::optional<TraceResult> second = tracer.render(options, [&](double part) {
    return !progress || progress((request.samples + part * request.floorSamples) / total);
  });
  if (!second) {
    return std::nullopt;
  }
  truth.second = toDisplay(second->image, request.settings.view.displayCurve());
  truth.floor = errorsAgainst(truth, truth.second, request.settings);
  return truth;
}

ComparedImage shownTruth(const GroundTruth& truth, const DisplayCurve& curve) {
  return comparedImage(toDisplay(truth.image, curve), "the reference");
}

ErrorFigures errorsAgainst(const GroundTruth& truth, const ComparedImage& shown, const Image8& picture, Plane2d* map,
                           std::vector<glm::dvec3>* perceived) {
  Comparison comparison =
      compareImages(shown, comparedImage(picture), {.mask = &truth.mirrors, .perceived = perceived});
  if (map != nullptr) {
    *map = std::move(comparison.flip);
  }
  return {.whole = comparison.whole, .mirrors = comparison.masked};
}

ErrorFigures errorsAgainst(const GroundTruth& truth, const Image8& picture, const Settings& settings, Plane2d* map) {
  return errorsAgainst(truth, shownTruth(truth, settings.view.displayCurve()), picture, map);
}

}  // namespace speculum
