// The part of the window that edits the scene: what pointer and keys do to it, and saving.
#include <algorithm>
#include <utility>

#include "app/demo.hpp"
#include "edit/save_place.hpp"
#include "platform/files.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace {

constexpr double clickPixels = 4.0;  // screen coordinates that the pointer may move by between press and release

// Whether the file is one of those that come with the program.
bool isShipped(const std::filesystem::path& file) {
  std::error_code none;
  const std::filesystem::path below = std::filesystem::relative(file, dataDirectory("scenes"), none);
  return !below.empty() && *below.begin() != "..";
}

// Where scenes are saved unless a person names another place; made when it is needed.
std::filesystem::path ownFolder() {
  return documentsDir() / "Speculum";
}

}  // namespace

void Demo::startEditing() {
  // A scene that is being traced in the background must not change meanwhile.
  editor_ = std::make_unique<SceneEditor>(loaded_->scene, shippedModels_, [this] { accuracy_.forgetScene(model_); });
  skipped_.clear();
  nextFile_.reset();
  pressed_.reset();
  dragging_ = false;
  refused_.clear();
  model_.edit.note.clear();
  model_.edit.asksSave = false;
  model_.edit.asksWhere = false;
  // What the panel has of the scene before must not be taken up for this one.
  editor_->show(model_.edit);
  model_.edit.edited = false;
  model_.edit.held = false;
  model_.edit.action = EditAction::none;
  settingsAtLoad_ = loaded_->settings;
  model_.bookmark = -1;
  model_.bookmarks.clear();
  shownStructure_ = editor_->document().structureRevision();
}

// Takes the scene as the window shows it at `time`; false while the window has no pixels.
bool Demo::lookAtScene(double time) {
  const VkExtent2D extent = renderer_.displayExtent();
  if (extent.width == 0 || extent.height == 0) {
    return false;
  }
  look_ = evaluate(loaded_->scene, time);
  look_.camera = camera_.pose(look_.camera);
  return true;
}

SceneEditor::Look Demo::look() const {
  const VkExtent2D extent = renderer_.displayExtent();
  const ReflectionSettings& r = model_.settings.reflection;
  return {.state = look_,
          .picture = PictureView(look_.camera, static_cast<int>(extent.width), static_cast<int>(extent.height)),
          .limits = {r.maxDepth, r.minThroughput, skipped_},
          .scale = window_.contentScale()};
}

glm::dvec2 Demo::pointerPixel() const {
  const VkExtent2D size = window_.size();
  const VkExtent2D extent = renderer_.displayExtent();
  return glm::dvec2(cursorX_, cursorY_) * glm::dvec2(extent.width, extent.height) /
         glm::max(glm::dvec2(size.width, size.height), 1.0);
}

void Demo::pressPointer(const MouseButtonEvent& event) {
  if (!editor_) {
    return;
  }
  // Another button while one is held belongs to nothing.
  if (pressed_ ? event.button != pressedButton_ : !event.pressed) {
    return;
  }
  const bool left = event.button == MouseButton::left;
  if (event.pressed) {
    holdsHandle_ = holdsHandle_ && editor_->dragging();
    if (ui_ && !ui_->takesPointer(cursorX_, cursorY_) && !editor_->dragging()) {
      pressed_ = {cursorX_, cursorY_};
      pressedButton_ = event.button;
      pressedShift_ = event.shift;
      if (left && lookAtScene(time_)) {
        holdsHandle_ = editor_->press(look(), pointerPixel());
      }
    }
    return;
  }
  if (left && editor_->dragging() && dragging_) {
    editor_->release();
  } else if (left && pressed_ && !dragging_ && lookAtScene(time_)) {
    editor_->cancelDrag();
    pressedShift_ ? editor_->clickAlso(look(), pointerPixel()) : editor_->click(look(), pointerPixel());
    model_.edit.open = model_.edit.open || editor_->document().selection();
  }
  pressed_.reset();
  dragging_ = false;
}

void Demo::movePointer(double x, double y) {
  const glm::dvec2 from = pressed_ && !dragging_ ? *pressed_ : glm::dvec2(cursorX_, cursorY_);
  cursorX_ = x;
  cursorY_ = y;
  dragging_ = dragging_ || (pressed_ && glm::distance(*pressed_, glm::dvec2(x, y)) > clickPixels);
  if (!dragging_) {
    return;
  }
  if (holdsHandle_) {
    editor_->drag(pointerPixel(), window_.keyDown(Key::leftControl) || window_.keyDown(Key::rightControl));
  } else if (pressedButton_ == MouseButton::left) {
    camera_.drag(x - from.x, y - from.y);
  } else {
    camera_.pan(x - from.x, y - from.y, window_.size().height);
  }
}

// True if nothing else is to be done with the key: while a question is open, all of them.
bool Demo::handleQuestionKey(const KeyEvent& event) {
  if (!model_.edit.asksSave && !model_.edit.asksWhere) {
    return false;
  }
  if (event.key == Key::escape) {
    answer(EditAction::stay);
  }
  return true;
}

bool Demo::handleEditKey(const KeyEvent& event) {
  if (event.control) {
    return handleControlKey(event);
  }
  if (event.repeat && event.key != Key::n) {
    return false;
  }
  switch (event.key) {
    case Key::g:
      return editor_->toggleMode(), true;
    case Key::n:
      editor_->selectNext(event.shift ? -1 : 1);
      return model_.edit.open = true;
    case Key::f2:
      model_.edit.open = !model_.edit.open;
      model_.edit.focus = model_.edit.open;
      ui_->setVisible(ui_->visible() || model_.edit.open);
      return true;
    case Key::del:
      return editor_->remove(), true;
    case Key::escape:
      return closeTop(), true;
    default:
      return false;
  }
}

