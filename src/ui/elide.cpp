#include "ui/elide.hpp"

namespace speculum {

namespace {

// Says whether a UTF-8 character begins with this byte.
bool begins(char c) {
  return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u;
}

}  // namespace

std::string endThatFits(const std::string& text, float room, const std::function<float(std::string_view)>& widthOf) {
  if (widthOf(text) <= room) {
    return text;
  }
  for (size_t start = 1; start < text.size(); ++start) {
    std::string end = "..." + text.substr(start);
    if (begins(text[start]) && widthOf(end) <= room) {
      return end;
    }
  }
  return "...";
}

}  // namespace speculum
