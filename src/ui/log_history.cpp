#include "ui/log_history.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace speculum {

namespace {

bool contains(const std::string& text, std::string_view part) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end() || part.empty();
}

}  // namespace

void LogHistory::add(LogLevel level, std::string text) {
  const std::lock_guard lock(mutex_);
  if (level != LogLevel::info) {
    problem_ = text.substr(0, text.find('\n'));
  }
  lines_.push_back({level, std::move(text)});
  if (lines_.size() > longest) {
    lines_.pop_front();
  }
}

std::string LogHistory::takeProblem() {
  const std::lock_guard lock(mutex_);
  return std::exchange(problem_, {});
}

void LogHistory::clear() {
  const std::lock_guard lock(mutex_);
  lines_.clear();
}

std::vector<LogLine> LogHistory::lines(LogLevel least, std::string_view part) const {
  const std::lock_guard lock(mutex_);
  std::vector<LogLine> chosen;
  std::ranges::copy_if(lines_, std::back_inserter(chosen),
                       [&](const LogLine& line) { return line.level >= least && contains(line.text, part); });
  return chosen;
}

std::string_view logLevelName(LogLevel level) {
  static constexpr std::array<std::string_view, 3> names{"info", "warning", "error"};
  return names[static_cast<size_t>(level)];
}

std::string logText(const std::vector<LogLine>& lines) {
  std::string text;
  for (const LogLine& line : lines) {
    text += std::string(logLevelName(line.level)) + ": " + line.text + "\n";
  }
  return text;
}

}  // namespace speculum
