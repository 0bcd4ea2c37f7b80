#include "plan/partial_instances.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

// A draw call costs about as much as the vertices of 96 triangles, so shorter gaps are drawn.
constexpr uint32_t shortestGap = 3 * 96;  // indices
constexpr double leastSaved = 0.1;        // of the mesh's indices
constexpr double rounding = 1e-5;         // relative to the sizes involved; bound of float rounding on the GPU

// A plane in the space of Vertex::position. Points with dot(normal, p) + offset >= 0 are seen.
struct LocalPlane {
  glm::dvec3 normal{0.0};
  glm::dvec3 reach{0.0};  // absolute values of the normal
  double offset = 0.0;
};

// Returns the view's planes that cut the mesh's bounding box; planes with all of the box on their visible side are left
// out.
RecycledVector<LocalPlane> cuttingPlanes(const View& view, const InstanceState& instance,
                                         const glm::dvec3& halfExtent) {
  RecycledVector<LocalPlane> planes;
  planes.reserve(1 + view.cone.size());
  const auto add = [&](const glm::dvec3& normal, double distance) {
    const glm::dvec3 local = normal * instance.worldFromMesh.linear;
    const glm::dvec3 size = glm::abs(local);
    const double reach = glm::dot(size, halfExtent);
    if (distance < reach * (1.0 + rounding)) {
      planes.push_back({local, size, distance + rounding * reach});
    }
  };
  const glm::dvec3& center = instance.worldFromMesh.translation;
  if (view.clip) {
    add(view.clip->normal, view.clip->distance(center));
  }
  for (const glm::dvec3& normal : view.cone) {
    add(normal, glm::dot(normal, center - view.eye));
  }
  return planes;
}

// Returns how far the mesh's box reaches from its centre along a direction in world space, metres.
double reachOf(const InstanceState& instance, const glm::dvec3& halfExtent, const glm::dvec3& direction) {
  return glm::dot(glm::abs(direction * instance.worldFromMesh.linear), halfExtent);
}

bool visible(const MeshCluster& cluster, const RecycledVector<LocalPlane>& planes) {
  return std::ranges::all_of(planes, [&](const LocalPlane& plane) {
    return glm::dot(plane.normal, cluster.center) + glm::dot(plane.reach, cluster.halfExtent) + plane.offset >= 0.0;
  });
}

}  // namespace

const PartialInstance* partOf(const RecycledVector<PartialInstance>& partial, int instance) {
  const auto found = std::ranges::lower_bound(partial, instance, {}, &PartialInstance::instance);
  return found != partial.end() && found->instance == instance ? &*found : nullptr;
}

IndexRange allOf(const Mesh& mesh) {
  return {0, static_cast<uint32_t>(mesh.indices.size())};
}

uint32_t indexCount(std::span<const IndexRange> ranges) {
  uint32_t count = 0;
  for (const IndexRange& range : ranges) {
    count += range.count;
  }
  return count;
}

bool seesOnlyFronts(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent) {
  const Affine& worldFromMesh = instance.worldFromMesh;
  const glm::dmat3& edges = worldFromMesh.linear;
  if (view.clip && !(view.clip->distance(worldFromMesh.translation) >
                     (1.0 + rounding) * reachOf(instance, halfExtent, view.clip->normal))) {
    return false;
  }
  // Rounding moves vertices by a share of the box's whole size, which matters where the box is thin.
  const double moved = rounding * (halfExtent.x * glm::length(edges[0]) + halfExtent.y * glm::length(edges[1]) +
                                   halfExtent.z * glm::length(edges[2]));
  const glm::dvec3 toEye = view.eye - worldFromMesh.translation;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 normal = glm::cross(edges[(i + 1) % 3], edges[(i + 2) % 3]);  // of two sides of the box
    const double side = halfExtent[i] * std::abs(glm::dot(normal, edges[i]));
    if (std::abs(glm::dot(normal, toEye)) > side + moved * glm::length(normal)) {
      return true;
    }
  }
  return false;
}

bool boundsVisible(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent) {
  return sphereVisible(view, instance.center, instance.radius) && boxVisible(view, instance.worldFromMesh, halfExtent);
}

RecycledVector<IndexRange> visibleRanges(const View& view, const InstanceState& instance, const Mesh& mesh) {
  const IndexRange all = allOf(mesh);
  const RecycledVector<LocalPlane> planes = cuttingPlanes(view, instance, mesh.halfExtent);
  if (mesh.clusters.empty() || planes.empty()) {
    return {all};
  }
  RecycledVector<IndexRange> ranges;
  for (const MeshCluster& cluster : mesh.clusters) {
    if (!visible(cluster, planes)) {
      continue;
    }
    if (!ranges.empty() && cluster.firstIndex - (ranges.back().first + ranges.back().count) < shortestGap) {
      ranges.back().count = cluster.firstIndex + cluster.indexCount - ranges.back().first;
    } else {
      ranges.push_back({cluster.firstIndex, cluster.indexCount});
    }
  }
  if (indexCount(ranges) > (1.0 - leastSaved) * all.count) {
    ranges.assign(1, all);
  }
  return ranges;
}

}  // namespace speculum
