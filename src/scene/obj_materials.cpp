#include "scene/obj_loader.hpp"

#include <algorithm>
#include <utility>

#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/materials.hpp"
#include "scene/text_lines.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Says whether the name is a whole path that leads to the file from everywhere on this machine.
bool isWholePathOf(const fs::path& file, const fs::path& name) {
  return name.is_absolute() && name.lexically_normal() == file;
}

}  // namespace

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
    readMtl(file, text);
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
  material.diffuse = colored && !entry.has("Kd") ? glm::dvec3(1.0) : material.diffuse;
  if (!entry.diffuseTexture.empty()) {
    const auto load = [&](const fs::path& picture) { return textureIndex(picture, textures); };
    material.diffuseTexture =
        readPicture(entry, entry.lines.at("map_Kd"), "map_Kd", entry.diffuseTexture, load).value_or(-1);
  }
  if (entry.has("Pm") || entry.has("Pr")) {
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

// Finds a material by a whole name, or by the name before a comment and within quotes in either line. Returns the name
// that is common.
std::pair<std::string, const ObjMaterials::Entry*> ObjMaterials::entryOf(const std::string& name) const {
  const std::string bare(withoutQuotes(withoutComment(name)));
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
      defects_.add(entry.file, entry.lines.at("map_d"), "map_d",
                   "'{}' is that of map_Kd and has no alpha, it is left out", entry.opacityTexture);
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
    material.opacityTexture =
        readPicture(entry, entry.lines.at("map_d"), "map_d", entry.opacityTexture, load).value_or(-1);
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
      readPicture(entry, entry.lines.at("map_Ke"), "map_Ke", entry.emissionTexture, [&](const fs::path& picture) {
        filesRead_.insert(withoutLinks(picture));
        return means_.of(picture).colors;
      });
  if (mean) {
    material.emission = *mean * (material.emission == glm::dvec3(0.0) ? glm::dvec3(1.0) : material.emission);
  }
}

}  // namespace speculum
