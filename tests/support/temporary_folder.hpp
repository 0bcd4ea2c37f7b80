#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "platform/files.hpp"

namespace speculum {

// A folder of one test's own, removed with it.
class TemporaryFolder {
 public:
  std::filesystem::path operator/(std::string_view name) const { return directory_.path() / name; }

  std::filesystem::path write(std::string_view name, std::string_view content) const {
    const std::filesystem::path file = *this / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }

 private:
  TemporaryDirectory directory_;
};

}  // namespace speculum
