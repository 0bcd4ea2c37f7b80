#include "plan/occlusion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/polygon.hpp"

namespace speculum {

namespace {

// Bound of rounding on the GPU, as a part of the size of what is drawn; floats are off by 1e-7 of that size.
constexpr double roundingPart = 1e-5;
// Factor for bounds of a face, to make up for rounding.
constexpr double roomForRounding = 1.0 + 1e-6;
// Largest number of mirrors, and of instances, that are tested in a view. Testing all against each other takes time in
// the square of their number, and occluders that look small hide little.
constexpr size_t mostTested = 512;
// Number of mirrors in a view up to which all are tested, because looking at the hierarchy takes longer.
constexpr size_t fewMirrors = 32;
// Limits of the search for several occluders: pieces of the polygon that are not hidden yet, and occluders.
constexpr size_t mostPieces = 24;
constexpr size_t mostOccluders = 64;

// `area` is the polygon's newellVector().
FlatOccluder flatOccluder(std::span<const glm::dvec3> polygon, const glm::dvec3& area, double size) {
  FlatOccluder made{.plane = {polygon[0], glm::normalize(area)}, .slack = roundingPart * size};
  for (const glm::dvec3& p : polygon) {
    made.slack = std::max(made.slack, 2.0 * std::abs(made.plane.distance(p)));
  }
  made.center = vertexMean(polygon);
  made.radius = farthestDistance(made.center, polygon);
  made.polygon = distinctVertices(polygon, 0.01 * made.slack);
  return made;
}

BodyOccluder bodyOccluder(const ConvexMesh& mesh, const InstanceState& state) {
  BodyOccluder whole{.mesh = &mesh, .slack = roundingPart * state.radius};
  for (const glm::dvec3& p : mesh.points) {
    whole.points.push_back(state.worldFromMesh.point(p));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    whole.normals.push_back(newellVector(std::array{whole.points[a], whole.points[b], whole.points[c]}));
  }
  return whole;
}

}  // namespace

// Filters occluders of a target, the polygon or one of its points, at little cost. Keeps those that look large enough
// to matter for the polygon, unless they lie wholly behind its plane or outside the cone from the eye through the
// target.
class Occlusion::Prefilter {
 public:
  // `plane` is the plane of the polygon.
  Prefilter(const glm::dvec3& eye, std::span<const glm::dvec3> polygon, const Plane& plane) {
    constexpr double least = 0.4;  // smallest apparent size of an occluder, as a part of the polygon's
    const glm::dvec3 center = vertexMean(polygon);
    leastRadius_ = least * farthestDistance(center, polygon);
    distance_ = glm::length(center - eye);
    before_.eye = eye;
    before_.clip = {plane.point, plane.distance(eye) < 0.0 ? -plane.normal : plane.normal};
  }

  void aimAt(std::span<const glm::dvec3> polygon) {
    target_ = polygon;
    before_.cone = coneThrough(before_.eye, polygon);
  }
  // The planes of the cone meet in the line of sight, the first one along `up`.
  void aimAt(const glm::dvec3& point, const glm::dvec3& up) {
    target_ = {&point, 1};
    const glm::dvec3 sight = point - before_.eye;
    before_.cone.clear();
    if (glm::dvec3 normal = glm::cross(sight, up); glm::length(normal) > 1e-6 * glm::length(sight)) {
      for (const glm::dvec3& n : {glm::normalize(normal), glm::normalize(glm::cross(sight, normal))}) {
        before_.cone.push_back(n);
        before_.cone.push_back(-n);
      }
    }
  }

  std::span<const glm::dvec3> target() const { return target_; }
  // Says whether an occluder of `radius` looks large enough at the point of the sphere that is nearest to the eye.
  bool looksLarge(const glm::dvec3& center, double sphereRadius, double radius) const {
    const glm::dvec3 fromEye = center - before_.eye;
    const double large = radius * distance_ + leastRadius_ * sphereRadius;
    return large * large >= leastRadius_ * leastRadius_ * glm::dot(fromEye, fromEye);
  }
  // Returns a view that sees what lies before the polygon, within the cone through the target.
  const View& before() const { return before_; }
  // Says whether a part of the target lies beyond a plane, seen from the eye.
  bool reachesBeyond(const Plane& plane) const {
    const double side = plane.distance(before_.eye);
    return std::ranges::any_of(target_, [&](const glm::dvec3& p) { return side * plane.distance(p) < 0.0; });
  }

