#include "systems/scene_renderer.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "plan/cube_face.hpp"
#include "plan/picture_tiles.hpp"
#include "plan/target_memory.hpp"

namespace speculum {

namespace {

// Says whether surfaces of the pass are shaded by DeferredShading.
bool defers(const FrameInfo& info, const DrawList& pass) {
  return MirrorSystem::defers(info, pass) || RenderSystem::defers(info, pass);
}

// Returns the curve of a picture whose radiances are stored times `radianceScale`.
DisplayCurve displayed(const DisplayCurve& curve, double radianceScale) {
  return {curve.exposure / radianceScale, curve.toneMap};
}

}  // namespace

SceneRenderer::SceneRenderer(Renderer& renderer, const Scene& scene)
    : renderer_(renderer),
      device_(renderer.device()),
      scene_(scene),
      resources_(device_, renderer.uploader(), scene),
      data_(device_, renderer.roundsSumsDown()),
      trace_(device_, renderer.uploader(), scene),
      maskSystem_(renderer.pipelines(), data_.layout()),
      renderSystem_(renderer.pipelines(), data_.layout(), resources_.textureLayout()),
      pointLightSystem_(renderer.pipelines(), data_.layout()),
      mirrorSystem_(device_, renderer.uploader(), renderer.pipelines(), data_.layout()),
      shadowSystem_(device_, renderer.pipelines(), data_.layout()),
      deferredShading_(device_, renderer.pipelines(), data_.layout()),
      watch_(renderer),
      display_(renderer),
      accumulation_(renderer),
      watched_(device_),
      probe_(renderer),
      mainTargets_(device_),
      mirrorTargets_(device_),
      environmentTargets_(device_),
      idle_(device_) {}

SceneRenderer::~SceneRenderer() = default;

const FiniteWatch& SceneRenderer::finiteWatch() {
  watch_.collect();
  return watch_;
}

void SceneRenderer::uploadTextures(Frame& frame, const SceneState& state, const Settings& settings,
                                   const FramePlan& plan) {
  resources_.upload(frame, settings, drawsTextures(scene_, state, settings, plan));
}

void SceneRenderer::record(Frame& frame, const SceneState& state, const Settings& settings, const FramePlan& plan,
                           const std::optional<TargetDisplay>& debug, bool shown,
                           const std::optional<SplitDisplay>& split) {
  data_.requireFits(plan);
  const double radianceScale = settings.view.radianceScale();
  const Environment environment = scaled(scene_.environment.cleared(settings.view.clearColor), radianceScale);
  watched_.begin(plan, debug, *frame.retired);
  releaseUnused(debug);
  prepareTargets(frame, settings, plan, shown);
  log_.beginFrame();
  const bool textured = drawsTextures(scene_, state, settings, plan);
  resources_.prepare(frame, settings, textured);
  pictureSize_ = {plan.width, plan.height};
  shown_ = settings.view;
  tiles_ = tilesOfPasses(plan);
  tilesLeft_ = tilesAtOnce_ = tilesAtOnce(plan, settings, plan.effects.raysToLights(scene_));
  data_.build(frame, resources_, scene_, state, settings, environment, plan);
  trace_.build(frame, state, settings, plan.effects);
  const FrameInfo info{
      .frame = frame,
      .scene = scene_,
      .settings = settings,
      .environment = environment,
      .plan = plan,
      .resources = resources_,
      .data = data_,
      .trace = trace_,
      .shadows = shadowSystem_,
      .ledger = ledger_,
      .images = mirrorTargets_.images(),
      .cached = mirrorTargets_.cached(),
      .encodedBackground = plan.encodes ? displayColor(storedBackground(environment, plan.main().view, plan.picture),
                                                       displayed(settings.view.displayCurve(), radianceScale))
                                        : std::nullopt,
      .maps = mapSets_};
  if (beginsPicture(plan)) {
    log_.beginPicture();
    cubes_.clear();
    if (!plan.mainReused()) {
      ledger_ = {};
      hasGaps_ = plan.refined != nullptr;
    }
  }
  if (!plan.mainReused() && endsPicture(plan)) {
    flat_ = flatColor(info);
    encoded_ = plan.encodes;
    hasGaps_ = hasGaps_ || flat_ || encoded_;
  }
  recordPasses(info);
  unfinished_ = !endsPicture(plan);
  if (unfinished_) {
    mainImage_ = {};
  } else {
    watched_.finish(plan, frame.commands, *frame.retired);
    mainTargets_.finish(*frame.retired);
    recordSum(info);
    radianceScale_ = radianceScale;
  }
  if (shown) {
    recordDisplay(info, debug, split);
  }
  if (!unfinished_) {
    endRecord(info, textured, drawsTransparency(scene_, state, settings, plan));
  }
  log_.endFrame(frame.number);
}

// Releases what only a TargetDisplay needs, once there is none.
void SceneRenderer::releaseUnused(const std::optional<TargetDisplay>& debug) {
  if (!debug || !debug->probe) {
    probe_.release();
  }
  if (!debug) {
    display_.releaseView();
  }
}

void SceneRenderer::prepareTargets(Frame& frame, const Settings& settings, const FramePlan& plan, bool shown) {
  if (beginsPicture(plan)) {
    if (unfinished_) {
      mirrorTargets_.restart();
    }
    mirrorTargets_.begin(plan, watched_.mirrorPass(), *frame.retired);
    const bool mainIsShown = accumulated() == 0 || keepsTarget({}, TargetKind::color);
    mainTargets_.begin(settings, plan, renderer_.roundsSumsDown(), shown && !unfinished_ && !encoded_ && mainIsShown,
                       *frame.retired);
    environmentTargets_.prepare(plan, *frame.retired);
  }
  shadowSystem_.prepare(frame, plan);
  mapSets_.clear();
  for (const Cube& cube : plan.cubes) {
    const bool environment = cube.kind == PassKind::environment;
    mapSets_.push_back(environment ? frame.descriptors->allocate(resources_.textureLayout()) : VK_NULL_HANDLE);
    if (environment) {
      const OffScreen& target = environmentTarget(plan, plan.passes[cube.faces[0]]);
      DescriptorWriter().image(0, target.descriptor()).update(device_, mapSets_.back());
    }
  }
  if (settings.debug.checkFinite) {
    // One more than there are passes, because the main view's samples and their mean are checked.
    watch_.begin(frame, plan.passes.size() + 1);
  } else {
    watch_.release();
  }
}

OffScreen& SceneRenderer::environmentTarget(const FramePlan& plan, const Pass& face) {
  return environmentTargets_[face.cube - cubesOf(plan.cubes, PassKind::shadow).size()];
}

void SceneRenderer::recordPasses(const FrameInfo& info) {
  const FramePlan& plan = info.plan;
  // Passes of a group render side by side, so none may pause for deferred shading.
  const bool grouped = !plan.tiles && !info.trace.set();
  const RecycledVector<ConcurrentPasses> groups =
      grouped ? independentPasses(plan) : RecycledVector<ConcurrentPasses>();
  auto group = groups.begin();
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    if (tiles_[i].empty()) {
      continue;
    }
    switch (plan.passes[i].id.kind) {
      case PassKind::shadow:
        recordShadow(info, i);
        break;
      case PassKind::environment:
        recordEnvironment(info, i);
        break;
      case PassKind::mirror: {
        const ConcurrentPasses range = grouped ? *group++ : ConcurrentPasses{i, i + 1};
        recordMirrors(info, range);
        i = range.end - 1;
        break;
      }
      default:
        recordMain(info, i);
    }
  }
  if (endsFaces(plan)) {
    cubes_ = plan.cubes;
    environmentTargets_.endFrame(*info.frame.retired);
    shadowSystem_.endFrame(plan, *info.frame.retired);
  }
  if (info.settings.debug.checkFinite) {
    watch_.end(info.frame);
  }
}

