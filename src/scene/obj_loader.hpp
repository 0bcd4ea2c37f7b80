#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/materials.hpp"
#include "scene/mesh_builder.hpp"
#include "scene/model_files.hpp"

namespace speculum {

// Reads a Wavefront OBJ file with its MTL files by tinyobjloader; appends the textures that its materials name to
// `textures`. A defect costs only the elements that it touches: Mesh::defects lists each kind of defect, which is
// logged as a warning. Throws InputError if nothing is left to draw or the file cannot be read.
Mesh loadObj(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

// Adds the file, and the files that its lines or those of its MTL files may name, as far as they exist. Reads no more
// than these lines, and throws nothing for damaged files.
void addFilesOfObj(const std::filesystem::path& file, std::set<std::filesystem::path>& files);

// Calls `found` for each file that a mtllib line of the OBJ file names, in their order, and `missing` for a name of one
// word without a file. There are one or several names, with blanks or without. A backslash before a blank keeps the
// blank; any other backslash separates folders.
void forEachLibrary(ModelFiles& search, const std::filesystem::path& objFile, std::string_view names,
                    const std::function<void(const std::filesystem::path& file, std::string_view name)>& found,
                    const std::function<void(const std::string& name)>& missing);

// Adds an MTL file and the pictures that its lines name, as far as they exist.
void addFilesOfMtl(const std::filesystem::path& file, ModelFiles& search, std::set<std::filesystem::path>& files);

// Options of a texture. Its coordinates are scale * (u, v) + offset.
struct TextureOptions {
  glm::dvec2 scale{1.0};
  glm::dvec2 offset{0.0};
  bool clamps = false;
  bool operator==(const TextureOptions&) const = default;
};

// Materials of the MTL files that an OBJ file names, as tinyobjloader reads them. Faces may name a material before its
// file is named.
class ObjMaterials {
 public:
  // `objFile` and `defects` must outlive this object. A defect names a line of the OBJ file or of an MTL file.
  ObjMaterials(const std::filesystem::path& objFile, ModelDefects& defects)
      : objFile_(objFile), defects_(defects), modelFiles_(objFile) {}

  // Reads the files that a mtllib line of the OBJ file names. A file that was read is not read again.
  void read(std::string_view names, int line);

  // Returns the index of the material that a usemtl line names, for material().
  int use(std::string_view name, int line);

  // Returns the material of an index from use(), or the default material for -1 and for a name that no file defines.
  // `colored`: the model has vertex colors, and a missing Kd is 1. Appends the material's textures to
  // `textures` unless they are there already. Call this when all files are read.
  PartMaterial material(int index, bool colored, std::vector<Texture>& textures);

  // Returns the files that were read, with symbolic links resolved.
  const std::set<std::filesystem::path>& files() const { return filesRead_; }
  // Returns the files that were read, and textures, except those found by a whole path; links are not resolved.
  const std::set<std::filesystem::path>& namedFiles() const { return namedFiles_; }

 private:
  struct Entry {
    Material material;                      // without its textures
    std::map<std::string_view, int> lines;  // by key that is given
    bool has(std::string_view key) const { return lines.contains(key); }
    bool opaque = false;  // d or Tr, and illum, say so
    double metal = 0.0;
    double roughness = 0.0;
    std::string diffuseTexture;
    std::string emissionTexture;
    std::string opacityTexture;
    TextureOptions textureOptions;  // of map_Kd, or else of map_d
    TextureOptions opacityOptions;  // of map_d
    std::filesystem::path file;
    int line = 0;  // line of newmtl
  };
  struct Use {
    std::string name;
    int line = 0;
  };
  class MtlReader;

  // Says whether a name in the file is empty but for a comment, and names no file as a whole.
  bool isComment(const std::filesystem::path& file, std::string_view name);
  void readLibrary(const std::filesystem::path& file, std::string_view name, int line);
  void readMtl(const std::filesystem::path& file, std::string_view text);
  std::pair<std::string, const Entry*> entryOf(const std::string& name) const;
  // Returns read(file) for the picture that a line of the entry's file names; nothing, with a defect, if it is not
  // there or not readable.
  template <typename Read>
  auto readPicture(const Entry& entry, int line, std::string_view key, const std::string& name, const Read& read)
      -> std::optional<decltype(read(std::filesystem::path()))>;
  int opacityIndex(const Entry& entry, const std::filesystem::path& picture, const Material& material,
                   std::vector<Texture>& textures);
  void addOpacity(const Entry& entry, Material& material, std::vector<Texture>& textures);
  void applyEmissionTexture(const Entry& entry, Material& material);

  const std::filesystem::path& objFile_;
  ModelDefects& defects_;
  ModelFiles modelFiles_;
  std::map<std::string, Entry> entries_;          // by name
  std::map<std::string, std::string> bareNames_;  // names of entries by what is before a comment; empty: several
  std::vector<Use> uses_;
  std::map<std::string, int> useIndices_;  // by name
  std::set<std::filesystem::path> filesRead_;
  std::set<std::filesystem::path> namedFiles_;
  std::map<std::filesystem::path, int> opacityIndices_;  // by picture: texture of opacity, -1 if it is opaque
  MeansOfPictures means_;                                // of emission
  bool missingFile_ = false;
};

}  // namespace speculum
