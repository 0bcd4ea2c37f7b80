#include "frame/frame_plan.hpp"

#include <queue>

#include "frame/cube_face.hpp"
#include "frame/environment_map.hpp"
#include "frame/image_reuse.hpp"
#include "frame/mesh_level.hpp"
#include "frame/mirror_sight.hpp"
#include "frame/occlusion.hpp"
#include "frame/pass_mask.hpp"
#include "frame/picture_offset.hpp"
#include "frame/shadow_map.hpp"

namespace speculum {

namespace {

constexpr double largestNear = 0.001;  // metres

// A pass before its index in the order of recording is known.
struct Node {
  PlannedPass pass;
  size_t draw = 0;  // index of its mirror among the parent's draws
  std::vector<int> children;
  std::optional<ImageChoice> choice;  // set for mirrors seen directly whose images are cached
};

// A mirror that deserves a pass, if the budget reaches it.
struct Candidate {
  double priority = 0.0;
  int parent = 0;                   // node
  size_t draw = 0;                  // index into the parent's mirrors
  std::vector<glm::dvec3> visible;  // world; visible region
  double areaPx = 0.0;              // of the picture
  glm::dvec3 throughput{1.0};
  int order = 0;  // of discovery; settles ties so that plans are reproducible

  bool operator<(const Candidate& other) const {
    return priority != other.priority ? priority < other.priority : order > other.order;
  }
};

// Bounds time and memory of a plan, whatever reflection.max_passes is: 25 000 passes of a few mirrors each, 1 200 of a
// thousand, or 200 that show 200 others each.
constexpr size_t mostWork = 2'500'000;

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

std::string number(double value) {
  std::ostringstream out;
  out.precision(3);
  out << value;
  return out.str();
}

class Planner {
 public:
  Planner(const Scene& scene, const SceneState& state, const Settings& settings, int width, int height,
          const FrameCache& cache, int picture)
      : scene_(scene), state_(state), allSettings_(settings), settings_(settings.reflection), cache_(cache) {
    // A larger `near` gains nothing, because depth is near / distance in a float, and loses the order of all that is
    // nearer, which is clamped to one depth.
    const double near = std::min(state.camera.near, largestNear);
    plan_.projection = Projection(state.camera.verticalFov, static_cast<double>(width) / height, near);
    plan_.width = width;
    plan_.height = height;
    plan_.picture = picture;
    const auto texels = [&](int pixels) {
      return std::max(1, static_cast<int>(std::lround(pixels * settings.view.scale)));
    };
    size_ = {texels(width), texels(height)};
    if (picture < settings.view.accumulate) {
      plan_.projection.offset = -2.0 * pictureOffset(picture, settings) / glm::dvec2(size_);
    }
    occlusion_.emplace(scene, state, settings, plan_.projection);
  }

  FramePlan plan() {
    Node& root = nodes_.emplace_back();
    root.pass.view = mainView(state_.camera, plan_.projection, size_.x, size_.y);
    root.pass.areaPx = root.pass.view.rect.area();
    fill(0);
    while (!candidates_.empty()) {
      const Candidate best = candidates_.top();
      candidates_.pop();
      expand(best);
    }
    findEffects();
    simplify();
    reuseUnchanged();
    record(0);
    dropSkipsInReused();
    if (settings_.skipUnchanged && !allSettings_.view.continuous) {
      reuseMain(plan_, cache_.main, surroundings());
    }
    if (allSettings_.view.accumulate > 1 && plan_.picture >= allSettings_.view.accumulate) {
      reuseMean();
    }
    return std::move(plan_);
  }

 private:
  void fill(int node);
  void skipUnseen(const View& view, int mirror);
  void skipBack(const View& view, int mirror, double height);
  void consider(int node, Sight sight);
  void propose(int node, Sight sight);
  void skip(const View& view, int mirror, SkipReason reason, std::string detail = {});
  void expand(const Candidate& candidate);
  View readable(const View& view) const;
  void findEffects();
  void findShadows();
  ImageSurroundings surroundings() const;
  void simplify();
  void reuseUnchanged();
  void collect(int node, std::vector<const PlannedPass*>& passes) const;
  int record(int node);
  void reuseImage(MirrorDraw& draw, const Node& node);
  void recordReused(int node);
  void dropSkipsInReused();
  void reuseMean();
  bool behindEye(const View& view, std::span<const glm::dvec3> polygon) const;

