#include "edit/scene_document.hpp"

#include <algorithm>
#include <utility>

#include "frame/setting_fields.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_loader.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

size_t bytesOf(const SceneContent& content) {
  size_t bytes = sizeof(content) + content.objects.size() * (sizeof(Object) + sizeof(int)) +
                 content.lights.size() * (sizeof(PointLight) + sizeof(int)) +
                 content.mirrors.size() * (sizeof(Mirror) + sizeof(int)) +
                 content.bookmarks.size() * (sizeof(Bookmark) + sizeof(int));
  for (const Object& object : content.objects) {
    bytes += object.name.size() + object.model.size();
  }
  for (const Mirror& mirror : content.mirrors) {
    bytes += mirror.name.size() + mirror.polygon.size() * sizeof(glm::dvec3);
  }
  return bytes;
}

// Whether the lists hold the same nodes in the same order.
bool sameStructure(const SceneContent& a, const SceneContent& b) {
  return a.origins.objects == b.origins.objects && a.origins.lights == b.origins.lights &&
         a.origins.mirrors == b.origins.mirrors &&
         std::equal(
             a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(),
             [](const Object& x, const Object& y) { return x.mesh == y.mesh && x.copies.count == y.copies.count; });
}

bool sameFile(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return a == b || (!a.empty() && fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error));
}

}  // namespace

SceneDocument::SceneDocument(Scene& scene) : scene_(scene), saved_(contentOf(scene)) {
  origins_ = saved_.origins;
  loaded_ = {.file = scene.file,
             .text = scene.text,
             .title = scene.title,
             .environment = scene.environment,
             .camera = scene.camera,
             .settings = scene.settings,
             .objects = scene.objects,
             .lights = scene.lights,
             .mirrors = scene.mirrors,
             .bookmarks = scene.bookmarks};
  if (!isModelFile(scene.file)) {
    savedFile_ = scene.file;
    savedText_ = scene.text;
  }
}

SceneContent SceneDocument::content() const {
  return {.environment = scene_.environment,
          .camera = scene_.camera,
          .objects = scene_.objects,
          .lights = scene_.lights,
          .mirrors = scene_.mirrors,
          .bookmarks = scene_.bookmarks,
          .origins = origins_};
}

void SceneDocument::restore(const SceneContent& content) {
  scene_.environment = content.environment;
  scene_.camera = content.camera;
  scene_.objects = content.objects;
  scene_.lights = content.lights;
  scene_.mirrors = content.mirrors;
  scene_.bookmarks = content.bookmarks;
  origins_ = content.origins;
}

void SceneDocument::noteChange(const SceneContent& before) {
  ++revision_;
  structureRevision_ += sameStructure(before, content()) ? 0 : 1;
}

void SceneDocument::record(Step step) {
  noteChange(step.content);
  selection_ = step.after;
  if (gesture_) {
    gesture_->label = std::move(step.label);
    gesture_->after = step.after;
    return;
  }
  redo_.clear();
  push(std::move(step));
}

void SceneDocument::push(Step step) {
  step.bytes = bytesOf(step.content);
  undoBytes_ += step.bytes;
  undo_.push_back(std::move(step));
  while (undo_.size() > mostSteps || (undo_.size() > 1 && undoBytes_ > mostBytes)) {
    undoBytes_ -= undo_.front().bytes;
    undo_.pop_front();
  }
}

void SceneDocument::change(const std::string& label, const Selection& selection,
                           const std::function<void(Scene&)>& edit) {
  SceneContent before = content();
  try {
    edit(scene_);
    if (scene_.objects.size() != before.objects.size() || scene_.lights.size() != before.lights.size() ||
        scene_.mirrors.size() != before.mirrors.size() || scene_.bookmarks.size() != before.bookmarks.size()) {
      throw std::logic_error("a change of values added or removed something");
    }
  } catch (...) {
    restore(before);
    throw;
  }
  if (content() == before) {
    return;
  }
  const Selection& selected = selection ? selection : selection_;
  record({.label = label, .content = std::move(before), .before = selected, .after = selected});
}

