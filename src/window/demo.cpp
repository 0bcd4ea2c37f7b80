#include "window/demo.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <utility>

#include "image/color.hpp"
#include "plan/picture_tiles.hpp"
#include "platform/machine.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "ui/input_map.hpp"
#include "window/shown_device.hpp"

namespace speculum {

namespace {

constexpr double longestStep = 0.1;  // seconds of animation in a frame, however long the program was held up
constexpr double idleSeconds = 0.1;  // interval at which an idle window polls for changes
constexpr int timedInterval = 16;    // interval in frames: timing each pass slows a frame

double milliseconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

}  // namespace

Demo::Demo(const Options& options)
    : options_(options),
      workspace_(options, *this),
      window_({.title = "Speculum", .width = options.size.width, .height = options.size.height}),
      device_(deviceOptions(options, &window_)),
      renderer_(device_, rendererOptions(options, &window_)),
      sceneRenderer_(std::make_unique<SceneRenderer>(renderer_, workspace_.scene())),
      planner_(device_, true),
      pace_(device_.info().isCpu(), device_.caps().sampleCounts),
      refreshHz_(window_.refreshRate()),
      deviceView_(shownDevice(renderer_, device_)),
      last_(Clock::now()) {
  applyDebugSettings(workspace_.settings(), device_);
  shownFile_ = workspace_.scene().file;
  ui_ = std::make_unique<SimpleUI>(renderer_, window_);
  window_.setListener([this](const InputEvent& event) { takeInput(event); });
  scenesListed();
}

bool Demo::step() {
  // Every exception of a frame comes here, so that unsaved changes are kept before the program ends.
  try {
    const bool open = stepOnce();
    if (open) {
      workspace_.keepChanges(Clock::now());
    }
    return open;
  } catch (...) {
    workspace_.keepUnsavedWork();
    throw;
  }
}

bool Demo::stepOnce() {
  if (pace_.drawsTiles()) {
    renderer_.waitIdle();
  } else if (pacer_.due()) {
    renderer_.waitForFrame();  // first, so that the events of this frame are as new as possible
  }
  window_.pollEvents();
  takeGamepad();
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  if (window_.paused()) {
    window_.waitEvents(idleSeconds);
    return !shouldClose();
  }
  const bool changes = changing();
  const bool changed = std::exchange(changes_, changes);
  changeBegins_ = changes && !changed;
  if (changes || pace_.wantsFrame()) {
    Settings shown = workspace_.settings();
    shown.reflection = mostAsked(workspace_.scene(), shown);
    pacer_.change(shown);
  }
  if (!pacer_.due() && !idle()) {
    return !shouldClose();
  }
  if (std::exchange(sceneIsNew_, false)) {
    beginOpening();
    presentPanels();
  }
  const double sinceLastMs = pacer_.beginFrame(seconds);
  const double frameSeconds = workspace_.frameSeconds(std::min(seconds, longestStep));
  updateUi(frameSeconds);
  drawFrame(frameSeconds, sinceLastMs);
  return !shouldClose();
}

void Demo::updateUi(double seconds) {
  const bool navigating = ui_->navigating() || workspace_.prompting();
  workspace_.moveCamera(heldDirection(), navigating ? GamepadState{} : gamepad_, seconds);
  workspace_.prepareView(seconds, !overPanels());
  output_ = ui_->build(shown());
  workspace_.accuracy().show(output_.points, output_.errorGain);
  workspace_.setRefusedEdit(output_.refusedEdit);
  for (const Command& command : std::exchange(output_.commands, {})) {
    workspace_.apply(command);
  }
  workspace_.update();
  workspace_.advance(seconds);
}

void Demo::beginOpening() {
  if (first_.holds()) {
    apply(SetPaused{false});
  }
  const bool paced = options_.frames == 0 && budgetMs() > 0.0;
  first_.begin(paced && workspace_.animates(), paced && device_.info().isCpu());
  opened_ = Clock::now();
  workspace_.setPlayCost("");
  workspace_.browser().showPoster(true);
}

void Demo::continueOpening(const FramePlan& plan) {
  const double seconds = std::chrono::duration<double>(Clock::now() - opened_).count();
  if (first_.drawn(pace_.playCost(), workspace_.animates(), endsPicture(plan) && !pace_.lowers(), seconds)) {
    apply(SetPaused{true});
    apply(Seek{0.0});
  }
  workspace_.setPlayCost(pace_.playCost().value_or(""));
  workspace_.browser().showPoster(first_.covered());
}

// Draws the panels alone before a scene's first picture, which may take long.
void Demo::presentPanels() {
  workspace_.setPictureText(drawingText());
  updateUi(0.0);
  if (std::optional<Frame> frame = renderer_.beginFrame()) {
    endWithPanels(*frame);
    workspace_.browser().showPoster(first_.covered());
    if (framesDrawn_ == 0) {
      spdlog::info("panels shown {:.0f} ms after the start", millisecondsSinceStart());
    }
  }
}

void Demo::endWithPanels(Frame& frame) {
  { const PassScope black = renderer_.beginPass(frame, fullPass("no picture", renderer_.displayTargets(frame))); }
  ui_->record(frame);
  endFrame(frame);
  renderer_.present();
}

// Ends the frame, and asks the window system while the GPU draws: after present() an answer would have to wait for the
// picture that an X server copies.
void Demo::endFrame(Frame& frame) {
  renderer_.endFrame(frame);
  ui_->readWindow();
}

// Ends the frame with the panels alone, after taking back the user's last step, which may have caused the exception.
// Call it while the exception is handled: rethrows it if there is no such step, or no frame to end.
void Demo::abandonFrame(Frame& frame, const std::string& why) {
  if (frame.commands == VK_NULL_HANDLE || !workspace_.undoFailedChange(why)) {
    throw;
  }
  endWithPanels(frame);
  useScene(workspace_.scene());
}

void Demo::drawFrame(double seconds, double sinceLastMs) {
  // Sets the cover between frames, because that waits for the device.
  if (const std::optional<Image8> cover = workspace_.accuracy().takeCover()) {
    sceneRenderer_->setCover(*cover);
  }
  const SceneState state = workspace_.state(workspace_.time());
  const bool movedBefore = pace_.moving();
  pace_.begin(state.camera, workspace_.animates() || workspace_.dragging(), seconds);
  const bool timed = timesPasses(movedBefore && !pace_.moving());
  renderer_.setTimerDetail(timed ? TimerDetail::passes : TimerDetail::frame);
  const Clock::time_point waits = Clock::now();
  std::optional<Frame> frame = renderer_.beginFrame();
  if (!frame) {
    return;
  }
  const Clock::time_point start = Clock::now();
  pace_.finished(renderer_.timings());
  const bool captured = workspace_.capture().wanted();
  frame->capture = capture_ || captured;
  const bool bare = workspace_.capture().bare();
  const FittedPlan* fitted = nullptr;
  try {
    fitted = &planFrame(*frame, state);
    const std::optional<TargetRequest>& target = output_.target;
    const std::optional<TargetDisplay> debug =
        target ? workspace_.report().target(*target, fitted->plan, fitted->settings,
                                            device_.limits().standardSampleLocations)
               : std::nullopt;
    sceneRenderer_->record(*frame, state, fitted->settings, fitted->plan, bare ? std::nullopt : debug);
  } catch (const DeviceLostError&) {
    throw;
  } catch (const SurfaceLostError&) {
    throw;
  } catch (const std::exception& error) {
    return abandonFrame(*frame, error.what());
  }
  const FramePlan& plan = fitted->plan;
  const Settings& settings = fitted->settings;
  if (!bare) {
    ui_->record(*frame);
  }
  const Clock::time_point end = Clock::now();
  const double cpuMs = milliseconds(end - start) - frame->waitedMs;
  const bool newPipelines = std::exchange(pipelines_, renderer_.pipelines().count()) != pipelines_;
  pace_.drawn(frame->number, milliseconds(waits - last_) + cpuMs, frame->waitedMs,
              !timed && !newPipelines && !plan.mainReused() && !plan.tiles);
  const uint64_t number = frame->number;
  endFrame(*frame);
  const bool compiledBefore = std::exchange(compiled_, newPipelines);
  if (compiledBefore && !newPipelines) {
    releaseFreedMemory();  // loading and compiling leave much freed memory
  }
  if (framesDrawn_ == 0) {
    spdlog::info("first picture submitted {:.0f} ms after the start", millisecondsSinceStart());
  }
  framesDrawn_ += framesDrawn_ < std::numeric_limits<int>::max();
  pacer_.frameDrawn();
  continueOpening(plan);
  const bool repeats = pace_.repeats() && !settings.view.continuous && options_.frames == 0;
  workspace_.report().update({workspace_.scene(), state, settings, plan, number, cpuMs, sinceLastMs, pace_.lowers(),
                              newPipelines || compiledBefore, repeats, workspace_.settings()},
                             renderer_, *sceneRenderer_, output_.hoveredPath);
  const auto radiance = [&] { return toDisplay(sceneRenderer_->radiance(), settings.view.displayCurve()); };
  const std::optional<Image8> picture = captured ? std::optional(pictureOf(renderer_.readback())) : std::nullopt;
  workspace_.frameDrawn({workspace_.scene(), state, settings, plan.width, plan.height},
                        endsPicture(plan) ? radiance : std::function<Image8()>(), picture ? &*picture : nullptr);
  frameSettings_ = settings;
  message_ = currentMessage();
  const Clock::time_point presents = Clock::now();
  renderer_.present();
  pace_.presented(milliseconds(Clock::now() - presents));
}

// Returns the target that the panels show if a picture has to be drawn for it.
std::optional<Pace::Target> Demo::missingTarget() const {
  const std::optional<TargetRequest>& target = output_.target;
  const bool missing = target && target->drawn && !isAlwaysThere(target->path, target->display.kind) &&
                       !sceneRenderer_->keepsTarget(target->path, target->display.kind);
  return missing ? std::optional(Pace::Target(target->path, target->display.kind)) : std::nullopt;
}

const FittedPlan& Demo::planFrame(Frame& frame, const SceneState& state) {
  const std::optional<Pace::Target> missing = missingTarget();
  Settings settings = workspace_.shownSettings();
  // Renders every mirror in each frame while debug.check_finite is on, which reports findings by mirror.
  settings.reflection.skipUnchanged = settings.reflection.skipUnchanged && !settings.debug.checkFinite;
  // While a mirror's target is shown, all mirrors are rendered in each frame, so that the target belongs to the
  // picture.
  planner_.begin(output_.target && !output_.target->path.empty(), ui_->holdsWidget() || pace_.moving());
  FrameCache cache = sceneRenderer_->cache(state);
  if (missing) {
    cache.main = nullptr;
  }
  const bool recorded = workspace_.capture().recording();  // without a time budget
  const Scene& scene = workspace_.scene();
  const FittedPlan& fitted = pace_.plan({.frame = {.scene = scene,
                                                   .state = state,
                                                   .settings = settings,
                                                   .size = glm::ivec2(frame.extent.width, frame.extent.height),
                                                   .cache = cache},
                                         .planner = planner_,
                                         .shown = {.scenes = scenes_,
                                                   .revision = workspace_.revision(),
                                                   .shaders = renderer_.pipelines().revision(),
                                                   .time = contentTime(scene, state.time),
                                                   .size = pictureSize()},
                                         .budgetMs = recorded ? 0.0 : budgetMs(),
                                         .front = workspace_.accuracy().front(),
                                         .input = changes_,
                                         .target = missing});
  uploadTextures(frame, state, fitted);
  workspace_.setPictureText(first_.covered() ? drawingText() : pictureText(scene, settings));
  return fitted;
}

// Uploads the textures of a plan, or leaves them out of it if there is no memory for them.
void Demo::uploadTextures(Frame& frame, const SceneState& state, const FittedPlan& fitted) {
  try {
    sceneRenderer_->uploadTextures(frame, state, fitted.settings, fitted.plan);
  } catch (const OutOfMemoryError& error) {
    planner_.leaveOutTextures(error.what());
    pace_.leaveOutTextures();
    sceneRenderer_->uploadTextures(frame, state, fitted.settings, fitted.plan);
  }
}

// Returns the pace's text and what the picture approximates, or would if the animation were paused.
std::string Demo::pictureText(const Scene& scene, const Settings& chosen) const {
  const std::string& text = pace_.text();
  const std::string rest = stillText(scene, chosen);
  if (!text.empty() && workspace_.animates()) {
    return text + ". Space: pause for the " + (rest.empty() ? "exact picture" : "whole picture (" + rest + ")");
  }
  return pace_.lowers() || rest.empty() ? text : text + (text.empty() ? "Approximate: " : "; approximate: ") + rest;
}

// Says whether to time passes one by one: only at the start and the end of a change and every few frames, because
// timing slows a frame. Tiles are timed in each frame: their sum is the time of a pass, and the window waits for them
// anyway.
bool Demo::timesPasses(bool movementEnded) {
  const bool times = ui_->windows().visible() &&
                     (changeBegins_ || movementEnded || untimedFrames_ >= timedInterval || pace_.drawsSlowly());
  untimedFrames_ = times ? 0 : std::min(untimedFrames_ + 1, timedInterval);
  return times;
}

std::string Demo::currentMessage() {
  if (!workspace_.problem().empty()) {
    return workspace_.problem();
  }
  if (!renderer_.pipelines().errors().empty()) {
    return renderer_.pipelines().errors();
  }
  const FiniteWatch& watch = sceneRenderer_->finiteWatch();
  if (watch.findingsFrame() > 0 && watch.findingsFrame() == renderer_.timings().frame) {
    return describe(watch.findings().front());
  }
  return planner_.message();
}

// Says whether the next frame could differ from the last one.
bool Demo::changing() {
  const bool rebuilt = renderer_.reloadShaders();
  const std::string& errors = renderer_.pipelines().errors();
  const bool shaders = std::exchange(shaderErrors_, errors) != errors || rebuilt;
  const bool working = workspace_.working();
  const bool finished = std::exchange(working_, working) && !working;
  return window_.takeActivity() || shaders || finished || gamepadChanged_ || gamepad_.used() ||
         workspace_.capture().recording() || heldDirection() != glm::dvec3(0.0) ||
         workspace_.settings().view.continuous || options_.frames > 0 || workspace_.animates();
}

// Sleeps while nothing changes. Returns true if a frame has to be drawn for something that changes slowly.
bool Demo::idle() {
  pacer_.idle();
  refreshHz_ = window_.refreshRate();
  window_.waitEvents(idleSeconds);
  return ui_->wantsFrames() || working_ || workspace_.statusFades();
}

// Says whether to close the window. It stays open while there is a prompt about unsaved changes.
bool Demo::shouldClose() {
  if (!window_.shouldClose() || closeAfterPrompt_) {
    return window_.shouldClose();
  }
  window_.refuseClose();
  workspace_.apply(Quit{});
  if (!closeAfterPrompt_) {
    if (window_.iconified()) {
      window_.restore();
    }
    pacer_.requestFrames(4);
  }
  return closeAfterPrompt_;
}

void Demo::close() {
  closeAfterPrompt_ = true;
  window_.requestClose();
}

void Demo::useScene(const Scene& scene) {
  renderer_.waitIdle();
  nonFinite_ = nonFinite();
  sceneRenderer_.reset();
  planner_.forgetScene();
  output_ = {};  // it may request a target of the old scene
  sceneRenderer_ = std::make_unique<SceneRenderer>(renderer_, scene);
  ++scenes_;
  pace_.sceneChanged();
  sceneIsNew_ = std::exchange(shownFile_, scene.file) != scene.file;
}

glm::ivec2 Demo::pictureSize() const {
  const VkExtent2D extent = renderer_.displayExtent();
  return {static_cast<int>(extent.width), static_cast<int>(extent.height)};
}

// Returns the part of the picture that no panel covers; the whole picture if that part is too small.
PixelRect Demo::freePicture() const {
  const glm::ivec2 size = pictureSize();
  const VkExtent2D window = window_.size();
  const WindowRect free = ui_->windows().freeRect();
  const glm::vec2 scale = glm::vec2(size) / glm::max(glm::vec2(window.width, window.height), 1.0f);
  const glm::ivec2 corner(free.corner * scale);
  const glm::ivec2 extent(free.size * scale);
  return 4 * extent.x < size.x ? PixelRect{0, 0, size.x, size.y} : PixelRect{corner.x, corner.y, extent.x, extent.y};
}

void Demo::setPresentMode(size_t index) {
  deviceView_.presentMode = index;
  renderer_.setPresentMode(renderer_.presentModes().at(index));
}

void Demo::takeInput(const InputEvent& event) {
  using Kind = InputEvent::Kind;
  if (event.kind == Kind::wheel || (event.down && (event.kind == Kind::key || event.kind == Kind::button))) {
    first_.uncover();
  }
  if (event.kind == Kind::key) {
    handleKey(event.key);
  } else if (event.kind == Kind::button && event.code <= static_cast<int>(MouseButton::middle)) {
    workspace_.pointerButton({static_cast<MouseButton>(event.code), event.down, event.shift}, overPanels());
  } else if (event.kind == Kind::pointer) {
    const VkExtent2D size = window_.size();
    workspace_.pointerMoved({event.x, event.y}, {size.width, size.height}, controlHeld());
  } else if (event.kind == Kind::wheel && !overPanels()) {
    workspace_.scrolled(event.y);
  } else if (event.kind == Kind::drop) {
    apply(OpenDropped{event.dropped});
  }
  ui_->push(event);
}

bool Demo::overPanels() const {
  const glm::dvec2& position = workspace_.pointer().position();
  return ui_->takesPointer(position.x, position.y);
}

// Applies the command of a key, unless a prompt or a text field has the keyboard.
void Demo::handleKey(const KeyEvent& event) {
  const std::optional<Command> command = event.pressed ? commandOf(event) : std::nullopt;
  if (!command) {
    return;
  }
  if (workspace_.prompting()) {
    return std::holds_alternative<Escape>(*command) ? apply(CancelPrompt{}) : void();
  }
  const bool typed = ui_->wantsKeyboard() && !std::holds_alternative<Quit>(*command);
  const bool presses = ui_->navigating() && std::holds_alternative<TogglePaused>(*command);
  if (!typed && !presses) {
    apply(*command);
  }
}

// Applies the commands of gamepad buttons. The direction pad navigates the panels (by Dear ImGui), which then have
// sticks and buttons too.
void Demo::takeGamepad() {
  const GamepadState before = std::exchange(gamepad_, gamepadSource_().value_or(GamepadState{}));
  gamepadChanged_ = gamepad_ != before;
  for (int i = 0; i < static_cast<int>(GamepadButton::count); ++i) {
    const auto button = static_cast<GamepadButton>(i);
    const GamepadCommand bound = commandOf(button);
    if (gamepad_.down(button) && !before.down(button) && !workspace_.prompting() &&
        (bound.inPanels || !ui_->navigating())) {
      apply(bound.command);
    }
  }
}

bool Demo::controlHeld() const {
  return window_.keyDown(Key::leftControl) || window_.keyDown(Key::rightControl);
}

// Returns the direction of the held fly keys, along right, up and backwards of the view.
glm::dvec3 Demo::heldDirection() const {
  if (ui_->wantsKeyboard() || controlHeld() || workspace_.prompting()) {
    return glm::dvec3(0.0);
  }
  const auto axis = [&](Key positive, Key negative) {
    return static_cast<double>(window_.keyDown(positive)) - static_cast<double>(window_.keyDown(negative));
  };
  return {axis(Key::d, Key::a), axis(Key::e, Key::q), axis(Key::s, Key::w)};
}

namespace {

Demo* shownDemo = nullptr;

void endWithoutDisplay() {
  if (shownDemo) {
    shownDemo->keepUnsavedWork();
  }
  printLine("the window system has ended (start it again)", stderr);
  std::_Exit(2);
}

}  // namespace

int runDemo(const Options& options) {
  chooseWindowPlatform(options.window.platform);
  installInterruptHandler();
  letBrokenPipesFail();
  Demo demo(options);
  const std::unique_ptr<Demo, void (*)(Demo*)> shown(shownDemo = &demo, [](Demo*) { shownDemo = nullptr; });
  onDisplayLost(&endWithoutDisplay);
  while (demo.step() && !interruptRequested() && (options.frames == 0 || demo.framesDrawn() < options.frames)) {
  }
  if (interruptRequested()) {
    demo.keepUnsavedWork();
  }
  demo.renderer().waitIdle();
  spdlog::info("{} frames", demo.framesDrawn());
  return exitCodeOfChecks(demo.device().validationMessages(), demo.nonFinite());
}

}  // namespace speculum
