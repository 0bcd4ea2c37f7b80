#include "frame/occlusion.hpp"

#include <algorithm>
#include <cmath>

#include "frame/scene_names.hpp"
#include "optics/convex_mesh.hpp"

namespace speculum {

namespace {

// Parts of the size of what is drawn; floats give or take 1e-7 of it.
constexpr double roundingPart = 1e-5;
// Polygons that several occluders may cut what is not hidden into, and occluders that are tried together.
constexpr size_t mostPieces = 24;
constexpr size_t mostOccluders = 64;

bool sphereMeetsSegment(const glm::dvec3& center, double radius, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(center - a, along) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 off = center - (a + t * along);
  return glm::dot(off, off) <= radius * radius;
}

}  // namespace

Occlusion::Occlusion(const Scene& scene, const SceneState& state, const Settings& settings,
                     const Projection& projection)
    : scene_(scene), state_(state), settings_(settings), projection_(projection), bodies_(state.instances.size()) {
  for (const MirrorState& mirror : state.mirrors) {
    double size = 0.0;
    for (const glm::dvec3& p : mirror.polygon) {
      size = std::max(size, glm::length(p - mirror.polygon[0]));
    }
    mirrors_.push_back(occluder(mirror.polygon, size));
  }
}

FlatOccluder Occlusion::occluder(std::vector<glm::dvec3> polygon, double size) {
  FlatOccluder made{.plane = {polygon[0], glm::normalize(newellVector(polygon))}, .slack = roundingPart * size};
  for (const glm::dvec3& p : polygon) {
    made.slack = std::max(made.slack, 2.0 * std::abs(made.plane.distance(p)));
  }
  made.polygon = std::move(polygon);
  return made;
}

const Occlusion::Body& Occlusion::bodyOf(int instance) {
  std::optional<Body>& body = bodies_[static_cast<size_t>(instance)];
  if (!body) {
    body.emplace();
    const InstanceState& state = state_.instances[static_cast<size_t>(instance)];
    const Mesh& mesh = scene_.meshes[state.mesh];
    body->slack = (roundingPart + 2.0 * convexTolerance) * state.radius;
    for (const glm::dvec3& p : mesh.convexVertices) {
      body->convexVertices.push_back(state.worldFromMesh.point(p));
    }
    for (const std::vector<glm::dvec3>& face : mesh.faces) {
      std::vector<glm::dvec3> polygon;
      for (const glm::dvec3& p : face) {
        polygon.push_back(state.worldFromMesh.point(p));
      }
      if (std::isnormal(polygonArea(polygon))) {
        body->faces.push_back(occluder(std::move(polygon), state.radius));
      }
    }
  }
  return *body;
}

// What may hide a part of `polygon`, which is one of mirror `mirror`.
std::vector<Occlusion::Hider> Occlusion::hiders(const View& view, std::span<const int> instances, int mirror,
                                                std::span<const glm::dvec3> polygon) {
  std::vector<Hider> found;
  const auto add = [&](std::optional<OccludedRegion> region, bool isMirror, int index) {
    const auto holds = [&](const HalfSpace& half) {
      return std::any_of(polygon.begin(), polygon.end(),
                         [&](const glm::dvec3& p) { return half.at(p - view.eye) > 0.0; });
    };
    if (region && std::all_of(region->begin(), region->end(), holds)) {
      found.push_back({std::move(*region), isMirror, index});
    }
  };
  for (size_t i = 0; i < mirrors_.size(); ++i) {
    if (static_cast<int>(i) != mirror) {
      add(hiddenByFace(mirrors_[i], view, projection_), true, static_cast<int>(i));
    }
  }
  const glm::dvec3 center = vertexMean(polygon);
  double radius = 0.0;
  for (const glm::dvec3& p : polygon) {
    radius = std::max(radius, glm::length(p - center));
  }
  // The levels of a mesh keep its corners, but not the outline of what is round.
  const bool simplified = settings_.reflection.meshError > 0.0 && !view.path.empty();
  for (const int i : instances) {
    const InstanceState& instance = state_.instances[static_cast<size_t>(i)];
    const Mesh& mesh = scene_.meshes[instance.mesh];
    if ((mesh.faces.empty() && mesh.convexVertices.empty()) ||
        !sphereMeetsSegment(instance.center, instance.radius + radius, view.eye, center)) {
      continue;
    }
    const Body& body = bodyOf(i);
    if (!body.convexVertices.empty() && !simplified) {
      add(hiddenByBody(body.convexVertices, body.slack, mirrors_[static_cast<size_t>(mirror)], view, projection_),
          false, i);
    }
    for (const FlatOccluder& face : body.faces) {
      add(hiddenByFace(face, view, projection_), false, i);
    }
  }
  return found;
}

std::string Occlusion::nameOfHider(const Hider& hider) const {
  if (hider.isMirror) {
    return nameOf("mirror", scene_.mirrors[static_cast<size_t>(hider.index)].name, hider.index);
  }
  const int object = state_.instances[static_cast<size_t>(hider.index)].object;
  return nameOf("object", scene_.objects[static_cast<size_t>(object)].name, object);
}

std::optional<std::string> Occlusion::hiddenBy(const View& view, std::span<const int> instances, int mirror,
                                               std::span<const glm::dvec3> polygon) {
  // What an oblique depth buffer keeps in order is not known here.
  const bool oblique = settings_.reflection.clip == ClipMethod::oblique && view.clip;
  if (!settings_.debug.skipHidden || settings_.view.wireframe || oblique || polygon.empty()) {
    return std::nullopt;
  }
  const std::vector<Hider> found = hiders(view, instances, mirror, polygon);
  for (const Hider& hider : found) {
    if (outside(hider.region, view.eye, {{polygon.begin(), polygon.end()}}).empty()) {
      return nameOfHider(hider);
    }
  }
  return hiddenTogether(found, view, polygon);
}

// Whether no piece is left of the polygon when the regions of all are taken away one after the other.
std::optional<std::string> Occlusion::hiddenTogether(std::span<const Hider> hiders, const View& view,
                                                     std::span<const glm::dvec3> polygon) const {
  std::vector<std::vector<glm::dvec3>> pieces = {{polygon.begin(), polygon.end()}};
  std::vector<std::string> names;
  for (const Hider& hider : hiders.first(std::min(hiders.size(), mostOccluders))) {
    std::vector<std::vector<glm::dvec3>> left = outside(hider.region, view.eye, pieces);
    if (left == pieces || left.size() > mostPieces) {
      continue;
    }
    pieces = std::move(left);
    const std::string name = nameOfHider(hider);
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
    if (pieces.empty()) {
      std::string all = names[0];
      for (size_t i = 1; i < names.size(); ++i) {
        all += (i + 1 < names.size() ? ", " : " and ") + names[i];
      }
      return all;
    }
  }
  return std::nullopt;
}

}  // namespace speculum
