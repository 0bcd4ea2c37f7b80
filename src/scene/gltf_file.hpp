#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/materials.hpp"
#include "scene/model_files.hpp"
#include "scene/scene.hpp"
#include "scene/value_range.hpp"

namespace speculum {

inline bool isIndex(int index, size_t count) {
  return index >= 0 && static_cast<size_t>(index) < count;
}

// Returns a member of an object; null if there is none.
const nlohmann::json& member(const nlohmann::json& object, const char* key);
// Says whether a value can be an index: an integer from 0 that an int holds, as the library keeps it.
bool isIndexNumber(const nlohmann::json& value);
// Returns what is wrong with JSON, without the library's name of the exception.
std::string jsonFault(const std::exception& error);
// Returns a member of an extension; a null value if there is none.
const tinygltf::Value& extensionMember(const tinygltf::ExtensionMap& extensions, const char* name, const char* key);
double numberOf(const tinygltf::Value& value, double usual);

// A glTF 2.0 file, as text (.gltf) or binary (.glb), with its buffers. tinygltf reads the objects of the JSON
// (readRepaired). Buffers and pictures are read here, because the library
// - looks for their files in the working folder too;
// - refuses a file that is longer than its buffer, and most kinds of data URIs;
// - decodes pictures that nothing uses.
class GltfFile {
 public:
  struct Picture {
    std::filesystem::path name;                   // its file, or a name of its place in a file
    std::optional<std::vector<uint8_t>> content;  // if it is no file of its own
  };

  // Moves vertices with nodes.
  struct Skin {
    std::vector<int> joints;       // nodes; -1: not readable
    int inverseBindMatrices = -1;  // accessor; -1: all are 1
  };

  // Reads the file and its buffers. `file` and `defects` must outlive this object. Throws InputError if the file is no
  // glTF 2.0, is damaged, or requires an extension that is not read.
  GltfFile(const std::filesystem::path& file, ModelDefects& defects);

  const tinygltf::Model& model() const { return model_; }  // indices are the attribute indicesAttribute
  const std::vector<Skin>& skins() const { return skins_; }
  bool hasMotion() const { return hasMotion_; }      // animations
  uint64_t byteCount() const { return byteCount_; }  // of the file and its buffers
  // Return the files that were read: of buffers, with symbolic links resolved; of buffers and pictures, as found.
  const std::set<std::filesystem::path>& bufferFiles() const { return bufferFiles_; }
  const std::set<std::filesystem::path>& namedFiles() const { return namedFiles_; }

  // Returns the number of an accessor's elements, 0 if there is no such accessor. Damaged files may claim any number.
  uint64_t countOf(int accessor) const;
  // Returns the numbers of an accessor with `components` for each element; normalized integers become 0 .. 1 or -1 ..
  // 1. Counts a defect and returns nothing if the accessor has another type, or elements outside of its data:
  // `ofTriangles` says that this costs triangles. Check the number of elements first.
  std::optional<std::vector<double>> numbers(int accessor, int components, bool ofTriangles = false);

  // Finds the picture of an image. Counts a defect and returns nothing if there is none.
  std::optional<Picture> picture(int image);

 private:
  // Names the bytes of a buffer or picture.
  struct Source {
    std::string uri;
    int bufferView = -1;
  };
  struct ElementType {
    int componentType = 0;  // TINYGLTF_COMPONENT_TYPE_*
    int components = 1;
    bool normalized = false;
  };

  void readJson(std::string_view text, std::vector<Source>& buffers);
  void readBuffers(const std::vector<Source>& sources, std::string_view binary);
  std::optional<std::filesystem::path> find(const std::string& uri);
  std::optional<std::span<const uint8_t>> viewBytes(int view) const;
  bool readSparse(const tinygltf::Accessor& accessor, const ElementType& type, std::vector<double>& values) const;
  // Calls store(i, number) for each component of `count` elements. Returns false, before the first call, if they are
  // not all there.
  template <typename Store>
  bool readElements(int view, uint64_t offset, const ElementType& type, uint64_t count, const Store& store) const;

