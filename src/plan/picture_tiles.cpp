#include "plan/picture_tiles.hpp"

#include <algorithm>

#include "plan/mirror_sight.hpp"

namespace speculum {

namespace {

// Most rays that are submitted together. Each part of a pass draws the whole geometry once more: with a quarter of this
// limit, the scene pool takes 1.8 times as long on an H200, which traces this many rays in some 10 ms.
constexpr double mostRays = 1 << 27;

int tilesAlong(int texels) {
  return (texels + tileSide - 1) / tileSide;
}

// Returns the number of tiles of a pass: none if the pass is not drawn, or is a layer, which is drawn with its face.
size_t tilesOf(const Pass& pass) {
  return !pass.drawn() || pass.isLayer ? 0 : pass.isFace() ? 1 : tilesIn(pass.view.rect);
}

}  // namespace

size_t faceCount(const FramePlan& plan) {
  size_t count = 0;
  for (const Pass& pass : plan.passes) {
    count += pass.isFace() ? tilesOf(pass) : 0;
  }
  return count;
}

size_t tileCount(const FramePlan& plan) {
  size_t count = 0;
  for (const Pass& pass : plan.passes) {
    count += tilesOf(pass);
  }
  return count;
}

std::vector<TileRange> tilesOfPasses(const FramePlan& plan) {
  const TileRange drawn = plan.tiles.value_or(TileRange{0, SIZE_MAX});
  std::vector<TileRange> tiles;
  size_t before = 0;
  for (const Pass& pass : plan.passes) {
    const size_t end = before + tilesOf(pass);
    tiles.push_back({std::clamp(drawn.first, before, end) - before, std::clamp(drawn.end, before, end) - before});
    before = end;
  }
  return tiles;
}

std::vector<PixelRect> tileRects(int width, int height, const TileRange& tiles) {
  std::vector<PixelRect> rects;
  const auto columns = static_cast<size_t>(tilesAlong(width));
  const size_t count = tilesIn({0, 0, width, height});
  for (size_t tile = count - tiles.end; tile < count - tiles.first;) {
    const size_t row = tile / columns;
    const size_t column = tile % columns;
    const size_t left = count - tiles.first - tile;
    const size_t wholeRows = column == 0 ? left / columns : 0;
    const size_t across = wholeRows > 0 ? columns : std::min(columns - column, left);
    const size_t down = std::max<size_t>(wholeRows, 1);
    const int x = static_cast<int>(column) * tileSide;
    const int y = static_cast<int>(row) * tileSide;
    rects.push_back({x, y, std::min(static_cast<int>(across) * tileSide, width - x),
                     std::min(static_cast<int>(down) * tileSide, height - y)});
    tile += across * down;
  }
  std::ranges::reverse(rects);
  return rects;
}

size_t tilesAtOnce(const FramePlan& plan, const Settings& settings, size_t raysToLights) {
  if (!plan.effects.traces()) {
    return SIZE_MAX;
  }
  // Rays of ripples and of smooth mirrors go through each sample.
  const bool perSample = settings.effects.perSample || plan.effects.rippleRays || plan.effects.mirrorRays;
  int samples = std::max(settings.view.samples, settings.reflection.samples);
  forEachSeen(plan, [&](const Pass& pass) { samples = std::max(samples, pass.quality.samples); });
  const int rough = plan.effects.roughRays ? roughRays(settings.effects, samples) : 1;
  const int paths = std::max(perSample ? samples : 1, rough);  // paths of rays from a pixel
  const int bounces = plan.effects.reflects() ? std::max(settings.reflection.maxDepth, 1) : 1;
  const double rays = static_cast<double>(paths) * bounces * static_cast<double>(1 + raysToLights);
  return static_cast<size_t>(std::max(1.0, mostRays / (tileSide * tileSide * rays)));
}

size_t tilesIn(const PixelRect& rect) {
  return static_cast<size_t>(tilesAlong(rect.width)) * static_cast<size_t>(tilesAlong(rect.height));
}

bool beginsPicture(const FramePlan& plan) {
  return !plan.tiles || plan.tiles->first == 0;
}

bool endsFaces(const FramePlan& plan) {
  return !plan.tiles ||
         (plan.tiles->end >= faceCount(plan) && (beginsPicture(plan) || plan.tiles->first < faceCount(plan)));
}

bool endsPicture(const FramePlan& plan) {
  return !plan.tiles || plan.tiles->end >= tileCount(plan);
}

}  // namespace speculum
