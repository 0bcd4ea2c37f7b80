#include "platform/platform.hpp"

#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>

#include <cstdlib>
#include <fstream>
#include <thread>

namespace speculum::test {
namespace {

namespace fs = std::filesystem;

std::vector<uint8_t> bytes(const std::string& text) {
  return {text.begin(), text.end()};
}

TEST(Platform, ReplacedFileHoldsTheNewContentAndNothingElseIsLeft) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "deep" / "file";
  ASSERT_TRUE(replaceFile(file, bytes("old")));
  ASSERT_TRUE(replaceFile(file, bytes("new content")));
  EXPECT_EQ(readFile(file), bytes("new content"));
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), fs::directory_iterator()), 1);
}

TEST(Platform, FailedReplacementKeepsTheOldContent) {
  const TemporaryDirectory directory;
  ASSERT_TRUE(replaceFile(directory.path() / "file", bytes("old")));
  EXPECT_FALSE(replaceFile(directory.path() / "file" / "below", bytes("new")));
  EXPECT_EQ(readFile(directory.path() / "file"), bytes("old"));
  fs::create_directory(directory.path() / "folder");
  EXPECT_FALSE(replaceFile(directory.path() / "folder", bytes("new")));
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
// Page faults of a thread that allocates, fills and frees 8 MiB again and again, without the first times.
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

TEST(Platform, FreedMemoryIsKeptForWhatIsAllocatedNext) {
  ::unsetenv("MALLOC_TRIM_THRESHOLD_");
  ::unsetenv("MALLOC_MMAP_THRESHOLD_");
  ::mallopt(M_TRIM_THRESHOLD, 128 << 10);
  ::mallopt(M_MMAP_THRESHOLD, 128 << 10);
  EXPECT_GT(faultsOfAllocating(), 16 * 1000);
  keepFreedMemory();
  EXPECT_LT(faultsOfAllocating(), 1000);
}

TEST(Platform, TheUsersOwnThresholdsForFreedMemoryStay) {
  ::mallopt(M_TRIM_THRESHOLD, 128 << 10);
  ::mallopt(M_MMAP_THRESHOLD, 128 << 10);
  setEnvironment("MALLOC_TRIM_THRESHOLD_", "131072");
  keepFreedMemory();
  ::unsetenv("MALLOC_TRIM_THRESHOLD_");
  EXPECT_GT(faultsOfAllocating(), 16 * 1000);
}
#endif

TEST(Platform, ProcessGivesOutputAndExitCode) {
  const ProcessResult result = runProcess({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.output, "out\nerr\n");
  EXPECT_EQ(runProcess({"a-program-that-does-not-exist"}).exitCode, 127);
}

TEST(Platform, CacheDirectoryFollowsXdg) {
  setEnvironment("XDG_CACHE_HOME", "/somewhere");
  EXPECT_EQ(userCacheDir(), "/somewhere/speculum");
  setEnvironment("XDG_CACHE_HOME", "relative/is/ignored");
  setEnvironment("HOME", "/home/me");
  EXPECT_EQ(userCacheDir(), "/home/me/.cache/speculum");
}

TEST(Platform, DataDirectoryErrorNamesThePlaces) {
  try {
    dataDirectory("no-such-data");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("share/speculum/no-such-data"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(fs::exists(dataDirectory("shaders")));
}

TEST(Platform, ModificationTimeGrows) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "file";
  EXPECT_EQ(modificationTime(file), std::nullopt);
  replaceFile(file, bytes("a"));
  const auto first = modificationTime(file);
  fs::last_write_time(file, fs::last_write_time(file) + std::chrono::milliseconds(250));
  EXPECT_NEAR(*modificationTime(file) - *first, 0.25, 1e-3);
}

TEST(Platform, PeakMemoryIsPlausible) {
  EXPECT_GT(peakResidentBytes(), uint64_t{1} << 20);
  EXPECT_LT(peakResidentBytes(), uint64_t{1} << 40);
}

}  // namespace
}  // namespace speculum::test
