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

// Whether the same things stand at the same places of the lists.
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
