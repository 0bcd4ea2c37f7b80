#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>

namespace {

std::string running;  // names the test; made beforehand, because a signal handler cannot allocate

// Names a test that hangs and ends the program. ctest would end it without a name, in ordinary runs after 600 s.
class TestWatch : public testing::EmptyTestEventListener {
  using Clock = std::chrono::steady_clock;

  void OnTestStart(const testing::TestInfo& test) override {
    running = std::string(test.test_suite_name()) + "." + test.name() + " did not end in time\n";
    ::alarm(static_cast<unsigned>(
        std::max<Clock::rep>(1, std::chrono::ceil<std::chrono::seconds>(end_ - Clock::now()).count())));
  }
  void OnTestEnd(const testing::TestInfo&) override { ::alarm(0); }

  static std::chrono::seconds most() {
    const char* given = std::getenv("SPECULUM_TEST_SECONDS");
    return std::chrono::seconds(given ? std::atoi(given) : 570);
  }
  const Clock::time_point end_ = Clock::now() + most();  // for all tests of the program
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
