#pragma once

#include <tiny_obj_loader.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/obj_scan.hpp"

namespace speculum {

// The text of a file. Throws InputError for what keeps it from being read, in terms of `line` and `key` of `from`.
std::string readText(const std::filesystem::path& file, const std::filesystem::path& from, int line,
                     std::string_view key, std::string_view right);

// Reads the MTL files that an OBJ file names, relative to its folder.
class ObjMaterials : public tinyobj::MaterialReader {
 public:
  explicit ObjMaterials(std::filesystem::path objFile) : objFile_(std::move(objFile)) {}

  // Called by the parser for each file. A missing one is a warning; throws InputError for malformed numbers.
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* indices, std::string* warning, std::string* error) override;

  // Index of a material, -1 and a warning (once a name) when there is none.
  int find(std::string_view name);

  // Of an index from find(). Loads its texture unless `textures` has it. Throws InputError when it cannot be read.
  Material material(int index, std::vector<Texture>& textures) const;

 private:
  struct Entry {
    tinyobj::material_t source;
    std::filesystem::path file;
    MtlLines lines;
  };

  std::filesystem::path objFile_;
  std::vector<Entry> entries_;
  std::map<std::string, int, std::less<>> indices_;
  std::set<std::filesystem::path> read_;
  bool missingFile_ = false;
};

}  // namespace speculum
