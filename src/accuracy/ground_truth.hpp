#pragma once

#include <functional>
#include <optional>

#include "compare/compared_image.hpp"
#include "compare/image_metrics.hpp"
#include "scene/scene_state.hpp"
#include "settings/settings.hpp"

namespace speculum {

// Traced picture that every configuration of a sweep is compared with.
struct GroundTruth {
  LinearImage image;   // TruthRequest::samples a pixel, depth 64, throughput 0
  PixelMask mirrors;   // pixels whose centre, and those of all eight neighbours, show a mirror's reflecting side
  ErrorFigures floor;  // error of `second` against `image`, both as the display shows them
  Image8 second;       // a grid of TruthRequest::floorSamples, as the display shows it; empty without a noise floor
  double ms = 0.0;     // wall clock time of tracing `image`
  int threads = 0;
};

struct TruthRequest {
  int width = 0;  // pixels
  int height = 0;
  int samples = 256;       // a square; on a grid of 16x16
  bool lattice = false;    // TraceOptions::lattice. A mean of pictures has the 8x8 grid, so a reference must not
  int floorSamples = 225;  // a square; 0: no noise floor
  Settings settings;       // exposure, tone curve and clear color of the pictures compared
};

// Called with the finished fraction, 0 .. 1; false cancels.
using FractionCallback = std::function<bool(double)>;

// Traces the ground truth. Returns nothing if `progress` cancelled. Blocks; may run on any thread.
std::optional<GroundTruth> traceGroundTruth(const Scene& scene, const SceneState& state, const TruthRequest& request,
                                            const FractionCallback& progress);

// Returns the truth as the display shows it under exposure and tone curve.
ComparedImage shownTruth(const GroundTruth& truth, const DisplayCurve& curve);
// Compares a display picture with the truth under the same curve; `map` receives the FLIP map, `perceived` what
// flipMap() perceives. `shown` is shownTruth(), which several pictures can share.
ErrorFigures errorsAgainst(const GroundTruth& truth, const ComparedImage& shown, const Image8& picture,
                           Plane2d* map = nullptr, std::vector<glm::dvec3>* perceived = nullptr);
ErrorFigures errorsAgainst(const GroundTruth& truth, const Image8& picture, const Settings& settings,
                           Plane2d* map = nullptr);

}  // namespace speculum