void SceneRenderer::recordShadow(const FrameInfo& info, size_t index) {
  const int layer = info.plan.passes[index].layer;
  const RecordedPass pass = shadowSystem_.record(renderer_, info, index);
  ledger_[EffectKind::shadows].draws += pass.draws;
  log_.add(pass);
  if (layer >= 0 && info.plan.passes[static_cast<size_t>(layer)].drawn()) {
    log_.add(pass);
    log_.joinLast();
  }
}

void SceneRenderer::recordEnvironment(const FrameInfo& info, size_t index) {
  const Pass& face = info.plan.passes[index];
  OffScreen& target = environmentTarget(info.plan, face);
  const VkExtent2D size = extentOf(face.view.rect.width, face.view.rect.height);
  const Viewport viewport{static_cast<float>(face.corner.x), static_cast<float>(face.corner.y),
                          static_cast<float>(size.width), static_cast<float>(size.height)};
  const PassDesc desc =
      scenePass(passName(scene_, info.plan, face), target.targets(), {{face.corner.x, face.corner.y}, size}, viewport,
                face.view, info.environment, info.plan.picture);
  const uint32_t drawsBefore = ledger_[EffectKind::curved].draws;
  RecordedPass pass{face.id, desc.name};
  pass.areaPx = face.areaPx;
  const size_t tiles = tilesIn(face.view.rect);
  makeRoom(info.frame, tiles);
  drawScene(info, index, desc, std::move(pass));
  tilesLeft_ -= std::min(tilesLeft_, tiles);
  // Counts each draw once: drawScene() has entered the curved mirrors seen in the face.
  ledger_[EffectKind::curved].draws = drawsBefore + log_.passes().back().draws;
  const bool last = static_cast<size_t>(face.id.face) + 1 == faceAxes().size();
  if (last && !info.plan.tiles) {
    watch_.check(info.frame, log_.passes().back(), target,
                 extentOf(3 * face.view.rect.width, 2 * face.view.rect.height));
  }
}

