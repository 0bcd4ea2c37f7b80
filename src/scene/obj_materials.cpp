#include "scene/obj_materials.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <sstream>

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

// Returns the path relative to the MTL file's folder. Replaces backslashes, because such files often come from Windows.
fs::path relativeTo(const fs::path& file, std::string name) {
  std::ranges::replace(name, '\\', '/');
  return (file.parent_path() / name).lexically_normal();
}

Texture loadTexture(const fs::path& file) {
  const std::array<float, 256>& linear = srgbDecoded();
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

// Returns a number for the parser, whose arithmetic overflows on 1e2147483648.
std::string checkedNumber(const LineReader& line, double value, const Range& range) {
  if (!range.contains(value)) {
    line.fail(line.keyword(), fmt::format("is {}", value), range.text());
  }
  // No number of a material makes a difference beyond; the parser rounds the largest doubles to infinity.
  return ' ' + fmt::to_string(std::clamp(value, -1e38, 1e38));
}

// Returns the line of a color, given by three numbers or by one for all three. Colors as spectra or CIE XYZ are left
// out with a warning.
std::string checkedColor(const fs::path& file, LineReader& line, const Range& range) {
  const std::vector<std::string_view>& tokens = line.tokens();
  if (tokens.size() > 1 && (tokens[1] == "spectral" || tokens[1] == "xyz")) {
    spdlog::warn("{}:{}: {} {} is not used (write {} r g b)", file.string(), line.number(), line.keyword(), tokens[1],
                 line.keyword());
    return {};
  }
  const std::vector<double>& numbers = tokens.size() == 2 ? line.numbers(1, 1) : line.numbers(3, 3);
  std::string text(line.keyword());
  for (size_t i = 0; i < 3; ++i) {
    text += checkedNumber(line, numbers[numbers.size() == 3 ? i : 0], range);
  }
  return text;
}

// Returns the line of a number. With -halo, d fades with the angle; its number counts.
std::string checkedFactor(LineReader& line) {
  const bool halo = line.tokens().size() > 1 && line.tokens()[1] == "-halo";
  return std::string(line.keyword()) + checkedNumber(line, line.numbers(1, 1, halo ? 2 : 1)[0], kAny);
}

struct MaterialLines {
  int newmtl = 0;
  int mapKd = 0;
};

struct CheckedMtl {
  std::string text;                            // for the parser: the lines that are used, without comments and options
  std::map<std::string, MaterialLines> lines;  // by material, the last one of a name
};

CheckedMtl checkMtl(const fs::path& file, std::string_view text) {
  // The parser keeps some kilobytes for each material.
  constexpr size_t kMostMaterials = 10'000;
  CheckedMtl checked;
  MaterialLines* current = nullptr;
  size_t count = 0;
  LineReader line(file, text, LineReader::Continuation::none);
  while (line.next()) {
    const std::string_view key = line.keyword();
    const bool color = key == "Kd" || key == "Ks" || key == "Ke";
    if (color) {
      checked.text.append(checkedColor(file, line, key == "Ke" ? kRadiance : kSurfaceColor));
    } else if (key == "Ns" || key == "d" || key == "Tr") {
      checked.text.append(checkedFactor(line));
    } else if (key == "newmtl") {
      if (++count > kMostMaterials) {
        line.fail("newmtl", "is one too many", fmt::format("at most {} materials are read", kMostMaterials));
      }
      current = &checked.lines[std::string(line.argument())];
      current->newmtl = line.number();
      checked.text.append("newmtl ").append(line.argument());
    } else if (key == "map_Kd" || key == "map_d") {
      checked.text.append(key).append(" ").append(textureName(line));
      if (key == "map_Kd" && current != nullptr) {
        current->mapKd = line.number();
      }
    }
    checked.text.push_back('\n');
  }
  return checked;
}

// Converts everything but the texture.
Material materialOf(const tinyobj::material_t& source) {
  const auto color = [](const tinyobj::real_t(&rgb)[3]) { return glm::dvec3(rgb[0], rgb[1], rgb[2]); };
  return {.name = source.name,
          .diffuse = color(source.diffuse),
          .specular = color(source.specular),
          .emission = color(source.emission),
          .shininess = std::clamp(static_cast<double>(source.shininess), kLeastShininess, kMostShininess)};
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
  std::error_code ignored;
  if (!filesRead_.insert(fs::weakly_canonical(file, ignored)).second) {
    return true;
  }
  const CheckedMtl checked = checkMtl(file, readInputText(file, "a Wavefront MTL file is needed"));
  std::vector<tinyobj::material_t> materials;
  std::map<std::string, int> indices;
  std::string warning;
  std::string error;
  std::istringstream stream(checked.text);
  tinyobj::LoadMtl(&indices, &materials, &stream, &warning, &error);
  for (const tinyobj::material_t& source : materials) {
    const std::string key(trimmed(source.name));
    const auto found = checked.lines.find(key);
    const MaterialLines lines = found == checked.lines.end() ? MaterialLines{} : found->second;
    indices_.try_emplace(key, static_cast<int>(entries_.size()));
    entries_.push_back({materialOf(source), source.dissolve >= 1.0 && source.alpha_texname.empty(),
                        source.diffuse_texname, file, lines.newmtl, lines.mapKd});
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
  Material material = entry.material;
  if (!entry.opaque) {
    spdlog::warn("{}:{}: material '{}' is not opaque, it is drawn opaque", entry.file.string(), entry.line,
                 material.name);
  }
  if (!entry.diffuseTexture.empty()) {
    const fs::path picture = relativeTo(entry.file, entry.diffuseTexture);
    try {
      material.diffuseTexture = textureIndex(picture, textures);
    } catch (const FileError& error) {
      throwInputError(entry.file, std::max(1, entry.textureLine), "map_Kd", picture.string() + ": " + error.problem(),
                      "name a PNG or JPEG file, relative to the MTL file");
    }
  }
  return material;
}

}  // namespace speculum
