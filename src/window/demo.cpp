#include "window/demo.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
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

Demo::Half::Half(Renderer& renderer, const Scene& scene)
    : renderer(std::make_unique<SceneRenderer>(renderer, scene)),
      planner(renderer.device(), true),
      pace(renderer.device().info().isCpu(), renderer.device().caps().sampleCounts) {}

Demo::Demo(const Options& options)
    : options_(options),
      workspace_(options, *this),
      window_({.title = "Speculum", .width = options.size.width, .height = options.size.height}),
      device_(deviceOptions(options, &window_)),
      renderer_(device_, rendererOptions(options, &window_)),
      halves_{std::make_unique<Half>(renderer_, workspace_.scene())},
      refreshHz_(window_.refreshRate()),
      deviceView_(shownDevice(renderer_, device_)),
      last_(Clock::now()) {
  applyDebugSettings(workspace_.settings(), device_);
  device_.sparePipelines().keepAtMost(32);
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
  if (half().pace.drawsTiles()) {
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
  const auto wantsFrame = [](const std::unique_ptr<Half>& half) { return half && half->pace.wantsFrame(); };
  if (changes || std::ranges::any_of(halves_, wantsFrame)) {
    std::vector<Settings> shown;
    for (int half = 0; half < (halves_[1] ? 2 : 1); ++half) {
      shown.push_back(workspace_.shownSettings(half));
      shown.back().reflection = mostAsked(workspace_.scene(), shown.back());
    }
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
  // Both halves of A | B show the same time, so it stands still in every second frame.
  const double passed = std::min(seconds, longestStep);
  heldSeconds_ += passed;
  updateUi(endsPair() ? 0.0 : workspace_.frameSeconds(std::exchange(heldSeconds_, 0.0)));
  drawFrame(workspace_.frameSeconds(passed), sinceLastMs);
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
  if (first_.holds() && workspace_.split().on()) {
    workspace_.releasePause();
  } else if (first_.holds()) {
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
  const Pace& pace = half().pace;
  if (first_.drawn(pace.playCost(), workspace_.animates(), endsPicture(plan) && !pace.lowers(), seconds)) {
    apply(SetPaused{true});
    apply(Seek{0.0});
  }
  workspace_.setPlayCost(pace.playCost().value_or(""));
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
  try {
    takeTurns();
  } catch (const OutOfMemoryError& error) {
    workspace_.undoFailedChange(error.what());
    return;
  }
  showCover();
  const SceneState state = workspace_.state(workspace_.time());
  Half& half = this->half();
  const bool movedBefore = half.pace.moving();
  for (const std::unique_ptr<Half>& each : halves_) {
    if (each) {
      each->pace.begin(state.camera, workspace_.animates() || workspace_.dragging(), seconds);
    }
  }
  const bool timed = timesPasses(movedBefore && !half.pace.moving());
  renderer_.setTimerDetail(timed ? TimerDetail::passes : TimerDetail::frame);
  const Clock::time_point waits = Clock::now();
  std::optional<Frame> frame = renderer_.beginFrame();
  if (!frame) {
    return;
  }
  const Clock::time_point start = Clock::now();
  half.pace.finished(timings());
  const bool captured = workspace_.capture().wanted() && (!workspace_.split().on() || half_ == 1);
  frame->capture = capture_ || captured;
  const bool bare = workspace_.capture().bare();
  const FittedPlan* fitted = nullptr;
  try {
    fitted = &planFrame(*frame, state);
    // The Targets panel shows a target of the half whose figures the panels show, whichever half is drawn.
    Half& shown = *halves_[static_cast<size_t>(workspace_.shownHalf())];
    const FittedPlan& its = shown.pace.planned();
    const std::optional<TargetRequest>& target = output_.target;
    const std::optional<TargetDisplay> debug =
        target && (isShown() || shown.frame > 0)
            ? workspace_.report().target(*target, its.plan, its.settings, device_.limits().standardSampleLocations)
            : std::nullopt;
    half.renderer->record(*frame, state, fitted->settings, fitted->plan, bare || !isShown() ? std::nullopt : debug,
                          true, splitDisplay(*frame));
    if (debug && !bare && !isShown()) {
      shown.renderer->showTarget(*frame, its.plan, *debug);
    }
  } catch (const DeviceLostError&) {
    throw;
  } catch (const SurfaceLostError&) {
    throw;
  } catch (const std::exception& error) {
    return abandonFrame(*frame, error.what());
  }
  const FramePlan& plan = fitted->plan;
  const Settings& settings = fitted->settings;
  if (!bare || workspace_.split().on()) {
    ui_->record(*frame, bare);
  }
  const Clock::time_point end = Clock::now();
  const double cpuMs = milliseconds(end - start) - frame->waitedMs;
  const bool newPipelines = std::exchange(pipelines_, renderer_.pipelines().count()) != pipelines_;
  half.pace.drawn(frame->number, milliseconds(waits - last_) + cpuMs, frame->waitedMs,
                  !timed && !newPipelines && !plan.mainReused() && !plan.tiles && !plan.showsNothing());
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
  if (isShown()) {
    continueOpening(plan);
  }
  const bool repeats = half.pace.repeats() && !settings.view.continuous && options_.frames == 0;
  workspace_.report(half_).update(
      {workspace_.scene(), state, settings, plan, number, cpuMs, sinceLastMs, half.pace.lowers(),
       newPipelines || compiledBefore, repeats, workspace_.shownSettings(half_), ui_->windows().visible()},
      timings(), device_, *half.renderer, output_.hoveredPath);
  half.frame = number;
  const auto radiance = [&] { return toDisplay(half.renderer->radiance(), settings.view.displayCurve()); };
  const std::optional<Image8> picture = captured ? std::optional(pictureOf(renderer_.readback())) : std::nullopt;
  workspace_.frameDrawn({workspace_.scene(), state, settings, plan.width, plan.height},
                        endsPicture(plan) && !plan.encodes ? radiance : std::function<Image8()>(),
                        picture ? &*picture : nullptr, half_);
  describeHalf();
  frameSettings_ = settings;
  message_ = currentMessage();
  const Clock::time_point presents = Clock::now();
  renderer_.present();
  half.pace.presented(milliseconds(Clock::now() - presents));
}

// Makes what draws B, or drops it, and chooses the half to draw: both take turns.
void Demo::takeTurns() {
  const bool split = workspace_.split().on();
  if (split && !halves_[1]) {
    renderer_.waitIdle();
    halves_[1] = std::make_unique<Half>(renderer_, workspace_.scene());
  } else if (!split && halves_[1]) {
    dropSecondHalf();
  }
  half_ = split ? 1 - half_ : 0;
}

void Demo::dropSecondHalf() {
  renderer_.waitIdle();
  if (const std::unique_ptr<Half> dropped = std::exchange(halves_[1], nullptr)) {
    nonFinite_ += dropped->renderer->finiteWatch().count();
  }
  workspace_.split().forgetPictures();
  half_ = covered_ = 0;
}

// Returns the times of the last frame that drew this half and has finished.
const FrameTimings& Demo::timings() const {
  static const FrameTimings none;
  const FrameTimings* found = halves_[1] ? renderer_.timingsOf(half().frame) : &renderer_.timings();
  return found ? *found : none;
}

// Sets the cover between frames, because that waits for the device.
void Demo::showCover() {
  if (const int shown = workspace_.shownHalf(); std::exchange(covered_, shown) != shown) {
    halves_[static_cast<size_t>(1 - shown)]->renderer->setCover({});
  }
  if (const std::optional<Image8> cover = workspace_.accuracy().takeCover()) {
    halves_[static_cast<size_t>(covered_)]->renderer->setCover(*cover);
  }
}

std::optional<SplitDisplay> Demo::splitDisplay(const Frame& frame) {
  if (!halves_[1]) {
    return std::nullopt;
  }
  const double divider = std::round(workspace_.split().divider() * frame.extent.width);
  return SplitDisplay{*halves_[static_cast<size_t>(1 - half_)]->renderer, half_ == 1, static_cast<uint32_t>(divider)};
}

// Tells A | B how its half was drawn.
void Demo::describeHalf() {
  if (!halves_[1]) {
    return;
  }
  const auto planned = [this](int of) { return halves_[static_cast<size_t>(of)]->pace.planned().settings; };
  const auto picture = [&](int of) {
    return toDisplay(halves_[static_cast<size_t>(of)]->renderer->radiance(), planned(of).view.displayCurve());
  };
  workspace_.split().frameDrawn({.half = half_,
                                 .gpuMs = workspace_.report(half_).shown().gpuMs,
                                 .text = half().pace.text(),
                                 .still = half().pace.completeStill()},
                                workspace_.accuracy().reference(), picture, planned);
}

void Demo::dropCachedImages() {
  for (const std::unique_ptr<Half>& half : halves_) {
    if (half) {
      half->renderer->restart();
    }
  }
}

uint64_t Demo::nonFinite() {
  uint64_t count = nonFinite_;
  for (const std::unique_ptr<Half>& half : halves_) {
    count += half && half->renderer ? half->renderer->finiteWatch().count() : 0;
  }
  return count;
}

// Returns the target that the panels show if a picture has to be drawn for it.
std::optional<Pace::Target> Demo::missingTarget() const {
  const std::optional<TargetRequest>& target = output_.target;
  const SceneRenderer& renderer = *half().renderer;
  const auto isMissing = [&](const MirrorPath& path, TargetKind kind) {
    return isAlwaysThere(path, kind) ? renderer.hasGaps() : !renderer.keepsTarget(path, kind);
  };
  const bool missing = target && target->drawn && isShown() && isMissing(target->path, target->display.kind);
  return missing ? std::optional(Pace::Target(target->path, target->display.kind)) : std::nullopt;
}

// Says whether nothing but the display reads the main view that is planned. Still pictures are shown again, compared
// and stored.
bool Demo::isShownOnly() const {
  return half().pace.moving() && !halves_[1] && !output_.target && !output_.errorGain && !workspace_.needsThumbnail();
}

const FittedPlan& Demo::planFrame(Frame& frame, const SceneState& state) {
  const std::optional<Pace::Target> missing = missingTarget();
  Half& half = this->half();
  Settings settings = workspace_.shownSettings(half_);
  // Renders every mirror in each frame while debug.check_finite is on, which reports findings by mirror.
  settings.reflection.skipUnchanged = settings.reflection.skipUnchanged && !settings.debug.checkFinite;
  // While a mirror's target is shown, all mirrors are rendered in each frame, so that the target belongs to the
  // picture.
  half.planner.begin(isShown() && output_.target && !output_.target->path.empty(),
                     ui_->holdsWidget() || half.pace.moving(), halves_[1] ? 2 : 1);
  FrameCache cache = half.renderer->cache(state);
  frame.waitedMs += cache.waitedMs;
  if (isShown() && output_.target) {
    cache.refined = nullptr;  // the whole target is shown
  }
  if (missing) {
    cache.main = nullptr;
  }
  const bool recorded = workspace_.capture().recording();  // without a time budget
  const Scene& scene = workspace_.scene();
  const FittedPlan& fitted = half.pace.plan({.frame = {.scene = scene,
                                                       .state = state,
                                                       .settings = settings,
                                                       .size = glm::ivec2(frame.extent.width, frame.extent.height),
                                                       .cache = cache,
                                                       .shownOnly = isShownOnly()},
                                             .planner = half.planner,
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
  if (isShown()) {
    workspace_.setPictureText(first_.covered() ? drawingText() : pictureText(scene, settings));
  }
  return fitted;
}

// Uploads the textures of a plan, or leaves them out of it if there is no memory for them.
void Demo::uploadTextures(Frame& frame, const SceneState& state, const FittedPlan& fitted) {
  Half& half = this->half();
  try {
    half.renderer->uploadTextures(frame, state, fitted.settings, fitted.plan);
  } catch (const OutOfMemoryError& error) {
    half.planner.leaveOutTextures(error.what());
    half.pace.leaveOutTextures();
    half.renderer->uploadTextures(frame, state, fitted.settings, fitted.plan);
  }
}

// Returns the pace's text and what the picture approximates, or would if the animation were paused.
std::string Demo::pictureText(const Scene& scene, const Settings& chosen) const {
  const std::string& text = half().pace.text();
  const std::string rest = stillText(scene, chosen);
  if (!text.empty() && workspace_.animates()) {
    return text + ". Space: pause for the " + (rest.empty() ? "exact picture" : "whole picture (" + rest + ")");
  }
  return half().pace.lowers() || rest.empty() ? text
                                              : text + (text.empty() ? "Approximate: " : "; approximate: ") + rest;
}

// Says whether to time passes one by one: only at the start and the end of a change and every few frames, because
// timing slows a frame. Tiles are timed in each frame: their sum is the time of a pass, and the window waits for them
// anyway.
bool Demo::timesPasses(bool movementEnded) {
  const bool times = ui_->windows().visible() &&
                     (changeBegins_ || movementEnded || untimedFrames_ >= timedInterval || half().pace.drawsSlowly());
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
  const FiniteWatch& watch = half().renderer->finiteWatch();
  if (watch.findingsFrame() > 0 && watch.findingsFrame() == timings().frame) {
    return describe(watch.findings().front());
  }
  for (size_t i = 0; i < halves_.size(); ++i) {
    if (halves_[i] && !halves_[i]->planner.message().empty()) {
      return (!halves_[1] ? "" : i == 0 ? "A: " : "B: ") + halves_[i]->planner.message();
    }
  }
  return "";
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
         workspace_.shownSettings(0).view.continuous || workspace_.shownSettings(1).view.continuous ||
         options_.frames > 0 || workspace_.animates();
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
  dropSecondHalf();
  Half& half = this->half();
  nonFinite_ = nonFinite();
  half.renderer.reset();
  half.planner.forgetScene();
  output_ = {};  // it may request a target of the old scene
  half.renderer = std::make_unique<SceneRenderer>(renderer_, scene);
  half.frame = 0;
  ++scenes_;
  half.pace.sceneChanged();
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

// Returns the direction of the held fly keys, along right, up and backwards of the view. A shortcut's letter does not
// fly if it is released after Ctrl.
glm::dvec3 Demo::heldDirection() const {
  if (ui_->wantsKeyboard() || controlHeld() || workspace_.prompting()) {
    return glm::dvec3(0.0);
  }
  const auto axis = [&](Key positive, Key negative) {
    return static_cast<double>(window_.keyDownAlone(positive)) - static_cast<double>(window_.keyDownAlone(negative));
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
