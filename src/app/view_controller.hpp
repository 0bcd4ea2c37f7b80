#pragma once

#include "app/camera_controller.hpp"
#include "platform/gamepad.hpp"
#include "ui/views.hpp"

namespace speculum {

// The camera of the window with its mode, the scene's bookmarks and the mirrors that it looks from.
class ViewController {
 public:
  void reset(const Scene& scene) { camera_.reset(scene.camera); }  // to the scene's camera
  void sceneChanged(const Scene& scene);
  void setMode(CameraMode mode);
  void toggleMode() { setMode(view_.mode == CameraMode::fly ? CameraMode::orbit : CameraMode::fly); }
  // Moves the camera along right, up and backwards of the view, each in -1 .. 1, and by the gamepad's sticks.
  void move(const glm::dvec3& direction, const GamepadState& pad, double seconds);

  void goToBookmark(size_t index, const Scene& scene);
  void goToNextBookmark(const Scene& scene);
  // Returns the present view as a bookmark. It has an up and a field of view of its own if they differ from the
  // scene's.
  Bookmark bookmark(const CameraPose& pose, const CameraSpec& usual) const;
  void listBookmarks(const Scene& scene);
  void setBookmark(int index) { view_.bookmark = index; }

  // Looks from the selected mirror, else from the one that fills most of the picture, else from the last one looked
  // from.
  void lookFromMirror(MirrorSide side, const Scene& scene, const SceneState& state, const Selection& selected,
                      std::span<const PassView> passes, double aspect);

  CameraController& camera() { return camera_; }
  const CameraController& camera() const { return camera_; }
  const CameraView& view() const { return view_; }

 private:
  CameraController camera_;
  CameraView view_;
  int lastMirror_ = -1;  // last mirror looked from; -1: none yet
};

}  // namespace speculum
