#include "platform/folders.hpp"

#include <stdexcept>

#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/system_files.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Returns the folder that the variable names, else the system's. The XDG base directory specification says to ignore
// relative paths.
fs::path userFolder(const char* variable, UserFolder folder) {
  const fs::path named = environment(variable);
  return named.is_absolute() ? named : systemFolder(folder);
}

}  // namespace

fs::path userCacheDir() {
  return userFolder("XDG_CACHE_HOME", UserFolder::cache) / "speculum";
}

fs::path userConfigDir() {
  return userFolder("XDG_CONFIG_HOME", UserFolder::config) / "speculum";
}

fs::path picturesDir() {
  return userFolder("XDG_PICTURES_DIR", UserFolder::pictures);
}

fs::path documentsDir() {
  return userFolder("XDG_DOCUMENTS_DIR", UserFolder::documents);
}

fs::path typedPath(const fs::path& typed) {
  const std::string home = environment(homeVariable);
  const bool expands = !home.empty() && typed.begin() != typed.end() && *typed.begin() == "~";
  return expands ? fs::path(home) / typed.lexically_relative("~") : typed;
}

fs::path dataDirectory(std::string_view name) {
  const fs::path exe = executablePath().parent_path();
  const fs::path up = exe.parent_path();
  std::vector<fs::path> candidates{exe / name};
  // Installed: below the prefix, which is one folder above programs and three above examples. Built: beside the
  // program, a folder higher for test programs, then up to the source tree.
  for (fs::path folder = up; candidates.size() < 7 && candidates.back() != folder / name;
       folder = folder.parent_path()) {
    candidates.push_back(folder / "share" / "speculum" / name);
    candidates.push_back(folder / name);
  }
  std::string searched;
  for (const fs::path& candidate : candidates) {
    if (isFolder(candidate)) {
      return candidate;
    }
    searched += (searched.empty() ? "" : ", ") + candidate.string();
  }
  throw std::runtime_error("no directory '" + std::string(name) + "' was found; looked at " + searched +
                           " (build the project, or install it with cmake --install)");
}

}  // namespace speculum
