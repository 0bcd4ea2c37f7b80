#include "frame/mesh_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace speculum {

namespace {

// Of the angle between the axis and the line of sight farthest from it.
double leastCosine(const View& view, const Projection& projection) {
  double square = 0.0;
  for (const int x : {view.rect.x, view.rect.x + view.rect.width}) {
    for (const int y : {view.rect.y, view.rect.y + view.rect.height}) {
      const glm::dvec2 device = glm::dvec2(x, y) * 2.0 / view.pictureSize - 1.0;
      const glm::dvec2 tangent = device * glm::dvec2(projection.aspect, 1.0) / projection.focal;
      square = std::max(square, glm::dot(tangent, tangent));
    }
  }
  return 1.0 / std::sqrt(1.0 + square);
}

// View depth of the nearest of the instance that is not cut away, metres.
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

double errorInTexels(const View& view, const Projection& projection, const InstanceState& instance, const Mesh& mesh,
                     double error) {
  const double shift = error * largestScale(instance.worldFromMesh.linear);
  const double cosine = leastCosine(view, projection);
  const double depth = nearestDepth(view, cosine, instance, mesh) - shift;
  if (!(depth > 0.0)) {
    return std::numeric_limits<double>::infinity();
  }
  const glm::dvec2 focal = 0.5 * view.pictureSize * projection.focal / glm::dvec2(projection.aspect, 1.0);
  return std::max(focal.x, focal.y) * shift / (depth * cosine);
}

LevelChoice chooseLevel(const View& view, const Projection& projection, double mostTexels,
                        const InstanceState& instance, const Mesh& mesh, std::vector<IndexRange> seen) {
  LevelChoice best{.ranges = std::move(seen)};
  const std::vector<MeshLevel>& levels = levelsOf(mesh).levels;
  for (size_t i = 0; i < levels.size(); ++i) {
    if (errorInTexels(view, projection, instance, mesh, levels[i].error) > mostTexels) {
      break;
    }
    std::vector<IndexRange> ranges = visibleRanges(view, instance, mesh.halfExtent, levels[i].all, levels[i].clusters);
    if (!ranges.empty() && indexCount(ranges) < indexCount(best.ranges)) {
      best = {static_cast<int>(i), std::move(ranges)};
    }
  }
  return best;
}

void simplifyPass(PlannedPass& pass, const View& readable, const Projection& projection, const Settings& settings,
                  const Scene& scene, const SceneState& state) {
  std::vector<PartialInstance> partial;
  for (const int i : pass.instances) {
    const InstanceState& instance = state.instances[static_cast<size_t>(i)];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const auto was = std::find_if(pass.partial.begin(), pass.partial.end(),
                                  [&](const PartialInstance& p) { return p.instance == i; });
    LevelChoice choice{.ranges = was != pass.partial.end() ? was->ranges : std::vector{allOf(mesh)}};
    const bool curved = settings.effects.curved && scene.objects[instance.object].mirror;
    if (!curved) {
      choice = chooseLevel(readable, projection, settings.reflection.meshError, instance, mesh, choice.ranges);
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

bool drawsLevels(const FramePlan& plan) {
  const auto draws = [](const PlannedPass& pass) { return !pass.simplified.empty(); };
  return std::any_of(plan.passes.begin(), plan.passes.end(), draws) ||
         std::any_of(plan.shown.begin(), plan.shown.end(), draws);
}

int levelOf(const PlannedPass& pass, int instance) {
  const auto found = std::lower_bound(pass.simplified.begin(), pass.simplified.end(), instance,
                                      [](const SimplifiedInstance& s, int wanted) { return s.instance < wanted; });
  return found != pass.simplified.end() && found->instance == instance ? found->level : -1;
}

}  // namespace speculum
