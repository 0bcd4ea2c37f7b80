#include "scene/textures.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "image/color.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

Texture textureOf(const Image8& image, const fs::path& source, bool linear) {
  Texture texture{.source = source, .linear = linear, .width = image.width, .height = image.height};
  texture.texels.reserve(image.rgba.size() / 4);
  const auto decoded = [&](uint8_t value) {
    return linear ? static_cast<float>(value) / 255.0f : srgbDecoded()[value];
  };
  for (size_t i = 0; i < image.rgba.size(); i += 4) {
    texture.texels.emplace_back(decoded(image.rgba[i]), decoded(image.rgba[i + 1]), decoded(image.rgba[i + 2]));
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
  spdlog::warn("{}: is drawn with {}x{} texels: the textures before it have 2^28 texels or more",
               texture.source.string(), small.width, small.height);
  return small;
}

int indexOf(const fs::path& source, bool linear, const std::function<Image8()>& read, std::vector<Texture>& textures) {
  const auto known = std::ranges::find_if(textures, [&](const Texture& texture) {
    return texture.source.native() == source.native() && texture.linear == linear;
  });
  const auto index = static_cast<int>(known - textures.begin());
  if (known == textures.end()) {
    textures.push_back(bounded(textureOf(read(), source, linear), mostPixels(textures)));
  }
  return index;
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
      source, false, [&] { return decodeTexture(source, picture); }, textures);
}

}  // namespace speculum
