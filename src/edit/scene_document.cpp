#include "edit/scene_document.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/material_mirrors.hpp"
#include "scene/scene_loader.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Says whether the lists hold the same nodes in the same order, whose materials make mirrors of the same.
bool sameStructure(const SceneContent& a, const SceneContent& b) {
  return a.origins.objects == b.origins.objects && a.origins.lights == b.origins.lights &&
         a.origins.mirrors == b.origins.mirrors &&
         std::ranges::equal(a.objects, b.objects, [](const Object& x, const Object& y) {
           return x.mesh == y.mesh && x.copies.count == y.copies.count && x.visible == y.visible &&
                  x.mirrorsFromMaterials == y.mirrorsFromMaterials && x.mirror.has_value() == y.mirror.has_value();
         });
}

// Says whether both draw the same picture. Names of mirrors count, because their passes have them.
bool samePicture(SceneContent a, SceneContent b) {
  for (SceneContent* content : {&a, &b}) {
    content->bookmarks.clear();
    content->origins = {};
    std::ranges::for_each(content->objects, [](Object& object) { object.name.clear(); });
    std::ranges::for_each(content->lights, [](PointLight& light) { light.name.clear(); });
  }
  return a == b;
}

}  // namespace

SceneDocument::SceneDocument(Scene& scene) : scene_(scene) {
  const auto count = [](std::vector<int>& origins, size_t size) {
    origins.resize(size);
    std::iota(origins.begin(), origins.end(), 0);
  };
  count(scene.origins.objects, scene.objects.size());
  count(scene.origins.lights, scene.lights.size());
  count(scene.origins.mirrors, scene.mirrors.size());
  count(scene.origins.bookmarks, scene.bookmarks.size());
  saved_ = scene;
  static_cast<SceneContent&>(loaded_) = saved_;
  loaded_.file = scene.file;
  loaded_.text = scene.text;
  loaded_.settings = scene.settings;
  if (!isModelFile(scene.file)) {
    savedFile_ = scene.file;
    savedText_ = scene.text;
  }
}

