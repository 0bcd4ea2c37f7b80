#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/ground_truth.hpp"
#include "edit/scene_document.hpp"
#include "session/lesson.hpp"
#include "session/session.hpp"
#include "ui/shown.hpp"
#include "window/accuracy_controller.hpp"
#include "window/background_job.hpp"
#include "window/status_line.hpp"

namespace speculum {

// Returns the settings with the quality of most mirror demos: one small image for each mirror, nothing in it
// reflects, one sample a pixel, maps in the place of rays.
Settings naiveSettings(const Settings& settings);

// Frame of one half of A | B, as it was drawn.
struct HalfFrame {
  int half = 0;      // 0 is A, on the left, 1 is B
  double gpuMs = 0;  // of the half's last picture of the scene
  int pictures = 1;  // in the half's mean
  std::string text;  // what the picture gives up, or how far it has converged
  // Number of the still picture that the frame completed, or shows again; none while it is not complete.
  std::optional<uint64_t> still;
};

// A | B: the window's view with two sets of settings, side by side. Both are trials: the scene keeps its own settings.
// Compares the halves' still pictures on another thread, with the reference if there is one, else with each other.
class SplitView {
 public:
  using Truth = std::shared_ptr<const GroundTruth>;

  explicit SplitView(std::vector<Lesson> lessons);

  // Begin to show two sets of settings, and choose B. `divider`: share of the picture's width to the left of it.
  void begin(const Settings& a, const Settings& b, double divider);
  void beginLesson(size_t lesson, const Settings& ofScene, double divider);
  void end();
  bool on() const { return shown_.on; }

  void choose(int half) { shown_.chosen = half; }  // the panels edit its settings
  int chosen() const { return shown_.chosen; }
  void moveDivider(double share);
  double divider() const { return shown_.divider; }
  int halfAt(double share) const { return share < shown_.divider ? 0 : 1; }  // share of the picture's width
  Settings& settings(int half) { return settings_[static_cast<size_t>(half)]; }
  const Settings& settings(int half) const { return settings_[static_cast<size_t>(half)]; }
  const std::vector<Lesson>& lessons() const { return lessons_; }

  // Call before a frame: takes finished comparisons and describes both halves.
  void update();
  // Call after each frame of a half. `picture` returns the pixels of a half's picture (display sRGB), and `drawn` the
  // settings that it was drawn with; both are called only to compare. `truth` is the reference of the view, or null.
  void frameDrawn(const HalfFrame& frame, const Truth& truth, const std::function<Image8(int half)>& picture,
                  const std::function<Settings(int half)>& drawn);
  void forgetPictures() { still_ = {}; }              // call when what drew the halves is gone
  bool working() const { return comparing_.busy(); }  // update() has work left although nothing changes
  const ShownSplit& shown() const { return shown_; }

 private:
  using Compared = std::pair<std::array<std::optional<uint64_t>, 2>, Truth>;

  std::vector<Lesson> lessons_;
  std::array<Settings, 2> settings_;
  std::array<std::optional<uint64_t>, 2> still_;  // HalfFrame::still of both
  std::optional<Compared> compared_;              // pictures and reference of the last comparison
  BackgroundJob<std::array<double, 2>> comparing_;
  ShownSplit shown_;
};

// The settings that the window draws with: the scene's or, of A | B, those of each half. Bounds of quality.* choose
// measured points. Each change is a step of the document's undo.
class SettingsController {
 public:
  // Throws what AccuracyController throws. The status line, which tells which half is edited, must outlive this object.
  SettingsController(const Options& options, const LoadedScene& loaded, StatusLine& status);
  // Call when another scene is shown. `loaded`: the settings that it was loaded with. The document must outlive this
  // object, or the next call.
  void setDocument(SceneDocument& document, const Settings& loaded);

  const Settings& ofScene() const { return ofScene_; }  // also during A | B
  // Settings that the panels show: the scene's or, of A | B, those of the chosen half.
  const Settings& chosen() const { return split_.on() ? split_.settings(split_.chosen()) : ofScene_; }
  // Settings with which the picture, or a half of A | B, is drawn.
  Settings shown(int half) const { return split_.on() ? split_.settings(half) : accuracy_.shown(ofScene_); }
  int shownHalf() const { return split_.on() ? split_.chosen() : 0; }  // whose figures the panels show

  void set(const Settings& settings, bool continued = false);  // the chosen ones; `continued` as of SetSettings
  void applyPoint(int point);
  // Begin A | B with the divider at this share of the picture's width. If it is on, toggleSplit() ends it first, and
  // begins it anew unless `start` is SplitStart::current. Returns whether it began.
  bool toggleSplit(SplitStart start, double divider);
  void beginLesson(size_t index, const Settings& loaded, double divider);
  void chooseHalf(int half);
  void keepHalf();  // ends A | B with the chosen half's settings
  void endSplit();
  // Follows a step of undo, or of redo unless `back`. Returns true if A | B hides the change.
  bool follow(const std::optional<SettingsStep>& step, bool back);
  void update();  // once a frame: takes finished comparisons and measurements

  SplitView& split() { return split_; }
  const SplitView& split() const { return split_; }
  AccuracyController& accuracy() { return accuracy_; }
  const AccuracyController& accuracy() const { return accuracy_; }

 private:
  void startEditing();   // call once A | B has begun: keeps the scene's pick, and edits the chosen half
  void edit(int half);   // lets the panels change this half, and drops a point that was picked for the other
  void setHalfStatus();  // says in the status line which half is edited
  Settings& edited() { return split_.on() ? split_.settings(split_.chosen()) : ofScene_; }

  Settings ofScene_;
  SplitView split_{shippedLessons()};
  AccuracyController accuracy_;
  AccuracyController::Pick pickOfScene_;  // during A | B, whose halves have picks of their own
  StatusLine& status_;
  SceneDocument* document_ = nullptr;
};

}  // namespace speculum
