#include "scene/scene_state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <limits>
#include <map>
#include <stdexcept>

#include "geometry/bvh.hpp"
#include "geometry/polygon.hpp"
#include "scene/material_mirrors.hpp"

namespace speculum {

namespace {

void addInstances(const Scene& scene, int objectIndex, int meshIndex, double time,
                  std::vector<InstanceState>& instances) {
  const Object& object = scene.objects[objectIndex];
  const Mesh& mesh = scene.meshes[meshIndex];
  const glm::dmat3 linear = modelTransform(object, time);
  const double largestScale = glm::compMax(glm::abs(object.scale));
  const glm::dvec3 center = linear * mesh.center;
  for (int copy = 0; copy < object.copies.count; ++copy) {
    InstanceState instance{.object = objectIndex, .copy = copy, .mesh = meshIndex};
    const glm::dvec3 position = object.position + static_cast<double>(copy) * object.copies.step;
    instance.worldFromMesh = {linear * mesh.unit, position + center};
    instance.center = instance.worldFromMesh.translation;
    instance.radius = mesh.radius * mesh.unit * largestScale * (1.0 + 1e-12);
    instances.push_back(instance);
  }
}

LightState lightState(const PointLight& light, double time) {
  if (!light.orbit) {
    return {light.position};
  }
  const Orbit& orbit = *light.orbit;
  return {orbit.center +
          rotationAboutAxis(orbit.axis, productModulo(orbit.speed, time, 360.0)) * (light.position - orbit.center)};
}

// Returns the unit direction of the first edge with a length, projected into the plane, because vertices may lie a
// little off the plane.
glm::dvec3 firstEdge(const std::vector<glm::dvec3>& polygon, const glm::dvec3& normal) {
  for (size_t i = 1; i < polygon.size(); ++i) {
    const glm::dvec3 edge = polygon[i] - polygon[i - 1];
    const glm::dvec3 inPlane = edge - normal * glm::dot(normal, edge);
    if (std::isnormal(glm::dot(inPlane, inPlane))) {
      return glm::normalize(inPlane);
    }
  }
  throw std::invalid_argument("a mirror's polygon has no edge");
}

double slackOf(const std::vector<glm::dvec3>& polygon) {
  const glm::dvec3 center = vertexMean(polygon);
  return 1e-9 * farthestDistance(center, polygon) + 1e-15 * glm::length(center);
}

MirrorState placedPolygon(const std::vector<glm::dvec3>& polygon) {
  MirrorState state;
  state.origin = polygon[0];
  state.normal = glm::normalize(newellVector(polygon));
  state.polygon = flattened(polygon, state.normal);
  state.axisX = firstEdge(polygon, state.normal);
  state.axisY = glm::cross(state.normal, state.axisX);
  return state;
}

MirrorState placedMirror(const Mirror& mirror, double time) {
  if (!mirror.polygon.empty()) {
    return placedPolygon(mirror.polygon);
  }
  MirrorState state;
  const glm::dmat3 rotation = rotationFromDegrees(mirror.rotation + spunBy(mirror.spin, time));
  state.origin = mirror.position;
  state.axisX = rotation[0];
  state.axisY = rotation[1];
  state.normal = rotation[2];
  const glm::dvec3 x = 0.5 * mirror.size.x * state.axisX;
  const glm::dvec3 y = 0.5 * mirror.size.y * state.axisY;
  state.polygon = {state.origin - x - y, state.origin + x - y, state.origin + x + y, state.origin - x + y};
  return state;
}

// The front stays the side from which the model winds its faces counter-clockwise, also with negative scale.
MirrorState placedMirror(const Scene& scene, const MaterialMirror& made, double time) {
  const Object& object = scene.objects[made.object];
  const Mesh& mesh = scene.meshes[object.mesh];
  const FlatMirror& flat = mesh.mirrorParts->flat[made.flat];
  const glm::dmat3 linear = modelTransform(object, time);
  const glm::dvec3 offset =
      object.position + static_cast<double>(made.copy) * object.copies.step + linear * mesh.center;
  const auto placed = [&](const std::vector<glm::dvec3>& polygon) {
    std::vector<glm::dvec3> points;
    for (const glm::dvec3& p : polygon) {
      points.push_back(linear * (mesh.unit * p) + offset);
    }
    if (glm::determinant(linear) < 0.0) {
      std::ranges::reverse(points);
    }
    return points;
  };
  MirrorState state = placedPolygon(placed(flat.outline));
  for (size_t i = 0; !flat.convex && i < flat.pieces.size(); ++i) {
    std::vector<glm::dvec3>& piece = state.pieces.emplace_back(placed(flat.pieces[i]));
    for (glm::dvec3& p : piece) {
      p -= glm::dot(p - state.origin, state.normal) * state.normal;
    }
  }
  return state;
}

// Returns the pose of a camera that looks along `forward`, which may have any length but must not be parallel to `up`.
CameraPose poseAlong(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up, double verticalFovDegrees,
                     double near) {
  const glm::dvec3 back = -glm::normalize(forward);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
  constexpr double smallestNear = 1e-20;  // smaller values gain nothing, and depth has to stay a float
  CameraPose pose{.eye = eye, .verticalFov = glm::radians(verticalFovDegrees), .near = std::max(near, smallestNear)};
  pose.worldToView = glm::transpose(glm::dmat3(right, glm::cross(back, right), back));
  return pose;
}

// Rotates the view direction instead of computing it from eye and target, which may round to one point far from the
// origin.
CameraPose cameraPose(const CameraSpec& camera, double time) {
  const glm::dmat3 turn = rotationAboutAxis(camera.up, productModulo(camera.orbitSpeed, time, 360.0));
  const glm::dvec3 arm = turn * (camera.position - camera.target);
  return poseAlong(camera.target + arm, -arm, camera.up, camera.verticalFov, camera.near);
}

struct Placed {
  size_t index = 0;
  bool twoSided = false;
  MirrorState* state = nullptr;
  Bounds bounds;
};

constexpr double largestTurn = 5e-5;  // more than the length by which unit normals of parallel mirrors differ

bool areParallel(const glm::dvec3& a, const glm::dvec3& b) {
  return std::abs(glm::dot(a, b)) > 1.0 - 1e-9;
}

// Says whether parallel mirrors lie in one plane.
bool inOnePlane(const Placed& a, const Placed& b) {
  const Plane plane{a.state->polygon[0], a.state->normal};
  const double slack = std::max(a.state->slack, b.state->slack);
  return std::ranges::all_of(b.state->polygon, [&](const auto& p) { return std::abs(plane.distance(p)) <= slack; });
}

// Says whether the line through an edge of `a` separates `b` from `a`, except for `slack` metres.
bool edgeSeparates(const Placed& a, const Placed& b, double slack) {
  const std::vector<glm::dvec3>& polygon = a.state->polygon;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 outward = glm::cross(polygon[(i + 1) % polygon.size()] - polygon[i], a.state->normal);
    const double length = glm::length(outward);
    const auto outside = [&](const auto& p) { return glm::dot(outward, p - polygon[i]) >= -slack * length; };
    if (length > 0.0 && std::ranges::all_of(b.state->polygon, outside)) {
      return true;
    }
  }
  return false;
}

// Returns the distance of two boxes along the axis on which they are farthest apart; below 0 where they overlap.
double gapBetween(const Bounds& a, const Bounds& b) {
  return glm::compMax(glm::max(a.low - b.high, b.low - a.high));
}

bool overlap(const Placed& a, const Placed& b) {
  const double slack = std::max(a.state->slack, b.state->slack);
  return gapBetween(a.bounds, b.bounds) <= slack && !edgeSeparates(a, b, slack) && !edgeSeparates(b, a, slack);
}

// Sets the layers of the mirrors of one plane for an eye on the side of the plane that `towardsEye` points to.
void setLayers(std::vector<Placed>& plane, const glm::dvec3& towardsEye) {
  const auto front = [&](const Placed& p) { return glm::dot(p.state->normal, towardsEye) > 0.0; };
  const auto layer = [&](const Placed& p) -> int& { return front(p) ? p.state->frontLayer : p.state->backLayer; };
  const auto showsBack = [&](const Placed& p) { return !front(p) && !p.twoSided; };
  std::ranges::sort(plane, {}, [&](const Placed& p) { return std::pair(showsBack(p), p.index); });
  RecycledVector<Bounds> boxes;
  double slack = 0.0;
  for (const Placed& placed : plane) {
    boxes.push_back(placed.bounds);
    slack = std::max(slack, placed.state->slack);
  }
  const Bvh hierarchy(boxes);
  // The deepest mirror among those before that overlap the next one decides its layer. Where many overlap, it is among
  // the deepest of all; elsewhere the hierarchy finds it.
  constexpr size_t few = 64;
  std::vector<const Placed*> deepest;  // of those before that lie on others; the deepest first
  for (uint32_t i = 0; i < plane.size(); ++i) {
    const Placed& placed = plane[i];
    const auto covering = std::ranges::find_if(deepest, [&](const Placed* other) { return overlap(*other, placed); });
    if (covering != deepest.end()) {
      layer(placed) = layer(**covering) + 1;
    } else {
      hierarchy.visit([&](const Bounds& box) { return gapBetween(box, boxes[i]) <= slack; },
                      [&](uint32_t j) {
                        if (j < i && layer(plane[j]) >= layer(placed) && overlap(plane[j], placed)) {
                          layer(placed) = layer(plane[j]) + 1;
                        }
                      });
    }
    if (layer(placed) > 0) {
      const auto shallower =
          std::ranges::partition_point(deepest, [&](const Placed* other) { return layer(*other) > layer(placed); });
      deepest.insert(shallower, &placed);
      deepest.resize(std::min(deepest.size(), few));
    }
  }
}

// Sets plane and layers of all mirrors; the layers must be 0 before. Mirrors count as lying in one plane if they are no
// farther apart than rounding can put them.
void findLayers(const Scene& scene, std::span<MirrorState> states) {
  Bounds box;
  double slack = 0.0;
  for (const MirrorState& state : states) {
    box.add(Bounds::around(state.polygon));
    slack = std::max(slack, state.slack);
  }
  // Lies outside of the box, in a direction that planes of mirrors are unlikely to be symmetric about.
  const glm::dvec3 point = box.low - glm::length(box.high - box.low) * glm::dvec3(0.83, 0.59, 0.37);
  std::vector<std::vector<Placed>> planes;
  std::multimap<double, size_t> planeAt;  // indices of the planes by their distance from `point`
  for (size_t i = 0; i < states.size(); ++i) {
    states[i].plane = static_cast<int>(i);
    const Placed placed{i, scene.mirror(i).twoSided, &states[i], Bounds::around(states[i].polygon)};
    const glm::dvec3 arm = states[i].polygon[0] - point;
    const double distance = std::abs(glm::dot(states[i].normal, arm));
    const double reach = slack + largestTurn * glm::length(arm);
    size_t same = planes.size();
    for (auto near = planeAt.lower_bound(distance - reach); near != planeAt.end() && near->first <= distance + reach;
         ++near) {
      const Placed& first = planes[near->second][0];
      if (near->second < same && areParallel(first.state->normal, states[i].normal) && inOnePlane(first, placed)) {
        same = near->second;
      }
    }
    if (same == planes.size()) {
      planes.push_back({placed});
      planeAt.emplace(distance, same);
    } else {
      states[i].plane = static_cast<int>(planes[same][0].index);
      planes[same].push_back(placed);
    }
  }
  for (std::vector<Placed>& plane : planes) {
    if (plane.size() > 1) {
      const glm::dvec3 normal = plane[0].state->normal;
      setLayers(plane, normal);
      setLayers(plane, -normal);
    }
  }
}

constexpr double thinnestWedge = 0.01;  // sine of the angle between two planes
constexpr double farthest = 100.0;      // from the light, in distances from the planes

// Returns by how many metres shaders may be wrong about the light's distance from the mirror's plane. Floats round by
// 6e-8. Rays come from points up to about a hundred times as far from the eye as the light.
double floatRounding(const glm::dvec3& light, const MirrorState& mirror, const glm::dvec3& eye) {
  return 4e-6 * glm::length(light - eye) + 5e-7 * glm::length(light - mirror.at(localNear(mirror, eye)));
}

// Returns an upper bound of floatRounding() that takes less time: the origin lies in the mirror's box.
double mostRounding(const glm::dvec3& light, const MirrorState& mirror, const glm::dvec3& eye) {
  return 5e-6 * glm::length(light - eye) + 5e-7 * glm::length(mirror.origin - eye);
}

}  // namespace

