#include "fuzz_support.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "scene/material_mirrors.hpp"
#include "scene/scene_loader.hpp"
#include "scene/scene_state.hpp"

namespace speculum::fuzz {

namespace {

void checkParts(const Mesh& mesh, size_t textureCount) {
  size_t next = 0;
  for (const MeshPart& part : mesh.parts) {
    require(part.firstIndex == next && part.indexCount > 0 && part.indexCount % 3 == 0, "parts follow each other");
    next += part.indexCount;
    const Material& material = part.material;
    for (const glm::dvec3& color : {material.diffuse, material.specular, material.emission}) {
      require(finite(color) && glm::all(glm::greaterThanEqual(color, glm::dvec3(0.0))), "colors are finite, 0 or more");
    }
    require(std::isfinite(material.shininess) && material.shininess >= 1.0, "shininess is finite, 1 or more");
    require(material.diffuseTexture < static_cast<int>(textureCount), "a texture's index is in range");
  }
  require(next == mesh.indices.size(), "parts cover all indices");
}

}  // namespace

void checkMesh(const Mesh& mesh, size_t textureCount) {
  require(!mesh.indices.empty() && mesh.indices.size() % 3 == 0, "a mesh has triangles");
  require(finite(mesh.center) && finite(mesh.halfExtent) && std::isfinite(mesh.radius), "a mesh's bounds are finite");
  for (const Vertex& vertex : mesh.vertices) {
    require(finite(vertex.position) && finite(vertex.normal) && finite(vertex.uv), "vertices are finite");
    require(glm::all(glm::lessThanEqual(glm::abs(vertex.position), mesh.halfExtent)), "vertices are in the box");
  }
  size_t shaded = 0;
  ShadedVertices(mesh).forEach([&](const Vertex& vertex, uint32_t) {
    require(unit(vertex.normal), "normals are of unit length");
    ++shaded;
  });
  require(shaded == ShadedVertices::countOf(mesh), "shaded vertices are counted");
  for (const uint32_t index : mesh.indices) {
    require(index < mesh.vertices.size(), "indices are in range");
  }
  require(mesh.colors.empty() || mesh.colors.size() == mesh.vertices.size(), "each vertex has a color, or none has");
  require(!mesh.colors.empty() || !mesh.hasVertexAlpha(), "alpha that counts is there");
  checkParts(mesh, textureCount);
}

namespace {

void checkMirrors(Mesh mesh, size_t textureCount) {
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  cutMirrorParts(scene, 0);
  if (!scene.meshes[0].mirrorParts) {
    return;
  }
  size_t triangles = 0;
  for (size_t i = 1; i < scene.meshes.size(); ++i) {
    triangles += scene.meshes[i].indices.size() / 3;
    checkParts(scene.meshes[i], textureCount);
  }
  require(triangles == scene.meshes[0].indices.size() / 3, "no triangle is lost or drawn twice");
  scene.objects.push_back({.mesh = 0});
  placeMaterialMirrors(scene);
  for (const MirrorState& mirror : evaluate(scene, 0.0).mirrors) {
    require(!mirrorPolygonProblem(mirror.polygon) && unit(mirror.normal), "mirrors are valid");
  }
}

}  // namespace

bool checkModel(std::string_view text) {
  static const TemporaryFolder folder;
  static const bool hasTexture = [] {
    writePng(folder / "t.png", Image8(2, 2));
    return true;
  }();
  constexpr std::string_view separator = "%mtl\n";
  const size_t end = std::min(text.find(separator), text.size());
  const std::string_view rest = text.substr(end);
  folder.write("m.mtl", rest.substr(std::min(separator.size(), rest.size())));
  const std::filesystem::path file = folder.write("m.obj", text.substr(0, end));
  std::vector<Texture> textures;
  Mesh mesh;
  if (!accepted([&] { mesh = loadObj(file, textures); })) {
    return false;
  }
  require(hasTexture, "the texture is there");
  checkMesh(mesh, textures.size());
  checkMirrors(std::move(mesh), textures.size());
  return true;
}

}  // namespace speculum::fuzz
