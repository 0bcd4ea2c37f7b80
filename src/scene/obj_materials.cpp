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
#include "scene/text_lines.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostMaterials = 10'000;  // of one file

// Returns the path relative to the MTL file's folder. Replaces backslashes, because such files often come from Windows.
fs::path relativeTo(const fs::path& file, std::string name) {
  std::ranges::replace(name, '\\', '/');
  return (file.parent_path() / name).lexically_normal();
}

Texture loadTexture(const fs::path& file, const fs::path& source) {
  const std::array<float, 256>& linear = srgbDecoded();
  const Image8 image = readImage8(file);
  Texture texture{.source = source, .width = image.width, .height = image.height};
  texture.texels.reserve(image.rgba.size() / 4);
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    texture.texels.emplace_back(linear[image.rgba[i]], linear[image.rgba[i + 1]], linear[image.rgba[i + 2]]);
  }
  return texture;
}

// Returns the number of pixels that a scene's next picture may have, given those before it. Without a bound, small
// files of few colors fill any memory.
double mostPixels(std::span<const Texture> textures) {
  double pixels = 0.0;
  for (const Texture& texture : textures) {
    pixels += static_cast<double>(texture.width) * texture.height;
  }
  constexpr double whole = 1 << 28;
  return pixels < whole ? whole : pixels < 2.0 * whole ? 1 << 20 : 1 << 12;
}

// Returns the texture with about `most` texels if it has more.
Texture bounded(Texture texture, double most) {
  const double factor = std::sqrt(most / (static_cast<double>(texture.width) * texture.height));
  if (factor >= 1.0) {
    return texture;
  }
  // A side of one texel leaves the other one more than its share.
  const int least = std::max(static_cast<int>(factor * texture.height), 1);
  const int width = std::clamp(static_cast<int>(most / least), 1, texture.width);
  const int height = std::clamp(static_cast<int>(most / width), 1, texture.height);
  Texture small = shrunk(texture, width, height);
  spdlog::warn("{}: is drawn with {}x{} texels: the textures before it have 2^28 texels or more",
               texture.source.string(), small.width, small.height);
  return small;
}

int textureIndex(const fs::path& file, std::vector<Texture>& textures) {
  const fs::path source = withoutLinks(file);
  const auto known = std::ranges::find_if(
      textures, [&](const Texture& texture) { return texture.source.native() == source.native(); });
  const auto index = static_cast<int>(known - textures.begin());
  if (known == textures.end()) {
    textures.push_back(bounded(loadTexture(file, source), mostPixels(textures)));
  }
  return index;
}

// Returns the number of words after an option of a texture, at most 3 for -o, -s and -t; -1 if the word is no option.
int wordsOf(std::string_view option) {
  constexpr std::array<std::string_view, 10> one{"-blendu", "-blendv", "-cc",      "-clamp", "-boost",
                                                 "-bm",     "-texres", "-imfchan", "-type",  "-colorspace"};
  if (option == "-o" || option == "-s" || option == "-t") {
    return 3;
  }
  return option == "-mm" ? 2 : std::ranges::find(one, option) != one.end() ? 1 : -1;
}

// Returns the file name after the options. It may hold blanks.
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

double readNumber(const LineReader& line, double value, const Range& range) {
  if (!range.contains(value)) {
    line.fail(line.keyword(), fmt::format("is {}", value), range.text());
  }
  return value;
}

// Returns a color, given by three numbers or by one for all three. Colors as spectra or CIE XYZ are left out with a
// warning.
std::optional<glm::dvec3> readColor(const fs::path& file, LineReader& line, const Range& range) {
  const std::vector<std::string_view>& tokens = line.tokens();
  if (tokens.size() > 1 && (tokens[1] == "spectral" || tokens[1] == "xyz")) {
    spdlog::warn("{}:{}: {} {} is not used (write {} r g b)", file.string(), line.number(), line.keyword(), tokens[1],
                 line.keyword());
    return std::nullopt;
  }
  const std::vector<double>& numbers = tokens.size() == 2 ? line.numbers(1, 1) : line.numbers(3, 3);
  glm::dvec3 color;
  for (size_t i = 0; i < 3; ++i) {
    color[static_cast<int>(i)] = readNumber(line, numbers[numbers.size() == 3 ? i : 0], range);
  }
  return color;
}

