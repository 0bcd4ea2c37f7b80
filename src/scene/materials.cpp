#include "scene/materials.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "platform/text.hpp"
#include "scene/value_range.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Returns a channel as opacities; none if all are 1.
std::vector<float> opacityOf(const Image8& image, size_t channel) {
  std::vector<float> values;
  values.reserve(image.rgba.size() / 4);
  for (size_t i = channel; i < image.rgba.size(); i += 4) {
    values.push_back(static_cast<float>(image.rgba[i]) / 255.0f);
  }
  return std::ranges::all_of(values, [](float value) { return value == 1.0f; }) ? std::vector<float>() : values;
}

Texture textureOf(const Image8& image, const fs::path& source, bool linear) {
  Texture texture{.source = source, .linear = linear, .width = image.width, .height = image.height};
  texture.texels.reserve(image.rgba.size() / 4);
  const auto decoded = [&](uint8_t value) {
    return linear ? static_cast<float>(value) / 255.0f : srgbDecoded()[value];
  };
  glm::dvec3 sum(0.0);
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    texture.texels.emplace_back(decoded(image.rgba[i]), decoded(image.rgba[i + 1]), decoded(image.rgba[i + 2]));
    sum += texture.texels.back();
  }
  texture.mean = sum / static_cast<double>(texture.texels.size());
  texture.hasAlpha = image.hasAlpha;
  if (image.hasAlpha) {
    texture.opacity = opacityOf(image, 3);
  }
  return texture;
}

// Returns the number of pixels that a scene's next texture may have, given the textures before it. Without a bound,
// small files of few colors fill any memory.
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
  // If one side shrinks to one texel, the other side may have more than its share.
  const int least = std::max(static_cast<int>(factor * texture.height), 1);
  const int width = std::clamp(static_cast<int>(most / least), 1, texture.width);
  const int height = std::clamp(static_cast<int>(most / width), 1, texture.height);
  Texture small = shrunk(texture, width, height);
  small.shrinkage =
      oneLine(fmt::format("{}: is drawn with {}x{} texels: the textures before it have 2^28 texels or more",
                          texture.source.string(), small.width, small.height));
  spdlog::warn("{}", small.shrinkage);
  return small;
}

int indexOf(const fs::path& source, bool linear, const std::function<Image8()>& read, std::vector<Texture>& textures) {
  const auto known = std::ranges::find_if(textures, [&](const Texture& texture) {
    return !texture.isMask && texture.linear == linear && texture.source.native() == source.native();
  });
  const auto index = static_cast<int>(known - textures.begin());
  if (known == textures.end()) {
    textures.push_back(bounded(textureOf(read(), source, linear), mostPixels(textures)));
  }
  return index;
}

PictureMeans meansOf(const Image8& image) {
  PictureMeans sums{glm::dvec3(0.0), glm::dvec3(0.0)};
  for (size_t i = 0; i < image.rgba.size(); ++i) {
    if (const auto channel = static_cast<int>(i % 4); channel < 3) {
      sums.numbers[channel] += image.rgba[i] / 255.0;
      sums.colors[channel] += srgbDecoded()[image.rgba[i]];
    }
  }
  const double count = static_cast<double>(image.rgba.size()) / 4.0;
  return {sums.numbers / count, sums.colors / count};
}

}  // namespace

int textureIndex(const fs::path& file, std::vector<Texture>& textures) {
  return indexOf(
      withoutLinks(file), false, [&] { return readTexture(file); }, textures);
}

int linearTextureIndex(const fs::path& file, std::vector<Texture>& textures) {
  return indexOf(
      withoutLinks(file), true, [&] { return readImage8(file); }, textures);
}

int textureIndex(const fs::path& source, const std::vector<uint8_t>& picture, std::vector<Texture>& textures) {
  return indexOf(
      source, false, [&] { return readTexture(source, picture); }, textures);
}

std::optional<int> opacityTextureIndex(const fs::path& file, std::vector<Texture>& textures) {
  const fs::path source = withoutLinks(file);
  const auto known = std::ranges::find_if(textures, [&](const Texture& texture) {
    return !texture.opacity.empty() && texture.source.native() == source.native();
  });
  if (known != textures.end()) {
    return static_cast<int>(known - textures.begin());
  }
  const Image8 image = readTexture(file);
  if (image.hasAlpha && !opacityOf(image, 3).empty()) {
    return indexOf(
        source, false, [&] { return image; }, textures);
  }
  Texture mask{.source = source, .width = image.width, .height = image.height, .isMask = true};
  mask.opacity = opacityOf(image, 0);
  if (mask.opacity.empty()) {
    return std::nullopt;
  }
  mask.texels.assign(image.rgba.size() / 4, glm::vec3(1.0f));
  textures.push_back(bounded(std::move(mask), mostPixels(textures)));
  return static_cast<int>(textures.size()) - 1;
}

const PictureMeans& MeansOfPictures::of(const fs::path& source, const std::vector<uint8_t>* content) {
  const auto known = known_.find(source);
  if (known != known_.end()) {
    return known->second;
  }
  return known_.emplace(source, meansOf(content ? readTexture(source, *content) : readTexture(source))).first->second;
}

bool isSeen(const Texture& texture) {
  return texture.opacity.empty() || std::ranges::any_of(texture.opacity, [](float opacity) { return opacity > 0.0f; });
}

bool isCutOut(const Texture& texture) {
  constexpr double leastShare = 0.875;
  const auto isClear = [](float opacity) { return opacity < 0.1f || opacity > 0.9f; };
  const auto clear = static_cast<double>(std::ranges::count_if(texture.opacity, isClear));
  return clear >= leastShare * static_cast<double>(texture.opacity.size());
}

void setMetalRoughness(Material& material, glm::dvec3 baseColor, double metal, double roughness,
                       const glm::dvec3& texture) {
  const double share = std::clamp(metal, 0.0, 1.0) * (1.0 - glm::smoothstep(0.5, 1.0, roughness));
  const double alpha = std::pow(std::clamp(roughness, 0.0, 1.0), 2.0);
  material.diffuse = (1.0 - share) * baseColor;
  material.specular = glm::mix(glm::dvec3(0.04), baseColor * texture, share);
  material.mirror.reset();
  if (share == 1.0 && roughness <= 0.05 + 1e-9) {  // tinyobjloader does not round to the nearest double
    material.mirror = glm::clamp(material.specular, 0.0, 1.0);
  }
  material.shininess = std::clamp(2.0 / std::max(alpha * alpha, 1e-9) - 2.0, leastShininess, mostShininess);
}

double roughnessOf(double shininess) {
  return std::pow(2.0 / (shininess + 2.0), 0.25);
}

}  // namespace speculum
