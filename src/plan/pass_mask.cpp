#include "plan/pass_mask.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

// Returns the rectangle's corners in device coordinates, with z = 0.
Polygon corners(const View& view) {
  const glm::dvec2 step = 2.0 / view.pictureSize;
  const double x0 = view.rect.x * step.x - 1.0;
  const double y0 = view.rect.y * step.y - 1.0;
  const double x1 = (view.rect.x + view.rect.width) * step.x - 1.0;
  const double y1 = (view.rect.y + view.rect.height) * step.y - 1.0;
  return {{x0, y0, 0.0}, {x1, y0, 0.0}, {x1, y1, 0.0}, {x0, y1, 0.0}};
}

constexpr double shortestEdge = 1.0 / 8.0;  // pixels

// Says whether the polygon's edges are long enough and its corners far enough from straight that no triangle of its fan
// loses its area when the GPU snaps vertices to a grid of 1/256 of a pixel or coarser. If a draw has a triangle without
// area, lavapipe leaves out the others too.
bool isWellShaped(std::span<const glm::dvec3> polygon, const glm::dvec2& step) {
  constexpr double flattest = 1.0 / 32.0;  // pixels
  const size_t n = polygon.size();
  for (size_t i = 0; i < n; ++i) {
    const glm::dvec2 before = glm::dvec2(polygon[(i + n - 1) % n] - polygon[i]) / step;
    const glm::dvec2 after = glm::dvec2(polygon[(i + 1) % n] - polygon[i]) / step;
    const double base = glm::length(after - before);
    const double area = std::abs(before.x * after.y - before.y * after.x);  // twice the triangle's
    if (!(glm::length(after) >= shortestEdge && base > 0.0 && area >= flattest * base)) {
      return false;
    }
  }
  return n >= 3;
}

// A plane of the cone seen as a line on the screen, as in widen(): p lies inside where dot(line, p) + offset >= 0, in
// device coordinates with z = 0. `perPixel` is by how much a step of one pixel along each axis changes that.
struct Edge {
  glm::dvec3 line{0.0};
  double offset = 0.0;
  glm::dvec2 perPixel{0.0};
};

Edge edgeOf(const glm::dvec3& planeNormal, const View& view, const Projection& projection) {
  const glm::dvec2 perDevice(projection.aspect / projection.focal, 1.0 / projection.focal);
  const glm::dvec3 n = view.worldToView * planeNormal;
  const glm::dvec3 line(n.x * perDevice.x, -n.y * perDevice.y, 0.0);
  return {line, -n.z - glm::dot(glm::dvec2(line), projection.offset),
          glm::abs(2.0 / view.pictureSize * glm::dvec2(line))};
}

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

// Returns by how many pixels rounding may turn the planes of a mirror image's cone. Near a mirror its corners are
// rounded as the eye's position is: by more than a pixel if the eye is far from the origin and micrometres from the
// mirror.
double roundingOfCone(const View& view, const Projection& projection) {
  const double height = view.clip ? std::abs(view.clip->distance(view.eye)) : INFINITY;  // above 0, see heightAbove()
  const double pixel = 2.0 * height / (projection.focal * view.pictureSize.y);
  return pixel > 0.0 ? 1e-15 * glm::length(view.eye) / pixel : 0.0;
}

}  // namespace

bool mixesTexels(const Pass& pass) {
  return pass.quality.scale != 1.0 || pass.shownIn.scale != 1.0 || pass.quality.interval > 1;
}

double seenBeyond(const View& view, const Projection& projection, const View& shownIn, double reach) {
  return view.pictureSize.x / shownIn.pictureSize.x * reach + roundingOfCone(view, projection);
}

// At the screen's resolution a pixel reads one texel. The mask holds all samples of that texel, because a driver may
// shade at another point where only some of them pass the depth test. At other resolutions, and in cached images, a
// pixel reads a box about its centre, which may lie half a pixel outside the edge. The box is as wide as a pixel, or as
// a texel if that is wider, and half a texel more on each side for the samples.
double lookupReach(const Pass& pass, const Settings& settings, bool standardLocations) {
  const ImageQuality& image = pass.quality;
  if (mixesTexels(pass)) {
    return cachedLookupReach(image);
  }
  // Standard locations of 2, 4 and 8 samples, from the texel's middle.
  const auto farthest = [&](int samples) { return standardLocations ? 0.5 - 0.5 / std::min(samples, 8) : 0.5; };
  const int most = std::max({image.samples, pass.shownIn.samples, settings.view.samples});
  const double beside = image.samples == pass.shownIn.samples ? 0.0 : 1.0;  // read in the place of texels outside
  return farthest(most) + farthest(image.samples) + beside;
}

std::vector<double> lookupReaches(const FramePlan& plan, const Settings& settings, bool standardLocations) {
  std::vector<double> reaches(plan.passes.size(), 0.0);
  for (size_t i = plan.passes.size(); i-- > 0;) {  // an image comes before the one pass that shows it
    const Pass& pass = plan.passes[i];
    for (const MirrorDraw& draw : pass.mirrors) {
      if (draw.pass >= 0) {
        const Pass& shown = plan.passes[draw.pass];
        reaches[draw.pass] = lookupReach(shown, settings, standardLocations) +
                             seenBeyond(shown.view, plan.projection, pass.view, reaches[i]);
      }
    }
  }
  return reaches;
}

