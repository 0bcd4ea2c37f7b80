#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/scene.hpp"
#include "session/options.hpp"

namespace speculum {

// The files that a command reads or writes. Different paths to one file, also through links, count as that file. Leaves
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

// Makes the folder of --out, and keeps other commands out of it while the result lives. Throws UsageError if it cannot
// be made or another command writes there.
std::shared_ptr<const void> claimFolder(const std::filesystem::path& out);

// Names the file of each picture of a sequence. The pattern has one %d or %0Nd, or none for a single picture; with a
// `count` of 0 it is a file name as it stands. Throws UsageError for endings other than .png and .exr, and for a
// sequence without a number.
class PictureSequence {
 public:
  PictureSequence(const std::filesystem::path& pattern, int count);
  std::filesystem::path at(int index) const;

 private:
  std::string before_;
  std::string after_;
  int digits_ = 0;  // of the number between before_ and after_; 0: a single picture
};

}  // namespace speculum
