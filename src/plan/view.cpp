#include "plan/view.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <tuple>

namespace speculum {

namespace {

// Angle at the eye below which an edge is taken to point at the eye and bounds nothing: rounding turns the plane
// through a shorter edge by more than 1e-7.
constexpr double shortestEdge = 1e-9;

// Returns the vector times a power of two, exactly, with its largest coordinate between 1 and 2: products of such
// vectors cannot underflow.
glm::dvec3 scaledToOne(const glm::dvec3& v) {
  constexpr uint64_t exponentBits = 0x7ffull << 52;
  const uint64_t exponent = std::bit_cast<uint64_t>(glm::compMax(glm::abs(v))) & exponentBits;
  // The exponents of a number and of its inverse add up to twice that of 1, so 0 and subnormal numbers have no inverse.
  constexpr uint64_t twice = 2ull * 0x3ff << 52;
  return exponent > 0 && exponent < twice ? v * std::bit_cast<double>(twice - exponent) : v;
}

// Returns the polygon cut by the clip plane alone.
Polygon clippedPart(const View& view, std::span<const glm::dvec3> polygon) {
  if (!view.clip) {
    return {polygon.begin(), polygon.end()};
  }
  // A mirror that ends at the plane of the mirror it would be seen in is not seen; rounding must not lift it off that
  // plane. It counts along the normal alone: vertices of large mirrors are far away along their plane. A vertex has the
  // rounding of the others too, because it may be a difference of larger numbers.
  glm::dvec3 reach(0.0);
  for (const glm::dvec3& p : polygon) {
    reach = glm::max(reach, glm::abs(p));
  }
  const double lift = 1e-15 * glm::dot(glm::abs(view.clip->normal), reach + glm::abs(view.clip->point));
  if (std::ranges::none_of(polygon, [&](const glm::dvec3& p) { return view.clip->distance(p) > lift; })) {
    return {};
  }
  return clipPolygon(polygon, *view.clip);
}

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

// Stays below the eye's distance from each mirror's plane, because a mirror's view sees what lies behind that plane,
// and below the distance of each object.
double nearOf(const SceneState& state, const Projection& projection) {
  const glm::dvec3& eye = state.camera.eye;
  // Depth is measured along the axis. In a corner of the picture, depth is this part of the distance.
  const double depthPart =
      1.0 / glm::length(glm::dvec3(projection.aspect / projection.focal, 1.0 / projection.focal, 1.0));
  double near = std::min(state.camera.near, Projection().near);
  for (const MirrorState& mirror : state.mirrors) {
    near = std::min(near, 0.5 * depthPart * std::abs(glm::dot(mirror.normal, eye - mirror.origin)));
  }
  for (const InstanceState& instance : state.instances) {
    const double outside = glm::length(eye - instance.center) - instance.radius;
    near = std::min(near, depthPart * std::max(0.5 * outside, 0.001 * instance.radius));
  }
  constexpr double smallest = 1e-20;  // depth has to stay a float
  return std::max(near, smallest);
}

View mainView(const CameraPose& camera, const Projection& projection, int width, int height) {
  View view;
  view.eye = camera.eye;
  view.worldToView = camera.worldToView;
  view.rect = {0, 0, width, height};
  view.pictureSize = glm::dvec2(width, height);
  boundByRectangle(view, projection);
  return view;
}

void boundByRectangle(View& view, const Projection& projection) {
  const double fx = projection.focal / projection.aspect;
  const double fy = projection.focal;
  const glm::dvec2 first(view.rect.x, view.rect.y);
  const glm::dvec2 last(view.rect.x + view.rect.width, view.rect.y + view.rect.height);
  const glm::dvec2 low = 2.0 * first / view.pictureSize - 1.0 - projection.offset;
  const glm::dvec2 high = 2.0 * last / view.pictureSize - 1.0 - projection.offset;
  const glm::dmat3 viewToWorld = glm::transpose(view.worldToView);
  view.cone.clear();
  // The planes are x - low.x w, high.x w - x, high.y w - y, y - low.y w >= 0 in clip space without offset, with w = -z
  // and y down.
  for (const glm::dvec3& n :
       {glm::dvec3(fx, 0, low.x), glm::dvec3(-fx, 0, -high.x), glm::dvec3(0, fy, -high.y), glm::dvec3(0, -fy, low.y)}) {
    view.cone.push_back(viewToWorld * glm::normalize(n));
  }
}

// In device coordinates without offset, a plane's line on the screen is nx / fx x - ny / fy y - nz = 0. A pixel
// outwards changes the constant by the gradient's length in pixels.
void widen(View& view, const Projection& projection, int pixels) {
  const glm::dvec2 step = 2.0 / view.pictureSize;
  for (glm::dvec3& normal : view.cone) {
    glm::dvec3 n = view.worldToView * normal;
    const glm::dvec2 gradient = step * glm::dvec2(n.x * projection.aspect / projection.focal, n.y / projection.focal);
    n.z -= pixels * glm::length(gradient);
    normal = glm::transpose(view.worldToView) * glm::normalize(n);
  }
  view.rect = {view.rect.x - pixels, view.rect.y - pixels, view.rect.width + 2 * pixels, view.rect.height + 2 * pixels};
}

glm::dvec2 overscan(const View& view) {
  const glm::dvec2 low(view.rect.x, view.rect.y);
  const glm::dvec2 high = low + glm::dvec2(view.rect.width, view.rect.height) - view.pictureSize;
  const glm::dvec2 beyond = glm::max(-low, high);
  return 1.0 + 2.0 * glm::max(beyond, 0.0) / view.pictureSize;
}

RecycledVector<glm::dvec3> coneThrough(const glm::dvec3& eye, std::span<const glm::dvec3> polygon) {
  glm::dvec3 inside(0.0);
  for (const glm::dvec3& p : polygon) {
    inside += p - eye;
  }
  RecycledVector<glm::dvec3> cone;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = scaledToOne(polygon[i] - eye);
    const glm::dvec3 b = scaledToOne(polygon[(i + 1) % polygon.size()] - eye);
    const glm::dvec3 n = glm::cross(a, b);
    const double length = glm::length(n);
    if (length <= shortestEdge * glm::length(a) * glm::length(b)) {
      continue;
    }
    cone.push_back(glm::dot(n, inside) < 0.0 ? n / -length : n / length);
  }
  return cone;
}

View reflectedView(const View& parent, int mirror, const Plane& plane, std::span<const glm::dvec3> visible,
                   const PixelRect& rect, const glm::dvec2& pictureSize) {
  View view;
  view.eye = reflectPoint(parent.eye, plane);
  view.worldToView = parent.worldToView * reflectionLinear(plane.normal);
  view.clip = plane;
  view.cone = coneThrough(view.eye, visible);
  view.rect = rect;
  view.pictureSize = pictureSize;
  view.path = parent.path;
  view.path.push_back(mirror);
  return view;
}

bool hullVisible(const View& view, std::span<const glm::dvec3> points) {
  const auto reaches = [&](const Plane& plane) {
    return std::ranges::any_of(points, [&](const glm::dvec3& p) { return plane.distance(p) >= 0.0; });
  };
  return (!view.clip || reaches(*view.clip)) && std::ranges::all_of(view.cone, [&](const glm::dvec3& normal) {
           return reaches({view.eye, normal});
         });
}

Polygon visiblePart(const View& view, std::span<const glm::dvec3> polygon) {
  // This test takes no memory, and most mirrors of a large scene lie beyond one of the planes.
  if (!hullVisible(view, polygon)) {
    return {};
  }
  Polygon part = clippedPart(view, polygon);
  for (const glm::dvec3& normal : view.cone) {
    if (part.size() < 3) {
      return {};
    }
    const Plane plane{view.eye, normal};
    if (!std::ranges::all_of(part, [&](const glm::dvec3& p) { return plane.distance(p) >= 0.0; })) {
      part = clipPolygon(part, plane);
    }
  }
  return part.size() < 3 ? Polygon() : part;
}

bool sphereVisible(const View& view, const glm::dvec3& center, double radius) {
  if (view.clip && view.clip->distance(center) < -radius) {
    return false;
  }
  return std::ranges::all_of(view.cone,
                             [&](const glm::dvec3& normal) { return glm::dot(normal, center - view.eye) >= -radius; });
}

bool boxVisible(const View& view, const Affine& worldFromBox, const glm::dvec3& halfExtent) {
  const auto reaches = [&](const glm::dvec3& normal, double distance) {
    const double reach = glm::dot(glm::abs(normal * worldFromBox.linear), halfExtent);
    if (distance >= -reach) {
      return true;
    }
    const glm::dvec3 axes(glm::length(worldFromBox.linear[0]), glm::length(worldFromBox.linear[1]),
                          glm::length(worldFromBox.linear[2]));
    const double rounding = 1e-5 * glm::dot(axes, halfExtent);  // bound of float rounding on the GPU
    return distance >= -(reach + rounding);
  };
  const glm::dvec3 fromEye = worldFromBox.translation - view.eye;
  return (!view.clip || reaches(view.clip->normal, view.clip->distance(worldFromBox.translation))) &&
         std::ranges::all_of(view.cone,
                             [&](const glm::dvec3& normal) { return reaches(normal, glm::dot(normal, fromEye)); });
}

bool boxVisible(const View& view, const Bounds& box) {
  const glm::dvec3 center = box.center();
  const glm::dvec3 half = box.high - center;
  const glm::dvec3 farthest = glm::abs(center) + half;
  const auto reaches = [&](const glm::dvec3& normal, const glm::dvec3& fromPoint, double rounding) {
    return glm::dot(normal, fromPoint) + glm::dot(glm::abs(normal), half) >= -rounding;
  };
  const auto roundingFrom = [&](const glm::dvec3& point) { return 1e-12 * glm::compAdd(farthest + glm::abs(point)); };
  const glm::dvec3 fromEye = center - view.eye;
  const double rounding = roundingFrom(view.eye);
  return (!view.clip || reaches(view.clip->normal, center - view.clip->point, roundingFrom(view.clip->point))) &&
         std::ranges::all_of(view.cone, [&](const glm::dvec3& normal) { return reaches(normal, fromEye, rounding); });
}

RecycledVector<glm::dvec4> toClip(const View& view, const Projection& projection, std::span<const glm::dvec3> polygon) {
  RecycledVector<glm::dvec4> clip;
  clip.reserve(polygon.size());
  for (const glm::dvec3& p : polygon) {
    clip.push_back(projection.clip(view.worldToView * (p - view.eye)));
  }
  return clip;
}

std::vector<int> frontToBack(const View& view, std::span<const int> instances, const SceneState& state) {
  struct Entry {
    double batch = 0.0;
    int mesh = 0;
    double distance = 0.0;
    int instance = 0;
    auto key() const { return std::tie(batch, mesh, distance, instance); }
  };
  RecycledVector<double> nearest;  // by mesh: distance of its nearest instance, metres
  std::vector<Entry> entries;
  entries.reserve(instances.size());
  for (const int i : instances) {
    const InstanceState& instance = state.instances[i];
    // To the far end of the bounding sphere, in metres. A room begins nearer to the eye than the objects in the room
    // but ends behind them, so the room is drawn after them.
    const double distance = glm::length(instance.center - view.eye) + instance.radius;
    nearest.resize(std::max<size_t>(nearest.size(), instance.mesh + 1), INFINITY);
    nearest[instance.mesh] = std::min(nearest[instance.mesh], distance);
    entries.push_back({.mesh = instance.mesh, .distance = distance, .instance = i});
  }
  for (Entry& entry : entries) {
    entry.batch = nearest[entry.mesh];
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) { return a.key() < b.key(); });
  std::vector<int> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries) {
    order.push_back(entry.instance);
  }
  return order;
}

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
