#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/model_files.hpp"
#include "scene/scene.hpp"

namespace speculum {

// A format of models. To add a format, write a loader and a row in the table of model_formats.cpp.
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

// Loads a model by its extension; a file with an unknown extension is read as the first format.
Model loadModel(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

// Adds a model's file and the existing files that it names.
void addModelFiles(const std::filesystem::path& model, std::set<std::filesystem::path>& files);

// Returns the names of the formats, each once: "Wavefront OBJ or glTF 2.0".
std::string modelFormatNames();
// Returns the patterns for a file dialog, in lower and upper case: "*.obj *.OBJ *.gltf *.GLTF *.glb *.GLB".
std::string modelPatterns();

}  // namespace speculum
