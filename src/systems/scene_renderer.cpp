#include "systems/scene_renderer.hpp"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <utility>

#include "frame/environment_map.hpp"
#include "frame/memory_fit.hpp"

namespace speculum {

namespace {

constexpr const char* mainName = "main view";

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

// Whether the image that a pass renders is kept for the next frame.
bool isHeld(const FramePlan& plan, int pass) {
  return std::any_of(plan.held.begin(), plan.held.end(), [&](const HeldImage& image) { return image.pass == pass; });
}

}  // namespace

std::string mirrorName(const Scene& scene, int mirror) {
  const std::string& name = scene.mirrors[mirror].name;
  return name.empty() ? std::to_string(mirror) : name;
}

std::string mirrorPathName(const Scene& scene, std::span<const int> path) {
  std::string text;
  for (const int mirror : path) {
    text += (text.empty() ? "" : " > ") + mirrorName(scene, mirror);
  }
  return text;
}

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
      probe_(renderer),
      environmentTargets_(device_) {
  const DescriptorBinding binding{.type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                  .stages = VK_SHADER_STAGE_FRAGMENT_BIT};
  displayLayout_ = createDescriptorSetLayout(device_, {&binding, 1}, "display");
  watchedDepth_ = std::make_unique<KeptDepth>(renderer, displayLayout_.get());
}

SceneRenderer::~SceneRenderer() {
  renderer_.waitIdle();
}

size_t SceneRenderer::pipelineCount() const {
  return maskSystem_.pipelineCount() + renderSystem_.pipelineCount() + pointLightSystem_.pipelineCount() +
         mirrorSystem_.pipelineCount() + displayPipelines_.size() + watch_.pipelineCount() +
         watchedDepth_->pipelineCount() + probe_.pipelineCount();
}

const FiniteWatch& SceneRenderer::finiteWatch() {
  watch_.collect();
  return watch_;
}

void SceneRenderer::record(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan,
                           const std::optional<DebugView>& debug) {
  const bool ofMirror = debug && debug->pass < static_cast<int>(plan.passes.size());
  keptPass_ = ofMirror ? std::optional(debug->pass) : std::nullopt;
  releaseViews(debug, *frame.retired);
  takeHeldImages(plan);
  prepareTargets(settings, plan, *frame.retired);
  prepareMaps(frame, plan);
  const Environment environment = effectiveEnvironment(scene_, settings);
  data_.build(frame, resources_, scene_, state, settings, environment, plan);
  const TracedEffects effects = tracedEffects(scene_, state, settings, plan);
  trace_.build(frame, state, settings, effects);
  ledger_ = {};
  targets_.assign(plan.passes.size(), nullptr);
  images_.assign(plan.passes.size(), {});
  recorded_.clear();
  const FrameInfo info{frame, scene_, settings, environment, plan,        resources_,
                       data_, trace_, ledger_,  images_,     heldImages_, mapSets_};
  if (settings.debug.checkFinite) {
    watch_.begin(frame, plan.maps.size() + plan.passes.size() + 2);  // the main view's samples and their mean
  } else {
    watch_.release();
  }
  size_t facePass = plan.passes.size() + 1;
  for (size_t i = 0; i < plan.maps.size(); ++i) {
    if (plan.maps[i].earlier < 0) {
      recordMap(frame, info, i, facePass);
      facePass += plan.maps[i].faces.size();
    }
  }
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    recordMirrorPass(frame, info, i);
  }
  recordMainPass(frame, info);
  if (settings.debug.checkFinite) {
    watch_.end(frame);
  }
  if (cover_) {
    recordCover(frame);
  } else {
    recordDisplayPass(frame, settings);
  }
  if (debug) {
    recordDebugView(frame, settings, plan, *debug);
    recordProbe(frame, plan, *debug);
    if (ofMirror && !isHeld(plan, debug->pass)) {
      pool_->release(*targets_[debug->pass]);
    }
  }
  const bool imagesShown = !plan.shown.empty();
  renderSystem_.endFrame(trace_.variant(), imagesShown, !effects.curved.empty());
  mirrorSystem_.endFrame(trace_.variant(), imagesShown);
  finishLedger(settings, plan, effects);
  keepHeldImages(plan);
  environmentTargets_.endFrame(plan, *frame.retired);
  if (pool_) {
    pool_->endFrame(*frame.retired);
  }
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
    std::erase_if(displayPipelines_, [](const auto& entry) { return entry.first.multisampled; });
  }
}

