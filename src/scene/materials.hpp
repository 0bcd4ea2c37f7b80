#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// Returns the index of the texture of a picture file. Appends it to `textures` unless it is there already; shrinks it
// (Texture::shrinkage) if the textures before it fill the memory that a scene's may take. Throws FileError.
int textureIndex(const std::filesystem::path& file, std::vector<Texture>& textures);
// Does the same for a picture that gives opacities: by its alpha channel or, if there is none or it is opaque
// throughout, by its red, which counts as a linear number. Returns nothing if that is opaque throughout too.
std::optional<int> opacityTextureIndex(const std::filesystem::path& file, std::vector<Texture>& textures);
// Does the same as textureIndex() for the content of a picture that stands in another file; `source` names it.
int textureIndex(const std::filesystem::path& source, const std::vector<uint8_t>& picture,
                 std::vector<Texture>& textures);
// Does the same for a picture file whose values are linear shares, 0 .. 1.
int linearTextureIndex(const std::filesystem::path& file, std::vector<Texture>& textures);

// Says whether some texel has any opacity.
bool isSeen(const Texture& texture);
// Says whether nearly all texels are either there or not, so that those between are the smoothed edge of a cut-out.
bool isCutOut(const Texture& texture);

// Means of a picture's pixels: of its bytes as 0 .. 1, and of the linear colors that they stand for in sRGB.
struct PictureMeans {
  glm::dvec3 numbers{1.0};
  glm::dvec3 colors{1.0};
};

// Means of pictures of which nothing else is drawn. No picture is read twice.
class MeansOfPictures {
 public:
  // Returns the means of a picture file or, with `content`, of a picture in another file, where `source` names it.
  // Throws FileError.
  const PictureMeans& of(const std::filesystem::path& source, const std::vector<uint8_t>* content = nullptr);

 private:
  std::map<std::filesystem::path, PictureMeans> known_;
};

// Sets Kd, Ks and Ns of `material` from the metal-roughness model of glTF 2.0 (appendix B): linear base color, metal
// and roughness of 0 .. 1. Other values count as the nearest in range. `texture` is the mean color of the base color's
// texture, times that of the vertices; white without either.
//
//     m = metal (1 - smoothstep(0.5, 1, roughness)),
//     Kd = (1 - m) base,   Ks = 0.04 + m (base texture - 0.04),
//     Ns = 2 / roughness^4 - 2, at least 1, at most 1e6
//
// A rough metal shows light from all sides, of which Ks shows nothing: so it fades to Kd.
// Ns gives the lobe the width of a GGX lobe with alpha = roughness^2: Walter et al., "Microfacet Models for Refraction
// through Rough Surfaces" (2007), section 5.2. Ks is the reflectance at normal incidence: it does not grow towards
// grazing angles, and reflects lights alone. The texture itself multiplies Kd only, so the highlights of a textured
// metal have one color. A metal of 1 with a roughness of 0.05 or less says mirror, and nothing else does: the caller
// takes that back (Material::mirror) if the material is not opaque.
void setMetalRoughness(Material& material, glm::dvec3 baseColor, double metal, double roughness,
                       const glm::dvec3& texture = glm::dvec3(1.0));
// Returns the roughness that setMetalRoughness() turns into `shininess`.
double roughnessOf(double shininess);

}  // namespace speculum
