#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace speculum {

// Texels decoded to linear RGB, row 0 at the top of the picture (v = 1).
struct Texture {
  std::filesystem::path source;  // without symbolic links
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> texels;
};

// Returns the texture with fewer texels, each the mean of the texels that it covers.
Texture shrunk(const Texture& texture, int width, int height);

}  // namespace speculum
