#pragma once

#include <map>

#include "accuracy/sweep.hpp"
#include "session/session.hpp"

namespace speculum {

// A view of the window to be measured.
struct SweepRequest {
  Options options;  // scene, size, time, device
  Settings base;
  CameraPose camera;
};

// Milliseconds of one configuration in two sizes of the picture.
struct SizedMs {
  double small = 0.0;
  double whole = 0.0;
};

// Measures a view, with a scene and a device of its own; may run on any thread. The window uses the same GPU meanwhile,
// and the measured times include that. Results have no points if `progress` returned false.
class ViewMeasurement {
 public:
  // Loads the scene, and throws what loading throws.
  explicit ViewMeasurement(const SweepRequest& request);

  // Measures a picture of few pixels against few samples, within seconds, and times each configuration `rounds` times;
  // a further call measures only the missing rounds. The whole picture's times are extrapolated from two
  // configurations that are timed in both sizes.
  SweepResults rough(int rounds, const SweepProgress& progress);
  SweepResults whole(const SweepProgress& progress);

 private:
  struct Effort {
    int samples = 0;  // samples a pixel of the reference
    int rounds = SweepPlan::leastRepeats;
    int floorSamples = 0;  // of its noise floor; 0: none
  };
  SweepResults measure(PictureSize size, const Effort& effort, const SweepProgress& progress);
  // Returns what a point takes in both sizes, timed one after the other.
  SizedMs sizedMs(const SweepPoint& point, PictureSize small);

  SweepRequest request_;
  Settings base_;
  Session session_;
  std::map<std::string, SizedMs> sizedMs_;  // by the point's name
};

// Replaces times of a small picture by those expected of the whole one, along a line through the configurations `base`
// and `fastest`, since parts of a frame, such as shadow maps, do not depend on its size. If both take about equally
// long, all times grow in proportion to `base`. The line's slope is kept between that proportion and `pixels`, the
// ratio of both sizes' pixels.
void enlargeTimes(SweepResults& results, const SizedMs& base, const SizedMs& fastest, double pixels);

}  // namespace speculum
