#include "platform/process.hpp"

#include <gtest/gtest.h>

namespace speculum::test {
namespace {

TEST(Process, GivesOutputAndExitCode) {
  const ProcessResult result = runProcess({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.output, "out\nerr\n");
  EXPECT_EQ(runProcess({"a-program-that-does-not-exist"}).exitCode, 127);
}

}  // namespace
}  // namespace speculum::test
