#include "platform/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace speculum {

std::string oneLine(std::string message) {
  constexpr size_t kLongest = 4000;
  constexpr size_t kEnd = 1000;
  if (message.size() > kLongest) {
    size_t begin = kLongest - kEnd;
    size_t end = message.size() - kEnd;
    while (begin > 0 && continuesCharacter(message[begin])) {
      --begin;
    }
    while (end < message.size() && continuesCharacter(message[end])) {
      ++end;
    }
    message.replace(begin, end - begin, " ... ");
  }
  std::ranges::replace_if(
      message, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return message;
}

std::string significant(double value, int digits) {
  const bool whole = std::abs(value) >= std::pow(10.0, digits) - 0.5;
  std::array<char, 400> text;  // the largest double has 309 digits
  const int length = whole ? std::snprintf(text.data(), text.size(), "%.0f", value)
                           : std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return {text.data(), static_cast<size_t>(length)};
}

}  // namespace speculum
