#include "window/workspace.hpp"

#include "scene/model_files.hpp"
#include "session/options.hpp"
#include "window/pace.hpp"

namespace speculum {

namespace fs = std::filesystem;

Workspace::Workspace(const Options& options, WorkspaceHost& host)
    : options_(options),
      host_(host),
      logCapture_(captureLog(log_)),
      loaded_(std::make_unique<LoadedScene>(loadSceneWithSettings(options))),
      shippedModels_(SceneBrowser::shippedModels()),
      settings_(options, *loaded_, status_),
      opener_(options, settings_.ofScene()) {
  browser().list(loaded_->scene.file);
  startDocument();
  if (options.frames == 0) {
    opener_.beginSession();
  }
}

void Workspace::startDocument() {
  // A scene that is being traced in the background must not change meanwhile.
  auto document = std::make_unique<SceneDocument>(loaded_->scene);
  auto editor =
      std::make_unique<SceneEditor>(*document, shippedModels_, [this] { settings_.accuracy().forgetScene(); });
  saving_ = std::make_unique<DocumentController>(*loaded_, *document, *editor, options_.frames == 0);
  editor_ = std::move(editor);
  document_ = std::move(document);
  opener_.setDocument(*document_, *saving_);
  pointer_.cancel();
  settings_.setDocument(*document_, loaded_->settings);
  view_.camera.sceneChanged(scene());
  std::ranges::for_each(reports_, &FrameReport::clear);
  shownStructure_ = document_->structureRevision();
  edit_ = {};
  saving_->fill(edit_, settings_.ofScene());
}

void Workspace::apply(const Command& command) {
  std::visit(Overloaded{
                 [&](const ResetCamera&) { view_.camera.reset(scene().camera); },
                 [&](const ToggleCameraMode&) { view_.camera.toggleMode(); },
                 [&](const SetCameraMode& c) { view_.camera.setMode(c.mode); },
                 [&](const FrameSelection&) { frame(document_->selection()); },
                 [&](const LookFromMirror& c) {
                   status_.set(view_.lookFromMirror(scene(), c.side, document_->selection(), report().shown().passes,
                                                    host_.pictureSize()));
                 },
                 [&](const AddBookmark&) {
                   editor_->addBookmark(view_.bookmark(scene()));
                   view_.camera.setBookmark(static_cast<int>(scene().bookmarks.size()) - 1);
                   status_.set("Added bookmark '" + scene().bookmarks.back().name + "'. Shift+M goes to the next one.");
                 },
                 [&](const GoToBookmark& c) { view_.camera.goToBookmark(c.index, scene()); },
                 [&](const GoToNextBookmark&) { view_.camera.goToNextBookmark(scene()); },
                 [&](const RemoveBookmark& c) { editor_->removeBookmark(c.index); },
                 [&](const Seek& c) { view_.playback.seek(c.seconds); },
                 [&](const StepTime& c) { view_.playback.step(c.steps); },
                 [&](const SetPaused& c) { view_.playback.setPaused(c.paused); },
                 [&](const TogglePaused&) { view_.playback.setPaused(!view_.playback.shown().paused); },
                 [&](const SetTimeSpeed& c) { view_.playback.setSpeed(c.factor); },
                 [&](const MultiplyTimeSpeed& c) { view_.playback.setSpeed(c.factor * view_.playback.shown().speed); },
                 [&](const SetSettings& c) { settings_.set(c.settings, c.continued); },
                 [&](const ResetSettings&) { settings_.set(loaded_->settings); },
                 [&](const ToggleSplit& c) { toggleSplit(c.start); },
                 [&](const ChooseHalf& c) { settings_.chooseHalf(c.half); },
                 [&](const ChooseOtherHalf&) { settings_.chooseHalf(1 - split().chosen()); },
                 [&](const MoveDivider& c) { split().moveDivider(c.share); },
                 [&](const KeepHalf&) { settings_.keepHalf(); },
                 [&](const NewScene&) { opener_.open({SceneBrowser::newScene()}); },
                 [&](const AskWhatToOpen&) { opener_.ask(); },
                 [&](const AskWhatToAdd&) { opener_.ask(Prompt::addObject); },
                 [&](const OpenScene& c) { opener_.open(c); },
                 [&](const OpenDropped& c) { opener_.openDropped(c.files); },
                 [&](const CancelLoading&) { opener_.cancelLoading(); },
                 [&](const Save&) { resume(saving_->save(settings_.ofScene())); },
                 [&](const AskWhereToSave&) { saving_->askWhere(); },
                 [&](const SaveAs& c) { resume(saving_->saveAs(c.file, settings_.ofScene(), c.copyModels)); },
                 [&](const DiscardChanges&) { resume(opener_.discard()); },
                 [&](const CancelPrompt&) { opener_.cancelPrompt(); },
                 [&](const Quit&) {
                   if (opener_.confirmQuit()) {
                     host_.close();
                   }
                 },
                 [&](const SelectNode& c) {
                   editor_->select(c.node);
                   if (c.inspect) {
                     host_.openInspector();
                   }
                 },
                 [&](const ToggleNode& c) { editor_->toggle(c.node); },
                 [&](const SelectNext& c) {
                   editor_->selectNext(c.step);
                   host_.openInspector();
                 },
                 [&](const SetGizmoMode& c) { editor_->setMode(c.mode); },
                 [&](const NextGizmoMode&) { editor_->nextMode(); },
                 [&](const EditNode& c) { editor_->edit(c.target, c.node, c.continued); },
                 [&](const EditCamera& c) {
                   editor_->editCamera(c.camera, c.continued);
                   view_.camera.reset(scene().camera);
                 },
                 [&](const TakeView&) { apply(EditCamera{cameraOf(view_.bookmark(scene()), scene().camera)}); },
                 [&](const EndEdit&) { editor_->endEdit(); },
                 [&](const AddMirror&) { addNode(&SceneEditor::addMirror); },
                 [&](const AddLight&) { addNode(&SceneEditor::addLight); },
                 [&](const AddObject& c) { addObject(c.model); },
                 [&](const DuplicateSelected&) {
                   if (const auto view = pointedScene(time()); view && document_->selection()) {
                     editor_->duplicate(*view, host_.freePicture());
                     reportAdded();
                   }
                 },
                 [&](const RemoveSelected&) {
                   if (const std::string removed = editor_->remove(); !removed.empty()) {
                     status_.set("Deleted " + removed + ". Ctrl+Z takes this back.");
                   }
                 },
                 [&](const Undo&) { step(UndoWay::back); },
                 [&](const Redo&) { step(UndoWay::forward); },
                 [&](const MeasureAccuracy&) { measureAccuracy(); },
                 [&](const CancelMeasurement&) { accuracy().cancel(); },
                 [&](const ApplyPoint& c) {
                   settings_.applyPoint(c.point);
                   status_.set("Shows the picked point as it was measured: one picture, not the mean of several.");
                 },
                 [&](const TakeScreenshot& c) { capture_.takeScreenshot(c.withPanel); },
                 [&](const ToggleRecording& c) {
                   if (const auto message = capture_.toggleRecording(scene().file.stem().string(), c.withPanel)) {
                     status_.set(*message);
                   }
                 },
                 [&](const CopyCommandLine&) { copyCommandLine(); },
                 [&](const CopyText& c) { host_.setClipboard(c.text); },
                 [&](const SetPresentMode& c) { host_.setPresentMode(c.index); },
                 [&](const ToggleFullScreen&) { host_.toggleFullScreen(); },
                 [&](const TogglePanel&) {
                   host_.togglePanels();
                   if (!host_.showsPanels()) {
                     status_.show("Panels hidden. Tab shows them again.", [this] { return !host_.showsPanels(); });
                   }
                 },
                 [&](const ToggleHelp&) { host_.toggleHelp(); },
                 [&](const ToggleInspector&) { host_.toggleInspector(); },
                 [&](const Escape&) { escape(); },
                 [&](const PauseHistory& c) { report().history().setPaused(c.paused); },
                 [&](const ClearHistory&) { report().history().clear(); },
                 [&](const DismissMessage&) { dismissMessage(); },
                 [&](const ClearLog&) { log_.clear(); },
             },
             command);
}

void Workspace::pointerButton(const MouseButtonEvent& event, bool overPanels) {
  const bool clicked = pointer_.button(event, overPanels, *editor_, pointedScene(time()));
  if (!clicked || !document_->selection()) {
    return;
  }
  const bool covers = host_.inspectorCovers(pointer_.position());
  const Selection node = document_->selection();
  status_.set("Selected " + describe(scene(), node) + ". Drag its handles (G: move, rotate, scale)." +
                  (editor_->selectedInMirror() ? " A click at the same place selects the mirror that shows it." : "") +
                  (covers ? " F2 opens the inspector." : ""),
              [this, node] { return sameNode(document_->selection(), node); });
  if (!covers) {
    host_.openInspector();
  }
}

void Workspace::pointerMoved(const glm::dvec2& position, const glm::dvec2& windowSize, bool snap) {
  const glm::dvec2 pixelsPerUnit = glm::dvec2(host_.pictureSize()) / glm::max(windowSize, 1.0);
  pointer_.move(position, pixelsPerUnit, windowSize.y, snap, *editor_, view_.camera);
}

double Workspace::frameSeconds(double seconds) const {
  return capture_.recording() ? 1.0 / Capture::framesPerSecond : seconds;
}

// Returns nothing while the window has no pixels.
std::optional<PointedScene> Workspace::pointedScene(double time) {
  const glm::ivec2 size = host_.pictureSize();
  if (size.x == 0 || size.y == 0) {
    return std::nullopt;
  }
  SceneState shown = state(time);
  const PictureView picture(shown.camera, size.x, size.y);
  const int half = split().on() ? split().halfAt(pointer_.pixel().x / size.x) : 0;
  const ReflectionSettings reflection = shownSettings(half).reflection;
  return PointedScene{
      .state = std::move(shown),
      .picture = picture,
      .limits = {reflection.maxDepth, reflection.minThroughput, reports_[static_cast<size_t>(half)].skipped()},
      .scale = host_.contentScale()};
}

void Workspace::prepareView(double seconds, bool pointerOverPicture) {
  saving_->fill(edit_, settings_.ofScene());
  const std::string title = (capture_.recording() ? "Recording, F10 stops - " : "") + scene().file.stem().string() +
                            (edit_.unsaved ? "* - Speculum" : " - Speculum");
  if (title_ != title) {
    host_.setTitle(title_ = title);
  }
  edit_.overlay = {};
  if (edit_.selected) {
    if (const auto view = pointedScene(view_.playback.after(seconds))) {
      const bool points = pointerOverPicture && !pointer_.dragging();
      edit_.overlay = editor_->overlay(*view, points ? std::optional(pointer_.pixel()) : std::nullopt);
    }
  }
  view_.camera.bookmarksChanged(scene());
  status_.update(capture_.wanted() && !capture_.hidesPanels());
}

UiInput Workspace::shown(const ShownDevice& device, const std::string& message) const {
  return {.frame = reports_[static_cast<size_t>(shownHalf())].shown(),
          .device = device,
          .browser = opener_.browser().shown(),
          .settings = settings(),
          .sceneSettings = loaded_->settings,
          .camera = view_.camera.shown(),
          .playback = view_.playback.shown(),
          .edit = edit_,
          .accuracy = settings_.accuracy().shown(),
          .split = settings_.split().shown(),
          .status = status_.shown(),
          .log = log_,
          .message = message,
          .recording = capture_.recording()};
}

void Workspace::update() {
  takeSceneChange();
  if (prompting() && capture_.hidesPanels()) {
    apply(ToggleRecording{});  // nobody would see the prompt
  }
  if (std::unique_ptr<LoadedScene> loaded = opener_.update()) {
    showScene(std::move(loaded));
  }
  // Warnings wait while a scene is read, because they may be about that scene.
  const std::string warning = browser().busy() ? std::string() : log_.takeProblem();
  if (!warning.empty() && !problem().starts_with(warning)) {
    status_.warn(warning);
  }
  settings_.update();
}

// Drops cached images of the old scene that content comparison does not cover: those reused by an interval, and those
// of mirrors whose indices changed. Also drops figures that would hide what the new scene costs; the figures of a drag
// stay together, because a drag changes costs little by little.
void Workspace::takeSceneChange() {
  if (!editor_->changedSinceLastCall()) {
    return;
  }
  if (!editor_->dragging()) {
    std::ranges::for_each(reports_, [](FrameReport& report) { report.history().restart(); });
  }
  const auto interval = [this](int half) {
    const Settings shown = shownSettings(half);
    return mostAsked(scene(), shown).updateInterval > 1 || shown.effects.environmentInterval > 1;
  };
  const uint64_t structure = document_->structureRevision();
  const bool restructured = std::exchange(shownStructure_, structure) != structure;
  if (restructured || interval(0) || interval(1)) {
    host_.dropCachedImages();
  }
}

void Workspace::frameDrawn(const ShownPicture& shown, const std::function<Image8()>& radiance, const Image8* captured,
                           int half) {
  if (captured) {
    const bool waits = animated() && !animates();
    const auto [text, logged] = capture_.save(scene().file.stem().string(), *captured, progress_, waits);
    logged ? status_.set(text) : status_.show(text);
  }
  if (half == shownHalf()) {
    accuracy().afterFrame(shown, watchedState(shown.state), radiance);
  }
  if (radiance && needsThumbnail() && !split().on() && std::exchange(needsThumbnail_, false)) {
    browser().storeThumbnail(radiance);
  }
  tookBack_ = false;
}

void Workspace::showScene(std::unique_ptr<LoadedScene> scene) {
  accuracy().setProblem("");  // the problem was one of the last scene
  accuracy().forgetScene("Another scene was opened");
  std::swap(loaded_, scene);
  try {
    host_.useScene(loaded_->scene);
  } catch (const std::exception& error) {
    opener_.setProblem(loaded_->scene.file.string() + ": " + error.what());
    std::swap(loaded_, scene);
    saving_->forgetDiscard();
    return host_.useScene(loaded_->scene);
  }
  startDocument();
  needsThumbnail_ = true;
  status_.sceneChanged();
  view_.playback.sceneChanged();
  if (isModelFile(loaded_->scene.file)) {
    frame({.kind = Selection::Kind::object, .index = 0});
  }
  browser().show(loaded_->scene.file, true);
  if (opener_.lesson()) {
    beginLesson(*opener_.lesson());
  }
}

void Workspace::addNode(void (SceneEditor::*add)(const PointedScene&)) {
  if (const std::optional<PointedScene> view = pointedScene(time())) {
    ((*editor_).*add)(*view);
    reportAdded();
  }
}

// Adds an object. Loads the model first if the scene does not have it; if that fails, the scene stays as it was.
void Workspace::addObject(const fs::path& model) {
  const std::optional<PointedScene> view = pointedScene(time());
  if (!view) {
    return;
  }
  Scene& scene = loaded_->scene;
  const auto meshes = static_cast<std::ptrdiff_t>(scene.meshes.size());
  const auto textures = static_cast<std::ptrdiff_t>(scene.textures.size());
  const auto grown = [&] { return static_cast<std::ptrdiff_t>(scene.meshes.size()) > meshes; };
  saving_->closeOpenPrompt();
  saving_->setNote("");
  try {
    const fs::path file = editor_->modelFile(model);
    accuracy().forgetScene();
    const int mesh = addModel(scene, file);
    if (grown()) {
      useModels();
    }
    editor_->addObject(*view, mesh);
    reportAdded();
  } catch (const std::exception& error) {
    saving_->setNote(error.what());
    status_.set(error.what());
    if (grown()) {
      scene.meshes.erase(scene.meshes.begin() + meshes, scene.meshes.end());
      scene.textures.erase(scene.textures.begin() + textures, scene.textures.end());
      useModels();
    }
  }
}

void Workspace::reportAdded() {
  status_.set("Added " + describe(scene(), editor_->selected()) + ". The inspector (F2) changes it.");
}

void Workspace::useModels() {
  host_.useScene(scene());
  editor_->modelsChanged();
}

void Workspace::resume(const std::optional<Command>& afterPrompt) {
  if (saving_->savedSinceLastCall()) {
    opener_.setProblem("");
    status_.set(saving_->note());
    opener_.forgetSaved();
    needsThumbnail_ = true;
    browser().show(scene().file, false);
  }
  if (afterPrompt) {
    apply(*afterPrompt);
  }
}

// Ends one thing at a time: drag, menu or list of keys, selection, A | B, message. Panels stay.
void Workspace::escape() {
  if (editor_->dragging()) {
    return editor_->cancelDrag();
  }
  if (!host_.closePopup()) {
    document_->selection() ? editor_->select({}) : split().on() ? settings_.endSplit() : dismissMessage();
  }
}

// Messages about shaders and memory stay until their cause is gone. The panels' button hides such a message, Escape
// does not.
void Workspace::dismissMessage() {
  opener_.setProblem("");
  status_.clear();
}

void Workspace::toggleSplit(SplitStart start) {
  if (settings_.toggleSplit(start, middleOfFreePicture())) {
    reports_[1] = {};
  }
}

void Workspace::beginLesson(size_t index) {
  const Lesson& lesson = split().lessons()[index];
  if (lesson.camera) {
    view_.camera.goTo(*lesson.camera, scene());
  }
  view_.playback.seek(lesson.time);
  view_.playback.hold();
  host_.closeSidePanels();
  // Until the next frame freePicture() lacks the room of these panels.
  const double left = static_cast<double>(host_.freePicture().x) / std::max(host_.pictureSize().x, 1);
  settings_.beginLesson(index, loaded_->settings, 0.5 * (left + 1.0));
  reports_[1] = {};
}

double Workspace::middleOfFreePicture() const {
  const PixelRect free = host_.freePicture();
  return (free.x + 0.5 * free.width) / std::max(host_.pictureSize().x, 1);
}

void Workspace::step(UndoWay way) {
  editor_->release();
  editor_->endEdit();
  const bool back = way == UndoWay::back;
  const std::string step = back ? document_->undoLabel() : document_->redoLabel();
  const CameraSpec camera = scene().camera;
  const bool hidden = settings_.follow(editor_->step(way), back);
  if (scene().camera != camera) {
    view_.camera.reset(scene().camera);
  }
  status_.set(step.empty() ? (back ? "Nothing to undo" : "Nothing to redo")
                           : (back ? "Undone: " : "Redone: ") + step +
                                 (hidden ? " (of the scene; A | B keeps its own settings)" : ""));
}

void Workspace::frame(const Selection& node) {
  view_.frame(scene(), node, host_.pictureSize(), host_.freePicture());
}

// Returns the options that draw the present view of the scene in `file`.
Options Workspace::shownOptions(const fs::path& file) {
  Options options = options_;
  const glm::ivec2 size = host_.pictureSize();
  options.scene = file.string();
  options.size = {size.x, size.y};
  options.time = time();
  return options;
}

void Workspace::copyCommandLine() {
  try {
    const fs::path file = saving_->savedOrCopy(loaded_->settings);
    Options options = shownOptions(file);
    if (view_.camera.moved()) {
      options.camera = view_.bookmark(scene());
    }
    const Settings shown = shownSettings(shownHalf());
    const std::string command = viewCommand(options, file, scene(), withPictures(shown, stillPictures(shown)));
    host_.setClipboard(command);
    const bool copy = file != scene().file;
    status_.set("Copied: " + command + (copy ? "   (of a copy of the scene: it has unsaved changes)" : ""));
  } catch (const std::runtime_error& error) {
    status_.set("Not copied: " + std::string(error.what()));
  }
}

void Workspace::measureAccuracy() {
  try {
    const SceneState shown = state(time());
    SweepRequest request{
        .options = shownOptions(saving_->savedOrCopy(loaded_->settings)), .base = settings(), .camera = shown.camera};
    request.options.gpu = host_.gpu();
    accuracy().measure(std::move(request), watchedState(shown));
  } catch (const std::runtime_error& error) {
    accuracy().setProblem(error.what());
  }
}

bool Workspace::undoFailedChange(const std::string& why) {
  editor_->release();
  editor_->endEdit();
  if (split().on()) {
    settings_.endSplit();
    opener_.setProblem("A | B has ended: " + why);
    return true;
  }
  const std::string label = document_->undoLabel();
  if (std::exchange(tookBack_, !label.empty())) {
    step(UndoWay::forward);  // the undone step was not the cause
    tookBack_ = false;
    return false;
  }
  if (label.empty()) {
    return false;
  }
  step(UndoWay::back);
  opener_.setProblem("Cannot " + label + ": " + why);
  return true;
}

}  // namespace speculum
