#include "plan/mirror_search.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <optional>
#include <queue>
#include <string>

#include "plan/cube_face.hpp"
#include "plan/mirror_sight.hpp"
#include "plan/occlusion.hpp"
#include "plan/pass_mask.hpp"

namespace speculum {

namespace {

// A mirror that gets a pass if the budget of passes suffices.
struct Candidate {
  double priority = 0.0;
  int parent = 0;       // node
  size_t draw = 0;      // index into the parent's mirrors
  Polygon visible;      // world; visible region
  double areaPx = 0.0;  // pixels of the picture
  glm::dvec3 throughput{1.0};
  int order = 0;  // number in order of discovery; settles ties so that plans are reproducible

  bool operator<(const Candidate& other) const {
    return priority != other.priority ? priority < other.priority : order > other.order;
  }
};

// Bounds time and memory of a plan, whatever reflection.max_passes is: 25 000 passes of a few mirrors each, 1 200 of a
// thousand, or 200 that show 200 others each.
constexpr size_t mostWork = 2'500'000;

RecycledString number(double value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 3).ptr;
  return {text.data(), end};
}

// Returns the boxes of the mirrors, with room for the rounding of what is cut from them.
RecycledVector<Bounds> mirrorBoxes(const SceneState& state) {
  RecycledVector<Bounds> boxes;
  for (const MirrorState& mirror : state.mirrors) {
    boxes.push_back(Bounds::around(mirror.polygon).widened(1e-9));
  }
  return boxes;
}

class MirrorSearch {
 public:
  MirrorSearch(const Scene& scene, const SceneState& state, const Settings& settings, const FrameCache& cache,
               FramePlan& plan)
      : scene_(scene),
        state_(state),
        allSettings_(settings),
        settings_(settings.reflection),
        cache_(cache),
        plan_(plan),
        hierarchy_(mirrorBoxes(state)),
        occlusion_(scene, state, settings, plan.projection, hierarchy_) {}

  RecycledVector<MirrorNode> nodes(const glm::ivec2& size) {
    MirrorNode& root = nodes_.emplace_back();
    root.pass.view = mainView(state_.camera, plan_.projection, size.x, size.y);
    root.pass.areaPx = root.pass.view.rect.area();
    root.pass.quality.samples = allSettings_.view.samples;
    fill(0);
    while (!candidates_.empty()) {
      const Candidate best = candidates_.top();
      candidates_.pop();
      expand(best);
    }
    return std::move(nodes_);
  }

 private:
  void fill(int node);
  void skip(const View& view, int mirror, SkipReason reason, RecycledString detail = {}) {
    plan_.skipped.push_back(skippedMirror(view, mirror, reason, std::move(detail)));
  }
  void consider(int node, Sight sight);
  void propose(int node, Sight sight);
  void expand(const Candidate& candidate);
  ImageQuality qualityOf(int mirror, const Pass& shownIn) const;
  double shownBeyond(const Pass& shownIn, const View& view) const;

