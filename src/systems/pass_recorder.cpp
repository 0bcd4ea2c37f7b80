#include "systems/pass_recorder.hpp"

#include <algorithm>
#include <utility>

#include "plan/target_memory.hpp"

namespace speculum {

PassRecorder::PassRecorder(Renderer& renderer, VkDescriptorSetLayout frameLayout, VkDescriptorSetLayout textureLayout)
    : renderer_(renderer),
      maskSystem_(renderer.pipelines(), frameLayout),
      renderSystem_(renderer.pipelines(), frameLayout, textureLayout),
      pointLightSystem_(renderer.pipelines(), frameLayout),
      mirrorSystem_(renderer.device(), renderer.uploader(), renderer.pipelines(), frameLayout),
      shadowSystem_(renderer.device(), renderer.pipelines(), frameLayout),
      deferredShading_(renderer.device(), renderer.pipelines(), frameLayout) {}

void PassRecorder::beginFrame(Frame& frame, const Scene& scene, const Settings& settings, const FramePlan& plan) {
  tiles_ = tilesOfPasses(plan);
  tilesLeft_ = tilesAtOnce_ = tilesAtOnce(plan, settings, plan.effects.raysToLights(scene));
  shadowSystem_.prepare(frame, plan);
}

bool PassRecorder::defers(const FrameInfo& info, size_t index) {
  const DrawList& pass = info.data.passes()[index];
  return MirrorSystem::defers(info, pass) || RenderSystem::defers(info, pass);
}

void PassRecorder::makeRoom(Frame& frame, size_t tiles) {
  if (tilesLeft_ < std::min(tiles, tilesAtOnce_)) {
    renderer_.submitPart(frame);
    tilesLeft_ = tilesAtOnce_;
  }
}

void PassRecorder::recordShadow(const FrameInfo& info, size_t index) {
  const int layer = info.plan.passes[index].layer;
  const RecordedPass pass = shadowSystem_.record(renderer_, info, index);
  info.ledger[EffectKind::shadows].draws += pass.draws;
  info.log.add(pass);
  if (layer >= 0 && info.plan.passes[static_cast<size_t>(layer)].drawn()) {
    info.log.add(pass);
    info.log.joinLast();
  }
}

void PassRecorder::recordEnvironment(const FrameInfo& info, size_t index, const PassDesc& desc) {
  const Pass& face = info.plan.passes[index];
  const uint32_t drawsBefore = info.ledger[EffectKind::curved].draws;
  const size_t tiles = tilesIn(face.view.rect);
  makeRoom(info.frame, tiles);
  record(info, index, desc, face.areaPx);
  tilesLeft_ -= std::min(tilesLeft_, tiles);
  // Counts each draw once: record() has entered the curved mirrors seen in the face.
  info.ledger[EffectKind::curved].draws = drawsBefore + info.log.passes().back().draws;
}

// Counts the draws of the first rectangle only: the other rectangles repeat these draws.
void PassRecorder::recordTiles(const FrameInfo& info, size_t index, const PassDesc& desc) {
  const auto [width, height] = desc.renderArea.extent;
  const TileRange& tiles = tiles_[index];
  bool first = tiles.first == 0;
  for (size_t begin = tiles.first; begin < tiles.end;) {
    makeRoom(info.frame, 1);
    const TileRange part{begin, begin + std::min(tilesLeft_, tiles.end - begin)};
    std::vector<PixelRect> rects = tileRects(static_cast<int>(width), static_cast<int>(height), part);
    if (defers(info, index)) {
      rects = DeferredShading::bands(rects, desc.targets.samples());
    }
    for (const PixelRect& rect : rects) {
      PassDesc drawn = desc;
      drawn.renderArea = drawn.scissor = {{rect.x, rect.y}, extentOf(rect.width, rect.height)};
      drawn.keepsSamples = info.plan.tiles || part != tiles || rects.size() > 1;
      const EffectLedger ledger = info.ledger;
      record(info, index, drawn, info.plan.passes[index].areaPx);
      if (!std::exchange(first, false)) {
        info.log.joinLast();
        info.ledger = ledger;
      }
    }
    tilesLeft_ -= part.end - part.first;
    begin = part.end;
  }
}

void PassRecorder::record(const FrameInfo& info, size_t index, const PassDesc& desc, double areaPx) {
  const Pass& pass = info.plan.passes[index];
  const DrawList& data = info.data.passes()[index];
  const bool deferred = defers(info, index);
  PassScope scope = renderer_.beginPass(info.frame, deferred ? DeferredShading::identifying(desc) : desc);
  uint32_t draws = maskSystem_.record(scope, info, data);
  scope.countSamples();
  draws += mirrorSystem_.record(scope, info, data);
  draws += pointLightSystem_.record(scope, info, data);
  draws += renderSystem_.record(scope, info, data);
  if (deferred) {
    scope.pause();
    deferredShading_.shade(scope, info, data);
    scope.resume(DeferredShading::shaded(desc));
    draws += deferredShading_.record(scope);
    draws += mirrorSystem_.recordReflections(scope, info, data);
    draws += renderSystem_.recordReflections(scope, info, data, deferredShading_);
  }
  draws += maskSystem_.markOutside(scope, info, data);
  info.log.add({pass.id, desc.name, draws, areaPx});
}

void PassRecorder::endPicture(const FrameInfo& info) {
  const FramePlan& plan = info.plan;
  const auto isShown = [](const Pass& pass) { return pass.source == PassSource::reused && !pass.isFace(); };
  const bool imagesShown = std::ranges::any_of(plan.passes, isShown);
  const bool glyphsShown =
      std::ranges::any_of(plan.passes, [&](const Pass& pass) { return isShown(pass) && !pass.lights.empty(); });
  const bool shadowMaps = !cubesOf(plan.cubes, PassKind::shadow).empty();
  const bool tracedShown = imagesShown && plan.effects.any();
  renderSystem_.endFrame(info.trace.variant(), shadowMaps, imagesShown, plan.effects.curved.has_value(), info.textured,
                         drawsTransparency(info.scene, info.state, info.settings, plan));
  mirrorSystem_.endFrame(info.trace.variant(), shadowMaps, tracedShown, info.textured);
  deferredShading_.endFrame(info.trace.variant(), tracedShown, *info.frame.retired);
  pointLightSystem_.endFrame(glyphsShown);
  if (!plan.mainReused()) {
    enterCosts(info);
  }
}

void PassRecorder::enterCosts(const FrameInfo& info) {
  const TracedEffects& effects = info.plan.effects;
  EffectLedger& ledger = info.ledger;
  ledger[EffectKind::msaa].bytes = sampleBytes(info.plan, info.settings);
  for (const RecordedPass& pass : info.log.passes()) {
    if (ledger[EffectKind::msaa].bytes > 0) {  // else the search would take time in the square of the passes
      const bool main = pass.kind == PassKind::main;
      const Pass* planned = main ? &info.plan.main() : mirrorPass(info.plan, pass.path);
      ledger[EffectKind::msaa].draws += planned && planned->quality.samples > 1 ? pass.draws : 0;
    }
  }
  ledger[EffectKind::textures].bytes = ledger[EffectKind::textures].draws > 0 ? info.resources.textureBytes() : 0;
  for (const auto& [kind, traces] :
       {std::pair(EffectKind::shadows, effects.shadowRays), std::pair(EffectKind::roughness, effects.roughRays),
        std::pair(EffectKind::ripple, effects.rippleRays),
        std::pair(EffectKind::castsLight, effects.castsLight.has_value()),
        std::pair(EffectKind::curved, effects.curvedRays)}) {
    ledger[kind].bytes = traces ? info.trace.bytes() + deferredShading_.bytes() : 0;
  }
  ledger[EffectKind::shadows].bytes += shadowSystem_.bytes();
  ledger[EffectKind::shadows].pipelines += static_cast<uint32_t>(shadowSystem_.pipelineCount());
  ledger[EffectKind::glyphs].pipelines = static_cast<uint32_t>(pointLightSystem_.pipelineCount());
  renderSystem_.countPipelines(ledger);
  mirrorSystem_.countPipelines(ledger);
  deferredShading_.countPipelines(ledger);
  ledger.rays = info.trace.rays();
}

}  // namespace speculum
