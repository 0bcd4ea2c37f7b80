#pragma once

#include <chrono>
#include <functional>

#include "app/accuracy_controller.hpp"
#include "app/camera_controller.hpp"
#include "app/log_capture.hpp"
#include "app/options.hpp"
#include "app/recorder.hpp"
#include "app/scene_editor.hpp"
#include "app/session.hpp"
#include "ui/simple_ui.hpp"

namespace speculum {

// How far a scene is read.
struct LoadedShare {
  std::filesystem::path file;  // that is read
  double done = 0.0;           // 0 .. 1
};

// The window: a scene, a camera that is moved by hand, the panel.
class Demo {
 public:
  explicit Demo(const Options& options);

  // Handles events and draws one frame; none while the window is paused, or nothing has changed or moves, but then it
  // sleeps for a while. False once the window is to be closed.
  bool step();

  Window& window() { return window_; }
  Device& device() { return device_; }
  Renderer& renderer() { return renderer_; }
  // As the next frame would show it.
  CameraPose camera() { return camera_.pose(evaluate(loaded_->scene, time_).camera); }
  const UiModel& model() const { return model_; }
  // Reads a scene or a model in the background; once it is there it takes the place of the scene that is shown. What
  // is wrong with it is the panel's message then, and the scene stays.
  void openFile(const std::filesystem::path& file);
  // Samples that debug.check_finite found in the frames that have finished, of every scene that was shown.
  uint64_t nonFinite() { return nonFinite_ + sceneRenderer_->finiteWatch().count(); }
  int framesDrawn() const { return framesDrawn_; }
  // In the place of the first gamepad that is connected.
  void setGamepadSource(std::function<std::optional<GamepadState>()> source) { gamepadSource_ = std::move(source); }
  // Makes frames from now on readable by Renderer::readback, panel included.
  void setCapture(bool capture) { capture_ = capture; }

 private:
  using Clock = std::chrono::steady_clock;

  struct RefusedTextures {
    std::string settings;  // at which there was no memory for them
    std::string problem;
  };

  void installInput();
  void findScenes();
  void showGallery();
  void showDevice();
  void showMemory();
  void applyPresentMode();
  void noteTimes(uint64_t frame, double cpuMs);
  size_t noteSceneFile(const std::filesystem::path& file);
  void openDropped(const std::vector<std::filesystem::path>& files);
  void chooseScene(int index);
  void followLoading();
  // demo_status.cpp
  void tell(const std::string& text);  // in the panel's status line and the log
  void show(const std::string& text);  // in the line alone
  void followStatus();
  bool statusFades() const;
  void showScene(std::unique_ptr<LoadedScene> scene);
  void moveCamera(double seconds);
  glm::dvec3 heldDirection() const;
  bool changing();
  bool rest();
  void drawFrame(double seconds);
  FittedPlan planAndUpload(Frame& frame, const SceneState& state, Settings settings);
  std::optional<DebugView> debugView(const FramePlan& plan, const Settings& drawn);
  void showTexel(const FramePlan& plan);
  void outlineSkipped(const FramePlan& plan, const SceneState& state);
  void describeTarget(const FramePlan& plan, const PlannedPass& pass, const Settings& drawn);
  void fillEffects(const FramePlan& plan, const SceneState& state, const Settings& drawn);
  void fillModel(const FramePlan& plan, const SceneState& state, const Settings& drawn);
  void fillPasses(const FramePlan& plan, const SceneState& state, int updateInterval);
  void applyModel();
  std::filesystem::path fileOfView(std::string& problem);
  SweepRequest sweepRequest(const std::filesystem::path& file);
  void handleKey(const KeyEvent& event);
  void handleSingleKey(const KeyEvent& event);
  void takeGamepad();
  void moveByGamepad(double seconds);
  void goTo(double time);
  void stepTime(int steps);
  void goToBookmark(int index);
  void bookmarkView();
  void nextBookmark();
  void applyBookmarks();
  void listBookmarks();
  void lookFromMirror(CameraController::MirrorSide side);
  int mirrorOfInterest() const;
  double aspect() const;
  void toggleRecording(bool bare);
  void frameScene();
  void saveShot();
  void copyCommand();
  // demo_models.cpp
  void findModels();
  void addObject();
  void useModels();
  // demo_edit.cpp
  void startEditing();
  bool lookAtScene(double time);
  SceneEditor::Look look() const;
  glm::dvec2 pointerPixel() const;
  void pressPointer(const MouseButtonEvent& event);
  void movePointer(double x, double y);
  bool handleQuestionKey(const KeyEvent& event);
  bool handleEditKey(const KeyEvent& event);
  bool handleControlKey(const KeyEvent& event);
  void showEdit(double seconds);
  void applyEdit();
  void actOn(EditAction action);
  bool settingsChanged() const;
  void answer(EditAction action);
  void saveScene();
  void undo();
  void redo();
  void askWhere();
  bool saveSceneTo(const std::filesystem::path& file);
  // demo_leave.cpp
  void closeTop();
  bool hasUnsaved() const;
  void goOn();
  bool mayLeave();
  bool closes();