// Releases and checks images after the whole range, because barriers are recorded only before and after it.
void SceneRenderer::recordMirrors(const FrameInfo& info, const ConcurrentPasses& range) {
  // Tiles of the range's only pass. In a longer range, each pass draws all of its tiles.
  const TileRange tiles = tiles_[range.first];
  if (tiles.first == 0) {
    passTargets_ = mirrorTargets_.acquire(info.plan, range, *info.frame.retired);
  }
  std::vector<PassDesc> descs;
  for (size_t i = range.first; i < range.end; ++i) {
    const View& view = info.plan.passes[i].view;
    PassDesc& desc =
        descs.emplace_back(scenePass(passName(scene_, info.plan, info.plan.passes[i]), passTargets_[i - range.first],
                                     {{0, 0}, extentOf(view.rect.width, view.rect.height)}, viewportOf(view), view,
                                     info.environment, info.plan.picture));
    desc.clearDepth = MaskSystem::clearDepth(info.data.passes()[i]);
    desc.grouped = range.end > range.first + 1;
    watched_.prepare(info.plan, i, desc, *info.frame.retired);
  }
  const size_t firstRecorded = log_.passes().size();
  {
    std::optional<SharedBarriers> group;
    if (descs.front().grouped) {
      group.emplace(device_.barriers(), info.frame.commands, descs);
    }
    for (size_t i = range.first; i < range.end; ++i) {
      const Pass& planned = info.plan.passes[i];
      const PassDesc& desc = descs[i - range.first];
      drawTiles(info, i, desc, {planned.id, desc.name, planned.depth, 0, planned.areaPx});
    }
  }
  // Images are released in the frame that draws the first tile. They keep their content for the later tiles, because no
  // image is acquired before the last tile is drawn.
  if (tiles.first > 0) {
    return;
  }
  for (size_t i = range.first; i < range.end; ++i) {
    const size_t k = i - range.first;
    watch_.check(info.frame, log_.passes()[firstRecorded + k], mirrorTargets_[i], descs[k].renderArea.extent);
    mirrorTargets_.releaseShown(info.plan, info.plan.passes[i]);
  }
}

std::optional<glm::vec3> SceneRenderer::flatColor(const FrameInfo& info) const {
  const Pass& main = info.plan.main();
  if (info.environment.sky || !info.plan.showsNothing() || info.plan.encodes || info.plan.tiles ||
      info.settings.view.accumulate > 1 || info.settings.debug.checkFinite || watched_.watches()) {
    return std::nullopt;
  }
  return storedBackground(info.environment, main.view, info.plan.picture);
}

