#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/ground_truth.hpp"

namespace speculum {

// Where a still picture of the window differs from the ray-traced reference: a heat map of the FLIP error. Tracing and
// comparing happen on other threads; whatever moves starts them anew.
class DifferenceView {
 public:
  ~DifferenceView() { reset(); }

  // What is being looked at. The scene must live until reset() or the next update() with another one.
  struct Look {
    const Scene& scene;
    const SceneState& state;
    const Settings& settings;
    int width = 0;  // pixels
    int height = 0;
  };
  // Once a frame. `picture` gives the display picture of the frame drawn last, and is called when one is to be
  // compared. True when heatMap() has changed.
  bool update(const Look& look, const std::function<Image8()>& picture);
  // Ends all work and forgets everything; true if there was a heat map.
  bool reset();

  // Of the picture as it is now; without pixels until there is one.
  const Image8& heatMap() const { return heatMap_; }
  // For people: what is shown or waited for.
  std::string status() const;

  struct Compared {
    Image8 heatMap;
    ImageMetrics metrics;
  };

 private:
  using Clock = std::chrono::steady_clock;
  void startTracing(const Look& look);
  bool collect();

  std::string view_;   // fingerprint of what the reference depends on
  std::string shown_;  // settings of the picture compared last
  Clock::time_point still_;
  std::atomic<bool> cancelled_ = false;
  std::atomic<double> progress_ = 0.0;  // of the reference being traced, 0 .. 1
  size_t traced_ = 0;                   // references finished
  std::future<std::optional<GroundTruth>> tracing_;
  std::future<Compared> comparing_;
  std::vector<std::future<Compared>> abandoned_;  // of views that are gone; waiting for them would hold up the window
  std::shared_ptr<const GroundTruth> truth_;      // also of comparisons
  Image8 heatMap_;
  ImageMetrics metrics_;
};

}  // namespace speculum
