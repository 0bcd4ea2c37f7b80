#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace speculum {

// Returns the text with the letters of ASCII in lower case.
inline std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Says whether the byte continues a character of UTF-8 that an earlier byte begins.
inline bool continuesCharacter(char byte) {
  return (static_cast<unsigned char>(byte) & 0xc0u) == 0x80u;
}

// Makes a message one line that can be read: replaces control characters, which names, keys and arguments may hold, by
// '?', and leaves out the middle of a message of more than 4000 bytes.
std::string oneLine(std::string message);

// Returns the number with this many significant digits, and never fewer than those before the decimal point. Only
// numbers below 1e-4 have an exponent.
std::string significant(double value, int digits);

}  // namespace speculum
