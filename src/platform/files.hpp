#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// A file that cannot be read or written. what() is `FILE: problem (remedy)`, made one line.
class FileError : public std::runtime_error {
 public:
  FileError(const std::filesystem::path& file, std::string problem, std::string remedy);
  const std::string& problem() const { return problem_; }
  const std::string& remedy() const { return remedy_; }

 private:
  std::string problem_;
  std::string remedy_;
};

// Reads a file. Throws FileError when it is missing, unreadable, a folder, a device or pipe (which might never end), or
// larger than `most` bytes.
std::vector<uint8_t> readFile(const std::filesystem::path& file, uintmax_t most = 1u << 30);
std::string readText(const std::filesystem::path& file, uintmax_t most = 1u << 30);
// Returns nothing for a file that readFile() throws for.
std::optional<std::vector<uint8_t>> readFileIfAny(const std::filesystem::path& file, uintmax_t most = 1u << 30);
std::string readTextIfAny(const std::filesystem::path& file, uintmax_t most = 1u << 30);  // or an empty text

// Writes a new file beside `file` and renames it, once it is on the disk, so that a reader sees the old or the new
// content and a failure leaves the old one. Keeps symbolic links, the mode and, where allowed, the owner; on Windows
// the access list, and links that lead to a file. Devices, pipes with a reader and /dev/fd/N are written to. Throws
// FileError, also when the folder is missing.
void replaceFile(const std::filesystem::path& file, std::span<const uint8_t> content);
void replaceFile(const std::filesystem::path& file, std::string_view text);
// Throws FileError if the folder of `file` is missing, or if `file` is a folder. Call it before work that takes long.
void requirePlaceFor(const std::filesystem::path& file);
// What becomes of a symbolic link that has the name of a file that is written: its target is written, or it is
// replaced.
enum class Links { follow, replace };
// Writes a file whose loss does no harm, and creates its folder. Does not wait for the disk. Returns false on failure.
// Follow links where users may have put them, not in caches, where they may lead to files that are not ours.
bool storeFile(const std::filesystem::path& file, std::span<const uint8_t> content, Links links = Links::replace);
bool storeFile(const std::filesystem::path& file, std::string_view text, Links links = Links::replace);

// Removes entries of a folder, with what is in them, except for the `kept` newest. Entries for which `count` is false
// are not counted and stay.
void keepNewest(const std::filesystem::path& folder, size_t kept,
                const std::function<bool(const std::filesystem::path&)>& count = {});

// Say whether a path leads, through any links, to a regular file or to a folder; false if that cannot be found out.
bool isFile(const std::filesystem::path& path);
bool isFolder(const std::filesystem::path& path);
// Returns the path from the root on, or the path itself if the working folder was deleted.
std::filesystem::path wholePath(const std::filesystem::path& path);
// Returns the whole path without symbolic links, or the path itself where they cannot be followed.
std::filesystem::path withoutLinks(const std::filesystem::path& path);
// Says whether the path of a file leads into a folder. Looks at the paths alone, so call withoutLinks() first.
bool isBelow(const std::filesystem::path& file, const std::filesystem::path& folder);
// Locks a folder while the result or a copy of it lives, and at most as long as this process, however it ends. Returns
// null if the folder is locked already, or is none.
std::shared_ptr<const void> lockFolder(const std::filesystem::path& folder);
// Returns the name with an ending. Cuts the name so that the whole has at most the length that file systems allow.
std::string fileNameOf(const std::string& name, const std::string& ending);
bool isWritable(const std::filesystem::path& file);  // or its folder, if the file does not exist

// A folder of this process, removed with its content on destruction.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::filesystem::path temporaryFolder();  // $TMPDIR or /tmp, whether or not it exists; on Windows %TMP%
std::filesystem::path executablePath();

// The user's folders. On Windows those that no XDG variable names are the system's: below local and roaming application
// data, Pictures and Documents. Elsewhere, without $HOME, they lie in $TMPDIR/speculum-UID, which nobody else can write
// to; if that folder cannot be had, they are paths that cannot be created.
std::filesystem::path userCacheDir();   // $XDG_CACHE_HOME/speculum or ~/.cache/speculum; not created
std::filesystem::path userConfigDir();  // $XDG_CONFIG_HOME/speculum or ~/.config/speculum; not created
// The user's folder for pictures: $XDG_PICTURES_DIR, the one that user-dirs.dirs names, or ~/Pictures.
std::filesystem::path picturesDir();
std::filesystem::path documentsDir();  // $XDG_DOCUMENTS_DIR, the one in user-dirs.dirs, or ~/Documents
// Returns the path that a user means by typing it: "~" as its first part is the home folder, if there is one.
std::filesystem::path typedPath(const std::filesystem::path& typed);

// Returns a sans serif font of the system whose digits are equally wide; empty if there is none.
std::filesystem::path systemFont();

struct FontFace {
  std::filesystem::path file;
  int index = 0;  // of the face in a file that holds several
};
// Returns outline fonts of the system that together have the characters, as far as it has them; those to prefer come
// first. Asks fontconfig (some 10 ms a font); on Windows, the fonts that come with it, whether or not they help.
std::vector<FontFace> fontsFor(std::u32string characters);

// Returns the directory of shipped data `name` ("shaders", "scenes", "models"): beside the executable, in
// <prefix>/share/speculum, or up to three folders above the executable. Throws std::runtime_error that lists where it
// looked.
std::filesystem::path dataDirectory(std::string_view name);

}  // namespace speculum
