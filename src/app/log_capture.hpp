#pragma once

#include <memory>

#include "ui/log_history.hpp"

namespace speculum {

// While it exists, adds log lines of level info and above to a history, which must outlive it. Other outputs of the log
// keep their level. Create and destroy it while no other thread logs.
class LogCapture {
 public:
  explicit LogCapture(LogHistory& history);
  ~LogCapture();
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

 private:
  struct Before;
  std::unique_ptr<Before> before_;
};

}  // namespace speculum
