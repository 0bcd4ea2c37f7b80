#include "window/demo.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "plan/pass_mask.hpp"
#include "platform/process.hpp"
#include "window/frame_report.hpp"

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
      halves_(renderer_, workspace_.scene()),
      refreshHz_(window_.refreshRate()),
      deviceView_(shownDevice(renderer_, device_)),
      ui_(renderer_, window_),
      input_(window_, ui_, workspace_),
      last_(Clock::now()) {
  applyDebugSettings(workspace_.settings(), device_);
  device_.sparePipelines().keepAtMost(32);
  shownFile_ = workspace_.scene().file;
  window_.setListener([this](const InputEvent& event) {
    if (isAction(event) && event.kind != InputEvent::Kind::key && !input_.overPanels()) {
      first_.uncover();
    }
    input_.take(event);
  });
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
  if (halves_.drawn().pace.drawsLong()) {
    renderer_.waitIdle();
  } else if (pacer_.due()) {
    renderer_.waitForFrame();  // first, so that the events of this frame are as new as possible
  }
  window_.pollEvents();
  input_.takeWaiting();
  input_.takeGamepad(gamepadSource_().value_or(GamepadState{}));
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  if (window_.paused()) {
    window_.waitEvents(idleSeconds);
    return !shouldClose();
  }
  requestFrames();
  if (pacer_.due() || idle()) {
    if (std::exchange(sceneIsNew_, false)) {
      beginOpening();
    }
    drawFrame(seconds);
  }
  return !shouldClose();
}

// Requests frames if the next one could differ from the last one.
void Demo::requestFrames() {
  const bool rebuilt = renderer_.reloadShaders();
  const std::string& errors = renderer_.pipelines().errors();
  const bool shaders = std::exchange(shaderErrors_, errors) != errors || rebuilt;
  const bool worked = std::exchange(working_, workspace_.working());
  const bool changed = changes_;
  changes_ = window_.takeActivity() || shaders || (worked && !working_) || input_.held() ||
             workspace_.capture().recording() || workspace_.shownSettings(0).view.continuous ||
             workspace_.shownSettings(1).view.continuous || options_.frames > 0 || workspace_.animates();
  changeBegins_ = changes_ && !changed;
  const auto wantsFrame = [](const PictureHalf& half) { return half.pace.wantsFrame(); };
  if (changes_ || std::ranges::any_of(halves_, wantsFrame)) {
    std::vector<Settings> shown;
    for (int half = 0; half < (halves_.split() ? 2 : 1); ++half) {
      shown.push_back(workspace_.shownSettings(half));
      shown.back().reflection = mostAsked(workspace_.scene(), shown.back());
    }
    pacer_.change(shown);
  }
}

