#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

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
