// The part of the window that decides when to draw, and what keys and pointer do.
#include <algorithm>
#include <limits>
#include <utility>

#include "app/demo.hpp"

namespace speculum {

namespace {

constexpr double longestStep = 0.1;  // seconds: a pause of the program is none of the animation's business
constexpr double restSeconds = 0.1;  // between looks at a window in which nothing changes
constexpr double smoothing = 0.05;   // of the frame time shown
// The panel takes up what happened in one frame, settles in a second, and shows figures of the frame two before.
constexpr int framesAfterChange = 4;

// In which everything that is held is rendered anew. A map that is kept for longer than a minute is asked for as it is.
int framesUntilFresh(const Settings& settings) {
  const EffectSettings& effects = settings.effects;
  const bool maps = effects.curved && effects.curvedLookup == CurvedLookup::environment;
  return std::max(settings.reflection.updateInterval, maps ? std::min(effects.environmentInterval, 3600) : 0);
}

}  // namespace

// Before the panel is made, whose callbacks then run first and pass everything on.
void Demo::installInput() {
  WindowCallbacks callbacks;
  callbacks.key = [this](const KeyEvent& event) { handleKey(event); };
  callbacks.mouseButton = [this](const MouseButtonEvent& event) { pressPointer(event); };
  callbacks.cursor = [this](double x, double y) { movePointer(x, y); };
  callbacks.scroll = [this](double, double dy) {
    if (!(ui_ && ui_->takesPointer(cursorX_, cursorY_))) {
      camera_.zoom(dy);
    }
  };
  callbacks.drop = [this](const std::vector<std::filesystem::path>& files) { openDropped(files); };
  window_.setCallbacks(std::move(callbacks));
}

void Demo::handleKey(const KeyEvent& event) {
  if (!event.pressed || !ui_ || handleQuestionKey(event)) {
    return;
  }
  if (event.key == Key::q && event.control) {
    return window_.requestClose();
  }
  if (ui_->wantsKeyboard() || handleEditKey(event)) {
    return;
  }
  if (event.key == Key::period || event.key == Key::comma) {
    stepTime(event.key == Key::period ? 1 : -1);
  }
  if (!event.repeat) {
    handleSingleKey(event);
  }
}

void Demo::handleSingleKey(const KeyEvent& event) {
  switch (event.key) {
    case Key::f1:
      model_.help = !model_.help;
      return ui_->setVisible(ui_->visible() || model_.help);
    case Key::tab:
      return ui_->setVisible(!ui_->visible());
    case Key::b:
      return lookFromMirror(event.shift ? CameraController::MirrorSide::front : CameraController::MirrorSide::back);
    case Key::m:
      return event.shift ? nextBookmark() : bookmarkView();
    case Key::f10:
      return toggleRecording(event.shift);
    case Key::f11:
      return window_.setFullScreen(!window_.fullScreen());
    case Key::f12:
      shot_ = event.shift ? Shot::picture : Shot::window;
      return;
    case Key::f:
      return frameScene();
    case Key::space:
      model_.paused = ui_->navigating() ? model_.paused : !model_.paused;
      return;
    case Key::leftBracket:
      model_.timeSpeed = std::max(slowestTime, 0.5 * model_.timeSpeed);
      return;
    case Key::rightBracket:
      model_.timeSpeed = std::min(fastestTime, 2.0 * model_.timeSpeed);
      return;
    default:
      return;
  }
}

void Demo::goTo(double time) {
  time_ = std::max(0.0, time);
}

void Demo::stepTime(int steps) {
  model_.paused = true;
  goTo(time_ + steps * timeStep);
}

void Demo::toggleRecording(bool bare) {
  if (recorder_.running()) {
    recorder_.stop();
    return tell(recorder_.message());
  }
  try {
    recorder_.start(loaded_->scene.file.stem().string(), bare);
  } catch (const std::filesystem::filesystem_error& error) {
    tell("not recorded: " + std::string(error.what()));
  }
}

void Demo::moveCamera(double seconds) {
  camera_.setMode(model_.cameraMode);
  camera_.move(heldDirection(), seconds);
  moveByGamepad(seconds);
}

// Along right, up and backwards of the view.
glm::dvec3 Demo::heldDirection() const {
  if (ui_->wantsKeyboard() || window_.keyDown(Key::leftControl) || window_.keyDown(Key::rightControl)) {
    return glm::dvec3(0.0);
  }
  const auto axis = [&](Key positive, Key negative) {
    return static_cast<double>(window_.keyDown(positive)) - static_cast<double>(window_.keyDown(negative));
  };
  return {axis(Key::d, Key::a), axis(Key::e, Key::q), axis(Key::s, Key::w)};
}

// Whether the next frame could differ from the last one.
bool Demo::changing() {
  const bool rebuilt = renderer_.reloadShaders();
  const std::string& errors = renderer_.pipelines().errors();
  const bool shaders = std::exchange(shaderErrors_, errors) != errors || rebuilt;
  const bool working = accuracy_.working(model_) || load_.running();
  const bool finished = std::exchange(working_, working) && !working;
  return window_.takeActivity() || shaders || finished || gamepadChanged_ || gamepad_.used() || recorder_.running() ||
         heldDirection() != glm::dvec3(0.0) || model_.settings.view.continuous || options_.frames > 0 ||
         (!model_.paused && moves(loaded_->scene));
}

// Nothing changes: sleeps. True if a frame is to be drawn all the same, for what changes slowly.
bool Demo::rest() {
  rested_ = true;
  window_.waitEvents(restSeconds);
  return ui_->wantsFrames() || working_ || statusFades();
}

bool Demo::step() {
  window_.pollEvents();
  takeGamepad();
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - last_).count();
  last_ = now;
  if (window_.paused()) {
    window_.waitEvents(restSeconds);
    return !closes();
  }
  if (changing()) {
    framesDue_ = framesAfterChange + framesUntilFresh(model_.settings);
  }
  if (framesDue_ == 0 && !rest()) {
    return !closes();
  }
  sinceLast_ = rested_ ? std::numeric_limits<double>::quiet_NaN() : 1000.0 * seconds;
  if (!std::exchange(rested_, false)) {
    model_.frameMs += (model_.frameMs == 0.0 ? 1.0 : smoothing) * (1000.0 * seconds - model_.frameMs);
  }
  drawFrame(std::min(seconds, longestStep));
  return !closes();
}

}  // namespace speculum
