#include "accuracy/fingerprint.hpp"

#include <spdlog/fmt/fmt.h>

#include "platform/files.hpp"

namespace speculum {

namespace {

static_assert(sizeof(Vertex) == 8 * sizeof(double) && sizeof(glm::vec3) == 3 * sizeof(float),
              "padding would make equal content differ");

void addColor(Fingerprint& fingerprint, const glm::dvec3& color) {
  for (int i = 0; i < 3; ++i) {
    fingerprint.add(color[i]);
  }
}

void addMesh(Fingerprint& fingerprint, const Mesh& mesh) {
  addColor(fingerprint, mesh.center);
  fingerprint.add(std::as_bytes(std::span(mesh.vertices)));
  fingerprint.add(std::as_bytes(std::span(mesh.indices)));
  for (const MeshPart& part : mesh.parts) {
    fingerprint.add(part.firstIndex);
    addColor(fingerprint, part.material.diffuse);
    addColor(fingerprint, part.material.specular);
    addColor(fingerprint, part.material.emission);
    fingerprint.add(part.material.shininess);
    fingerprint.add(part.material.diffuseTexture);
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
  const std::vector<uint8_t> file = readFile(scene.file);
  fingerprint.add(std::as_bytes(std::span(file)));
  for (const Mesh& mesh : scene.meshes) {
    addMesh(fingerprint, mesh);
  }
  for (const Texture& texture : scene.textures) {
    fingerprint.add(texture.width);
    fingerprint.add(std::as_bytes(std::span(texture.texels)));
  }
}

}  // namespace speculum