// What is not entered draw by draw.
void SceneRenderer::finishLedger(const Settings& settings, const FramePlan& plan, const TracedEffects& effects) {
  Settings single = settings;
  single.view.samples = 1;
  single.reflection.samples = 1;
  ledger_[EffectKind::msaa].bytes = targetBytes(plan, settings) - targetBytes(plan, single);
  for (const RecordedPass& pass : recorded_) {
    const int samples = pass.depth >= 0 ? settings.reflection.samples : settings.view.samples;
    const bool scene = pass.depth >= 0 || pass.name == mainName;
    ledger_[EffectKind::msaa].draws += scene && samples > 1 ? pass.draws : 0;
  }
  ledger_[EffectKind::textures].bytes = ledger_[EffectKind::textures].draws > 0 ? resources_.textureBytes() : 0;
  ledger_[EffectKind::toneMap].draws = settings.view.toneMap == ToneMap::aces ? 1 : 0;
  for (const auto& [kind, caller] :
       {std::pair(EffectKind::shadows, &effects.shadows), std::pair(EffectKind::roughness, &effects.roughness),
        std::pair(EffectKind::ripple, &effects.ripple), std::pair(EffectKind::castsLight, &effects.castsLight),
        std::pair(EffectKind::curved, &effects.curved)}) {
    const bool traces = !caller->empty() && (kind != EffectKind::roughness || effects.roughRays) &&
                        (kind != EffectKind::curved || effects.curvedRays);
    ledger_[kind].bytes = traces ? trace_.bytes() : 0;
  }
  ledger_[EffectKind::curved].bytes += environmentTargets_.bytes();
  ledger_[EffectKind::glyphs].pipelines = static_cast<uint32_t>(pointLightSystem_.pipelineCount());
  for (const auto& [variant, pipeline] : displayPipelines_) {
    ledger_.pipeline(EffectKind::toneMap, variant.toneMap == ToneMap::aces);
  }
  renderSystem_.countPipelines(ledger_);
  mirrorSystem_.countPipelines(ledger_);
}

std::span<const HeldImage> SceneRenderer::heldImages() const {
  return heldRevision_ == renderer_.pipelines().revision() ? std::span(held_) : std::span<const HeldImage>();
}

std::span<const EnvironmentMap> SceneRenderer::environmentMaps() const {
  return heldRevision_ == renderer_.pipelines().revision() ? environmentTargets_.held()
                                                           : std::span<const EnvironmentMap>();
}

void SceneRenderer::restart() {
  environmentTargets_.restart();
  held_.clear();
  heldTargets_.clear();
  restart_ = true;
}

// Gives back what the plan shows no more: its targets serve passes of this frame. Nothing to wait for, barriers order
// frames as they do passes.
void SceneRenderer::takeHeldImages(const FramePlan& plan) {
  std::vector<OffScreen*> targets(plan.held.size(), nullptr);
  heldImages_.assign(plan.held.size(), {});
  for (size_t i = 0; i < plan.held.size(); ++i) {
    if (plan.held[i].earlier >= 0) {
      targets[i] = std::exchange(heldTargets_[static_cast<size_t>(plan.held[i].earlier)], nullptr);
      heldImages_[i] = {targets[i]->descriptor(), targets[i]->samples()};
    }
  }
  for (const OffScreen* unused : heldTargets_) {
    if (unused) {
      pool_->release(*unused);
    }
  }
  heldTargets_ = std::move(targets);
}

