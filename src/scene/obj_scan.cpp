#include "scene/obj_scan.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "scene/input_error.hpp"

namespace speculum {

namespace {

// Triangulation takes time in the square of this.
constexpr size_t kMostCorners = 1000;
// The parser keeps some kilobytes for each material.
constexpr size_t kMostMaterials = 10'000;

constexpr std::string_view kBlanks = " \t\r\n\v\f";

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> tokens;
  for (size_t begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    tokens.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return tokens;
}

// Nothing when malformed; infinite or NaN values, spelled or overflown, are returned as they are.
std::optional<double> parseNumber(std::string_view token) {
  if (token.starts_with('+')) {
    token.remove_prefix(1);
    if (token.starts_with('-')) {
      return std::nullopt;
    }
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (end != token.data() + token.size() || error == std::errc::invalid_argument) {
    return std::nullopt;
  }
  // from_chars does not tell overflow from underflow.
  return error == std::errc() ? value : std::strtod(std::string(token).c_str(), nullptr);
}

class LineScanner {
 public:
  // With `continued`, a backslash at the end of a line joins the next one to it.
  LineScanner(const std::filesystem::path& file, std::string_view text, bool continued)
      : file_(file), rest_(text), continued_(continued) {
    if (rest_.starts_with("\xef\xbb\xbf")) {
      rest_.remove_prefix(3);
    }
  }

  // The next line that holds anything but blanks and a comment, as its tokens.
  bool next() {
    while (!rest_.empty()) {
      number_ += linesTaken_;
      linesTaken_ = 0;
      line_ = takeLine();
      if (continued_ && continues(line_)) {
        joinContinuation();
      }
      if (line_.find('\0') != std::string_view::npos) {
        fail("file", "is not a text file", "a Wavefront OBJ or MTL file is needed");
      }
      tokens_ = split(line_.substr(0, std::min(line_.find('#'), line_.size())));
      if (!tokens_.empty()) {
        return true;
      }
    }
    return false;
  }

  std::string_view keyword() const { return tokens_[0]; }
  // All after the keyword, blanks inside included.
  std::string_view argument() const { return trimmed(line_.substr(line_.find(tokens_[0]) + tokens_[0].size())); }
  // All from one of the tokens on.
  std::string_view from(std::string_view token) const { return trimmed(line_.substr(token.data() - line_.data())); }
  const std::vector<std::string_view>& tokens() const { return tokens_; }
  std::string joinedTokens() const { return fmt::format("{}", fmt::join(tokens_, " ")); }
  int number() const { return number_; }

  [[noreturn]] void fail(std::string_view key, const std::string& wrong, const std::string& right) const {
    throwInputError(file_, number_, key, wrong, right);
  }

  // The numbers after the keyword.
  std::vector<double> numbers(size_t least, size_t most) const {
    std::vector<double> values;
    for (size_t i = 1; i < tokens_.size(); ++i) {
      const std::optional<double> value = parseNumber(tokens_[i]);
      if (!value) {
        fail(keyword(), fmt::format("'{}' is not a number", tokens_[i]), "write for example 0.5 or -1e-3");
      }
      values.push_back(*value);
    }
    if (values.size() < least || values.size() > most) {
      const std::string right = least == most ? fmt::to_string(least) : fmt::format("{} .. {}", least, most);
      fail(keyword(), fmt::format("has {} numbers", values.size()), right + " are needed");
    }
    return values;
  }

 private:
  // A backslash that ends a comment is part of the comment.
  static bool continues(std::string_view line) {
    return line.ends_with('\\') && line.find('#') == std::string_view::npos;
  }

  std::string_view takeLine() {
    const size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    const bool crLf = rest_.substr(end).starts_with("\r\n");
    rest_.remove_prefix(std::min(end + (crLf ? 2 : 1), rest_.size()));
    ++linesTaken_;
    return line;
  }

  void joinContinuation() {
    joined_.clear();
    while (continues(line_)) {
      joined_.append(line_.substr(0, line_.size() - 1)).push_back(' ');
      line_ = rest_.empty() ? std::string_view() : takeLine();
    }
    joined_.append(line_);
    line_ = joined_;
  }

  const std::filesystem::path& file_;
  std::string_view rest_;
  bool continued_;
  std::string_view line_;
  std::string joined_;  // what line_ shows of a continued line
  std::vector<std::string_view> tokens_;
  int number_ = 1;      // of the first of the lines that line_ joins
  int linesTaken_ = 0;  // that line_ joins
};

bool allFinite(const std::vector<double>& values, size_t count) {
  for (size_t i = 0; i < std::min(count, values.size()); ++i) {
    if (!std::isfinite(values[i])) {
      return false;
    }
  }
  return true;
}

void checkIndex(const LineScanner& line, std::string_view text, const char* kind, size_t count) {
  long long index = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (text.empty() || end != text.data() + text.size() || error == std::errc::invalid_argument) {
    line.fail("f", fmt::format("'{}' is not an index", text), "write v, v/vt, v//vn or v/vt/vn");
  }
  const long long largest = static_cast<long long>(count);
  if (error != std::errc() || index == 0 || index > largest || index < -largest) {
    const std::string range =
        count == 0 ? fmt::format("there is no {} line above", kind) : fmt::format("1 .. {0}, or -{0} .. -1", count);
    line.fail("f", fmt::format("{} index {} is out of range", kind, text), range);
  }
}

void checkFace(const LineScanner& line, const ObjScan& scan) {
  const std::vector<std::string_view>& tokens = line.tokens();
  if (tokens.size() < 4) {
    line.fail("f", fmt::format("has {} vertices", tokens.size() - 1), "a face needs 3 or more");
  }
  if (tokens.size() - 1 > kMostCorners) {
    line.fail("f", fmt::format("has {} vertices", tokens.size() - 1), fmt::format("3 .. {} are needed", kMostCorners));
  }
  for (size_t i = 1; i < tokens.size(); ++i) {
    const std::string_view corner = tokens[i];
    const size_t first = corner.find('/');
    checkIndex(line, corner.substr(0, first), "v", scan.finitePosition.size());
    if (first == std::string_view::npos) {
      continue;
    }
    const size_t second = corner.find('/', first + 1);
    const std::string_view texcoord =
        corner.substr(first + 1, second == std::string_view::npos ? second : second - first - 1);
    if (second == std::string_view::npos || !texcoord.empty()) {
      checkIndex(line, texcoord, "vt", scan.finiteTexcoord.size());
    }
    if (second != std::string_view::npos) {
      checkIndex(line, corner.substr(second + 1), "vn", scan.finiteNormal.size());
    }
  }
}

// Written anew: the parser's own arithmetic overflows on 1e2147483648.
std::string lineOf(std::string_view keyword, const std::vector<double>& numbers, size_t count) {
  std::string text(keyword);
  for (size_t i = 0; i < std::min(count, numbers.size()); ++i) {
    text += ' ' + (std::isfinite(numbers[i]) ? fmt::to_string(numbers[i]) : "0");
  }
  return text;
}

// What the parser is to see of a line.
std::string scanLine(const LineScanner& line, ObjScan& scan) {
  const std::string keyword(line.keyword());
  const bool position = keyword == "v";
  if (position || keyword == "vn" || keyword == "vt") {
    const size_t used = keyword == "vt" ? 2 : 3;
    const std::vector<double> numbers = line.numbers(used == 2 ? 1 : 3, position ? 8 : 3);
    std::vector<bool>& finite = position ? scan.finitePosition : used == 2 ? scan.finiteTexcoord : scan.finiteNormal;
    finite.push_back(allFinite(numbers, used));
    return lineOf(keyword, numbers, used);
  }
  if (keyword == "f") {
    checkFace(line, scan);
    return line.joinedTokens();
  }
  return keyword == "usemtl" || keyword == "mtllib" ? keyword + " " + std::string(line.argument()) : "";
}

// The words that an option of a texture takes behind it; those of -o, -s and -t, up to 3, are numbers. -1: no option.
int wordsOf(std::string_view option) {
  constexpr std::array<std::string_view, 10> one{"-blendu", "-blendv", "-cc",      "-clamp", "-boost",
                                                 "-bm",     "-texres", "-imfchan", "-type",  "-colorspace"};
  if (option == "-o" || option == "-s" || option == "-t") {
    return 3;
  }
  return option == "-mm" ? 2 : std::find(one.begin(), one.end(), option) != one.end() ? 1 : -1;
}

// The file name, which may hold blanks, behind the options, none of which is used.
std::string_view textureName(const LineScanner& line) {
  const std::vector<std::string_view>& tokens = line.tokens();
  size_t i = 1;
  while (i < tokens.size() && wordsOf(tokens[i]) >= 0) {
    const int most = wordsOf(tokens[i++]);
    for (int word = 0; word < most && i < tokens.size() && (most < 3 || parseNumber(tokens[i])); ++word) {
      ++i;
    }
  }
  return i < tokens.size() ? line.from(tokens[i]) : std::string_view();
}

// The numbers of a line of a material.
std::vector<double> checkedNumbers(const LineScanner& line, bool color) {
  const std::vector<double> numbers = color ? line.numbers(3, 3) : line.numbers(1, 1);
  for (const double value : numbers) {
    if (!std::isfinite(value)) {
      line.fail(line.keyword(), "is not finite", "finite numbers are needed");
    }
    if (color && value < 0.0) {
      line.fail(line.keyword(), "is negative", "colours are 0 or more");
    }
  }
  return numbers;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const size_t begin = text.find_first_not_of(kBlanks);
  return begin == std::string_view::npos ? std::string_view()
                                         : text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

ObjScan scanObj(const std::filesystem::path& file, std::string_view text, const std::function<void(double)>& progress) {
  constexpr int kOften = 1 << 14;  // lines
  ObjScan scan;
  LineScanner line(file, text, true);
  scan.text.reserve(text.size());
  while (line.next()) {
    scan.text.append(scanLine(line, scan)).push_back('\n');
    if (progress && line.number() % kOften == 0) {
      // What is kept of a line may be longer than the line.
      progress(std::min(1.0, static_cast<double>(scan.text.size()) / static_cast<double>(text.size())));
    }
  }
  return scan;
}

MtlScan scanMtl(const std::filesystem::path& file, std::string_view text) {
  MtlScan scan;
  MtlLines* current = nullptr;
  size_t count = 0;
  LineScanner line(file, text, false);
  while (line.next()) {
    const std::string_view key = line.keyword();
    const bool color = key == "Kd" || key == "Ks" || key == "Ke";
    if (key == "newmtl") {
      current = &scan.lines[std::string(line.argument())];
      current->newmtl = line.number();
      if (++count > kMostMaterials) {
        line.fail("newmtl", "is one too many", fmt::format("at most {} materials are read", kMostMaterials));
      }
    } else if (key == "map_Kd" && current != nullptr) {
      current->mapKd = line.number();
    }
    if (color || key == "Ns" || key == "d" || key == "Tr") {
      scan.text.append(lineOf(key, checkedNumbers(line, color), 3));
    } else if (key == "newmtl") {
      scan.text.append("newmtl ").append(line.argument());
    } else if (key == "map_Kd" || key == "map_d") {
      scan.text.append(key).append(" ").append(textureName(line));
    }
    scan.text.push_back('\n');
  }
  return scan;
}

}  // namespace speculum
