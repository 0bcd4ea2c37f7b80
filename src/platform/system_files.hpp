#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "platform/files.hpp"

// What files.cpp shares with its halves for a system, files_posix.cpp and files_win32.cpp, of which CMake compiles one.
namespace speculum {

// The system's own halves.

// replaceFile() and storeFile(): `lasting` waits until the content is on the disk.
void replace(const std::filesystem::path& file, std::span<const uint8_t> content, bool lasting, Links links);
// Makes a folder that nobody else can write to. Throws std::runtime_error.
std::filesystem::path newTemporaryFolder();

enum class UserFolder { cache, config, pictures, documents };

// Returns the user's folder where no variable of XDG names one. If there is none, a path that cannot be created.
std::filesystem::path systemFolder(UserFolder folder);

extern const char* const homeVariable;  // environment variable that holds the home folder

// The common half of files.cpp. `file` is the path that the user gave, for messages; `target` is where its links lead.

std::filesystem::path folderOf(const std::filesystem::path& file);            // "." if it names none
[[noreturn]] void failToWrite(const std::filesystem::path& file, int error);  // of the system; throws FileError
// Throws FileError if the folder of `target` is missing, or if `target` is a folder.
void requirePlaceFor(const std::filesystem::path& file, const std::filesystem::path& target);
// Returns a name beside `target` for what is written before it takes its place.
std::filesystem::path partialName(const std::filesystem::path& target, int number);

}  // namespace speculum
