#include "app/picture_sequence.hpp"

#include <spdlog/fmt/fmt.h>

#include "app/options.hpp"

namespace speculum {

PictureSequence::PictureSequence(const std::filesystem::path& pattern, int count) {
  const std::string extension = pattern.extension().string();
  if (extension != ".png" && extension != ".exr") {
    throw UsageError("--out: '" + pattern.string() + "' has no known ending (.png or .exr)");
  }
  const std::string text = pattern.string();
  before_ = text;
  for (size_t at = count == 0 ? text.npos : text.find('%'); at != text.npos; at = text.find('%', at + 1)) {
    const bool padded = at + 2 < text.size() && text[at + 1] == '0' && text[at + 2] >= '1' && text[at + 2] <= '9';
    const size_t end = at + (padded ? 3 : 1);
    if (end < text.size() && text[end] == 'd') {
      before_ = text.substr(0, at);
      after_ = text.substr(end + 1);
      digits_ = padded ? text[at + 2] - '0' : 1;
      return;
    }
  }
  if (count > 1) {
    throw UsageError("--out: '" + text + "' names one file for " + std::to_string(count) +
                     " pictures (a pattern such as dir/%04d.png)");
  }
}

std::filesystem::path PictureSequence::at(int index) const {
  return digits_ > 0 ? fmt::format("{}{:0{}}{}", before_, index, digits_, after_) : before_;
}

}  // namespace speculum
