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

struct LogCapture::Before {
  std::shared_ptr<spdlog::logger> logger;
  spdlog::level::level_enum level;
  spdlog::sink_ptr sink;
};

LogCapture::LogCapture(LogHistory& history) {
  const std::shared_ptr<spdlog::logger> logger = spdlog::default_logger();
  before_ = std::make_unique<Before>(Before{logger, logger->level(), std::make_shared<HistorySink>(history)});
  for (const spdlog::sink_ptr& sink : logger->sinks()) {
    sink->set_level(std::max(sink->level(), logger->level()));
  }
  before_->sink->set_level(spdlog::level::info);
  logger->sinks().push_back(before_->sink);
  logger->set_level(std::min(logger->level(), spdlog::level::info));
}

LogCapture::~LogCapture() {
  before_->logger->set_level(before_->level);
  std::erase(before_->logger->sinks(), before_->sink);
}

}  // namespace speculum
