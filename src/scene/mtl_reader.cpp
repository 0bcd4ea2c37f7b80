#include <spdlog/fmt/fmt.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/gtx/component_wise.hpp>
#include <limits>
#include <sstream>
#include <utility>

#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/obj_loader.hpp"
#include "scene/text_lines.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

constexpr double usualDiffuse = 0.8;  // Kd of a material without one and without a texture

// A key that is read. Of a color, `usual` stands for numbers that are missing or out of range.
struct MtlKey {
  std::string_view name;  // in its usual case
  enum { color, number, texture } form;
  Range range{};
  double usual = 0.0;
};

constexpr std::array mtlKeys{MtlKey{"Kd", MtlKey::color, surfaceColorRange, usualDiffuse},
                             MtlKey{"Ks", MtlKey::color, surfaceColorRange},
                             MtlKey{"Ke", MtlKey::color, radianceRange},
                             MtlKey{"Ns", MtlKey::number},
                             MtlKey{"Pr", MtlKey::number, unitRange},
                             MtlKey{"Pm", MtlKey::number, unitRange},
                             MtlKey{"d", MtlKey::number},
                             MtlKey{"Tr", MtlKey::number},
                             MtlKey{"illum", MtlKey::number},
                             MtlKey{"map_Kd", MtlKey::texture},
                             MtlKey{"map_Ke", MtlKey::texture},
                             MtlKey{"map_d", MtlKey::texture}};

bool isSwitch(std::string_view word) {
  return word == "on" || word == "off";
}

bool isNumber(std::string_view word) {
  return parseNumber(word).has_value();
}

// Options of a texture. The words behind one, `most` at most, are its own as far as they have its form.
struct TextureOption {
  std::string_view names;  // between blanks
  int most;
  bool (*fits)(std::string_view word);  // in lower case
};

constexpr std::array textureOptions{
    TextureOption{" -s -o -t ", 3, isNumber},
    TextureOption{" -mm ", 2, isNumber},
    TextureOption{" -bm -boost -texres ", 1, isNumber},
    TextureOption{" -clamp -cc -blendu -blendv ", 1, isSwitch},
    TextureOption{" -imfchan ", 1,
                  [](std::string_view word) {
                    return word.size() == 1 && std::string_view("rgbmlz").find(word) != std::string_view::npos;
                  }},
    TextureOption{" -type ", 1, [](std::string_view word) { return word == "sphere" || word.starts_with("cube_"); }},
    TextureOption{" -colorspace ", 1,
                  [](std::string_view word) { return word[0] != '-' && word.find('.') == std::string_view::npos; }}};

const TextureOption* optionOf(std::string_view token) {
  const std::string word = " " + lowerCase(std::string(token)) + " ";
  const auto found = std::ranges::find_if(
      textureOptions, [&](const TextureOption& option) { return option.names.find(word) != std::string_view::npos; });
  return found == textureOptions.end() ? nullptr : &*found;
}

// Reads options from tokens[i] on, of which -s, -o and -clamp count. Returns the index of the token behind them.
size_t readOptions(const std::vector<std::string_view>& tokens, size_t i, TextureOptions& options) {
  constexpr Range range{.low = -1e9, .high = 1e9};
  while (i < tokens.size()) {
    const TextureOption* option = optionOf(tokens[i]);
    if (option == nullptr) {
      break;
    }
    const std::string name = lowerCase(std::string(tokens[i++]));
    for (int word = 0; word < option->most && i < tokens.size(); ++word, ++i) {
      const std::string text = lowerCase(std::string(tokens[i]));
      if (!option->fits(text)) {
        break;
      }
      const double value = parseNumber(text).value_or(0.0);
      if (word < 2 && range.contains(value) && (name == "-s" || name == "-o")) {
        (name == "-s" ? options.scale : options.offset)[word] = value;
      }
      options.clamps = name == "-clamp" ? text == "on" : options.clamps;
    }
  }
  return i;
}

struct NamedTexture {
  std::string_view name;
  TextureOptions options;
  std::string_view unknown;  // an option before the name that is not known
};

// Reads the name, which may hold blanks, and the options before it. If there is no such file, takes a word with a dash
// in front for an unknown option, and options behind the name for what they are, if that leaves the name of a file.
NamedTexture namedTexture(const LineReader& line, const std::function<bool(std::string_view)>& isFile) {
  constexpr size_t mostWords = 4;  // of an unknown option
  const std::vector<std::string_view>& tokens = line.tokens();
  NamedTexture usual;
  const size_t first = readOptions(tokens, 1, usual.options);
  usual.name = line.after(tokens[first - 1]);
  const auto behind = std::find_if(tokens.begin() + static_cast<std::ptrdiff_t>(std::min(first + 1, tokens.size())),
                                   tokens.end(), [](std::string_view token) { return optionOf(token) != nullptr; });
  const bool dashed = first < tokens.size() && tokens[first].starts_with('-');
  if ((!dashed && behind == tokens.end()) || isFile(usual.name)) {
    return usual;
  }
  NamedTexture other = usual;
  if (behind != tokens.end()) {
    other.name = trimmed(usual.name.substr(0, behind->data() - usual.name.data()));
    const size_t end = readOptions(tokens, static_cast<size_t>(behind - tokens.begin()), other.options);
    if (end == tokens.size() && isFile(other.name)) {
      return other;
    }
  }
  for (size_t i = first + 1; dashed && i < tokens.size() && i <= first + mostWords; ++i) {
    other = usual;
    other.unknown = tokens[first];
    other.name = line.after(tokens[readOptions(tokens, i, other.options) - 1]);
    if (isFile(other.name)) {
      return other;
    }
  }
  return usual;
}

