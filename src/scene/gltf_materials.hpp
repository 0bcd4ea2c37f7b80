#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/gltf_file.hpp"
#include "scene/materials.hpp"
#include "scene/value_range.hpp"

namespace speculum {

// Returns a color within the range, or white if there are too few numbers.
glm::dvec3 colorOf(const std::vector<double>& values, const Range& range);

// Returns how a texture continues outside of its picture, to the sides and up (TINYGLTF_TEXTURE_WRAP_*).
glm::ivec2 waysToWrap(const tinygltf::Model& model, int texture);
inline constexpr glm::ivec2 clampingWays(TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);

// Materials of a glTF file, as the mesh's parts need them.
class GltfMaterials {
 public:
  // All must outlive this object. Textures are appended to `textures`.
  GltfMaterials(const std::filesystem::path& file, GltfFile& content, ModelDefects& defects,
                std::vector<Texture>& textures)
      : file_(file), content_(content), defects_(defects), textures_(textures) {}

  // Returns a material; for another index the default one, which is white for a mesh with colors. `withAlpha`: its
  // vertices have colors with alpha below 1. `meanColor`: of its vertices.
  Material material(int index, bool colored, bool withAlpha, const glm::dvec3& meanColor);

 private:
  void add(std::string_view kind, std::string_view detail) { defects_.add(file_, 1, "materials", kind, detail); }
  // Set the colors and the coverage of a material whose texture is set.
  void setSurface(Material& material, const tinygltf::PbrMetallicRoughness& surface, const glm::dvec3& meanColor);
  void setCoverage(Material& material, const tinygltf::Material& from, bool withAlpha);
  glm::dvec3 emissionOf(const tinygltf::Material& from);
  // Returns the means of a texture's pixels; 1 without a picture.
  const PictureMeans& meansOf(int texture);
  // Returns read(file) or read(name, content) for a texture's picture; nothing if there is none.
  template <typename Read>
  auto readPicture(int texture, const Read& read) -> std::optional<decltype(read(std::filesystem::path()))>;

  const std::filesystem::path& file_;
  GltfFile& content_;
  ModelDefects& defects_;
  std::vector<Texture>& textures_;
  MeansOfPictures pictureMeans_;
  // By the index of the file's texture, so that no picture is looked for and no defect counted for each material.
  std::map<int, int> diffuse_;  // index into textures_; -1: not readable
  std::map<int, PictureMeans> means_;
};

}  // namespace speculum
