#include "frame/occlusion.hpp"

#include <algorithm>
#include <cmath>

#include "frame/scene_names.hpp"

namespace speculum {

namespace {

// Parts of the size of what is drawn; floats give or take 1e-7 of it.
constexpr double roundingPart = 1e-5;
// How much farther from the eye what is hidden has to be, as a part of its distance: the depth test must be sure.
constexpr double depthPart = 1e-4;
constexpr double marginPixels = 1.0;

bool sphereMeetsSegment(const glm::dvec3& center, double radius, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(center - a, along) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 off = center - (a + t * along);
  return glm::dot(off, off) <= radius * radius;
}

// Without vertices that clipping put on top of another.
std::vector<glm::dvec3> distinctVertices(const std::vector<glm::dvec3>& polygon, double least) {
  std::vector<glm::dvec3> kept;
  for (const glm::dvec3& p : polygon) {
    if (kept.empty() || glm::length(p - kept.back()) > least) {
      kept.push_back(p);
    }
  }
  while (kept.size() > 1 && glm::length(kept.front() - kept.back()) <= least) {
    kept.pop_back();
  }
  return kept;
}

}  // namespace

Occlusion::Occlusion(const Scene& scene, const SceneState& state, const Settings& settings,
                     const Projection& projection)
    : scene_(scene),
      state_(state),
      settings_(settings),
      projection_(projection),
      instanceFaces_(state.instances.size()) {
  for (const MirrorState& mirror : state.mirrors) {
    double size = 0.0;
    for (const glm::dvec3& p : mirror.polygon) {
      size = std::max(size, glm::length(p - mirror.polygon[0]));
    }
    mirrors_.push_back(occluder(mirror.polygon, size));
  }
}

Occlusion::Occluder Occlusion::occluder(std::vector<glm::dvec3> polygon, double size) {
  Occluder made{.plane = {polygon[0], glm::normalize(newellVector(polygon))}, .slack = roundingPart * size};
  for (const glm::dvec3& p : polygon) {
    made.slack = std::max(made.slack, 2.0 * std::abs(made.plane.distance(p)));
  }
  made.polygon = std::move(polygon);
  return made;
}

const std::vector<Occlusion::Occluder>& Occlusion::facesOf(int instance) {
  std::optional<std::vector<Occluder>>& faces = instanceFaces_[static_cast<size_t>(instance)];
  if (!faces) {
    faces.emplace();
    const InstanceState& state = state_.instances[static_cast<size_t>(instance)];
    for (const std::vector<glm::dvec3>& face : scene_.meshes[state.mesh].faces) {
      std::vector<glm::dvec3> polygon;
      for (const glm::dvec3& p : face) {
        polygon.push_back(state.worldFromMesh.point(p));
      }
      if (std::isnormal(polygonArea(polygon))) {
        faces->push_back(occluder(std::move(polygon), state.radius));
      }
    }
  }
  return *faces;
}

std::optional<std::string> Occlusion::hiddenBy(const View& view, std::span<const int> instances, int mirror,
                                               std::span<const glm::dvec3> polygon) {
  // What an oblique depth buffer keeps in order is not known here.
  const bool oblique = settings_.reflection.clip == ClipMethod::oblique && view.clip;
  if (!settings_.debug.skipHidden || settings_.view.wireframe || oblique || polygon.empty()) {
    return std::nullopt;
  }
  for (size_t i = 0; i < mirrors_.size(); ++i) {
    if (static_cast<int>(i) != mirror && covers(mirrors_[i], view, polygon)) {
      return nameOf("mirror", scene_.mirrors[i].name, static_cast<int>(i));
    }
  }
  for (const int i : instances) {
    const InstanceState& instance = state_.instances[static_cast<size_t>(i)];
    if (scene_.meshes[instance.mesh].faces.empty() ||
        !sphereMeetsSegment(instance.center, instance.radius, view.eye, polygon[0])) {
      continue;
    }
    const std::vector<Occluder>& faces = facesOf(i);
    if (std::any_of(faces.begin(), faces.end(), [&](const Occluder& face) { return covers(face, view, polygon); })) {
      return nameOf("object", scene_.objects[instance.object].name, instance.object);
    }
  }
  return std::nullopt;
}

// Along each line of sight, and nothing of it nearer than depth can tell.
bool Occlusion::isBehind(const Occluder& occluder, const View& view, std::span<const glm::dvec3> polygon) const {
  const double eye = occluder.plane.distance(view.eye);
  if (!(std::abs(eye) > occluder.slack)) {
    return false;
  }
  return std::all_of(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) {
    const double height = eye > 0.0 ? occluder.plane.distance(p) : -occluder.plane.distance(p);
    if (height >= -occluder.slack) {
      return false;
    }
    const double crossing = std::abs(eye) / (std::abs(eye) - height);  // of the plane, 1 at p
    const double nearest = -(view.worldToView * (p - view.eye)).z * crossing;
    return crossing < 1.0 - depthPart && nearest > (1.0 + depthPart) * projection_.near;
  });
}

bool Occlusion::covers(const Occluder& occluder, const View& view, std::span<const glm::dvec3> polygon) const {
  if (!isBehind(occluder, view, polygon)) {
    return false;
  }
  std::vector<glm::dvec3> drawn = occluder.polygon;
  if (view.clip) {
    drawn = clipPolygon(drawn, Plane{view.clip->point + occluder.slack * view.clip->normal, view.clip->normal});
  }
  drawn = distinctVertices(drawn, 0.01 * occluder.slack);
  if (drawn.size() < 3) {
    return false;
  }
  const double eye = std::abs(occluder.plane.distance(view.eye));
  const glm::dvec3 inside = vertexMean(drawn) - view.eye;
  const double pixel = 2.0 / (projection_.focal * view.pictureSize.y);  // at unit depth
  for (size_t i = 0; i < drawn.size(); ++i) {
    const glm::dvec3 a = drawn[i] - view.eye;
    const glm::dvec3 b = drawn[(i + 1) % drawn.size()] - view.eye;
    glm::dvec3 normal = glm::cross(a, b);
    const double length = glm::length(normal);
    if (!(length > 1e-9 * glm::length(a) * glm::length(b))) {
      return false;
    }
    normal *= (glm::dot(normal, inside) < 0.0 ? -1.0 : 1.0) / length;
    const bool within = std::all_of(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) {
      const double crossing = eye / (eye + std::abs(occluder.plane.distance(p)));
      const double depth = -(view.worldToView * (p - view.eye)).z;
      const double distance = glm::dot(normal, p - view.eye);
      return distance > marginPixels * pixel * depth && crossing * distance > occluder.slack;
    });
    if (!within) {
      return false;
    }
  }
  return true;
}

}  // namespace speculum
