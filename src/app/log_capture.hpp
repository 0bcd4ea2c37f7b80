#pragma once

#include <memory>

#include "ui/log_history.hpp"

namespace speculum {

// While it lives, what is logged from level info on is kept in a history as well; where the log went before, it says no
// more than it did. Not while other threads log.
class LogCapture {
 public:
  explicit LogCapture(std::shared_ptr<LogHistory> history);
  ~LogCapture();
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

 private:
  struct Before;
  std::unique_ptr<Before> before_;
};

}  // namespace speculum
