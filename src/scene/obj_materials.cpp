#include "scene/obj_loader.hpp"

#include <spdlog/fmt/fmt.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <limits>
#include <sstream>
#include <utility>

#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/materials.hpp"
#include "scene/text_lines.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Returns the number of words after an option of a texture, at most 3 for -o, -s and -t; -1 if the word is no option.
int wordsOf(std::string_view option) {
  constexpr std::array<std::string_view, 10> one{"-blendu", "-blendv", "-cc",      "-clamp", "-boost",
                                                 "-bm",     "-texres", "-imfchan", "-type",  "-colorspace"};
  if (option == "-o" || option == "-s" || option == "-t") {
    return 3;
  }
  return option == "-mm" ? 2 : std::ranges::find(one, option) != one.end() ? 1 : -1;
}

// Reads the name, which may hold blanks, and those of the options before it that count: -s, -o and -clamp.
std::pair<std::string_view, TextureOptions> namedTexture(const LineReader& line) {
  constexpr Range range{.low = -1e9, .high = 1e9};
  const std::vector<std::string_view>& tokens = line.tokens();
  TextureOptions options;
  size_t i = 1;
  while (i < tokens.size() && wordsOf(tokens[i]) >= 0) {
    const std::string_view option = tokens[i];
    const int most = wordsOf(tokens[i++]);
    for (int word = 0; word < most && i < tokens.size() && (most < 3 || parseNumber(tokens[i])); ++word) {
      const double value = parseNumber(tokens[i]).value_or(0.0);
      if (word < 2 && range.contains(value) && (option == "-s" || option == "-o")) {
        (option == "-s" ? options.scale : options.offset)[word] = value;
      }
      options.clamps = option == "-clamp" ? tokens[i] == "on" : options.clamps;
      ++i;
    }
  }
  return {line.after(tokens[i - 1]), options};
}

