#include "app/recovery.hpp"

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

void recordRecovery(const fs::path& copy) {
  storeFile(recordOf(copy), copy.string());
}

bool hasRecovery(const fs::path& copy) {
  std::error_code none;
  return fs::exists(recordOf(copy), none);
}

std::optional<fs::path> newestRecovery() {
  std::error_code none;
  std::optional<fs::path> newest;
  fs::file_time_type time;
  for (const auto& record : fs::directory_iterator(recordFolder(), none)) {
    const fs::path copy = readTextIfAny(record);
    if (isFile(copy) && (!newest || record.last_write_time(none) > time)) {
      newest = copy;
      time = record.last_write_time(none);
    }
  }
  return newest;
}

void forgetRecovery(const fs::path& copy) {
  std::error_code none;
  fs::remove(recordOf(copy), none);
}

}  // namespace speculum
