#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// Returns the index of the texture of a picture file. Appends it to `textures` unless it is there already; shrinks it
// if the textures before it fill the memory that a scene's may take. Throws FileError.
int textureIndex(const std::filesystem::path& file, std::vector<Texture>& textures);
// Does the same for a picture that gives opacities: by its own alpha or, if it has none, by its red, which counts as a
// linear number.
int opacityTextureIndex(const std::filesystem::path& file, std::vector<Texture>& textures);
// Does the same as textureIndex() for the content of a picture that stands in another file; `source` names it.
int textureIndex(const std::filesystem::path& source, const std::vector<uint8_t>& picture,
                 std::vector<Texture>& textures);
// Does the same for a picture file whose values are linear shares, 0 .. 1.
int linearTextureIndex(const std::filesystem::path& file, std::vector<Texture>& textures);

// Says whether nearly all texels are either there or not, so that those between are the smoothed edge of a cut-out.
bool isCutOut(const Texture& texture);

}  // namespace speculum
