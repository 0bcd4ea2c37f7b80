#include "fuzz_support.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <fstream>

namespace speculum::fuzz {

namespace fs = std::filesystem;

InputFolder::InputFolder(std::string_view kind) {
  // Warnings are thousands a second and say nothing here.
  spdlog::set_level(spdlog::level::off);
  std::string pattern = (fs::temp_directory_path() / ("speculum-" + std::string(kind) + "-XXXXXX")).string();
  if (mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("no folder " + pattern);
  }
  path_ = pattern;
}

InputFolder::~InputFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path InputFolder::write(std::string_view name, std::string_view content) const {
  const fs::path file = path_ / name;
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

void require(bool kept, const char* promise) {
  if (!kept) {
    throw BrokenPromise(promise);
  }
}

}  // namespace speculum::fuzz
