#pragma once

#include <filesystem>
#include <fstream>
#include <string_view>

#include "platform/files.hpp"

namespace speculum {

// A folder of one test, which the destructor removes.
class TemporaryFolder : public TemporaryDirectory {
 public:
  std::filesystem::path operator/(std::string_view name) const { return path() / name; }

  // Writes a file, in a folder below if `name` has one.
  std::filesystem::path write(std::string_view name, std::string_view content) const {
    const std::filesystem::path file = path() / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
    return file;
  }
};

}  // namespace speculum