  const std::filesystem::path& file_;
  ModelDefects& defects_;
  ModelFiles modelFiles_;
  tinygltf::Model model_;
  std::vector<Skin> skins_;
  bool hasMotion_ = false;
  uint64_t byteCount_ = 0;
  std::string text_;                               // content of the file
  std::deque<std::vector<uint8_t>> storage_;       // content of other buffers
  std::vector<std::span<const uint8_t>> buffers_;  // within these; empty: not there
  std::vector<Source> images_;
  std::set<std::filesystem::path> bufferFiles_;
  std::set<std::filesystem::path> namedFiles_;
};

// Adds the file, and the files that its buffers and pictures name, as far as they exist. Throws nothing for damaged
// files.
void addFilesOfGltf(const std::filesystem::path& file, std::set<std::filesystem::path>& files);

inline constexpr std::string_view validGltf = "a valid glTF 2.0 file is needed";  // remedy of an InputError

// Attribute of a primitive in a repaired model that names the accessor of its indices. Primitive::indices is not set.
inline constexpr const char* indicesAttribute = "indices";

inline constexpr const char* specularGlossiness = "KHR_materials_pbrSpecularGlossiness";
inline constexpr const char* unlit = "KHR_materials_unlit";
// Extensions of materials that are read, at least in part.
inline constexpr std::array<std::string_view, 4> materialExtensions{
    specularGlossiness, unlit, "KHR_materials_emissive_strength", "KHR_materials_transmission"};

inline constexpr const char* noLight = "none";  // type of a light that could not be read

// Reads the JSON of `file` by tinygltf. That library refuses a file for one object that it cannot read, and for indices
// of a primitive that it cannot find. Here such an object costs only what uses it, and counts as a defect. Factors,
// transforms and lights get the nearest numbers that they may have, or the usual ones, which counts too. `root` has
// asset.version, and no buffers, images, skins and animations. Throws InputError if it cannot be read nevertheless.
tinygltf::Model readRepaired(const std::filesystem::path& file, nlohmann::json root, ModelDefects& defects);

// Reads a glTF 2.0 file (.gltf or .glb) by tinygltf: the triangles of its default scene as one mesh, its first
// perspective camera, and its lights. Appends the textures of materials that are used to `textures`. A defect costs
// only what it touches: Mesh::defects lists each kind of defect, which is logged as a warning. Throws InputError if
// nothing is left to draw or the file cannot be read.
Model loadGltf(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

// Returns a color of a repaired model: white if the file has none.
glm::dvec3 colorOf(const std::vector<double>& values);

// Returns how a texture continues outside of its picture, to the sides and up (TINYGLTF_TEXTURE_WRAP_*).
glm::ivec2 waysToWrap(const tinygltf::Model& model, int texture);
inline constexpr glm::ivec2 clampingWays(TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);

// Where the base color's texture lies on a surface.
class TexturePlacement {
 public:
  explicit TexturePlacement(const tinygltf::TextureInfo& texture);
  const std::string& texcoords() const { return texcoords_; }  // name of the attribute
  // Returns the texture coordinate, v up, of the attribute's, v down.
  glm::dvec2 apply(const glm::dvec2& uv) const;

 private:
  std::string texcoords_;
  glm::dvec2 offset_{0.0};
  glm::dvec2 scale_{1.0};
  double rotation_ = 0.0;  // radians
};

// A node, camera or light, and the transform to the scene's space of its own or its parent's.
struct GltfPlaced {
  int index = -1;
  glm::dmat4 transform{1.0};
};

// Adds the camera, unless its index is -1, and lights of a repaired file to a model that has its mesh. The camera looks
// at the point before it that is nearest to the mesh's centre.
void addView(const std::filesystem::path& file, const tinygltf::Model& content, const GltfPlaced& camera,
             std::span<const GltfPlaced> lights, Model& model, ModelDefects& defects);

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
  void add(std::string_view kind, std::string_view detail, std::string_view reason = {}) {
    defects_.add(file_, 1, "materials", kind, detail, reason);
  }
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
