#include "edit/recovery.hpp"

#include <utility>

#include "platform/files.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

// Returns the folder of all copies, without links, because a scene's models are found from here when the copy is gone.
fs::path copiesFolder() {
  return withoutLinks(userConfigDir()) / "unsaved";
}

// Returns the file beside a copy that holds the path of what it was made of.
fs::path noteOf(const fs::path& copy) {
  return copy.parent_path() / "original";
}

fs::file_time_type timeOf(const fs::path& file) {
  std::error_code none;
  return fs::last_write_time(file, none);
}

}  // namespace

bool Recovery::isCopy(const fs::path& file) {
  return withoutLinks(file).parent_path().parent_path() == copiesFolder();
}

fs::path Recovery::originalOf(const fs::path& copy) {
  return isCopy(copy) ? readTextIfAny(noteOf(copy), 1u << 16) : "";
}

// Returns the newest copy in a window's folder, without a file if there is none, without a lock if a window holds it.
Recovery::Copy Recovery::held(const fs::path& folder) {
  Copy copy{.lock = lockFolder(folder)};
  std::error_code none;
  for (fs::directory_iterator entry(folder, none); copy.lock && entry != fs::directory_iterator();
       entry.increment(none)) {
    // A link could lead to any other file.
    const bool fits = entry->path().extension() == ".toml" && fs::is_regular_file(entry->symlink_status(none));
    if (fits && (copy.file.empty() || timeOf(*entry) > timeOf(copy.file))) {
      copy.file = *entry;
    }
  }
  return copy;
}

fs::path Recovery::findNewest() {
  std::error_code none;
  for (fs::directory_iterator entry(copiesFolder(), none); entry != fs::directory_iterator(); entry.increment(none)) {
    Copy copy = held(*entry);
    if (!copy.file.empty() && (offered_.file.empty() || timeOf(copy.file) > timeOf(offered_.file))) {
      offered_ = std::move(copy);
    }
  }
  return offered_.file;
}

void Recovery::setScene(const fs::path& file) {
  forget();
  Copy copy = std::exchange(offered_, {});
  if (isCopy(file) && copy.file != file) {
    copy = held(file.parent_path());
  }
  own_ = copy.file == file ? std::move(copy) : Copy();
}

Recovery::Copy Recovery::freeFolder() {
  constexpr int mostFolders = 10'000;
  for (int number = 1; number < mostFolders; ++number) {
    const fs::path folder = copiesFolder() / std::to_string(number);
    std::error_code none;
    fs::create_directories(folder, none);
    Copy copy = held(folder);
    if (copy.file.empty() && (copy.lock || !fs::exists(folder, none))) {
      return {folder / "", std::move(copy.lock)};  // writing says why there is no folder
    }
  }
  throw FileError(copiesFolder(), "is full", "remove what is not needed");
}

fs::path Recovery::keep(const std::string& name, const fs::path& original,
                        const std::function<std::string(const fs::path& file)>& text) {
  if (!isFolder(own_.file.parent_path())) {
    own_ = freeFolder();
  }
  own_.file.replace_filename(fileNameOf(name, ".toml"));
  if (originalOf(own_.file) != original) {
    replaceFile(noteOf(own_.file), std::string_view(original.string()));
  }
  replaceFile(own_.file, text(own_.file));
  return own_.file;
}

void Recovery::remove(Copy& copy) {
  std::error_code none;
  fs::remove_all(copy.file.parent_path(), none);
  copy = {};
}

}  // namespace speculum