Selection SceneDocument::structural(const std::string& label, const std::function<Selection()>& edit) {
  SceneContent before = content();
  const Selection selected = selection_;
  const Selection after = edit();
  record({.label = label, .content = std::move(before), .before = selected, .after = after});
  return after;
}

Selection SceneDocument::append(const Thing& node) {
  const auto append = [](auto& nodes, std::vector<int>& origins, auto added, Selection::Kind kind) {
    added.name = freeName(added.name, nodes);
    nodes.push_back(std::move(added));
    origins.push_back(-1);
    return Selection{.kind = kind, .index = static_cast<int>(nodes.size()) - 1};
  };
  if (const auto* object = std::get_if<Object>(&node)) {
    return append(scene_.objects, origins_.objects, *object, Selection::Kind::object);
  }
  if (const auto* light = std::get_if<PointLight>(&node)) {
    return append(scene_.lights, origins_.lights, *light, Selection::Kind::light);
  }
  return append(scene_.mirrors, origins_.mirrors, std::get<Mirror>(node), Selection::Kind::mirror);
}

void SceneDocument::erase(const Selection& selection) {
  const auto erase = [&](auto& nodes, std::vector<int>& origins) {
    nodes.erase(nodes.begin() + selection.index);
    origins.erase(origins.begin() + selection.index);
  };
  if (selection.kind == Selection::Kind::object) {
    erase(scene_.objects, origins_.objects);
  } else if (selection.kind == Selection::Kind::mirror) {
    erase(scene_.mirrors, origins_.mirrors);
  } else {
    erase(scene_.lights, origins_.lights);
  }
}

Selection SceneDocument::addMirror(const glm::dvec3& position, const glm::dvec3& viewer) {
  Mirror mirror = newMirror(position, viewer);
  mirror.name = freeName(mirror.name, scene_.mirrors);
  return structural("add mirror '" + mirror.name + "'", [&] { return append(mirror); });
}

Selection SceneDocument::addLight(const glm::dvec3& position, const glm::dvec3& viewer) {
  PointLight light = newLight(position, viewer);
  light.name = freeName(light.name, scene_.lights);
  return structural("add light '" + light.name + "'", [&] { return append(light); });
}

Selection SceneDocument::addObject(int mesh, const glm::dvec3& position) {
  Object object = newObject(scene_, mesh, position);
  object.name = freeName(object.name, scene_.objects);
  return structural("add object '" + object.name + "'", [&] { return append(object); });
}

Selection SceneDocument::duplicate(const Selection& selection) {
  return selection ? structural("duplicate " + describe(scene_, selection),
                                [&] { return append(copyBeside(scene_, selection)); })
                   : selection;
}

std::vector<Selection> SceneDocument::duplicate(std::span<const Selection> nodes) {
  std::vector<Selection> copies;
  structural("duplicate " + describe(scene_, nodes), [&] {
    for (const Thing& copy : copiesBeside(scene_, nodes)) {
      copies.push_back(append(copy));
    }
    return copies.front();
  });
  return copies;
}

void SceneDocument::remove(const Selection& selection) {
  if (selection) {
    select(selection);
    remove({&selection, 1});
  }
}

void SceneDocument::remove(std::span<const Selection> nodes) {
  std::vector<Selection> fromTheEnd(nodes.begin(), nodes.end());
  std::sort(fromTheEnd.begin(), fromTheEnd.end(),
            [](const Selection& a, const Selection& b) { return a.index > b.index; });
  structural("remove " + describe(scene_, nodes), [&] {
    for (const Selection& node : fromTheEnd) {
      erase(node);
    }
    return Selection();
  });
}

std::string SceneDocument::addBookmark(Bookmark bookmark) {
  bookmark.name = freeName(bookmark.name.empty() ? "view" : bookmark.name, scene_.bookmarks);
  structural("add bookmark '" + bookmark.name + "'", [&] {
    scene_.bookmarks.push_back(bookmark);
    origins_.bookmarks.push_back(-1);
    return selection_;
  });
  return bookmark.name;
}

