#include "cli/progress.hpp"

#include <cstdio>

#include "platform/process.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

constexpr double quietSeconds = 1.0;
constexpr double atOnce = 0.2;  // seconds; work reported so soon is not part of the pace
constexpr double plainInterval = 5.0;
constexpr double barInterval = 0.1;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace

Progress::Progress(std::string_view what, double total)
    : what_(oneLine(what)),
      total_(total),
      terminal_(isTerminal(2)),
      created_(Clock::now()),
      start_(created_),
      last_(start_) {}

Progress::~Progress() {
  if (shown_ && terminal_) {
    std::fprintf(stderr, "\n");
  }
}

bool Progress::set(double done) {
  done_ = done;
  const Clock::time_point now = Clock::now();
  // An earlier run did the work that is reported at once, so this work is not part of the pace.
  if (seconds(now - created_) < atOnce) {
    before_ = done;
    start_ = now;
  }
  const double elapsed = seconds(now - start_);
  const bool due = seconds(now - last_) >= (terminal_ ? barInterval : plainInterval) || (shown_ && done >= total_);
  if (elapsed >= quietSeconds && due && done > before_) {
    last_ = now;
    shown_ = true;
    print(elapsed / (done - before_) * (total_ - done));
  }
  return !interruptRequested();
}

void Progress::print(double secondsLeft) {
  const double part = total_ > 0.0 ? done_ / total_ : 1.0;
  if (!terminal_) {
    std::fprintf(stderr, "%s: %.0f %%, %.0f s left\n", what_.c_str(), 100.0 * part, secondsLeft);
    return;
  }
  constexpr int width = 40;
  const int filled = static_cast<int>(part * width);
  std::fprintf(stderr, "\r%s [%s%s] %3.0f %%, %.0f s left  ", what_.c_str(), std::string(filled, '#').c_str(),
               std::string(width - filled, '.').c_str(), 100.0 * part, secondsLeft);
  std::fflush(stderr);
}

}  // namespace speculum
