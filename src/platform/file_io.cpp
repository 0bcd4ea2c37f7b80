#include "platform/file_io.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace speculum {

namespace fs = std::filesystem;

std::vector<uint8_t> readFileBytes(const fs::path& file, uintmax_t most) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    throw std::runtime_error(file.string() + ": is a folder (a file is needed)");
  }
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) {
    throw std::runtime_error(file.string() + ": is a device or pipe (a file is needed)");
  }
  if (const uintmax_t size = fs::file_size(file, ignored); !ignored && size > most) {
    throw std::runtime_error(file.string() + ": is larger than " + std::to_string(most >> 20) +
                             " MiB (a smaller file is needed)");
  }
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw std::runtime_error(file.string() + ": cannot be read: " + std::strerror(errno) + " (check the path)");
  }
  std::vector<uint8_t> bytes(fs::file_size(file, ignored));
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<size_t>(stream.gcount()));
  if (stream.bad()) {
    throw std::runtime_error(file.string() + ": cannot be read: " + std::strerror(errno) + " (check the disk)");
  }
  return bytes;
}

void replaceFile(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  std::error_code error;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    throw std::runtime_error(file.string() + ": cannot be written: there is no folder '" + folder.string() +
                             "' (create it first)");
  }
  if (fs::is_directory(file, error)) {
    throw std::runtime_error(file.string() + ": cannot be written: it is a folder (name a file)");
  }
  // Renaming over a device such as /dev/null would replace the device.
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    write(file);
    return;
  }
  const fs::path partial = file.string() + ".part";
  try {
    write(partial);
    fs::rename(partial, file, error);
    if (error) {
      throw std::runtime_error(file.string() + ": cannot be written: " + error.message() + " (check the folder)");
    }
  } catch (...) {
    fs::remove(partial, error);
    throw;
  }
}

}  // namespace speculum
