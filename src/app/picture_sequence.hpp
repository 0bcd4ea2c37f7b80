#pragma once

#include <filesystem>
#include <string>

namespace speculum {

// Names the file of each picture of a sequence. The pattern has one %d or %0Nd, or none for a single picture. Throws
// UsageError for endings other than .png and .exr, and for a sequence without a number.
class PictureSequence {
 public:
  PictureSequence(const std::filesystem::path& pattern, int count);
  std::filesystem::path at(int index) const;

 private:
  std::string before_;
  std::string after_;
  int digits_ = 0;  // of the number between; 0: a single picture
};

}  // namespace speculum
