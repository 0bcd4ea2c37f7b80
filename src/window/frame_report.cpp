#include "window/frame_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "edit/picture_view.hpp"
#include "plan/mirror_sight.hpp"
#include "plan/pass_mask.hpp"
#include "plan/view.hpp"
#include "session/session_subject.hpp"
#include "settings/setting_fields.hpp"

namespace speculum {

namespace {

constexpr double smoothing = 0.05;    // smallest weight of a frame in the times shown
constexpr double settlingMs = 500.0;  // a frame that takes longer is shown without averaging
constexpr size_t awaitedFrames = 4;   // frames whose GPU times may still arrive

ShownTarget targetOf(const FramePlan& plan, const Pass& pass, const Settings& settings, bool standardSampleLocations) {
  const View& view = pass.view;
  const auto texel = [&](const glm::dvec2& device) {
    return glm::vec2((0.5 * device + 0.5) * view.pictureSize - glm::dvec2(view.rect.x, view.rect.y));
  };
  ShownTarget target{.path = view.path,
                     .complete = endsPicture(plan),
                     .size = {view.rect.width, view.rect.height},
                     .near = plan.projection.near};
  if (!view.path.empty() && settings.debug.maskPasses) {
    const double reach = lookupReaches(plan, settings, standardSampleLocations)[&pass - plan.passes.data()];
    for (const glm::dvec2& p : passMask(view, plan.projection, reach)) {
      target.mask.push_back(texel(p));
    }
  }
  if (target.mask.empty()) {
    const glm::vec2 size(target.size);
    target.mask = {{0.0f, 0.0f}, {size.x, 0.0f}, size, {0.0f, size.y}};
  }
  for (const MirrorDraw& mirror : pass.mirrors) {
    std::vector<glm::vec2> outline;
    for (const glm::dvec4& clip : toClip(view, plan.projection, visiblePart(view, mirror.polygon))) {
      if (clip.w > 1e-12) {
        outline.push_back(texel(glm::dvec2(clip) / clip.w));
      }
    }
    target.mirrors.push_back(std::move(outline));
  }
  return target;
}

// Finds a pass in a list of rows or recorded passes.
template <typename Passes>
auto placeOf(Passes& passes, const PassId& wanted) {
  return std::ranges::find_if(passes, [&](const PassId& pass) { return pass == wanted; });
}

std::string_view reasonText(SkipReason reason) {
  static constexpr std::array<std::string_view, 10> texts = {
      "behind the eye",        "seen from behind", "outside the view",  "hidden",    "below Min. pixels",
      "below Min. throughput", "above Max. depth", "above Max. passes", "unchanged", "drawn by rays"};
  return texts[static_cast<size_t>(reason)];
}

std::string kindName(VkPhysicalDeviceType type) {
  constexpr std::array names{"other", "integrated GPU", "discrete GPU", "virtual GPU", "CPU"};  // in Vulkan's order
  return names[static_cast<size_t>(type)];
}

FeatureRow feature(const char* name, bool present, const char* without) {
  return {name, present, present ? "yes" : without};
}

}  // namespace

void FrameReport::clear() {
  shown_.passes.clear();
  shown_.skipped.clear();
  shown_.history.clear();
  shown_.target = {};
  shown_.timedGpuMs = 0.0;
  skipped_.clear();
}

void FrameReport::update(const RecordedFrame& frame, const FrameTimings& timings, Device& device,
                         SceneRenderer& sceneRenderer, const MirrorPath& hoveredPath) {
  const MemoryBudget budget = device.memoryBudget();
  shown_.deviceBytes = device.allocatedBytes();
  shown_.budgetBytes = budget.budgetBytes;
  shown_.usedBytes = budget.usedBytes;
  shown_.validationMessages = device.validation() ? device.validationMessages() : -1;
  shown_.target.value = sceneRenderer.probed();
  shown_.target.complete = sceneRenderer.keepsTarget(shown_.target.path, targetKind_);
  const std::span<const RecordedPass> timed = sceneRenderer.passesOf(timings.frame);
  updateTimes(frame, timings, timed);
  if (endsPicture(frame.plan)) {
    updatePasses(frame, sceneRenderer.passes());
    updateEffects(frame, sceneRenderer.ledger());
  }
  updateOutline(frame, hoveredPath);
  skipped_ = frame.plan.skipped;
  if (frame.panels) {
    updateSkipped(frame);
  } else {
    shown_.skipped.clear();  // rows of cached images would not follow what changes until panels are shown again
  }
}

void FrameReport::addFrame(const RecordedFrame& frame, const FrameTimings& timings,
                           std::span<const RecordedPass> timed) {
  if (beginsPicture(frame.plan)) {
    picture_ = {.whole = !frame.plan.tiles,
                .settings = frame.settings,
                .chosen = frame.chosen,
                .lowered = frame.lowered,
                .repeats = frame.repeats};
  } else if (timings.frame == picture_.number) {
    picture_.gpuMs += timings.gpuMs;
    picture_.addPasses(timings, timed);
  }
  picture_.compiles = picture_.compiles || frame.compiles;
  picture_.cpuMs += frame.cpuMs;
  picture_.sinceLastMs += frame.sinceLastMs;
  picture_.number = frame.number;
}

// Frames that draw only the panels change no figure but the times of passes: all others stay those of the last frame
// that drew another picture. A picture of several frames counts as one frame, the last; until then the figures are
// those of the picture before.
void FrameReport::updateTimes(const RecordedFrame& frame, const FrameTimings& timings,
                              std::span<const RecordedPass> timed) {
  addFrame(frame, timings, timed);
  const std::optional<TileRange>& tiles = frame.plan.tiles;
  shown_.target.share = tiles ? static_cast<double>(tiles->end) / static_cast<double>(tileCount(frame.plan)) : 0.0;
  const bool drawsScene = !frame.plan.mainReused() && !frame.repeats;
  shown_.still = !drawsScene || frame.plan.tiles;
  const bool drewScene = endsPicture(frame.plan) && !std::exchange(panelsOnly_, !drawsScene) && !drawn_.empty();
  if (endsPicture(frame.plan) && drawsScene) {
    const double ms = drewScene ? picture_.sinceLastMs : std::nan("");
    const auto average = [](double& shown, double now, bool begins) {
      shown += (begins ? 1.0 : std::clamp(now / settlingMs, smoothing, 1.0)) * (now - shown);
    };
    averages_ = averages_ && drewScene && !frame.plan.tiles;
    average(shown_.cpuMs, picture_.cpuMs, !drewScene);
    if (!std::isnan(ms) && !frame.plan.tiles) {
      average(shown_.frameMs, ms, !std::exchange(averages_, true));
    }
    // Figures of other settings would hide what the present settings cost.
    if (!sameMainView(std::exchange(historySettings_, picture_.chosen), picture_.chosen)) {
      shown_.history.restart();
    }
    if (!picture_.compiles) {
      shown_.history.add(frame.number, ms, picture_.cpuMs, picture_.lowered);
    }
  }
  if (endsPicture(frame.plan) && !frame.plan.mainReused()) {
    drawn_.push_front(picture_);
    drawn_.resize(std::min(drawn_.size(), awaitedFrames));
    tilesTimed_ = tilesTimed_ && frame.plan.tiles;
  }
  const auto drawn = std::ranges::find(drawn_, timings.frame, &Picture::number);
  if (drawn == drawn_.end()) {
    return;
  }
  const double gpuMs = drawn->gpuMs + timings.gpuMs;
  if (!drawn->repeats) {
    shown_.gpuMs = gpuMs;
    if (shown_.still || shown_.frameMs == 0.0) {
      shown_.cpuMs = drawn->cpuMs;
      shown_.frameMs = drawn->cpuMs + gpuMs;
    }
  }
  Picture picture = *drawn;
  picture.addPasses(timings, timed);
  std::vector<std::pair<std::string, double>> passes;
  if (drawn->whole) {
    for (const PassTiming& pass : timings.passes) {
      passes.emplace_back(pass.name, pass.gpuMs);
    }
  } else {
    tilesTimed_ = picture.timed;
    for (const TimedPass& pass : picture.timed ? picture.passes.passes() : std::vector<TimedPass>()) {
      passes.emplace_back(pass.name, pass.timing.gpuMs);
    }
  }
  if (picture.timed) {
    setTimes(picture, gpuMs);
  } else if (!drawn->whole) {
    shown_.timedGpuMs = 0.0;
  }
  if (!passes.empty()) {
    double rest = gpuMs;
    for (const auto& [name, ms] : passes) {
      rest -= ms;
    }
    passes.emplace_back("other work", std::max(rest, 0.0));
  }
  shown_.history.addGpu(timings.frame, gpuMs, passes);
}

// Sets the times of the listed passes to those of `picture`. The list may be that of a later picture.
void FrameReport::setTimes(const Picture& picture, double gpuMs) {
  shown_.timedGpuMs = gpuMs;
  timedSettings_ = picture.settings;
  timedLowered_ = picture.lowered;
  std::ranges::for_each(shown_.passes, [](PassRow& row) { row.timed = false; });
  for (const TimedPass& pass : picture.passes.passes()) {
    if (const auto row = placeOf(shown_.passes, pass); row != shown_.passes.end()) {
      row->gpuMs = pass.timing.gpuMs;
      row->timed = true;
    }
  }
}

// Lists passes of cached images too, because nobody can read a list that changes from frame to frame.
void FrameReport::updatePasses(const RecordedFrame& frame, std::span<const RecordedPass> passes) {
  const FramePlan& plan = frame.plan;
  const int interval = mostAsked(frame.scene, frame.settings).updateInterval;
  const auto reuses = [](const Pass& pass) { return pass.source == PassSource::reused && !pass.isFace(); };
  const auto isReused = [&](const PassRow& row) {
    return std::ranges::any_of(plan.passes, [&](const Pass& pass) { return reuses(pass) && pass.id == row; });
  };
  std::vector<PassRow> rows;
  if (interval > 1 || std::ranges::any_of(plan.passes, reuses)) {
    rows = std::move(shown_.passes);
  }
  for (PassRow& row : rows) {
    ++row.framesAgo;
    row.reused = plan.mainReused() ? row.reused : isReused(row);
  }
  std::ptrdiff_t index = 0;
  for (const RecordedPass& pass : passes) {
    auto row = placeOf(rows, pass);
    if (row == rows.end()) {
      PassRow fresh{pass, pass.name};
      const auto before = placeOf(shown_.passes, pass);
      fresh.gpuMs = before == shown_.passes.end() ? std::nan("") : before->gpuMs;  // only some frames time passes
      fresh.timed = before != shown_.passes.end() && before->timed;
      row = rows.insert(rows.begin() + index, std::move(fresh));
    }
    row->areaPx = pass.areaPx;
    row->draws = pass.draws;
    const Pass* planned = mirrorPass(plan, pass.path);
    row->resolution = planned ? depthReadout(*planned, plan.projection, frame.scene, frame.state) : std::nullopt;
    row->framesAgo = 0;
    row->reused = false;
    index = row - rows.begin() + 1;
  }
  std::erase_if(rows, [&](const PassRow& row) { return row.framesAgo >= interval && !isReused(row); });
  // Times of another quality say nothing about this picture, times of other settings little.
  const bool otherQuality = timedLowered_ != frame.lowered || (plan.tiles && !tilesTimed_);
  if (!plan.mainReused() && (otherQuality || !sameMainView(timedSettings_, frame.settings))) {
    shown_.timedGpuMs = 0.0;
    for (PassRow& row : rows) {
      row.gpuMs = otherQuality ? std::nan("") : row.gpuMs;
      row.timed = false;
    }
  }
  shown_.passes = std::move(rows);
}

void FrameReport::updateEffects(const RecordedFrame& frame, const EffectLedger& ledger) {
  shown_.effects.clear();
  shown_.rays.clear();
  if (const RayUse& rays = ledger.rays; rays.traced) {
    shown_.rays = rays.hardware ? "Rays by ray queries (" : "Rays by shaders (";
    shown_.rays += std::string(rays.why) + ")";
  }
  for (const Effect& effect : effectsOf(frame.scene, frame.state, frame.settings, frame.plan)) {
    EffectRow& view = shown_.effects.emplace_back(EffectRow{effect, ledger[effect.kind]});
    view.name = findSettingField(settingsWithout(effect).front().key)->label;  // of the effect's switch
  }
}

// Outlines the part of the hovered mirror that the view in which it is drawn shows. The outline ends where that view
// ends.
void FrameReport::updateOutline(const RecordedFrame& frame, const MirrorPath& hovered) {
  shown_.outlinedPath.clear();
  shown_.outline.clear();
  // The path is that of the last frame; an edit may have removed mirrors since.
  const auto exists = [&](int mirror) { return static_cast<size_t>(mirror) < frame.state.mirrors.size(); };
  if (!hovered.empty() && std::ranges::all_of(hovered, exists)) {
    const PictureView picture(frame.state.camera, frame.plan.width, frame.plan.height);
    const std::span<const int> before = std::span(hovered).first(hovered.size() - 1);
    if (const auto image = picture.through(frame.scene, frame.state, before)) {
      shown_.outlinedPath = hovered;
      const Polygon part = visiblePart(image->view(), frame.state.mirrors[hovered.back()].polygon);
      for (size_t i = 0; i < part.size(); ++i) {
        const auto from = image->pixel(part[i]);
        const auto to = image->pixel(part[(i + 1) % part.size()]);
        if (from && to) {
          shown_.outline.push_back({*from, *to});
        }
      }
    }
  }
}

// A plan does not list the mirrors skipped in cached images, so the rows of the frame that rendered such an image stay.
void FrameReport::updateSkipped(const RecordedFrame& frame) {
  const RecycledVector<SkippedMirror> skipped = skippedMirrors(frame.scene, frame.state, frame.plan, mostListed);
  const std::vector<SkippedRow> before = std::exchange(shown_.skipped, {});
  for (const SkippedMirror& skip : skipped) {
    shown_.skipped.push_back({mirrorPathName(frame.scene, skip.path), skip.path, std::string(reasonText(skip.reason)),
                              std::string(skip.detail), skip.reason == SkipReason::rays});
  }
  std::set<int> reused;  // mirrors seen directly in cached images
  for (const Pass& pass : frame.plan.passes) {
    if (pass.source == PassSource::reused && pass.view.path.size() == 1) {
      reused.insert(pass.view.path.front());
    }
  }
  std::set<MirrorPath> listed;
  for (const SkippedMirror& skip : skipped) {
    if (reused.contains(skip.path.front())) {
      listed.insert(skip.path);
    }
  }
  for (const SkippedRow& skip : before) {
    if (skip.path.size() > 1 && reused.contains(skip.path.front()) && listed.insert(skip.path).second) {
      shown_.skipped.push_back(skip);
    }
  }
}

std::optional<TargetDisplay> FrameReport::target(const TargetRequest& request, const FramePlan& plan,
                                                 const Settings& settings, bool standardSampleLocations) {
  const Pass* mirror = mirrorPass(plan, request.path);
  if (!mirror && !request.path.empty()) {
    return std::nullopt;
  }
  targetKind_ = request.display.kind;
  // While tiles are drawn, the target of the picture before stays.
  if (endsPicture(plan) || !shown_.target.complete || shown_.target.path != request.path) {
    const std::optional<TexelValue> value = shown_.target.value;
    shown_.target = targetOf(plan, mirror ? *mirror : plan.main(), settings, standardSampleLocations);
    shown_.target.value = value;
  }
  if (!request.drawn) {
    return std::nullopt;
  }
  TargetDisplay display = request.display;
  display.pass = static_cast<int>((mirror ? mirror : &plan.main()) - plan.passes.data());
  // The image may have become smaller since the pointer was there.
  if (display.probe && (display.probe->x >= shown_.target.size.x || display.probe->y >= shown_.target.size.y)) {
    display.probe.reset();
  }
  return display;
}

ShownDevice shownDevice(const Renderer& renderer, const Device& device) {
  const DeviceInfo& info = device.info();
  const DeviceCaps& caps = device.caps();
  ShownDevice view{.name = info.name,
                   .kind = kindName(info.type),
                   .driver = info.driver,
                   .vulkan = info.vulkanVersion(),
                   .renderPath = std::string(renderPathName(device.renderPath())),
                   .samples = sampleCountsOf(device)};
  view.features = {feature("dynamic rendering", caps.dynamicRendering, "render passes are used"),
                   feature("timestamps", caps.timestampValidBits > 0, "no times of passes"),
                   feature("pipeline statistics", caps.pipelineStatistics, "no triangles and fragments"),
                   feature("precise occlusion", caps.countsSamples, "samples drawn are not counted"),
                   feature("geometry shaders", caps.primitiveId, "no effect that traces rays"),
                   feature("sample shading", caps.sampleRateShading, "samples share a shading"),
                   feature("depth clamp", caps.depthClamp, "the near plane cuts"),
                   feature("wireframe", caps.fillModeNonSolid, "no wireframe"),
                   feature("wide lines", caps.wideLines, "wireframe is one pixel wide"),
                   feature("anisotropic filter", caps.anisotropy, "shaders filter instead"),
                   feature("dynamic polygon mode", caps.dynamicPolygonMode, "wireframe has pipelines of its own"),
                   feature("ray queries", caps.rayQueries, "shaders trace all rays"),
                   feature("memory budget", caps.memoryBudget, "the size of the heaps is used")};
  if (!renderer.headless()) {
    view.features.push_back(
        feature("UNORM surface", !renderer.copiesDisplay(), "sRGB only: pictures are copied into it"));
  }
  const std::vector<PresentMode> modes = renderer.presentModes();
  for (const PresentMode mode : modes) {
    view.presentModes.emplace_back(presentModeName(mode));
  }
  const auto mode = std::ranges::find(modes, renderer.presentMode());
  view.presentMode = static_cast<size_t>(mode - modes.begin());
  return view;
}

}  // namespace speculum
