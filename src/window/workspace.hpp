#pragma once

#include "window/accuracy_controller.hpp"
#include "window/capture.hpp"
#include "window/frame_report.hpp"
#include "window/pointer_controller.hpp"
#include "window/scene_opener.hpp"
#include "window/split_view.hpp"
#include "window/status_line.hpp"

namespace speculum {

// The time of the animation.
class Playback {
 public:
  void seek(double seconds) {
    shown_.time = std::max(0.0, seconds);
    ++seeks_;
  }
  void step(int steps) {
    shown_.paused = true;
    seek(shown_.time + steps * timeStep);
  }
  void setPaused(bool paused) { shown_.paused = paused; }
  void setCost(const std::string& cost) { shown_.cost = cost; }
  void setSpeed(double speed) { shown_.speed = std::clamp(speed, slowestTime, fastestTime); }
  double after(double seconds) const { return shown_.time + (shown_.paused ? 0.0 : seconds * shown_.speed); }
  void advance(double seconds) { shown_.time = after(seconds); }
  const ShownPlayback& shown() const { return shown_; }
  int seeks() const { return seeks_; }  // how often the time was set

 private:
  ShownPlayback shown_;
  int seeks_ = 0;
};

// The part of the window that a workspace uses.
class WorkspaceHost {
 public:
  virtual ~WorkspaceHost() = default;

  // Shows this scene from now on, or the same one with other models. If useScene() throws, it is called again with the
  // old scene.
  virtual void useScene(const Scene& scene) = 0;
  virtual void dropCachedImages() = 0;
  virtual void scenesListed() = 0;             // the list of scenes has changed
  virtual glm::ivec2 pictureSize() const = 0;  // pixels; 0 while the window has none
  virtual PixelRect freePicture() const = 0;   // part of the picture that no panel covers
  virtual double contentScale() const = 0;     // pixels for one at 96 dots an inch
  virtual std::string gpu() const = 0;         // value of --gpu
  virtual void setClipboard(const std::string& text) = 0;
  virtual void setTitle(const std::string& title) = 0;
  virtual void close() = 0;
  virtual void toggleFullScreen() = 0;
  virtual void setPresentMode(size_t index) = 0;
  virtual bool togglePanels() = 0;  // returns whether they are shown then
  virtual void toggleHelp() = 0;
  virtual void toggleInspector() = 0;
  virtual void openInspector() = 0;
  // Says whether the inspector is closed and would open over `place`, in screen coordinates of the window.
  virtual bool inspectorCovers(const glm::dvec2& place) const = 0;
  // Closes an open menu or the list of keys. Returns false if neither is open.
  virtual bool closePopup() = 0;
};

// The scene that is shown and everything that users do with it: each action comes here as a command, from panels, keys,
// gamepad and tests. Depends on neither a window nor a GPU.
class Workspace {
 public:
  // Loads the scene of the options. The host must outlive the workspace, and is not called before the first command.
  // Throws UsageError and InputError.
  Workspace(const Options& options, WorkspaceHost& host);

  void apply(const Command& command);

  // Handle the pointer, in screen coordinates of the window. `overPanels` says that the event belongs to the panels.
  void pointerButton(const MouseButtonEvent& event, bool overPanels);
  void pointerMoved(const glm::dvec2& position, const glm::dvec2& windowSize, bool snap);
  void scrolled(double notches) { camera_.zoom(notches); }

  // The stages of a frame, in this order. `seconds` since the last frame.
  double frameSeconds(double seconds) const;  // animation time of the frame: fixed while frames are recorded
  void moveCamera(const glm::dvec3& direction, const GamepadState& pad, double seconds) {
    camera_.move(direction, pad, seconds);
  }
  // Prepares what shown() returns for the frame that is `seconds` from now. With `pointerOverPicture` the handle below
  // the pointer lights up.
  void prepareView(double seconds, bool pointerOverPicture);
  UiInput shown(const ShownDevice& device, const std::string& message) const;
  void update();  // after the frame's commands: takes finished background work
  void advance(double seconds) { playback_.advance(seconds); }
  // Says whether the next frameDrawn() reads `radiance` for the scene's thumbnail.
  bool needsThumbnail() const { return needsThumbnail_ && options_.frames == 0; }
  // Call when the frame is drawn. `radiance` returns the pixels of its picture, without panels (display sRGB); it is
  // null if the picture is not complete, or encoded. `captured`: the frame as read back for Capture; null if none is
  // wanted. `half`: of A | B, that the frame drew.
  void frameDrawn(const ShownPicture& shown, const std::function<Image8()>& radiance, const Image8* captured,
                  int half = 0);

  // Say whether frames are needed although nothing happens.
  bool animates() const { return !playback_.shown().paused && animated(); }
  bool working() const { return accuracy_.working() || opener_.working() || split_.working(); }
  uint64_t revision() const { return document_->revision(); }
  bool dragging() const { return editor_->dragging(); }
  bool statusFades() const { return status_.fades(); }

