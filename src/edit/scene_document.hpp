#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "edit/scene_content.hpp"
#include "edit/scene_writer.hpp"
#include "edit/selection.hpp"
#include "frame/settings.hpp"

namespace speculum {

// A scene that a person edits, with undo, and with what saving it needs. Changes go to the scene itself; meshes,
// textures and settings are not its business.
class SceneDocument {
 public:
  // Older steps are forgotten beyond so many, or beyond so many bytes; the last one is always kept.
  static constexpr size_t mostSteps = 1000;
  static constexpr size_t mostBytes = size_t{64} << 20;

  // `scene` as it was loaded; it must outlive the document, and only the document may change what can be edited of it.
  explicit SceneDocument(Scene& scene);

  const Scene& scene() const { return scene_; }

  // One step: `edit` changes values of environment, camera, objects, lights, mirrors or bookmarks. Nothing happens if
  // it changes nothing. If it throws, the scene is as before and the exception goes on; std::logic_error if it adds or
  // removes anything. Within a gesture all changes are one step, with the last label.
  void change(const std::string& label, const Selection& selection, const std::function<void(Scene&)>& edit);

  // A drag, or a slider that is held: what changes until its end is one step, none if all is as before in the end.
  // Undo, redo and saving end it.
  void beginGesture();
  void endGesture();
  void cancelGesture();  // all is as it was at the beginning
  bool inGesture() const { return gesture_.has_value(); }

  // The new thing is selected, and its place returned. Sizes follow the distance to `viewer`, the eye.
  Selection addMirror(const glm::dvec3& position, const glm::dvec3& viewer);  // upright, facing the viewer
  Selection addLight(const glm::dvec3& position, const glm::dvec3& viewer);
  // Of a mesh that the scene has, as the model is: scale 1, its own colours. `position` (world) is under the middle of
  // it.
  Selection addObject(int mesh, const glm::dvec3& position);
  // A little beside; an object with copies as a whole. Throws std::out_of_range for what does not exist.
  Selection duplicate(const Selection& selection);
  void remove(const Selection& selection);  // nothing is selected afterwards
  // Several different things in one step, which stay together: all are put beside the whole by the same way. The first
  // copy is selected; the places of all are returned, in the order of `things`.
  std::vector<Selection> duplicate(std::span<const Selection> things);
  void remove(std::span<const Selection> things);

  // `name` is made one that no other bookmark has; returned.
  std::string addBookmark(Bookmark bookmark);
  void removeBookmark(size_t index);
  std::string renameBookmark(size_t index, const std::string& name);

  bool canUndo() const { return !undo_.empty(); }
  bool canRedo() const { return !redo_.empty(); }
  std::string undoLabel() const { return undo_.empty() ? "" : undo_.back().label; }  // "move object 'teapot'"
  std::string redoLabel() const { return redo_.empty() ? "" : redo_.back().label; }
  void undo();  // nothing happens if there is no step
  void redo();

  // What the person works on; undo and redo restore it.
  const Selection& selection() const { return selection_; }
  void select(const Selection& selection) { selection_ = selection; }

  // Whether the scene differs from what was saved or loaded last.
  bool modified() const;
  // Rises with every change of the scene, undo and redo included.
  uint64_t revision() const { return revision_; }
  // Rises when things came, went or changed places: what counts objects, copies, mirrors or lights, or remembers their
  // indices, must be made anew.
  uint64_t structureRevision() const { return structureRevision_; }

  // Where save() goes unless told otherwise: the scene's file, or a scene file beside a model.
  std::filesystem::path usualFile() const;
  // Writes the scene with the changes of settings since it was loaded. The file is the scene's from then on. Throws
  // SaveError; see writeSceneFile for `overwrite`.
  void save(const std::filesystem::path& file, std::span<const SavedSetting> settings, bool overwrite = false);
  // As save() would write it.
  std::string text(const std::filesystem::path& file, std::span<const SavedSetting> settings) const;

 private:
  // What undo or redo brings back, and what is selected before and after the step.
  struct Step {
    std::string label;
    SceneContent content;
    Selection before;
    Selection after;
    size_t bytes = 0;
  };

  SceneContent content() const;
  void restore(const SceneContent& content);
  void noteChange(const SceneContent& before);
  void record(Step step);
  void push(Step step);
  // Runs `edit`, which returns what is then selected.
  Selection structural(const std::string& label, const std::function<Selection()>& edit);
  void take(const Selection& selection);
  Selection appendCopy(const Selection& selection, const glm::dvec3& step);

  Scene& scene_;
  Scene loaded_;  // without meshes and textures
  SceneContent::Origins origins_;
  std::deque<Step> undo_;
  std::vector<Step> redo_;
  size_t undoBytes_ = 0;
  std::optional<Step> gesture_;
  Selection selection_;
  SceneContent saved_;
  std::filesystem::path savedFile_;
  std::optional<std::string> savedText_;
  uint64_t revision_ = 0;
  uint64_t structureRevision_ = 0;
  mutable std::optional<std::pair<uint64_t, bool>> modified_;  // at a revision
};

// What differs between the two, for save().
std::vector<SavedSetting> settingChanges(const Settings& from, const Settings& to);

}  // namespace speculum