void SceneRenderer::recordMain(const FrameInfo& info, size_t index) {
  const Pass& main = info.plan.passes[index];
  PassTargets targets = mainTargets_.drawn().targets();
  if (info.plan.encodes) {
    targets = {renderer_.displayTargets(info.frame).color, nullptr, targets.depth, TargetRole::swapchain};
  }
  const PassDesc whole = fullPass(passName(scene_, info.plan, main), targets);
  PassDesc desc = scenePass(whole.name, whole.targets, whole.renderArea, whole.viewport, main.view, info.environment,
                            info.plan.picture);
  if (info.encodedBackground) {
    std::ranges::copy(info.encodedBackground->float32, desc.clearColor.begin());
  }
  if (flat_ && !info.plan.tiles) {
    desc.renderArea = desc.scissor = {{0, 0}, {1, 1}};  // the texel that the display may read
    drawScene(info, index, desc, {main.id, desc.name, -1, 0, 1.0});
    return mirrorTargets_.releaseShown(info.plan, main);
  }
  if (renderer_.roundsSumsDown()) {
    desc.targets.resolve = nullptr;  // recordMean() stands in
  }
  desc.storeSamples = info.settings.debug.checkFinite;
  watched_.prepare(info.plan, index, desc, *info.frame.retired);
  drawTiles(info, index, desc, {main.id, desc.name, -1, 0, main.areaPx});
  if (renderer_.roundsSumsDown() && endsPicture(info.plan)) {
    if (const auto mean = display_.recordMean(info.frame, mainTargets_.drawn(), info.plan.picture)) {
      log_.add(*mean);
      log_.joinLast();
    }
  }
  watch_.check(info.frame, log_.passes().back(), mainTargets_.drawn(), mainTargets_.drawn().extent());
  mirrorTargets_.releaseShown(info.plan, main);
}

void SceneRenderer::recordSum(const FrameInfo& info) {
  if (info.settings.view.accumulate == 1) {
    accumulation_.release(*info.frame.retired);
  } else if (const bool again = info.plan.picture > 0 && info.plan.picture + 1 == accumulated();
             !info.plan.mainReused() && !again) {
    log_.add(accumulation_.add(info.frame, mainTargets_.drawn().descriptor(), mainTargets_.drawn().extent(),
                               info.plan.picture, info.plan.refined.get()));
  }
}

DisplayedPicture SceneRenderer::picture() {
  const int pictures = accumulated();
  return display_.picture(pictures > 0 ? accumulation_.descriptor() : mainTargets_.shown().descriptor(),
                          mainTargets_.shown().extent(), displayed(shown_.displayCurve(), radianceScale_), pictures,
                          flat_);
}

void SceneRenderer::recordDisplay(const FrameInfo& info, const std::optional<TargetDisplay>& debug,
                                  const std::optional<SplitDisplay>& split) {
  const VkExtent2D display = info.frame.extent;
  const bool divides = split && split->other.pictureSize_.x > 0 && !split->other.encoded_;
  const uint32_t left = divides ? std::min(split->divider, display.width) : display.width;
  const std::array areas{VkRect2D{{0, 0}, {left, display.height}},
                         VkRect2D{{static_cast<int32_t>(left), 0}, {display.width - left, display.height}}};
  const auto log = [&](const RecordedPass& pass) {
    if (!unfinished_) {
      log_.add(pass);
    }
  };
  if (!info.plan.encodes) {
    std::array pictures{picture(), divides ? split->other.picture() : DisplayedPicture()};
    pictures[0].area = areas[divides && split->right];
    pictures[1].area = areas[divides && !split->right];
    log(display_.record(info.frame, std::span(pictures).first(divides ? 2 : 1)));
  }
  if (const auto target = debug ? showTarget(info.frame, info.plan, *debug) : std::nullopt) {
    log(*target);
  }
}

std::optional<RecordedPass> SceneRenderer::showTarget(Frame& frame, const FramePlan& plan, const TargetDisplay& debug) {
  const WatchedTarget::Target* watched = watched_.shown(plan, debug);
  if (!watched) {
    return std::nullopt;
  }
  const WatchedTarget::Target& target = *watched;
  OffScreen* image = watchedImage(plan, debug.pass);
  const bool showsDepth = target.kind == TargetKind::depth;
  if (showsDepth ? !watched_.hasDepth() : !image) {
    return std::nullopt;
  }
  Image& texels = showsDepth ? watched_.depth() : image->color();
  const MirrorImage shown{showsDepth ? watched_.depthDescriptor() : image->descriptor(), texels.samples()};
  const auto view = showsDepth ? display_.recordDepth(frame, target.size, debug, shown, target.near)
                               : display_.recordColor(frame, target.size, debug, shown,
                                                      displayed(shown_.displayCurve(), radianceScale_));
  // The target that is shown, of the last complete picture, may be smaller than the one that the probe was meant for.
  if (debug.probe && glm::all(glm::lessThan(*debug.probe, target.size))) {
    probe_.probe(frame, texels, shown.descriptor, *debug.probe);
  }
  return view;
}