double cachedLookupReach(const ImageQuality& quality) {
  return std::max(quality.scale, 1.0) + 1.0;
}

std::vector<glm::dvec2> passMask(const View& view, const Projection& projection, double reach) {
  constexpr double rounding = 0.1;  // pixels; bound of the rounding of float positions on the GPU
  const glm::dvec2 step = 2.0 / view.pictureSize;
  Polygon part = corners(view);
  bool cut = false;
  for (const glm::dvec3& normal : view.cone) {
    const auto [line, exact, perPixel] = edgeOf(normal, view, projection);
    const double offset = exact + reach * (perPixel.x + perPixel.y) + rounding * glm::length(perPixel);
    const double length2 = glm::dot(line, line);
    if (length2 == 0.0) {
      continue;
    }
    // Moves the cut outwards until the polygon is well shaped, or does not cut at all: the mask may be larger than
    // needed.
    for (const double outwards : {0.0, 0.25, 0.5, 1.0}) {
      const double moved = offset + outwards * glm::length(perPixel);
      const auto inside = [&, &line = line](const glm::dvec3& p) { return glm::dot(line, p) + moved >= 0.0; };
      if (std::ranges::all_of(part, inside)) {
        break;
      }
      Polygon rest = clipPolygon(part, Plane{line * (-moved / length2), line});
      if (isWellShaped(rest, step)) {
        part = std::move(rest);
        cut = true;
        break;
      }
    }
  }
  if (!cut) {
    return {};
  }
  std::vector<glm::dvec2> mask;
  mask.reserve(part.size());
  for (const glm::dvec3& p : part) {
    mask.emplace_back(p);
  }
  return mask;
}

std::vector<std::vector<glm::dvec2>> outsideParts(const View& view, const Projection& projection) {
  std::vector<std::vector<glm::dvec2>> parts;
  const Polygon whole = corners(view);
  for (const glm::dvec3& normal : view.cone) {
    const auto [line, offset, perPixel] = edgeOf(normal, view, projection);
    const double length2 = glm::dot(line, line);
    if (length2 == 0.0) {
      continue;
    }
    const Plane edge{line * (-offset / length2), -line};
    Polygon part = clipPolygon(whole, edge);
    // A short edge loses its end at the rectangle's corner, where no texel's centre is near. Its other end lies on the
    // mirror's edge, and without that end the part would have another edge than the mirror.
    for (size_t i = part.size(); i-- > 0 && part.size() > 3;) {
      const size_t next = (i + 1) % part.size();
      if (glm::length(glm::dvec2(part[next] - part[i]) / (2.0 / view.pictureSize)) < shortestEdge) {
        part.erase(part.begin() +
                   static_cast<std::ptrdiff_t>(edge.distance(part[i]) > edge.distance(part[next]) ? i : next));
      }
    }
    if (isWellShaped(part, 2.0 / view.pictureSize)) {
      parts.emplace_back(part.begin(), part.end());
    }
  }
  return parts;
}

std::vector<std::vector<PixelRect>> convergedParts(const FramePlan& plan) {
  if (!plan.refined) {
    return {};
  }
  std::vector<std::vector<PixelRect>> parts(plan.passes.size());
  constexpr double everywhere = INFINITY;
  std::vector<double> margins(plan.passes.size(), 0.0);  // texels of the main view from refined tiles to what is read
  for (size_t i = plan.passes.size(); i-- > 0;) {
    const Pass& pass = plan.passes[i];
    if (pass.isFace() || !pass.drawn()) {
      continue;
    }
    for (const MirrorDraw& draw : pass.mirrors) {
      if (draw.pass >= 0) {
        const ImageQuality& image = plan.passes[draw.pass].quality;
        // A tile's edge may lie within a texel of an image of another size. That texel is drawn too, and texels beside
        // that stand in for those outside the mirror.
        const double reach = draw.blurs || draw.ripples ? everywhere
                             : image.scale == 1.0 && pass.quality.scale == 1.0
                                 ? (image.samples == pass.quality.samples ? 0.0 : 1.0)
                                 : (cachedLookupReach(image) + 1.0) / image.scale;
        margins[draw.pass] = std::max(margins[draw.pass], margins[i] + reach);
      }
    }
    if (margins[i] == everywhere) {
      continue;
    }
    const glm::dvec2 size = pass.view.pictureSize / plan.main().view.pictureSize;
    for (const PixelRect& rect : convergedRects(*plan.refined, static_cast<int>(std::ceil(margins[i])))) {
      const glm::ivec2 low(glm::ceil(size * glm::dvec2(rect.x, rect.y)));
      const glm::ivec2 high(glm::floor(size * glm::dvec2(rect.x + rect.width, rect.y + rect.height)));
      const PixelRect part = intersect({low.x, low.y, high.x - low.x, high.y - low.y}, pass.view.rect);
      if (!part.empty()) {
        parts[i].push_back(part);
      }
    }
  }
  return parts;
}

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