  const Scene& scene_;
  const SceneState& state_;
  const Settings& allSettings_;
  const ReflectionSettings& settings_;
  const FrameCache& cache_;
  FramePlan plan_;
  glm::ivec2 size_{0};  // texels of the main view
  std::vector<Node> nodes_;
  std::priority_queue<Candidate> candidates_;
  std::optional<Occlusion> occlusion_;
  int discovered_ = 0;
  size_t work_ = 0;  // twice the mirrors looked at, and as much time and memory spent on what else a pass has
};

// Widens the view by what look-ups read of its image beyond the visible region. Cached images are read farthest; all
// views get that margin, so that the same is drawn in the same order with every update interval.
View Planner::readable(const View& view) const {
  View readable = view;
  if (!view.path.empty()) {
    Settings caching = allSettings_;
    caching.reflection.updateInterval = std::max(caching.reflection.updateInterval, 2);
    widen(readable, plan_.projection, static_cast<int>(std::ceil(1.5 * lookupReach(caching, false))) + 1);
  }
  return readable;
}

// Finds what is drawn in a node's view, and which of its mirrors are candidates for passes.
void Planner::fill(int node) {
  const View view = nodes_[node].pass.view;
  const View readable = this->readable(view);
  addVisibleInstances(readable, scene_, state_, allSettings_.debug.cullClusters, -1, nodes_[node].pass);
  for (size_t i = 0; i < scene_.lights.size(); ++i) {
    const PointLight& light = scene_.lights[i];
    if (hasGlyph(light, allSettings_.effects) && sphereVisible(readable, state_.lights[i].position, light.radius)) {
      nodes_[node].pass.lights.push_back(static_cast<int>(i));
    }
  }
  // Polygons are cut one pixel farther out, so that no cut edge lies where the image is read.
  View drawn = readable;
  widen(drawn, plan_.projection, 1);
  const auto isOwn = [&](int mirror) { return !view.path.empty() && view.path.back() == mirror; };
  std::vector<Sight> sights;  // of the mirrors that are seen; a view may look at a thousand that are not
  std::vector<int> seen;
  for (int i = 0; i < static_cast<int>(scene_.mirrors.size()); ++i) {
    if (!isOwn(i) && !behindEye(view, state_.mirrors[i].polygon)) {
      Sight sight = sightOf(scene_, state_, view, drawn, i);
      if (!sight.visible.empty()) {
        sights.push_back(std::move(sight));
        seen.push_back(i);
      }
    }
  }
  // Each mirror that is seen is kept with its polygon, and tested against the others.
  work_ += 64 + 2 * scene_.mirrors.size() + seen.size() * (4 + std::min<size_t>(seen.size(), 512) / 4) +
           (state_.instances.size() + nodes_[node].pass.instances.size()) / 16 + state_.lights.size() / 8;
  occlusion_->setView(view, nodes_[node].pass.instances, std::move(seen));
  size_t next = 0;
  for (int i = 0; i < static_cast<int>(scene_.mirrors.size()); ++i) {
    if (next < sights.size() && sights[next].draw.mirror == i) {
      consider(node, std::move(sights[next++]));
    } else if (!isOwn(i)) {
      skipUnseen(view, i);
    }
  }
}

bool Planner::behindEye(const View& view, std::span<const glm::dvec3> polygon) const {
  return std::ranges::all_of(polygon,
                             [&](const glm::dvec3& p) { return (view.worldToView * (p - view.eye)).z >= 0.0; });
}

void Planner::skip(const View& view, int mirror, SkipReason reason, std::string detail) {
  SkippedMirror skipped{mirror, view.path, static_cast<int>(view.path.size()), reason, std::move(detail)};
  skipped.path.push_back(mirror);
  plan_.skipped.push_back(std::move(skipped));
}

void Planner::skipUnseen(const View& view, int mirror) {
  const MirrorState& placed = state_.mirrors[mirror];
  if (behindEye(view, placed.polygon)) {
    return skip(view, mirror, SkipReason::behind);
  }
  const double height = heightAbove(placed, view.eye);
  if (showsBack(scene_.mirrors[mirror], height)) {
    return skipBack(view, mirror, height);
  }
  skip(view, mirror, SkipReason::outside);
}

void Planner::skipBack(const View& view, int mirror, double height) {
  skip(view, mirror, SkipReason::backface, height == 0.0 ? "the eye is in its plane" : "");
}

void Planner::consider(int node, Sight sight) {
  PlannedPass& pass = nodes_[node].pass;
  const View& view = pass.view;
  const int mirror = sight.draw.mirror;
  const std::optional<std::string> occluder = occlusion_->hiddenBy(mirror, sight.draw.polygon);
  if (sight.draw.back) {
    if (sight.height < 0.0 && !occluder) {
      pass.mirrors.push_back(std::move(sight.draw));
    }
    return skipBack(view, mirror, sight.height);
  }
  if (occluder) {
    return skip(view, mirror, SkipReason::hidden, "behind " + *occluder);
  }
  propose(node, std::move(sight));
}

// Adds a visible mirror to the draws, and makes it a candidate if it is worth a pass.
void Planner::propose(int node, Sight sight) {
  PlannedPass& pass = nodes_[node].pass;
  const View& view = pass.view;
  const int mirror = sight.draw.mirror;
  const Mirror& material = scene_.mirrors[mirror];
  const double area = screenArea(toClip(view, plan_.projection, sight.visible), plan_.width, plan_.height);
  const glm::dvec3 throughput =
      pass.channels * reflectanceBound(material, allSettings_.effects, sight.draw.plane, view.eye, sight.visible);
  const bool deep = static_cast<int>(view.path.size()) >= settings_.maxDepth;
  const bool reflects = !deep && largest(throughput) >= settings_.minThroughput;
  sight.draw.scatters = scatters(material, allSettings_.effects, reflects);
  sight.draw.blurs = reflects && !sight.draw.scatters && isRough(material, allSettings_.effects);
  sight.draw.ripples = reflects && !sight.draw.scatters && isRippled(material, allSettings_.effects);
  const bool needsPass = !sight.draw.scatters;
  pass.mirrors.push_back(std::move(sight.draw));
  if (deep) {
    return skip(view, mirror, SkipReason::maxDepth, "max_depth " + std::to_string(settings_.maxDepth));
  }
  if (needsPass && area < settings_.minPixels) {
    return skip(view, mirror, SkipReason::minPixels, number(area) + " px");
  }
  if (largest(throughput) < settings_.minThroughput) {
    return skip(view, mirror, SkipReason::minThroughput, number(largest(throughput)));
  }
  if (needsPass) {
    candidates_.push({area * largest(throughput), node, pass.mirrors.size() - 1, std::move(sight.visible), area,
                      throughput, discovered_++});
  }
}

void Planner::expand(const Candidate& candidate) {
  const View& parent = nodes_[candidate.parent].pass.view;
  const MirrorDraw& draw = nodes_[candidate.parent].pass.mirrors[candidate.draw];
  if (static_cast<int>(nodes_.size()) > settings_.maxPasses) {
    return skip(parent, draw.mirror, SkipReason::maxPasses, "max_passes " + std::to_string(settings_.maxPasses));
  }
  if (work_ > mostWork) {
    return skip(parent, draw.mirror, SkipReason::maxPasses, "too many to plan");
  }
  const glm::dvec2 picture = nodes_[0].pass.view.pictureSize * settings_.scale;
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
  Node node;
  node.pass.view = reflectedView(parent, draw.mirror, draw.plane, candidate.visible, rect, picture);
  const bool readsBeside = draw.blurs || draw.ripples;
  if (readsBeside) {
    boundByRectangle(node.pass.view, plan_.projection);
  }
  node.pass.depth = static_cast<int>(parent.path.size());
  node.pass.areaPx = candidate.areaPx * (picture.x / plan_.width) * (picture.y / plan_.height);
  node.pass.throughput = largest(candidate.throughput);
  node.pass.channels = candidate.throughput;
  node.draw = candidate.draw;
  // Beside its own pixels nothing can be reprojected.
  const int interval = readsBeside ? 1 : settings_.updateInterval;
  if (node.pass.depth == 0 && (interval > 1 || settings_.skipUnchanged)) {
    const ReuseRequest request{node.pass.view, plan_.projection, candidate.visible,
                               allSettings_,   interval,         candidate.order};
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

// Finds the environment and shadow maps, and the effects that they and all passes call for, of reused images too.
void Planner::findEffects() {
  std::vector<const PlannedPass*> passes;
  collect(0, passes);
  plan_.maps = environmentMaps(scene_, state_, allSettings_, passes);
  passes.pop_back();
  for (const EnvironmentMap& map : plan_.maps) {
    for (const PlannedPass& face : map.faces) {
      passes.push_back(&face);
    }
  }
  passes.push_back(&nodes_[0].pass);
  plan_.effects = tracedEffects(scene_, state_, allSettings_, passes);
  if (plan_.effects.shadowMaps) {
    findShadows();
  }
}

void Planner::findShadows() {
  std::vector<ShadowReader> readers;
  for (const Node& node : nodes_) {
    readers.push_back({&node.pass, readable(node.pass.view), &plan_.projection});
  }
  for (const EnvironmentMap& map : plan_.maps) {
    for (const PlannedPass& face : map.faces) {
      readers.push_back({&face, face.view, &map.projection});
    }
  }
  plan_.shadowMaps = shadowMaps(scene_, state_, allSettings_, readers);
}

// Chooses mesh levels. There are none where rays are traced: rays start on what is drawn and meet the full meshes,
// which would shadow their own levels; so would shadow maps. There are none without clipping either: what is drawn may
// then be nearer than the mirror, which the level's error is measured from.
void Planner::simplify() {
  if (settings_.clip == ClipMethod::none || plan_.effects.traces() || plan_.effects.shadowMaps) {
    return;
  }
  for (Node& node : nodes_) {
    const double texels = meshErrorIn(node.pass.view, allSettings_);
    if (texels > 0.0) {
      simplifyPass(node.pass, readable(node.pass.view), plan_.projection, texels, allSettings_.effects, scene_, state_);
    }
  }
}

ImageSurroundings Planner::surroundings() const {
  ImageSurroundings around{scene_, state_, allSettings_, plan_.projection, plan_.effects, {}};
  for (const ShadowMap& map : plan_.shadowMaps) {
    around.shadowSerial = std::max(around.shadowSerial, map.serial);
  }
  for (const EnvironmentMap& map : plan_.maps) {
    around.maps.emplace_back(map.instance, map.serial);
  }
  return around;
}

// Reuses the cached images that would come out the same if they were rendered.
void Planner::reuseUnchanged() {
  const View& main = nodes_[0].pass.view;
  reuseShadowMaps(plan_.shadowMaps, cache_.shadowMaps, allSettings_, state_);
  ImageSurroundings withoutMaps = surroundings();
  withoutMaps.maps.clear();
  reuseMaps(plan_.maps, cache_.maps, withoutMaps, main);
  if (!settings_.skipUnchanged) {
    return;
  }
  const ImageSurroundings around = surroundings();
  for (const int child : nodes_[0].children) {
    std::optional<ImageChoice>& choice = nodes_[child].choice;
    if (choice && choice->image.cacheIndex < 0) {
      std::vector<const PlannedPass*> passes;
      collect(child, passes);
      reuseIfUnchanged(choice->image, cache_.images, around, main, passes);
    }
  }
}

// Adds the passes of all that is seen in a node, then its own.
void Planner::collect(int node, std::vector<const PlannedPass*>& passes) const {
  for (const int child : nodes_[node].children) {
    collect(child, passes);
  }
  passes.push_back(&nodes_[node].pass);
}

// Records depth first, so that an image lives no longer than until its parent is drawn. Returns the pass's index, -1
// for the main view.
int Planner::record(int node) {
  std::vector<int> childPasses;
  for (const int child : nodes_[node].children) {
    Node& seen = nodes_[child];
    MirrorDraw& draw = nodes_[node].pass.mirrors[seen.draw];
    if (seen.choice && seen.choice->image.cacheIndex >= 0) {
      reuseImage(draw, seen);
      recordReused(child);
      continue;
    }
    std::optional<ImageChoice> choice = std::move(seen.choice);
    draw.pass = record(child);
    childPasses.push_back(draw.pass);
    if (choice) {
      choice->image.pass = draw.pass;
      plan_.cached.push_back(std::move(choice->image));
    }
  }
  const int index = node == 0 ? -1 : static_cast<int>(plan_.passes.size());
  for (const int pass : childPasses) {
    plan_.passes[pass].parent = index;
  }
  if (node == 0) {
    plan_.main = std::move(nodes_[0].pass);
  } else {
    plan_.passes.push_back(std::move(nodes_[node].pass));
  }
  return index;
}

// Lists the passes that a reused image replaces.
void Planner::recordReused(int node) {
  for (const int child : nodes_[node].children) {
    recordReused(child);
  }
  plan_.reused.push_back(std::move(nodes_[node].pass));
}

void Planner::reuseImage(MirrorDraw& draw, const Node& node) {
  const auto& [image, moved] = *node.choice;
  const View& parent = nodes_[0].pass.view;
  draw.cached = moved ? cachedLookup(image, parent, node.pass.view, plan_.projection) : CachedLookup{};
  draw.cached->image = static_cast<int>(plan_.cached.size());
  const int frames = image.unchangedFor + image.age - 1;
  skip(parent, image.mirror, SkipReason::unchanged,
       "image of " + (frames == 1 ? std::string("the last frame") : std::to_string(frames) + " frames ago") +
           (moved ? ", reprojected" : ""));
  plan_.cached.push_back(image);
}

// Drops the reasons of mirrors that are seen in reused images only.
void Planner::dropSkipsInReused() {
  std::vector<bool> reused(scene_.mirrors.size(), false);
  for (const CachedImage& image : plan_.cached) {
    reused[static_cast<size_t>(image.mirror)] = image.cacheIndex >= 0;
  }
  std::erase_if(plan_.skipped, [&](const SkippedMirror& skipped) {
    return skipped.depth > 0 && reused[static_cast<size_t>(skipped.path.front())];
  });
}

// Shows the complete mean again and draws nothing.
void Planner::reuseMean() {
  plan_.mainReused = true;
  plan_.reused = std::move(plan_.passes);
  plan_.passes.clear();
  plan_.maps.clear();
  plan_.shadowMaps.assign(cache_.shadowMaps.begin(), cache_.shadowMaps.end());
  for (ShadowMap& map : plan_.shadowMaps) {
    std::ranges::for_each(map.faces, [](ShadowFace& face) { face.rendered = false; });
  }
  for (MirrorDraw& draw : plan_.main.mirrors) {
    draw.pass = -1;
  }
}

}  // namespace

std::string_view skipReasonName(SkipReason reason) {
  static constexpr std::array<std::string_view, 9> names = {"behind",    "backface",   "outside",
                                                            "hidden",    "min_pixels", "min_throughput",
                                                            "max_depth", "max_passes", "unchanged"};
  return names[static_cast<size_t>(reason)];
}

const PlannedPass* mirrorPass(const FramePlan& plan, const std::vector<int>& path) {
  const auto pass = std::ranges::find_if(plan.passes, [&](const PlannedPass& p) { return p.view.path == path; });
  return pass == plan.passes.end() ? nullptr : &*pass;
}

FramePlan planFrame(const Scene& scene, const SceneState& state, const Settings& settings, int width, int height,
                    const FrameCache& cache, int picture) {
  return Planner(scene, state, settings, width, height, cache, picture).plan();
}

}  // namespace speculum
