#pragma once

#include "accuracy/sweep.hpp"
#include "app/options.hpp"

namespace speculum {

// A view of the window to be measured.
struct SweepRequest {
  Options options;  // scene, size, device
  Settings base;
  CameraPose camera;
  double time = 0.0;  // seconds of animation
};

// Measures a view with a scene and a device of its own; may run on any thread. The window uses the same GPU meanwhile,
// which its times include. The result has no points if `progress` returned false. Throws what loading and measuring
// throw.
SweepResults measureView(const SweepRequest& request, const SweepProgress& progress);

// The same of a picture of few pixels against few samples, within seconds. Its times are enlarged to those of the whole
// picture by what one configuration takes in both sizes.
SweepResults measureRoughly(const SweepRequest& request, const SweepProgress& progress);

}  // namespace speculum