size_t SceneDocument::bytesOf(const Step& step) {
  const Edit* edit = std::get_if<Edit>(&step);
  if (!edit) {
    return sizeof(step);
  }
  const SceneContent& content = edit->content;
  size_t bytes = sizeof(step) + content.objects.size() * (sizeof(Object) + sizeof(int)) +
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

// A step that changed a single setting is labelled with its name.
std::string SceneDocument::labelOf(const Step& step) {
  if (const Edit* edit = std::get_if<Edit>(&step)) {
    return edit->label;
  }
  const SettingsStep& settings = std::get<SettingsStep>(step);
  std::string label;
  for (const SettingField& field : settingFields()) {
    if (!sameSetting(field, settings.before, settings.after)) {
      label = label.empty() ? std::string("change ") + field.label : "change settings";
    }
  }
  return label + (settings.half < 0 ? "" : settings.half == 0 ? " of A" : " of B");
}

void SceneDocument::recordChange(const SceneContent& before) {
  placeMaterialMirrors(scene_);
  ++revision_;
  pictureRevision_ += samePicture(before, content()) ? 0 : 1;
  structureRevision_ += sameStructure(before, content()) ? 0 : 1;
}

void SceneDocument::record(Edit edit) {
  recordChange(edit.content);
  selection_ = edit.after;
  if (gesture_) {
    gesture_->label = std::move(edit.label);
    gesture_->after = edit.after;
    return;
  }
  redo_.clear();
  push(std::move(edit));
}

void SceneDocument::push(Step step) {
  settingsStepOpen_ = false;
  undoBytes_ += bytesOf(step);
  undo_.push_back(std::move(step));
  while (undo_.size() > mostSteps || (undo_.size() > 1 && undoBytes_ > mostBytes)) {
    undoBytes_ -= bytesOf(undo_.front());
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
    content() = before;
    throw;
  }
  if (content() == before) {
    return;
  }
  const Selection& selected = selection ? selection : selection_;
  record({.label = label, .content = std::move(before), .before = selected, .after = selected});
}

Selection SceneDocument::structural(const std::string& label, const std::function<Selection()>& edit) {
  Edit step{.label = label, .content = content(), .before = selection_};
  const Selection after = step.after = edit();
  record(std::move(step));
  return after;
}

Selection SceneDocument::append(const SceneNode& node) {
  Selection added{.kind = kindOf(node)};
  withNodes(content(), added.kind, [&](auto& nodes, std::vector<int>& origins) {
    auto copy = std::get<typename std::decay_t<decltype(nodes)>::value_type>(node);
    copy.name = freeName(copy.name, nodes);
    added.index = static_cast<int>(nodes.size());
    nodes.push_back(std::move(copy));
    origins.push_back(-1);
  });
  return added;
}

void SceneDocument::erase(const Selection& selection) {
  withNodes(content(), selection.kind, [&](auto& nodes, std::vector<int>& origins) {
    nodes.erase(nodes.begin() + selection.index);
    origins.erase(origins.begin() + selection.index);
  });
}

Selection SceneDocument::add(const SceneNode& node) {
  Edit step{.content = content(), .before = selection_};
  const Selection added = step.after = append(node);
  step.label = "add " + describe(scene_, added);
  record(std::move(step));
  return added;
}

std::vector<Selection> SceneDocument::duplicate(std::span<const Selection> nodes, double side) {
  std::vector<Selection> copies;
  structural("duplicate " + describe(scene_, nodes), [&] {
    for (const SceneNode& copy : copiesBeside(scene_, nodes, side)) {
      copies.push_back(append(copy));
    }
    return copies.front();
  });
  return copies;
}

void SceneDocument::remove(std::vector<Selection> nodes) {
  const std::string label = "remove " + describe(scene_, nodes);
  std::ranges::sort(nodes, std::greater<>(), &Selection::index);  // erasing the last first keeps the other indices
  structural(label, [&] {
    std::ranges::for_each(nodes, [&](const Selection& node) { erase(node); });
    return Selection();
  });
}

std::string SceneDocument::addBookmark(Bookmark bookmark) {
  bookmark.name = freeName(bookmark.name.empty() ? "view" : bookmark.name, scene_.bookmarks);
  structural("add bookmark '" + bookmark.name + "'", [&] {
    scene_.bookmarks.push_back(bookmark);
    scene_.origins.bookmarks.push_back(-1);
    return selection_;
  });
  return bookmark.name;
}

void SceneDocument::removeBookmark(size_t index) {
  structural("remove bookmark '" + scene_.bookmarks.at(index).name + "'", [&] {
    scene_.bookmarks.erase(scene_.bookmarks.begin() + index);
    scene_.origins.bookmarks.erase(scene_.origins.bookmarks.begin() + index);
    return selection_;
  });
}

void SceneDocument::settingsChanged(const Settings& before, const Settings& after, bool continued, int half) {
  if (before == after) {
    return;
  }
  redo_.clear();
  if (!continued || !settingsStepOpen_ || std::get<SettingsStep>(undo_.back()).half != half) {
    push(SettingsStep{.before = before, .after = after, .half = half});
    settingsStepOpen_ = true;
  }
  auto& step = std::get<SettingsStep>(undo_.back());
  step.after = after;
  if (step.before == after) {
    undoBytes_ -= bytesOf(undo_.back());
    undo_.pop_back();
    settingsStepOpen_ = false;
  }
}

void SceneDocument::forgetHalves() {
  const auto isOfHalf = [](const Step& step) {
    const auto* settings = std::get_if<SettingsStep>(&step);
    return settings && settings->half >= 0;
  };
  for (const Step& step : undo_) {
    undoBytes_ -= isOfHalf(step) ? bytesOf(step) : 0;
  }
  std::erase_if(undo_, isOfHalf);
  std::erase_if(redo_, isOfHalf);
  settingsStepOpen_ = false;
}

void SceneDocument::beginGesture() {
  endGesture();
  gesture_ = Edit{.content = content(), .before = selection_, .after = selection_};
}

void SceneDocument::endGesture() {
  if (std::optional<Edit> edit = std::exchange(gesture_, std::nullopt); edit && content() != edit->content) {
    redo_.clear();
    push(*std::move(edit));
  }
}

void SceneDocument::cancelGesture() {
  if (std::optional<Edit> edit = std::exchange(gesture_, std::nullopt)) {
    selection_ = edit->before;
    if (content() != edit->content) {
      swapContent(*edit);
    }
  }
}

void SceneDocument::swapContent(Edit& edit) {
  std::swap(content(), edit.content);
  recordChange(edit.content);
}

bool SceneDocument::changesScene(UndoWay way) const {
  const std::deque<Step>& steps = way == UndoWay::back ? undo_ : redo_;
  return !steps.empty() && std::holds_alternative<Edit>(steps.back());
}

std::optional<SettingsStep> SceneDocument::apply(Step& step, UndoWay way) {
  if (const auto* settings = std::get_if<SettingsStep>(&step)) {
    return *settings;
  }
  auto& edit = std::get<Edit>(step);
  swapContent(edit);
  selection_ = way == UndoWay::back ? edit.before : edit.after;
  return std::nullopt;
}

std::optional<SettingsStep> SceneDocument::undo() {
  endGesture();
  if (undo_.empty()) {
    return std::nullopt;
  }
  undoBytes_ -= bytesOf(undo_.back());
  redo_.push_back(std::move(undo_.back()));
  undo_.pop_back();
  settingsStepOpen_ = false;
  return apply(redo_.back(), UndoWay::back);
}

std::optional<SettingsStep> SceneDocument::redo() {
  endGesture();
  if (redo_.empty()) {
    return std::nullopt;
  }
  Step step = std::move(redo_.back());
  redo_.pop_back();
  const std::optional<SettingsStep> settings = apply(step, UndoWay::forward);
  push(std::move(step));
  return settings;
}

bool SceneDocument::modified() const {
  if (!modified_ || modified_->first != revision_) {
    modified_ = {revision_, content() != saved_};
  }
  return modified_->second;
}

fs::path SceneDocument::usualFile() const {
  return isModelFile(scene_.file) ? fs::path(scene_.file).replace_extension(".toml") : scene_.file;
}

std::string SceneDocument::text(const fs::path& file, std::span<const SettingChange> settings,
                                ReadBack readBack) const {
  return editedText(loaded_, content(), scene_.meshes, scene_.textures, settings, file, readBack);
}

void SceneDocument::save(const fs::path& file, std::span<const SettingChange> settings, bool overwrite,
                         bool copiesModels) {
  endGesture();
  if (isModelFile(file)) {
    throw SaveError(oneLine(file.string() + ": not saved: it is the name of a model (name a file such as " +
                            fs::path(file).replace_extension(".toml").filename().string() + ")"));
  }
  const auto requireOwn = [&] {
    if (!overwrite) {
      requireOwnFile(file, withoutLinks(file) == withoutLinks(savedFile_) ? savedText_ : std::nullopt);
    }
  };
  if (copiesModels) {
    requireOwn();  // a file that is not written gets no copies
  }
  SourceFiles sources = copiesModels ? copyModels(scene_, wholePath(file).parent_path()) : SourceFiles();
  const auto exchangeSources = [&] {
    for (size_t i = 0; i < sources.meshes.size(); ++i) {
      std::swap(scene_.meshes[i].source, sources.meshes[i]);
    }
    for (size_t i = 0; i < sources.textures.size(); ++i) {
      std::swap(scene_.textures[i].source, sources.textures[i]);
    }
  };
  std::string text;
  exchangeSources();
  try {
    text = this->text(file, settings);
    requireOwn();
    writeSceneFile(file, text);
  } catch (...) {
    exchangeSources();
    throw;
  }
  saved_ = content();
  modified_.reset();
  savedFile_ = file;
  scene_.file = file;
  scene_.settings = parseScene(file, text).settings;
  scene_.text = text;
  savedText_ = std::move(text);
}

}  // namespace speculum
