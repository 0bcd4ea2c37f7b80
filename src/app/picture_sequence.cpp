#include "app/picture_sequence.hpp"

#include <spdlog/fmt/fmt.h>

#include <regex>

#include "app/options.hpp"

namespace speculum {

PictureSequence::PictureSequence(const std::filesystem::path& pattern, int count) {
  const std::string extension = pattern.extension().string();
  if (extension != ".png" && extension != ".exr") {
    throw UsageError("--out: '" + pattern.string() + "' has no known ending (.png or .exr)");
  }
  static const std::regex number("%(0([1-9]))?d");
  const std::string text = pattern.string();
  std::smatch match;
  if (count == 0 || !std::regex_search(text, match, number)) {
    if (count > 1) {
      throw UsageError("--out: '" + text + "' names one file for " + std::to_string(count) +
                       " pictures (a pattern such as dir/%04d.png)");
    }
    before_ = text;
    return;
  }
  before_ = match.prefix();
  after_ = match.suffix();
  digits_ = match[2].matched ? std::stoi(match[2]) : 1;
}

std::filesystem::path PictureSequence::at(int index) const {
  return digits_ > 0 ? fmt::format("{}{:0{}}{}", before_, index, digits_, after_) : before_;
}

}  // namespace speculum
