#include "platform/text.hpp"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <bit>
#include <cmath>
#include <tuple>

namespace speculum {

bool isUtf16(std::string_view content) {
  const std::string_view begin = content.substr(0, 4096);
  std::array<size_t, 2> zeros{};
  for (size_t i = 0; i < begin.size(); ++i) {
    zeros[i % 2] += begin[i] == '\0';
  }
  const auto [least, most] = std::minmax(zeros[0], zeros[1]);
  return content.starts_with("\xff\xfe") || content.starts_with("\xfe\xff") ||
         (4 * most > begin.size() && 50 * least < most);
}

std::pair<char32_t, size_t> firstCharacter(std::string_view text) {
  static constexpr std::array<char32_t, 5> least{0, 0x110000, 0x80, 0x800, 0x10000};
  const auto lead = static_cast<uint8_t>(text[0]);
  const auto ones = static_cast<size_t>(std::countl_one(lead));
  char32_t code = lead & (0x7fu >> ones);
  for (size_t i = 1; i < ones; ++i) {
    code = i < text.size() && continuesCharacter(text[i]) ? code << 6 | (text[i] & 0x3fu) : 0;
  }
  const bool valid = ones < least.size() && code >= least[ones] && code < 0x110000 && code >> 11 != 0xd800 >> 11;
  return valid ? std::pair(code, std::max<size_t>(ones, 1)) : std::pair<char32_t, size_t>(lead, 0);
}

namespace {

// Says whether a code is a control character, a mark that turns the direction of text, a line separator or no
// character.
bool isHidden(char32_t code) {
  static constexpr std::array<char32_t, 14> bounds{0,      0x20,   0x7f,   0xa0,   0x61c,  0x61d,  0x200e,
                                                   0x2010, 0x2028, 0x202f, 0x2060, 0x2070, 0xfdd0, 0xfdf0};
  return (std::ranges::upper_bound(bounds, code) - bounds.begin()) % 2 == 1 || (code & 0xfffeu) == 0xfffeu;
}

// Returns the first character and its length. A byte that is no character counts as one, with a code of its own.
std::pair<char32_t, size_t> characterOf(std::string_view text) {
  const auto [code, bytes] = firstCharacter(text);
  return bytes > 0 ? std::pair(code, bytes) : std::pair<char32_t, size_t>(0x110000 + code, 1);
}

// Reads one element of a pattern, at `glob`, but no *. Returns its length, and whether it stands for the character. A
// set that does not end is a bracket.
std::pair<size_t, bool> matchElement(std::string_view glob, char32_t wanted) {
  if (glob[0] == '?') {
    return {1, true};
  }
  size_t at = 0;  // in the pattern
  const auto next = [&] {
    at += glob[at] == '\\' && at + 1 < glob.size() ? 1 : 0;
    const auto [code, bytes] = characterOf(glob.substr(at));
    at += bytes;
    return code;
  };
  if (glob[0] == '[') {
    const bool negated = glob.size() > 1 && (glob[1] == '!' || glob[1] == '^');
    const size_t first = negated ? 2 : 1;
    bool found = false;
    for (at = first; at < glob.size();) {
      if (glob[at] == ']' && at > first) {
        return {at + 1, found != negated};
      }
      const char32_t low = next();
      char32_t high = low;
      if (at + 1 < glob.size() && glob[at] == '-' && glob[at + 1] != ']') {
        ++at;
        high = next();
      }
      found = found || (low <= wanted && wanted <= high);
    }
    at = 0;
  }
  const bool matches = next() == wanted;
  return {at, matches};
}

}  // namespace

std::string utf8(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (size_t i = 0, bytes = 0; i < text.size(); i += std::max<size_t>(bytes, 1)) {
    char32_t code = 0;
    std::tie(code, bytes) = firstCharacter(text.substr(i));
    result += bytes > 0 ? std::string(text.substr(i, bytes))
                        : std::string{static_cast<char>(0xc0u | code >> 6), static_cast<char>(0x80u | (code & 0x3fu))};
  }
  return result;
}

std::string escaped(std::string_view text, const std::map<char, std::string_view>& escapes) {
  std::string result;
  for (const char c : text) {
    const auto found = escapes.find(c);
    result += found == escapes.end() ? std::string_view(&c, 1) : found->second;
  }
  return result;
}

std::string csvField(const std::string& text) {
  return text.find_first_of(",\"\r\n") == std::string::npos ? text : "\"" + escaped(text, {{'"', "\"\""}}) + "\"";
}

bool matchesGlob(std::string_view glob, std::string_view text) {
  size_t star = std::string_view::npos;  // after the last * so far
  size_t tried = 0;                      // first character of the text that this * does not stand for
  size_t g = 0;
  for (size_t t = 0; t < text.size() || g < glob.size();) {
    if (g < glob.size() && glob[g] == '*') {
      star = ++g;
      tried = t;
      continue;
    }
    const auto [code, bytes] = t < text.size() ? characterOf(text.substr(t)) : std::pair<char32_t, size_t>();
    const auto [length, matches] =
        g < glob.size() && bytes > 0 ? matchElement(glob.substr(g), code) : std::pair<size_t, bool>();
    if (matches) {
      g += length;
      t += bytes;
    } else if (star != std::string_view::npos && tried < text.size()) {
      g = star;
      t = tried += characterOf(text.substr(tried)).second;
    } else {
      return false;
    }
  }
  return true;
}

std::string oneLine(std::string_view text) {
  std::string line;
  bool begun = false;  // `line` has a visible character of ASCII
  for (size_t i = 0, bytes = 0; i < text.size(); i += std::max<size_t>(bytes, 1)) {
    char32_t code = 0;
    std::tie(code, bytes) = firstCharacter(text.substr(i));
    // Runners act on a line that begins with ::, and on ##[, ##vso[ or ##teamcity[ anywhere in it.
    const bool runs = code == '#' ? i > 0 && text[i - 1] == '#' : !begun && text.substr(i).starts_with("::");
    if (runs || bytes == 0 || isHidden(code)) {
      line += bytes > 1 ? fmt::format("\\u{:04x}", uint32_t{code}) : fmt::format("\\x{:02x}", uint32_t{code});
    } else {
      line += text.substr(i, bytes);
    }
    begun = begun || (line.back() > 0x20 && line.back() < 0x7f);
  }
  return shortened(line, 4000);
}

std::string indentedLines(std::string_view text) {
  std::string lines;
  for (size_t at = 0; at < text.size();) {
    const size_t length = std::min(text.find('\n', at), text.size()) - at;
    lines += (at == 0 ? "" : "\n  ") + oneLine(text.substr(at, length));
    at += length + 1;
  }
  return lines;
}

void printLine(std::string_view text, std::FILE* stream) {
  std::fputs((oneLine(text) + "\n").c_str(), stream);
}

std::string significant(double value, int digits) {
  const bool whole = std::abs(value) >= std::pow(10.0, digits) - 0.5;
  return whole ? fmt::format("{:.0f}", value) : fmt::format("{:.{}g}", value, digits);
}

std::string endsThatFit(const std::string& text, float room, const std::function<float(std::string_view)>& widthOf) {
  if (widthOf(text) <= room) {
    return text;
  }
  std::string longest = "...";
  for (size_t fits = 0, most = text.size(); fits < most;) {
    const size_t kept = (fits + most + 1) / 2;
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
      longest = std::move(both);
      fits = kept;
    } else {
      most = kept - 1;
    }
  }
  return longest;
}

std::string shortened(const std::string& text, size_t most) {
  const auto bytes = [](std::string_view part) { return static_cast<float>(part.size()); };
  return endsThatFit(text, static_cast<float>(most), bytes);
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
