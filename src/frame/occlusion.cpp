#include "frame/occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "frame/mesh_level.hpp"
#include "frame/scene_names.hpp"
#include "geometry/mesh_levels.hpp"

namespace speculum {

namespace {

// Rounding of what is drawn on the GPU, as a part of its size; floats are off by 1e-7 of it.
constexpr double roundingPart = 1e-5;
// Limits of the search for several occluders: pieces of the polygon that are not hidden yet, and occluders.
constexpr size_t mostPieces = 24;
constexpr size_t mostOccluders = 64;

bool sphereMeetsSegment(const glm::dvec3& center, double radius, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(center - a, along) / length2, 0.0, 1.0) : 0.0;
  const glm::dvec3 off = center - (a + t * along);
  return glm::dot(off, off) <= radius * radius;
}

double radiusAbout(const glm::dvec3& center, std::span<const glm::dvec3> points) {
  double radius = 0.0;
  for (const glm::dvec3& p : points) {
    radius = std::max(radius, glm::length(p - center));
  }
  return radius;
}

// Filters occluders: keeps those that look large enough and stand before a corner or the middle of a polygon, as an
// occluder of the whole polygon does.
class Prefilter {
 public:
  Prefilter(const glm::dvec3& eye, std::span<const glm::dvec3> polygon)
      : eye_(eye), center_(vertexMean(polygon)), polygon_(polygon) {
    constexpr double least = 0.4;  // of the polygon's own angle
    width_ = least * radiusAbout(center_, polygon) / glm::length(center_ - eye);
  }

  bool include(const glm::dvec3& center, double radius) const {
    if (!looksLarge(radius, glm::length(center - eye_) - radius)) {
      return false;
    }
    return sphereMeetsSegment(center, radius, eye_, center_) ||
           std::any_of(polygon_.begin(), polygon_.end(),
                       [&](const glm::dvec3& p) { return sphereMeetsSegment(center, radius, eye_, p); });
  }
  bool looksLarge(double radius, double nearest) const { return nearest <= 0.0 || radius >= width_ * nearest; }
  // Says whether a corner lies beyond a plane.
  bool reachesBeyond(const Plane& plane) const {
    const double side = plane.distance(eye_);
    return std::any_of(polygon_.begin(), polygon_.end(),
                       [&](const glm::dvec3& p) { return side * plane.distance(p) < 0.0; });
  }

 private:
  glm::dvec3 eye_;
  glm::dvec3 center_;
  std::span<const glm::dvec3> polygon_;
  double width_ = 0.0;
};

}  // namespace

Occlusion::Occlusion(const Scene& scene, const SceneState& state, const Settings& settings,
                     const Projection& projection)
    : scene_(scene), state_(state), settings_(settings), projection_(projection), bodies_(state.instances.size()) {
  for (const MirrorState& mirror : state.mirrors) {
    double size = 0.0;
    for (const glm::dvec3& p : mirror.polygon) {
      size = std::max(size, glm::length(p - mirror.polygon[0]));
    }
    mirrors_.push_back(flatOccluder(mirror.polygon, size));
  }
  for (const Mesh& mesh : scene.meshes) {
    double largest = 0.0;
    for (const std::vector<glm::dvec3>& face : mesh.faces) {
      largest = std::max(largest, radiusAbout(vertexMean(face), face));
    }
    largestFaces_.push_back(mesh.radius > 0.0 ? largest / mesh.radius : 0.0);
  }
}

FlatOccluder Occlusion::flatOccluder(std::vector<glm::dvec3> polygon, double size) {
  FlatOccluder made{.plane = {polygon[0], glm::normalize(newellVector(polygon))}, .slack = roundingPart * size};
  for (const glm::dvec3& p : polygon) {
    made.slack = std::max(made.slack, 2.0 * std::abs(made.plane.distance(p)));
  }
  made.center = vertexMean(polygon);
  made.radius = radiusAbout(made.center, polygon);
  made.polygon = std::move(polygon);
  return made;
}

BodyOccluder Occlusion::bodyOccluder(const ConvexMesh& mesh, const InstanceState& state) {
  BodyOccluder whole{.mesh = &mesh, .slack = roundingPart * state.radius};
  for (const glm::dvec3& p : mesh.points) {
    whole.points.push_back(state.worldFromMesh.point(p));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    whole.normals.push_back(newellVector(std::array{whole.points[a], whole.points[b], whole.points[c]}));
  }
  return whole;
}

const Occlusion::Body& Occlusion::bodyOf(int instance) {
  std::optional<Body>& body = bodies_[static_cast<size_t>(instance)];
  if (!body) {
    body.emplace();
    const InstanceState& state = state_.instances[static_cast<size_t>(instance)];
    const Mesh& mesh = scene_.meshes[state.mesh];
    if (!mesh.convex.triangles.empty()) {
      body->whole = bodyOccluder(mesh.convex, state);
    }
    for (const std::vector<glm::dvec3>& face : mesh.faces) {
      std::vector<glm::dvec3> polygon;
      for (const glm::dvec3& p : face) {
        polygon.push_back(state.worldFromMesh.point(p));
      }
      if (std::isnormal(polygonArea(polygon))) {
        body->faces.push_back(flatOccluder(std::move(polygon), state.radius));
      }
    }
  }
  return *body;
}