void SceneDocument::removeBookmark(size_t index) {
  structural("remove bookmark '" + scene_.bookmarks.at(index).name + "'", [&] {
    scene_.bookmarks.erase(scene_.bookmarks.begin() + static_cast<std::ptrdiff_t>(index));
    origins_.bookmarks.erase(origins_.bookmarks.begin() + static_cast<std::ptrdiff_t>(index));
    return selection_;
  });
}

std::string SceneDocument::renameBookmark(size_t index, const std::string& name) {
  const std::string before = scene_.bookmarks.at(index).name;
  if (name.empty() || name == before) {
    return before;
  }
  const std::string chosen = freeName(name, scene_.bookmarks);
  change("rename bookmark '" + before + "'", {}, [&](Scene& scene) { scene.bookmarks[index].name = chosen; });
  return chosen;
}

void SceneDocument::beginGesture() {
  endGesture();
  gesture_ = Step{.content = content(), .before = selection_, .after = selection_};
}

void SceneDocument::endGesture() {
  if (!gesture_) {
    return;
  }
  Step step = *std::exchange(gesture_, std::nullopt);
  if (content() == step.content) {
    return;
  }
  redo_.clear();
  push(std::move(step));
}

void SceneDocument::cancelGesture() {
  if (!gesture_) {
    return;
  }
  const Step step = *std::exchange(gesture_, std::nullopt);
  const SceneContent now = content();
  selection_ = step.before;
  if (!(now == step.content)) {
    restore(step.content);
    noteChange(now);
  }
}

void SceneDocument::undo() {
  endGesture();
  if (undo_.empty()) {
    return;
  }
  Step step = std::move(undo_.back());
  undo_.pop_back();
  undoBytes_ -= step.bytes;
  SceneContent now = content();
  restore(step.content);
  noteChange(now);
  selection_ = step.before;
  step.content = std::move(now);
  redo_.push_back(std::move(step));
}

void SceneDocument::redo() {
  endGesture();
  if (redo_.empty()) {
    return;
  }
  Step step = std::move(redo_.back());
  redo_.pop_back();
  SceneContent now = content();
  restore(step.content);
  noteChange(now);
  selection_ = step.after;
  step.content = std::move(now);
  push(std::move(step));
}

bool SceneDocument::modified() const {
  if (!modified_ || modified_->first != revision_) {
    modified_ = {revision_, !(content() == saved_)};
  }
  return modified_->second;
}

fs::path SceneDocument::usualFile() const {
  return isModelFile(scene_.file) ? fs::path(scene_.file).replace_extension(".toml") : scene_.file;
}

std::string SceneDocument::text(const fs::path& file, std::span<const SavedSetting> settings) const {
  return editedText(loaded_, content(), scene_.meshes, settings, file);
}

void SceneDocument::save(const fs::path& file, std::span<const SavedSetting> settings, bool overwrite) {
  endGesture();
  if (isModelFile(file)) {
    throw SaveError(oneLine(file.string() + ": not saved: it is the name of a model (name a file such as " +
                            fs::path(file).replace_extension(".toml").filename().string() + ")"));
  }
  std::string text = this->text(file, settings);
  writeSceneFile(file, text, sameFile(file, savedFile_) ? savedText_ : std::nullopt, overwrite);
  saved_ = content();
  modified_.reset();
  savedFile_ = file;
  scene_.file = file;
  scene_.settings = parseScene(file, text).settings;
  scene_.text = text;
  savedText_ = std::move(text);
}

std::vector<SavedSetting> settingChanges(const Settings& from, const Settings& to) {
  std::vector<SavedSetting> changes;
  for (const SettingField& field : settingFields()) {
    std::string value = settingValue(to, field.key);
    if (settingValue(from, field.key) != value) {
      changes.push_back({std::string(field.key), std::move(value)});
    }
  }
  return changes;
}

}  // namespace speculum
