#pragma once

#include <chrono>
#include <map>
#include <tuple>

#include "accuracy/pareto.hpp"
#include "accuracy/sweep.hpp"
#include "session/session.hpp"
#include "ui/shown.hpp"
#include "window/difference_map.hpp"
#include "window/motion_controller.hpp"

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

// The camera and the animation time of the window, and what the user did to both.
struct WatchedState {
  CameraPose camera;
  bool movedCamera = false;  // the user moved the camera; false: it is the scene's
  double time = 0.0;         // seconds of animation
  int seeks = 0;             // how often the user set the time
  bool paused = false;
  bool animated = false;  // the picture depends on the time
};
// Says whether the user has changed the view since it was measured: moved the camera, set another time, or paused at
// another time. Running animation time does not count: otherwise every frame would be another view.
bool isOtherView(const WatchedState& measured, const WatchedState& now);
// Returns the name of a measurement's step, for the user, and the share of all steps that is done, 0 .. 1. Steps are
// counted through the parts of a measurement: 0 a rough one, 1 more rounds of its times, 2 the whole picture.
std::pair<std::string, double> measuringStep(int part, const SweepStatus& status);
// Estimates the seconds until a stage ends of which the share `fraction` (0 .. 1) took `elapsed` seconds; 0: too early
// to tell.
double secondsLeft(double elapsed, double fraction);

// Accuracy of the window's view: runs measurements, applies the settings of measured points, follows the budget of
// quality.*, and shows the difference map over the picture.
class AccuracyController {
 public:
  // Begins with the points of --sweep-results, if there are any. `loaded` are the scene's settings after the choice of
  // a point by quality.*, `choice` says why that point was chosen. Throws InputError for a file that holds no sweep.
  AccuracyController(const Options& options, const Settings& loaded, const std::string& choice);

  // Starts a measurement in the background, and cancels one that runs. `view`: the state that is measured.
  void measure(SweepRequest request, const WatchedState& view);
  void cancel();  // points of a rough measurement stay
  void setProblem(const std::string& problem) { shown_.about = problem; }
  // Sets `settings` to those of a measured point. Does nothing for an index that no point has.
  void applyPoint(int point, Settings& settings) const;
  // Call once a frame with UiOutput::points and UiOutput::errorGain.
  void show(bool points, std::optional<double> errorGain);
  // Call with the settings of a point that the user picked. While these are in use, shown() returns them without the
  // mean of still pictures, which hides how points differ.
  void pick(const Settings& before, const Settings& settings) {
    setPick({picked_ == before ? shown_.own : before, settings});
  }
  struct Pick {
    std::optional<Settings> own;     // as in ShownAccuracy
    std::optional<Settings> picked;  // of the point; none: no point was picked
  };
  Pick pick() const { return {shown_.own, picked_}; }
  void setPick(const Pick& pick) { std::tie(shown_.own, picked_) = std::tie(pick.own, pick.picked); }
  Settings shown(Settings settings) const;

  // Call before a frame. Takes finished results; if `settings` have a budget, it then chooses a point of them, which is
  // applied to `settings`.
  void beforeFrame(Settings& settings);
  // Applies the point that the bounds of quality.* choose, if these bounds differ from those that were applied last.
  void followBudget(Settings& settings);
  // Takes the budget of `settings` without choosing a point: undo restored it together with the settings that it had
  // chosen.
  void acceptBudget(const Settings& settings) { budget_ = budgetOf(settings); }
  // Call after a frame of the view is drawn. `image` returns the pixels of its picture (display sRGB); it is null if
  // the picture is not finished.
  void afterFrame(const ShownPicture& shown, const WatchedState& view, const std::function<Image8()>& image);
  // Returns the heat map to show instead of the scene, if it changed since the last call. A picture without pixels
  // shows the scene again.
  std::optional<Image8> takeCover();
  bool working() const;  // afterFrame() has work left although nothing changes
  // Shows the heat map again: call when another picture takes the place of the one that it was made for.
  void showAgain() { coverChanged_ = coverChanged_ || difference_.map().width > 0; }
  // Reference of the view that is shown, as far as the difference map has traced one; null without it.
  std::shared_ptr<const GroundTruth> reference() const { return difference_.reference(); }
  // Call before the scene changes or goes away. Drops the points and the heat map, cancels a measurement, and waits for
  // the threads that read the scene. The panel shows `why`, the first words of a sentence, instead of the points.
  void forgetScene(const std::string& why = "The scene was changed");

  const ShownAccuracy& shown() const { return shown_; }
  // The measured front, most accurate first; empty before a measurement.
  const std::vector<MotionLevel>& front() const { return frontLevels_; }

 private:
  void setResults(SweepResults results, bool rough = false);
  void takeResults();
  void findCurrentPoint(const Settings& settings);
  void setChoice(const std::string& text = {}, bool misses = false);

  ShownAccuracy shown_;
  struct Status : SweepStatus {
    std::shared_ptr<const SweepResults> rough;  // null until it is measured
    int part = 0;                               // of the measurement, see measuringStep()
  };
  BackgroundJob<SweepResults, Status> sweep_;
  std::shared_ptr<const SweepResults> rough_;  // rough measurement that was shown last
  DifferenceMap difference_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point stageBegan_;
  WatchedState requested_;                // state that the running measurement measures
  std::optional<WatchedState> measured_;  // state that the points were measured in; none: they were read from a file
  bool showsPoints_ = false;
  std::optional<double> errorGain_;  // of the difference map; none: the map is not shown
  std::optional<Settings> picked_;
  bool coverChanged_ = false;
  SweepResults results_;
  bool isRough_ = false;                                   // results_ are of few pixels and samples
  std::vector<std::vector<SettingChange>> pointSettings_;  // by point: every setting that its figures depend on
  std::optional<Settings> settings_;                       // settings for which the current point was found
  std::vector<MotionLevel> frontLevels_;
  QualityBudget budget_;    // applied last
  bool setByHand_ = false;  // the user changed settings since a budget chose them
};

}  // namespace speculum