// Draws a frame of the window, `seconds` after the last step.
void Demo::drawFrame(double seconds) {
  const double sinceLastMs = pacer_.beginFrame(seconds);
  const double passed = std::min(seconds, longestStep);
  heldSeconds_ += passed;
  // Both halves of A | B show the same time, so it stands still in every second frame.
  const bool endsPair = workspace_.split().on() && halves_.split() && halves_.index() == 0;
  updateUi(endsPair ? 0.0 : workspace_.frameSeconds(std::exchange(heldSeconds_, 0.0)));
  if (sceneIsNew_ || !takeTurns()) {  // beginOpening() covers the first frame of a new scene
    return;
  }
  // While A | B is on, only the frame that draws the second half is saved: then both halves show the same time.
  saved_ = workspace_.capture().wanted() && (!workspace_.split().on() || halves_.index() == 1);
  bare_ = workspace_.capture().bare();
  SceneState state = workspace_.state(workspace_.time());
  if (saved_ && halves_.index() == 1) {
    state.camera = previousCamera_;  // events between the two frames may have moved it
  }
  previousCamera_ = state.camera;
  first_.shows({.settings = imageSettings(workspace_.shownSettings(halves_.index())),
                .revision = workspace_.pictureRevision(),
                .time = state.time,
                .seeks = workspace_.view().playback.seeks(),
                .camera = workspace_.view().camera.moved() ? std::optional(state.camera) : std::nullopt},
               workspace_.split().on());
  PictureHalf& half = halves_.drawn();
  const bool timed = beginPace(state, workspace_.frameSeconds(passed));
  const Clock::time_point waits = Clock::now();
  std::optional<Frame> frame = renderer_.beginFrame();
  if (!frame) {
    return;
  }
  const Clock::time_point begins = Clock::now();
  half.pace.finished(halves_.timings());
  if (!recordPicture(*frame, state)) {
    return;
  }
  if (!bare_ || workspace_.split().on()) {
    ui_.record(*frame, bare_ ? SimpleUI::Part::divider : SimpleUI::Part::all);
  }
  if (workspace_.capture().hidesPanels()) {
    if (saved_) {
      renderer_.captureNow(*frame);
    }
    ui_.record(*frame, SimpleUI::Part::status);  // a full screen has no title that says how to stop
  }
  const auto& [plan, settings, message, traces] = half.pace.planned();
  const double cpuMs = milliseconds(Clock::now() - begins) - frame->waitedMs;
  const size_t pipelines = std::exchange(pipelines_, renderer_.pipelines().count());
  const bool compiles = pipelines_ != pipelines;
  half.pace.drawn(
      frame->number, milliseconds(waits - last_) + cpuMs, frame->waitedMs,
      (!timed || half.pace.drawsSlowly()) && !compiles && !plan.mainReused() && !plan.tiles && !plan.showsNothing());
  endFrame(*frame);
  const bool compiled = countFrame(compiles);
  report({workspace_.scene(), state, settings, plan, frame->number, cpuMs, sinceLastMs, half.pace.lowers(), compiled,
          half.pace.repeats() && !settings.view.continuous && options_.frames == 0,
          workspace_.shownSettings(halves_.index()), ui_.windows().visible()});
  const Clock::time_point presents = Clock::now();
  renderer_.present();
  half.pace.presented(milliseconds(Clock::now() - presents));
}

void Demo::updateUi(double seconds) {
  input_.moveCamera(seconds);
  workspace_.prepareView(seconds, !input_.overPanels());
  if (workspace_.browser().takeListed()) {
    ui_.setThumbnails(workspace_.browser().thumbnails());
  }
  output_ = ui_.build(shown());
  workspace_.accuracy().show(output_.points, output_.errorGain);
  workspace_.setRefusedEdit(output_.refusedEdit);
  for (const Command& command : std::exchange(output_.commands, {})) {
    workspace_.apply(command);
  }
  workspace_.update();
  workspace_.view().playback.advance(workspace_.animates() ? seconds : 0.0);
}

// Draws the panels alone before a scene's first picture, which may take long.
void Demo::beginOpening() {
  if (first_.holds() && workspace_.split().on()) {
    workspace_.view().playback.playNext();
  } else if (first_.holds()) {
    apply(SetPaused{false});
  }
  const bool paced = options_.frames == 0 && budgetMs() > 0.0;
  const bool split = workspace_.split().on();
  const Image8 thumbnail = workspace_.browser().thumbnail();
  ui_.setPoster(thumbnail);
  first_.begin(paced && workspace_.animates(), paced && !split && device_.info().isCpu() && thumbnail.width > 0);
  halves_.drawn().pace.forgetPlayCost();
  opened_ = Clock::now();
  workspace_.setPlayCost("");
  workspace_.browser().showPoster(!split);
  workspace_.setPictureText(first_.text(!split && thumbnail.width > 0, {}));
  updateUi(0.0);
  if (std::optional<Frame> frame = renderer_.beginFrame()) {
    endWithPanels(*frame);
    workspace_.browser().showPoster(first_.covered());
    if (!first_.covered()) {
      workspace_.setPictureText("");  // the next frame shows a picture
    }
    if (framesDrawn_ == 0) {
      spdlog::info("panels shown {:.0f} ms after the start", millisecondsSinceStart());
    }
  }
}

