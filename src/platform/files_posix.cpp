#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/system_files.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

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
  const fs::path folder = configuredDir(variable, home);
  return folder.is_absolute() ? folder : home / fallback;
}

// Returns the ranges of a set of characters as fontconfig prints it: "20-7e a0 1f600".
std::vector<std::pair<char32_t, char32_t>> rangesIn(const std::string& charset) {
  std::vector<std::pair<char32_t, char32_t>> ranges;
  std::istringstream words(charset);
  for (std::string word; words >> word;) {
    char* end = nullptr;
    const unsigned long first = std::strtoul(word.c_str(), &end, 16);
    const unsigned long last = *end == '-' ? std::strtoul(end + 1, nullptr, 16) : first;
    ranges.emplace_back(static_cast<char32_t>(first), static_cast<char32_t>(last));
  }
  return ranges;
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
  fs::path partial;
  int descriptor = -1;
  for (int number = 0; descriptor < 0; ++number) {
    partial = partialName(target, number);
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

const char* const homeVariable = "HOME";

fs::path systemFolder(UserFolder folder) {
  switch (folder) {
    case UserFolder::cache:
      return homeFolder() / ".cache";
    case UserFolder::config:
      return homeFolder() / ".config";
    case UserFolder::pictures:
      return desktopDir("XDG_PICTURES_DIR", "Pictures");
    case UserFolder::documents:
      break;
  }
  return desktopDir("XDG_DOCUMENTS_DIR", "Documents");
}

fs::path temporaryFolder() {
  const fs::path folder = environment("TMPDIR");
  return folder.empty() ? fs::path("/tmp") : folder;
}

fs::path executablePath() {
  return fs::read_symlink("/proc/self/exe");
}

fs::path systemFont() {
  for (const char* file : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                           "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                           "/usr/share/fonts/truetype/roboto/unhinted/RobotoTTF/Roboto-Regular.ttf",
                           "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"}) {
    if (isFile(file)) {
      return file;
    }
  }
  const ProcessResult found = runProcess({"fc-match", "-f", "%{file}", "sans-serif:fontformat=TrueType"});
  return found.exitCode == 0 && isFile(found.output) ? fs::path(found.output) : fs::path();
}

// Fontconfig answers with the font that lacks the fewest of the characters, which may be all.
std::vector<FontFace> fontsFor(std::u32string characters) {
  std::vector<FontFace> fonts;
  constexpr int most = 16;  // fonts that are asked for: each takes memory and time
  for (int asked = 0; !characters.empty() && asked < most; ++asked) {
    std::string pattern = "sans-serif:scalable=true:outline=true:color=false:charset=";
    for (const char32_t character : characters) {
      pattern += fmt::format("{:x} ", uint32_t{character});
    }
    const ProcessResult found =
        runProcess({"fc-match", "-f", "\nfont\n%{file}\n%{index}\n%{outline}%{color}\n%{charset}", pattern});
    std::istringstream lines(found.exitCode == 0 ? found.output : "");
    std::string file, index, kind, charset;
    while (std::getline(lines, file) && file != "font") {  // warnings may come before it
    }
    std::getline(lines, file) && std::getline(lines, index) && std::getline(lines, kind) &&
        std::getline(lines, charset);
    const auto ranges = rangesIn(charset);
    const size_t helped = std::erase_if(characters, [&](char32_t character) {
      return std::ranges::any_of(
          ranges, [&](const auto& range) { return range.first <= character && character <= range.second; });
    });
    if (helped == 0) {
      break;
    }
    if (!kind.starts_with("TrueFalse") || !isFile(file)) {
      continue;
    }
    constexpr unsigned long faceBits = 0xffff;  // the others name a variant of the face
    fonts.push_back({file, static_cast<int>(std::strtoul(index.c_str(), nullptr, 10) & faceBits)});
  }
  return fonts;
}

}  // namespace speculum
