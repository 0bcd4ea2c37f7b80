#pragma once

#include <memory>

#include "ui/log_history.hpp"

namespace speculum {

// While it lives, lines of level info and above are added to a history as well, which must outlive it; where the log
// went before, it says no more than it did. Make and destroy it while no other thread logs.
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
