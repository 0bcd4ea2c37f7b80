#include "systems/scene_renderer.hpp"

#include <algorithm>

#include "plan/cube_face.hpp"
#include "systems/gpu_conversion.hpp"

namespace speculum {

SceneRenderer::SceneRenderer(Renderer& renderer, const Scene& scene)
    : renderer_(renderer),
      device_(renderer.device()),
      scene_(scene),
      resources_(device_, renderer.uploader(), scene),
      data_(device_, renderer.roundsSumsDown()),
      trace_(device_, renderer.uploader(), scene),
      recorder_(renderer, data_.layout(), resources_.textureLayout()),
      watch_(renderer),
      display_(renderer),
      watched_(device_),
      probe_(renderer),
      main_(renderer),
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
  watched_.begin(plan, debug, *frame.retired);
  releaseUnused(debug);
  prepareTargets(frame, settings, plan, shown);
  const FrameInfo info = infoOf(frame, state, settings, plan);
  resources_.prepare(frame, settings, info.textured);
  data_.build(info);
  trace_.build(info);
  beginPicture(info);
  recordPasses(info);
  endPicture(info);
  if (shown) {
    recordDisplay(info, debug, split);
  }
  if (endsPicture(plan)) {
    keepImages(info);
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
    if (main_.unfinished()) {
      mirrorTargets_.restart();
    }
    mirrorTargets_.begin(plan, watched_.mirrorPass(), *frame.retired);
    const bool mainIsShown = accumulated() == 0 || keepsTarget({}, TargetKind::color);
    main_.begin(settings, plan, shown && mainIsShown, *frame.retired);
    environmentTargets_.prepare(plan, *frame.retired);
  }
  recorder_.beginFrame(frame, scene_, settings, plan);
  if (settings.debug.checkFinite) {
    // One more than there are passes, because the main view's samples and their mean are checked.
    watch_.begin(frame, plan.passes.size() + 1);
  } else {
    watch_.release();
  }
}

FrameInfo SceneRenderer::infoOf(Frame& frame, const SceneState& state, const Settings& settings,
                                const FramePlan& plan) {
  const double radianceScale = settings.view.radianceScale();
  FrameInfo info{.frame = frame,
                 .scene = scene_,
                 .state = state,
                 .settings = settings,
                 .plan = plan,
                 .environment = scaled(scene_.environment.cleared(settings.view.clearColor), radianceScale),
                 .textured = drawsTextures(scene_, state, settings, plan),
                 .resources = resources_,
                 .data = data_,
                 .trace = trace_,
                 .shadows = recorder_.shadows(),
                 .log = log_,
                 .ledger = ledger_,
                 .images = mirrorTargets_.images(),
                 .cached = mirrorTargets_.cached(),
                 .maps = environmentTargets_.bind(frame, plan, resources_.textureLayout())};
  if (plan.encodes) {
    info.encodedBackground = displayColor(storedBackground(info.environment, plan.main().view, plan.picture),
                                          MainPicture::scaled(settings.view.displayCurve(), radianceScale));
  }
  return info;
}

void SceneRenderer::beginPicture(const FrameInfo& info) {
  log_.beginFrame();
  if (beginsPicture(info.plan)) {
    log_.beginPicture();
    cubes_.clear();
    if (!info.plan.mainReused()) {
      ledger_ = {};
    }
  }
  main_.beginFrame(info, watched_.watches());
}

