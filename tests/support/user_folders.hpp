#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "platform/files.hpp"
#include "platform/process.hpp"

namespace speculum::testing_support {

// Empty folders in the place of the user's own, which tests must neither read nor write. Environment variables name
// them.
class UserFolders {
 public:
  UserFolders(std::initializer_list<const char*> variables) {
    for (const char* name : variables) {
      before_.emplace_back(name, environment(name));
      setEnvironment(name, (path() / name).string());
    }
  }
  ~UserFolders() {
    for (const auto& [name, value] : before_) {
      setEnvironment(name, value);
    }
  }
  UserFolders(const UserFolders&) = delete;
  UserFolders& operator=(const UserFolders&) = delete;

  const std::filesystem::path& path() const { return home_.path(); }
  // Returns the screenshots and recordings that were saved.
  static std::vector<std::filesystem::path> pictures() {
    std::error_code none;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(picturesDir() / "Speculum", none)) {
      files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
  }

 private:
  TemporaryDirectory home_;
  std::vector<std::pair<std::string, std::string>> before_;
};

}  // namespace speculum::testing_support
