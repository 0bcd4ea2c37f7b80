#include "app/recovery.hpp"

#include <string>

#include "platform/files.hpp"
#include "platform/folders.hpp"

namespace speculum {

namespace fs = std::filesystem;

namespace {

fs::path recordFile() {
  return userConfigDir() / "recovery";
}

}  // namespace

void recordRecovery(const fs::path& copy) {
  storeFile(recordFile(), copy.string());
}

std::optional<fs::path> recoveryCopy() {
  const auto record = readFileIfAny(recordFile());
  const fs::path copy = record ? fs::path(std::string(record->begin(), record->end())) : fs::path();
  std::error_code none;
  return fs::is_regular_file(copy, none) ? std::optional(copy) : std::nullopt;
}

void forgetRecovery() {
  std::error_code none;
  fs::remove(recordFile(), none);
}

}  // namespace speculum
