#include "frame/mesh_level.hpp"

#include <algorithm>
#include <cmath>
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

// Returns the view depth in metres of the instance's nearest point that is not clipped away.
double nearestDepth(const View& view, double cosine, const InstanceState& instance, const Mesh& mesh) {
  const glm::dmat3 viewFromMesh = view.worldToView * instance.worldFromMesh.linear;
  const glm::dvec3 along(viewFromMesh[0].z, viewFromMesh[1].z, viewFromMesh[2].z);
  const double center = -(view.worldToView * (instance.worldFromMesh.translation - view.eye)).z;
  const double depth = center - glm::dot(glm::abs(along), mesh.halfExtent);
  return view.clip ? std::max(depth, -view.clip->distance(view.eye) * cosine) : depth;
}

double largestScale(const glm::dmat3& linear) {
  return std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
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
  return displacement / largestScale(instance.worldFromMesh.linear);
}

LevelChoice chooseLevel(const View& view, double largestError, const InstanceState& instance, const Mesh& mesh,
                        std::vector<IndexRange> seen) {
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
      std::vector<IndexRange> ranges = visibleRanges(view, instance, mesh.halfExtent, level->all, level->clusters);
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

void simplifyPass(PlannedPass& pass, const View& readable, const Projection& projection, double texels,
                  const EffectSettings& effects, const Scene& scene, const SceneState& state) {
  std::vector<PartialInstance> partial;
  for (const int i : pass.instances) {
    const InstanceState& instance = state.instances[static_cast<size_t>(i)];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const PartialInstance* part = partOf(pass.partial, i);
    LevelChoice choice{.ranges = part ? part->ranges : std::vector{allOf(mesh)}};
    const bool curved = effects.curved && scene.objects[instance.object].mirror;
    if (!curved) {
      const double largest = largestError(readable, projection, instance, mesh, texels);
      choice = chooseLevel(readable, largest, instance, mesh, std::move(choice.ranges));
    }
    const IndexRange all = choice.level < 0 ? allOf(mesh) : levelsOf(mesh).levels[choice.level].all;
    if (choice.ranges.front() != all) {
      partial.push_back({i, std::move(choice.ranges)});
    }
    if (choice.level >= 0) {
      pass.simplified.push_back({i, choice.level});
    }
  }
  pass.partial = std::move(partial);
}

std::vector<int> meshesWithLevels(const FramePlan& plan, const SceneState& state) {
  std::set<int> meshes;
  const auto add = [&](const PlannedPass& pass) {
    for (const SimplifiedInstance& simplified : pass.simplified) {
      meshes.insert(state.instances[static_cast<size_t>(simplified.instance)].mesh);
    }
  };
  add(plan.main);
  std::ranges::for_each(plan.passes, add);
  std::ranges::for_each(plan.reused, add);
  return {meshes.begin(), meshes.end()};
}

int levelOf(const PlannedPass& pass, int instance) {
  const auto found = std::ranges::lower_bound(pass.simplified, instance, {}, &SimplifiedInstance::instance);
  return found != pass.simplified.end() && found->instance == instance ? found->level : -1;
}

}  // namespace speculum
