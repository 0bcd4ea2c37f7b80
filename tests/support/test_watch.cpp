#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

#include "sampling.hpp"

namespace {

std::string running;  // the test, as a line to print, which a signal handler could not make

// Ends the program where a test hangs, before ctest does, which does not know which test it was.
class TestWatch : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo& test) override {
    running = std::string(test.test_suite_name()) + "." + test.name() + " did not end within its time\n";
    ::alarm(seconds_);
  }
  void OnTestEnd(const testing::TestInfo&) override { ::alarm(0); }

  unsigned seconds_ = speculum::testing_support::fullTests() ? 6000 : 400;
};

const bool watching = [] {
  std::signal(SIGALRM, [](int) {
    static_cast<void>(::write(STDERR_FILENO, running.data(), running.size()));
    std::abort();
  });
  testing::UnitTest::GetInstance()->listeners().Append(new TestWatch);
  return true;
}();

}  // namespace
