#include "window/pointer_controller.hpp"

namespace speculum {

constexpr double clickReach = 4.0;  // screen coordinates that the pointer may move by between press and release

void PointerController::cancel() {
  pressed_.reset();
  dragging_ = false;
}

bool PointerController::button(const MouseButtonEvent& event, bool overPanels, SceneEditor& editor,
                               const std::optional<PointedScene>& view) {
  // Ignores another button while one is held.
  if (pressed_ ? event.button != button_ : !event.pressed) {
    return false;
  }
  const bool left = event.button == MouseButton::left;
  if (event.pressed) {
    holdsHandle_ = holdsHandle_ && editor.dragging();
    if (!overPanels && !editor.dragging()) {
      pressed_ = position_;
      button_ = event.button;
      shift_ = event.shift;
      holdsHandle_ = left && view && editor.press(*view, pixel_);
    }
    return false;
  }
  bool clicked = false;
  if (left && editor.dragging() && dragging_) {
    editor.release();
  } else if (left && pressed_ && !dragging_ && view) {
    editor.cancelDrag();
    shift_ ? editor.clickAlso(*view, pixel_) : editor.click(*view, pixel_);
    clicked = true;
  }
  cancel();
  return clicked;
}

void PointerController::move(const glm::dvec2& position, const glm::dvec2& pixelsPerUnit, double height, bool snap,
                             SceneEditor& editor, CameraController& camera) {
  const glm::dvec2 by = position - (pressed_ && !dragging_ ? *pressed_ : position_);
  position_ = position;
  pixel_ = position * pixelsPerUnit;
  dragging_ = dragging_ || (pressed_ && glm::distance(*pressed_, position) > clickReach);
  if (!dragging_) {
    return;
  }
  if (holdsHandle_) {
    editor.drag(pixel_, snap);
  } else if (button_ == MouseButton::left) {
    camera.drag(by.x, by.y);
  } else {
    camera.pan(by.x, by.y, height);
  }
}

}  // namespace speculum