 private:
  std::span<const glm::dvec3> target_;
  View before_;
  double leastRadius_ = 0.0;  // of an occluder as far away as the polygon's middle
  double distance_ = 0.0;     // from the eye to the polygon's middle
};

Occlusion::Occlusion(const Scene& scene, const SceneState& state, const Settings& settings,
                     const Projection& projection, const Bvh& mirrors)
    : scene_(scene), state_(state), settings_(settings), projection_(projection), hierarchy_(mirrors) {
  for (const MirrorState& mirror : state.mirrors) {
    const double size = farthestDistance(mirror.polygon[0], mirror.polygon);
    const std::vector<glm::dvec3>& piece = mirror.piece(0);
    mirrors_.push_back({.occluder = flatOccluder(piece, newellVector(piece), size)});
  }
  shapes_.resize(scene.meshes.size());
}

const Occlusion::Shape& Occlusion::shapeOf(int mesh) {
  Shape& shape = shapes_[mesh];
  if (!std::exchange(shape.known, true)) {
    const Mesh& of = scene_.meshes[mesh];
    shape.transparent = isTransparent(of, settings_.effects);
    for (const ConvexFace& face : of.faces) {
      shape.largest = std::max(shape.largest, face.radius / of.radius);
    }
    shape.largest = of.convex.points.empty() ? shape.largest : 1.0;
  }
  return shape;
}

Occlusion::Body& Occlusion::bodyOf(int instance) {
  const auto [entry, isNew] = bodies_.try_emplace(instance);
  Body& body = entry->second;
  if (isNew) {
    const InstanceState& state = state_.instances[instance];
    const Mesh& mesh = scene_.meshes[state.mesh];
    if (!mesh.convex.triangles.empty()) {
      body.whole = bodyOccluder(mesh.convex, state);
    }
    const double scale = roomForRounding * state.radius / mesh.radius;
    body.bounds.reserve(mesh.faces.size());
    for (const ConvexFace& face : mesh.faces) {
      body.bounds.push_back({state.worldFromMesh.point(face.center), scale * face.radius, scale * face.width});
    }
  }
  return body;
}

Occlusion::Face& Occlusion::faceOf(FaceBounds& bounds, int instance, size_t index) {
  if (!bounds.face) {
    Face& face = faces_.emplace_back();
    bounds.face = &face;
    const InstanceState& state = state_.instances[instance];
    const std::vector<glm::dvec3>& corners = scene_.meshes[state.mesh].faces[index].corners;
    Polygon polygon(corners.size());
    std::ranges::transform(corners, polygon.begin(), [&](const auto& p) { return state.worldFromMesh.point(p); });
    const glm::dvec3 area = newellVector(polygon);
    if (std::isnormal(0.5 * glm::length(area))) {
      face.occluder = flatOccluder(polygon, area, state.radius);
    }
  }
  return *bounds.face;
}

const OccludedRegion* Occlusion::regionOf(Face& face) const {
  if (std::exchange(face.view, viewNumber_) != viewNumber_) {
    face.hides = hiddenByFace(face.occluder, *view_, projection_, face.region);
  }
  return face.hides ? &face.region : nullptr;
}

const BodyRegion* Occlusion::regionOf(Body& body) const {
  if (std::exchange(body.view, viewNumber_) != viewNumber_) {
    body.region = body.whole.mesh ? hiddenByBody(body.whole, *view_, projection_) : std::nullopt;
  }
  return body.region ? &*body.region : nullptr;
}

bool Occlusion::Occluder::hides(const glm::dvec3& fromEye) const {
  const auto holds = [&](const HalfSpace& half) { return half.at(fromEye) > 0.0; };
  return (!also || holds(*also)) && std::ranges::all_of(*region, holds);
}

bool Occlusion::Occluders::add(const Occluder& occluder, const glm::dvec3& eye, std::span<const glm::dvec3> polygon) {
  bool all = true;
  const auto meets = [&](const HalfSpace& half) {
    const auto within = std::ranges::count_if(polygon, [&](const glm::dvec3& p) { return half.at(p - eye) > 0.0; });
    all = all && within == std::ssize(polygon);
    return within > 0;
  };
  if ((occluder.also && !meets(*occluder.also)) || !std::ranges::all_of(*occluder.region, meets)) {
    return false;
  }
  if (all) {
    whole = occluder;
  } else {
    parts.push_back(occluder);
  }
  return all;
}

// Finds the first occluder that hides all of the target, a part of `mirror`, or else the occluders that hide a part of
// it.
Occlusion::Occluders Occlusion::occludersOf(int mirror, const Prefilter& prefilter) {
  const glm::dvec3& eye = view_->eye;
  const std::span<const glm::dvec3> target = prefilter.target();
  Occluders found;
  const auto addFace = [&](Face& face, bool isMirror, int index) {
    const FlatOccluder& occluder = face.occluder;
    if (occluder.polygon.empty() || !prefilter.looksLarge(occluder.center, occluder.radius, occluder.radius) ||
        !prefilter.reachesBeyond(occluder.plane) || !hullVisible(prefilter.before(), occluder.polygon)) {
      return false;
    }
    const OccludedRegion* region = regionOf(face);
    return region && found.add({isMirror, index, region}, eye, target);
  };
  const bool searches = viewMirrors_.size() > fewMirrors;
  RecycledVector<int> near;
  if (searches) {
    hierarchy_.visit([&](const Bounds& box) { return boxVisible(prefilter.before(), box); },
                     [&](uint32_t i) { near.push_back(static_cast<int>(i)); });
    std::ranges::sort(near);
  }
  for (const int i : searches ? near : viewMirrors_) {
    if (i != mirror && mirrors_[i].tested == viewNumber_ && addFace(mirrors_[i], true, i)) {
      return found;
    }
  }
  for (const auto& [i, center, radius, largest] : viewInstances_) {
    const InstanceState& instance = state_.instances[i];
    if (!prefilter.looksLarge(center, radius, largest) ||
        !boundsVisible(prefilter.before(), instance, scene_.meshes[instance.mesh].halfExtent)) {
      continue;
    }
    Body& body = bodyOf(i);
    if (const BodyRegion* region = regionOf(body)) {
      const bool before = isBefore(body.whole, mirrors_[mirror].occluder, eye);
      if (found.add({false, i, &region->outline, before ? nullptr : &region->beyond}, eye, target)) {
        return found;
      }
    }
    for (size_t k = 0; k < body.bounds.size(); ++k) {
      FaceBounds& face = body.bounds[k];
      if (prefilter.looksLarge(face.center, face.radius, face.radius) && !looksNarrow(face) &&
          addFace(faceOf(face, i, k), false, i)) {
        return found;
      }
    }
  }
  return found;
}

RecycledString Occlusion::nameOfOccluder(const Occluder& occluder) const {
  if (occluder.isMirror) {
    return nameOf<RecycledString>("mirror", scene_.mirror(occluder.index).name, occluder.index);
  }
  const int object = state_.instances[occluder.index].object;
  return nameOf<RecycledString>("object", scene_.objects[object].name, object);
}

bool Occlusion::skips(const View& view) const {
  // An oblique depth buffer may keep another order, so nothing is hidden.
  const bool oblique = settings_.reflection.clip == ClipMethod::oblique && view.clip;
  return settings_.debug.skipHidden && !settings_.view.wireframe && !oblique;
}

void Occlusion::setView(const View& view, std::span<const int> instances, RecycledVector<int> mirrors) {
  view_ = &view;
  ++viewNumber_;
  forward_ = -glm::transpose(view.worldToView)[2];
  narrowest_ = narrowestFace(view, projection_);
  // Mirrors are drawn only where the view shows them, not in the margin that is read around it.
  viewMirrors_ = std::move(mirrors);
  viewInstances_.clear();
  if (mirrors_.empty() || !skips(view)) {
    return;
  }
  // Keeps the candidates that fill the widest angles at the eye, in their order.
  const auto keepLargest = [&](RecycledVector<int>& candidates, const auto& sphereOf) {
    if (candidates.size() > mostTested) {
      const auto angle = [&](int i) {
        const auto [center, radius] = sphereOf(static_cast<size_t>(i));
        return radius / std::max(glm::length(center - view.eye) - radius, 1e-300);
      };
      std::ranges::nth_element(candidates, candidates.begin() + mostTested, {},
                               [&](int i) { return std::pair(-angle(i), i); });
      candidates.resize(mostTested);
      std::ranges::sort(candidates);
    }
  };
  keepLargest(viewMirrors_,
              [&](size_t i) { return std::pair(mirrors_[i].occluder.center, mirrors_[i].occluder.radius); });
  RecycledVector<int> kept(instances.begin(), instances.end());
  keepLargest(kept, [&](size_t i) { return std::pair(state_.instances[i].center, state_.instances[i].radius); });
  for (const int i : kept) {
    const InstanceState& instance = state_.instances[i];
    const Shape& shape = shapeOf(instance.mesh);
    if (!shape.transparent) {
      viewInstances_.push_back({i, instance.center, instance.radius, instance.radius * shape.largest});
    }
  }
  for (const int i : viewMirrors_) {
    mirrors_[i].tested = viewNumber_;
  }
}

std::optional<RecycledString> Occlusion::hiddenBy(int mirror, std::span<const glm::dvec3> polygon) {
  if (!skips(*view_) || polygon.empty()) {
    return std::nullopt;
  }
  Prefilter prefilter(view_->eye, polygon, mirrors_[mirror].occluder.plane);
  // A polygon is visible if one of its points is. An occluder that hides all of it is the first one to hide a point, or
  // comes after that one. Both are found in less time than all occluders of the polygon.
  const glm::dvec3 up = glm::transpose(view_->worldToView)[1];
  for (size_t i = 0; i <= polygon.size(); ++i) {
    const glm::dvec3 point = i == 0 ? vertexMean(polygon) : polygon[i - 1];
    prefilter.aimAt(point, up);
    const std::optional<Occluder> first = occludersOf(mirror, prefilter).whole;
    if (!first) {
      return std::nullopt;
    }
    if (std::ranges::all_of(polygon, [&](const glm::dvec3& p) { return first->hides(p - view_->eye); })) {
      return nameOfOccluder(*first);
    }
  }
  prefilter.aimAt(polygon);
  const Occluders found = occludersOf(mirror, prefilter);
  return found.whole ? nameOfOccluder(*found.whole) : hiddenTogether(found.parts, polygon);
}

// Cuts the occluded regions off the polygon one after the other, until no piece is left.
std::optional<RecycledString> Occlusion::hiddenTogether(std::span<const Occluder> occluders,
                                                        std::span<const glm::dvec3> polygon) const {
  RecycledVector<Polygon> pieces = {{polygon.begin(), polygon.end()}};
  RecycledVector<const Occluder*> used;
  for (const Occluder& occluder : occluders.first(std::min(occluders.size(), mostOccluders))) {
    RecycledVector<Polygon> left = outside(*occluder.region, occluder.also, view_->eye, pieces);
    if (left == pieces || left.size() > mostPieces) {
      continue;
    }
    pieces = std::move(left);
    used.push_back(&occluder);
    if (pieces.empty()) {
      return namesOf(used);
    }
  }
  return std::nullopt;
}

RecycledString Occlusion::namesOf(std::span<const Occluder* const> occluders) const {
  RecycledVector<RecycledString> names;  // each once
  for (const Occluder* occluder : occluders) {
    const RecycledString name = nameOfOccluder(*occluder);
    if (std::ranges::find(names, name) == names.end()) {
      names.push_back(name);
    }
  }
  RecycledString all = names[0];
  for (size_t i = 1; i < names.size(); ++i) {
    all += (i + 1 < names.size() ? ", " : " and ") + names[i];
  }
  return all;
}

}  // namespace speculum
