#include "platform/files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace speculum {

namespace fs = std::filesystem;

namespace {

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

void write(const fs::path& target, const fs::path& file, std::span<const uint8_t> content) {
  std::ofstream stream(target, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) {
    throw FileError(file, "cannot be written", "check the folder's permissions and free space");
  }
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

}  // namespace

FileError::FileError(const fs::path& file, std::string problem, const std::string& remedy)
    : std::runtime_error(file.string() + ": " + problem + " (" + remedy + ")"), problem_(std::move(problem)) {}

std::vector<uint8_t> readFile(const fs::path& file, uintmax_t most) {
  return read<std::vector<uint8_t>>(file, most);
}

std::string readText(const fs::path& file, uintmax_t most) {
  return read<std::string>(file, most);
}

std::optional<std::vector<uint8_t>> readFileIfAny(const fs::path& file) {
  try {
    return readFile(file);
  } catch (const FileError&) {
    return std::nullopt;
  }
}

void replaceFile(const fs::path& file, std::span<const uint8_t> content) {
  std::error_code error;
  const fs::path folder = folderOf(file);
  if (!fs::is_directory(folder, error)) {
    throw FileError(file, "cannot be written: there is no folder '" + folder.string() + "'", "create it first");
  }
  if (fs::is_directory(file, error)) {
    throw FileError(file, "cannot be written: it is a folder", "name a file");
  }
  // Renaming over a device such as /dev/null would replace the device.
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    write(file, file, content);
    return;
  }
  const fs::path partial = file.string() + ".part" + std::to_string(::getpid());
  try {
    write(partial, file, content);
    fs::rename(partial, file, error);
    if (error) {
      throw FileError(file, "cannot be written: " + error.message(), "check the folder");
    }
  } catch (...) {
    fs::remove(partial, error);
    throw;
  }
}

void replaceFile(const fs::path& file, std::string_view text) {
  replaceFile(file, bytesOf(text));
}

bool storeFile(const fs::path& file, std::span<const uint8_t> content) {
  std::error_code ignored;
  fs::create_directories(folderOf(file), ignored);
  try {
    replaceFile(file, content);
    return true;
  } catch (const FileError&) {
    return false;
  }
}

bool storeFile(const fs::path& file, std::string_view text) {
  return storeFile(file, bytesOf(text));
}

bool isWritable(const fs::path& file) {
  std::error_code ignored;
  return ::access((fs::exists(file, ignored) ? file : folderOf(file)).c_str(), W_OK) == 0;
}

std::optional<double> modificationTime(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    return std::nullopt;
  }
  return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (fs::temp_directory_path() / "speculum-XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    throw std::runtime_error("no temporary directory could be made at " + name + " (is it writable?)");
  }
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace speculum
