#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"

namespace speculum {

// Called now and then with the file that is being read and the finished share of all files, 0 .. 1. An exception from
// the callback ends the loading.
using LoadProgress = std::function<void(const std::filesystem::path& file, double done)>;

// Counts the defects of a model and of the files that it names, so that each kind of a file is one warning.
class ModelDefects {
 public:
  struct Kind {
    std::filesystem::path file;
    std::string key;
    std::string_view kind;
    std::string reason;
    std::string text;  // about the first defect of the kind
    size_t count = 0;
    bool costsTriangles = false;  // set this for a defect that leaves triangles out
  };

  // Counts a defect in a line of a file, from 1. `kind` is a text that outlives this object; its {} stands for
  // `detail`. Defects with different texts in `reason` are of different kinds. Those beyond the first 50 kinds count as
  // one kind. Returns the kind, which is valid until the next call.
  Kind& add(const std::filesystem::path& file, int line, std::string_view key, std::string_view kind,
            std::string_view detail = {}, std::string_view reason = {});

  // Returns one warning for each kind, `FILE:LINE: key: kind (and N more)` with the line of the kind's first defect, in
  // the order of these first defects.
  std::vector<std::string> report() const;
  // Returns the first of these warnings that is about triangles which are left out.
  std::optional<std::string> lostTriangles() const;

 private:
  std::vector<Kind> kinds_;
};

// Finds the files that a model names. Models come from other machines, so names may be in quotes, have backslashes,
// begin with a drive or folder that is not here, differ in case, or be Latin-1. If there is no such file, a '#' after a
// blank begins a comment.
class ModelFiles {
 public:
  explicit ModelFiles(const std::filesystem::path& model) : modelFolder_(model.parent_path()) {}

  // Returns the file that `name` in `namingFile` means: as named, relative to the folder of the naming file or of the
  // model; else, without regard to case, below these folders, or by its file name in these folders and in their
  // subfolders textures, tex and maps. Returns nothing if no such file exists.
  std::optional<std::filesystem::path> find(const std::filesystem::path& namingFile, std::string_view name);

  // Follows a relative path from a folder, without regard to case and to being UTF-8 or Latin-1. Returns nothing if no
  // file is there.
  std::optional<std::filesystem::path> follow(std::filesystem::path folder, const std::filesystem::path& path);

 private:
  std::optional<std::filesystem::path> findWhole(const std::filesystem::path& namingFile, std::string_view name);

  // Files and folders by their names in UTF-8 and lower case.
  struct Listing {
    std::map<std::string, std::filesystem::path> files;
    std::map<std::string, std::filesystem::path> folders;
  };
  const Listing& listing(const std::filesystem::path& folder);
  std::filesystem::path modelFolder_;
  std::map<std::filesystem::path, Listing> listings_;
};

struct ForeignFile {
  std::string wrong;  // "is a PLY file"
  std::string right;
  bool isKnown = true;  // by its beginning; else bytes anywhere in it are no text
};

// Returns what a file is and what is needed instead, if its content begins like that of a known format or is no text.
// `readAs`: the extension of the format as which it was read, ".obj" or ".gltf", which does not count; empty: neither.
std::optional<ForeignFile> foreignFile(std::string_view content, std::string_view readAs);

// A format of models. To add a format, write a loader and a row in the table of model_files.cpp.
struct ModelFormat {
  std::string_view extension;  // in lower case, with the dot
  std::string_view name;       // for messages: "Wavefront OBJ"
  // Loads a model and appends its textures to `textures`. Throws InputError if nothing is left to draw or the file
  // cannot be read.
  Model (*load)(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress);
  // Adds the file and the existing files that it names.
  void (*addFiles)(const std::filesystem::path& file, std::set<std::filesystem::path>& files);
};

// Says whether the file's extension is that of a format, in upper or lower case.
bool isModelFile(const std::filesystem::path& file);

// Loads a model by its extension; a file with an unknown extension is read as the first format. Logs a warning for each
// of its defects that none of the `others` has, which may share its material files.
Model loadModel(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {},
                std::span<const Mesh> others = {});

// Adds a model's file and the existing files that it names.
void addModelFiles(const std::filesystem::path& model, std::set<std::filesystem::path>& files);

// Returns the names of the formats, each once: "Wavefront OBJ or glTF 2.0".
std::string modelFormatNames();
// Returns the patterns for a file dialog, in lower and upper case: "*.obj *.OBJ *.gltf *.GLTF *.glb *.GLB".
std::string modelPatterns();

}  // namespace speculum
