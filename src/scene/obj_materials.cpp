#include "scene/obj_materials.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "image/image.hpp"
#include "platform/file_io.hpp"
#include "scene/input_error.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Paths in MTL files often come from Windows.
fs::path relativeTo(const fs::path& file, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return (file.parent_path() / name).lexically_normal();
}

// The parser's arithmetic may round the largest doubles, which are finite to the scan, to infinity.
bool allFinite(const Material& material) {
  bool finite = std::isfinite(material.shininess);
  for (int i = 0; i < 3; ++i) {
    finite = finite && std::isfinite(material.diffuse[i]) && std::isfinite(material.specular[i]) &&
             std::isfinite(material.emission[i]);
  }
  return finite;
}

// A file's fault without the advice in brackets at its end.
std::string withoutAdvice(const std::string& message) {
  return message.substr(0, message.rfind(" ("));
}

Texture loadTexture(const fs::path& file) {
  static const std::array<float, 256> linear = [] {
    std::array<float, 256> table{};
    for (size_t i = 0; i < table.size(); ++i) {
      table[i] = static_cast<float>(srgbDecode(static_cast<double>(i) / 255.0));
    }
    return table;
  }();
  const Image8 image = readImage8(file);
  Texture texture{.source = file, .width = image.width, .height = image.height};
  texture.texels.reserve(image.rgba.size() / 4);
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    texture.texels.emplace_back(linear[image.rgba[i]], linear[image.rgba[i + 1]], linear[image.rgba[i + 2]]);
  }
  return texture;
}

int textureIndex(const fs::path& file, std::vector<Texture>& textures) {
  std::error_code ignored;
  const fs::path canonical = fs::weakly_canonical(file, ignored);
  for (size_t i = 0; i < textures.size(); ++i) {
    if (fs::weakly_canonical(textures[i].source, ignored) == canonical) {
      return static_cast<int>(i);
    }
  }
  textures.push_back(loadTexture(file));
  return static_cast<int>(textures.size()) - 1;
}

}  // namespace

std::string readText(const fs::path& file, const fs::path& from, int line, std::string_view key,
                     std::string_view right) {
  try {
    const std::vector<uint8_t> bytes = readFileBytes(file);
    return std::string(bytes.begin(), bytes.end());
  } catch (const std::runtime_error& error) {
    throwInputError(from, line, key, withoutAdvice(error.what()), right);
  }
}

bool ObjMaterials::operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                              std::map<std::string, int>* indices, std::string* warning, std::string* error) {
  const fs::path file = relativeTo(objFile_, std::string(trimmed(name)));
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    spdlog::warn("{}: there is no material file '{}', its faces get the default material", objFile_.string(),
                 file.string());
    missingFile_ = true;
    return false;
  }
  // Materials multiply when many lines name one file.
  if (!read_.insert(fs::weakly_canonical(file, ignored)).second) {
    return true;
  }
  const std::string text = readText(file, file, 1, "file", "a Wavefront MTL file is needed");
  const MtlScan scan = scanMtl(file, text);
  const size_t first = materials->size();
  std::istringstream stream(scan.text);
  tinyobj::LoadMtl(indices, materials, &stream, warning, error);
  for (size_t i = first; i < materials->size(); ++i) {
    const tinyobj::material_t& material = (*materials)[i];
    const std::string key(trimmed(material.name));
    const auto found = scan.lines.find(key);
    indices_.try_emplace(key, static_cast<int>(entries_.size()));
    entries_.push_back({material, file, found == scan.lines.end() ? MtlLines{} : found->second});
  }
  return true;
}

int ObjMaterials::find(std::string_view name) {
  const std::string_view key = trimmed(name);
  const auto found = indices_.find(key);
  if (found != indices_.end()) {
    return found->second;
  }
  if (!missingFile_) {
    spdlog::warn("{}: there is no material '{}', its faces get the default material", objFile_.string(), key);
  }
  indices_.emplace(std::string(key), -1);
  return -1;
}

Material ObjMaterials::material(int index, std::vector<Texture>& textures) const {
  if (index < 0) {
    return {};
  }
  const Entry& entry = entries_[index];
  const tinyobj::material_t& source = entry.source;
  Material material{.name = source.name,
                    .diffuse = {source.diffuse[0], source.diffuse[1], source.diffuse[2]},
                    .specular = {source.specular[0], source.specular[1], source.specular[2]},
                    .emission = {source.emission[0], source.emission[1], source.emission[2]},
                    .shininess = std::max(1.0, static_cast<double>(source.shininess))};
  if (!allFinite(material)) {
    throwInputError(entry.file, std::max(1, entry.lines.newmtl), "newmtl", "has a number that is out of range",
                    "numbers that a double can hold are needed");
  }
  if (source.dissolve < 1.0 || !source.alpha_texname.empty()) {
    spdlog::warn("{}:{}: material '{}' is not opaque, it is drawn opaque", entry.file.string(), entry.lines.newmtl,
                 source.name);
  }
  if (!source.diffuse_texname.empty()) {
    try {
      material.diffuseTexture = textureIndex(relativeTo(entry.file, source.diffuse_texname), textures);
    } catch (const std::runtime_error& error) {
      throwInputError(entry.file, std::max(1, entry.lines.mapKd), "map_Kd", withoutAdvice(error.what()),
                      "name a PNG or JPEG file, relative to the MTL file");
    }
  }
  return material;
}

}  // namespace speculum