  Options options_;
  UiModel model_;
  LogCapture log_{model_.log.history};
  std::unique_ptr<LoadedScene> loaded_;
  Window window_;
  Device device_;
  Renderer renderer_;
  std::unique_ptr<SceneRenderer> sceneRenderer_;
  BudgetPlanner planner_;
  std::optional<RefusedTextures> texturesRefused_;
  std::unique_ptr<SimpleUI> ui_;
  CameraController camera_;
  AccuracyController accuracy_;
  std::vector<std::filesystem::path> sceneFiles_;
  int shownScene_ = 0;
  int shownPresentMode_ = 0;
  std::optional<std::vector<int>> watched_;  // path of the mirror image that the panel shows; empty: the main view
  std::vector<std::filesystem::path> shippedModels_;
  BackgroundJob<std::unique_ptr<LoadedScene>, LoadedShare> load_;
  std::string sceneError_;
  uint64_t nonFinite_ = 0;               // of scenes shown before
  std::unique_ptr<SceneEditor> editor_;  // of loaded_
  SceneState look_;                      // what the person points into
  std::vector<SkippedMirror> skipped_;   // in the last frame
  MouseButton pressedButton_ = MouseButton::left;
  bool pressedShift_ = false;
  std::optional<glm::dvec2> pressed_;              // screen coordinates; the pointer went down over the picture
  std::optional<std::filesystem::path> nextFile_;  // to be opened, while unsaved changes are asked about
  std::optional<uint64_t> discarded_;              // revision of the scene whose changes were given up
  Settings discardedSettings_;                     // likewise
  Settings settingsAtLoad_;                        // before the person changed any
  uint64_t shownStructure_ = 0;                    // of the scene, in the last frame
  bool closing_ = false;                           // once unsaved changes are answered for
  bool leaves_ = false;                            // with the answer
  std::filesystem::path refused_;                  // that was not overwritten; asked for again, it is
  bool holdsHandle_ = false;                       // what is pressed is a handle, not the picture
  bool dragging_ = false;
  double cursorX_ = 0.0;
  double cursorY_ = 0.0;
  std::function<std::optional<GamepadState>()> gamepadSource_ = [this] { return window_.gamepad(); };
  GamepadState gamepad_;
  bool gamepadChanged_ = false;  // since the last step
  int lookedFrom_ = -1;          // the mirror, index into Scene::mirrors; -1: none yet
  Recorder recorder_;
  Clock::time_point statusSince_;
  double time_ = 0.0;  // seconds of animation
  Clock::time_point last_;
  int framesDue_ = 0;       // to draw, although nothing changes any more
  double sinceLast_ = 0.0;  // milliseconds between the last two frames; NaN if the window rested
  bool rested_ = true;      // before the frame that is drawn next
  bool working_ = false;    // in the background, for the panel
  std::string shaderErrors_;
  bool capture_ = false;
  enum class Shot { none, window, picture };
  Shot shot_ = Shot::none;  // to be saved of the next frame
  int framesDrawn_ = 0;
};

// The window until it is closed or --frames are drawn. Exit code 1 if the validation layer or debug.check_finite had
// anything to say.
int runDemo(const Options& options);

}  // namespace speculum
