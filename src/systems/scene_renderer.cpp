#include "systems/scene_renderer.hpp"

#include <algorithm>
#include <utility>

#include "frame/environment_map.hpp"
#include "frame/memory_fit.hpp"
#include "frame/mesh_level.hpp"
#include "frame/scene_names.hpp"
#include "image/color.hpp"

namespace speculum {

namespace {

VkRect2D areaOf(const PixelRect& rect) {
  return {{0, 0}, {static_cast<uint32_t>(rect.width), static_cast<uint32_t>(rect.height)}};
}

std::array<float, 4> clearColor(const Environment& environment) {
  const glm::vec3 color(glm::min(environment.background, glm::dvec3(65504.0)));
  return {color.r, color.g, color.b, 0.0f};  // infinitely far
}

// The rectangle's corner is the target's; the viewport is as large as what is drawn of the picture's plane.
PassViewport viewportOf(const View& view) {
  const glm::dvec2 size = overscan(view) * view.pictureSize;
  const glm::dvec2 corner = 0.5 * (view.pictureSize - size) - glm::dvec2(view.rect.x, view.rect.y);
  return {static_cast<float>(corner.x), static_cast<float>(corner.y), static_cast<float>(size.x),
          static_cast<float>(size.y)};
}

VkFrontFace frontFace(const View& view) {
  return view.mirrored() ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE;
}

}  // namespace

SceneRenderer::SceneRenderer(Renderer& renderer, const Scene& scene)
    : renderer_(renderer),
      device_(renderer.device()),
      scene_(scene),
      resources_(device_, renderer.uploader(), scene),
      data_(device_),
      trace_(device_, renderer.uploader(), scene),
      maskSystem_(renderer.pipelines(), data_.layout()),
      renderSystem_(renderer.pipelines(), data_.layout(), resources_.textureLayout()),
      pointLightSystem_(renderer.pipelines(), data_.layout()),
      mirrorSystem_(device_, renderer.uploader(), renderer.pipelines(), data_.layout()),
      watch_(renderer),
      display_(renderer),
      watchedDepth_(std::make_unique<KeptDepth>(renderer, display_.layout())),
      probe_(renderer),
      mirrorTargets_(device_),
      environmentTargets_(device_) {}

SceneRenderer::~SceneRenderer() {
  renderer_.waitIdle();
}

size_t SceneRenderer::pipelineCount() const {
  return maskSystem_.pipelineCount() + renderSystem_.pipelineCount() + pointLightSystem_.pipelineCount() +
         mirrorSystem_.pipelineCount() + display_.pipelineCount() + watch_.pipelineCount() +
         watchedDepth_->pipelineCount() + probe_.pipelineCount();
}

const FiniteWatch& SceneRenderer::finiteWatch() {
  watch_.collect();
  return watch_;
}

void SceneRenderer::uploadTextures(Frame& frame, const SceneState& state, const Settings& settings,
                                   const FramePlan& plan) {
  resources_.upload(frame, settings.effects.textures, drawsTextures(scene_, state, settings, plan));
}

void SceneRenderer::record(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan,
                           const std::optional<DebugView>& debug) {
  const bool ofMirror = debug && debug->pass < static_cast<int>(plan.passes.size());
  releaseViews(debug, *frame.retired);
  mirrorTargets_.begin(plan, device_.sampleCount(settings.reflection.samples),
                       ofMirror ? std::optional(debug->pass) : std::nullopt, *frame.retired);
  prepareMain(settings, plan, *frame.retired);
  prepareMaps(frame, plan);
  resources_.prepare(frame, settings.effects.textures, drawsTextures(scene_, state, settings, plan));
  resources_.prepareLevels(frame, meshesWithLevels(plan, state));
  const Environment environment = effectiveEnvironment(scene_, settings);
  data_.build(frame, resources_, scene_, state, settings, environment, plan);
  trace_.build(frame, state, settings, plan.effects);
  if (!plan.mainReused) {
    ledger_ = {};
  }
  recorded_.clear();
  const FrameInfo info{frame,
                       scene_,
                       settings,
                       environment,
                       plan,
                       resources_,
                       data_,
                       trace_,
                       ledger_,
                       mirrorTargets_.images(),
                       mirrorTargets_.cached(),
                       mapSets_};
  recordPasses(frame, info);
  recorded_.push_back(display_.record(frame, {.descriptor = main_->descriptor()}, settings));
  if (debug) {
    recordDebugView(frame, settings, plan, *debug);
    recordProbe(frame, plan, *debug);
  }
  endRecord(settings, plan, *frame.retired);
}

// Those of maps, mirrors and the main view.
void SceneRenderer::recordPasses(Frame& frame, const FrameInfo& info) {
  const FramePlan& plan = info.plan;
  if (info.settings.debug.checkFinite) {
    watch_.begin(frame, plan.maps.size() + plan.passes.size() + 2);  // the main view's samples and their mean
  } else {
    watch_.release();
  }
  size_t facePass = plan.passes.size() + 1;
  for (size_t i = 0; i < plan.maps.size(); ++i) {
    if (plan.maps[i].cacheIndex < 0) {
      recordMap(frame, info, i, facePass);
      facePass += plan.maps[i].faces.size();
    }
  }
  for (const PassRange& range : independentPasses(plan)) {
    recordMirrorPasses(frame, info, range);
  }
  if (!plan.mainReused) {
    recordMainPass(frame, info);
  }
  if (info.settings.debug.checkFinite) {
    watch_.end(frame);
  }
}

// Gives back what no frame needed for a while.
void SceneRenderer::endRecord(const Settings& settings, const FramePlan& plan, RetireQueue& retired) {
  const bool imagesShown = !plan.reused.empty() || plan.mainReused;
  renderSystem_.endFrame(trace_.variant(), imagesShown, plan.effects.curved.has_value());
  mirrorSystem_.endFrame(trace_.variant(), imagesShown);
  pointLightSystem_.endFrame(
      (plan.mainReused && !plan.main.lights.empty()) ||
      std::any_of(plan.reused.begin(), plan.reused.end(), [](const auto& p) { return !p.lights.empty(); }));
  if (!plan.mainReused) {
    finishLedger(settings, plan);
  }
  mainImage_ = {settings, plan.mainContent};
  mirrorTargets_.end(plan, retired);
  cacheRevision_ = renderer_.pipelines().revision();
  environmentTargets_.endFrame(plan, retired);
}

// What looking at targets took, as soon as nobody does.
void SceneRenderer::releaseViews(const std::optional<DebugView>& debug, RetireQueue& retired) {
  depthPass_ = debug && debug->kind == TargetKind::depth ? std::optional(debug->pass) : std::nullopt;
  if (!depthPass_) {
    watchedDepth_->release(retired);
  }
  if (!debug || !debug->probe) {
    probe_.release();
  }
  if (!debug) {
    display_.releaseView();
  }
}

// What is not entered draw by draw.
void SceneRenderer::finishLedger(const Settings& settings, const FramePlan& plan) {
  const TracedEffects& effects = plan.effects;
  Settings single = settings;
  single.view.samples = 1;
  single.reflection.samples = 1;
  ledger_[EffectKind::msaa].bytes = targetBytes(plan, settings) - targetBytes(plan, single);
  for (const RecordedPass& pass : recorded_) {
    const bool ofMirror = pass.kind == PassKind::mirror;
    const int samples = ofMirror ? settings.reflection.samples : settings.view.samples;
    const bool scene = ofMirror || pass.kind == PassKind::main;
    ledger_[EffectKind::msaa].draws += scene && samples > 1 ? pass.draws : 0;
  }
  ledger_[EffectKind::textures].bytes = ledger_[EffectKind::textures].draws > 0 ? resources_.textureBytes() : 0;
  ledger_[EffectKind::toneMap].draws = settings.view.toneMap == ToneMap::aces ? 1 : 0;
  for (const auto& [kind, caller] :
       {std::pair(EffectKind::shadows, &effects.shadows), std::pair(EffectKind::roughness, &effects.roughness),
        std::pair(EffectKind::ripple, &effects.ripple), std::pair(EffectKind::castsLight, &effects.castsLight),
        std::pair(EffectKind::curved, &effects.curved)}) {
    const bool traces = *caller && (kind != EffectKind::roughness || effects.roughRays) &&
                        (kind != EffectKind::curved || effects.curvedRays);
    ledger_[kind].bytes = traces ? trace_.bytes() : 0;
  }
  ledger_[EffectKind::curved].bytes += environmentTargets_.bytes();
  ledger_[EffectKind::glyphs].pipelines = static_cast<uint32_t>(pointLightSystem_.pipelineCount());
  display_.countPipelines(ledger_);
  renderSystem_.countPipelines(ledger_);
  mirrorSystem_.countPipelines(ledger_);
}

FrameCache SceneRenderer::cache() const {
  if (cacheRevision_ != renderer_.pipelines().revision()) {
    return {};
  }
  return {.images = mirrorTargets_.cachedImages(),
          .maps = environmentTargets_.cached(),
          .main = mainImage_.content.empty() ? nullptr : &mainImage_};
}

void SceneRenderer::restart() {
  mainImage_ = {};
  environmentTargets_.restart();
  mirrorTargets_.restart();
}

void SceneRenderer::prepareMain(const Settings& settings, const FramePlan& plan, RetireQueue& retired) {
  const VkExtent2D extent{static_cast<uint32_t>(plan.width), static_cast<uint32_t>(plan.height)};
  const VkSampleCountFlagBits mainSamples = device_.sampleCount(settings.view.samples);
  const bool readSamples = settings.debug.checkFinite && mainSamples != VK_SAMPLE_COUNT_1_BIT;
  if (!main_ || main_->samples() != mainSamples || main_->desc().readSamples != readSamples) {
    if (main_) {
      main_->retire(retired);
    }
    const OffScreenDesc desc{.name = "main view",
                             .extent = extent,
                             .samples = mainSamples,
                             .readSamples = readSamples,
                             .role = TargetRole::main};
    main_ = std::make_unique<OffScreen>(device_, desc, retired);
  }
  main_->resize(extent, retired);
}

uint32_t SceneRenderer::recordSystems(const PassScope& scope, const FrameInfo& info, size_t pass,
                                      const PassFormat& format) {
  uint32_t draws = mirrorSystem_.record(scope, info, pass, format);
  draws += pointLightSystem_.record(scope, info, pass, format);
  draws += renderSystem_.record(scope, info, pass, format);
  return draws;
}

// Samples before their mean: it hides what is negative in one of them.
void SceneRenderer::checkTarget(Frame& frame, const FrameInfo& info, const RecordedPass& pass, OffScreen& target,
                                VkExtent2D used) {
  if (!info.settings.debug.checkFinite) {
    return;
  }
  if (Image* samples = target.samplesImage()) {
    watch_.check(frame, pass.name + " (samples)", pass.path, *samples, target.samplesDescriptor(), used);
  }
  watch_.check(frame, pass.name, pass.path, target.color(), target.descriptor(), used);
}

void SceneRenderer::prepareMaps(Frame& frame, const FramePlan& plan) {
  environmentTargets_.prepare(plan, *frame.retired);
  mapSets_.clear();
  for (size_t i = 0; i < plan.maps.size(); ++i) {
    mapSets_.push_back(frame.descriptors->allocate(resources_.textureLayout()));
    DescriptorWriter().image(0, environmentTargets_[i].descriptor()).update(device_, mapSets_.back());
  }
}

// `firstPass`: of its faces, in info.data.
void SceneRenderer::recordMap(Frame& frame, const FrameInfo& info, size_t map, size_t firstPass) {
  const EnvironmentMap& planned = info.plan.maps[map];
  OffScreen& target = environmentTargets_[map];
  const auto size = static_cast<uint32_t>(planned.size);
  for (size_t face = 0; face < planned.faces.size(); ++face) {
    const glm::ivec2 corner = faceCorner(planned, face);
    const PlannedPass& pass = planned.faces[face];
    RecordedPass recorded{.name = "environment of " + planned.name + " " + faceAxes()[face].name,
                          .kind = PassKind::environment,
                          .areaPx = pass.areaPx};
    const VkRect2D area{{corner.x, corner.y}, {size, size}};
    const uint32_t drawsBefore = ledger_[EffectKind::curved].draws;
    const PassDesc desc{.name = recorded.name,
                        .targets = target.targets(),
                        .renderArea = area,
                        .viewport = {static_cast<float>(corner.x), static_cast<float>(corner.y),
                                     static_cast<float>(size), static_cast<float>(size)},
                        .scissor = area,
                        .frontFace = frontFace(pass.view),
                        .clearColor = clearColor(info.environment),
                        .collectStatistics = true};
    {
      PassScope scope = renderer_.beginPass(frame, desc);
      scope.countSamples();
      recorded.draws = recordSystems(scope, info, firstPass + face, {.samples = target.samples()});
    }
    ledger_[EffectKind::curved].draws = drawsBefore + recorded.draws;  // curved mirrors in it were entered already
    recorded_.push_back(std::move(recorded));
  }
  checkTarget(frame, info, recorded_.back(), target, {3 * size, 2 * size});
}

PassDesc SceneRenderer::mirrorPass(const FrameInfo& info, size_t index, const PassTargets& targets) const {
  const View& view = info.plan.passes[index].view;
  const VkRect2D area = areaOf(view.rect);
  return {.name = "mirror " + mirrorPathName(scene_, view.path),
          .targets = targets,
          .renderArea = area,
          .viewport = viewportOf(view),
          .scissor = area,
          .frontFace = frontFace(view),
          .clearColor = clearColor(info.environment),
          .clearDepth = MaskSystem::clearDepth(info.data.passes()[index]),
          .collectStatistics = true,
          .grouped = true};
}

RecordedPass SceneRenderer::recordMirrorPass(Frame& frame, const FrameInfo& info, size_t index, const PassDesc& desc) {
  const PlannedPass& pass = info.plan.passes[index];
  RecordedPass recorded{.name = desc.name, .path = pass.view.path, .depth = pass.depth, .areaPx = pass.areaPx};
  PassScope scope = renderer_.beginPass(frame, desc);
  const PassFormat format{.samples = desc.targets.samples(), .mirrorView = true};
  recorded.draws = maskSystem_.record(scope, info, index, format);
  scope.countSamples();
  recorded.draws += recordSystems(scope, info, index, format);
  return recorded;
}

// Images are given back and checked when the whole range is drawn: barriers stand around it.
void SceneRenderer::recordMirrorPasses(Frame& frame, const FrameInfo& info, const PassRange& range) {
  const std::vector<PassTargets> targets = mirrorTargets_.acquire(info.plan, range, *frame.retired);
  std::vector<PassDesc> passes;
  for (size_t i = range.first; i < range.end; ++i) {
    passes.push_back(mirrorPass(info, i, targets[i - range.first]));
    if (keepsDepth(i)) {
      watchedDepth_->prepare(passes.back(), *frame.retired);
    }
  }
  {
    const PassGroup group = renderer_.beginGroup(frame, passes);
    for (size_t i = range.first; i < range.end; ++i) {
      recorded_.push_back(recordMirrorPass(frame, info, i, passes[i - range.first]));
    }
  }
  for (size_t i = range.first; i < range.end; ++i) {
    if (keepsDepth(i)) {
      watchedDepth_->finish(frame.commands);
    }
    checkTarget(frame, info, recorded_[recorded_.size() - range.end + i], mirrorTargets_[i],
                passes[i - range.first].renderArea.extent);
    mirrorTargets_.releaseShown(info.plan, info.plan.passes[i]);
  }
}

void SceneRenderer::recordMainPass(Frame& frame, const FrameInfo& info) {
  PassDesc desc = fullPass("main view", main_->targets());
  desc.clearColor = clearColor(info.environment);
  desc.frontFace = frontFace(info.plan.main.view);
  desc.collectStatistics = true;
  desc.storeSamples = main_->desc().readSamples;
  RecordedPass recorded{.name = desc.name, .kind = PassKind::main, .areaPx = info.plan.main.areaPx};
  const size_t index = info.plan.passes.size();
  if (keepsDepth(index)) {
    watchedDepth_->prepare(desc, *frame.retired);
  }
  {
    PassScope scope = renderer_.beginPass(frame, desc);
    scope.countSamples();
    recorded.draws = recordSystems(scope, info, index, {.samples = main_->samples()});
  }
  if (keepsDepth(index)) {
    watchedDepth_->finish(frame.commands);
  }
  recorded_.push_back(std::move(recorded));
  checkTarget(frame, info, recorded_.back(), *main_, main_->extent());
  mirrorTargets_.releaseShown(info.plan, info.plan.main);
}

void SceneRenderer::recordDebugView(Frame& frame, const Settings& settings, const FramePlan& plan,
                                    const DebugView& debug) {
  const bool ofMain = debug.pass == static_cast<int>(plan.passes.size());
  const MirrorImage color =
      ofMain ? MirrorImage{.descriptor = main_->descriptor()} : mirrorTargets_.images()[debug.pass];
  const bool ofDepth = depthPass_ && watchedDepth_->exists();
  const auto pass = ofDepth ? display_.recordDepth(frame, plan, debug, *watchedDepth_)
                            : display_.recordColor(frame, plan, debug, color, settings);
  if (pass) {
    recorded_.push_back(*pass);
  }
}

LinearImage SceneRenderer::radiance() {
  renderer_.waitIdle();
  const std::vector<float> texels = renderer_.uploader().readFloats(main_->color());
  const VkExtent2D extent = main_->color().extent();
  LinearImage image(static_cast<int>(extent.width), static_cast<int>(extent.height));
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = {texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]};
  }
  return image;
}

void SceneRenderer::recordProbe(Frame& frame, const FramePlan& plan, const DebugView& debug) {
  if (!debug.probe) {
    return;
  }
  if (depthPass_ && watchedDepth_->exists()) {
    return probe_.probe(frame, watchedDepth_->image(), watchedDepth_->descriptor(), *debug.probe);
  }
  OffScreen& target =
      debug.pass == static_cast<int>(plan.passes.size()) ? *main_ : mirrorTargets_[static_cast<size_t>(debug.pass)];
  probe_.probe(frame, target.color(), target.descriptor(), *debug.probe);
}

}  // namespace speculum
