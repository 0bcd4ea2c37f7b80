#pragma once

#include <memory>

#include "ui/log_history.hpp"

namespace speculum {

// Adds log lines of level info and above to a history, which must outlive the result, while that exists. Other outputs
// of the log keep their level. Begin and end it while no other thread logs.
[[nodiscard]] std::shared_ptr<void> captureLog(LogHistory& history);

}  // namespace speculum
