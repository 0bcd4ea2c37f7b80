#include "file_fault.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <future>
#include <thread>

namespace {

std::vector<std::string> diskCalls;
bool fsyncFails = false;

}  // namespace

// The linker's --wrap leads calls of NAME to __wrap_NAME, and __real_NAME to the C library.
extern "C" {
int __real_fsync(int descriptor);
int __wrap_fsync(int descriptor) {
  diskCalls.emplace_back("fsync");
  errno = EIO;
  return fsyncFails ? -1 : __real_fsync(descriptor);
}
int __real_rename(const char* from, const char* to);
int __wrap_rename(const char* from, const char* to) {
  diskCalls.emplace_back("rename");
  return __real_rename(from, to);
}
}

namespace speculum::test {
namespace {

namespace fs = std::filesystem;
using testing_support::expectFileFault;

// A folder for files, without one.
class Files : public testing::Test {
 protected:
  // Returns the number of entries of the folder.
  auto count() const { return std::distance(fs::directory_iterator(folder_), fs::directory_iterator()); }

  const TemporaryDirectory directory_;
  const fs::path folder_ = directory_.path();
  const fs::path file_ = folder_ / "file";
};

TEST_F(Files, ReplaceLeavesOnlyTheNewContent) {
  replaceFile(file_, "old");
  replaceFile(file_, std::string("new\0content", 11));
  EXPECT_EQ(readText(file_), std::string("new\0content", 11));
  EXPECT_EQ(readFile(file_).size(), 11u);
  EXPECT_EQ(count(), 1);
}

TEST_F(Files, FailedReplaceKeepsTheOldContent) {
  replaceFile(file_, "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{.rlim_cur = 1000, .rlim_max = limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  expectFileFault([&] { replaceFile(file_, std::string(100'000, 'x')); }, file_, "cannot be written");
  ::setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_EQ(readText(file_), "old");
  EXPECT_EQ(count(), 1);
}

TEST_F(Files, ReplaceWaitsForTheDisk) {
  replaceFile(file_, "old");
  diskCalls.clear();
  replaceFile(file_, "new");
  EXPECT_EQ(diskCalls, std::vector<std::string>({"fsync", "rename", "fsync"}))
      << "the content, and then the folder's names";
  fsyncFails = true;
  expectFileFault([&] { replaceFile(file_, "lost"); }, file_, "cannot be written");
  fsyncFails = false;
  EXPECT_EQ(readText(file_), "new");
  EXPECT_EQ(count(), 1);
}

TEST_F(Files, ReplaceNeedsAFolderAndAFile) {
  const fs::path below = folder_ / "none" / "file";
  expectFileFault([&] { replaceFile(below, "a"); }, below, "cannot be written: there is no folder");
  expectFileFault([&] { replaceFile(folder_, "a"); }, folder_, "cannot be written: it is a folder");
}

TEST_F(Files, DevicesAreWrittenNotReplaced) {
  replaceFile("/dev/null", "a");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Files, ReplaceKeepsLinksAndModes) {
  const fs::path link = folder_ / "link";
  const fs::path dangling = folder_ / "dangling";
  replaceFile(file_, "old");
  fs::permissions(file_, fs::perms(0640));
  fs::create_symlink("link2", link);
  fs::create_symlink(file_, folder_ / "link2");
  fs::create_symlink("new", dangling);
  replaceFile(link, "new");
  replaceFile(dangling, "made");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(fs::is_symlink(dangling));
  EXPECT_EQ(readText(file_), "new");
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms(0640));
  EXPECT_EQ(readText(folder_ / "new"), "made");
  fs::create_symlink("circle", folder_ / "circle");
  expectFileFault([&] { replaceFile(folder_ / "circle", "a"); }, folder_ / "circle", "cannot be written");
}

TEST_F(Files, ReplaceTakesTheLongestNames) {
  const fs::path file = folder_ / (std::string(251, 'n') + ".txt");
  replaceFile(file, "old");
  replaceFile(file, "new");
  EXPECT_EQ(readText(file), "new");
  EXPECT_EQ(count(), 1);
}

TEST_F(Files, ReplaceLeavesFilesOfOthersAlone) {
  for (const std::string end : {".part", ".part0", ".part1"}) {
    replaceFile(folder_ / ("file" + end), "precious");
  }
  replaceFile(folder_ / "file", "a");
  for (const std::string end : {".part", ".part0", ".part1"}) {
    EXPECT_EQ(readText(folder_ / ("file" + end)), "precious");
  }
  EXPECT_EQ(count(), 4);
}

TEST_F(Files, ReplaceWritesToAPipe) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::future<std::string> reader = std::async(std::launch::async, [&] {
    std::ifstream stream(pipe);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  });
  replaceFile(pipe, "content");
  EXPECT_EQ(reader.get(), "content");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(Files, PipesWithoutReaderAreRefused) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink("pipe", folder_ / "link");
  expectFileFault([&] { replaceFile(folder_ / "link", "a"); }, folder_ / "link", "it is a pipe that nobody reads");
}

// More than a pipe holds, so that the writer has to wait.
TEST_F(Files, SlowReadersOfAPipeGetAll) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const std::string content(300'000, 'x');
  std::future<size_t> reader = std::async(std::launch::async, [&] {
    std::ifstream stream(pipe);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return std::string(std::istreambuf_iterator<char>(stream), {}).size();
  });
  replaceFile(pipe, content);
  EXPECT_EQ(reader.get(), content.size());
}

TEST_F(Files, OpenDescriptorsAreWrittenTo) {
  replaceFile(file_, "first ");
  const int appending = ::open(file_.c_str(), O_WRONLY | O_APPEND);
  ASSERT_GE(appending, 0);
  replaceFile("/dev/fd/" + std::to_string(appending), "second");
  EXPECT_THROW(replaceFile("/dev/fd/" + std::to_string(appending) + "x", "lost"), FileError);
  ::close(appending);
  EXPECT_EQ(readText(file_), "first second");
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  replaceFile("/proc/self/fd/" + std::to_string(ends[1]), "piped");
  std::array<char, 5> read{};
  EXPECT_EQ(::read(ends[0], read.data(), read.size()), 5);
  EXPECT_EQ(std::string_view(read.data(), read.size()), "piped");
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST_F(Files, StoreMakesTheFolder) {
  const fs::path file = folder_ / "deep" / "file";
  EXPECT_TRUE(storeFile(file, "a"));
  EXPECT_EQ(readText(file), "a");
  EXPECT_FALSE(storeFile(file / "below", "a"));
  EXPECT_FALSE(storeFile(folder_ / "deep", "a"));
  EXPECT_EQ(readText(file), "a");
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(storeFile(pipe, "a")) << "nobody reads it";
  const fs::path link = folder_ / "deep" / "link";
  fs::create_symlink(file, link);
  EXPECT_TRUE(storeFile(link, "b"));
  EXPECT_EQ(readText(link), "b");
  EXPECT_EQ(readText(file), "a") << "which is not ours";
}

TEST_F(Files, FoldersDevicesAndHugeFilesAreRefused) {
  expectFileFault([&] { readFile(file_); }, file_, "cannot be read: No such file");
  EXPECT_FALSE(readFileIfAny(file_));
  expectFileFault([&] { readFile(folder_); }, folder_, "is a folder");
  expectFileFault([] { readFile("/dev/zero"); }, "/dev/zero", "is a device or pipe");
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expectFileFault([&] { readText(pipe); }, pipe, "is a device or pipe");
  replaceFile(file_, "");
  EXPECT_EQ(readText(file_), "");
  fs::resize_file(file_, (2u << 20) + 1);
  expectFileFault([&] { readFile(file_, 2u << 20); }, file_, "is larger than 2 MiB");
  EXPECT_EQ(readFile(file_).size(), (2u << 20) + 1);
}

}  // namespace
}  // namespace speculum::test
