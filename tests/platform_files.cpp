#include "platform/files.hpp"
#include "test_headers.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <future>

namespace speculum::test {
namespace {

namespace fs = std::filesystem;

template <typename Action>
void expectFileError(const Action& action, const fs::path& file, const std::string& problem) {
  try {
    action();
    ADD_FAILURE() << "no FileError was thrown for " << file;
  } catch (const FileError& error) {
    EXPECT_EQ(error.problem().find(problem), 0u) << error.problem();
    EXPECT_EQ(std::string(error.what()).find(file.string() + ": " + error.problem() + " ("), 0u) << error.what();
  }
}

TEST(Files, ReplaceLeavesOnlyTheNewContent) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "file";
  replaceFile(file, "old");
  replaceFile(file, std::string("new\0content", 11));
  EXPECT_EQ(readText(file), std::string("new\0content", 11));
  EXPECT_EQ(readFile(file).size(), 11u);
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), fs::directory_iterator()), 1);
}

TEST(Files, FailedReplaceKeepsTheOldContent) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "file";
  replaceFile(file, "old");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{.rlim_cur = 1000, .rlim_max = limit.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  expectFileError([&] { replaceFile(file, std::string(100'000, 'x')); }, file, "cannot be written");
  ::setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_EQ(readText(file), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), fs::directory_iterator()), 1);
}

TEST(Files, ReplaceNeedsAFolderAndAFile) {
  const TemporaryDirectory directory;
  const fs::path below = directory.path() / "none" / "file";
  expectFileError([&] { replaceFile(below, "a"); }, below, "cannot be written: there is no folder");
  expectFileError([&] { replaceFile(directory.path(), "a"); }, directory.path(), "cannot be written: it is a folder");
}

TEST(Files, DevicesAreWrittenNotReplaced) {
  replaceFile("/dev/null", "a");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST(Files, ReplaceKeepsLinksAndModes) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "file";
  const fs::path link = directory.path() / "link";
  const fs::path dangling = directory.path() / "dangling";
  replaceFile(file, "old");
  fs::permissions(file, fs::perms(0640));
  fs::create_symlink("link2", link);
  fs::create_symlink(file, directory.path() / "link2");
  fs::create_symlink("new", dangling);
  replaceFile(link, "new");
  replaceFile(dangling, "made");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(fs::is_symlink(dangling));
  EXPECT_EQ(readText(file), "new");
  EXPECT_EQ(fs::status(file).permissions(), fs::perms(0640));
  EXPECT_EQ(readText(directory.path() / "new"), "made");
  fs::create_symlink("circle", directory.path() / "circle");
  expectFileError([&] { replaceFile(directory.path() / "circle", "a"); }, directory.path() / "circle",
                  "cannot be written");
}

TEST(Files, ReplaceTakesTheLongestNames) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / (std::string(251, 'n') + ".txt");
  replaceFile(file, "old");
  replaceFile(file, "new");
  EXPECT_EQ(readText(file), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), fs::directory_iterator()), 1);
}

TEST(Files, ReplaceLeavesFilesOfOthersAlone) {
  const TemporaryDirectory directory;
  for (const std::string end : {".part", ".part0", ".part1"}) {
    replaceFile(directory.path() / ("file" + end), "precious");
  }
  replaceFile(directory.path() / "file", "a");
  for (const std::string end : {".part", ".part0", ".part1"}) {
    EXPECT_EQ(readText(directory.path() / ("file" + end)), "precious");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(directory.path()), fs::directory_iterator()), 4);
}

TEST(Files, ReplaceWritesToAPipe) {
  const TemporaryDirectory directory;
  const fs::path pipe = directory.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::future<std::string> reader = std::async(std::launch::async, [&] {
    std::ifstream stream(pipe);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  });
  replaceFile(pipe, "content");
  EXPECT_EQ(reader.get(), "content");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(Files, OpenDescriptorsAreWrittenTo) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "log";
  replaceFile(file, "first ");
  const int appending = ::open(file.c_str(), O_WRONLY | O_APPEND);
  ASSERT_GE(appending, 0);
  replaceFile("/dev/fd/" + std::to_string(appending), "second");
  ::close(appending);
  EXPECT_EQ(readText(file), "first second");
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  replaceFile("/proc/self/fd/" + std::to_string(ends[1]), "piped");
  std::array<char, 5> read{};
  EXPECT_EQ(::read(ends[0], read.data(), read.size()), 5);
  EXPECT_EQ(std::string_view(read.data(), read.size()), "piped");
  ::close(ends[0]);
  ::close(ends[1]);
}

TEST(Files, StoreMakesTheFolder) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "deep" / "file";
  EXPECT_TRUE(storeFile(file, "a"));
  EXPECT_EQ(readText(file), "a");
  EXPECT_FALSE(storeFile(file / "below", "a"));
  EXPECT_FALSE(storeFile(directory.path() / "deep", "a"));
  EXPECT_EQ(readText(file), "a");
}

TEST(Files, FoldersDevicesAndHugeFilesAreRefused) {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "file";
  expectFileError([&] { readFile(file); }, file, "cannot be read: No such file");
  EXPECT_FALSE(readFileIfAny(file));
  expectFileError([&] { readFile(directory.path()); }, directory.path(), "is a folder");
  expectFileError([] { readFile("/dev/zero"); }, "/dev/zero", "is a device or pipe");
  const fs::path pipe = directory.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expectFileError([&] { readText(pipe); }, pipe, "is a device or pipe");
  replaceFile(file, "");
  EXPECT_EQ(readText(file), "");
  fs::resize_file(file, (2u << 20) + 1);
  expectFileError([&] { readFile(file, 2u << 20); }, file, "is larger than 2 MiB");
  EXPECT_EQ(readFile(file).size(), (2u << 20) + 1);
}

}  // namespace
}  // namespace speculum::test
