#include "platform/process.hpp"
#include "test_headers.hpp"

namespace speculum::test {
namespace {

TEST(Process, GivesOutputAndExitCode) {
  const ProcessResult result = runProcess({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.output, "out\nerr\n");
  EXPECT_EQ(runProcess({"a-program-that-does-not-exist"}).exitCode, 127);
}

TEST(Process, TalksLineByLine) {
  ChildProcess child({"sh", "-c", "while read line; do echo \"got $line\"; done; printf rest; exit 4"},
                     ChildProcess::Input::pipe);
  EXPECT_EQ(child.readLine(0.0), std::nullopt);
  EXPECT_TRUE(child.running());
  child.write("one\ntwo\n");
  EXPECT_EQ(child.readLine(10.0), "got one");
  EXPECT_EQ(child.readLine(10.0), "got two");
  child.closeInput();
  EXPECT_EQ(child.readLine(10.0), std::nullopt);
  EXPECT_FALSE(child.running());
  EXPECT_EQ(child.wait().exitCode, 4);
  EXPECT_EQ(child.wait().output, "rest");
}

TEST(Process, EndedAndHungChildrenAreHandled) {
  ChildProcess ended({"true"}, ChildProcess::Input::pipe);
  EXPECT_EQ(ended.readLine(10.0), std::nullopt);
  ended.write("nobody reads this\n");
  ChildProcess hung({"sh", "-c", "trap '' TERM; echo up; while :; do sleep 0.1; done"}, ChildProcess::Input::pipe);
  EXPECT_EQ(hung.readLine(10.0), "up");
  hung.kill();
  EXPECT_EQ(hung.wait().exitCode, 128 + 9);
}

}  // namespace
}  // namespace speculum::test