// Keeps what the next frame may reuse, and releases what no frame needed for a while.
void SceneRenderer::endRecord(const FrameInfo& info, bool textured, bool transparent) {
  const FramePlan& plan = info.plan;
  RetireQueue& retired = *info.frame.retired;
  const auto isShown = [](const Pass& pass) { return pass.source == PassSource::reused && !pass.isFace(); };
  const bool imagesShown = std::ranges::any_of(plan.passes, isShown);
  const bool glyphsShown =
      std::ranges::any_of(plan.passes, [&](const Pass& pass) { return isShown(pass) && !pass.lights.empty(); });
  const bool shadowMaps = !cubesOf(plan.cubes, PassKind::shadow).empty();
  renderSystem_.endFrame(trace_.variant(), shadowMaps, imagesShown, plan.effects.curved.has_value(), textured,
                         transparent);
  mirrorSystem_.endFrame(trace_.variant(), shadowMaps, imagesShown && plan.effects.any(), textured);
  deferredShading_.endFrame(trace_.variant(), imagesShown && plan.effects.any(), retired);
  pointLightSystem_.endFrame(glyphsShown);
  if (!plan.mainReused()) {
    finishLedger(info);
  }
  mainImage_ = {info.settings, plan.mainContent, encoded_};
  mirrorTargets_.end(plan, retired);
  cacheRevision_ = renderer_.pipelines().revision();
}

// Counts the draws of the first rectangle only: the other rectangles repeat these draws.
void SceneRenderer::drawTiles(const FrameInfo& info, size_t index, const PassDesc& desc, const RecordedPass& pass) {
  const auto [width, height] = desc.renderArea.extent;
  const TileRange& tiles = tiles_[index];
  bool first = tiles.first == 0;
  for (size_t begin = tiles.first; begin < tiles.end;) {
    makeRoom(info.frame, 1);
    const TileRange part{begin, begin + std::min(tilesLeft_, tiles.end - begin)};
    std::vector<PixelRect> rects = tileRects(static_cast<int>(width), static_cast<int>(height), part);
    if (defers(info, info.data.passes()[index])) {
      rects = DeferredShading::bands(rects, desc.targets.samples());
    }
    for (const PixelRect& rect : rects) {
      PassDesc drawn = desc;
      drawn.renderArea = drawn.scissor = {{rect.x, rect.y}, extentOf(rect.width, rect.height)};
      drawn.keepsSamples = info.plan.tiles || part != tiles || rects.size() > 1;
      const EffectLedger ledger = ledger_;
      drawScene(info, index, drawn, pass);
      if (!std::exchange(first, false)) {
        log_.joinLast();
        ledger_ = ledger;
      }
    }
    tilesLeft_ -= part.end - part.first;
    begin = part.end;
  }
}

void SceneRenderer::makeRoom(Frame& frame, size_t tiles) {
  if (tilesLeft_ < std::min(tiles, tilesAtOnce_)) {
    renderer_.submitPart(frame);
    tilesLeft_ = tilesAtOnce_;
  }
}

void SceneRenderer::drawScene(const FrameInfo& info, size_t index, const PassDesc& desc, RecordedPass pass) {
  const DrawList& data = info.data.passes()[index];
  const bool deferred = defers(info, data);
  PassScope scope = renderer_.beginPass(info.frame, deferred ? DeferredShading::identifying(desc) : desc);
  pass.draws = maskSystem_.record(scope, info, data);
  scope.countSamples();
  pass.draws += mirrorSystem_.record(scope, info, data);
  pass.draws += pointLightSystem_.record(scope, info, data);
  pass.draws += renderSystem_.record(scope, info, data);
  if (deferred) {
    scope.pause();
    deferredShading_.shade(scope, info, data);
    scope.resume(DeferredShading::shaded(desc));
    pass.draws += deferredShading_.record(scope);
    pass.draws += mirrorSystem_.recordReflections(scope, info, data);
    pass.draws += renderSystem_.recordReflections(scope, info, data, deferredShading_);
  }
  log_.add(std::move(pass));
}