// Reads an opacity. With -halo, d fades with the angle, and the number behind that option counts.
double readFactor(LineReader& line) {
  const bool halo = line.tokens().size() > 1 && line.tokens()[1] == "-halo";
  return readNumber(line, line.numbers(1, 1, halo ? 2 : 1)[0], kAny);
}

}  // namespace

bool ObjMaterials::isThere(std::string_view name) const {
  return isFile(relativeTo(objFile_, std::string(name)));
}

bool ObjMaterials::read(std::string_view name) {
  const fs::path file = relativeTo(objFile_, std::string(trimmed(name)));
  if (!isFile(file)) {
    spdlog::warn("{}: there is no material file '{}', its faces get the default material", objFile_.string(),
                 file.string());
    missingFile_ = true;
    return false;
  }
  if (!filesRead_.insert(withoutLinks(file)).second) {
    return true;
  }
  readLines(file, readInputText(file, "a Wavefront MTL file is needed"));
  return true;
}

void ObjMaterials::readLines(const fs::path& file, std::string_view text) {
  const size_t before = entries_.size();
  Entry none;  // what stands above the first newmtl belongs to no material
  Entry* entry = &none;
  LineReader line(file, text, LineReader::Continuation::none);
  while (line.next()) {
    const std::string_view key = line.keyword();
    if (key == "newmtl") {
      if (entries_.size() - before == kMostMaterials) {
        line.fail("newmtl", "is one too many", fmt::format("at most {} materials are read", kMostMaterials));
      }
      entry = &entries_.emplace_back();
      entry->material.name = line.argument();
      entry->file = file;
      entry->line = line.number();
      indices_.try_emplace(entry->material.name, static_cast<int>(entries_.size()) - 1);
    } else if (key == "Kd") {
      const std::optional<glm::dvec3> color = readColor(file, line, kSurfaceColor);
      entry->diffuse = color ? color : entry->diffuse;
    } else if (key == "Ks") {
      entry->material.specular = readColor(file, line, kSurfaceColor).value_or(entry->material.specular);
    } else if (key == "Ke") {
      entry->material.emission = readColor(file, line, kRadiance).value_or(entry->material.emission);
    } else if (key == "Ns") {
      entry->material.shininess = std::clamp(readFactor(line), kLeastShininess, kMostShininess);
    } else if (key == "d") {
      entry->opacity = readFactor(line);
    } else if (key == "Tr") {
      entry->transparency = readFactor(line);
    } else if (key == "map_d") {
      entry->hasMask = entry->hasMask || !textureName(line).empty();
    } else if (key == "map_Kd") {
      if (const std::string_view name = textureName(line); !name.empty()) {
        entry->diffuseTexture = name;
        entry->textureLine = line.number();
      }
    }
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
  material.diffuse = entry.diffuse.value_or(entry.diffuseTexture.empty() ? glm::dvec3(0.0) : material.diffuse);
  if (entry.opacity.value_or(1.0 - entry.transparency) < 1.0 || entry.hasMask) {
    spdlog::warn("{}:{}: material '{}' is not opaque, it is drawn opaque", entry.file.string(), entry.line,
                 material.name);
  }
  if (!entry.diffuseTexture.empty()) {
    const fs::path picture = relativeTo(entry.file, entry.diffuseTexture);
    try {
      material.diffuseTexture = textureIndex(picture, textures);
    } catch (const FileError& error) {
      throwInputError(entry.file, entry.textureLine, "map_Kd", picture.string() + ": " + error.problem(),
                      isFile(picture) ? error.remedy() : "name a PNG or JPEG file, relative to the MTL file");
    }
  }
  return material;
}

}  // namespace speculum
