#pragma once

#include <chrono>

#include "window/pace.hpp"
#include "window/picture_halves.hpp"
#include "window/window_input.hpp"

namespace speculum {

// The window: shows a workspace and passes the user's input on to it.
class Demo : private WorkspaceHost {
 public:
  explicit Demo(const Options& options);

  // Handles events and draws one frame. While the window is paused or nothing changes it sleeps for a while instead.
  // Returns false once the window is to be closed.
  bool step();
  void apply(const Command& command) { workspace_.apply(command); }

  UiInput shown() { return workspace_.shown(deviceView_, message()); }
  const PanelState& panels() const { return ui_.windows().state(); }
  CameraPose camera() { return workspace_.state(workspace_.time()).camera; }  // of the next frame
  // Settings of the last frame; the pace may have lowered them.
  const Settings& frameSettings() const { return halves_.drawn().pace.planned().settings; }
  Window& window() { return window_; }
  Device& device() { return device_; }
  Renderer& renderer() { return renderer_; }
  uint64_t nonFinite() const { return halves_.nonFinite(); }
  int framesDrawn() const { return framesDrawn_; }
  // Saves a copy of unsaved changes and logs where.
  void keepUnsavedWork() noexcept { workspace_.keepUnsavedWork(); }
  // Takes the gamepad's state from `source` instead of from the first connected gamepad.
  void setGamepadSource(std::function<std::optional<GamepadState>()> source) { gamepadSource_ = std::move(source); }
  // Makes frames from now on readable by Renderer::readback, panels included.
  void setCapture(bool capture) { capture_ = capture; }

 private:
  using Clock = std::chrono::steady_clock;

  bool stepOnce();

  // WorkspaceHost
  void useScene(const Scene& scene) override;
  void dropCachedImages() override {
    std::ranges::for_each(halves_, [](const PictureHalf& half) { half.renderer->restart(); });
  }
  glm::ivec2 pictureSize() const override;
  PixelRect freePicture() const override;
  double contentScale() const override { return ui_.scale(); }
  std::string gpu() const override { return std::to_string(device_.info().index); }
  void setClipboard(const std::string& text) override { window_.setClipboard(text); }
  void setTitle(const std::string& title) override { window_.setTitle(title); }
  void close() override;
  void toggleFullScreen() override { window_.setFullScreen(!window_.fullScreen()); }
  void setPresentMode(size_t index) override;
  void togglePanels() override { ui_.windows().toggleVisible(); }
  void closeSidePanels() override { ui_.windows().closeSidePanels(); }
  bool showsPanels() const override { return ui_.windows().visible(); }
  void toggleHelp() override { ui_.windows().toggleHelp(); }
  void toggleInspector() override { ui_.windows().toggleInspector(); }
  void openInspector() override { ui_.windows().openInspector(); }
  bool inspectorCovers(const glm::dvec2& place) const override { return ui_.windows().inspectorCovers(place); }
  bool closePopup() override { return ui_.holdsEscape() || ui_.windows().closeHelp(); }

  bool shouldClose();
  void requestFrames();
  bool idle();
  void updateUi(double seconds);
  void beginOpening();
  void continueOpening(const FramePlan& plan);
  void endWithPanels(Frame& frame);
  void endFrame(Frame& frame);
  void drawFrame(double seconds);
  bool takeTurns();
  bool beginPace(const SceneState& state, double seconds);
  bool isShown() const { return halves_.index() == workspace_.shownHalf(); }
  std::optional<Pace::Target> missingTarget() const;
  const FittedPlan& planFrame(Frame& frame, const SceneState& state);
  bool recordPicture(Frame& frame, const SceneState& state);
  std::optional<TargetDisplay> shownTarget();
  bool countFrame(bool compiles);
  void report(const RecordedFrame& frame);
  double budgetMs() const;
  std::string message();

  Options options_;
  Workspace workspace_;
  Window window_;
  Device device_;
  Renderer renderer_;
  PictureHalves halves_;
  double heldSeconds_ = 0.0;  // of animation, since the last frame that began a pair of halves
  FirstPictures first_;
  double refreshHz_;  // of the monitor
  ShownDevice deviceView_;
  SimpleUI ui_;
  WindowInput input_;
  std::function<std::optional<GamepadState>()> gamepadSource_ = [this] { return window_.gamepad(); };
  UiOutput output_;  // of the panels in the frame that is drawn
  FramePacer pacer_;
  int untimedFrames_ = 0;            // since the last frame whose passes were timed one by one
  bool changes_ = false;             // something changes in this step
  bool changeBegins_ = false;        // something changes, and did not in the step before
  size_t pipelines_ = 0;             // number of pipelines after the last frame
  bool compiled_ = false;            // the last frame compiled pipelines
  bool sceneIsNew_ = true;           // no picture of the scene was drawn yet
  std::filesystem::path shownFile_;  // file of the scene that is shown
  bool closeAfterPrompt_ = false;    // the prompt is answered: close the window
  bool working_ = false;             // background work has results to show
  std::string shaderErrors_;
  Clock::time_point last_;    // when the last step began
  Clock::time_point opened_;  // when the scene was shown first
  bool capture_ = false;
  bool saved_ = false;         // the frame that is drawn is saved by Capture
  bool bare_ = false;          // and without panels
  CameraPose previousCamera_;  // of the frame before
  int framesDrawn_ = 0;
};

}  // namespace speculum
