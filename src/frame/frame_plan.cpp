#include "frame/frame_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <sstream>

#include "frame/environment_map.hpp"
#include "frame/image_reuse.hpp"
#include "frame/mesh_level.hpp"
#include "frame/mirror_sight.hpp"
#include "frame/occlusion.hpp"
#include "frame/pass_mask.hpp"

namespace speculum {

namespace {

constexpr double largestNear = 0.001;  // metres

// A pass before its place in the order of recording is known.
struct Node {
  PlannedPass pass;
  std::vector<int> children;      // nodes
  std::optional<HeldImage> held;  // its image, if it is to be held; rendered by the pass if `earlier` is -1
  bool moved = false;             // since the earlier image
};

// A mirror that deserves a pass, if the budget reaches it.
struct Candidate {
  double priority = 0.0;
  int parent = 0;   // node
  size_t draw = 0;  // index into the parent's mirrors
  std::vector<glm::dvec3> visible;
  double areaPx = 0.0;
  glm::dvec3 throughput{1.0};
  int order = 0;  // of discovery; settles ties so that plans are reproducible

  bool operator<(const Candidate& other) const {
    return priority != other.priority ? priority < other.priority : order > other.order;
  }
};

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
          const EarlierImages& earlier)
      : scene_(scene), state_(state), allSettings_(settings), settings_(settings.reflection), earlier_(earlier) {
    // Everything in front of `near` is clamped to one depth and would lose its order; a larger one gains nothing,
    // because depth is near / distance in a float.
    const double near = std::min(state.camera.near, largestNear);
    plan_.projection = Projection(state.camera.verticalFov, static_cast<double>(width) / height, near);
    plan_.width = width;
    plan_.height = height;
    occlusion_.emplace(scene, state, settings, plan_.projection);
  }

  FramePlan plan() {
    Node& root = nodes_.emplace_back();
    root.pass.view = mainView(state_.camera, plan_.projection, plan_.width, plan_.height);
    root.pass.areaPx = root.pass.view.rect.area();
    fill(0);
    while (!candidates_.empty()) {
      const Candidate best = candidates_.top();
      candidates_.pop();
      expand(best);
    }
    findEffects();
    simplify();
    keepUnchanged();
    record(0);
    forgetHeldSubtrees();
    if (settings_.skipUnchanged && !allSettings_.view.continuous) {
      keepMain(plan_, earlier_.main, surroundings());
    }
    return std::move(plan_);
  }

 private:
  void fill(int node);
  void addInstance(PlannedPass& pass, const View& readable, int i);
  void consider(int node, int mirror, const View& readable);
  void propose(int node, Sight sight);
  void skip(const View& view, int mirror, SkipReason reason, std::string detail = {});
  void expand(const Candidate& candidate);
  void hold(Node& node, const Candidate& candidate, int interval) const;
  View readable(const View& view) const;
  void findEffects();
  ImageSurroundings surroundings() const;
  void simplify();
  void keepUnchanged();
  void collect(int node, std::vector<const PlannedPass*>& passes) const;
  int record(int node);
  void showHeld(MirrorDraw& draw, const Node& node);
  void leaveOut(int node);
  void forgetHeldSubtrees();
  bool behindEye(const View& view, std::span<const glm::dvec3> polygon) const;

  const Scene& scene_;
  const SceneState& state_;
  const Settings& allSettings_;
  const ReflectionSettings& settings_;
  const EarlierImages& earlier_;
  FramePlan plan_;
  std::vector<Node> nodes_;
  std::priority_queue<Candidate> candidates_;
  std::optional<Occlusion> occlusion_;
  int discovered_ = 0;
};

void Planner::addInstance(PlannedPass& pass, const View& readable, int i) {
  const InstanceState& instance = state_.instances[static_cast<size_t>(i)];
  const Mesh& mesh = scene_.meshes[instance.mesh];
  const std::vector<IndexRange> ranges =
      allSettings_.debug.cullClusters ? visibleRanges(readable, instance, mesh) : std::vector<IndexRange>{allOf(mesh)};
  if (ranges.empty()) {
    return;
  }
  pass.instances.push_back(i);
  if (ranges.front() != allOf(mesh)) {
    pass.partial.push_back({i, ranges});
  }
}

