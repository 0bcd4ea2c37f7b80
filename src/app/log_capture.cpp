#include "app/log_capture.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace speculum {

namespace {

class HistorySink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit HistorySink(LogHistory& history) : history_(history) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const LogLevel level = message.level >= spdlog::level::err    ? LogLevel::error
                           : message.level >= spdlog::level::warn ? LogLevel::warning
                                                                  : LogLevel::info;
    history_.add(level, std::string(message.payload.begin(), message.payload.end()));
  }
  void flush_() override {}

  LogHistory& history_;
};

}  // namespace

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

}  // namespace speculum
