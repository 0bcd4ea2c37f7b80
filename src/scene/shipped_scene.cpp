#include "scene/shipped_scene.hpp"

#include "platform/files.hpp"
#include "platform/folders.hpp"

namespace speculum {

std::optional<std::filesystem::path> shippedScene(const std::filesystem::path& wanted) {
  namespace fs = std::filesystem;
  if (wanted.is_relative()) {
    const fs::path scenes = dataDirectory("scenes");
    for (const fs::path& candidate : {scenes / wanted, scenes.parent_path() / wanted,
                                      scenes / (wanted.string() + ".toml"), scenes.parent_path() / "models" / wanted}) {
      if (isFile(candidate)) {
        return candidate;
      }
    }
  }
  return std::nullopt;
}

}  // namespace speculum
