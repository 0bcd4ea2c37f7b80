#pragma once

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

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

// Says whether a file's content is UTF-16 text: begins with its mark, or has the zeros of Latin letters at odd or at
// even offsets alone.
bool isUtf16(std::string_view content);

// Returns the first character of a text in UTF-8, and the number of its bytes. If the text does not begin with a
// character, as some file names, returns its first byte and 0.
std::pair<char32_t, size_t> firstCharacter(std::string_view text);

// Returns the text in UTF-8: a byte that does not belong to a character of it becomes the character that it is in
// Latin-1, which old programs write.
std::string utf8(std::string_view text);

// Returns the text with the escapes of characters in their places.
std::string escaped(std::string_view text, const std::map<char, std::string_view>& escapes);
// Returns the text as a field of CSV, in quotation marks where it needs them: RFC 4180.
std::string csvField(const std::string& text);

// Says whether the whole text matches the pattern, both in UTF-8: * stands for any characters, ? for one, [a-z] and
// [!a-z] for one of a set, and a backslash takes the special meaning from the next one. Names of classes in a set, as
// [[:digit:]], are not known.
bool matchesGlob(std::string_view glob, std::string_view text);

// Makes a text one line that does nothing to the terminal or CI runner that it is printed to, whatever names, keys and
// messages it holds: escapes control characters, marks of direction, bytes that are not UTF-8 and starts of runners'
// commands as \x1b or \u202e, and leaves out the middle of a line of more than 4000 bytes.
std::string oneLine(std::string_view text);
// Applies oneLine() to each line of a text. Indents all lines but the first, so that none passes for a message of its
// own.
std::string indentedLines(std::string_view text);
// Prints oneLine() and a line break. Every command prints through this function.
void printLine(std::string_view text, std::FILE* stream = stdout);

// Returns the number with this many significant digits, but with all digits before the decimal point. Only numbers
// below 1e-4 have an exponent.
std::string significant(double value, int digits);

// Returns `text` (UTF-8) or, if it is wider than `room`, as much of its start and end as fits with "..." between.
// `widthOf` is in the units of `room`.
std::string endsThatFit(const std::string& text, float room, const std::function<float(std::string_view)>& widthOf);

// Returns `text` (UTF-8) or, if it has more bytes than `most`, as much of its start and end with "..." between.
std::string shortened(const std::string& text, size_t most);

// Returns `text` with line breaks in place of spaces, so that no line is wider than `room` unless one word is. A number
// and its % are one word.
std::string brokenAtSpaces(std::string text, float room, const std::function<float(std::string_view)>& widthOf);

}  // namespace speculum