// A mirror image is read a little beyond the edge of what is seen of it. As far as a held one in any case, so that what
// is drawn, and in which order, is the same with every update interval.
View Planner::readable(const View& view) const {
  View readable = view;
  if (!view.path.empty()) {
    Settings held = allSettings_;
    held.reflection.updateInterval = std::max(held.reflection.updateInterval, 2);
    widen(readable, plan_.projection, static_cast<int>(std::ceil(1.5 * lookupReach(held, false))) + 1);
  }
  return readable;
}

// What is drawn in a node's view, and which of its mirrors are candidates for passes.
void Planner::fill(int node) {
  const View view = nodes_[node].pass.view;
  const View readable = this->readable(view);
  for (size_t i = 0; i < state_.instances.size(); ++i) {
    const InstanceState& instance = state_.instances[i];
    if (sphereVisible(readable, instance.center, instance.radius) &&
        boxVisible(readable, instance.worldFromMesh, scene_.meshes[instance.mesh].halfExtent)) {
      addInstance(nodes_[node].pass, readable, static_cast<int>(i));
    }
  }
  for (size_t i = 0; i < scene_.lights.size(); ++i) {
    const PointLight& light = scene_.lights[i];
    if (hasGlyph(light, allSettings_.effects) && sphereVisible(readable, state_.lights[i].position, light.radius)) {
      nodes_[node].pass.lights.push_back(static_cast<int>(i));
    }
  }
  for (size_t i = 0; i < scene_.mirrors.size(); ++i) {
    const bool last = !view.path.empty() && view.path.back() == static_cast<int>(i);
    if (!last) {
      consider(node, static_cast<int>(i), readable);
    }
  }
}

bool Planner::behindEye(const View& view, std::span<const glm::dvec3> polygon) const {
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const glm::dvec3& p) { return (view.worldToView * (p - view.eye)).z >= 0.0; });
}

void Planner::skip(const View& view, int mirror, SkipReason reason, std::string detail) {
  SkippedMirror skipped{mirror, view.path, static_cast<int>(view.path.size()), reason, std::move(detail)};
  skipped.path.push_back(mirror);
  plan_.skipped.push_back(std::move(skipped));
}

void Planner::consider(int node, int mirror, const View& readable) {
  PlannedPass& pass = nodes_[node].pass;
  const View& view = pass.view;
  const std::vector<glm::dvec3>& polygon = state_.mirrors[mirror].polygon;
  if (behindEye(view, polygon)) {
    return skip(view, mirror, SkipReason::behind);
  }
  Sight sight = sightOf(scene_, state_, view, mirror);
  const std::optional<std::string> occluder =
      sight.visible.empty() ? std::nullopt
                            : occlusion_->hiddenBy(view, pass.instances, mirror, visiblePart(readable, polygon));
  if (sight.draw.back) {
    if (!sight.visible.empty() && sight.height < 0.0 && !occluder) {
      pass.mirrors.push_back(std::move(sight.draw));
    }
    return skip(view, mirror, SkipReason::backface, sight.height == 0.0 ? "the eye is in its plane" : "");
  }
  if (sight.visible.empty()) {
    return skip(view, mirror, SkipReason::outside);
  }
  if (occluder) {
    return skip(view, mirror, SkipReason::hidden, "behind " + *occluder);
  }
  propose(node, std::move(sight));
}

// Draws a mirror that is seen, and makes it a candidate unless it is not worth a pass.
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
  const glm::dvec2 picture = glm::dvec2(plan_.width, plan_.height) * settings_.scale;
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
  node.pass.depth = static_cast<int>(parent.path.size());
  node.pass.areaPx = candidate.areaPx;
  node.pass.throughput = largest(candidate.throughput);
  node.pass.channels = candidate.throughput;
  node.pass.parent = static_cast<int>(candidate.draw);  // until record() knows the order
  // What is looked up beside a rough mirror's own pixels cannot be reprojected.
  const int interval = draw.blurs ? 1 : settings_.updateInterval;
  if (node.pass.depth == 0 && (interval > 1 || settings_.skipUnchanged)) {
    hold(node, candidate, interval);
  }
  const int index = static_cast<int>(nodes_.size());
  nodes_[candidate.parent].children.push_back(index);
  nodes_.push_back(std::move(node));
  fill(index);
}

void Planner::hold(Node& node, const Candidate& candidate, int interval) const {
  HeldChoice choice = chooseHeld(
      earlier_.held, {node.pass.view, plan_.projection, candidate.visible, allSettings_, interval, candidate.order});
  if (choice.image.earlier < 0) {
    node.pass.view = choice.image.view;
  }
  node.moved = choice.moved;
  node.held = std::move(choice.image);
}