glm::dvec3 Environment::radiance(const glm::dvec3& d) const {
  if (!sky) {
    return background;
  }
  return d.y >= 0.0 ? glm::mix(sky->horizon, sky->zenith, std::sqrt(d.y))
                    : glm::mix(sky->horizon, sky->ground, std::min(1.0, -8.0 * d.y));
}

Environment Environment::cleared(const std::optional<glm::dvec3>& color) const {
  Environment environment = *this;
  if (color) {
    environment.background = *color;
    environment.sky.reset();
  }
  return environment;
}

MirrorOptics opticsOf(const Mirror& mirror) {
  return {.reflectance = mirror.reflectance,
          .fresnel = mirror.fresnel,
          .baseColor = mirror.baseColor,
          .backColor = mirror.backColor,
          .twoSided = mirror.twoSided,
          .alpha = mirror.roughness * mirror.roughness,
          .ripple = mirror.ripple,
          .map = mirror.map};
}

MirrorOptics opticsOf(const ObjectMirror& mirror) {
  return {.reflectance = mirror.reflectance, .fresnel = mirror.fresnel, .baseColor = mirror.baseColor};
}

glm::dvec3 MirrorOptics::reflectanceAt(double cosine) const {
  if (fresnel == Fresnel::none) {
    return reflectance;
  }
  const double grazing = 1.0 - std::clamp(cosine, 0.0, 1.0);
  return reflectance + (1.0 - reflectance) * std::pow(grazing, 5.0);
}

