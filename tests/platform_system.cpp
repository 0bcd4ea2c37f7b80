// The user's folders, the machine's memory and other programs.
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "error_message.hpp"
#include "platform/folders.hpp"
#include "platform/machine.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "test_headers.hpp"

namespace speculum::test {
namespace {

TEST(Folders, CacheDirectoryFollowsXdg) {
  setEnvironment("XDG_CACHE_HOME", "/somewhere");
  EXPECT_EQ(userCacheDir(), "/somewhere/speculum");
  setEnvironment("XDG_CACHE_HOME", "relative/is/ignored");
  setEnvironment("HOME", "/home/me");
  EXPECT_EQ(userCacheDir(), "/home/me/.cache/speculum");
}

TEST(Folders, MissingDataDirectoryListsWhereItLooked) {
  EXPECT_TRUE(contains(messageOf([] { dataDirectory("no-such-data"); }), "share/speculum/no-such-data"));
  EXPECT_TRUE(std::filesystem::exists(dataDirectory("shaders")));
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
// Returns the page faults of a thread that allocates, fills and frees 8 MiB repeatedly, without the first four times.
long faultsOfAllocating() {
  long faults = 0;
  std::thread([&] {
    const auto faultsSoFar = [] {
      rusage usage{};
      ::getrusage(RUSAGE_THREAD, &usage);
      return usage.ru_minflt;
    };
    long before = 0;
    for (int i = 0; i < 20; ++i) {
      before = i == 4 ? faultsSoFar() : before;
      std::vector<std::vector<char>> blocks;
      for (int k = 0; k < 32; ++k) {
        blocks.emplace_back(256 << 10, 'x');
      }
    }
    faults = faultsSoFar() - before;
  }).join();
  return faults;
}

TEST(Machine, KeepsFreedMemory) {
  ::unsetenv("MALLOC_TRIM_THRESHOLD_");
  ::unsetenv("MALLOC_MMAP_THRESHOLD_");
  ::mallopt(M_TRIM_THRESHOLD, 128 << 10);
  ::mallopt(M_MMAP_THRESHOLD, 128 << 10);
  EXPECT_GT(faultsOfAllocating(), 16 * 1000);
  keepFreedMemory();
  EXPECT_LT(faultsOfAllocating(), 1000);
}

TEST(Machine, ReleasesFreedMemory) {
  keepFreedMemory();
  std::vector<std::unique_ptr<std::vector<char>>> blocks;
  for (int i = 0; i < 400; ++i) {
    blocks.push_back(std::make_unique<std::vector<char>>(100 << 10, 'x'));
  }
  const auto last = std::move(blocks.back());  // keeps the heap's end where it is
  blocks.clear();
  const auto resident = [] {
    long pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> pages;
    return pages * ::sysconf(_SC_PAGESIZE);
  };
  const long before = resident();
  releaseFreedMemory();
  EXPECT_LT(resident(), before - (30 << 20));
}

TEST(Machine, KeepsTheUsersMallocThresholds) {
  ::mallopt(M_TRIM_THRESHOLD, 128 << 10);
  ::mallopt(M_MMAP_THRESHOLD, 128 << 10);
  setEnvironment("MALLOC_TRIM_THRESHOLD_", "131072");
  keepFreedMemory();
  ::unsetenv("MALLOC_TRIM_THRESHOLD_");
  EXPECT_GT(faultsOfAllocating(), 16 * 1000);
}
#endif

TEST(Machine, KnowsWhenTheProcessStarted) {
  const double first = millisecondsSinceStart();
  EXPECT_GE(first, 0.0);
  EXPECT_LT(first, 60e3);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GE(millisecondsSinceStart(), first + 40.0);
}

TEST(Machine, PeakMemoryIsPlausible) {
  EXPECT_GT(peakResidentBytes(), uint64_t{1} << 20);
  EXPECT_LT(peakResidentBytes(), uint64_t{1} << 40);
}

TEST(Text, LargeNumbersHaveNoExponent) {
  EXPECT_EQ(significant(12.34, 3), "12.3");
  EXPECT_EQ(significant(999.4, 3), "999");
  EXPECT_EQ(significant(999.7, 3), "1000");
  EXPECT_EQ(significant(1570.4, 3), "1570");
  EXPECT_EQ(significant(-123.0, 2), "-123");
  EXPECT_EQ(significant(0.00123, 2), "0.0012");
  EXPECT_EQ(significant(1e300, 3).size(), 301u);
  EXPECT_EQ(significant(0.0000123, 2), "1.2e-05");
}

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
