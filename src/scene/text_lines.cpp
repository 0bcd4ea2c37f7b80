#include "scene/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "platform/text.hpp"

namespace speculum {

namespace {

bool isBlank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) {
    text.remove_prefix(1);
  }
  while (!text.empty() && isBlank(text.back())) {
    text.remove_suffix(1);
  }
  return text;
}

std::string_view withoutComment(std::string_view name) {
  for (size_t i = 0; i < name.size(); ++i) {
    if (name[i] == '#' && (i == 0 || isBlank(name[i - 1]))) {
      name = name.substr(0, i);
    }
  }
  return trimmed(name);
}

std::string_view withoutQuotes(std::string_view text) {
  const bool quoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return quoted ? text.substr(1, text.size() - 2) : text;
}

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

LineReader::LineReader(std::string_view text, Continuation continuation)
    : rest_(text), size_(text.size()), continuation_(continuation) {
  if (rest_.starts_with("\xef\xbb\xbf")) {
    rest_.remove_prefix(3);
  }
}

bool LineReader::next() {
  while (!rest_.empty()) {
    number_ += linesTaken_;
    linesTaken_ = 0;
    line_ = takeLine();
    if (continues(line_)) {
      joinContinuation();
    }
    split();
    if (!tokens_.empty()) {
      return true;
    }
  }
  return false;
}

std::string_view LineReader::takeLine() {
  const auto end = std::ranges::find_if(rest_, [](char c) { return c == '\n' || c == '\r'; });
  const std::string_view line = rest_.substr(0, end - rest_.begin());
  rest_.remove_prefix(line.size());
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<size_t>(1, rest_.size()));
  ++linesTaken_;
  return line;
}

// A backslash that ends a comment is part of the comment.
bool LineReader::continues(std::string_view line) const {
  const std::string_view text = trimmed(line);
  if (continuation_ == Continuation::none || !text.ends_with('\\') || text.find('#') != std::string_view::npos) {
    return false;
  }
  const char before = text.size() > 1 ? text[text.size() - 2] : ' ';
  const std::string keyword = lowerCase(std::string(text.substr(0, text.find_first_of(" \t"))));
  const bool endsName =
      static_cast<unsigned char>(before) >= 0x80 || keyword == "o" || keyword == "g" || keyword == "usemtl";
  return isBlank(before) || !endsName;
}

void LineReader::joinContinuation() {
  joined_.clear();
  while (continues(line_)) {
    joined_.append(line_.substr(0, line_.rfind('\\'))).push_back(' ');
    line_ = rest_.empty() ? std::string_view() : takeLine();
  }
  joined_.append(line_);
  line_ = joined_;
}

void LineReader::split() {
  tokens_.clear();
  size_t comment = line_.find('#');
  // Programs of old compilers write 1.#QNAN and -1.#IND for NaN.
  while (comment != std::string_view::npos && comment > 0 && line_[comment - 1] == '.' && comment + 1 < line_.size() &&
         (line_[comment + 1] == 'I' || line_[comment + 1] == 'Q' || line_[comment + 1] == 'S')) {
    comment = line_.find('#', comment + 1);
  }
  const std::string_view line = line_.substr(0, comment);
  for (size_t i = 0; i < line.size();) {
    const size_t begin = i;
    while (i < line.size() && !isBlank(line[i])) {
      ++i;
    }
    if (i > begin) {
      tokens_.push_back(line.substr(begin, i - begin));
    } else {
      ++i;
    }
  }
}

}  // namespace speculum