glm::dvec3 spunBy(const glm::dvec3& spin, double time) {
  glm::dvec3 angles;
  for (int i = 0; i < 3; ++i) {
    angles[i] = spin[i] == 0.0 ? 0.0 : productModulo(spin[i], time, 360.0);
  }
  return angles;
}

CameraPose lookAt(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up, double verticalFovDegrees,
                  double near) {
  const glm::dvec3 forward = target - eye;
  if (!hasDirection(forward) || !hasDirection(up) ||
      !(glm::length(glm::cross(forward, up)) > 1e-9 * glm::length(forward) * glm::length(up))) {
    throw std::invalid_argument("the camera's target is its position, or lies along its up vector");
  }
  return poseAlong(eye, forward, up, verticalFovDegrees, near);
}

glm::dvec2 localNear(const MirrorState& mirror, const glm::dvec3& eye) {
  const MirrorBox box = boxOf(mirror, mirror.polygon);
  return glm::clamp(mirror.local(eye), box.low, box.low + box.size);
}

MirrorBox boxOf(const MirrorState& mirror, std::span<const glm::dvec3> points) {
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  for (const glm::dvec3& p : points) {
    low = glm::min(low, mirror.local(p));
    high = glm::max(high, mirror.local(p));
  }
  return {low, high - low};
}

