#pragma once

#include <functional>
#include <string>

#include "ui/shown.hpp"
#include "window/camera_controller.hpp"
#include "window/capture.hpp"
#include "window/frame_report.hpp"
#include "window/scene_editor.hpp"
#include "window/scene_opener.hpp"
#include "window/settings_controller.hpp"
#include "window/status_line.hpp"

namespace speculum {

// The part of the window that a workspace uses.
class WorkspaceHost {
 public:
  virtual ~WorkspaceHost() = default;

  // Shows this scene from now on, or the same one with other models. If useScene() throws, it is called again with the
  // old scene.
  virtual void useScene(const Scene& scene) = 0;
  virtual void dropCachedImages() = 0;
  virtual glm::ivec2 pictureSize() const = 0;  // pixels; 0 while the window has none
  virtual PixelRect freePicture() const = 0;   // part of the picture that no panel covers
  virtual double contentScale() const = 0;     // pixels for one at 96 dots an inch
  virtual std::string gpu() const = 0;         // value of --gpu
  virtual void setClipboard(const std::string& text) = 0;
  virtual void setTitle(const std::string& title) = 0;
  virtual void close() = 0;
  virtual void toggleFullScreen() = 0;
  virtual void setPresentMode(size_t index) = 0;
  virtual void togglePanels() = 0;
  virtual bool showsPanels() const = 0;
  virtual void closeSidePanels() = 0;  // those at the right
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

  // The stages of a frame, in this order. `seconds` since the last frame.
  double frameSeconds(double seconds) const;  // animation time of the frame: fixed while frames are recorded
  // Prepares what shown() returns for the frame that is `seconds` from now. With `pointerOverPicture` the handle below
  // the pointer lights up.
  void prepareView(double seconds, bool pointerOverPicture);
  UiInput shown(const ShownDevice& device, const std::string& message) const;
  void update();  // after the frame's commands: takes finished background work
  // Says whether the next frameDrawn() reads `radiance` for the scene's thumbnail.
  bool needsThumbnail() const { return needsThumbnail_ && options_.frames == 0; }
  // Call when the frame is drawn. `radiance` returns the pixels of its picture, without panels (display sRGB); it is
  // null if the picture is not complete, or encoded. `captured`: the frame as read back for Capture; null if none is
  // wanted. `half`: of A | B, that the frame drew.
  void frameDrawn(const ShownPicture& shown, const std::function<Image8()>& radiance, const Image8* captured,
                  int half = 0);

  // Say whether frames are needed although nothing happens.
  bool animates() const { return !view_.playback.shown().paused && animated(); }
  bool working() const { return accuracy().working() || opener_.working() || split().working(); }
  uint64_t pictureRevision() const { return document_->pictureRevision(); }
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
  const Settings& settings() const { return settings_.chosen(); }
  Settings shownSettings(int half = 0) const { return settings_.shown(half); }
  int shownHalf() const { return settings_.shownHalf(); }
  SplitView& split() { return settings_.split(); }
  const SplitView& split() const { return settings_.split(); }
  AccuracyController& accuracy() { return settings_.accuracy(); }
  const AccuracyController& accuracy() const { return settings_.accuracy(); }
  ViewController& view() { return view_; }
  double time() const { return view_.time(); }
  SceneState state(double time) { return view_.state(scene(), time); }
  WatchedState watchedState(const SceneState& shown) const { return view_.watchedState(scene(), shown); }
  const std::string& problem() const { return opener_.problem(); }
  SceneBrowser& browser() { return opener_.browser(); }
  const Capture& capture() const { return capture_; }
  // Says how the picture is drawn, and how far it is in the words of Pace::progress().
  void setPictureText(const std::string& text, const std::string& progress = {}) {
    status_.setPicture(text);
    progress_ = progress;
  }
  void setPlayCost(const std::string& cost) { view_.playback.setCost(animated() ? cost : ""); }
  void setRefusedEdit(bool refused) { saving_->setRefusedEdit(refused); }  // as in DocumentController
  FrameReport& report(int half) { return reports_[static_cast<size_t>(half)]; }
  FrameReport& report() { return report(shownHalf()); }
  const PointerController& pointer() const { return pointer_; }
  bool prompting() const { return saving_->prompting(); }
  const SceneDocument& document() const { return *document_; }
  const DocumentController& saving() const { return *saving_; }

 private:
  void showScene(std::unique_ptr<LoadedScene> scene);
  void startDocument();
  void addNode(void (SceneEditor::*add)(const PointedScene&));
  void addObject(const std::filesystem::path& model);
  void reportAdded();  // shows that the selected node was added
  void useModels();
  void resume(const std::optional<Command>& afterPrompt);
  void escape();
  void dismissMessage();
  void toggleSplit(SplitStart start);
  void beginLesson(size_t index);
  double middleOfFreePicture() const;  // share of the picture's width
  void step(UndoWay way);
  void copyCommandLine();
  void measureAccuracy();
  void frame(const Selection& node);  // none: the whole scene
  void takeSceneChange();
  bool animated() const { return view_.animated(scene()); }
  std::optional<PointedScene> pointedScene(double time);
  Options shownOptions(const std::filesystem::path& file);

  Options options_;
  WorkspaceHost& host_;
  LogHistory log_;
  std::shared_ptr<void> logCapture_;
  std::unique_ptr<LoadedScene> loaded_;
  std::vector<std::filesystem::path> shippedModels_;
  std::unique_ptr<SceneDocument> document_;  // of loaded_
  std::unique_ptr<SceneEditor> editor_;
  std::unique_ptr<DocumentController> saving_;
  StatusLine status_;
  SettingsController settings_;
  SceneOpener opener_;
  ViewController view_;
  PointerController pointer_;
  Capture capture_;
  std::array<FrameReport, 2> reports_;  // of the picture or, of A | B, of both halves
  ShownEdit edit_;
  std::string title_;            // of the window
  std::string progress_;         // of the picture
  uint64_t shownStructure_ = 0;  // structureRevision() of the scene in the last frame
  bool tookBack_ = false;        // undoFailedChange() undid a step, and no frame was drawn since
  bool needsThumbnail_ = true;   // the scene was opened or saved since the last picture
};

}  // namespace speculum