void SceneRenderer::keepHeldImages(const FramePlan& plan) {
  for (size_t i = 0; i < plan.held.size(); ++i) {
    if (plan.held[i].pass >= 0) {
      heldTargets_[i] = targets_[static_cast<size_t>(plan.held[i].pass)];
    }
  }
  held_ = plan.held;
  heldRevision_ = renderer_.pipelines().revision();
}

void SceneRenderer::prepareTargets(const Settings& settings, const FramePlan& plan, RetireQueue& retired) {
  const VkSampleCountFlagBits samples = device_.sampleCount(settings.reflection.samples);
  const bool needless = plan.passes.empty() && plan.held.empty();
  if (depth_ && (restart_ || depth_->samples() != samples || needless)) {
    pool_->clear(retired);
    pool_.reset();
    depth_->trim({0, 0}, retired);
    depth_.reset();
  }
  restart_ = false;
  if (!plan.passes.empty()) {
    if (!depth_) {
      depth_ = std::make_unique<SharedDepth>(device_, samples, "mirror images");
      pool_ = std::make_unique<ImagePool>(device_, *depth_, "mirror image");
    }
    VkExtent2D largest{1, 1};
    for (const PlannedPass& pass : plan.passes) {
      largest.width = std::max(largest.width, static_cast<uint32_t>(pass.view.rect.width));
      largest.height = std::max(largest.height, static_cast<uint32_t>(pass.view.rect.height));
    }
    depth_->require(largest, retired);
  }
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

// Of the pass recorded last. Samples before their mean: it hides what is negative in one of them.
void SceneRenderer::checkTarget(Frame& frame, const FrameInfo& info, OffScreen& target, VkExtent2D used) {
  if (!info.settings.debug.checkFinite) {
    return;
  }
  const RecordedPass& pass = recorded_.back();
  if (Image* samples = target.samplesImage()) {
    watch_.check(frame, pass.name + " (samples)", pass.path, *samples, target.samplesDescriptor(), used);
  }
  watch_.check(frame, pass.name, pass.path, target.color(), target.descriptor(), used);
}

// Not those that are kept: for the debug view until the frame ends, for the next frames.
void SceneRenderer::releaseImages(const FramePlan& plan, const PlannedPass& pass) {
  for (const MirrorDraw& draw : pass.mirrors) {
    if (draw.pass >= 0 && draw.pass != keptPass_ && !isHeld(plan, draw.pass)) {
      pool_->release(*targets_[draw.pass]);
    }
  }
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
  checkTarget(frame, info, target, {3 * size, 2 * size});
}

void SceneRenderer::recordMirrorPass(Frame& frame, const FrameInfo& info, size_t index) {
  const PlannedPass& pass = info.plan.passes[index];
  const View& view = pass.view;
  const VkRect2D area = areaOf(view.rect);
  OffScreen& target = pool_->acquire(area.extent, *frame.retired);
  RecordedPass recorded{.name = "mirror " + mirrorPathName(scene_, view.path),
                        .path = view.path,
                        .depth = pass.depth,
                        .areaPx = pass.areaPx};
  PassDesc desc{.name = recorded.name,
                .targets = target.targets(),
                .renderArea = area,
                .viewport = viewportOf(view),
                .scissor = area,
                .frontFace = frontFace(view),
                .clearColor = clearColor(info.environment),
                .clearDepth = MaskSystem::clearDepth(info.data.passes()[index]),
                .collectStatistics = true};
  if (keepsDepth(index)) {
    watchedDepth_->prepare(desc, *frame.retired);
  }
  {
    PassScope scope = renderer_.beginPass(frame, desc);
    const PassFormat format{.samples = target.samples(), .mirrorView = true};
    recorded.draws = maskSystem_.record(scope, info, index, format);
    scope.countSamples();
    recorded.draws += recordSystems(scope, info, index, format);
  }
  if (keepsDepth(index)) {
    watchedDepth_->finish(frame.commands);
  }
  recorded_.push_back(std::move(recorded));
  checkTarget(frame, info, target, area.extent);
  targets_[index] = &target;
  images_[index] = {target.descriptor(), target.samples()};
  releaseImages(info.plan, pass);
}

void SceneRenderer::recordMainPass(Frame& frame, const FrameInfo& info) {
  PassDesc desc = fullPass(mainName, main_->targets());
  desc.clearColor = clearColor(info.environment);
  desc.frontFace = frontFace(info.plan.main.view);
  desc.collectStatistics = true;
  desc.storeSamples = main_->desc().readSamples;
  RecordedPass recorded{.name = desc.name, .areaPx = info.plan.main.areaPx};
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
  checkTarget(frame, info, *main_, main_->extent());
  releaseImages(info.plan, info.plan.main);
}

const Pipeline& SceneRenderer::displayPipeline(const DisplayVariant& variant) {
  std::unique_ptr<Pipeline>& pipeline = displayPipelines_[variant];
  if (!pipeline) {
    GraphicsPipelineDesc desc{.name = "display", .vert = "full_screen.vert", .frag = "display.frag"};
    if (variant.multisampled) {
      desc.frag = "display_average.frag";
    }
    desc.fragConstants = {variant.toneMap == ToneMap::aces};
    desc.setLayouts = {displayLayout_.get()};
    desc.pushConstantBytes = sizeof(DisplayConstants);
    desc.color = variant.format;
    desc.depth = VK_FORMAT_UNDEFINED;
    desc.depthTest = false;
    desc.depthWrite = false;
    pipeline = std::make_unique<Pipeline>(renderer_.pipelines(), std::move(desc));
  }
  return *pipeline;
}

void SceneRenderer::recordDisplay(Frame& frame, const PassDesc& desc, const MirrorImage& radiance,
                                  const glm::vec4& lookup, const Settings& settings) {
  const Pipeline& pipeline = displayPipeline({.toneMap = settings.view.toneMap,
                                              .multisampled = radiance.samples != VK_SAMPLE_COUNT_1_BIT,
                                              .format = renderer_.displayFormat()});
  recordFullScreen(frame, desc, pipeline, radiance.descriptor, {lookup, static_cast<float>(settings.view.exposure)});
}

void SceneRenderer::recordFullScreen(Frame& frame, const PassDesc& desc, const Pipeline& pipeline,
                                     const VkDescriptorImageInfo& image, const DisplayConstants& constants) {
  const VkDescriptorSet set = frame.descriptors->allocate(displayLayout_.get());
  DescriptorWriter().image(0, image).update(device_, set);
  const PassScope scope = renderer_.beginPass(frame, desc);
  pipeline.bind(scope.commands());
  pipeline.bindSet(scope.commands(), 0, set);
  pipeline.push(scope.commands(), constants);
  vkCmdDraw(scope.commands(), 3, 1, 0, 0);
  recorded_.push_back({.name = desc.name, .draws = 1});
}

void SceneRenderer::recordDisplayPass(Frame& frame, const Settings& settings) {
  recordDisplay(frame, fullPass("display", renderer_.displayTargets(frame)), {.descriptor = main_->descriptor()},
                glm::vec4(1.0f, 1.0f, 0.0f, 0.0f), settings);
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

void SceneRenderer::setCover(const Image8& picture) {
  if (cover_) {
    renderer_.retired().retire(std::move(cover_));
    cover_ = Image();
  }
  if (picture.width < 1) {
    return;
  }
  std::vector<uint64_t> texels(static_cast<size_t>(picture.width) * picture.height);
  for (size_t i = 0; i < texels.size(); ++i) {
    glm::vec4 linear(1.0f);
    for (int channel = 0; channel < 3; ++channel) {
      linear[channel] = static_cast<float>(srgbDecode(picture.rgba[4 * i + channel] / 255.0));
    }
    texels[i] = glm::packHalf4x16(linear);
  }
  // Validation layer 1.3.239 forgets the fences of frames in flight when an upload's is waited for.
  renderer_.waitIdle();
  const VkExtent2D extent{static_cast<uint32_t>(picture.width), static_cast<uint32_t>(picture.height)};
  cover_ = renderer_.uploader().image(std::as_bytes(std::span(texels)), extent, colorFormat, false, "cover");
  if (!coverSampler_) {
    coverSampler_ = createSampler(device_, {}, "cover");
  }
}

void SceneRenderer::recordCover(Frame& frame) {
  const glm::vec2 scale(static_cast<float>(cover_.extent().width) / static_cast<float>(frame.extent.width),
                        static_cast<float>(cover_.extent().height) / static_cast<float>(frame.extent.height));
  recordDisplay(frame, fullPass("display", renderer_.displayTargets(frame)),
                {.descriptor = cover_.descriptor(coverSampler_.get())}, glm::vec4(scale, 0.0f, 0.0f), Settings());
}

void SceneRenderer::recordProbe(Frame& frame, const FramePlan& plan, const DebugView& debug) {
  if (!debug.probe) {
    return;
  }
  if (depthPass_ && watchedDepth_->exists()) {
    return probe_.probe(frame, watchedDepth_->image(), watchedDepth_->descriptor(), *debug.probe);
  }
  OffScreen& target = debug.pass == static_cast<int>(plan.passes.size()) ? *main_ : *targets_[debug.pass];
  probe_.probe(frame, target.color(), target.descriptor(), *debug.probe);
}

void SceneRenderer::recordDebugView(Frame& frame, const Settings& settings, const FramePlan& plan,
                                    const DebugView& debug) {
  const bool ofMain = debug.pass == static_cast<int>(plan.passes.size());
  const PixelRect image = ofMain ? PixelRect{0, 0, plan.width, plan.height} : plan.passes[debug.pass].view.rect;
  PixelRect area = intersect(debug.area, {0, 0, plan.width, plan.height});
  glm::dvec2 corner(debug.area.x, debug.area.y);  // of texel 0, 0, in pixels of the display
  double zoom = debug.zoom;
  if (zoom > 0.0) {
    corner -= zoom * debug.origin;
  } else {
    zoom = std::min(static_cast<double>(area.width) / image.width, static_cast<double>(area.height) / image.height);
    corner = {area.x, area.y};
  }
  const glm::dvec2 last = corner + zoom * glm::dvec2(image.width, image.height);
  const glm::ivec2 low(glm::ceil(glm::max(corner - 0.5, glm::dvec2(-1.0))));
  const glm::ivec2 high(glm::floor(glm::min(last, glm::dvec2(plan.width, plan.height) + 1.0)));
  area = intersect(area, {low.x, low.y, high.x - low.x, high.y - low.y});
  if (area.empty()) {
    return;
  }
  PassDesc desc = fullPass("debug view", renderer_.displayTargets(frame));
  desc.renderArea = {{area.x, area.y}, areaOf(area).extent};
  desc.scissor = desc.renderArea;
  desc.loadColor = true;
  const glm::vec4 lookup(glm::dvec4(1.0 / zoom, 1.0 / zoom, -corner / zoom));
  if (depthPass_ && watchedDepth_->exists()) {
    const float half = static_cast<float>(plan.projection.near / debug.halfDistance);
    recordFullScreen(frame, desc, watchedDepth_->pipeline(), watchedDepth_->descriptor(), {lookup, half});
  } else {
    recordDisplay(frame, desc, ofMain ? MirrorImage{.descriptor = main_->descriptor()} : images_[debug.pass], lookup,
                  settings);
  }
}

}  // namespace speculum