void Demo::continueOpening(const FramePlan& plan) {
  const double seconds = std::chrono::duration<double>(Clock::now() - opened_).count();
  const Pace& pace = halves_.drawn().pace;
  if (first_.drawn(pace.playCost(), workspace_.animates(), endsPicture(plan) && !pace.coarse(), seconds)) {
    apply(SetPaused{true});
    apply(Seek{0.0});
  }
  workspace_.setPlayCost(pace.playCost().value_or(""));
  workspace_.browser().showPoster(first_.covered());
}

void Demo::endWithPanels(Frame& frame) {
  { const PassScope black = renderer_.beginPass(frame, fullPass("no picture", renderer_.displayTargets(frame))); }
  ui_.record(frame);
  endFrame(frame);
  renderer_.present();
}

// Ends the frame, and asks the window system while the GPU draws: after present() an answer would have to wait for the
// picture that an X server copies.
void Demo::endFrame(Frame& frame) {
  renderer_.endFrame(frame);
  ui_.readWindow();
}

// Chooses the half to draw. If there is no memory for B, ends A | B and returns false.
bool Demo::takeTurns() {
  try {
    halves_.takeTurns(workspace_.split().on(), workspace_.scene());
  } catch (const OutOfMemoryError& error) {
    workspace_.undoFailedChange(error.what());
    return false;
  }
  // Covers change between frames, because that waits for the device.
  const int shown = workspace_.shownHalf();
  if (halves_.split()) {
    halves_.at(1 - shown).renderer->setCover({});
  }
  if (const std::optional<Image8> cover = workspace_.accuracy().takeCover()) {
    halves_.at(shown).renderer->setCover(*cover);
  }
  return true;
}

// Plans the picture and records it. If that fails, takes back the user's last step, which may have been the cause, ends
// the frame with the panels alone and returns false. Throws if there is no such step, or no frame to end.
bool Demo::recordPicture(Frame& frame, const SceneState& state) {
  frame.capture = capture_ || saved_;
  try {
    const auto& [plan, settings, message, traces] = planFrame(frame, state);
    const std::optional<TargetDisplay> target = shownTarget();
    std::optional<SplitDisplay> split;
    if (const int index = halves_.index(); halves_.split()) {
      const double divider = std::round(workspace_.split().divider() * frame.extent.width);
      split.emplace(SplitDisplay{*halves_.at(1 - index).renderer, index == 1, static_cast<uint32_t>(divider)});
    }
    halves_.drawn().renderer->record(frame, state, settings, plan, isShown() ? target : std::nullopt, true, split);
    if (target && !isShown()) {
      PictureHalf& shown = halves_.at(workspace_.shownHalf());
      shown.renderer->showTarget(frame, shown.pace.planned().plan, *target);
    }
    return true;
  } catch (const DeviceLostError&) {
    throw;
  } catch (const SurfaceLostError&) {
    throw;
  } catch (const std::exception& error) {
    if (frame.commands == VK_NULL_HANDLE || !workspace_.undoFailedChange(error.what())) {
      throw;
    }
  }
  endWithPanels(frame);
  useScene(workspace_.scene());
  return false;
}

// Describes the target that the Targets panel shows, and returns how to draw it. It is one of the half whose figures
// the panels show, whichever half is drawn.
std::optional<TargetDisplay> Demo::shownTarget() {
  const PictureHalf& shown = halves_.at(workspace_.shownHalf());
  if (!output_.target || (!isShown() && shown.frame == 0)) {
    return std::nullopt;
  }
  const FittedPlan& fitted = shown.pace.planned();
  const std::optional<TargetDisplay> target = workspace_.report().target(*output_.target, fitted.plan, fitted.settings,
                                                                         device_.limits().standardSampleLocations);
  return bare_ ? std::nullopt : target;
}

