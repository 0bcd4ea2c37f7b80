#include "app/recovery.hpp"

#include <utility>

#include "platform/files.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

fs::path recordFolder() {
  return userConfigDir() / "unsaved";
}

fs::path recordOf(const fs::path& copy) {
  return recordFolder() / copy.filename();
}

}  // namespace

const std::optional<fs::path>& Recovery::findNewest() {
  std::error_code none;
  fs::file_time_type time;
  for (const auto& record : fs::directory_iterator(recordFolder(), none)) {
    const fs::path copy = readTextIfAny(record);
    if (isFile(copy) && (!copy_ || record.last_write_time(none) > time)) {
      copy_ = copy;
      time = record.last_write_time(none);
    }
  }
  return copy_;
}

bool Recovery::isRecorded(const fs::path& copy) {
  std::error_code none;
  return fs::exists(recordOf(copy), none);
}

void Recovery::record(const fs::path& copy, bool keepsEarlier) {
  storeFile(recordOf(copy), copy.string());
  if (copy != copy_ && !keepsEarlier) {
    forget();
  }
  copy_ = copy;
}

void Recovery::forget() {
  if (copy_) {
    std::error_code none;
    fs::remove(recordOf(*std::exchange(copy_, std::nullopt)), none);
  }
}

void Recovery::postpone(const fs::path& file) {
  if (file != copy_) {
    copy_.reset();
  }
}

}  // namespace speculum
