#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// Materials of the MTL files that an OBJ file names.
class ObjMaterials {
 public:
  explicit ObjMaterials(std::filesystem::path objFile) : objFile_(std::move(objFile)) {}

  // Reads an MTL file, relative to the OBJ file; a second time it does nothing. Returns false and logs a warning when
  // it is missing. Throws InputError for malformed numbers and too many materials.
  bool read(std::string_view name);
  bool isThere(std::string_view name) const;

  // Index of a material; -1, and a warning the first time, when there is none.
  int find(std::string_view name);

  // The material of an index from find(). Appends its texture to `textures` unless it is there. Throws InputError when
  // the texture cannot be read.
  Material material(int index, std::vector<Texture>& textures) const;

  // Files that were read, without symbolic links.
  const std::set<std::filesystem::path>& files() const { return filesRead_; }

 private:
  struct Entry {
    Material material;  // without its diffuse color and texture
    std::optional<glm::dvec3> diffuse;
    std::optional<double> opacity;  // d, which counts more than Tr
    double transparency = 0.0;      // Tr
    bool hasMask = false;           // map_d
    std::string diffuseTexture;
    std::filesystem::path file;
    int line = 0;         // of newmtl
    int textureLine = 0;  // of map_Kd
  };
  void readLines(const std::filesystem::path& file, std::string_view text);

  std::filesystem::path objFile_;
  std::vector<Entry> entries_;
  std::map<std::string, int, std::less<>> indices_;
  std::set<std::filesystem::path> filesRead_;
  bool missingFile_ = false;
};

}  // namespace speculum