double numberOf(std::string_view token) {
  return parseNumber(token).value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

// Reads an MTL file. Each material is a text of its own for tinyobjloader, because the library keeps what the material
// before it has set. Lines are put into the form that the library reads as meant: keys in their usual case, no
// comments, colors of three numbers, numbers in their range, and a texture's name without options before it.
class ObjMaterials::MtlReader {
 public:
  MtlReader(ObjMaterials& materials, const fs::path& file, std::string_view text)
      : materials_(materials), file_(file), line_(text, LineReader::Continuation::none) {}

  void read() {
    constexpr int mostMaterials = 10'000;
    int count = 0;
    while (line_.next()) {
      const std::string key = lowerCase(std::string(line_.keyword()));
      if (key == "newmtl") {
        finishMaterial();
        if (++count > mostMaterials) {
          add("newmtl", "is one too many, 10000 materials of a file are read");
          return;
        }
        name_ = utf8(line_.argument());
        entry_.emplace();
        entry_->file = file_;
        entry_->line = line_.number();
      } else if (entry_) {  // what stands above the first newmtl belongs to no material
        readLine(key);
      }
    }
    finishMaterial();
  }

 private:
  void add(std::string_view key, std::string_view kind, std::string_view detail = {}) {
    materials_.defects_.add(file_, line_.number(), key, kind, detail);
  }

  void readLine(const std::string& keyword) {
    const auto isKeyword = [&](const MtlKey& key) { return lowerCase(std::string(key.name)) == keyword; };
    const auto key = std::ranges::find_if(mtlKeys, isKeyword);
    if (key == mtlKeys.end()) {
      addLeftOut(keyword);
    } else if (key->form == MtlKey::color    ? readColor(*key)
               : key->form == MtlKey::number ? readNumber(*key)
                                             : readTexture(*key)) {
      entry_->lines[key->name] = line_.number();
    }
  }

  // Counts a key that is not read, unless it changes nothing: a number of 0, or a texture without a name.
  void addLeftOut(const std::string& key) {
    constexpr std::array<std::string_view, 3> numbers{"ps", "pc", "aniso"};
    constexpr std::array<std::string_view, 12> textures{"map_ks",   "map_ns", "map_pr", "map_pm", "map_ps", "map_pc",
                                                        "map_bump", "bump",   "norm",   "disp",   "decal",  "refl"};
    constexpr std::array<std::string_view, 8> withoutPart{"ka",  "map_ka", "ni",        "tf",
                                                          "pcr", "anisor", "sharpness", "map_aat"};
    const auto isOf = [&](const auto& keys) { return std::ranges::find(keys, key) != keys.end(); };
    const bool isOfNumbers = isOf(numbers);
    if (isOfNumbers || isOf(textures)) {
      const bool isEmpty = isOfNumbers ? line_.tokens().size() > 1 && numberOf(line_.tokens()[1]) == 0.0
                                       : materials_.isComment(file_, textureOfLine().name);
      if (!isEmpty) {
        add(line_.keyword(), "is not read, the material is drawn without it");
      }
    } else if (!isOf(withoutPart)) {
      add("newmtl", "'{}' is no known key, it is left out", line_.keyword());
    }
  }

  // Colors as spectra or CIE XYZ are left out. One number counts for all three.
  bool readColor(const MtlKey& key) {
    const std::vector<std::string_view>& tokens = line_.tokens();
    if (tokens.size() < 2 || tokens[1] == "spectral" || tokens[1] == "xyz") {
      add(key.name, "is not three numbers, it is left out");
      return false;
    }
    text_ += key.name;
    for (size_t i = 1; i <= 3; ++i) {
      const size_t token = tokens.size() == 2 ? 1 : i;
      const double value = token < tokens.size() ? numberOf(tokens[token]) : std::nan("");
      if (!key.range.contains(value)) {
        add(key.name, "is not three numbers in range, the usual value stands for the others");
      }
      text_ += fmt::format(" {}", key.range.contains(value) ? value : key.usual);
    }
    text_ += '\n';
    return true;
  }

  // With -halo, d fades with the angle, and the number behind that option counts. Of a number out of range, the nearest
  // one in range counts.
  bool readNumber(const MtlKey& key) {
    const std::vector<std::string_view>& tokens = line_.tokens();
    const size_t at = tokens.size() > 1 && tokens[1] == "-halo" ? 2 : 1;
    const double value = at < tokens.size() ? numberOf(tokens[at]) : std::nan("");
    if (!std::isfinite(value)) {
      add(key.name, "is not a finite number, it is left out");
      return false;
    }
    if (!key.range.contains(value)) {
      add(key.name, "is out of range, the nearest number in range counts");
    }
    text_ += fmt::format("{} {}\n", key.name, std::clamp(value, key.range.low, key.range.high));
    return true;
  }

  NamedTexture textureOfLine() {
    return namedTexture(line_,
                        [&](std::string_view name) { return materials_.modelFiles_.find(file_, name).has_value(); });
  }

  bool readTexture(const MtlKey& key) {
    const auto [name, options, unknown] = textureOfLine();
    if (materials_.isComment(file_, name)) {
      if (!withoutComment(line_.argument()).empty()) {
        add(key.name, "has options but names no file, it is left out");
      }
      return false;
    }
    if (!unknown.empty()) {
      add(key.name, "'{}' is no known option, it is left out", unknown);
    }
    text_.append(key.name).append(" ").append(name).append("\n");
    if (key.name != "map_Ke") {
      (key.name == "map_Kd" ? entry_->textureOptions : entry_->opacityOptions) = options;
    }
    return true;
  }

  void finishMaterial() {
    if (!entry_) {
      return;
    }
    std::istringstream stream("newmtl m\n" + std::exchange(text_, {}));
    std::map<std::string, int> indices;
    std::vector<tinyobj::material_t> read;
    tinyobj::LoadMtl(&indices, &read, &stream, nullptr, nullptr);
    const tinyobj::material_t& from = read.at(0);
    Material& material = entry_->material;
    material.name = name_;
    material.diffuse = entry_->has("Kd") ? glm::dvec3(from.diffuse[0], from.diffuse[1], from.diffuse[2])
                                         : glm::dvec3(from.diffuse_texname.empty() ? usualDiffuse : 1.0);
    material.specular = {from.specular[0], from.specular[1], from.specular[2]};
    material.emission = {from.emission[0], from.emission[1], from.emission[2]};
    material.shininess = std::clamp<double>(from.shininess, leastShininess, mostShininess);
    material.opacity = std::clamp<double>(from.dissolve, 0.0, 1.0);
    if (material.opacity == 0.0) {
      // Exporters write Tr 1 for opaque, or d 0 beside a texture of opacity.
      materials_.defects_.add(file_, entry_->line, "newmtl", "'{}' has no opacity at all, it is drawn as with d 1",
                              name_);
      material.opacity = 1.0;
    }
    constexpr std::array transparentModes{4, 6, 7, 9};  // of illum
    const bool opaqueMode = std::ranges::find(transparentModes, from.illum) == transparentModes.end();
    entry_->opaque =
        (entry_->has("d") || entry_->has("Tr")) && from.dissolve >= 1.0f && entry_->has("illum") && opaqueMode;
    entry_->opacityTexture = from.alpha_texname;
    entry_->metal = from.metallic;
    entry_->roughness = entry_->has("Pr") ? from.roughness : roughnessOf(material.shininess);
    if (from.illum >= 3 && glm::compMax(material.specular) >= 0.5 && from.shininess >= 500.0) {
      material.mirror = glm::min(material.specular, 1.0);
    }
    // A surface has one set of coordinates.
    if (!entry_->has("map_Kd")) {
      entry_->textureOptions = entry_->opacityOptions;
    } else if (entry_->has("map_d") && entry_->textureOptions != entry_->opacityOptions) {
      materials_.defects_.add(file_, entry_->lines["map_d"], "map_d",
                              "'{}' has other options than map_Kd, those of map_Kd count for both", from.alpha_texname);
    }
    material.clamps = entry_->textureOptions.clamps;
    entry_->diffuseTexture = from.diffuse_texname;
    entry_->emissionTexture = from.emissive_texname;
    std::string& whole =
        materials_.bareNames_.try_emplace(std::string(withoutQuotes(withoutComment(name_))), name_).first->second;
    whole = whole == name_ ? name_ : "";
    materials_.entries_.try_emplace(name_, std::move(*entry_));
    entry_.reset();
  }

  ObjMaterials& materials_;
  const fs::path& file_;
  LineReader line_;
  std::optional<Entry> entry_;  // the material that is being read
  std::string name_;
  std::string text_;  // for tinyobjloader
};

void ObjMaterials::readMtl(const fs::path& file, std::string_view text) {
  MtlReader(*this, file, text).read();
}

void addFilesOfMtl(const fs::path& file, ModelFiles& search, std::set<fs::path>& files) {
  if (!files.insert(file).second) {
    return;
  }
  const std::string text = readTextIfAny(file);
  for (LineReader line(text, LineReader::Continuation::none); line.next();) {
    if (lowerCase(std::string(line.keyword())).starts_with("map_")) {
      const auto find = [&](std::string_view name) { return search.find(file, name); };
      if (const auto named = find(namedTexture(line, [&](auto name) { return find(name).has_value(); }).name)) {
        files.insert(*named);
      }
    }
  }
}

}  // namespace speculum
