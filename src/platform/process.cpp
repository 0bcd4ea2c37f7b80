#include "platform/process.hpp"

#include <utility>

namespace speculum {

ProcessResult ChildProcess::wait() {
  if (child_ != 0) {
    while (read()) {
    }
    result_.exitCode = waitFor(std::exchange(child_, 0));
  }
  return result_;
}

std::optional<std::string> ChildProcess::takeLine() {
  const size_t length = result_.output.find('\n');
  if (length == std::string::npos) {
    return std::nullopt;
  }
  std::string line = result_.output.substr(0, length);
  result_.output.erase(0, length + 1);
  return line;
}

ProcessResult runProcess(const std::vector<std::string>& arguments) {
  return ChildProcess(arguments).wait();
}

}  // namespace speculum
