#pragma once

#include <chrono>

#include "accuracy/ground_truth.hpp"
#include "window/background_job.hpp"

namespace speculum {

// A picture of the window and everything that it depends on. The scene must live until DifferenceMap::stop().
struct ShownPicture {
  const Scene& scene;
  const SceneState& state;
  const Settings& settings;
  int width = 0;  // pixels
  int height = 0;
  int pictures = 1;      // in the mean that is shown, of settings.view.accumulate
  bool complete = true;  // the mean gets no further picture: it may have converged before
};

// Heat map of the FLIP error of a still picture of the window against the ray-traced reference. Tracing and comparing
// run on other threads; any motion restarts them. A mean of pictures is compared again once it is complete.
class DifferenceMap {
 public:
  // Call once a frame, after it is drawn. `image` returns the pixels of its picture (display sRGB) and is called only
  // when they are needed. `samples`: samples a pixel of the finest reference. Returns true when map() has changed.
  bool update(const ShownPicture& shown, const std::function<Image8()>& image, int samples);
  // Drops everything without waiting for running work. Returns true if there was a heat map.
  bool reset();
  void stop();  // as reset(), but waits for running work

  const Plane2d& map() const { return result_.map; }  // FLIP error by pixel; without pixels until there is a result
  const std::shared_ptr<const GroundTruth>& reference() const { return truth_; }  // of the view; null: not traced yet
  // By mirror: the mean error within its outline, NaN if the eye does not see it; empty without map().
  const std::vector<double>& mirrorErrors() const { return result_.mirrorErrors; }
  bool working() const;        // update() has work left although nothing changes
  std::string status() const;  // text for the user: the error, or the work that is running

 private:
  using Clock = std::chrono::steady_clock;
  struct Compared {
    int pictures = 1;  // in the mean that was compared
    int wanted = 1;    // in the mean at most; `pictures` if it was complete
    Plane2d map;
    ImageMetrics metrics;
    std::vector<double> mirrorErrors;
  };
  using Truth = std::shared_ptr<const GroundTruth>;
  // Everything that the reference depends on.
  struct View {
    std::filesystem::path file;
    int samples = 0;
    int width = 0;
    int height = 0;
    std::optional<double> time;  // of a scene that moves
    CameraPose camera;
    std::optional<glm::dvec3> clearColor;

    bool operator==(const View&) const = default;
  };

  void startTracing(const ShownPicture& shown);
  void startComparing(const ShownPicture& shown, Image8 image);
  bool collect();
  bool lacksReference() const;

  std::optional<View> view_;
  bool plays_ = false;                                 // the last change of the view was one of the time
  std::optional<std::pair<Settings, bool>> compared_;  // of the picture compared last; whether its mean was complete
  Clock::time_point still_;                            // since when the view has not changed
  BackgroundJob<Truth> tracing_;
  BackgroundJob<Compared> comparing_;
  size_t traced_ = 0;  // number of references that are finished
  Truth truth_;
  Compared result_;
  std::string problem_;  // error that ended the work
};

}  // namespace speculum
