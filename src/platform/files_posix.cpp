#include "platform/system_files.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "platform/files.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, int error) {
  failToWrite(file, std::strerror(error));
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
    fail(file, error);
  }
}

// Returns the file that symbolic links at the end of the path lead to, whether or not it exists.
fs::path behindLinks(fs::path file) {
  std::error_code error;
  for (int links = 0; links < 40 && fs::is_symlink(file, error); ++links) {
    file = file.parent_path() / fs::read_symlink(file, error);
  }
  if (fs::is_symlink(file, error)) {
    fail(file, ELOOP);
  }
  return file;
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
        std::from_chars(name.data(), name.data() + name.size(), number).ptr == name.data() + name.size()) {
      return number;
    }
    if (!fs::is_symlink(file, error)) {
      break;
    }
    file = file.parent_path() / fs::read_symlink(file, error);
  }
  return -1;
}

}  // namespace

void replace(const fs::path& file, std::span<const uint8_t> content, bool lasting, Links links) {
  std::error_code error;
  if (const int own = descriptorNamed(file); own >= 0) {
    return writeAndClose(::dup(own), file, content, false);
  }
  const fs::path target = links == Links::follow ? behindLinks(file) : file;
  requirePlaceFor(file, target);
  struct stat old {};
  const bool exists = ::lstat(target.c_str(), &old) == 0 && !S_ISLNK(old.st_mode);
  // Writes to a device or pipe directly: renaming a file over it would replace it.
  if (exists && !S_ISREG(old.st_mode)) {
    // Waits for a pipe's reader, which may come a little later, but not for a file whose loss does no harm.
    int descriptor = -1;
    for (int tries = lasting ? 40 : 1; descriptor < 0 && tries > 0; --tries) {
      descriptor = ::open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
      if (descriptor < 0 && errno != ENXIO) {
        fail(file, errno);
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
  fs::path partial;
  int descriptor = -1;
  for (int number = 0; descriptor < 0; ++number) {
    partial = partialName(target, number);
    descriptor = ::open(partial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno != EEXIST) {
      fail(file, errno);
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
      fail(file, errno);
    }
    if (lasting) {
      const int names = ::open(folderOf(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
      ::fsync(names);
      ::close(names);
    }
  } catch (...) {
    fs::remove(partial, error);
    throw;
  }
}

bool isWritable(const fs::path& file) {
  std::error_code ignored;
  return ::access((fs::exists(file, ignored) ? file : folderOf(file)).c_str(), W_OK) == 0;
}

std::shared_ptr<const void> lockFolder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  // A file system without locks cannot say that another process is there.
  if (descriptor < 0 || (::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)) {
    ::close(descriptor);
    return nullptr;
  }
  return std::shared_ptr<const int>(new int(descriptor), [](const int* held) {
    ::close(*held);
    delete held;
  });
}

fs::path newTemporaryFolder() {
  std::string name = (temporaryFolder() / "speculum-XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    throw std::runtime_error("no temporary directory could be made at " + name + " (name a writable folder in TMPDIR)");
  }
  return name;
}

}  // namespace speculum
