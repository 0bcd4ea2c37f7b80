#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/obj_loader.hpp"

namespace speculum {

// A format of models. A new one is a loader and its line in the table of model_formats.cpp.
struct ModelFormat {
  std::string_view extension;  // in lower case, with the dot
  std::string_view name;       // for messages: "Wavefront OBJ"
  // Appends the model's textures. Throws InputError if nothing is left to draw or the file cannot be read.
  Mesh (*load)(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress);
};

// Says whether the file's extension is that of a format, in any case.
bool isModelFile(const std::filesystem::path& file);

// Loads a model by its extension; a file with another one is read as the first format.
Mesh loadModel(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress = {});

// Names of the formats: "Wavefront OBJ".
std::string modelFormatNames();
// Patterns of a file dialog, in lower and upper case: "*.obj *.OBJ".
std::string modelPatterns();

}  // namespace speculum
