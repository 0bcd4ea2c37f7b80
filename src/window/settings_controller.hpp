#pragma once

#include "edit/scene_document.hpp"
#include "session/session.hpp"
#include "window/accuracy_controller.hpp"
#include "window/split_view.hpp"

namespace speculum {

// The settings that the window draws with: the scene's or, of A | B, those of each half. Bounds of quality.* choose
// measured points. Each change is a step of the document's undo.
class SettingsController {
 public:
  // Throws what AccuracyController throws.
  SettingsController(const Options& options, const LoadedScene& loaded);
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
  // Begin A | B with the divider at this share of the picture's width.
  void beginSplit(bool naive, double divider);
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
  Settings& edited() { return split_.on() ? split_.settings(split_.chosen()) : ofScene_; }

  Settings ofScene_;
  SplitView split_{shippedLessons()};
  AccuracyController accuracy_;
  SceneDocument* document_ = nullptr;
};

}  // namespace speculum