// Says whether the name is a whole path that leads to the file from everywhere on this machine.
bool isWholePathOf(const fs::path& file, const fs::path& name) {
  return name.is_absolute() && name.lexically_normal() == file;
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

  void readLine(const std::string& key) {
    if (key == "kd") {
      entry_->hasDiffuse = readColor("Kd", surfaceColorRange, usualDiffuse) || entry_->hasDiffuse;
    } else if (key == "ks") {
      readColor("Ks", surfaceColorRange, 0.0);
    } else if (key == "ke") {
      readColor("Ke", radianceRange, 0.0);
    } else if (key == "ns") {
      readNumber("Ns");
    } else if (key == "d" || key == "tr") {
      entry_->hasOpacity = readNumber(key == "d" ? "d" : "Tr") || entry_->hasOpacity;
    } else if (key == "illum") {
      entry_->hasIllum = readNumber("illum") || entry_->hasIllum;
    } else if (key == "pr" || key == "pm") {
      const bool read = readNumber(key == "pr" ? "Pr" : "Pm", Range{0.0, 1.0});
      entry_->metalRoughness = read || entry_->metalRoughness;
      entry_->hasRoughness = (read && key == "pr") || entry_->hasRoughness;
    } else if (key == "map_kd") {
      if (readTexture("map_Kd")) {
        entry_->textureLine = line_.number();
      }
    } else if (key == "map_ke") {
      if (readTexture("map_Ke")) {
        entry_->emissionLine = line_.number();
      }
    } else if (key == "map_d") {
      if (readTexture("map_d")) {
        entry_->opacityLine = line_.number();
      }
    } else {
      addLeftOut(key);
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
    const bool isNumber = isOf(numbers);
    if (isNumber || isOf(textures)) {
      const bool isEmpty = isNumber ? line_.tokens().size() > 1 && numberOf(line_.tokens()[1]) == 0.0
                                    : materials_.isComment(file_, namedTexture(line_).first);
      if (!isEmpty) {
        add(line_.keyword(), "is not read, the material is drawn without it");
      }
    } else if (!isOf(withoutPart)) {
      add("newmtl", "'{}' is no known key, it is left out", line_.keyword());
    }
  }

  // Colors as spectra or CIE XYZ are left out. One number counts for all three; `usual` stands in the place of a number
  // that is missing or out of range.
  bool readColor(const char* key, const Range& range, double usual) {
    const std::vector<std::string_view>& tokens = line_.tokens();
    if (tokens.size() < 2 || tokens[1] == "spectral" || tokens[1] == "xyz") {
      add(key, "is not three numbers, it is left out");
      return false;
    }
    text_ += key;
    for (size_t i = 1; i <= 3; ++i) {
      const size_t token = tokens.size() == 2 ? 1 : i;
      const double value = token < tokens.size() ? numberOf(tokens[token]) : std::nan("");
      if (!range.contains(value)) {
        add(key, "is not three numbers in range, the usual value stands for the others");
      }
      text_ += fmt::format(" {}", range.contains(value) ? value : usual);
    }
    text_ += '\n';
    return true;
  }

  // With -halo, d fades with the angle, and the number behind that option counts. Of a number out of range, the nearest
  // one in range counts.
  bool readNumber(const char* key, const std::optional<Range>& range = {}) {
    const std::vector<std::string_view>& tokens = line_.tokens();
    const size_t at = tokens.size() > 1 && tokens[1] == "-halo" ? 2 : 1;
    double value = at < tokens.size() ? numberOf(tokens[at]) : std::nan("");
    if (!std::isfinite(value)) {
      add(key, "is not a finite number, it is left out");
      return false;
    }
    if (range && !range->contains(value)) {
      add(key, "is out of range, the nearest number in range counts");
      value = std::clamp(value, range->low, range->high);
    }
    text_ += fmt::format("{} {}\n", key, value);
    return true;
  }

  bool readTexture(const char* key) {
    const auto [name, options] = namedTexture(line_);
    if (materials_.isComment(file_, name)) {
      return false;
    }
    text_.append(key).append(" ").append(name).append("\n");
    if (std::string_view(key) != "map_Ke") {
      (std::string_view(key) == "map_Kd" ? entry_->textureOptions : entry_->opacityOptions) = options;
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
    material.diffuse = entry_->hasDiffuse ? glm::dvec3(from.diffuse[0], from.diffuse[1], from.diffuse[2])
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
    entry_->opaque = entry_->hasOpacity && from.dissolve >= 1.0f && entry_->hasIllum && opaqueMode;
    entry_->opacityTexture = from.alpha_texname;
    entry_->metal = from.metallic;
    entry_->roughness = entry_->hasRoughness ? from.roughness : roughnessOf(material.shininess);
    if (from.illum >= 3 && glm::compMax(material.specular) >= 0.5 && from.shininess >= 500.0) {
      material.mirror = glm::min(material.specular, 1.0);
    }
    // A surface has one set of coordinates.
    if (entry_->textureLine == 0) {
      entry_->textureOptions = entry_->opacityOptions;
    } else if (entry_->opacityLine != 0 && entry_->textureOptions != entry_->opacityOptions) {
      materials_.defects_.add(file_, entry_->opacityLine, "map_d",
                              "'{}' has other options than map_Kd, those of map_Kd count for both", from.alpha_texname);
    }
    material.clamps = entry_->textureOptions.clamps;
    entry_->diffuseTexture = from.diffuse_texname;
    entry_->emissionTexture = from.emissive_texname;
    std::string& whole = materials_.bareNames_.try_emplace(std::string(withoutComment(name_)), name_).first->second;
    whole = whole == name_ ? name_ : "";
    materials_.entries_.try_emplace(name_, std::move(*entry_));
    entry_.reset();
  }

  static constexpr double usualDiffuse = 0.8;  // Kd of a material without one and without a texture

  ObjMaterials& materials_;
  const fs::path& file_;
  LineReader line_;
  std::optional<Entry> entry_;  // the material that is being read
  std::string name_;
  std::string text_;  // for tinyobjloader
};

void forEachLibrary(ModelFiles& search, const fs::path& objFile, std::string_view names,
                    const std::function<void(const fs::path& file, std::string_view name)>& found,
                    const std::function<void(const std::string& name)>& missing) {
  constexpr size_t mostWords = 8;  // of a name
  constexpr std::string_view blanks = " \t";
  const auto isMtl = [](const std::string& name) { return lowerCase(name).ends_with(".mtl"); };
  const auto isThere = [&](std::string_view name) {
    const std::optional<fs::path> file = search.find(objFile, name);
    if (file) {
      found(*file, name);
    }
    return file.has_value();
  };
  const std::string_view bare = withoutComment(names);
  if ((bare.empty() || names.find_first_of(blanks) != std::string_view::npos) && isThere(names)) {
    return;
  }
  names = bare;
  std::vector<std::string> words(1);
  for (size_t i = 0; i < names.size(); ++i) {
    if (blanks.find(names[i]) != std::string_view::npos) {
      words.emplace_back();
    } else {
      i += names.substr(i).starts_with("\\ ");
      words.back() += names[i];
    }
  }
  std::erase(words, "");
  // A name is one word, or has blanks up to a word that ends like a material file.
  for (size_t first = 0, end = 0; first < words.size(); first = end) {
    std::string name;
    bool named = false;
    for (end = first; end < std::min(words.size(), first + mostWords) && !named && !isMtl(name); ++end) {
      name += (name.empty() ? "" : " ") + words[end];
      named = (end == first || isMtl(name)) && isThere(name);
    }
    if (!named) {
      end = first + 1;
      missing(words[first]);
    }
  }
}

void addFilesOfMtl(const fs::path& file, ModelFiles& search, std::set<fs::path>& files) {
  if (!files.insert(file).second) {
    return;
  }
  const std::string text = readTextIfAny(file);
  for (LineReader line(text, LineReader::Continuation::none); line.next();) {
    if (lowerCase(std::string(line.keyword())).starts_with("map_")) {
      if (const std::optional<fs::path> named = search.find(file, namedTexture(line).first)) {
        files.insert(*named);
      }
    }
  }
}

void ObjMaterials::read(std::string_view names, int line) {
  forEachLibrary(
      modelFiles_, objFile_, names, [&](const fs::path& file, std::string_view name) { readLibrary(file, name, line); },
      [&](const std::string& name) {
        defects_.add(objFile_, line, "mtllib", "there is no file '{}', its faces get the default material", name);
        missingFile_ = true;
      });
}

bool ObjMaterials::isComment(const fs::path& file, std::string_view name) {
  return withoutComment(name).empty() && !modelFiles_.find(file, name);
}

void ObjMaterials::readLibrary(const fs::path& file, std::string_view name, int line) {
  if (!isWholePathOf(file, trimmed(name))) {
    namedFiles_.insert(file);
  }
  if (!filesRead_.insert(withoutLinks(file)).second) {
    return;
  }
  try {
    const std::string text = readText(file);
    if (isUtf16(text)) {
      throw FileError(file, "is UTF-16 text", "save it as UTF-8");
    }
    MtlReader(*this, file, text).read();
  } catch (const FileError& error) {
    defects_.add(objFile_, line, "mtllib", "{}, its faces get the default material", error.what());
    missingFile_ = true;
  }
}

int ObjMaterials::use(std::string_view name, int line) {
  const auto [known, isNew] = useIndices_.try_emplace(utf8(name), static_cast<int>(uses_.size()));
  if (isNew) {
    uses_.push_back({known->first, line});
  }
  return known->second;
}

PartMaterial ObjMaterials::material(int index, bool colored, std::vector<Texture>& textures) {
  Material usual;
  usual.diffuse = colored ? glm::dvec3(1.0) : usual.diffuse;
  if (index < 0) {
    return usual;
  }
  const Use& use = uses_[index];
  const auto [name, found] = entryOf(use.name);
  if (found == nullptr) {
    if (!missingFile_) {
      defects_.add(objFile_, use.line, "usemtl", "there is no material '{}', its faces get the default one", use.name);
    }
    return usual;
  }
  const Entry& entry = *found;
  Material material = entry.material;
  material.name = name;
  material.diffuse = colored && !entry.hasDiffuse ? glm::dvec3(1.0) : material.diffuse;
  if (!entry.diffuseTexture.empty()) {
    const auto load = [&](const fs::path& picture) { return textureIndex(picture, textures); };
    material.diffuseTexture = readPicture(entry, entry.textureLine, "map_Kd", entry.diffuseTexture, load).value_or(-1);
  }
  if (entry.metalRoughness) {
    const glm::dvec3 mean = material.diffuseTexture < 0 ? glm::dvec3(1.0) : textures[material.diffuseTexture].mean;
    setMetalRoughness(material, material.diffuse, entry.metal, entry.roughness, mean);
  }
  if (!entry.emissionTexture.empty()) {
    applyEmissionTexture(entry, material);
  }
  addOpacity(entry, material, textures);
  if (material.isTransparent()) {
    material.mirror.reset();
  }
  return {material, entry.textureOptions.scale, entry.textureOptions.offset};
}

// Finds a material by a whole name, or by the name before a comment in either line. Returns the name that is common.
std::pair<std::string, const ObjMaterials::Entry*> ObjMaterials::entryOf(const std::string& name) const {
  const std::string bare(withoutComment(name));
  for (const std::string& known : {name, bare}) {
    if (const auto entry = entries_.find(known); entry != entries_.end()) {
      return {known, &entry->second};
    }
  }
  const auto commented = bareNames_.find(bare);
  const bool isOne = commented != bareNames_.end() && !commented->second.empty() && !bare.empty();
  return {bare, isOne ? &entries_.at(commented->second) : nullptr};
}

template <typename Read>
auto ObjMaterials::readPicture(const Entry& entry, int line, std::string_view key, const std::string& name,
                               const Read& read) -> std::optional<decltype(read(fs::path()))> {
  const std::optional<fs::path> picture = modelFiles_.find(entry.file, name);
  if (!picture) {
    defects_.add(entry.file, line, key, "there is no file '{}', the texture is left out", name);
    return std::nullopt;
  }
  if (!isWholePathOf(*picture, name) && namedFiles_.contains(entry.file)) {
    namedFiles_.insert(*picture);
  }
  try {
    return read(*picture);
  } catch (const FileError& error) {
    defects_.add(entry.file, line, key, "{}, the texture is left out", error.what(), error.problem());
    return std::nullopt;
  }
}

// Returns the index of the texture of map_d; -1 if it is opaque. A picture without alpha that gives the color too is
// named by exporters that write both lines for every texture: its red is not meant.
int ObjMaterials::opacityIndex(const Entry& entry, const fs::path& picture, const Material& material,
                               std::vector<Texture>& textures) {
  const fs::path source = withoutLinks(picture);
  if (material.diffuseTexture >= 0 && textures[material.diffuseTexture].source.native() == source.native()) {
    const Texture& colors = textures[material.diffuseTexture];
    if (!colors.hasAlpha) {
      defects_.add(entry.file, entry.opacityLine, "map_d", "'{}' is that of map_Kd and has no alpha, it is left out",
                   entry.opacityTexture);
    }
    return colors.opacity.empty() ? -1 : material.diffuseTexture;
  }
  auto known = opacityIndices_.find(source);
  if (known == opacityIndices_.end()) {
    known = opacityIndices_.emplace(source, opacityTextureIndex(picture, textures).value_or(-1)).first;
  }
  if (known->second < 0) {
    filesRead_.insert(source);
  }
  return known->second;
}

// Adds the opacity of map_d, or else the alpha of the diffuse texture. That alpha does not count if the material says
// that it is opaque: exporters that mean opacity write map_d too. An opaque material whose texture is a cut-out becomes
// a cut-out.
void ObjMaterials::addOpacity(const Entry& entry, Material& material, std::vector<Texture>& textures) {
  if (!entry.opacityTexture.empty()) {
    const auto load = [&](const fs::path& picture) { return opacityIndex(entry, picture, material, textures); };
    material.opacityTexture = readPicture(entry, entry.opacityLine, "map_d", entry.opacityTexture, load).value_or(-1);
  } else if (!entry.opaque && material.diffuseTexture >= 0 && !textures[material.diffuseTexture].opacity.empty()) {
    material.opacityTexture = material.diffuseTexture;
  }
  if (material.opacityTexture >= 0 && !isSeen(textures[material.opacityTexture])) {
    defects_.add(entry.file, entry.line, "newmtl", "'{}' has a texture without any opacity, it is drawn as opaque",
                 material.name);
    material.opacityTexture = -1;
  }
  if (material.opacity == 1.0 && material.opacityTexture >= 0 && isCutOut(textures[material.opacityTexture])) {
    material.cutoff = 0.5;
  }
}

// Emission has one color on a surface: the texture's mean multiplies it. Exporters write Ke 0 beside a texture.
void ObjMaterials::applyEmissionTexture(const Entry& entry, Material& material) {
  const auto mean =
      readPicture(entry, entry.emissionLine, "map_Ke", entry.emissionTexture, [&](const fs::path& picture) {
        filesRead_.insert(withoutLinks(picture));
        return means_.of(picture).colors;
      });
  if (mean) {
    material.emission = *mean * (material.emission == glm::dvec3(0.0) ? glm::dvec3(1.0) : material.emission);
  }
}

}  // namespace speculum
