#include "frame/frame_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "frame/cube_face.hpp"
#include "frame/environment_map.hpp"
#include "frame/mesh_level.hpp"
#include "frame/mirror_search.hpp"
#include "frame/picture_offset.hpp"
#include "frame/shadow_map.hpp"

namespace speculum {

namespace {

class Planner {
 public:
  Planner(const Scene& scene, const SceneState& state, const Settings& settings, int width, int height,
          const FrameCache& cache, int picture)
      : scene_(scene), state_(state), allSettings_(settings), settings_(settings.reflection), cache_(cache) {
    plan_.projection = Projection(state.camera.verticalFov, static_cast<double>(width) / height, state.camera.near);
    plan_.projection.near = nearOf(state, plan_.projection);
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
    changes_ = settings_.skipUnchanged ? cache.changes : nullptr;
  }

  FramePlan plan() {
    nodes_ = findPasses(scene_, state_, allSettings_, cache_, size_, plan_);
    findEffects();
    simplify();
    reuseUnchanged();
    record(0);
    dropSkipsInReused();
    if (changes_ && !allSettings_.view.continuous) {
      reuseMain(plan_, cache_.main, surroundings());
    }
    if (allSettings_.view.accumulate > 1 && plan_.picture >= allSettings_.view.accumulate) {
      reuseMean();
    }
    return std::move(plan_);
  }

 private:
  void findEffects();
  void findShadows();
  ImageSurroundings surroundings() const;
  void simplify();
  void addMaps(RecycledVector<SimplifiedPass>& passes);
  RecycledVector<SimplifiedPass> facesToSimplify(EnvironmentMap& map) const;
  void reuseUnchanged();
  void collect(int node, RecycledVector<const PlannedPass*>& passes) const;
  int record(int node);
  void reuseImage(MirrorDraw& draw, const PassNode& node);
  void recordReused(int node);
  void dropSkipsInReused();
  void reuseMean();

