#include "platform/process.hpp"

#include <algorithm>
#include <utility>

namespace speculum {

namespace {

const auto started = std::chrono::steady_clock::now();

}  // namespace

double millisecondsSinceStart() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started).count();
}

ProcessResult ChildProcess::wait() {
  if (child_ != 0) {
    while (read()) {
    }
    result_.exitCode = waitFor(std::exchange(child_, 0));
  }
  return result_;
}

std::optional<ProcessResult> ChildProcess::poll() {
  while (child_ != 0 && readable(Clock::now())) {
    if (!read()) {
      return wait();
    }
  }
  return child_ == 0 ? std::optional(result_) : std::nullopt;
}

std::optional<std::string> ChildProcess::readLine(double seconds) {
  const std::chrono::duration<double> time(std::max(0.0, seconds));
  const Clock::time_point end = Clock::now() + std::chrono::ceil<Clock::duration>(time);
  for (;;) {
    if (std::optional<std::string> line = takeLine()) {
      return line;
    }
    const bool ready = child_ != 0 && readable(end);
    if (ready && !read()) {
      result_.exitCode = waitFor(std::exchange(child_, 0));
    } else if (!ready && (child_ == 0 || Clock::now() >= end)) {
      return std::nullopt;
    }
  }
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