// Environment maps, and what they and all passes call for: what earlier frames rendered shows the same effects.
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
}

// Rays start on the surfaces that are drawn and meet the meshes themselves, which would shadow their simplified selves.
// Without clipping, what is drawn may be nearer than the mirror.
void Planner::simplify() {
  if (settings_.meshError <= 0.0 || settings_.clip == ClipMethod::none || plan_.effects.traces()) {
    return;
  }
  for (size_t i = 1; i < nodes_.size(); ++i) {
    PlannedPass& pass = nodes_[i].pass;
    simplifyPass(pass, readable(pass.view), plan_.projection, allSettings_, scene_, state_);
  }
}

ImageSurroundings Planner::surroundings() const {
  ImageSurroundings around{scene_, state_, allSettings_, plan_.projection, plan_.effects, {}};
  for (const EnvironmentMap& map : plan_.maps) {
    around.maps.emplace_back(map.instance, map.serial);
  }
  return around;
}

// Of the images that would be rendered, those that would be what they were are not.
void Planner::keepUnchanged() {
  const View& main = nodes_[0].pass.view;
  keepMaps(plan_.maps, earlier_.maps, {scene_, state_, allSettings_, plan_.projection, plan_.effects, {}}, main);
  if (!settings_.skipUnchanged) {
    return;
  }
  const ImageSurroundings around = surroundings();
  for (const int child : nodes_[0].children) {
    std::optional<HeldImage>& held = nodes_[child].held;
    if (held && held->earlier < 0) {
      std::vector<const PlannedPass*> passes;
      collect(child, passes);
      keepIfUnchanged(*held, earlier_.held, around, main, passes);
    }
  }
}

// The pass of a node and those of all that is seen in it.
void Planner::collect(int node, std::vector<const PlannedPass*>& passes) const {
  for (const int child : nodes_[node].children) {
    collect(child, passes);
  }
  passes.push_back(&nodes_[node].pass);
}

// Depth first, so that an image lives no longer than until its parent is drawn. Returns the pass's index, -1 for main.
int Planner::record(int node) {
  std::vector<int> childPasses;
  for (const int child : nodes_[node].children) {
    MirrorDraw& draw = nodes_[node].pass.mirrors[static_cast<size_t>(nodes_[child].pass.parent)];
    if (nodes_[child].held && nodes_[child].held->earlier >= 0) {
      showHeld(draw, nodes_[child]);
      leaveOut(child);
      continue;
    }
    std::optional<HeldImage> held = std::move(nodes_[child].held);
    draw.pass = record(child);
    childPasses.push_back(draw.pass);
    if (held) {
      held->pass = draw.pass;
      plan_.held.push_back(std::move(*held));
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

void Planner::leaveOut(int node) {
  for (const int child : nodes_[node].children) {
    leaveOut(child);
  }
  plan_.shown.push_back(std::move(nodes_[node].pass));
}

void Planner::showHeld(MirrorDraw& draw, const Node& node) {
  const HeldImage& image = *node.held;
  const View& parent = nodes_[0].pass.view;
  draw.held = node.moved ? heldLookup(image, parent, node.pass.view, plan_.projection) : HeldLookup{};
  draw.held->image = static_cast<int>(plan_.held.size());
  const int frames = image.kept + image.age - 1;
  skip(parent, image.mirror, SkipReason::unchanged,
       "image of " + (frames == 1 ? std::string("the last frame") : std::to_string(frames) + " frames ago") +
           (node.moved ? ", reprojected" : ""));
  plan_.held.push_back(image);
}

// What is seen in a held image is not looked at.
void Planner::forgetHeldSubtrees() {
  std::erase_if(plan_.skipped, [&](const SkippedMirror& skipped) {
    return skipped.depth > 0 && std::any_of(plan_.held.begin(), plan_.held.end(), [&](const HeldImage& image) {
             return image.earlier >= 0 && image.mirror == skipped.path.front();
           });
  });
}

}  // namespace

std::string_view skipReasonName(SkipReason reason) {
  static constexpr std::array<std::string_view, 9> names = {"behind",    "backface",   "outside",
                                                            "hidden",    "min_pixels", "min_throughput",
                                                            "max_depth", "max_passes", "unchanged"};
  return names[static_cast<size_t>(reason)];
}

FramePlan planFrame(const Scene& scene, const SceneState& state, const Settings& settings, int width, int height,
                    const EarlierImages& earlier) {
  return Planner(scene, state, settings, width, height, earlier).plan();
}

}  // namespace speculum
