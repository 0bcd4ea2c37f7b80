#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "edit/mesh_outline.hpp"
#include "edit/pick.hpp"
#include "edit/scene_document.hpp"
#include "ui/edit_model.hpp"

namespace speculum {

// What is edited of the scene that the window shows: selection, handles over the picture, fields of the inspector.
class SceneEditor {
 public:
  // What the window shows, for pointing into.
  struct Look {
    const SceneState& state;
    PictureView picture;
    PickLimits limits;
    double scale = 1.0;  // pixels of the picture for one of an ordinary screen
  };

  // Keeps a reference to the scene, and edits it; calls `beforeChange` before each time. `shipped`: models that come
  // with the program.
  SceneEditor(Scene& scene, std::span<const std::filesystem::path> shipped, std::function<void()> beforeChange);

  // Takes hold of a handle; false if there is none at that pixel.
  bool press(const Look& look, const glm::dvec2& pixel);
  bool dragging() const { return drag_.has_value(); }
  void drag(const glm::dvec2& pixel, bool snap);
  void release();
  void cancelDrag();  // puts the thing back
  // Selects what the pixel shows, a further click at the same place what it is seen in: from the innermost thing
  // outwards, and round. Nothing where the background is seen directly.
  void click(const Look& look, const glm::dvec2& pixel);
  // Adds what is seen directly at the pixel to what is selected, or takes it out of that.
  void clickAlso(const Look& look, const glm::dvec2& pixel);
  void toggle(const Selection& thing);
  void select(const Selection& selection);  // alone
  void selectNext(int step);                // in the order of the scene, round
  void toggleMode() { mode_ = mode_ == GizmoMode::move ? GizmoMode::turn : GizmoMode::move; }

  // The file of the model that the inspector has chosen. Throws InputError for one that is not there.
  std::filesystem::path chosenModel(const UiEdit& edit) const;
  void modelsChanged();  // the scene has others
  // Where the view looks. Objects are of a mesh of the scene.
  void add(const Look& look, EditAction kind, int mesh);
  void duplicate();
  void remove();
  void bookmark(Bookmark view);
  void removeBookmark(size_t index);
  void undo();
  void redo();

  SceneDocument& document() { return document_; }
  const SceneDocument& document() const { return document_; }

  // Fills the inspector.
  void show(UiEdit& edit) const;
  // What is drawn over the picture for the selected thing. `pointer`: pixel of the picture, where it is over it.
  UiOverlay overlay(const Look& look, const std::optional<glm::dvec2>& pointer);
  // Takes up what was edited in the inspector.
  void apply(const UiEdit& edit);

  // Whether the scene changed since the last call.
  bool takeChanged() { return std::exchange(shownRevision_, document_.revision()) != document_.revision(); }

 private:
  struct Held {
    Selection what;
    Thing start;
    glm::dvec3 pivot{0.0};  // world
  };
  struct Drag {
    GizmoDrag gizmo;
    std::vector<Held> held;  // the document's selection first, about whose pivot all turn
    double time = 0.0;       // seconds of animation
    glm::dvec2 pixel{0.0};
    GizmoDrag::Change change;
  };
  struct Clicked {
    std::vector<Picked> found;  // from the innermost thing outwards
    glm::dvec2 pixel{0.0};
    size_t chosen = 0;  // of those
  };

  using Placed = std::pair<Selection, Thing>;

  void put(const std::string& verb, std::span<const Placed> things);
  std::vector<Selection> selected() const;  // the document's first
  Thing dragged(const Held& held) const;
  void step(void (SceneDocument::*way)());
  void forgetPath();
  void showThings(UiEdit& edit) const;
  PictureView clickedImage(const Look& look) const;
  Gizmo gizmo(const Look& look) const;
  const MeshOutline& meshOutline(const Selection& thing);
  glm::dvec3 placeAhead(const Look& look, double part, double least = 0.0);
  std::string dragLabel() const;

  Picker& picker();

  SceneDocument document_;
  std::span<const std::filesystem::path> shipped_;
  std::vector<std::filesystem::path> models_;  // that an object can be added of, the scene's first
  std::function<void()> beforeChange_;
  std::unique_ptr<Picker> picker_;  // made when it is needed first
  std::vector<int> path_;           // mirrors that the selected thing was picked through
  std::vector<Selection> others_;   // selected together with the document's; of objects the first copy
  GizmoMode mode_ = GizmoMode::move;
  std::optional<Drag> drag_;
  std::optional<Clicked> clicked_;
  std::map<int, MeshOutline> outlines_;  // by mesh, of those that were selected
  uint64_t shownRevision_ = 0;
};

}  // namespace speculum
