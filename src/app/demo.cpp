#include "app/demo.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>

#include "app/pass_outlines.hpp"
#include "app/screenshot.hpp"
#include "frame/scene_names.hpp"
#include "image/picture_files.hpp"
#include "platform/process.hpp"
#include "ui/panels.hpp"

namespace speculum {

namespace {

constexpr double smoothing = 0.05;  // of the CPU time shown

}  // namespace

Demo::Demo(const Options& options)
    : options_(options),
      loaded_(std::make_unique<LoadedScene>(loadSceneWithSettings(options))),
      window_({.title = "Speculum", .width = options.size.width, .height = options.size.height}),
      device_(deviceOptions(options, &window_)),
      renderer_(device_, rendererOptions(options, &window_)),
      sceneRenderer_(std::make_unique<SceneRenderer>(renderer_, loaded_->scene)),
      planner_(device_),
      accuracy_(options, loaded_->settings, model_) {
  applyDebugSettings(loaded_->settings, device_);
  installInput();
  ui_ = std::make_unique<SimpleUI>(renderer_, window_);
  findScenes();
  findModels();
  model_.settings = loaded_->settings;
  model_.sceneSettings = loaded_->settings;
  showDevice();
  model_.accuracy.choice = loaded_->quality ? loaded_->quality->why : "";
  camera_.reset(loaded_->scene.camera);
  startEditing();
  last_ = Clock::now();
}

void Demo::applyModel() {
  if (model_.resetSettings) {
    model_.settings = loaded_->settings;
  }
  if (model_.resetCamera) {
    camera_.reset(loaded_->scene.camera);
  }
  applyEdit();
  applyBookmarks();
  if (model_.scene != shownScene_) {
    chooseScene(std::exchange(model_.scene, shownScene_));
  }
  followLoading();
  if (model_.copyCommand) {
    copyCommand();
  }
  if (model_.screenshot) {
    shot_ = Shot::window;
  }
  if (model_.copyHistory) {
    window_.setClipboard(model_.history.csv());
  }
  if (model_.copyLog) {
    window_.setClipboard(logText(shownLog(model_)));
  }
  applyPresentMode();
  if (model_.seek) {
    goTo(*model_.seek);
  }
  std::filesystem::path measured;
  if (model_.accuracy.measure) {
    measured = fileOfView(model_.accuracy.about);
    model_.accuracy.measure = !measured.empty();
  }
  accuracy_.apply(model_, [&] { return sweepRequest(measured); });
}

void Demo::saveShot() {
  if (recorder_.running()) {
    recorder_.add(pictureOf(renderer_.readback()));
    show(recorder_.message());
  }
  if (std::exchange(shot_, Shot::none) == Shot::none) {
    return;
  }
  try {
    const std::filesystem::path file = newPictureFile(loaded_->scene.file.stem().string());
    writePng(file, pictureOf(renderer_.readback()));
    tell("saved " + file.string());
  } catch (const std::exception& error) {
    tell("not saved: " + std::string(error.what()));
  }
}

void Demo::drawFrame(double seconds) {
  seconds = recorder_.running() ? 1.0 / Recorder::framesPerSecond : seconds;
  moveCamera(seconds);
  showEdit(seconds);
  followStatus();
  ui_->build(model_);
  applyModel();
  time_ += model_.paused ? 0.0 : seconds * model_.timeSpeed;
  const Clock::time_point start = Clock::now();
  renderer_.setTimerDetail(ui_->visible() ? TimerDetail::passes : TimerDetail::frame);
  std::optional<Frame> frame = renderer_.beginFrame();
  if (!frame) {
    return;
  }
  SceneState state = evaluate(loaded_->scene, time_);
  state.camera = camera_.pose(state.camera);
  Settings settings = model_.settings;
  if (settings.debug.checkFinite) {
    settings.reflection.skipUnchanged = false;  // so that what is found names the mirror in every frame
  }
  watched_ = model_.debugPass >= 0 ? std::optional(model_.passes[model_.debugPass].path) : std::nullopt;
  if (watched_ && !watched_->empty()) {
    settings.reflection.updateInterval = 1;  // the image is there to be shown in every frame
    settings.reflection.skipUnchanged = false;
  }
  const FittedPlan fitted = planAndUpload(*frame, state, settings);
  const FramePlan& plan = fitted.plan;
  const bool bare = shot_ == Shot::picture || recorder_.bare();
  sceneRenderer_->record(*frame, state, fitted.settings, plan, bare ? std::nullopt : debugView(plan, fitted.settings));
  if (!bare) {
    const PassScope scope = renderer_.beginOverlay(*frame);
    ui_->record(scope);
  }
  const double cpuMs = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  model_.cpuMs += smoothing * (cpuMs - model_.cpuMs);
  noteTimes(frame->number, cpuMs);
  frame->capture = capture_ || shot_ != Shot::none || recorder_.running();
  renderer_.endFrame(*frame);
  saveShot();
  ++framesDrawn_;
  framesDue_ = std::max(0, framesDue_ - 1);
  fillModel(plan, state, fitted.settings);
  accuracy_.update(model_, {loaded_->scene, state, fitted.settings, plan.width, plan.height}, *sceneRenderer_);
}

// Lists the passes of as many frames as it takes to render each image, and those that cached images replace: a list
// that changed from frame to frame could not be read.
void Demo::fillPasses(const FramePlan& plan, const SceneState& state, int updateInterval) {
  const FrameTimings& timings = renderer_.timings();
  const auto isShown = [&](const UiPass& row) {
    return (plan.mainReused && row.kind == PassKind::main) ||
           std::any_of(plan.reused.begin(), plan.reused.end(),
                       [&](const PlannedPass& p) { return p.view.path == row.path; });
  };
  std::vector<UiPass> rows;
  if (updateInterval > 1 || !plan.reused.empty() || plan.mainReused) {
    rows = std::move(model_.passes);
  }
  for (UiPass& row : rows) {
    ++row.framesAgo;
  }
  std::ptrdiff_t place = 0;
  for (const RecordedPass& pass : sceneRenderer_->passes()) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const UiPass& r) { return r.id == pass; });
    if (row == rows.end()) {
      row =
          rows.insert(rows.begin() + place,
                      UiPass{.name = pass.name, .path = pass.path, .depth = pass.depth, .kind = pass.kind, .id = pass});
    }
    row->areaPx = pass.areaPx;
    row->draws = pass.draws;
    const auto planned = std::find_if(plan.passes.begin(), plan.passes.end(),
                                      [&](const PlannedPass& p) { return p.view.path == pass.path; });
    row->resolution =
        planned != plan.passes.end() ? depthReadout(*planned, plan.projection, loaded_->scene, state) : std::nullopt;
    row->outline = outlineOf(plan, pass.path, plan.width, plan.height);
    row->framesAgo = 0;
    place = row - rows.begin() + 1;
  }
  std::erase_if(rows, [&](const UiPass& row) { return row.framesAgo >= updateInterval && !isShown(row); });
  // The times are of an earlier frame, whose plan may have differed.
  const std::span<const RecordedPass> timed = sceneRenderer_->passesOf(timings.frame);
  for (size_t i = 0; i < std::min(timed.size(), timings.passes.size()); ++i) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const UiPass& r) { return r.id == timed[i]; });
    if (row != rows.end()) {
      row->gpuMs = timings.passes[i].gpuMs;
    }
  }
  model_.passes = std::move(rows);
  const auto shown = std::find_if(model_.passes.begin(), model_.passes.end(), [&](const UiPass& row) {
    return watched_ && panels::hasTarget(row) && row.path == *watched_;
  });
  model_.debugPass = shown != model_.passes.end() ? static_cast<int>(shown - model_.passes.begin()) : -1;
}