OffScreen* SceneRenderer::watchedImage(const FramePlan& plan, int pass) {
  if (plan.passes[static_cast<size_t>(pass)].id.kind == PassKind::main) {
    return flat_ || encoded_ ? nullptr : &mainTargets_.shown();
  }
  return unfinished_ || plan.mainReused() ? mirrorTargets_.earlierWatched()
                                          : &mirrorTargets_[static_cast<size_t>(pass)];
}

// Enters in the ledger the costs that are not entered with each draw.
void SceneRenderer::finishLedger(const FrameInfo& info) {
  const Settings& settings = info.settings;
  const TracedEffects& effects = info.plan.effects;
  ledger_[EffectKind::msaa].bytes = sampleBytes(info.plan, settings);
  for (const RecordedPass& pass : log_.passes()) {
    const bool main = pass.kind == PassKind::main;
    const Pass* planned = main ? &info.plan.main() : mirrorPass(info.plan, pass.path);
    ledger_[EffectKind::msaa].draws += planned && planned->quality.samples > 1 ? pass.draws : 0;
  }
  ledger_[EffectKind::textures].bytes = ledger_[EffectKind::textures].draws > 0 ? resources_.textureBytes() : 0;
  ledger_[EffectKind::toneMap].draws = settings.view.toneMap == ToneMap::aces && !flat_ ? 1 : 0;
  for (const auto& [kind, traces] :
       {std::pair(EffectKind::shadows, effects.shadowRays), std::pair(EffectKind::roughness, effects.roughRays),
        std::pair(EffectKind::ripple, effects.rippleRays),
        std::pair(EffectKind::castsLight, effects.castsLight.has_value()),
        std::pair(EffectKind::curved, effects.curvedRays)}) {
    ledger_[kind].bytes = traces ? trace_.bytes() + deferredShading_.bytes() : 0;
  }
  ledger_[EffectKind::curved].bytes += environmentTargets_.bytes();
  ledger_[EffectKind::shadows].bytes += shadowSystem_.bytes();
  ledger_[EffectKind::shadows].pipelines += static_cast<uint32_t>(shadowSystem_.pipelineCount());
  ledger_[EffectKind::glyphs].pipelines = static_cast<uint32_t>(pointLightSystem_.pipelineCount());
  display_.countPipelines(ledger_);
  renderSystem_.countPipelines(ledger_);
  mirrorSystem_.countPipelines(ledger_);
  deferredShading_.countPipelines(ledger_);
  ledger_.rays = trace_.rays();
}

FrameCache SceneRenderer::cache(const SceneState& state) {
  changes_.update(scene_, state);
  FrameCache cache{.changes = &changes_, .accumulated = accumulated()};
  cache.refined = accumulation_.refined(displayed(shown_.displayCurve(), radianceScale_), shown_, cache.waitedMs);
  if (cacheRevision_ == renderer_.pipelines().revision()) {
    cache.images = mirrorTargets_.cachedImages();
    cache.cubes = cubes_;
    cache.main = mainImage_.content.empty() ? nullptr : &mainImage_;
  }
  return cache;
}

void SceneRenderer::restart() {
  mainImage_ = {};
  cubes_.clear();
  environmentTargets_.restart();
  mirrorTargets_.restart();
}

std::optional<TexelValue> SceneRenderer::probed() {
  std::optional<TexelValue> found = probe_.value();
  if (found) {
    found->value /= glm::vec4(glm::vec3(static_cast<float>(radianceScale_)), 1.0f);
  }
  return found;
}

LinearImage SceneRenderer::radiance() {
  if (encoded_) {
    throw std::logic_error("radiance of a picture that is shown only (FrameRequest::shownOnly)");
  }
  renderer_.waitIdle();
  const int pictures = accumulated();
  const std::vector<float> texels =
      flat_ ? std::vector<float>()
            : renderer_.uploader().readFloats(pictures > 0 ? accumulation_.sum() : mainTargets_.shown().color());
  const VkExtent2D extent = mainTargets_.shown().color().extent();
  LinearImage image(static_cast<int>(extent.width), static_cast<int>(extent.height));
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = flat_ ? *flat_ : glm::vec3(texels[4 * i], texels[4 * i + 1], texels[4 * i + 2]);
    image.pixels[i] /= static_cast<float>(std::max(pictures, 1) * radianceScale_);
  }
  return enlarged(image, pictureSize_.x, pictureSize_.y);
}

}  // namespace speculum
