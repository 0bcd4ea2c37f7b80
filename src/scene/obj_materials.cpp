#include "scene/obj_materials.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "image/color.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "scene/input_error.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Paths in MTL files often come from Windows.
fs::path relativeTo(const fs::path& file, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return (file.parent_path() / name).lexically_normal();
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

// Number of words after an option of a texture, at most 3 for -o, -s and -t; -1 if the word is no option.
int wordsOf(std::string_view option) {
  constexpr std::array<std::string_view, 10> one{"-blendu", "-blendv", "-cc",      "-clamp", "-boost",
                                                 "-bm",     "-texres", "-imfchan", "-type",  "-colorspace"};
  if (option == "-o" || option == "-s" || option == "-t") {
    return 3;
  }
  return option == "-mm" ? 2 : std::find(one.begin(), one.end(), option) != one.end() ? 1 : -1;
}

// File name after the options, which are skipped. The name may hold blanks.
std::string_view textureName(const LineReader& line) {
  const std::vector<std::string_view>& tokens = line.tokens();
  size_t i = 1;
  while (i < tokens.size() && wordsOf(tokens[i]) >= 0) {
    const int most = wordsOf(tokens[i++]);
    for (int word = 0; word < most && i < tokens.size() && (most < 3 || parseNumber(tokens[i])); ++word) {
      ++i;
    }
  }
  return i < tokens.size() ? line.from(tokens[i]) : std::string_view();
}

double numberOf(LineReader& line) {
  const double value = line.numbers(1, 1)[0];
  if (!std::isfinite(value)) {
    line.fail(line.keyword(), "is not finite", "finite numbers are needed");
  }
  return value;
}

glm::dvec3 colorOf(LineReader& line) {
  const std::vector<double>& rgb = line.numbers(3, 3);
  for (const double value : rgb) {
    if (!std::isfinite(value)) {
      line.fail(line.keyword(), "is not finite", "finite numbers are needed");
    }
    if (value < 0.0) {
      line.fail(line.keyword(), "is negative", "colours are 0 or more");
    }
  }
  return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace

bool ObjMaterials::read(std::string_view name) {
  const fs::path file = relativeTo(objFile_, std::string(trimmed(name)));
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) {
    spdlog::warn("{}: there is no material file '{}', its faces get the default material", objFile_.string(),
                 file.string());
    missingFile_ = true;
    return false;
  }
  if (!filesRead_.insert(fs::weakly_canonical(file, ignored)).second) {
    return true;
  }
  const std::string text = readInputText(file, "a Wavefront MTL file is needed");
  LineReader line(file, text, LineReader::Continuation::none);
  Entry unnamed;  // what stands above the first material
  Entry* entry = &unnamed;
  size_t count = 0;
  while (line.next()) {
    if (line.keyword() == "newmtl") {
      constexpr size_t kMostMaterials = 10'000;
      if (++count > kMostMaterials) {
        line.fail("newmtl", "is one too many", fmt::format("at most {} materials are read", kMostMaterials));
      }
      indices_.try_emplace(std::string(line.argument()), static_cast<int>(entries_.size()));
      entry = &entries_.emplace_back();
      entry->material.name = line.argument();
      entry->file = file;
      entry->line = line.number();
    } else {
      readLine(line, *entry);
    }
  }
  return true;
}

void ObjMaterials::readLine(LineReader& line, Entry& entry) {
  const std::string_view key = line.keyword();
  if (key == "Kd") {
    entry.diffuse = colorOf(line);
  } else if (key == "Ks") {
    entry.material.specular = colorOf(line);
  } else if (key == "Ke") {
    entry.material.emission = colorOf(line);
  } else if (key == "Ns") {
    entry.material.shininess = std::max(1.0, numberOf(line));
  } else if (key == "d") {
    entry.dissolve = numberOf(line);
  } else if (key == "Tr") {
    entry.transparency = numberOf(line);
  } else if (key == "map_Kd") {
    entry.diffuseTexture = textureName(line);
    entry.textureLine = line.number();
  } else if (key == "map_d") {
    entry.dissolveTexture = textureName(line);
  }
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
  Material material = entry.material;
  // Textures are multiplied by a colour that files may leave out.
  material.diffuse = entry.diffuse.value_or(glm::dvec3(entry.diffuseTexture.empty() ? 0.0 : 0.6));
  if (entry.dissolve.value_or(1.0 - entry.transparency) < 1.0 || !entry.dissolveTexture.empty()) {
    spdlog::warn("{}:{}: material '{}' is not opaque, it is drawn opaque", entry.file.string(), entry.line,
                 material.name);
  }
  if (!entry.diffuseTexture.empty()) {
    const fs::path picture = relativeTo(entry.file, entry.diffuseTexture);
    try {
      material.diffuseTexture = textureIndex(picture, textures);
    } catch (const FileError& error) {
      throwInputError(entry.file, entry.textureLine, "map_Kd", picture.string() + ": " + error.problem(),
                      "name a PNG or JPEG file, relative to the MTL file");
    }
  }
  return material;
}

}  // namespace speculum
