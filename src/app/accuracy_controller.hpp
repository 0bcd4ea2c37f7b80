#pragma once

#include <string>

#include "accuracy/pareto.hpp"
#include "app/difference_view.hpp"
#include "app/view_sweep.hpp"
#include "systems/scene_renderer.hpp"
#include "ui/ui_model.hpp"

namespace speculum {

// What is behind the accuracy panel: measurements of the view, the points that settings are taken from, the budget, the
// difference view.
class AccuracyController {
 public:
  // Begins with the points of --sweep-results, if there are any, of which `settings` are one already if they have
  // bounds. Throws InputError for a file that is none.
  AccuracyController(const Options& options, const Settings& settings, UiModel& model);

  // After the panel was laid out and before the frame is drawn: does what the person asked for. `view` gives what a
  // measurement would measure.
  void apply(UiModel& model, const std::function<SweepRequest()>& view);
  // After the frame is drawn: fills the panel's figures and keeps the renderer's cover up to date.
  void update(UiModel& model, const ShownPicture& shown, SceneRenderer& sceneRenderer);
  // Whether update() has more to show although nothing changes.
  bool working(const UiModel& model) const;
  // Before the scene goes away.
  void forgetScene(UiModel& model);

 private:
  void showResults(UiModel& model);
  void applyBudget(UiModel& model);
  void findCurrentPoint(UiModel& model);

  BackgroundJob<SweepResults, SweepStatus> sweep_;
  DifferenceView difference_;
  SweepResults results_;
  std::vector<std::vector<SettingChange>> pointSettings_;  // by point, every setting that it depends on
  std::string settings_;                                   // that the current point was looked for with
  int chosen_ = -1;                                        // point of the budget's choice that is shown
  QualityBudget budget_;                                   // that was applied last
};

}  // namespace speculum