// Counts the frame that was drawn, which made pipelines or did not. Says whether it or the one before did.
bool Demo::countFrame(bool compiles) {
  const bool compiled = std::exchange(compiled_, compiles);
  if (compiled && !compiled_) {
    releaseFreedMemory();  // loading and compiling leave much freed memory
  }
  if (framesDrawn_ == 0) {
    spdlog::info("first picture submitted {:.0f} ms after the start", millisecondsSinceStart());
  }
  framesDrawn_ += framesDrawn_ < std::numeric_limits<int>::max();
  pacer_.frameDrawn();
  return compiled || compiled_;
}

// Reports how the frame was drawn.
void Demo::report(const RecordedFrame& frame) {
  PictureHalf& half = halves_.drawn();
  const int index = halves_.index();
  if (isShown()) {
    continueOpening(frame.plan);
    first_.covered()
        ? workspace_.setPictureText(first_.text(true, half.pace.firstShare()), "not finished: a preview")
        : workspace_.setPictureText(half.text(frame.scene, frame.chosen, workspace_.animates()), half.pace.progress());
  }
  workspace_.report(index).update(frame, halves_.timings(), device_, *half.renderer, output_.hoveredPath);
  half.frame = frame.number;
  const auto pixels = [this](int of) { return halves_.at(of).pixels(); };
  const auto picture = std::function([&] { return pixels(index); });
  const std::optional<Image8> captured = saved_ ? std::optional(pictureOf(renderer_.readback())) : std::nullopt;
  const int pictures = std::max(half.renderer->accumulated(), 1);
  const bool complete = half.pace.completeStill() || pictures >= frame.settings.view.accumulate;
  workspace_.frameDrawn(
      {frame.scene, frame.state, frame.settings, frame.plan.width, frame.plan.height, pictures, complete},
      endsPicture(frame.plan) && !frame.plan.encodes ? picture : nullptr, captured ? &*captured : nullptr, index);
  if (halves_.split()) {
    workspace_.split().frameDrawn({.half = index,
                                   .gpuMs = workspace_.report(index).shown().gpuMs,
                                   .pictures = half.pace.pictures(),
                                   .text = half.pace.text(),
                                   .still = half.pace.completeStill()},
                                  workspace_.accuracy().reference(), pixels,
                                  [this](int of) { return halves_.at(of).pace.planned().settings; });
  }
}

// Returns the target that the panels show if a picture has to be drawn for it.
std::optional<Pace::Target> Demo::missingTarget() const {
  const std::optional<TargetRequest>& target = output_.target;
  if (!target || !target->drawn || !isShown()) {
    return std::nullopt;
  }
  const SceneRenderer& renderer = *halves_.drawn().renderer;
  const Pace::Target shown(target->path, target->display.kind);
  const bool missing =
      isAlwaysThere(shown.first, shown.second) ? renderer.hasGaps() : !renderer.keepsTarget(shown.first, shown.second);
  return missing ? std::optional(shown) : std::nullopt;
}