void SceneRenderer::recordPasses(const FrameInfo& info) {
  const FramePlan& plan = info.plan;
  // Passes of a group render side by side, so none may pause for deferred shading.
  const bool grouped = !plan.tiles && !info.trace.set();
  const RecycledVector<ConcurrentPasses> groups =
      grouped ? independentPasses(plan) : RecycledVector<ConcurrentPasses>();
  auto group = groups.begin();
  for (size_t i = 0; i < plan.passes.size(); ++i) {
    if (recorder_.tiles(i).empty()) {
      continue;
    }
    switch (plan.passes[i].id.kind) {
      case PassKind::shadow:
        recorder_.recordShadow(info, i);
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
    recorder_.endFaces(info);
  }
  if (info.settings.debug.checkFinite) {
    watch_.end(info.frame);
  }
}

void SceneRenderer::recordEnvironment(const FrameInfo& info, size_t index) {
  const Pass& face = info.plan.passes[index];
  const PixelRect& rect = face.view.rect;
  OffScreen& target = environmentTargets_.of(info.plan, face);
  const VkRect2D area{{face.corner.x, face.corner.y}, extentOf(rect.width, rect.height)};
  const Viewport viewport{static_cast<float>(face.corner.x), static_cast<float>(face.corner.y),
                          static_cast<float>(rect.width), static_cast<float>(rect.height)};
  recorder_.recordEnvironment(info, index, scenePass(info, face, target.targets(), area, viewport));
  const bool last = static_cast<size_t>(face.id.face) + 1 == faceAxes().size();
  if (last && !info.plan.tiles) {
    watch_.check(info.frame, log_.passes().back(), target, extentOf(3 * rect.width, 2 * rect.height));
  }
}

// Releases and checks images after the whole range, because barriers are recorded only before and after it.
void SceneRenderer::recordMirrors(const FrameInfo& info, const ConcurrentPasses& range) {
  // Tiles of the range's only pass. In a longer range, each pass draws all of its tiles.
  const TileRange tiles = recorder_.tiles(range.first);
  if (tiles.first == 0) {
    passTargets_ = mirrorTargets_.acquire(info.plan, range, *info.frame.retired);
  }
  std::vector<PassDesc> descs;
  for (size_t i = range.first; i < range.end; ++i) {
    const Pass& pass = info.plan.passes[i];
    const VkRect2D area{{0, 0}, extentOf(pass.view.rect.width, pass.view.rect.height)};
    PassDesc& desc =
        descs.emplace_back(scenePass(info, pass, passTargets_[i - range.first], area, viewportOf(pass.view)));
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
      recorder_.recordTiles(info, i, descs[i - range.first]);
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

void SceneRenderer::recordMain(const FrameInfo& info, size_t index) {
  const Pass& main = info.plan.passes[index];
  PassTargets targets = main_.drawn().targets();
  if (info.plan.encodes) {
    targets = {renderer_.displayTargets(info.frame).color, nullptr, targets.depth, TargetRole::swapchain};
  }
  const PassDesc whole = fullPass("", targets);
  PassDesc desc = scenePass(info, main, targets, whole.renderArea, whole.viewport);
  if (info.encodedBackground) {
    std::ranges::copy(info.encodedBackground->float32, desc.clearColor.begin());
  }
  if (main_.flat() && !info.plan.tiles) {
    desc.renderArea = desc.scissor = {{0, 0}, {1, 1}};  // the texel that the display may read
    recorder_.record(info, index, desc, 1.0);
    return mirrorTargets_.releaseShown(info.plan, main);
  }
  if (renderer_.roundsSumsDown()) {
    desc.targets.resolve = nullptr;  // recordMean() stands in
  }
  desc.storeSamples = info.settings.debug.checkFinite;
  watched_.prepare(info.plan, index, desc, *info.frame.retired);
  recorder_.recordTiles(info, index, desc);
  if (renderer_.roundsSumsDown() && endsPicture(info.plan)) {
    if (const auto mean = display_.recordMean(info.frame, main_.drawn(), info.plan.picture)) {
      log_.add(*mean);
      log_.joinLast();
    }
  }
  watch_.check(info.frame, log_.passes().back(), main_.drawn(), main_.drawn().extent());
  mirrorTargets_.releaseShown(info.plan, main);
}

void SceneRenderer::endPicture(const FrameInfo& info) {
  if (endsPicture(info.plan)) {
    watched_.finish(info.plan, info.frame.commands, *info.frame.retired);
  }
  main_.endFrame(info);
}

void SceneRenderer::recordDisplay(const FrameInfo& info, const std::optional<TargetDisplay>& debug,
                                  const std::optional<SplitDisplay>& split) {
  const VkExtent2D display = info.frame.extent;
  const bool divides = split && split->other.main_.hasRadiance();
  const uint32_t left = divides ? std::min(split->divider, display.width) : display.width;
  const std::array areas{VkRect2D{{0, 0}, {left, display.height}},
                         VkRect2D{{static_cast<int32_t>(left), 0}, {display.width - left, display.height}}};
  const auto log = [&](const RecordedPass& pass) {
    if (!main_.unfinished()) {
      log_.add(pass);
    }
  };
  if (!info.plan.encodes) {
    const auto shown = [](SceneRenderer& of) { return of.display_.covered(of.main_.displayed()); };
    std::array pictures{shown(*this), divides ? shown(split->other) : DisplayedPicture()};
    pictures[0].area = areas[divides && split->right];
    pictures[1].area = areas[divides && !split->right];
    log(display_.record(info.frame, std::span(pictures).first(divides ? 2 : 1)));
  }
  if (const auto target = debug ? showTarget(info.frame, info.plan, *debug) : std::nullopt) {
    log(*target);
  }
}

std::optional<RecordedPass> SceneRenderer::showTarget(Frame& frame, const FramePlan& plan, const TargetDisplay& debug) {
  const WatchedTarget::Target* target = watched_.shown(plan, debug);
  if (!target) {
    return std::nullopt;
  }
  OffScreen* image = watchedImage(plan, debug.pass);
  const bool showsDepth = target->kind == TargetKind::depth;
  if (showsDepth ? !watched_.hasDepth() : !image) {
    return std::nullopt;
  }
  Image& texels = showsDepth ? watched_.depth() : image->color();
  const MirrorImage shown{showsDepth ? watched_.depthDescriptor() : image->descriptor(), texels.samples()};
  const auto view = display_.recordTarget(frame, *target, debug, shown, main_.curve());
  // The target that is shown, of the last complete picture, may be smaller than the one that the probe was meant for.
  if (debug.probe && glm::all(glm::lessThan(*debug.probe, target->size))) {
    probe_.probe(frame, texels, shown.descriptor, *debug.probe);
  }
  return view;
}

// Keeps what the next frame may reuse, and releases what no frame needed for a while.
void SceneRenderer::keepImages(const FrameInfo& info) {
  recorder_.endPicture(info);
  if (!info.plan.mainReused()) {
    ledger_[EffectKind::toneMap].draws = info.settings.view.toneMap == ToneMap::aces && !main_.flat() ? 1 : 0;
    ledger_[EffectKind::curved].bytes += environmentTargets_.bytes();
    display_.countPipelines(ledger_);
  }
  main_.keep(info);
  mirrorTargets_.end(info.plan, *info.frame.retired);
  cacheRevision_ = renderer_.pipelines().revision();
}

OffScreen* SceneRenderer::watchedImage(const FramePlan& plan, int pass) {
  if (plan.passes[static_cast<size_t>(pass)].id.kind == PassKind::main) {
    return main_.hasColor() ? &main_.shown() : nullptr;
  }
  return main_.unfinished() || plan.mainReused() ? mirrorTargets_.earlierWatched()
                                                 : &mirrorTargets_[static_cast<size_t>(pass)];
}

FrameCache SceneRenderer::cache(const SceneState& state) {
  changes_.update(scene_, state);
  FrameCache cache{.changes = &changes_, .accumulated = accumulated()};
  cache.refined = main_.refined(cache.waitedMs);
  if (cacheRevision_ == renderer_.pipelines().revision()) {
    cache.images = mirrorTargets_.cachedImages();
    cache.cubes = cubes_;
    cache.main = main_.reusable();
  }
  return cache;
}

void SceneRenderer::restart() {
  main_.restart();
  cubes_.clear();
  environmentTargets_.restart();
  mirrorTargets_.restart();
}

std::optional<TexelValue> SceneRenderer::probed() {
  std::optional<TexelValue> found = probe_.value();
  if (found) {
    found->value /= glm::vec4(glm::vec3(static_cast<float>(main_.radianceScale())), 1.0f);
  }
  return found;
}

}  // namespace speculum
