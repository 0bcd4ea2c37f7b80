#include "platform/files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "platform/folders.hpp"
#include "platform/text.hpp"

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

[[noreturn]] void failToWrite(const fs::path& file, int error) {
  throw FileError(file, std::string("cannot be written: ") + std::strerror(error),
                  "check the folder's permissions and free space");
}

// Writes and closes the descriptor; with `lasting` waits until the content has reached the disk. `file` is for
// messages.
void writeAndClose(int descriptor, const fs::path& file, std::span<const uint8_t> content, bool lasting) {
  int error = 0;
  while (!content.empty() && error == 0) {
    const ssize_t count = ::write(descriptor, content.data(), content.size());
    if (count >= 0) {
      content = content.subspan(static_cast<size_t>(count));
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (error == 0 && lasting && ::fsync(descriptor) != 0) {
    error = errno;
  }
  if (::close(descriptor) != 0 && error == 0) {
    error = errno;
  }
  if (error != 0) {
    failToWrite(file, error);
  }
}

// Returns the file that symbolic links at the end of the path lead to, whether or not it exists.
fs::path behindLinks(fs::path file) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(file, error); ++links) {
    file = file.parent_path() / fs::read_symlink(file, error);
  }
  if (fs::is_symlink(file, error)) {
    failToWrite(file, ELOOP);
  }
  return file;
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Returns the open descriptor that a path such as /dev/stdout or /dev/fd/3 names, else -1. The descriptor may stand for
// a pipe, or for a file that is appended to.
int descriptorNamed(fs::path file) {
  std::error_code error;
  const fs::path descriptors = fs::canonical("/proc/self/fd", error);
  for (int links = 0; links < 40 && !error; ++links) {
    const std::string name = file.filename().string();
    int number = -1;
    if (fs::weakly_canonical(folderOf(file), error) == descriptors &&
        std::from_chars(name.data(), name.data() + name.size(), number).ec == std::errc()) {
      return number;
    }
    if (!fs::is_symlink(file, error)) {
      break;
    }
    file = file.parent_path() / fs::read_symlink(file, error);
  }
  return -1;
}

void replace(const fs::path& file, std::span<const uint8_t> content, bool lasting) {
  std::error_code error;
  if (const int own = descriptorNamed(file); own >= 0) {
    return writeAndClose(::dup(own), file, content, false);
  }
  const fs::path target = behindLinks(file);
  const fs::path folder = folderOf(target);
  if (!fs::is_directory(folder, error)) {
    throw FileError(file, "cannot be written: there is no folder '" + folder.string() + "'", "create it first");
  }
  if (fs::is_directory(target, error)) {
    throw FileError(file, "cannot be written: it is a folder", "name a file");
  }
  struct stat old {};
  const bool exists = ::stat(target.c_str(), &old) == 0;
  // Writes to a device or pipe directly: renaming a file over it would replace it.
  if (exists && !S_ISREG(old.st_mode)) {
    // Waits for a pipe's reader, which may come a little later, but not for a file whose loss does no harm.
    int descriptor = -1;
    for (int tries = lasting ? 40 : 1; descriptor < 0 && tries > 0; --tries) {
      descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
      if (descriptor < 0 && errno != ENXIO) {
        failToWrite(file, errno);
      }
      ::usleep(descriptor < 0 ? 50'000 : 0);
    }
    if (descriptor < 0) {
      throw FileError(file, "cannot be written: it is a pipe that nobody reads", "start its reader, or name a file");
    }
    if (lasting) {
      ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    }
    return writeAndClose(descriptor, file, content, false);
  }
  // Leaves room for the ending, since a file system bounds names to 255 bytes.
  const std::string name = target.filename().string().substr(0, 200);
  fs::path partial;
  int descriptor = -1;
  for (int number = 0; descriptor < 0; ++number) {
    partial = folder / (name + ".part" + std::to_string(number));
    descriptor = ::open(partial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) {
      failToWrite(file, errno);
    }
  }
  try {
    if (exists) {
      // Only root may give a file to another owner.
      [[maybe_unused]] const int result = ::fchown(descriptor, old.st_uid, old.st_gid);
      ::fchmod(descriptor, old.st_mode & 07777);
    }
    writeAndClose(descriptor, file, content, lasting);
    if (::rename(partial.c_str(), target.c_str()) != 0) {
      failToWrite(file, errno);
    }
    if (lasting) {
      const int names = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      ::fsync(names);
      ::close(names);
    }
  } catch (...) {
    fs::remove(partial, error);
    throw;
  }
}

}  // namespace

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
  replace(file, content, true);
}

void replaceFile(const fs::path& file, std::string_view text) {
  replace(file, bytesOf(text), true);
}

bool storeFile(const fs::path& file, std::span<const uint8_t> content) {
  std::error_code ignored;
  fs::create_directories(folderOf(file), ignored);
  try {
    replace(file, content, false);
    return true;
  } catch (const FileError&) {
    return false;
  }
}

bool storeFile(const fs::path& file, std::string_view text) {
  return storeFile(file, bytesOf(text));
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

bool isWritable(const fs::path& file) {
  std::error_code ignored;
  return ::access((fs::exists(file, ignored) ? file : folderOf(file)).c_str(), W_OK) == 0;
}

std::shared_ptr<const int> lockFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  // A file system without locks cannot say that another process is there.
  if (descriptor < 0 || (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)) {
    ::close(descriptor);
    return nullptr;
  }
  return {new int(descriptor), [](const int* held) {
            ::close(*held);
            delete held;
          }};
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

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (temporaryFolder() / "speculum-XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    throw std::runtime_error("no temporary directory could be made at " + name + " (name a writable folder in TMPDIR)");
  }
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace speculum
