#pragma once

#include <filesystem>

// What folders.cpp asks the system for: folders_posix.cpp or folders_win32.cpp answers.
namespace speculum {

enum class UserFolder { cache, config, pictures, documents };

// Returns the user's folder where no variable of XDG names one. If there is none, a path that cannot be created.
std::filesystem::path systemFolder(UserFolder folder);

extern const char* const homeVariable;  // environment variable that holds the home folder

}  // namespace speculum
