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

}  // namespace speculum
