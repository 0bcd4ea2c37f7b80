#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/options.hpp"
#include "scene/scene.hpp"

namespace speculum {

// The files that a command reads or writes. Different paths to a file, also through links, count as the same. Leaves
// out devices and pipes, because writing does not replace them.
class UsedFiles {
 public:
  // Adds a file, with words that name it in an error. Ignores an empty path.
  void add(std::string_view words, const std::filesystem::path& file);
  // Throws UsageError if an option's output is one of the files.
  void requireUnused(std::string_view option, const std::filesystem::path& file);

 private:
  static bool isReplaced(const std::filesystem::path& file);
  // Resolves the links of each folder only once.
  std::filesystem::path resolved(const std::filesystem::path& file);

  std::map<std::filesystem::path, std::string> used_;
  std::map<std::filesystem::path, std::filesystem::path> folders_;
};

// Refuse an output that would replace another output or a file that the command reads. The first checks files that
// options name, the second the file of the loaded scene, its models, materials and textures. Devices and pipes may be
// named twice. Throw UsageError.
void requireFilesOfTheirOwn(const Options& options);
void requireFilesOfTheirOwn(const Options& options, const Scene& scene);

}  // namespace speculum