glm::dmat3 modelTransform(const Object& object, double time) {
  const glm::dmat3 turn = rotationFromDegrees(object.rotation + spunBy(object.spin, time));
  const glm::dmat3 scaled(turn[0] * object.scale.x, turn[1] * object.scale.y, turn[2] * object.scale.z);
  return object.up == UpAxis::z ? glm::dmat3(scaled[0], -scaled[2], scaled[1]) : scaled;
}

SceneState evaluate(const Scene& scene, double timeSeconds) {
  SceneState state{.time = timeSeconds, .camera = cameraPose(scene.camera, timeSeconds)};
  state.instances.reserve(scene.objects.size());
  for (size_t i = 0; i < scene.objects.size(); ++i) {
    forEachDrawnMesh(scene, static_cast<int>(i),
                     [&](int mesh) { addInstances(scene, static_cast<int>(i), mesh, timeSeconds, state.instances); });
  }
  std::ranges::stable_sort(state.instances,
                           [](const InstanceState& a, const InstanceState& b) { return a.mesh < b.mesh; });
  for (const PointLight& light : scene.lights) {
    state.lights.push_back(lightState(light, timeSeconds));
  }
  for (const Mirror& mirror : scene.mirrors) {
    state.mirrors.push_back(placedMirror(mirror, timeSeconds));
  }
  for (const MaterialMirror& mirror : scene.materialMirrors) {
    state.mirrors.push_back(placedMirror(scene, mirror, timeSeconds));
  }
  size_t pieces = 0;
  for (MirrorState& placed : state.mirrors) {
    placed.slack = slackOf(placed.polygon);
    placed.firstPiece = static_cast<int>(pieces);
    pieces += placed.pieceCount();
  }
  findLayers(scene, state.mirrors);
  const bool bounces = std::ranges::any_of(scene.mirrors, &Mirror::castsLight);
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    if (bounces || scene.lights[i].castsShadow) {
      state.lights[i].position = besideMirrors(state.lights[i].position, state.mirrors);
    }
  }
  return state;
}