const FittedPlan& Demo::planFrame(Frame& frame, const SceneState& state) {
  const std::optional<Pace::Target> missing = missingTarget();
  PictureHalf& half = halves_.drawn();
  Settings settings = workspace_.shownSettings(halves_.index());
  // Renders every mirror in each frame while debug.check_finite is on, which reports findings by mirror.
  settings.reflection.skipUnchanged = settings.reflection.skipUnchanged && !settings.debug.checkFinite;
  const bool showsTarget = isShown() && output_.target;
  // While a mirror's target is shown, all mirrors are rendered in each frame, so that the target belongs to the
  // picture.
  half.planner.begin(showsTarget && !output_.target->path.empty(), ui_.holdsWidget() || half.pace.moving(),
                     halves_.split() ? 2 : 1);
  FrameCache cache = half.renderer->cache(state);
  frame.waitedMs += cache.waitedMs;
  if (showsTarget) {
    cache.refined = nullptr;  // the whole target is shown
  }
  if (missing) {
    cache.main = nullptr;
  }
  const bool recorded = workspace_.capture().recording();  // without a time budget
  // Nothing but the display reads a main view that moves: still pictures are shown again, compared and stored.
  const bool shownOnly =
      half.pace.moving() && !halves_.split() && !output_.target && !output_.errorGain && !workspace_.needsThumbnail();
  const Scene& scene = workspace_.scene();
  return half.plan(frame, {.frame = {.scene = scene,
                                     .state = state,
                                     .settings = settings,
                                     .size = glm::ivec2(frame.extent.width, frame.extent.height),
                                     .cache = cache,
                                     .shownOnly = shownOnly},
                           .planner = half.planner,
                           .shown = {.revision = workspace_.pictureRevision(),
                                     .shaders = renderer_.pipelines().revision(),
                                     .time = contentTime(scene, state.time),
                                     .size = pictureSize()},
                           .budgetMs = recorded ? 0.0 : budgetMs(),
                           .front = workspace_.accuracy().front(),
                           .input = changes_,
                           .covered = first_.covered(),
                           .target = missing});
}

// Begins the frame, `seconds` after the last, for both halves. Returns whether its passes are timed one by one: only at
// the start and the end of a change and every few frames, because timing slows a frame. Tiles are timed in each frame:
// their sum is the time of a pass, and the window waits for them anyway.
bool Demo::beginPace(const SceneState& state, double seconds) {
  const Pace& pace = halves_.drawn().pace;
  const bool moved = pace.moving();
  for (PictureHalf& half : halves_) {
    half.pace.begin(state.camera, workspace_.animates() || workspace_.dragging(), seconds);
  }
  const bool ends = moved && !pace.moving();
  const bool times =
      ui_.windows().visible() && (changeBegins_ || ends || untimedFrames_ >= timedInterval || pace.drawsSlowly());
  untimedFrames_ = times ? 0 : std::min(untimedFrames_ + 1, timedInterval);
  renderer_.setTimerDetail(times ? TimerDetail::passes : TimerDetail::frame);
  return times;
}

std::string Demo::message() {
  const std::string& shaders = renderer_.pipelines().errors();
  return !workspace_.problem().empty() ? workspace_.problem() : !shaders.empty() ? shaders : halves_.problem();
}

// Sleeps while nothing changes. Returns true if a frame has to be drawn for something that changes slowly.
bool Demo::idle() {
  pacer_.idle();
  refreshHz_ = window_.refreshRate();
  window_.waitEvents(idleSeconds);
  return ui_.wantsFrames() || working_ || workspace_.statusFades();
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
  output_ = {};  // it may request a target of the old scene
  workspace_.split().forgetPictures();
  halves_.useScene(scene);
  sceneIsNew_ = std::exchange(shownFile_, scene.file) != scene.file;
}

double Demo::budgetMs() const {
  return motionBudget(workspace_.shownSettings(halves_.index()), device_.info().isCpu(), refreshHz_);
}

glm::ivec2 Demo::pictureSize() const {
  const VkExtent2D extent = renderer_.displayExtent();
  return {static_cast<int>(extent.width), static_cast<int>(extent.height)};
}

// Returns the part of the picture that no panel covers; the whole picture if that part is too small.
PixelRect Demo::freePicture() const {
  const glm::ivec2 size = pictureSize();
  const VkExtent2D window = window_.size();
  const WindowRect free = ui_.windows().freeRect();
  const glm::vec2 scale = glm::vec2(size) / glm::max(glm::vec2(window.width, window.height), 1.0f);
  const glm::ivec2 corner(free.corner * scale);
  const glm::ivec2 extent(free.size * scale);
  return 4 * extent.x < size.x ? PixelRect{0, 0, size.x, size.y} : PixelRect{corner.x, corner.y, extent.x, extent.y};
}

void Demo::setPresentMode(size_t index) {
  deviceView_.presentMode = index;
  renderer_.setPresentMode(renderer_.presentModes().at(index));
}

}  // namespace speculum
