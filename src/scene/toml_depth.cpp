#include "scene/toml_depth.hpp"

#include <algorithm>
#include <cstddef>

namespace speculum {

namespace {

// Returns the end of the string that begins at `start` with a quotation mark, or of the part that an unfinished one
// spans.
size_t endOfString(std::string_view toml, size_t start) {
  const char quote = toml[start];
  const bool multiLine = toml.substr(start, 3) == std::string_view(quote == '"' ? "\"\"\"" : "'''");
  const size_t marks = multiLine ? 3 : 1;
  size_t i = start + marks;
  while (i < toml.size()) {
    if (toml[i] == '\\' && quote == '"') {
      i += 2;
    } else if (toml[i] == '\n' && !multiLine) {
      return i;
    } else if (toml.substr(i, marks) == toml.substr(start, marks)) {
      i += marks;
      // Up to two quotation marks may stand right before the closing three.
      for (int extra = 0; extra < 2 && multiLine && i < toml.size() && toml[i] == quote; ++extra) {
        ++i;
      }
      return i;
    } else {
      ++i;
    }
  }
  return toml.size();
}

// Line of the first character outside strings and comments for which `stop` is true, or 0.
template <typename Stop>
int lineOf(std::string_view toml, Stop stop) {
  int line = 1;
  for (size_t i = toml.starts_with("\xef\xbb\xbf") ? 3 : 0; i < toml.size();) {
    const size_t start = i;
    const char c = toml[i++];
    if (c == '"' || c == '\'') {
      i = endOfString(toml, start);
      for (const char skipped : toml.substr(start, i - start)) {
        line += skipped == '\n' ? 1 : 0;
      }
    } else if (c == '#') {
      i = std::min(toml.find('\n', i), toml.size());
    } else if (stop(c)) {
      return line;
    } else if (c == '\n') {
      ++line;
    }
  }
  return 0;
}

}  // namespace

int lineOfTooDeepKey(std::string_view toml) {
  constexpr int kMostDots = 31;
  int dots = 0;
  return lineOf(toml, [&](char c) {
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) {
      dots = 0;
    }
    dots += c == '.' ? 1 : 0;
    return dots > kMostDots;
  });
}

int lineOfStrayCharacter(std::string_view toml) {
  return lineOf(toml, [](char c) { return static_cast<unsigned char>(c) > 0x7f; });
}

}  // namespace speculum
