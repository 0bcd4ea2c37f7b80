#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "edit/picture_view.hpp"
#include "edit/scene_document.hpp"
#include "edit/transform.hpp"
#include "platform/window.hpp"
#include "ui/shown.hpp"
#include "window/camera_controller.hpp"

namespace speculum {

// The scene as the window shows it, for picking.
struct PointedScene {
  SceneState state;
  PictureView picture;
  PickLimits limits;
  double scale = 1.0;  // pixels of the picture for one at 96 dots an inch
};

// Edits the scene that the window shows: selection, handles over the picture, fields of the inspector, undo.
class SceneEditor {
 public:
  // Keeps a reference to the document, and calls `beforeChange` before each change of it. `shipped`: models that come
  // with the program.
  SceneEditor(SceneDocument& document, std::span<const std::filesystem::path> shipped,
              std::function<void()> beforeChange);

  bool press(const PointedScene& view, const glm::dvec2& pixel);  // grips a handle; false if there is none
  bool dragging() const { return drag_.has_value(); }
  void drag(const glm::dvec2& pixel, bool snap);
  void release();
  void cancelDrag();  // puts the nodes back
  // Selects the node that the pixel shows. Further clicks at the same place select the mirror that the node is seen in,
  // then the mirror around that one, and so on outwards, then begin again. Selects nothing where the background or the
  // sky is seen directly.
  void click(const PointedScene& view, const glm::dvec2& pixel);
  // Adds the node that is seen directly at the pixel to the selection, or removes it.
  void clickAlso(const PointedScene& view, const glm::dvec2& pixel);
  void toggle(const Selection& node);
  void select(const Selection& node);       // alone
  void selectNext(int step);                // in the order of allNodes(); after the last one comes the first
  std::vector<Selection> selected() const;  // the document's selection first, then others_
  bool selectedInMirror() const { return !path_.empty(); }  // the selected node was picked through a mirror
  void setMode(GizmoMode mode) { mode_ = mode; }
  void nextMode() { mode_ = static_cast<GizmoMode>((static_cast<int>(mode_) + 1) % 3); }

  // Replaces the scene's camera by one that gives a view; `continued` as of edit().
  void editCamera(const CameraSpec& camera, bool continued);
  // Replaces a node by one of its kind. With `continued` further edits until endEdit() belong to the same step of undo.
  // Nothing changes for an orbit whose axis has no direction.
  void edit(const Selection& target, const SceneNode& node, bool continued);
  void endEdit();
  // Add a node in the middle of the view. `mesh`: index into Scene::meshes.
  void addMirror(const PointedScene& view);
  void addLight(const PointedScene& view);
  void addObject(const PointedScene& view, int mesh);
  void duplicate(const PointedScene& view, const PixelRect& free);  // `free`: where no panel covers the picture, pixels
  std::string remove();  // deletes the selected nodes, and describes them; empty: there were none
  void addBookmark(Bookmark bookmark);
  void removeBookmark(size_t index);              // if there is one
  std::optional<SettingsStep> step(UndoWay way);  // undoes or redoes a step, see SceneDocument

  // Returns the file of an AddObject command's model. Throws InputError if it does not exist.
  std::filesystem::path modelFile(const std::filesystem::path& model) const;
  void modelsChanged();  // call when the scene's models changed

  bool changedSinceLastCall() { return std::exchange(shownRevision_, document_.revision()) != document_.revision(); }

  // Fills the editor's part of ShownEdit.
  void fill(ShownEdit& view) const;
  // Returns outline and handles of the selected nodes. `pointer`: pixel of the pointer, if that is over the picture.
  ShownOverlay overlay(const PointedScene& view, const std::optional<glm::dvec2>& pointer);

 private:
  struct Clicked {
    std::vector<Picked> found;  // from the innermost node outwards
    glm::dvec2 pixel{0.0};
    size_t chosen = 0;  // index into `found`
  };

  void replace(const std::string& verb, std::span<const PlacedNode> nodes);
  void beginChange();
  void forgetPath();
  PictureView clickedImage(const PointedScene& view) const;
  Gizmo gizmo(const PointedScene& view) const;
  const MeshOutline& meshOutline(const Selection& node);
  double sideInSight(const PointedScene& view, std::span<const Selection> nodes, const PixelRect& free) const;
  glm::dvec3 pointAhead(const PointedScene& view, double part, double least = 0.0);
  Picker& picker();

  SceneDocument& document_;
  std::span<const std::filesystem::path> shipped_;
  std::vector<std::filesystem::path> models_;  // of objects that can be added; the scene's own come first
  std::function<void()> beforeChange_;
  std::unique_ptr<Picker> picker_;  // made when it is needed first
  MirrorPath path_;                 // mirrors that the selected node was picked through
  std::vector<Selection> others_;   // selected besides the document's selection; of an object the first copy
  GizmoMode mode_ = GizmoMode::move;
  std::optional<NodeDrag> drag_;
  std::optional<Clicked> clicked_;
  std::map<int, MeshOutline> outlines_;  // by mesh, of objects that were selected
  uint64_t shownRevision_ = 0;
};

// Turns the pointer's events over the picture into drags of handles or the camera, and clicks that select.
class PointerController {
 public:
  // Handles a press or release. `overPanels` says that the event belongs to the panels. `view` is the scene as it is
  // shown now, if the window has pixels. Returns true if a click may have selected something.
  bool button(const MouseButtonEvent& event, bool overPanels, SceneEditor& editor,
              const std::optional<PointedScene>& view);
  // Handles a move to `position` (screen coordinates of the window). One screen coordinate is `pixelsPerUnit` pixels of
  // the picture; `height` is the window's, in screen coordinates. With `snap`, drags go in steps.
  void move(const glm::dvec2& position, const glm::dvec2& pixelsPerUnit, double height, bool snap, SceneEditor& editor,
            CameraController& camera);
  void cancel();  // call when another scene is shown

  const glm::dvec2& position() const { return position_; }  // screen coordinates
  const glm::dvec2& pixel() const { return pixel_; }        // of the picture
  bool dragging() const { return dragging_; }

 private:
  MouseButton button_ = MouseButton::left;  // button that went down over the picture
  bool shift_ = false;                      // Shift was held at the press
  std::optional<glm::dvec2> pressed_;       // position of the press; none: no button is down
  bool holdsHandle_ = false;                // the press gripped a handle, not the picture
  bool dragging_ = false;
  glm::dvec2 position_{0.0};
  glm::dvec2 pixel_{0.0};
};

}  // namespace speculum
