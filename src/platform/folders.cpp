#include "platform/folders.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

#include "platform/files.hpp"
#include "platform/process.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Returns a folder below $TMPDIR that nobody else can write to; nothing if there can be none: other users may have put
// a link or a folder of theirs in its place, or may be able to rename the folder, if $TMPDIR has no sticky bit.
std::optional<fs::path> ownTemporaryFolder() {
  const fs::path parent = temporaryFolder();
  const fs::path folder = parent / ("speculum-" + std::to_string(::geteuid()));
  struct stat around {};
  struct stat own {};
  ::mkdir(folder.c_str(), 0700);
  const bool safe = ::stat(parent.c_str(), &around) == 0 && ::lstat(folder.c_str(), &own) == 0 &&
                    ((around.st_mode & S_IWOTH) == 0 || (around.st_mode & S_ISVTX) != 0) &&
                    (around.st_uid == 0 || around.st_uid == own.st_uid) && S_ISDIR(own.st_mode) &&
                    own.st_uid == ::geteuid() && (own.st_mode & 077) == 0;
  return safe ? std::optional(folder) : std::nullopt;
}

// Returns the folder that holds the user's other folders. Without $HOME, its content is lost when the machine starts
// again. If there is no temporary folder either, it is a path that cannot be created, so that nothing is kept.
fs::path homeFolder() {
  const fs::path home = environment("HOME");
  return home.is_absolute() ? home : ownTemporaryFolder().value_or("/proc/no-home");
}

fs::path userDir(const char* variable, const char* fallback) {
  // The XDG base directory specification says to ignore relative paths.
  const fs::path base = environment(variable);
  return (base.is_absolute() ? base : homeFolder() / fallback) / "speculum";
}

// Returns the folder that the file of xdg-user-dirs names: XDG_PICTURES_DIR="$HOME/..." or an absolute path.
fs::path configuredDir(const std::string& variable, const fs::path& home) {
  std::ifstream file(userConfigDir().parent_path() / "user-dirs.dirs");
  const std::string key = variable + "=\"";
  for (std::string line; std::getline(file, line);) {
    const size_t end = line.rfind('"');
    if (!line.starts_with(key) || end < key.size()) {
      continue;
    }
    const std::string value = line.substr(key.size(), end - key.size());
    return value.starts_with("$HOME/") ? home / value.substr(6) : fs::path(value);
  }
  return {};
}

fs::path desktopDir(const std::string& variable, const char* fallback) {
  const fs::path home = homeFolder();
  for (const fs::path& folder : {fs::path(environment(variable)), configuredDir(variable, home)}) {
    if (folder.is_absolute()) {
      return folder;
    }
  }
  return home / fallback;
}

}  // namespace

fs::path temporaryFolder() {
  const fs::path folder = environment("TMPDIR");
  return folder.empty() ? fs::path("/tmp") : folder;
}

fs::path executablePath() {
  return fs::read_symlink("/proc/self/exe");
}

fs::path userCacheDir() {
  return userDir("XDG_CACHE_HOME", ".cache");
}

fs::path userConfigDir() {
  return userDir("XDG_CONFIG_HOME", ".config");
}

fs::path picturesDir() {
  return desktopDir("XDG_PICTURES_DIR", "Pictures");
}

fs::path documentsDir() {
  return desktopDir("XDG_DOCUMENTS_DIR", "Documents");
}

fs::path typedPath(const fs::path& typed) {
  const std::string home = environment("HOME");
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