  // Call after a frame that could not be drawn: undoes the last step and shows why. Returns false if there is no step.
  // If undoing did not help in the last frame, redoes the step and returns false.
  bool undoFailedChange(const std::string& why);
  // Call in every step, also without a frame: keeps unsaved changes in a copy that the next start offers.
  void keepChanges(SceneOpener::Clock::time_point now) noexcept { opener_.keepChanges(now); }
  // Before the program ends without a prompt: keeps unsaved changes in a copy, logs where, and makes the next start
  // offer it.
  void keepUnsavedWork() noexcept { opener_.keepUnsavedWork(); }

  const Scene& scene() const { return loaded_->scene; }
  // Settings that the panels show: the scene's or, of A | B, those of the chosen half.
  const Settings& settings() const { return split_.on() ? split_.settings(split_.chosen()) : settings_; }
  // Settings with which the picture, or a half of A | B, is drawn.
  Settings shownSettings(int half = 0) const {
    return split_.on() ? split_.settings(half) : accuracy_.shown(settings_);
  }
  SplitView& split() { return split_; }
  const SplitView& split() const { return split_; }
  double time() const { return playback_.shown().time; }
  SceneState state(double time);  // with the camera of the window
  WatchedState watchedState(const SceneState& shown) const;
  const std::string& problem() const { return opener_.problem(); }
  AccuracyController& accuracy() { return accuracy_; }
  SceneBrowser& browser() { return opener_.browser(); }
  const Capture& capture() const { return capture_; }
  void setPictureText(const std::string& text) { status_.setPicture(text); }
  void setPlayCost(const std::string& cost) { playback_.setCost(animated() ? cost : ""); }
  void setRefusedEdit(bool refused) { saving_->setRefusedEdit(refused); }  // as in DocumentController
  FrameReport& report(int half) { return reports_[static_cast<size_t>(half)]; }
  FrameReport& report() { return report(shownHalf()); }
  int shownHalf() const { return split_.on() ? split_.chosen() : 0; }  // whose figures the panels show
  const PointerController& pointer() const { return pointer_; }
  bool prompting() const { return saving_->prompting(); }
  const SceneDocument& document() const { return *document_; }
  const DocumentController& saving() const { return *saving_; }

  // Call if the program has paused the animation of the scene that leaves: the next scene plays again.
  void releasePause() { pausedForUser_ = true; }

 private:
  void pause(bool paused);
  void showScene(std::unique_ptr<LoadedScene> scene);
  void startDocument();
  void addNode(void (SceneEditor::*add)(const PointedScene&));
  void addObject(const std::filesystem::path& model);
  void reportAdded();  // shows that the selected node was added
  void useModels();
  void resume(const std::optional<Command>& afterPrompt);
  void escape();
  void dismissMessage();
  void setSettings(const Settings& settings, bool continued = false);
  Settings& panelSettings() { return split_.on() ? split_.settings(split_.chosen()) : settings_; }
  void toggleSplit(bool naive);
  void chooseHalf(int half);
  void keepHalf();
  void endSplit();
  void beginLesson(size_t index);
  double middleOfFreePicture() const;  // share of the picture's width
  void step(UndoWay way);
  void copyCommandLine();
  void measureAccuracy();
  void frame(const Selection& node);  // none: the whole scene
  void lookFromMirror(MirrorSide side);
  void takeSceneChange();
  bool animated() const { return camera_.moved() ? contentMoves(scene()) : moves(scene()); }
  std::optional<PointedScene> pointedScene(double time);
  Options shownOptions(const std::filesystem::path& file);
  double aspect() const;

  Options options_;
  WorkspaceHost& host_;
  LogHistory log_;
  std::shared_ptr<void> logCapture_;
  std::unique_ptr<LoadedScene> loaded_;
  std::vector<std::filesystem::path> shippedModels_;
  std::unique_ptr<SceneDocument> document_;  // of loaded_
  std::unique_ptr<SceneEditor> editor_;
  std::unique_ptr<DocumentController> saving_;
  SceneOpener opener_;
  AccuracyController accuracy_;
  CameraController camera_;
  PointerController pointer_;
  Playback playback_;
  Capture capture_;
  StatusLine status_;
  bool pausedForUser_ = false;          // the program paused the animation, not the user: the next scene plays again
  std::array<FrameReport, 2> reports_;  // of the picture or, of A | B, of both halves
  SplitView split_{shippedLessons()};
  Settings settings_;
  ShownEdit edit_;
  std::string title_;            // of the window
  uint64_t shownStructure_ = 0;  // structureRevision() of the scene in the last frame
  bool tookBack_ = false;        // undoFailedChange() undid a step, and no frame was drawn since
  bool needsThumbnail_ = true;   // the scene was opened or saved since the last picture
};

}  // namespace speculum