void Demo::fillEffects(const FramePlan& plan, const SceneState& state, const Settings& drawn) {
  model_.effects.clear();
  const EffectLedger& ledger = sceneRenderer_->ledger();
  for (const Effect& effect : effectsOf(loaded_->scene, state, drawn, plan)) {
    const EffectCost& cost = ledger[static_cast<EffectKind>(model_.effects.size())];
    model_.effects.push_back({effect.name, effect.calledFor, effect.why, cost.draws, cost.bytes, cost.pipelines});
  }
}

void Demo::fillModel(const FramePlan& plan, const SceneState& state, const Settings& drawn) {
  const FrameTimings& timings = renderer_.timings();
  model_.sceneBackground = glm::vec3(loaded_->scene.environment.background);
  model_.sceneSky = loaded_->scene.environment.sky.has_value();
  model_.gpuMs = timings.gpuMs;
  model_.deviceBytes = device_.allocatedBytes();
  showMemory();
  model_.validationMessages = device_.validation() ? device_.validationMessages() : -1;
  model_.message = sceneError_.empty() ? renderer_.pipelines().errors() : sceneError_;
  const FiniteWatch& watch = sceneRenderer_->finiteWatch();
  if (model_.message.empty() && watch.findingsFrame() > 0 && watch.findingsFrame() == timings.frame) {
    model_.message = describe(watch.findings().front());
  }
  if (model_.message.empty()) {
    model_.message = texturesRefused_ ? texturesRefused_->problem : "";
    model_.message += !model_.message.empty() && !planner_.message().empty() ? "; " : "";
    model_.message += planner_.message();
  }
  model_.time = time_;
  fillPasses(plan, state, drawn.reflection.updateInterval);
  fillEffects(plan, state, drawn);
  showTexel(plan);
  outlineSkipped(plan, state);
  skipped_ = plan.skipped;
  model_.skipped.clear();
  for (const SkippedMirror& skip : plan.skipped) {
    model_.skipped.push_back(
        {mirrorPathName(loaded_->scene, skip.path), std::string(skipReasonName(skip.reason)), skip.detail, skip.path});
  }
}

int runDemo(const Options& options) {
  installInterruptHandler();
  Demo demo(options);
  while (demo.step() && !interruptRequested() && (options.frames == 0 || demo.framesDrawn() < options.frames)) {
  }
  demo.renderer().waitIdle();
  spdlog::info("{} frames", demo.framesDrawn());
  return exitCodeOfChecks(demo.device().validationMessages(), demo.nonFinite());
}

}  // namespace speculum
