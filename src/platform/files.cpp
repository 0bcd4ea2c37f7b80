#include "platform/files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "platform/process.hpp"
#include "platform/system_files.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

template <typename Content>
Content read(const fs::path& file, uintmax_t most) {
  std::error_code error;
  if (fs::is_directory(file, error)) {
    throw FileError(file, "is a folder", "a file is needed");
  }
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw FileError(file, "is a device or pipe", "a file is needed");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw FileError(file, std::string("cannot be read: ") + std::strerror(errno), "check the path");
  }
  const uintmax_t size = fs::file_size(file, error);
  if (!error && size > most) {
    throw FileError(file, "is larger than " + std::to_string(most >> 20) + " MiB", "a smaller file is needed");
  }
  Content content(error ? 0 : size, 0);
  stream.read(reinterpret_cast<char*>(content.data()), static_cast<std::streamsize>(content.size()));
  if (error || stream.bad()) {
    throw FileError(file, std::string("cannot be read: ") + std::strerror(errno), "check the disk");
  }
  content.resize(static_cast<size_t>(stream.gcount()));
  return content;
}

std::span<const uint8_t> bytesOf(std::string_view text) {
  return {reinterpret_cast<const uint8_t*>(text.data()), text.size()};
}

// Returns the folder that the variable names, else the system's. The XDG base directory specification says to ignore
// relative paths.
fs::path userFolder(const char* variable, UserFolder folder) {
  const fs::path named = environment(variable);
  return named.is_absolute() ? named : systemFolder(folder);
}

}  // namespace

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

void failToWrite(const fs::path& file, int error) {
  throw FileError(file, "cannot be written: " + std::system_category().message(error),
                  "check the folder's permissions and free space");
}

void requirePlaceFor(const fs::path& file, const fs::path& target) {
  if (const fs::path folder = folderOf(target); !isFolder(folder)) {
    throw FileError(file, "cannot be written: there is no folder '" + folder.string() + "'", "create it first");
  }
  if (isFolder(target)) {
    throw FileError(file, "cannot be written: it is a folder", "name a file");
  }
}

void requirePlaceFor(const fs::path& file) {
  requirePlaceFor(file, file);
}

fs::path partialName(const fs::path& target, int number) {
  // Leaves room for the ending, since a file system bounds names to 255 bytes.
  const std::string name = target.filename().string();
  return folderOf(target) / (name.substr(0, 200) + ".part" + std::to_string(number));
}

FileError::FileError(const fs::path& file, std::string problem, std::string remedy)
    : std::runtime_error(oneLine(file.string() + ": " + problem + " (" + remedy + ")")),
      problem_(std::move(problem)),
      remedy_(std::move(remedy)) {}

std::vector<uint8_t> readFile(const fs::path& file, uintmax_t most) {
  return read<std::vector<uint8_t>>(file, most);
}

std::string readText(const fs::path& file, uintmax_t most) {
  return read<std::string>(file, most);
}

std::optional<std::vector<uint8_t>> readFileIfAny(const fs::path& file, uintmax_t most) {
  try {
    return readFile(file, most);
  } catch (const FileError&) {
    return std::nullopt;
  }
}

std::string readTextIfAny(const fs::path& file, uintmax_t most) {
  const std::vector<uint8_t> content = readFileIfAny(file, most).value_or(std::vector<uint8_t>());
  return {content.begin(), content.end()};
}

void replaceFile(const fs::path& file, std::span<const uint8_t> content) {
  replace(file, content, true, Links::follow);
}

void replaceFile(const fs::path& file, std::string_view text) {
  replace(file, bytesOf(text), true, Links::follow);
}

bool storeFile(const fs::path& file, std::span<const uint8_t> content, Links links) {
  std::error_code ignored;
  fs::create_directories(folderOf(file), ignored);
  try {
    replace(file, content, false, links);
    return true;
  } catch (const FileError&) {
    return false;
  }
}

bool storeFile(const fs::path& file, std::string_view text, Links links) {
  return storeFile(file, bytesOf(text), links);
}

void keepNewest(const fs::path& folder, size_t kept, const std::function<bool(const fs::path&)>& count) {
  std::error_code none;
  std::vector<std::pair<fs::file_time_type, fs::path>> entries;
  for (fs::directory_iterator entry(folder, none); entry != fs::directory_iterator(); entry.increment(none)) {
    if (!count || count(entry->path())) {
      entries.emplace_back(entry->last_write_time(none), entry->path());
    }
  }
  std::ranges::sort(entries, std::greater<>());
  for (size_t i = kept; i < entries.size(); ++i) {
    fs::remove_all(entries[i].second, none);
  }
}

bool isFile(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}

bool isFolder(const fs::path& path) {
  std::error_code none;
  return fs::is_directory(path, none);
}

fs::path wholePath(const fs::path& path) {
  std::error_code none;
  const fs::path whole = fs::absolute(path, none);
  return whole.empty() ? path : whole;
}

fs::path withoutLinks(const fs::path& path) {
  std::error_code error;
  fs::path target = fs::weakly_canonical(wholePath(path), error);
  return error ? path : target;
}

bool isBelow(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

std::string fileNameOf(const std::string& name, const std::string& ending) {
  constexpr size_t longest = 255;  // bytes, in usual file systems
  const size_t most = std::min(name.size(), longest - ending.size());
  size_t length = most;
  while (length > 0 && length < name.size() && continuesCharacter(name[length])) {
    --length;
  }
  constexpr size_t longestRest = 3;  // bytes after the first of a character; a name with more of them is no UTF-8
  return name.substr(0, most - length > longestRest ? most : length) + ending;
}

TemporaryDirectory::TemporaryDirectory() : path_(newTemporaryFolder()) {}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

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
