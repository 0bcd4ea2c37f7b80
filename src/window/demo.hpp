#pragma once

#include <array>
#include <chrono>

#include "session/frame_planner.hpp"
#include "ui/simple_ui.hpp"
#include "window/first_pictures.hpp"
#include "window/frame_pacer.hpp"
#include "window/pace.hpp"
#include "window/workspace.hpp"

namespace speculum {

// The window: shows a workspace and passes the user's input on to it.
class Demo : private WorkspaceHost {
 public:
  explicit Demo(const Options& options);

  // Handles events and draws one frame. While the window is paused or nothing changes it sleeps for a while instead.
  // Returns false once the window is to be closed.
  bool step();
  void apply(const Command& command) { workspace_.apply(command); }

  UiInput shown() const { return workspace_.shown(deviceView_, message_); }
  const PanelState& panels() const { return ui_->windows().state(); }
  CameraPose camera() { return workspace_.state(workspace_.time()).camera; }  // of the next frame
  const Settings& frameSettings() const { return frameSettings_; }  // of the last frame; the pace may have lowered them
  Window& window() { return window_; }
  Device& device() { return device_; }
  Renderer& renderer() { return renderer_; }
  // Samples that debug.check_finite found in the frames that have finished, of every scene that was shown.
  uint64_t nonFinite();
  int framesDrawn() const { return framesDrawn_; }
  // Saves a copy of unsaved changes and logs where.
  void keepUnsavedWork() noexcept { workspace_.keepUnsavedWork(); }
  // Takes the gamepad's state from `source` instead of from the first connected gamepad.
  void setGamepadSource(std::function<std::optional<GamepadState>()> source) { gamepadSource_ = std::move(source); }
  // Makes frames from now on readable by Renderer::readback, panels included.
  void setCapture(bool capture) { capture_ = capture; }

 private:
  using Clock = std::chrono::steady_clock;

  // What draws the picture: the only one, or a half of A | B. Only one half is drawn in each frame, so that the
  // device's times are those of one set of settings.
  struct Half {
    Half(Renderer& renderer, const Scene& scene);

    std::unique_ptr<SceneRenderer> renderer;
    FramePlanner planner;
    Pace pace;
    uint64_t frame = 0;  // number of the last frame that drew it; 0: none yet
  };

  bool stepOnce();

  // WorkspaceHost
  void useScene(const Scene& scene) override;
  void dropCachedImages() override;
  void scenesListed() override { ui_->setThumbnails(workspace_.browser().thumbnails()); }
  glm::ivec2 pictureSize() const override;
  PixelRect freePicture() const override;
  double contentScale() const override { return ui_->scale(); }
  std::string gpu() const override { return std::to_string(device_.info().index); }
  void setClipboard(const std::string& text) override { window_.setClipboard(text); }
  void setTitle(const std::string& title) override { window_.setTitle(title); }
  void close() override;
  void toggleFullScreen() override { window_.setFullScreen(!window_.fullScreen()); }
  void setPresentMode(size_t index) override;
  bool togglePanels() override { return ui_->windows().toggleVisible(); }
  void toggleHelp() override { ui_->windows().toggleHelp(); }
  void toggleInspector() override { ui_->windows().toggleInspector(); }
  void openInspector() override { ui_->windows().openInspector(); }
  bool inspectorCovers(const glm::dvec2& place) const override { return ui_->windows().inspectorCovers(place); }
  bool closePopup() override { return ui_->holdsEscape() || ui_->windows().closeHelp(); }

  void takeInput(const InputEvent& event);
  void handleKey(const KeyEvent& event);
  void takeGamepad();
  glm::dvec3 heldDirection() const;
  bool controlHeld() const;
  bool overPanels() const;
  bool shouldClose();
  bool changing();
  bool idle();
  void updateUi(double seconds);
  void beginOpening();
  void continueOpening(const FramePlan& plan);
  void presentPanels();
  void endWithPanels(Frame& frame);
  void endFrame(Frame& frame);
  void abandonFrame(Frame& frame, const std::string& why);
  void drawFrame(double seconds, double sinceLastMs);
  void takeTurns();
  void dropSecondHalf();
  bool endsPair() const { return workspace_.split().on() && halves_[1] && half_ == 0; }
  Half& half() { return *halves_[static_cast<size_t>(half_)]; }
  const Half& half() const { return *halves_[static_cast<size_t>(half_)]; }
  bool isShown() const { return half_ == workspace_.shownHalf(); }
  const FrameTimings& timings() const;
  void showCover();
  std::optional<SplitDisplay> splitDisplay(const Frame& frame);
  void describeHalf();
  std::optional<Pace::Target> missingTarget() const;
  bool isShownOnly() const;
  const FittedPlan& planFrame(Frame& frame, const SceneState& state);
  void uploadTextures(Frame& frame, const SceneState& state, const FittedPlan& fitted);
  std::string drawingText() const { return "Drawing " + workspace_.scene().file.filename().string() + "..."; }
  std::string pictureText(const Scene& scene, const Settings& chosen) const;
  double budgetMs() const { return motionBudget(workspace_.shownSettings(half_), device_.info().isCpu(), refreshHz_); }
  bool timesPasses(bool movementEnded);
  std::string currentMessage();

  Options options_;
  Workspace workspace_;
  Window window_;
  Device device_;
  Renderer renderer_;
  std::array<std::unique_ptr<Half>, 2> halves_;  // the second one only while there is A | B
  int half_ = 0;                                 // that is drawn in this frame, or was in the last one
  int covered_ = 0;                              // half that has the accuracy's heat map as its cover
  double heldSeconds_ = 0.0;                     // of animation, since the last frame that began a pair of halves
  FirstPictures first_;
  double refreshHz_;  // of the monitor
  ShownDevice deviceView_;
  std::unique_ptr<SimpleUI> ui_;
  UiOutput output_;  // of the panels in the frame that is drawn
  FramePacer pacer_;
  int untimedFrames_ = 0;            // since the last frame whose passes were timed one by one
  bool changes_ = false;             // something changes in this step
  bool changeBegins_ = false;        // something changes, and did not in the step before
  size_t pipelines_ = 0;             // number of pipelines after the last frame
  bool compiled_ = false;            // the last frame compiled pipelines
  int scenes_ = 0;                   // number of scenes shown before this one
  bool sceneIsNew_ = true;           // no picture of the scene was drawn yet
  std::filesystem::path shownFile_;  // file of the scene that is shown
  Settings frameSettings_;
  std::string message_;
  uint64_t nonFinite_ = 0;  // samples found in the scenes shown before
  std::function<std::optional<GamepadState>()> gamepadSource_ = [this] { return window_.gamepad(); };
  GamepadState gamepad_;
  bool gamepadChanged_ = false;    // since the last step
  bool closeAfterPrompt_ = false;  // the prompt is answered: close the window
  bool working_ = false;           // background work has results to show
  std::string shaderErrors_;
  Clock::time_point last_;    // when the last step began
  Clock::time_point opened_;  // when the scene was shown first
  bool capture_ = false;
  int framesDrawn_ = 0;
};

// Runs the window until it is closed or --frames are drawn. Returns the exit code: 1 if the validation layer or
// debug.check_finite reported anything.
int runDemo(const Options& options);

}  // namespace speculum
