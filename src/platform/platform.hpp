#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// What depends on the operating system. platform.cpp is the one file of the project that may assume Linux.

std::filesystem::path executablePath();
std::filesystem::path userCacheDir();   // $XDG_CACHE_HOME/speculum or ~/.cache/speculum; not created
std::filesystem::path userConfigDir();  // $XDG_CONFIG_HOME/speculum or ~/.config/speculum; not created
// The user's folder for pictures: $XDG_PICTURES_DIR, what user-dirs.dirs of the configuration says, ~/Pictures.
std::filesystem::path picturesDir();
std::filesystem::path documentsDir();                // likewise $XDG_DOCUMENTS_DIR, ~/Documents
bool isWritable(const std::filesystem::path& file);  // of one that does not exist, its folder

// The directory of shipped data `name` ("shaders", "scenes", "models"): beside the executable, in
// <prefix>/share/speculum, or up to three folders above the executable. Throws std::runtime_error that lists the places
// looked at.
std::filesystem::path dataDirectory(std::string_view name);

struct ProcessResult {
  int exitCode = -1;   // 127 when the program was not found
  std::string output;  // stdout and stderr, interleaved
};
// Searches PATH; no shell takes part.
ProcessResult runProcess(const std::vector<std::string>& arguments);

std::string machineDescription();  // processor, its threads, operating system
uint64_t peakResidentBytes();

// From now on up to 64 MiB a thread that was freed stay with the process. A Vulkan driver that draws on the CPU
// (lavapipe) allocates and frees the vertices of every draw; the C library would hand them back to the system each time
// and fault the same pages in again at the next draw. The user's own MALLOC_ variables win.
void keepFreedMemory();

// Writes beside `file` and renames over it, so that a reader sees the old or the new content. Creates the directory.
// Returns false, leaving the old content, if that fails.
bool replaceFile(const std::filesystem::path& file, std::span<const uint8_t> content);
std::optional<std::vector<uint8_t>> readFile(const std::filesystem::path& file);

// Seconds since an arbitrary epoch with sub-second resolution; nothing for a file that does not exist.
std::optional<double> modificationTime(const std::filesystem::path& file);

void setEnvironment(const std::string& name, const std::string& value);
std::string environment(const std::string& name);  // empty if not set
bool isTerminal(int fileDescriptor);

// Ctrl-C and a termination request only set a flag from now on.
void installInterruptHandler();
bool interruptRequested();

// A directory of this process, removed with its content on destruction.
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

}  // namespace speculum
