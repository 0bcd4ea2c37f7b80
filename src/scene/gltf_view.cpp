#include <algorithm>
#include <cmath>

#include "scene/gltf_file.hpp"

namespace speculum {

namespace {

// Returns the unit vector along v; zero for zero.
glm::dvec3 direction(const glm::dvec3& v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : glm::dvec3(0.0);
}

// Says whether rounding leaves a camera or light at `v` its place relative to the mesh, wherever the model is moved.
bool isPlace(const glm::dvec3& v, const Mesh& mesh) {
  const double radius = mesh.radius * mesh.unit;
  return glm::distance(v, mesh.center) <= 1e6 * radius && glm::length(v) <= std::min(1e10 * radius, 1e14);
}

// Returns the camera; nothing if it has no usable place.
std::optional<CameraSpec> cameraOf(const tinygltf::Camera& from, const glm::dmat4& transform, const Mesh& mesh) {
  const double radius = mesh.radius * mesh.unit;
  CameraSpec camera{.position = glm::dvec3(transform[3]), .up = direction(glm::dvec3(transform[1]))};
  const glm::dvec3 forward = -direction(glm::dvec3(transform[2]));
  const double distance = glm::dot(mesh.center - camera.position, forward);
  camera.target = camera.position + (distance > 0.01 * radius ? distance : radius) * forward;
  camera.verticalFov = std::clamp(glm::degrees(from.perspective.yfov), fieldOfViewRange.low, fieldOfViewRange.high);
  const bool usable = isPlace(camera.position, mesh) && glm::length(glm::cross(forward, camera.up)) > 1e-3;
  return usable ? std::optional(camera) : std::nullopt;
}

PointLight lightOf(const tinygltf::Light& from, const glm::dmat4& transform, const Mesh& mesh) {
  constexpr double farOff = 100.0;  // distance that stands for infinity, in radii of the model
  const double radius = mesh.radius * mesh.unit;
  PointLight light{.name = from.name,
                   .position = glm::dvec3(transform[3]),
                   .color = colorOf(from.color),
                   .intensity = from.intensity,
                   .radius = 0.01 * radius,
                   .glow = 0.0};
  if (from.type == "directional") {
    light.position = mesh.center + farOff * radius * direction(glm::dvec3(transform[2]));
    light.intensity *= farOff * radius * farOff * radius;
  }
  light.intensity = std::clamp(light.intensity, radianceRange.low, radianceRange.high);
  return light;
}

}  // namespace

void addView(const std::filesystem::path& file, const tinygltf::Model& content, const GltfPlaced& camera,
             std::span<const GltfPlaced> lights, Model& model, ModelDefects& defects) {
  constexpr size_t mostLights = 32;
  constexpr size_t mostWithShadows = 4;
  const auto add = [&](std::string_view key, std::string_view kind, int index) {
    defects.add(file, 1, key, kind, std::to_string(index));
  };
  if (camera.index != -1) {
    model.camera = cameraOf(content.cameras[camera.index], camera.transform, model.mesh);
    if (!model.camera) {
      add("cameras", "camera {} has no usable place, it is left out", camera.index);
    }
  }
  for (const auto& [index, transform] : lights) {
    if (!isIndex(index, content.lights.size()) || model.lights.size() == mostLights) {
      add("lights", "light {} is not there, or comes after 32 others, it is left out", index);
      continue;
    }
    const tinygltf::Light& from = content.lights[index];
    if (from.type == noLight) {
      continue;
    }
    if (from.type == "spot") {
      add("lights", "light {} is a spot, it shines to all sides", index);
    }
    PointLight light = lightOf(from, transform, model.mesh);
    if (isPlace(light.position, model.mesh)) {
      light.castsShadow = model.lights.size() < mostWithShadows;
      model.lights.push_back(std::move(light));
    } else {
      add("lights", "light {} has no usable place, it is left out", index);
    }
  }
}

}  // namespace speculum