// Adds a region that holds a part of the polygon. Returns whether it holds all of it.
bool Occlusion::Occluders::add(std::optional<OccludedRegion> region, const Occluder& of, const glm::dvec3& eye,
                               std::span<const glm::dvec3> polygon) {
  if (!region) {
    return false;
  }
  bool all = true;
  for (const HalfSpace& half : *region) {
    const auto within =
        std::count_if(polygon.begin(), polygon.end(), [&](const glm::dvec3& p) { return half.at(p - eye) > 0.0; });
    if (within == 0) {
      return false;
    }
    all = all && within == std::ssize(polygon);
  }
  if (all) {
    whole = of;
  } else {
    parts.push_back(of);
    parts.back().region = std::move(*region);
  }
  return all;
}

// Finds the first occluder that hides all of `polygon`, a part of `mirror`, or else those that hide a part of it.
Occlusion::Occluders Occlusion::occludersOf(const View& view, std::span<const int> instances, int mirror,
                                            std::span<const glm::dvec3> polygon) {
  Occluders found;
  const Prefilter prefilter(view.eye, polygon);
  const auto addFace = [&](const FlatOccluder& face, const Occluder& of) {
    return prefilter.reachesBeyond(face.plane) &&
           found.add(hiddenByFace(face, view, projection_), of, view.eye, polygon);
  };
  for (size_t i = 0; i < mirrors_.size(); ++i) {
    // Mirrors are drawn only where the view shows them, not in the margin that is read around it.
    if (static_cast<int>(i) != mirror && prefilter.include(mirrors_[i].center, mirrors_[i].radius) &&
        !visiblePart(view, mirrors_[i].polygon).empty() &&
        addFace(mirrors_[i], {.isMirror = true, .index = static_cast<int>(i)})) {
      return found;
    }
  }
  const bool simplifies = meshErrorIn(view, settings_) > 0.0;
  for (const int i : instances) {
    const InstanceState& instance = state_.instances[static_cast<size_t>(i)];
    const Mesh& mesh = scene_.meshes[instance.mesh];
    const double nearest = glm::length(instance.center - view.eye) - instance.radius;
    const double widest = mesh.convex.points.empty() ? instance.radius * largestFaces_[instance.mesh] : instance.radius;
    // Levels of a mesh have other outlines.
    if ((simplifies && mayHaveLevels(mesh)) || !prefilter.looksLarge(widest, nearest) ||
        !prefilter.include(instance.center, instance.radius)) {
      continue;
    }
    const Body& body = bodyOf(i);
    if (body.whole.mesh && found.add(hiddenByBody(body.whole, mirrors_[static_cast<size_t>(mirror)], view, projection_),
                                     {.index = i}, view.eye, polygon)) {
      return found;
    }
    if (std::any_of(body.faces.begin(), body.faces.end(), [&](const FlatOccluder& face) {
          return prefilter.include(face.center, face.radius) && addFace(face, {.index = i});
        })) {
      return found;
    }
  }
  return found;
}

std::string Occlusion::nameOfOccluder(const Occluder& occluder) const {
  if (occluder.isMirror) {
    return nameOf("mirror", scene_.mirrors[static_cast<size_t>(occluder.index)].name, occluder.index);
  }
  const int object = state_.instances[static_cast<size_t>(occluder.index)].object;
  return nameOf("object", scene_.objects[static_cast<size_t>(object)].name, object);
}

std::optional<std::string> Occlusion::hiddenBy(const View& view, std::span<const int> instances, int mirror,
                                               std::span<const glm::dvec3> polygon) {
  // An oblique depth buffer may keep another order, so nothing is hidden.
  const bool oblique = settings_.reflection.clip == ClipMethod::oblique && view.clip;
  if (!settings_.debug.skipHidden || settings_.view.wireframe || oblique || polygon.empty()) {
    return std::nullopt;
  }
  const Occluders found = occludersOf(view, instances, mirror, polygon);
  return found.whole ? nameOfOccluder(*found.whole) : hiddenTogether(found.parts, view, polygon);
}

// Takes the regions away from the polygon one after the other, until no piece is left.
std::optional<std::string> Occlusion::hiddenTogether(std::span<const Occluder> occluders, const View& view,
                                                     std::span<const glm::dvec3> polygon) const {
  std::vector<std::vector<glm::dvec3>> pieces = {{polygon.begin(), polygon.end()}};
  std::vector<std::string> names;
  for (const Occluder& occluder : occluders.first(std::min(occluders.size(), mostOccluders))) {
    std::vector<std::vector<glm::dvec3>> left = outside(occluder.region, view.eye, pieces);
    if (left == pieces || left.size() > mostPieces) {
      continue;
    }
    pieces = std::move(left);
    const std::string name = nameOfOccluder(occluder);
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
