#include "edit/new_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <limits>

#include "scene/scene_state.hpp"

namespace speculum {

namespace {

// Returns the distance rounded to two digits, so that sizes are what a user would type.
double distanceOf(const glm::dvec3& position, const glm::dvec3& viewer) {
  const double length = glm::length(viewer - position);
  // The loader refuses a mirror that is too small for its distance from the origin.
  const double distance = std::max(length > 0.0 ? length : 1.0, 1e-8 * glm::length(position));
  const double perUnit = std::pow(10.0, 1.0 - std::floor(std::log10(distance)));
  return std::round(distance * perUnit) / perUnit;
}

// Returns half the extent of the model's box along the world's axes.
glm::dvec3 halfExtent(const Object& object, const Mesh& mesh) {
  const glm::dmat3 linear = modelTransform(object, 0.0) * mesh.unit;
  return glm::abs(linear[0]) * mesh.halfExtent.x + glm::abs(linear[1]) * mesh.halfExtent.y +
         glm::abs(linear[2]) * mesh.halfExtent.z;
}

// Returns the vector from the first copy to the last, metres in the world.
glm::dvec3 rowOf(const Object& object) {
  return static_cast<double>(object.copies.count - 1) * object.copies.step;
}

// Returns a step within the mirror's plane, so that neither copy stands before the other.
glm::dvec3 stepInPlane(const MirrorState& state) {
  const auto x = [&](const glm::dvec3& vertex) { return glm::dot(vertex - state.origin, state.axisX); };
  const auto [low, high] = std::ranges::minmax(state.polygon, {}, x);
  return 1.1 * (x(high) - x(low)) * state.axisX;
}

// Returns a copy of the node, moved by `step`. A light's orbit moves too, so that the light circles as before.
SceneNode copyMoved(const SceneNode& node, const glm::dvec3& step) {
  SceneNode copy = moved(node, step, 0.0);
  if (auto* light = std::get_if<PointLight>(&copy); light && light->orbit) {
    light->orbit->center += step;
  }
  return copy;
}

glm::dvec3 stepBesideOne(const Scene& scene, const Selection& selection) {
  const size_t index = selection.index;
  switch (selection.kind) {
    case Selection::Kind::object: {
      const Object& object = scene.objects.at(index);
      return {2.2 * halfExtent(object, scene.meshes.at(object.mesh)).x + std::abs(rowOf(object).x), 0.0, 0.0};
    }
    case Selection::Kind::mirror:
      return stepInPlane(evaluate(scene, 0.0).mirrors.at(index));
    case Selection::Kind::light:
      return {6.0 * scene.lights.at(index).radius, 0.0, 0.0};
    default:
      return glm::dvec3(0.0);
  }
}

glm::dvec3 stepBesideAll(const Scene& scene, std::span<const Selection> nodes) {
  const SceneState state = evaluate(scene, 0.0);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (Selection node : nodes) {
    node.copy = 0;
    const double x = pivotOf(scene, state, node).x;
    const double reach = reachOf(scene, state, node);
    const double row = node.kind == Selection::Kind::object ? rowOf(scene.objects.at(node.index)).x : 0.0;
    low = std::min(low, x + std::min(row, 0.0) - reach);
    high = std::max(high, x + std::max(row, 0.0) + reach);
  }
  return {1.1 * (high - low), 0.0, 0.0};
}

}  // namespace

Mirror newMirror(const glm::dvec3& position, const glm::dvec3& viewer) {
  const glm::dvec3 toViewer = viewer - position;
  const double distance = distanceOf(position, viewer);
  Mirror mirror{.name = "mirror", .position = position, .size = {3.0 * distance / 10.0, 4.0 * distance / 10.0}};
  mirror.rotation.y = std::round(10.0 * glm::degrees(std::atan2(toViewer.x, toViewer.z))) / 10.0;
  return mirror;
}

PointLight newLight(const glm::dvec3& position, const glm::dvec3& viewer) {
  const double distance = distanceOf(position, viewer);
  return {.name = "light", .position = position, .intensity = distance * distance, .radius = 0.01 * distance};
}

Object newObject(const Scene& scene, int mesh, const glm::dvec3& position) {
  const Mesh& model = scene.meshes.at(mesh);
  Object object{.name = model.source.stem().string(), .mesh = mesh};
  const glm::dvec3 center = modelTransform(object, 0.0) * model.center;
  object.position = position - center + glm::dvec3(0.0, halfExtent(object, model).y, 0.0);
  return object;
}

bool liesOnBack(const Scene& scene, const Object& object) {
  const Mesh& mesh = scene.meshes.at(object.mesh);
  const glm::dvec3 low = mesh.center - mesh.unit * mesh.halfExtent;
  const double size = 2.0 * mesh.unit * glm::compMax(mesh.halfExtent);
  return object.up == UpAxis::y && object.rotation == glm::dvec3(0.0) && std::abs(low.z) < 0.01 * size &&
         std::abs(low.y) >= 0.01 * size && 2.0 * mesh.unit * mesh.halfExtent.z > 0.05 * size;
}

Object stoodUp(const Scene& scene, Object object) {
  const Mesh& mesh = scene.meshes.at(object.mesh);
  const auto foot = [&] {
    return modelTransform(object, 0.0) * mesh.center - glm::dvec3(0.0, halfExtent(object, mesh).y, 0.0);
  };
  const glm::dvec3 before = foot();
  object.up = UpAxis::z;
  object.position += before - foot();
  return object;
}

glm::dvec3 stepBeside(const Scene& scene, std::span<const Selection> nodes, double side) {
  return side * (nodes.size() == 1 ? stepBesideOne(scene, nodes.front()) : stepBesideAll(scene, nodes));
}

std::vector<SceneNode> copiesBeside(const Scene& scene, std::span<const Selection> nodes, double side) {
  const glm::dvec3 step = stepBeside(scene, nodes, side);
  std::vector<SceneNode> copies;
  for (const Selection& node : nodes) {
    copies.push_back(copyMoved(nodeOf(scene, node), step));
  }
  return copies;
}

std::string freeName(const std::string& wanted, const std::set<std::string>& taken) {
  if (wanted.empty() || !taken.contains(wanted)) {
    return wanted;
  }
  const size_t blank = wanted.rfind(' ');
  const std::string last = blank == std::string::npos ? "" : wanted.substr(blank + 1);
  const bool counted = !last.empty() && last.size() < 9 && last.find_first_not_of("0123456789") == std::string::npos;
  const std::string stem = counted ? wanted.substr(0, blank) : wanted;
  for (int number = counted ? std::stoi(last) + 1 : 2;; ++number) {
    if (std::string name = stem + " " + std::to_string(number); !taken.contains(name)) {
      return name;
    }
  }
}

}  // namespace speculum