  const Scene& scene_;
  const SceneState& state_;
  const Settings& allSettings_;
  const ReflectionSettings& settings_;
  const FrameCache& cache_;
  const SceneChanges* changes_ = nullptr;  // null without reflection.skip_unchanged
  FramePlan plan_;
  glm::ivec2 size_{0};  // texels of the main view
  RecycledVector<PassNode> nodes_;
};

// Finds the environment and shadow maps, and the effects that maps and passes call for. Passes of cached images count.
void Planner::findEffects() {
  RecycledVector<const PlannedPass*> passes;
  collect(0, passes);
  EnvironmentMaps maps = environmentMaps(scene_, state_, allSettings_, passes);
  plan_.maps = std::move(maps.maps);
  passes.pop_back();
  for (const EnvironmentMap& map : plan_.maps) {
    for (const PlannedPass& face : map.faces) {
      passes.push_back(&face);
    }
  }
  passes.push_back(&nodes_[0].pass);
  plan_.effects = tracedEffects(scene_, state_, allSettings_, passes);
  if (maps.omitted > 0) {
    plan_.effects.curved->append("; ")
        .append(std::to_string(plan_.maps.size()))
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
  for (const PassNode& node : nodes_) {
    readers.push_back({&node.pass, readableView(node.pass, plan_.projection), &plan_.projection});
  }
  for (const EnvironmentMap& map : plan_.maps) {
    for (const PlannedPass& face : map.faces) {
      readers.push_back({&face, face.view, &map.projection});
    }
  }
  plan_.shadowMaps = shadowMaps(scene_, state_, allSettings_, readers);
}

// Chooses mesh levels. Rays from objects rule them out: they start on what is drawn but meet full meshes, in whose
// shadow a level would stand. Drawing without a clip plane rules them out too: an object may then be nearer than the
// mirror, and a level's error is allowed for the mirror's distance.
void Planner::simplify() {
  const bool wanted = settings_.meshError > 0.0 || allSettings_.view.meshError > 0.0;
  if (!wanted || settings_.clip == ClipMethod::none || plan_.effects.tracesFromObjects()) {
    return;
  }
  RecycledVector<SimplifiedPass> passes;
  for (PassNode& node : nodes_) {
    passes.push_back({&node.pass, readableView(node.pass, plan_.projection), &plan_.projection,
                      meshErrorIn(node.pass.view, allSettings_)});
  }
  if (plan_.effects.shadowMaps) {
    addMaps(passes);
    simplifyAlike(passes, allSettings_, scene_, state_);
    return;
  }
  for (const SimplifiedPass& pass : passes) {
    if (pass.texels > 0.0) {
      simplifyPass(pass, allSettings_, scene_, state_);
    }
  }
  if (settings_.meshError > 0.0) {
    // An object that two faces show has one level in both, so that it has no step at their edge.
    for (EnvironmentMap& map : plan_.maps) {
      simplifyAlike(facesToSimplify(map), allSettings_, scene_, state_);
    }
  }
}

RecycledVector<SimplifiedPass> Planner::facesToSimplify(EnvironmentMap& map) const {
  RecycledVector<SimplifiedPass> faces;
  for (PlannedPass& face : map.faces) {
    faces.push_back({&face, face.view, &map.projection, settings_.meshError});
  }
  return faces;
}

// Adds the faces of environment maps and of the shadow maps that all of them look up.
void Planner::addMaps(RecycledVector<SimplifiedPass>& passes) {
  for (EnvironmentMap& map : plan_.maps) {
    std::ranges::copy(facesToSimplify(map), std::back_inserter(passes));
  }
  constexpr double softened = 2.0;  // texels that a lookup reads in each direction
  const double texels = allSettings_.view.meshError > 0.0 ? softened : 0.0;
  for (ShadowMap& map : plan_.shadowMaps) {
    for (ShadowFace& face : map.faces) {
      if (face.inReach) {
        passes.push_back({&face.pass, face.pass.view, &face.projection, texels, face.read});
      }
    }
  }
}

ImageSurroundings Planner::surroundings() const {
  ImageSurroundings around{scene_, state_, allSettings_, plan_.projection, plan_.effects, changes_, {}};
  for (const ShadowMap& map : plan_.shadowMaps) {
    around.shadowSerial = std::max(around.shadowSerial, map.serial);
  }
  for (const EnvironmentMap& map : plan_.maps) {
    around.maps.emplace_back(map.instance, map.serial);
  }
  return around;
}

// Reuses the cached images that would be the same if they were rendered again.
void Planner::reuseUnchanged() {
  const View& main = nodes_[0].pass.view;
  reuseShadowMaps(plan_.shadowMaps, cache_.shadowMaps, allSettings_, scene_, state_, cache_.changes);
  ImageSurroundings withoutMaps = surroundings();
  withoutMaps.maps.clear();
  reuseMaps(plan_.maps, cache_.maps, withoutMaps, main);
  if (!changes_) {
    return;
  }
  const ImageSurroundings around = surroundings();
  for (const int child : nodes_[0].children) {
    std::optional<ImageChoice>& choice = nodes_[child].choice;
    if (choice && choice->image.cacheIndex < 0) {
      RecycledVector<const PlannedPass*> passes;
      collect(child, passes);
      reuseIfUnchanged(choice->image, cache_.images, around, main, passes);
    }
  }
}

// Adds the passes of a node's descendants, then its own.
void Planner::collect(int node, RecycledVector<const PlannedPass*>& passes) const {
  for (const int child : nodes_[node].children) {
    collect(child, passes);
  }
  passes.push_back(&nodes_[node].pass);
}

// Adds a node's passes to the plan, depth first, so that an image is needed no longer than until its parent is drawn.
// Returns the index of the node's pass, -1 for the main view.
int Planner::record(int node) {
  RecycledVector<int> childPasses;
  for (const int child : nodes_[node].children) {
    PassNode& seen = nodes_[child];
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

// Lists the passes that a cached image replaces.
void Planner::recordReused(int node) {
  for (const int child : nodes_[node].children) {
    recordReused(child);
  }
  plan_.reused.push_back(std::move(nodes_[node].pass));
}

void Planner::reuseImage(MirrorDraw& draw, const PassNode& node) {
  const auto& [image, moved] = *node.choice;
  const View& parent = nodes_[0].pass.view;
  draw.cached = moved ? cachedLookup(image, parent, node.pass.view, plan_.projection) : CachedLookup{};
  draw.cached->image = static_cast<int>(plan_.cached.size());
  const int frames = image.unchangedFor + image.age - 1;
  RecycledString which = frames == 1 ? "image of the last frame" : "image of ";
  if (frames != 1) {
    which.append(std::to_string(frames)).append(" frames ago");
  }
  skipMirror(plan_, parent, image.mirror, SkipReason::unchanged, which.append(moved ? ", reprojected" : ""));
  plan_.cached.push_back(image);
}

// Drops skipped mirrors that are seen only in cached images.
void Planner::dropSkipsInReused() {
  RecycledVector<bool> reused(scene_.mirrors.size(), false);
  for (const CachedImage& image : plan_.cached) {
    reused[image.mirror] = image.cacheIndex >= 0;
  }
  std::erase_if(plan_.skipped,
                [&](const SkippedMirror& skipped) { return skipped.depth > 0 && reused[skipped.path.front()]; });
}

// Makes the plan show the complete mean again and draw nothing.
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
  static constexpr std::array<std::string_view, 10> names = {
      "behind",         "backface",  "outside",    "hidden",    "min_pixels",
      "min_throughput", "max_depth", "max_passes", "unchanged", "rays"};
  return names[static_cast<size_t>(reason)];
}

const PlannedPass* mirrorPass(const FramePlan& plan, std::span<const int> path) {
  const RecycledVector<PlannedPass>& passes = shownPasses(plan);
  const auto pass =
      std::ranges::find_if(passes, [&](const PlannedPass& p) { return std::ranges::equal(p.view.path, path); });
  return pass == passes.end() ? nullptr : &*pass;
}

FramePlan planFrame(const Scene& scene, const SceneState& state, const Settings& settings, int width, int height,
                    const FrameCache& cache, int picture) {
  return Planner(scene, state, settings, width, height, cache, picture).plan();
}

}  // namespace speculum
