// What the gamepad does in the window. The direction pad goes to the panel (Dear ImGui's navigation); while it is
// there, sticks and buttons are the panel's too, but for those that leave it.
#include "app/demo.hpp"

namespace speculum {

namespace {

constexpr double turnSpeed = 90.0;  // degrees a second

}  // namespace

void Demo::takeGamepad() {
  const GamepadState before = gamepad_;
  gamepad_ = gamepadSource_().value_or(GamepadState{});
  gamepadChanged_ = gamepad_ != before;
  const auto pressed = [&](GamepadButton button) { return gamepad_.down(button) && !before.down(button); };
  if (pressed(GamepadButton::back)) {
    ui_->setVisible(!ui_->visible());
  }
  if (pressed(GamepadButton::start)) {
    model_.paused = !model_.paused;
  }
  if (ui_->navigating()) {
    return;
  }
  if (pressed(GamepadButton::a)) {
    frameScene();
  }
  if (pressed(GamepadButton::b)) {
    model_.cameraMode = model_.cameraMode == CameraMode::fly ? CameraMode::orbit : CameraMode::fly;
  }
  if (pressed(GamepadButton::x)) {
    lookFromMirror(CameraController::MirrorSide::front);
  }
  if (pressed(GamepadButton::y)) {
    lookFromMirror(CameraController::MirrorSide::back);
  }
  if (pressed(GamepadButton::leftBumper)) {
    stepTime(-1);
  }
  if (pressed(GamepadButton::rightBumper)) {
    stepTime(1);
  }
  if (pressed(GamepadButton::leftStick)) {
    camera_.reset(loaded_->scene.camera);
  }
  if (pressed(GamepadButton::rightStick)) {
    shot_ = Shot::window;
  }
}

void Demo::moveByGamepad(double seconds) {
  if (ui_->navigating()) {
    return;
  }
  if (gamepad_.rightX != 0.0f || gamepad_.rightY != 0.0f) {
    camera_.turn(gamepad_.rightX * turnSpeed * seconds, gamepad_.rightY * turnSpeed * seconds);
  }
  camera_.move({gamepad_.leftX, gamepad_.rightTrigger - gamepad_.leftTrigger, gamepad_.leftY}, seconds);
}

}  // namespace speculum
