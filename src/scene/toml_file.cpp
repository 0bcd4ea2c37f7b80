#include "scene/toml_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "platform/text.hpp"
#include "scene/input_error.hpp"
#include "scene/text_lines.hpp"

namespace speculum {

namespace {

namespace fs = std::filesystem;

constexpr uintmax_t largestFile = 16u << 20;  // bytes; no scene written by hand is larger

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

// Returns the line of the first character outside strings and comments for which `stop` is true, or 0.
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

// Returns the text of a line, as much as a message has room for.
std::string excerptOf(std::string_view toml, int line) {
  constexpr size_t longest = 60;
  for (int before = 1; before < line && !toml.empty(); ++before) {
    toml.remove_prefix(std::min(toml.find('\n'), toml.size() - 1) + 1);
  }
  return shortened(std::string(trimmed(toml.substr(0, toml.find('\n')))), longest);
}

// Says how TOML writes what could not be parsed. `problem` is the library's message: what was being parsed, and what is
// wrong.
std::string_view rightToml(std::string_view problem) {
  struct Rule {
    std::string_view part;  // text that the problem contains
    std::string_view right;
  };
  // The first rule that applies counts, so rules about what is wrong stand before rules about where.
  static constexpr Rule rules[] = {
      {"redefine", ", where a key stands once in its table, a table once, and [[name]] begins one of several tables"},
      {"table header:", ", where [name] begins a table, and [[name]] one of several"},
      {"key-value pair:", ", where a line is key = value, with several numbers as [1, 2, 3]"},
      {"root table:", ", where a line is key = value, with several numbers as [1, 2, 3]"},
      {"escape sequence", ", where a \\ is \\\\ in a text in \"...\", and itself in '...'"},
      {"string:", ", where a text ends with the quotation marks that begin it, on its line unless they are three"},
      {"boolean:", ", where true and false are written so, and a text stands in quotation marks"},
      {"value:", ", where a value is a number, true, false, a text in quotation marks, [1, 2, 3] or { key = 1 }"},
      {"integer:", ", where a number is such as 2, 0.5 or 1e-3"},
      {"floating-point:", ", where a number is such as 2, 0.5 or 1e-3"},
      {"array:", ", where an array is [1, 2, 3]"},
      {"inline table:", ", where { key = 1, other = 2 } stands on one line"},
  };
  const auto rule = std::ranges::find_if(
      rules, [&](const Rule& candidate) { return problem.find(candidate.part) != std::string_view::npos; });
  return rule == std::end(rules) ? "" : rule->right;
}

}  // namespace

std::string readTomlText(const fs::path& file, std::string_view kind) {
  return readInputText(file, fmt::format("a {} is needed", kind), largestFile);
}

toml::table readToml(const fs::path& file, std::string_view kind) {
  return parseToml(file, readTomlText(file, kind), kind);
}

toml::table parseToml(const fs::path& file, std::string_view text, std::string_view kind) {
  if (isUtf16(text)) {
    throwInputError(file, 1, "toml", "is UTF-16 text", "save it as UTF-8");
  }
  if (const int line = lineOfTooDeepKey(text)) {
    throwInputError(file, line, "toml", "a key has too many parts",
                    fmt::format("no key of a {} has more than 3", kind));
  }
  if (const int line = lineOfStrayCharacter(text)) {
    throwInputError(file, line, "toml", "a character that is not ASCII stands outside quotation marks",
                    "a TOML 1.0 file is needed, which quotes such keys and texts");
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const int line = std::max(1, static_cast<int>(error.source().begin.line));
    std::string_view problem = error.description();
    constexpr std::string_view prefix = "Error while parsing ";
    problem.remove_prefix(problem.starts_with(prefix) ? prefix.size() : 0);
    throwInputError(file, line, "toml", fmt::format("{}, in '{}'", problem, excerptOf(text, line)),
                    fmt::format("a TOML 1.0 file is needed{}", rightToml(problem)));
  }
}

int lineOfTooDeepKey(std::string_view toml) {
  constexpr int mostDots = 31;
  int dots = 0;
  return lineOf(toml, [&](char c) {
    if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) {
      dots = 0;
    }
    dots += c == '.' ? 1 : 0;
    return dots > mostDots;
  });
}

int lineOfStrayCharacter(std::string_view toml) {
  return lineOf(toml, [](char c) { return static_cast<unsigned char>(c) > 0x7f; });
}

std::string tomlText(double value) {
  const double size = std::abs(value);
  // An integer has no negative zero.
  if (value == std::trunc(value) && size < 1e15 && !(value == 0.0 && std::signbit(value))) {
    return std::to_string(static_cast<int64_t>(value));
  }
  if (value == 0.0) {
    return "-0.0";
  }
  std::array<char, 64> text;
  const bool plain = size >= 1e-5 && size < 1e15;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 plain ? std::chars_format::fixed : std::chars_format::scientific)
                       .ptr;
  return {text.data(), end};
}

std::string tomlText(int value) {
  return std::to_string(value);
}

std::string tomlText(const glm::dvec2& value) {
  return fmt::format("[{}, {}]", tomlText(value.x), tomlText(value.y));
}

std::string tomlText(const glm::dvec3& value) {
  return fmt::format("[{}, {}, {}]", tomlText(value.x), tomlText(value.y), tomlText(value.z));
}

std::string tomlText(const std::vector<glm::dvec3>& values) {
  std::string text;
  for (const glm::dvec3& value : values) {
    text += (text.empty() ? "" : ", ") + tomlText(value);
  }
  return "[" + text + "]";
}

std::string tomlText(bool value) {
  return value ? "true" : "false";
}

std::string tomlText(std::string_view value) {
  std::string text = "\"";
  for (size_t i = 0; i < value.size(); ++i) {
    const char c = value[i];
    if (c == '"' || c == '\\') {
      text.append(1, '\\').append(1, c);
    } else if (c == '\n') {
      text += "\\n";
    } else if (c == '\t') {
      text += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      text += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else if (const size_t length = firstCharacter(value.substr(i)).second; length > 0) {
      text += value.substr(i, length);
      i += length - 1;
    } else {
      text += utf8(value.substr(i, 1));
    }
  }
  return text + "\"";
}

std::string tomlKey(std::string_view key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? std::string(key) : tomlText(key);
}

}  // namespace speculum
