#include "ui/elide.hpp"

#include "platform/text.hpp"

namespace speculum {

std::string endsThatFit(const std::string& text, float room, const std::function<float(std::string_view)>& widthOf) {
  if (widthOf(text) <= room) {
    return text;
  }
  for (size_t kept = text.size(); kept > 0; --kept) {
    size_t end = (kept + 1) / 2;              // of the kept start
    size_t begin = text.size() - (kept / 2);  // of the kept end
    while (end > 0 && continuesCharacter(text[end])) {
      --end;
    }
    while (begin < text.size() && continuesCharacter(text[begin])) {
      ++begin;
    }
    std::string both = text.substr(0, end) + "..." + text.substr(begin);
    if (widthOf(both) <= room) {
      return both;
    }
  }
  return "...";
}

std::string brokenAtSpaces(std::string text, float room, const std::function<float(std::string_view)>& widthOf) {
  size_t line = 0;                   // its first character
  size_t space = std::string::npos;  // its last space
  for (size_t end = 0; end <= text.size(); ++end) {
    const bool unit = end + 1 < text.size() && text[end] == ' ' && text[end + 1] == '%';  // stays with its number
    if (end < text.size() && ((text[end] != ' ' && text[end] != '\n') || unit)) {
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
