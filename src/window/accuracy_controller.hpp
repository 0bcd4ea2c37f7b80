#pragma once

#include <chrono>

#include "accuracy/pareto.hpp"
#include "ui/shown.hpp"
#include "window/difference_map.hpp"
#include "window/motion_levels.hpp"
#include "window/view_sweep.hpp"

namespace speculum {

// A view of the window, and what the user did to it.
struct WatchedState {
  CameraPose camera;
  bool movedCamera = false;  // by the user; else it is the scene's
  double time = 0.0;         // seconds of animation
  int seeks = 0;             // how often the user set the time
  bool paused = false;
  bool animated = false;  // the picture depends on the time
};
// Says whether the user has changed the view since it was measured: the camera, or the time by setting it or by a pause
// elsewhere. Running animation time does not count: otherwise every frame would be another view.
bool isOtherView(const WatchedState& measured, const WatchedState& now);
// Names the step of a measurement, counted on through its parts (a rough one, more rounds of its times, the whole
// picture), and returns the share of all steps that is done.
std::pair<std::string, double> measuringStep(int part, const SweepStatus& status);
// Estimates the seconds until a stage ends of which this fraction took `elapsed` seconds; 0: too early to tell.
double secondsLeft(double elapsed, double fraction);

// Accuracy of the view: measurements, the measured points whose settings can be applied, the budget, the difference
// view.
class AccuracyController {
 public:
  // Begins with the points of --sweep-results, if there are any. `loaded` are the scene's settings, with quality.*
  // applied; `choice` is the reason. Throws InputError for a file that holds no sweep.
  AccuracyController(const Options& options, const Settings& loaded, const std::string& choice);

  void measure(SweepRequest request, const WatchedState& view);
  void cancel();
  void setProblem(const std::string& problem) { shown_.about = problem; }
  void applyPoint(int point, Settings& settings) const;
  // Says what of UiOutput the panels ask for.
  void show(bool points, std::optional<double> errorGain);
  // Call with the settings of a point that the user picked. While they stay, shown() leaves out the mean of still
  // pictures, which hides how points differ.
  void pick(const Settings& settings) { picked_ = settings; }
  Settings shown(Settings settings) const;

  // Call before a frame. Takes finished results; a budget that is set then chooses a point of them.
  void beforeFrame(Settings& settings);
  // Applies the choice of quality.* if that differs from what was applied last.
  void followBudget(Settings& settings);
  // Takes a budget that undo restored together with the settings that it had chosen, without choosing again.
  void acceptBudget(const Settings& settings) { budget_ = budgetOf(settings); }
  // Call after a frame of the view is drawn. `image` returns its pixels; null if its picture is not finished.
  void afterFrame(const ShownPicture& shown, const WatchedState& view, const std::function<Image8()>& image);
  // Returns the picture to show instead of the scene, if it changed since the last call; one without pixels shows the
  // scene.
  std::optional<Image8> takeCover();
  bool working() const;  // afterFrame() has work left although nothing changes
  // Call before the scene changes or goes away, with what to show then instead of points.
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
    int part = 0;                               // as measuringStep() takes it
  };
  BackgroundJob<SweepResults, Status> sweep_;
  std::shared_ptr<const SweepResults> rough_;  // last one shown
  DifferenceMap difference_;
  using Clock = std::chrono::steady_clock;
  Clock::time_point stageBegan_;
  WatchedState requested_;                // of the measurement that runs
  std::optional<WatchedState> measured_;  // of the points; none if they were read from a file
  bool showsPoints_ = false;
  std::optional<double> errorGain_;  // of the difference view; none: it is not shown
  std::optional<Settings> picked_;
  bool coverChanged_ = false;
  SweepResults results_;
  bool isRough_ = false;                                   // results_ are of few pixels and samples
  std::vector<std::vector<SettingChange>> pointSettings_;  // by point, every setting that it depends on
  std::optional<Settings> settings_;                       // settings for which the current point was found
  std::vector<MotionLevel> frontLevels_;
  QualityBudget budget_;    // that was applied last
  bool setByHand_ = false;  // settings, since a budget chose them
};

}  // namespace speculum
