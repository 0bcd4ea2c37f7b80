#include "ui/log_history.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "platform/text.hpp"

namespace speculum {

namespace {

class HistorySink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit HistorySink(LogHistory& history) : history_(history) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    history_.add(message.level, indentedLines({message.payload.data(), message.payload.size()}));
  }
  void flush_() override {}

  LogHistory& history_;
};

}  // namespace

void LogHistory::add(LogLevel level, std::string text) {
  const std::lock_guard lock(mutex_);
  if (level > LogLevel::info) {
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
  const std::string wanted = lowerCase(std::string(part));
  const auto isChosen = [&](const LogLine& line) {
    return line.level >= least && lowerCase(line.text).find(wanted) != std::string::npos;
  };
  const std::lock_guard lock(mutex_);
  std::vector<LogLine> chosen;
  std::ranges::copy_if(lines_, std::back_inserter(chosen), isChosen);
  return chosen;
}

std::shared_ptr<void> captureLog(LogHistory& history) {
  const std::shared_ptr<spdlog::logger> logger = spdlog::default_logger();
  const spdlog::level::level_enum level = logger->level();
  const auto capture = std::make_shared<HistorySink>(history);
  for (const spdlog::sink_ptr& sink : logger->sinks()) {
    sink->set_level(std::max(sink->level(), level));
  }
  capture->set_level(spdlog::level::info);
  logger->sinks().push_back(capture);
  logger->set_level(std::min(level, spdlog::level::info));
  return {capture.get(), [=](void*) {
            logger->set_level(level);
            std::erase(logger->sinks(), capture);
          }};
}

std::string logText(const std::vector<LogLine>& lines) {
  std::string text;
  for (const LogLine& line : lines) {
    text += fmt::format("{}: {}\n", spdlog::level::to_string_view(line.level), line.text);
  }
  return text;
}

}  // namespace speculum
