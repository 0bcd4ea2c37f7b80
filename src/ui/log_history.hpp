#pragma once

#include <spdlog/common.h>

#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

using LogLevel = spdlog::level::level_enum;

struct LogLine {
  LogLevel level = LogLevel::info;
  std::string text;
};

// The latest lines of the log. Any thread may add to it.
class LogHistory {
 public:
  static constexpr size_t longest = 500;  // lines

  void add(LogLevel level, std::string text);
  void clear();
  // Returns the lines of at least that level that contain `part` in any case, oldest first.
  std::vector<LogLine> lines(LogLevel least = LogLevel::info, std::string_view part = {}) const;
  // Returns the first line of the newest warning or error since the last call; empty if none came.
  std::string takeProblem();

 private:
  mutable std::mutex mutex_;
  std::deque<LogLine> lines_;
  std::string problem_;  // that takeProblem() returns next
};

// Adds log lines of level info and above to `history` as long as the result lives; the history must outlive it. Other
// outputs of the log keep their level. Make and destroy the result while no other thread logs.
[[nodiscard]] std::shared_ptr<void> captureLog(LogHistory& history);

std::string logText(const std::vector<LogLine>& lines);  // "warning: ...", each on a line

}  // namespace speculum
