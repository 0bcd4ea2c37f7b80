#include "test_headers.hpp"
#include "ui/log_history.hpp"

namespace speculum {
namespace {

TEST(LogHistory, KeepsTheLatestLines) {
  LogHistory log;
  for (size_t i = 0; i < LogHistory::longest + 3; ++i) {
    log.add(LogLevel::info, std::to_string(i));
  }
  ASSERT_EQ(log.lines().size(), LogHistory::longest);
  EXPECT_EQ(log.lines().front().text, "3");
  log.clear();
  EXPECT_TRUE(log.lines().empty());
}

TEST(LogHistory, FiltersByLevelAndText) {
  LogHistory log;
  log.add(LogLevel::info, "GPU 0");
  log.add(LogLevel::warning, "Validation: one");
  log.add(LogLevel::error, "validation: two");
  EXPECT_EQ(log.lines().size(), 3u);
  EXPECT_EQ(log.lines(LogLevel::warning).size(), 2u);
  EXPECT_EQ(logText(log.lines(LogLevel::info, "VALIDATION")), "warning: Validation: one\nerror: validation: two\n");
  EXPECT_EQ(logText(log.lines(LogLevel::error, "gpu")), "");
}

}  // namespace
}  // namespace speculum