CameraSpec cameraOf(const Bookmark& bookmark, const CameraSpec& camera) {
  return {.position = bookmark.position,
          .target = bookmark.target,
          .up = bookmark.up.value_or(camera.up),
          .verticalFov = bookmark.verticalFov.value_or(camera.verticalFov),
          .near = camera.near};
}

bool spins(const Object& object) {
  return object.spin != glm::dvec3(0.0);
}

bool spins(const Mirror& mirror) {
  return mirror.spin != glm::dvec3(0.0);
}

bool orbits(const PointLight& light) {
  return light.orbit && light.orbit->speed != 0.0;
}

bool contentMoves(const Scene& scene) {
  const auto any = [](const auto& list, const auto& test) { return std::ranges::any_of(list, test); };
  return any(scene.objects, [](const Object& object) { return spins(object); }) || any(scene.lights, orbits) ||
         any(scene.mirrors, [](const Mirror& m) { return spins(m) || (m.ripple && m.ripple->speed != 0.0); });
}

bool moves(const Scene& scene) {
  return scene.camera.orbitSpeed != 0.0 || contentMoves(scene);
}

glm::dvec3 besideMirrors(const glm::dvec3& light, std::span<const MirrorState> mirrors,
                         const std::optional<glm::dvec3>& eye) {
  std::vector<Plane> planes;  // planes near the light, facing it
  double away = 0.0;          // metres
  for (size_t i = 0; i < mirrors.size(); ++i) {
    const MirrorState& mirror = mirrors[i];
    const double height = glm::dot(mirror.normal, light - mirror.origin);
    if (mirror.plane != static_cast<int>(i) ||
        (eye && std::abs(height) > std::max(mirror.slack, mostRounding(light, mirror, *eye)))) {
      continue;
    }
    const double distance = std::max(mirror.slack, eye ? floatRounding(light, mirror, *eye) : 0.0);
    if (std::abs(height) <= distance) {
      planes.push_back({mirror.origin, height < -mirror.slack ? -mirror.normal : mirror.normal});
      away = std::max(away, distance);
    }
  }
  // Moves the light to the same distance from all planes: if distances differed, rounding would decide which mirrors
  // the light reaches by way of others. Each step keeps the distances from the planes before it, for up to three
  // planes.
  glm::dvec3 point = light;
  std::vector<glm::dvec3> taken;  // orthonormal
  for (const Plane& plane : planes) {
    glm::dvec3 step = plane.normal;
    for (const glm::dvec3& direction : taken) {
      step -= glm::dot(step, direction) * direction;
    }
    const double length2 = glm::dot(step, step);
    if (length2 > thinnestWedge * thinnestWedge) {
      point += (away - plane.distance(point)) / length2 * step;
      taken.push_back(step / std::sqrt(length2));
    }
  }
  const bool tooFar = glm::distance(point, light) > farthest * away;
  point = tooFar ? light : point;
  // For more than three planes, or planes that leave hardly any room, moving to each in turn (Kaczmarz's method) is a
  // compromise.
  for (int turn = 0; (tooFar || taken.size() < planes.size()) && turn < 50; ++turn) {
    for (const Plane& plane : planes) {
      point += (away - plane.distance(point)) * plane.normal;
    }
  }
  return point;
}

double heightOverMirrors(const glm::dvec3& point, std::span<const MirrorState> mirrors) {
  double height = 1e30;
  for (const MirrorState& mirror : mirrors) {
    height = std::min(height, std::abs(glm::dot(mirror.normal, point - mirror.origin)));
  }
  return height;
}

}  // namespace speculum
