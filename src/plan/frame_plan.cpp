#include "plan/frame_plan.hpp"

#include <algorithm>
#include <cmath>

#include "plan/cube_face.hpp"
#include "plan/image_reuse.hpp"
#include "plan/mirror_search.hpp"
#include "plan/mirror_sight.hpp"
#include "plan/shadow_map.hpp"

namespace speculum {

namespace {

class Planner {
 public:
  explicit Planner(const FrameRequest& request)
      : scene_(request.scene),
        state_(request.state),
        allSettings_(request.settings),
        settings_(request.settings.reflection),
        cache_(request.cache),
        shownOnly_(request.shownOnly) {
    const CameraPose& camera = state_.camera;
    plan_.width = request.size.x;
    plan_.height = request.size.y;
    plan_.picture = request.picture;
    plan_.projection = Projection(camera.verticalFov, static_cast<double>(plan_.width) / plan_.height, camera.near);
    plan_.projection.near = nearOf(state_, plan_.projection);
    const auto texels = [&](int pixels) {
      return std::max(1, static_cast<int>(std::lround(pixels * allSettings_.view.scale)));
    };
    size_ = {texels(plan_.width), texels(plan_.height)};
    if (plan_.picture < allSettings_.view.accumulate) {
      plan_.projection.offset = -2.0 * pictureOffset(plan_.picture, allSettings_) / glm::dvec2(size_);
      if (cache_.refined && plan_.picture == cache_.accumulated && cache_.refined->texels == size_) {
        plan_.refined = cache_.refined;
      }
    }
    changes_ = settings_.skipUnchanged ? cache_.changes : nullptr;
  }

  FramePlan plan() {
    plan_.passes.clear();
    nodes_ = findPasses(scene_, state_, allSettings_, cache_, size_, plan_);
    findEffects();
    addFaces();
    reuseUnchanged();
    addReused();
    add(0);
    dropSkipsInReused();
    if (meanIsComplete()) {
      std::ranges::for_each(plan_.passes, [](Pass& pass) { pass.source = PassSource::reused; });
      return std::move(plan_);
    }
    const bool stays = changes_ && !allSettings_.view.continuous && reuseMain(plan_, cache_.main, surroundings());
    plan_.encodes = shownOnly_ && !stays && canEncode();
    return std::move(plan_);
  }

 private:
  void findEffects();
  void findShadows();
  ImageSurroundings surroundings() const;
  void addFaces();
  void reuseUnchanged();
  void collect(int node, RecycledVector<const Pass*>& passes) const;
  void addReused();
  void addReused(int node);
  int add(int node);
  void append(int node, PassSource source);
  void reuseImage(MirrorDraw& draw, const MirrorNode& node);
  void dropSkipsInReused();
  bool canEncode() const {
    const DebugSettings& debug = allSettings_.debug;
    const bool drawsAny = !plan_.showsNothing() || scene_.environment.cleared(allSettings_.view.clearColor).sky;
    return mayEncode(allSettings_.view) && debug.encodeEarly && !debug.checkFinite && !plan_.effects.any() && drawsAny;
  }
  bool meanIsComplete() const {
    return allSettings_.view.accumulate > 1 && plan_.picture >= allSettings_.view.accumulate;
  }