  const Scene& scene_;
  const SceneState& state_;
  const Settings& allSettings_;
  const ReflectionSettings& settings_;
  const FrameCache& cache_;
  FramePlan& plan_;
  RecycledVector<MirrorNode> nodes_;
  std::priority_queue<Candidate, RecycledVector<Candidate>> candidates_;
  Bvh hierarchy_;  // of mirrors
  Occlusion occlusion_;
  int discovered_ = 0;
  size_t work_ = 0;  // 2 for each mirror looked at, and other steps in proportion to their time and memory
};

// Finds what a node's view draws, and which of its mirrors are candidates for passes.
void MirrorSearch::fill(int node) {
  const View view = nodes_[node].pass.view;
  const View readable = readableView(nodes_[node].pass, plan_.projection);
  const Onlooker onlooker = view.path.empty() ? Onlooker::eye : Onlooker::mirror;
  View reached = readable;  // by wide lines of triangles outside it
  if (allSettings_.view.wireframe && allSettings_.view.lineWidth > 1.0) {
    widen(reached, plan_.projection, static_cast<int>(std::ceil(plan_.lineWidth(view, allSettings_.view))));
  }
  addVisibleInstances(reached, onlooker, scene_, state_, allSettings_.debug.cullClusters, -1, nodes_[node].pass);
  addVisibleLights(readable, onlooker, scene_, state_, allSettings_.effects, nodes_[node].pass);
  // Polygons are cut one pixel farther out, so that no cut edge lies where the image is read.
  View drawn = readable;
  widen(drawn, plan_.projection, 1);
  // The image of a mirror shows no mirror that lies in the same plane.
  const auto inOwnPlane = [&](int mirror) {
    return !view.path.empty() && state_.mirrors[view.path.back()].plane == state_.mirrors[mirror].plane;
  };
  // Lines of sight come from the reflected eye and begin to see at the window. A line that crosses another mirror's
  // plane before the window does not meet that mirror. Where both mirrors share an edge, rounding would show the
  // other's back.
  std::optional<Polygon> window;  // the part of the view's own mirror through which it sees
  const auto liesBefore = [&](int mirror) {
    if (!window) {
      View through = view;
      through.clip.reset();
      window = view.path.empty() ? Polygon() : visiblePart(through, state_.mirrors[view.path.back()].polygon);
    }
    const double height = heightAbove(state_.mirrors[mirror], view.eye);
    return height != 0.0 && !window->empty() && std::ranges::all_of(*window, [&](const glm::dvec3& p) {
             return height * heightAbove(state_.mirrors[mirror], p) <= 0.0;
           });
  };
  RecycledVector<int> near;  // mirrors whose boxes the view may see
  hierarchy_.visit([&](const Bounds& box) { return boxVisible(view, box); },
                   [&](uint32_t i) { near.push_back(static_cast<int>(i)); });
  std::ranges::sort(near);
  RecycledVector<Sight> sights;  // of the mirrors that are seen
  RecycledVector<int> seen;
  for (const int i : near) {
    if (!inOwnPlane(i) && !isBehindEye(view, state_.mirrors[i].polygon)) {
      Sight sight = sightOf(scene_, state_, view, drawn, i);
      if (!sight.visible.empty() && !liesBefore(i)) {
        sights.push_back(std::move(sight));
        seen.push_back(i);
      }
    }
  }
  // A mirror that is seen counts more: it is kept with its polygon, and tested against the others that are seen.
  work_ += 72 + 2 * scene_.mirrorCount() + seen.size() * (4 + std::min<size_t>(seen.size(), 512) / 4) +
           state_.instances.size() / 16 + nodes_[node].pass.instances.size() / 4 + state_.lights.size() / 8;
  nodes_[node].pass.unseen = static_cast<uint32_t>(scene_.mirrorCount() - !view.path.empty() - seen.size());
  occlusion_.setView(view, nodes_[node].pass.instances, std::move(seen));
  for (Sight& sight : sights) {
    consider(node, std::move(sight));
  }
}

void MirrorSearch::consider(int node, Sight sight) {
  Pass& pass = nodes_[node].pass;
  const View& view = pass.view;
  const int mirror = sight.draw.mirror;
  const std::optional<RecycledString> occluder = occlusion_.hiddenBy(mirror, sight.draw.polygon);
  if (sight.draw.back) {
    if (sight.height < 0.0 && !occluder) {
      pass.mirrors.push_back(std::move(sight.draw));
    }
    return plan_.skipped.push_back(skippedBack(view, mirror, sight.height));
  }
  if (occluder) {
    return skip(view, mirror, SkipReason::hidden, "behind " + *occluder);
  }
  propose(node, std::move(sight));
}

// Adds a visible mirror to the draws, and makes it a candidate if it is worth a pass.
void MirrorSearch::propose(int node, Sight sight) {
  Pass& pass = nodes_[node].pass;
  const View& view = pass.view;
  const int mirror = sight.draw.mirror;
  const Mirror& material = scene_.mirror(mirror);
  const MirrorOptics optics = opticsOf(material, allSettings_.effects);
  const double area = screenArea(toClip(view, plan_.projection, sight.visible), plan_.width, plan_.height);
  const glm::dvec3 throughput = pass.channels * reflectanceBound(optics, sight.draw.plane, view.eye, sight.visible);
  const bool deep = static_cast<int>(view.path.size()) >= settings_.maxDepth;
  const bool reflects = !deep && glm::compMax(throughput) >= settings_.minThroughput;
  const glm::dvec2 texels = view.pictureSize / glm::dvec2(plan_.width, plan_.height);
  const double samples = area * texels.x * texels.y * pass.quality.samples;
  const std::string_view rays = whyRays(material.quality, optics, allSettings_, reflects, samples);
  sight.draw.byRays = !rays.empty();
  sight.draw.blurs = reflects && !sight.draw.byRays && optics.alpha > 0.0;
  sight.draw.ripples = reflects && !sight.draw.byRays && optics.ripple;
  pass.mirrors.push_back(std::move(sight.draw));
  if (deep) {
    return skip(view, mirror, SkipReason::maxDepth,
                RecycledString("max_depth ").append(std::to_string(settings_.maxDepth)));
  }
  if (rays.empty() && area < settings_.minPixels) {
    return skip(view, mirror, SkipReason::minPixels, number(area) + " px");
  }
  if (glm::compMax(throughput) < settings_.minThroughput) {
    return skip(view, mirror, SkipReason::minThroughput, number(glm::compMax(throughput)));
  }
  if (!rays.empty()) {
    return skip(view, mirror, SkipReason::rays, RecycledString(rays));
  }
  candidates_.push({area * glm::compMax(throughput), node, pass.mirrors.size() - 1, std::move(sight.visible), area,
                    throughput, discovered_++});
}

ImageQuality MirrorSearch::qualityOf(int mirror, const Pass& shownIn) const {
  const ReflectionSettings own = reflectionOf(scene_.mirror(mirror).quality, allSettings_);
  if (shownIn.view.path.empty()) {
    return {own.scale, own.samples, own.updateInterval};
  }
  const auto& [scale, samples, interval] = shownIn.quality;
  return {std::min(own.scale, scale), std::min(own.samples, samples), interval};
}

// A pass is read beyond its view's cone, and shows other mirrors there.
double MirrorSearch::shownBeyond(const Pass& shownIn, const View& view) const {
  constexpr double most = 1e4;  // far outside any picture
  const double read = shownIn.view.path.empty() ? 0.0 : lookupReach(shownIn, allSettings_, false);
  return std::min(seenBeyond(view, plan_.projection, shownIn.view, shownIn.shownBeyond + read), most);
}

void MirrorSearch::expand(const Candidate& candidate) {
  const View& parent = nodes_[candidate.parent].pass.view;
  const MirrorDraw& draw = nodes_[candidate.parent].pass.mirrors[candidate.draw];
  if (static_cast<int>(nodes_.size()) > settings_.maxPasses) {
    return skip(parent, draw.mirror, SkipReason::maxPasses,
                RecycledString("max_passes ").append(std::to_string(settings_.maxPasses)));
  }
  if (work_ > mostWork) {
    return skip(parent, draw.mirror, SkipReason::maxPasses, "too many to plan");
  }
  MirrorNode node;
  node.pass.shownIn = nodes_[candidate.parent].pass.quality;
  node.pass.quality = qualityOf(draw.mirror, nodes_[candidate.parent].pass);
  const glm::dvec2 picture = nodes_[0].pass.view.pictureSize * node.pass.quality.scale;
  const glm::dvec2 ratio = picture / parent.pictureSize;
  const PixelRect& outer = parent.rect;
  const int x0 = static_cast<int>(std::floor(outer.x * ratio.x));
  const int y0 = static_cast<int>(std::floor(outer.y * ratio.y));
  const int x1 = static_cast<int>(std::ceil((outer.x + outer.width) * ratio.x));
  const int y1 = static_cast<int>(std::ceil((outer.y + outer.height) * ratio.y));
  const PixelRect rect =
      screenRect(toClip(parent, plan_.projection, candidate.visible), picture.x, picture.y, {x0, y0, x1 - x0, y1 - y0});
  if (rect.empty()) {
    return skip(parent, draw.mirror, SkipReason::outside);
  }
  node.pass.view = reflectedView(parent, draw.mirror, draw.plane, candidate.visible, rect, picture);
  const bool displacesLookup = draw.blurs || draw.ripples;
  if (displacesLookup) {
    boundByRectangle(node.pass.view, plan_.projection);
  }
  node.pass.areaPx = candidate.areaPx * (picture.x / plan_.width) * (picture.y / plan_.height);
  node.pass.channels = candidate.throughput;
  node.pass.shownBeyond = shownBeyond(nodes_[candidate.parent].pass, node.pass.view);
  node.draw = candidate.draw;
  // An image that is read beside a pixel's own texel cannot be reprojected.
  const int interval = displacesLookup ? 1 : node.pass.quality.interval;
  if (parent.path.empty() && (interval > 1 || settings_.skipUnchanged)) {
    const ReuseRequest request{node.pass.view, plan_.projection,          candidate.visible,
                               allSettings_,   node.pass.quality.samples, interval,
                               candidate.order};
    node.choice = chooseImage(cache_.images, request);
    if (node.choice->image.cacheIndex < 0) {
      node.pass.view = node.choice->image.view;
    }
  }
  const int index = static_cast<int>(nodes_.size());
  nodes_[candidate.parent].children.push_back(index);
  nodes_.push_back(std::move(node));
  fill(index);
}

}  // namespace

RecycledVector<MirrorNode> findPasses(const Scene& scene, const SceneState& state, const Settings& settings,
                                      const FrameCache& cache, const glm::ivec2& size, FramePlan& plan) {
  return MirrorSearch(scene, state, settings, cache, plan).nodes(size);
}

View readableView(const Pass& pass, const Projection& projection) {
  View readable = pass.view;
  if (!readable.path.empty()) {
    widen(readable, projection,
          static_cast<int>(std::ceil(1.5 * cachedLookupReach(pass.quality) + pass.shownBeyond)) + 1);
  }
  return readable;
}

}  // namespace speculum
