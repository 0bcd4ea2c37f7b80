#include "frame/mesh_level.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>
#include <set>
#include <utility>

namespace speculum {

namespace {

// Returns the cosine of the largest angle between the view's axis and a line of sight.
double leastCosine(const View& view, const Projection& projection) {
  double square = 0.0;
  for (const int x : {view.rect.x, view.rect.x + view.rect.width}) {
    for (const int y : {view.rect.y, view.rect.y + view.rect.height}) {
      const glm::dvec2 device = glm::dvec2(x, y) * 2.0 / view.pictureSize - 1.0 - projection.offset;
      const glm::dvec2 tangent = device * glm::dvec2(projection.aspect, 1.0) / projection.focal;
      square = std::max(square, glm::dot(tangent, tangent));
    }
  }
  return 1.0 / std::sqrt(1.0 + square);
}

// Returns a lower bound of the view depth, in metres, of the instance's points that the view may see.
double nearestDepth(const View& view, double cosine, const InstanceState& instance, const Mesh& mesh) {
  const glm::dmat3& linear = instance.worldFromMesh.linear;
  const glm::dmat3 axes(linear[0] * mesh.halfExtent.x, linear[1] * mesh.halfExtent.y, linear[2] * mesh.halfExtent.z);
  const glm::dvec3 center = instance.worldFromMesh.translation - view.eye;
  const auto leastAlong = [&](const glm::dvec3& direction) {
    const glm::dvec3 reach = glm::abs(direction * axes);
    return glm::dot(direction, center) - (reach.x + reach.y + reach.z);
  };
  const glm::dvec3 ahead = -glm::row(view.worldToView, 2);
  double depth = leastAlong(ahead);
  const bool isLarge = depth < 0.5 * glm::dot(ahead, center);
  if (isLarge) {  // of a smaller box the planes would raise the bound by less than a factor of 3
    // A point q of the visible cone has n.q >= 0 for each plane, so that its depth is no less than (ahead - w n).q for
    // any w > 0. The box's least of that is largest where one axis of the box has no share in it.
    const glm::dvec3 along = ahead * axes;
    for (const glm::dvec3& normal : view.cone) {
      const glm::dvec3 across = normal * axes;
      for (int i = 0; i < 3; ++i) {
        const double weight = across[i] == 0.0 ? 0.0 : along[i] / across[i];
        if (weight > 0.0 && std::isfinite(weight)) {
          depth = std::max(depth, leastAlong(ahead - weight * normal));
        }
      }
    }
  }
  return view.clip ? std::max(depth, -view.clip->distance(view.eye) * cosine) : depth;
}

}  // namespace

double largestError(const View& view, const Projection& projection, const InstanceState& instance, const Mesh& mesh,
                    double texels) {
  const double cosine = leastCosine(view, projection);
  const double depth = nearestDepth(view, cosine, instance, mesh);
  const glm::dvec2 focal = 0.5 * view.pictureSize * projection.focal / glm::dvec2(projection.aspect, 1.0);
  // f d / ((z - d) cos a) = texels, because the displacement may move the nearest point nearer by d.
  const double reach = texels * cosine;
  const double displacement = reach * std::max(depth, 0.0) / (std::max(focal.x, focal.y) + reach);
  const glm::dmat3& linear = instance.worldFromMesh.linear;
  return displacement / std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
}

LevelChoice chooseLevel(const View& view, double largestError, const InstanceState& instance, const Mesh& mesh,
                        RecycledVector<IndexRange> seen) {
  LevelChoice best{.ranges = std::move(seen)};
  if (largestError <= 0.0) {
    return best;  // levelsOf() would make levels that nothing uses
  }
  const std::vector<MeshLevel>& levels = levelsOf(mesh).levels;
  const auto end = std::ranges::upper_bound(levels, largestError, {}, &MeshLevel::error);
  // Coarsest first. Of the finer levels only the first one with clusters can have fewer triangles to draw.
  for (auto level = end; level != levels.begin();) {
    --level;
    const bool clustered = !level->clusters.empty();
    if (level + 1 == end || clustered) {
      RecycledVector<IndexRange> ranges = visibleRanges(view, instance, mesh.halfExtent, level->all, level->clusters);
      if (!ranges.empty() && indexCount(ranges) < indexCount(best.ranges)) {
        best = {static_cast<int>(level - levels.begin()), std::move(ranges)};
      }
    }
    if (clustered) {
      break;
    }
  }
  return best;
}

double meshErrorIn(const View& view, const Settings& settings) {
  return view.path.empty() ? settings.view.meshError : settings.reflection.meshError;
}

namespace {

// Chooses the coarsest level whose error is no more than `largestError`, whatever the view sees of it.
LevelChoice coarsestLevel(const View& view, double largestError, const InstanceState& instance, const Mesh& mesh,
                          RecycledVector<IndexRange> seen) {
  if (largestError <= 0.0) {
    return {.ranges = std::move(seen)};
  }
  const std::vector<MeshLevel>& levels = levelsOf(mesh).levels;
  const auto end = std::ranges::upper_bound(levels, largestError, {}, &MeshLevel::error);
  if (end == levels.begin()) {
    return {.ranges = std::move(seen)};
  }
  const MeshLevel& level = *(end - 1);
  RecycledVector<IndexRange> ranges = visibleRanges(view, instance, mesh.halfExtent, level.all, level.clusters);
  return {static_cast<int>(end - 1 - levels.begin()),
          ranges.empty() ? RecycledVector<IndexRange>{level.all} : std::move(ranges)};
}

// Draws each instance of the pass as choose(instance, ranges seen of the mesh) says. Without culling of clusters, whole
// levels are drawn, but the same ones.
template <typename Choose>
void applyLevels(const SimplifiedPass& simplified, const Settings& settings, const Scene& scene,
                 const SceneState& state, const Choose& choose) {
  const bool culls = settings.debug.cullClusters;
  Pass& pass = *simplified.pass;
  RecycledVector<PartialInstance> partial;
  for (const int i : pass.instances) {
    const Mesh& mesh = scene.meshes[state.instances[i].mesh];
    RecycledVector<IndexRange> seen = {allOf(mesh)};
    if (const PartialInstance* part = partOf(pass.partial, i)) {
      seen = part->ranges;
    } else if (!culls) {
      seen = visibleRanges(simplified.readable, state.instances[i], mesh);
    }
    LevelChoice choice = choose(i, std::move(seen));
    const IndexRange all = choice.level < 0 ? allOf(mesh) : levelsOf(mesh).levels[choice.level].all;
    if (culls && choice.ranges.front() != all) {
      partial.push_back({i, std::move(choice.ranges)});
    }
    if (choice.level >= 0) {
      pass.simplified.push_back({i, choice.level});
    }
  }
  pass.partial = std::move(partial);
}

// Returns the largest error that the pass allows for an instance, in the mesh's unit.
double errorOf(const SimplifiedPass& simplified, int i, const Settings& settings, const Scene& scene,
               const SceneState& state) {
  const InstanceState& instance = state.instances[i];
  if (settings.effects.curved && scene.objects[instance.object].mirror) {
    return 0.0;
  }
  return largestError(simplified.readable, *simplified.projection, instance, scene.meshes[instance.mesh],
                      simplified.texels);
}

}  // namespace

void simplifyPass(const SimplifiedPass& simplified, const Settings& settings, const Scene& scene,
                  const SceneState& state) {
  applyLevels(simplified, settings, scene, state, [&](int i, RecycledVector<IndexRange> seen) {
    const InstanceState& instance = state.instances[i];
    return chooseLevel(simplified.readable, errorOf(simplified, i, settings, scene, state), instance,
                       scene.meshes[instance.mesh], std::move(seen));
  });
}

void simplifyAlike(std::span<const SimplifiedPass> passes, const Settings& settings, const Scene& scene,
                   const SceneState& state) {
  const int instances = static_cast<int>(state.instances.size());
  RecycledVector<double> largest(state.instances.size(), std::numeric_limits<double>::infinity());
  for (const SimplifiedPass& simplified : passes) {
    // Not only what the pass draws: the level must not depend on the clusters that are left out.
    for (int i = 0; i < instances; ++i) {
      const InstanceState& instance = state.instances[i];
      if (largest[i] > 0.0 && boundsVisible(simplified.readable, instance, scene.meshes[instance.mesh].halfExtent)) {
        largest[i] = std::min(largest[i], errorOf(simplified, i, settings, scene, state));
      }
    }
  }
  for (const SimplifiedPass& simplified : passes) {
    if (!simplified.drawn) {
      continue;
    }
    applyLevels(simplified, settings, scene, state, [&](int i, RecycledVector<IndexRange> seen) {
      const InstanceState& instance = state.instances[i];
      return coarsestLevel(simplified.readable, largest[i], instance, scene.meshes[instance.mesh], std::move(seen));
    });
  }
}

std::vector<int> meshesWithLevels(const FramePlan& plan, const SceneState& state) {
  std::set<int> meshes;
  for (const Pass& pass : plan.passes) {
    for (const SimplifiedInstance& simplified : pass.simplified) {
      meshes.insert(state.instances[simplified.instance].mesh);
    }
  }
  return {meshes.begin(), meshes.end()};
}

int levelOf(const Pass& pass, int instance) {
  const auto found = std::ranges::lower_bound(pass.simplified, instance, {}, &SimplifiedInstance::instance);
  return found != pass.simplified.end() && found->instance == instance ? found->level : -1;
}

}  // namespace speculum
