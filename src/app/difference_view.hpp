#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "accuracy/ground_truth.hpp"

namespace speculum {

// Where a still picture of the window differs from the ray-traced reference: a heat map of the FLIP error. Tracing and
// comparing happen on other threads; whatever moves starts them anew.
class DifferenceView {
 public:
  ~DifferenceView() { end(); }

  // What is being looked at. The scene must live until end().
  struct Look {
    const Scene& scene;
    const SceneState& state;
    const Settings& settings;
    int width = 0;  // pixels
    int height = 0;
  };
  // Once a frame, after it is drawn. `picture` gives its display picture, and is called when one is to be compared.
  // True when heatMap() has changed.
  bool update(const Look& look, const std::function<Image8()>& picture);
  // Forgets everything without waiting for work that is under way; true if there was a heat map.
  bool reset();
  // Waits for it as well.
  void end();

  // Of the picture as it is now; without pixels until there is one.
  const Image8& heatMap() const { return heatMap_; }
  // Whether update() has more to do although nothing changes.
  bool working() const;
  // For people: what is shown or waited for.
  std::string status() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Control {
    std::atomic<bool> cancelled = false;
    std::atomic<double> progress = 0.0;  // 0 .. 1
  };
  struct Compared {
    std::string settings;
    Image8 heatMap;
    ImageMetrics metrics;
  };
  using Truth = std::shared_ptr<const GroundTruth>;

  void startTracing(const Look& look);
  void startComparing(const Look& look, Image8 picture);
  bool collect();

  std::string view_;   // fingerprint of what the reference depends on
  std::string shown_;  // settings of the picture compared last
  Clock::time_point still_;
  std::shared_ptr<Control> control_;  // of the tracing that runs
  std::future<Truth> tracing_;
  std::future<Compared> comparing_;
  std::vector<std::future<Truth>> abandonedTraces_;  // of views that are gone
  std::vector<std::future<Compared>> abandonedComparisons_;
  size_t traced_ = 0;  // references finished
  Truth truth_;
  Image8 heatMap_;
  ImageMetrics metrics_;
  std::string problem_;  // that ended the work
};

}  // namespace speculum
