#pragma once

#include "accuracy/sweep.hpp"
#include "app/session.hpp"

namespace speculum {

// A view of the window to be measured.
struct SweepRequest {
  Options options;  // scene, size, device
  Settings base;
  CameraPose camera;
  double time = 0.0;  // seconds of animation
};

// Measures a view, with a scene and a device of its own; may run on any thread. The window uses the same GPU meanwhile,
// which its times include. Results have no points if `progress` returned false.
class ViewMeasurement {
 public:
  // Loads the scene, and throws what loading throws.
  explicit ViewMeasurement(const SweepRequest& request);

  // Measures a picture of few pixels against few samples, within seconds. Its times are enlarged to those of the whole
  // picture by what one configuration takes in both sizes.
  SweepResults rough(const SweepProgress& progress);
  SweepResults whole(const SweepProgress& progress);

 private:
  SweepResults measure(PictureSize size, int samples, const SweepProgress& progress);
  double baseMs(PictureSize size);

  SweepRequest request_;
  Settings base_;
  Session session_;
};

}  // namespace speculum