bool Demo::handleControlKey(const KeyEvent& event) {
  switch (event.key) {
    case Key::z:
      return event.shift ? redo() : undo(), true;
    case Key::y:
      return redo(), true;
    case Key::d:
      return event.repeat ? void() : editor_->duplicate(), true;
    case Key::s:
      return event.shift ? askWhere() : saveScene(), true;
    default:
      return false;
  }
}

// As the frame that is drawn next shows it.
void Demo::showEdit(double seconds) {
  editor_->show(model_.edit);
  model_.edit.unsavedSettings = model_.edit.open && settingsChanged();
  const double next = time_ + (model_.paused ? 0.0 : seconds * model_.timeSpeed);
  if (editor_->document().selection() && lookAtScene(next)) {
    const bool over = !ui_->takesPointer(cursorX_, cursorY_) && !dragging_;
    model_.edit.overlay = editor_->overlay(look(), over ? std::optional(pointerPixel()) : std::nullopt);
  }
}

void Demo::applyEdit() {
  editor_->apply(model_.edit);
  actOn(model_.edit.action);
  if (editor_->takeChanged()) {
    // Images that are held whatever they show would show what was, and that of another mirror if places changed.
    // Others are compared with all that they show.
    const uint64_t structure = editor_->document().structureRevision();
    if (model_.settings.reflection.updateInterval > 1 || model_.settings.effects.environmentInterval > 1 ||
        std::exchange(shownStructure_, structure) != structure) {
      sceneRenderer_->restart();
    }
    if (model_.accuracy.showDifference) {
      sceneRenderer_->setCover({});
    }
  }
}

// Whether saving would change them in the file.
bool Demo::settingsChanged() const {
  return settingsKey(model_.settings) != settingsKey(loaded_->settings);
}

void Demo::actOn(EditAction action) {
  switch (action) {
    case EditAction::addObject:
      return addObject();
    case EditAction::addLight:
    case EditAction::addMirror:
      if (lookAtScene(time_)) {
        editor_->add(look(), action, -1);
      }
      return;
    case EditAction::duplicate:
      return editor_->duplicate();
    case EditAction::remove:
      return editor_->remove();
    case EditAction::lookOut:
      return lookFromMirror(CameraController::MirrorSide::front);
    case EditAction::lookBehind:
      return lookFromMirror(CameraController::MirrorSide::back);
    case EditAction::undo:
      return undo();
    case EditAction::redo:
      return redo();
    default:
      return answer(action);
  }
}

void Demo::undo() {
  const std::string what = editor_->document().undoLabel();
  editor_->undo();
  tell(what.empty() ? "nothing to undo" : "undone: " + what);
}

void Demo::redo() {
  const std::string what = editor_->document().redoLabel();
  editor_->redo();
  tell(what.empty() ? "nothing to redo" : "redone: " + what);
}

void Demo::answer(EditAction action) {
  switch (action) {
    case EditAction::save:
      model_.edit.asksSave = false;
      return saveScene();
    case EditAction::askWhere:
      model_.edit.asksSave = false;
      return askWhere();
    case EditAction::saveAs:
      if (saveSceneTo(model_.edit.saveAs)) {
        model_.edit.asksWhere = false;
        goOn();
      }
      return;
    case EditAction::discard:
      model_.edit.asksSave = false;
      return goOn();
    case EditAction::stay:
      model_.edit.asksSave = false;
      model_.edit.asksWhere = false;
      closing_ = false;
      nextFile_.reset();
      refused_.clear();
      if (load_.hasResult()) {
        load_.cancel();
      }
      return;
    default:
      return;
  }
}

// Into its own file; one that comes with the program is not overwritten unasked.
void Demo::saveScene() {
  editor_->release();
  const std::filesystem::path file = editor_->document().usualFile();
  if (isShipped(file) || !isWritable(file)) {
    return askWhere();
  }
  if (saveSceneTo(file)) {
    return goOn();
  }
  const std::string why = model_.edit.note;
  askWhere();
  model_.edit.note = why;
}

void Demo::askWhere() {
  const std::filesystem::path file = editor_->document().usualFile();
  model_.edit.note.clear();
  const bool usual = isWritable(file) && !isShipped(file);
  model_.edit.saveAs = (usual ? file : ownFolder() / file.filename()).string();
  model_.edit.asksWhere = true;
}

bool Demo::saveSceneTo(const std::filesystem::path& named) {
  std::filesystem::path file = named;
  try {
    file = sceneFileNamed(named);
    if (file.parent_path() == ownFolder()) {
      std::error_code none;
      std::filesystem::create_directories(ownFolder(), none);
    }
    requireFolder(file);
    if (isShipped(file) && file != refused_) {
      throw SaveError(file.string() + ": not saved: it comes with the program");
    }
    editor_->document().save(file, settingChanges(settingsAtLoad_, model_.settings), file == refused_);
    model_.edit.note = "saved " + file.string();
    tell(model_.edit.note);
    shownScene_ = static_cast<int>(noteSceneFile(file));
    model_.scene = shownScene_;
    loaded_->settings = model_.settings;
    model_.sceneSettings = model_.settings;
    refused_.clear();
    return true;
  } catch (const SaveError& error) {
    std::error_code none;
    const bool overwritable = file.extension() == ".toml" && std::filesystem::is_regular_file(file, none);
    model_.edit.note = error.what();
    model_.edit.note += overwritable ? "\nSave once more to overwrite it." : "";
    refused_ = overwritable ? file : std::filesystem::path();
    return false;
  }
}

}  // namespace speculum
