#include "edit/save_place.hpp"

#include "edit/scene_writer.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_loader.hpp"

namespace speculum {

namespace fs = std::filesystem;

fs::path sceneFileNamed(const fs::path& file) {
  if (!file.has_filename()) {
    throw SaveError(oneLine(file.string() + ": not saved: there is no file name (add one such as scene.toml)"));
  }
  return file.extension() == ".toml" || isModelFile(file) ? file : fs::path(file) += ".toml";
}

void requireFolder(const fs::path& file) {
  std::error_code none;
  fs::path missing;
  fs::path folder = fs::absolute(file, none).parent_path();  // empty in a folder that was deleted
  for (; !folder.empty() && !fs::is_directory(folder, none); folder = folder.parent_path()) {
    missing = folder;
  }
  if (folder.empty()) {
    throw SaveError(
        oneLine(file.string() + ": not saved: the working folder does not exist any more (name a whole path)"));
  }
  if (!missing.empty()) {
    throw SaveError(oneLine(file.string() + ": not saved: there is no folder " + missing.string() +
                            " (create it, or name a file in another)"));
  }
}

}  // namespace speculum
