#pragma once

#include <functional>
#include <optional>

#include "accuracy/compared_image.hpp"
#include "accuracy/sweep_json.hpp"
#include "frame/settings.hpp"
#include "scene/scene_state.hpp"

namespace speculum {

// What every configuration of a sweep is compared with.
struct GroundTruth {
  LinearImage image;   // 8x8 samples a pixel, depth 64, throughput 0
  PixelMask mirrors;   // pixels whose centre, and those of all eight neighbours, show a mirror's reflecting side
  ErrorFigures floor;  // of a 9x9 grid against the 8x8 one, both as the display shows them
  double ms = 0.0;     // wall clock of the 8x8 one
  int threads = 0;
  // By depth d: root mean square over the mirrors' pixels of the throughput that reaches beyond d + 1 mirrors in a row,
  // 0 where none does. Reflections cut at depth d are wrong in proportion to it.
  std::vector<double> throughputBeyond;
};

struct TruthRequest {
  int width = 0;  // pixels
  int height = 0;
  int samples = 64;  // a square; the noise floor takes a grid of one more a side
  bool noiseFloor = true;
  Settings settings;  // exposure, tone curve and clear colour of the pictures compared
};

// Called with the finished fraction, 0 .. 1; false cancels.
using FractionCallback = std::function<bool(double)>;

// Nothing if cancelled.
std::optional<GroundTruth> traceGroundTruth(const Scene& scene, const SceneState& state, const TruthRequest& request,
                                            const FractionCallback& progress);

// Errors of a display picture against the truth shown with the same exposure and tone curve; `map` receives the FLIP
// map.
ErrorFigures errorsAgainst(const GroundTruth& truth, const Image8& picture, const Settings& settings,
                           Plane2d* map = nullptr);

}  // namespace speculum
