#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "edit/new_nodes.hpp"
#include "edit/scene_writer.hpp"

namespace speculum {

enum class UndoWay { back, forward };

// Settings before and after a step that changed only these.
struct SettingsStep {
  Settings before;
  Settings after;
  int half = -1;  // whose settings these are: of a half of A | B, 0 or 1; -1: the scene's
};

// A scene that a user edits, with undo and saving. Changes go to the scene itself. Meshes, textures and settings are
// left to others, but changes of settings are steps of undo too.
class SceneDocument {
 public:
  // Beyond these numbers the oldest steps are dropped; the last step is always kept.
  static constexpr size_t mostSteps = 1000;
  static constexpr size_t mostBytes = size_t{64} << 20;

  // `scene` as it was loaded. It must outlive the document, and only the document may change what SceneContent holds.
  explicit SceneDocument(Scene& scene);

  const Scene& scene() const { return scene_; }

  // Calls `edit`, which changes values of environment, camera, objects, lights, mirrors or bookmarks, as one step; as
  // none if nothing changes. If `edit` throws, the scene is as before. Throws std::logic_error if `edit` adds or
  // removes anything. Within a gesture all changes are one step, with the last label.
  void change(const std::string& label, const Selection& selection, const std::function<void(Scene&)>& edit);

  // A gesture is a drag, or a slider that is held: all changes until its end are one step, or none if they cancel out.
  // Undo, redo and saving end it.
  void beginGesture();
  void endGesture();
  void cancelGesture();  // back to the beginning
  bool inGesture() const { return gesture_.has_value(); }
  bool gestureChanges() const { return gesture_ && content() != gesture_->content; }

  // Each of these adds a node in one step, selects it and returns where it is; see new_nodes.hpp.
  Selection addMirror(const glm::dvec3& position, const glm::dvec3& viewer) { return add(newMirror(position, viewer)); }
  Selection addLight(const glm::dvec3& position, const glm::dvec3& viewer) { return add(newLight(position, viewer)); }
  Selection addObject(int mesh, const glm::dvec3& position) { return add(newObject(scene_, mesh, position)); }
  // Puts copies of different nodes (at least one) beside them in one step, to the other side if `side` is -1. The
  // copies stay together; the first is selected, all are returned in the order of `nodes`. Throws std::out_of_range if
  // a node does not exist.
  std::vector<Selection> duplicate(std::span<const Selection> nodes, double side = 1.0);
  void remove(std::vector<Selection> nodes);  // nothing is selected afterwards

  // Adds a bookmark under a name that no other has, and returns that name.
  std::string addBookmark(Bookmark bookmark);
  void removeBookmark(size_t index);

  // Call after a change of the settings of SettingsStep::half. `continued`: the change belongs to the step of the
  // change before, unless another step, undo or redo came between. A step that ends with the settings of its beginning
  // is taken away.
  void settingsChanged(const Settings& before, const Settings& after, bool continued, int half = -1);
  // Takes away all steps that changed settings of a half.
  void forgetHalves();

  bool canUndo() const { return !undo_.empty(); }
  bool canRedo() const { return !redo_.empty(); }
  std::string undoLabel() const { return undo_.empty() ? "" : labelOf(undo_.back()); }  // "move object 'teapot'"
  std::string redoLabel() const { return redo_.empty() ? "" : labelOf(redo_.back()); }
  // Says whether the next step that way changes the scene; false if there is no step.
  bool changesScene(UndoWay way) const;
  // Take back a step, or do it again. Nothing happens if there is no step. A step that changed settings is returned,
  // for the caller to restore them.
  std::optional<SettingsStep> undo();
  std::optional<SettingsStep> redo();

  // The node that the user works on; undo and redo restore it.
  const Selection& selection() const { return selection_; }
  void select(const Selection& selection) { selection_ = selection; }

  // Says whether the scene differs from what was saved or loaded last.
  bool modified() const;
  // Rises with every change of the scene, undo and redo included.
  uint64_t revision() const { return revision_; }
  // Rises with every change that a picture may show, but not with names and bookmarks.
  uint64_t pictureRevision() const { return pictureRevision_; }
  // Rises when nodes or copies are added, removed or reordered: indices and counts from before are then stale.
  uint64_t structureRevision() const { return structureRevision_; }

  // Default file of save(): the scene's own, or a scene file beside a model.
  std::filesystem::path usualFile() const;
  // Writes the scene with the settings that changed since it was loaded (an empty value takes the key out), and makes
  // the file the scene's. Throws SaveError; see requireOwnFile for `overwrite`, and copyModels() for `copiesModels`.
  void save(const std::filesystem::path& file, std::span<const SettingChange> settings, bool overwrite = false,
            bool copiesModels = false);
  // Returns the text that save() would write. Throws SaveError.
  std::string text(const std::filesystem::path& file, std::span<const SettingChange> settings,
                   ReadBack readBack = ReadBack::required) const;

 private:
  // Content that undo or redo restores, and the selection before and after the edit.
  struct Edit {
    std::string label;
    SceneContent content;
    Selection before;
    Selection after;
  };
  using Step = std::variant<Edit, SettingsStep>;
  static size_t bytesOf(const Step& step);
  static std::string labelOf(const Step& step);

  SceneContent& content() { return scene_; }
  const SceneContent& content() const { return scene_; }
  void recordChange(const SceneContent& before);
  void swapContent(Edit& edit);  // exchanges the edit's content with the scene's
  void record(Edit edit);
  void push(Step step);
  std::optional<SettingsStep> apply(Step& step, UndoWay way);
  // Records `edit` as a step and selects what it returns.
  Selection structural(const std::string& label, const std::function<Selection()>& edit);
  Selection add(const SceneNode& node);     // as a step
  Selection append(const SceneNode& node);  // under a free name, without a step
  void erase(const Selection& selection);

  Scene& scene_;
  Scene loaded_;  // without meshes and textures
  std::deque<Step> undo_;
  std::deque<Step> redo_;
  size_t undoBytes_ = 0;
  bool settingsStepOpen_ = false;  // the last of undo_ changes settings, and continued changes belong to it
  std::optional<Edit> gesture_;
  Selection selection_;
  SceneContent saved_;
  std::filesystem::path savedFile_;
  std::optional<std::string> savedText_;
  uint64_t revision_ = 0;
  uint64_t pictureRevision_ = 0;
  uint64_t structureRevision_ = 0;
  mutable std::optional<std::pair<uint64_t, bool>> modified_;  // revision, and modified() at that revision
};

}  // namespace speculum
