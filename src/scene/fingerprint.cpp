#include "scene/fingerprint.hpp"

#include <spdlog/fmt/fmt.h>

#include "scene/scene_fields.hpp"

namespace speculum {

namespace {

static_assert(sizeof(Vertex) == 8 * sizeof(double) && sizeof(glm::vec4) == 4 * sizeof(float),
              "padding would make equal content differ");

// Adds all numbers of a value; of a node, all that change the picture: not its name, and not the path of its model.
template <typename T>
void addValue(Fingerprint& fingerprint, const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    fingerprint.add(static_cast<double>(value));
  } else {
    const auto counts = [](const auto& field) {
      return field.use != FieldUse::label && field.key != "model" && field.key != "reflectance_map";
    };
    visitParts(value, counts, [&](const auto& part) { addValue(fingerprint, part); });
  }
}

void addMesh(Fingerprint& fingerprint, const Mesh& mesh) {
  addValue(fingerprint, mesh.center);
  fingerprint.add(std::as_bytes(std::span(mesh.vertices)));
  fingerprint.add(std::as_bytes(std::span(mesh.colors)));
  fingerprint.add(std::as_bytes(std::span(mesh.indices)));
  for (const MeshPart& part : mesh.parts) {
    fingerprint.add(part.firstIndex);
    addValue(fingerprint, part.material.diffuse);
    addValue(fingerprint, part.material.specular);
    addValue(fingerprint, part.material.emission);
    fingerprint.add(part.material.shininess);
    fingerprint.add(part.material.diffuseTexture);
    fingerprint.add(part.material.clamps);
    fingerprint.add(part.material.opacity);
    fingerprint.add(part.material.opacityTexture);
    fingerprint.add(part.material.cutoff);
    fingerprint.add(part.material.vertexAlpha);
    if (part.material.mirror && part.material.twoSided) {  // others keep their fingerprint in stored results
      fingerprint.add(true);
    }
  }
}

}  // namespace

void Fingerprint::add(std::span<const std::byte> bytes) {
  state_ = fnv1a(bytes, state_);
}

void Fingerprint::add(std::string_view text) {
  add(static_cast<uint64_t>(text.size()));
  add(std::as_bytes(std::span(text)));
}

std::string Fingerprint::hex() const {
  return fmt::format("{:016x}", state_);
}

void addScene(Fingerprint& fingerprint, const Scene& scene) {
  addValue(fingerprint, scene.environment);
  addValue(fingerprint, scene.camera);
  addValue(fingerprint, scene.objects);
  addValue(fingerprint, scene.lights);
  addValue(fingerprint, scene.mirrors);
  for (const Object& object : scene.objects) {
    fingerprint.add(object.mesh);
  }
  for (const Mirror& mirror : scene.mirrors) {
    fingerprint.add(mirror.map);
  }
  for (const Mesh& mesh : scene.meshes) {
    addMesh(fingerprint, mesh);
  }
  for (const Texture& texture : scene.textures) {
    fingerprint.add(texture.width);
    fingerprint.add(std::as_bytes(std::span(texture.texels)));
    fingerprint.add(std::as_bytes(std::span(texture.opacity)));
  }
}

}  // namespace speculum
