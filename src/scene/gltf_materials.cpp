#include "scene/gltf_file.hpp"

#include <algorithm>
#include <cmath>

#include "platform/files.hpp"
#include "scene/materials.hpp"

namespace speculum {

namespace fs = std::filesystem;

glm::dvec3 colorOf(const std::vector<double>& values) {
  return values.size() < 3 ? glm::dvec3(1.0) : glm::dvec3(values[0], values[1], values[2]);
}

glm::ivec2 waysToWrap(const tinygltf::Model& model, int texture) {
  const int sampler = isIndex(texture, model.textures.size()) ? model.textures[texture].sampler : -1;
  return isIndex(sampler, model.samplers.size())
             ? glm::ivec2(model.samplers[sampler].wrapS, model.samplers[sampler].wrapT)
             : glm::ivec2(TINYGLTF_TEXTURE_WRAP_REPEAT);
}

TexturePlacement::TexturePlacement(const tinygltf::TextureInfo& texture) {
  const auto transform = [&](const char* key) -> const tinygltf::Value& {
    return extensionMember(texture.extensions, "KHR_texture_transform", key);
  };
  const auto pairOf = [](const tinygltf::Value& value, double usual) {
    return value.ArrayLen() == 2 ? glm::dvec2(numberOf(value.Get(0), usual), numberOf(value.Get(1), usual))
                                 : glm::dvec2(usual);
  };
  const tinygltf::Value& set = transform("texCoord");
  texcoords_ = "TEXCOORD_" + std::to_string(set.IsInt() ? set.GetNumberAsInt() : texture.texCoord);
  offset_ = pairOf(transform("offset"), 0.0);
  scale_ = pairOf(transform("scale"), 1.0);
  rotation_ = numberOf(transform("rotation"), 0.0);
}

glm::dvec2 TexturePlacement::apply(const glm::dvec2& uv) const {
  const glm::dvec2 scaled = scale_ * uv;
  const glm::dvec2 turned(std::cos(rotation_) * scaled.x + std::sin(rotation_) * scaled.y,
                          std::cos(rotation_) * scaled.y - std::sin(rotation_) * scaled.x);
  return {turned.x + offset_.x, 1.0 - (turned.y + offset_.y)};
}

template <typename Read>
auto GltfMaterials::readPicture(int texture, const Read& read) -> std::optional<decltype(read(fs::path()))> {
  if (!isIndex(texture, content_.model().textures.size())) {
    if (texture != -1) {
      add("there is no texture {}, it is left out", std::to_string(texture));
    }
    return std::nullopt;
  }
  const tinygltf::Texture& from = content_.model().textures[texture];
  if (from.sampler != -1 && !isIndex(from.sampler, content_.model().samplers.size())) {
    add("there is no sampler {}, the texture repeats", std::to_string(from.sampler));
  }
  if (from.source == -1 && !from.extensions.empty()) {
    const std::string& extension = from.extensions.begin()->first;
    add("a texture has no picture but that of {}, it is left out", extension, extension);
    return std::nullopt;
  }
  const std::optional<GltfFile::Picture> picture = content_.picture(from.source);
  if (!picture) {
    return std::nullopt;
  }
  try {
    return picture->content ? read(picture->name, *picture->content) : read(picture->name);
  } catch (const FileError& error) {
    add("{}, the texture is left out", error.what(), error.problem());
    return std::nullopt;
  }
}

Material GltfMaterials::material(int index, bool colored, bool withAlpha, const glm::dvec3& meanColor) {
  if (!isIndex(index, content_.model().materials.size())) {
    return colored ? Material{.diffuse = glm::dvec3(1.0)} : Material();
  }
  const tinygltf::Material& from = content_.model().materials[index];
  const tinygltf::PbrMetallicRoughness& surface = from.pbrMetallicRoughness;
  Material material{.name = from.name};
  const auto load = [&](const auto&... picture) { return textureIndex(picture..., textures_); };
  const auto [known, isNew] = diffuse_.try_emplace(surface.baseColorTexture.index, -1);
  if (isNew) {
    known->second = readPicture(surface.baseColorTexture.index, load).value_or(-1);
  }
  material.diffuseTexture = known->second;
  material.clamps = waysToWrap(content_.model(), surface.baseColorTexture.index) == clampingWays;
  material.twoSided = from.doubleSided;
  setSurface(material, surface, meanColor);
  material.emission = emissionOf(from);
  setCoverage(material, from, withAlpha);
  for (const auto& [name, content] : from.extensions) {
    if (std::ranges::find(materialExtensions, name) == materialExtensions.end()) {
      defects_.add(file_, 1, name, "is not read, '{}' is drawn without it", from.name);
    }
  }
  if (from.normalTexture.index >= 0 || from.occlusionTexture.index >= 0) {
    add("'{}' has a normal or occlusion texture, it is left out", from.name);
  }
  return material;
}

void GltfMaterials::setSurface(Material& material, const tinygltf::PbrMetallicRoughness& surface,
                               const glm::dvec3& meanColor) {
  double metal = surface.metallicFactor;
  double roughness = surface.roughnessFactor;
  if (surface.metallicRoughnessTexture.index >= 0) {
    add("'{}' has a texture of metal and roughness, its mean is drawn", material.name);
    const glm::dvec3& mean = meansOf(surface.metallicRoughnessTexture.index).numbers;
    roughness *= mean.y;
    metal *= mean.z;
  }
  const glm::dvec3 base = colorOf(surface.baseColorFactor);
  const glm::dvec3 mean = material.diffuseTexture < 0 ? glm::dvec3(1.0) : textures_[material.diffuseTexture].mean;
  setMetalRoughness(material, base, metal, roughness, mean * meanColor);
}

void GltfMaterials::setCoverage(Material& material, const tinygltf::Material& from, bool withAlpha) {
  if (from.alphaMode == "MASK" || from.alphaMode == "BLEND") {
    const std::vector<double>& factor = from.pbrMetallicRoughness.baseColorFactor;
    material.vertexAlpha = withAlpha;
    material.opacity = factor.size() == 4 ? factor[3] : 1.0;
    if (material.diffuseTexture >= 0 && !textures_[material.diffuseTexture].opacity.empty()) {
      material.opacityTexture = material.diffuseTexture;
    }
  }
  if (from.alphaMode == "MASK") {
    material.cutoff = std::min(from.alphaCutoff, 2.0);
  } else {
    // Glass of which nothing were left could not be seen, so it keeps the share that it reflects. A texture says where
    // the material transmits light, so its mean counts.
    constexpr double reflected = 0.04;
    constexpr const char* transmission = "KHR_materials_transmission";
    double passing =
        std::min(numberOf(extensionMember(from.extensions, transmission, "transmissionFactor"), 0.0), 1.0 - reflected);
    const tinygltf::Value& texture = extensionMember(from.extensions, transmission, "transmissionTexture");
    if (passing > 0.0 && texture.IsObject() && texture.Get("index").IsInt()) {
      add("'{}' has a texture of its transmission, its mean is drawn", from.name);
      passing *= meansOf(texture.Get("index").GetNumberAsInt()).numbers.x;
    }
    material.opacity *= 1.0 - passing;
  }
  if (material.isTransparent()) {
    material.mirror.reset();
  }
}

glm::dvec3 GltfMaterials::emissionOf(const tinygltf::Material& from) {
  const double strength =
      numberOf(extensionMember(from.extensions, "KHR_materials_emissive_strength", "emissiveStrength"), 1.0);
  glm::dvec3 emission = strength * colorOf(from.emissiveFactor);
  if (emission != glm::dvec3(0.0) && from.emissiveTexture.index >= 0) {
    add("'{}' has an emissive texture, its mean is drawn", from.name);
    emission *= meansOf(from.emissiveTexture.index).colors;
  }
  return glm::clamp(emission, radianceRange.low, radianceRange.high);
}

const PictureMeans& GltfMaterials::meansOf(int texture) {
  const auto [known, isNew] = means_.try_emplace(texture);
  if (isNew) {
    const auto read = [&](const auto& source, const auto&... content) { return pictureMeans_.of(source, &content...); };
    known->second = readPicture(texture, read).value_or(PictureMeans());
  }
  return known->second;
}

}  // namespace speculum
