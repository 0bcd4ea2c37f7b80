#pragma once

#include <optional>
#include <string>
#include <vector>

#include "edit/gizmo.hpp"
#include "edit/transform.hpp"

namespace speculum {

// What the person asks for of the scene as a whole or of the selected thing.
enum class EditAction {
  none,
  addObject,
  addLight,
  addMirror,
  duplicate,
  remove,
  lookOut,  // of the selected mirror
  lookBehind,
  undo,
  redo,
  save,
  askWhere,  // opens the question for the file to save to
  saveAs,
  discard,  // answers to the question about unsaved changes
  stay
};

// What is drawn over the picture, in its pixels.
struct UiOverlay {
  std::vector<PixelLine> outline;  // of the selected thing, or of the image of it that was clicked
  std::vector<PixelLine> itself;   // of the thing, where an image was clicked
  std::vector<GizmoShape> gizmo;
  Grip active = Grip::none;  // hovered or dragged
  std::string label;         // what the drag does
  glm::dvec2 labelAt{0.0};
};

// A mirror's vertices while they are typed: one after the other, so that in between they may be no mirror.
struct UiPolygon {
  std::vector<glm::dvec3> vertices;  // world, metres
  std::vector<glm::dvec3> taken;     // the mirror's, as they were when `vertices` came from them or went to them
  int mirror = -1;                   // whose they are
  std::string problem;               // why `vertices` are not the mirror's: one line; empty: they are
};

// The scene as it is edited. The application fills it before every frame and reads back what was changed.
struct UiEdit {
  bool open = false;                                      // the inspector is; changed by the person
  bool focus = false;                                     // bring the list under the keyboard once
  std::vector<std::pair<Selection, std::string>> things;  // all of the scene, with their names
  Selection selected;                                     // changed by the person
  std::vector<Selection> others;                          // selected together with it
  std::optional<Selection> toggled;                       // set by the panel: to be added to those, or taken out
  std::vector<std::string> through;  // mirrors that the selected thing was picked through, from the eye
  std::vector<int> throughMirrors;   // the same, indices into Scene::mirrors
  Thing thing;                       // the selected one; edited in place
  bool edited = false;               // set by the panel: `thing` was
  bool held = false;                 // set by the panel: a field is being edited, what follows belongs to the same step
  GizmoMode mode = GizmoMode::move;  // changed by the person
  std::vector<std::string> models;   // that an object can be added of
  int model = 0;                     // index into models, their number for modelFile; changed by the person
  std::string modelFile;             // an OBJ file, absolute or from the scene's folder; likewise
  UiPolygon polygon;                 // of the selected mirror; changed by the person
  std::string undo;                  // what would be undone; empty: nothing
  std::string redo;
  std::string file;  // of the scene
  bool unsaved = false;
  bool unsavedSettings = false;          // differ from those that were saved or loaded
  bool asksSave = false;                 // unsaved changes would be lost: the question is shown
  bool asksWhere = false;                // the question for a file is shown
  std::string saveAs;                    // the file that is proposed; changed by the person
  std::string note;                      // what was saved, or why it was not
  EditAction action = EditAction::none;  // set by the panel
  UiOverlay overlay;
};

}  // namespace speculum
