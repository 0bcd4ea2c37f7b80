#include "ui/elide.hpp"

namespace speculum {

namespace {

// Says whether a UTF-8 character begins with this byte.
bool begins(char c) {
  return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
}

}  // namespace

std::string startThatFits(const std::string& text, float room, const std::function<float(std::string_view)>& widthOf) {
  if (widthOf(text) <= room) {
    return text;
  }
  for (size_t end = text.size(); end > 0; --end) {
    std::string start = text.substr(0, end) + "...";
    if ((end == text.size() || begins(text[end])) && widthOf(start) <= room) {
      return start;
    }
  }
  return "...";
}

std::string brokenAtSpaces(std::string text, float room, const std::function<float(std::string_view)>& widthOf) {
  size_t line = 0;                   // its first character
  size_t space = std::string::npos;  // its last space
  for (size_t end = 0; end <= text.size(); ++end) {
    if (end < text.size() && text[end] != ' ' && text[end] != '\n') {
      continue;
    }
    if (space != std::string::npos && widthOf(std::string_view(text).substr(line, end - line)) > room) {
      text[space] = '\n';
      line = space + 1;
    }
    space = end;
    if (end < text.size() && text[end] == '\n') {
      line = end + 1;
      space = std::string::npos;
    }
  }
  return text;
}

}  // namespace speculum