  const Scene& scene_;
  const SceneState& state_;
  const Settings& allSettings_;
  const ReflectionSettings& settings_;
  const FrameCache& cache_;
  const bool shownOnly_;
  const SceneChanges* changes_ = nullptr;  // null without reflection.skip_unchanged
  FramePlan plan_;
  glm::ivec2 size_{0};  // texels of the main view
  RecycledVector<MirrorNode> nodes_;
  PlannedCubes shadowMaps_;
  PlannedCubes environmentMaps_;
};

// Finds the environment and shadow maps, and the effects that maps and passes call for. Passes of cached images count.
void Planner::findEffects() {
  RecycledVector<const Pass*> passes;
  collect(0, passes);
  EnvironmentMaps maps = environmentMaps(scene_, state_, allSettings_, passes);
  environmentMaps_ = std::move(maps);
  passes.pop_back();
  for (const Pass& face : environmentMaps_.faces) {
    passes.push_back(&face);
  }
  passes.push_back(&nodes_[0].pass);
  plan_.effects = tracedEffects(scene_, state_, allSettings_, passes);
  if (maps.omitted > 0) {
    plan_.effects.curved->append("; ")
        .append(std::to_string(environmentMaps_.cubes.size()))
        .append(" have environment maps, ")
        .append(std::to_string(maps.omitted))
        .append(" more show the background");
  }
  if (plan_.effects.shadowMaps) {
    findShadows();
  }
}

void Planner::findShadows() {
  RecycledVector<ShadowReader> readers;
  for (const MirrorNode& node : nodes_) {
    readers.push_back({&node.pass, readableView(node.pass, plan_.projection), &plan_.projection});
  }
  for (const Pass& face : environmentMaps_.faces) {
    readers.push_back({&face, face.view, &face.projection});
  }
  shadowMaps_ = shadowMaps(scene_, state_, allSettings_, readers);
}

ImageSurroundings Planner::surroundings() const {
  ImageSurroundings around{scene_, state_, allSettings_, plan_.projection, plan_.effects, changes_, {}};
  for (const Cube& cube : plan_.cubes) {
    if (cube.kind == PassKind::shadow) {
      around.shadowSerial = std::max(around.shadowSerial, cube.serial);
    } else {
      around.maps.emplace_back(cube.instance, cube.serial);
    }
  }
  return around;
}

// Adds the faces of maps to the plan. A complete mean needs none, but keeps the shadow maps of the frame before for the
// frames after it.
void Planner::addFaces() {
  const std::span<const Cube> shadows = cubesOf(cache_.cubes, PassKind::shadow);
  if (meanIsComplete()) {
    plan_.cubes.assign(shadows.begin(), shadows.end());
    return;
  }
  ImageSurroundings around = surroundings();
  around.changes = cache_.changes;
  addShadowMaps(plan_, std::move(shadowMaps_), shadows, around);
  addEnvironmentMaps(plan_, std::move(environmentMaps_), cubesOf(cache_.cubes, PassKind::environment), surroundings(),
                     nodes_[0].pass.view);
}

// Reuses the cached images that would be the same if they were rendered again.
void Planner::reuseUnchanged() {
  if (!changes_) {
    return;
  }
  const ImageSurroundings around = surroundings();
  for (const int child : nodes_[0].children) {
    std::optional<ImageChoice>& choice = nodes_[child].choice;
    if (choice && choice->image.cacheIndex < 0) {
      RecycledVector<const Pass*> passes;
      collect(child, passes);
      reuseIfUnchanged(choice->image, cache_.images, around, nodes_[0].pass.view, passes);
    }
  }
}

// Adds the passes of a node's descendants, then its own.
void Planner::collect(int node, RecycledVector<const Pass*>& passes) const {
  for (const int child : nodes_[node].children) {
    collect(child, passes);
  }
  passes.push_back(&nodes_[node].pass);
}

void Planner::append(int node, PassSource source) {
  Pass& pass = plan_.passes.emplace_back(std::move(nodes_[node].pass));
  pass.id = {.kind = node == 0 ? PassKind::main : PassKind::mirror, .path = pass.view.path};
  pass.source = source;
  pass.projection = plan_.projection;
}

// Adds the passes that cached images replace.
void Planner::addReused() {
  for (const int child : nodes_[0].children) {
    if (nodes_[child].choice && nodes_[child].choice->image.cacheIndex >= 0) {
      reuseImage(nodes_[0].pass.mirrors[nodes_[child].draw], nodes_[child]);
      addReused(child);
    }
  }
}

void Planner::addReused(int node) {
  for (const int child : nodes_[node].children) {
    addReused(child);
  }
  append(node, PassSource::reused);
}

// Adds the passes that are drawn for a node, depth first, so that an image is needed no longer than until its parent is
// drawn. Returns the index of the node's pass.
int Planner::add(int node) {
  for (const int child : nodes_[node].children) {
    MirrorDraw& draw = nodes_[node].pass.mirrors[nodes_[child].draw];
    if (draw.cached) {
      continue;
    }
    draw.pass = add(child);
    if (std::optional<ImageChoice>& choice = nodes_[child].choice) {
      choice->image.pass = draw.pass;
      plan_.cached.push_back(std::move(choice->image));
    }
  }
  append(node, PassSource::drawn);
  return static_cast<int>(plan_.passes.size()) - 1;
}

void Planner::reuseImage(MirrorDraw& draw, const MirrorNode& node) {
  const auto& [image, moved] = *node.choice;
  const View& parent = nodes_[0].pass.view;
  draw.cached = moved ? cachedLookup(image, parent, node.pass.view, plan_.projection) : CachedLookup{};
  draw.cached->image = static_cast<int>(plan_.cached.size());
  const int frames = image.unchangedFor + image.age - 1;
  RecycledString which = frames == 1 ? "image of the last frame" : "image of ";
  if (frames != 1) {
    which.append(std::to_string(frames)).append(" frames ago");
  }
  plan_.skipped.push_back(
      skippedMirror(parent, image.mirror, SkipReason::unchanged, which.append(moved ? ", reprojected" : "")));
  plan_.cached.push_back(image);
}

// Drops skipped mirrors that are seen only in cached images.
void Planner::dropSkipsInReused() {
  RecycledVector<bool> reused(scene_.mirrorCount(), false);
  for (const CachedImage& image : plan_.cached) {
    reused[image.mirror] = image.cacheIndex >= 0;
  }
  std::erase_if(plan_.skipped, [&](const SkippedMirror& skipped) {
    return depthOf(skipped.path) > 0 && reused[skipped.path.front()];
  });
}

}  // namespace

std::string_view skipReasonName(SkipReason reason) {
  static constexpr std::array<std::string_view, 10> names = {
      "behind",         "backface",  "outside",    "hidden",    "min_pixels",
      "min_throughput", "max_depth", "max_passes", "unchanged", "rays"};
  return names[static_cast<size_t>(reason)];
}

bool mayEncode(const ViewSettings& view) {
  return view.samples == 1 && view.scale == 1.0 && view.accumulate == 1;
}

std::span<const Pass> FramePlan::drawnMirrors() const {
  const auto isDrawn = [](const Pass& pass) { return pass.id.kind == PassKind::mirror && pass.drawn(); };
  const auto first = std::ranges::find_if(passes, isDrawn);
  return {first, std::find_if_not(first, passes.end(), isDrawn)};
}

std::span<const Pass> FramePlan::shownMirrors() const {
  if (!mainReused()) {
    return drawnMirrors();
  }
  const auto first = std::ranges::find(passes, PassKind::mirror, [](const Pass& pass) { return pass.id.kind; });
  return {std::min(first, passes.end() - 1), passes.end() - 1};
}

std::span<const Cube> cubesOf(std::span<const Cube> cubes, PassKind kind) {
  const auto first = std::ranges::find(cubes, kind, &Cube::kind);
  return {first, std::find_if(first, cubes.end(), [&](const Cube& cube) { return cube.kind != kind; })};
}

const Pass* mirrorPass(const FramePlan& plan, std::span<const int> path) {
  const std::span<const Pass> passes = plan.shownMirrors();
  const auto pass = std::ranges::find_if(passes, [&](const Pass& p) { return std::ranges::equal(p.view.path, path); });
  return pass == passes.end() ? nullptr : &*pass;
}

std::string passName(const Scene& scene, const FramePlan& plan, const Pass& pass) {
  if (pass.isFace()) {
    const Cube& cube = plan.cubes[static_cast<size_t>(pass.cube)];
    return (pass.id.kind == PassKind::shadow ? "shadow map of " : "environment of ") + std::string(cube.name) + " " +
           faceAxes()[static_cast<size_t>(pass.id.face)].name;
  }
  return pass.id.kind == PassKind::main ? "main view" : "mirror " + mirrorPathName(scene, pass.view.path);
}

FramePlan planFrame(const FrameRequest& request) {
  return Planner(request).plan();
}

}  // namespace speculum
