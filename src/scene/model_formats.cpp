#include "scene/model_formats.hpp"

#include <algorithm>
#include <array>

#include "platform/text.hpp"
#include "scene/gltf_file.hpp"
#include "scene/obj_loader.hpp"

namespace speculum {

namespace {

Model loadObjModel(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress) {
  return {.mesh = loadObj(file, textures, progress)};
}

constexpr std::array formats{ModelFormat{".obj", "Wavefront OBJ", &loadObjModel, &addFilesOfObj},
                             ModelFormat{".gltf", "glTF 2.0", &loadGltf, &addFilesOfGltf},
                             ModelFormat{".glb", "glTF 2.0", &loadGltf, &addFilesOfGltf}};

const ModelFormat* formatOf(const std::filesystem::path& file) {
  const auto found = std::ranges::find(formats, lowerCase(file.extension().string()), &ModelFormat::extension);
  return found == formats.end() ? nullptr : &*found;
}

const ModelFormat& formatOrFirst(const std::filesystem::path& file) {
  const ModelFormat* format = formatOf(file);
  return format == nullptr ? formats.front() : *format;
}

}  // namespace

bool isModelFile(const std::filesystem::path& file) {
  return formatOf(file) != nullptr;
}

Model loadModel(const std::filesystem::path& file, std::vector<Texture>& textures, const LoadProgress& progress) {
  const size_t known = textures.size();
  Model model = formatOrFirst(file).load(file, textures, progress);
  for (size_t i = known; i < textures.size(); ++i) {
    if (!textures[i].shrinkage.empty()) {
      model.mesh.defects.push_back(textures[i].shrinkage);
    }
  }
  return model;
}

void addModelFiles(const std::filesystem::path& model, std::set<std::filesystem::path>& files) {
  formatOrFirst(model).addFiles(model, files);
}

std::string modelFormatNames() {
  std::string names;
  for (const ModelFormat& format : formats) {
    if (names.find(format.name) == std::string::npos) {
      names.append(names.empty() ? "" : " or ").append(format.name);
    }
  }
  return names;
}

std::string modelPatterns() {
  std::string patterns;
  for (const ModelFormat& format : formats) {
    std::string upper(format.extension);
    std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    patterns.append(patterns.empty() ? "*" : " *").append(format.extension).append(" *").append(upper);
  }
  return patterns;
}

}  // namespace speculum
