// The halves of src/platform for Windows. scripts/windows --test runs this program under wine.
#include <atomic>
#include <chrono>
#include <thread>

#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/win32.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

#include <sddl.h>  // needs win32.hpp

namespace speculum::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* oddName = "Spiegel \xc3\xa4\xc3\xb6 \xe9\x8f\xa1.txt";  // blank, umlauts, a Chinese mirror

class WindowsFiles : public testing::Test {
 protected:
  const TemporaryDirectory directory_;
  const fs::path file_ = directory_.path() / oddName;
};

TEST_F(WindowsFiles, ReplaceLeavesOnlyTheNewContent) {
  for (const std::string& content : {std::string("old\r\n"), std::string("new\n"), std::string()}) {
    replaceFile(file_, std::string_view(content));
    EXPECT_EQ(readText(file_), content);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_.path()), {}), 1);
  EXPECT_EQ(fs::directory_iterator(directory_.path())->path().filename().string(), oddName);
}

TEST_F(WindowsFiles, ReadOnlyFilesAreKept) {
  replaceFile(file_, std::string_view("old"));
  fs::permissions(file_, fs::perms::owner_read);
  if (std::ofstream(file_, std::ios::app)) {
    GTEST_SKIP() << "this user may write to files that are read-only, as root under wine";
  }
  EXPECT_FALSE(isWritable(file_));
  EXPECT_THROW(replaceFile(file_, std::string_view("new")), FileError);
  EXPECT_EQ(readText(file_), "old");
  fs::permissions(file_, fs::perms::owner_all);
  EXPECT_TRUE(isWritable(file_));
  EXPECT_EQ(std::distance(fs::directory_iterator(directory_.path()), {}), 1);
}

// A scanner opens new files for a moment and denies others to delete them.
TEST_F(WindowsFiles, ReplaceWaitsForAFileInUse) {
  replaceFile(file_, std::string_view("old"));
  replaceFile(directory_.path() / "other", std::string_view("other"));
  HANDLE reader = ::CreateFileW(file_.c_str(), GENERIC_READ, FILE_SHARE_READ, nullptr, OPEN_EXISTING, 0, nullptr);
  ASSERT_NE(reader, INVALID_HANDLE_VALUE);
  EXPECT_FALSE(::MoveFileExW((directory_.path() / "other").c_str(), file_.c_str(), MOVEFILE_REPLACE_EXISTING))
      << "a file in use can be replaced at once, so this test shows nothing";
  std::atomic<bool> closed = false;
  std::thread closing([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    closed = true;
    ::CloseHandle(reader);
  });
  replaceFile(file_, std::string_view("new"));
  EXPECT_TRUE(closed);
  closing.join();
  EXPECT_EQ(readText(file_), "new");
}

std::vector<std::byte> accessOf(const fs::path& file) {
  DWORD size = 0;
  ::GetFileSecurityW(file.c_str(), DACL_SECURITY_INFORMATION, nullptr, 0, &size);
  std::vector<std::byte> access(size);
  ::GetFileSecurityW(file.c_str(), DACL_SECURITY_INFORMATION, access.data(), size, &size);
  return access;
}

TEST_F(WindowsFiles, ReplaceKeepsTheAccessList) {
  replaceFile(file_, std::string_view("old"));
  const std::vector<std::byte> usual = accessOf(file_);
  PSECURITY_DESCRIPTOR own = nullptr;
  ASSERT_TRUE(::ConvertStringSecurityDescriptorToSecurityDescriptorW(L"D:P(A;;FA;;;OW)(A;;FA;;;BA)", SDDL_REVISION_1,
                                                                     &own, nullptr));
  ASSERT_TRUE(::SetFileSecurityW(file_.c_str(), DACL_SECURITY_INFORMATION, own));
  ::LocalFree(own);
  const std::vector<std::byte> narrow = accessOf(file_);
  ASSERT_NE(narrow, usual);
  replaceFile(file_, std::string_view("new"));
  EXPECT_EQ(accessOf(file_), narrow);
  EXPECT_EQ(readText(file_), "new");
}

TEST_F(WindowsFiles, ReplaceKeepsLinks) {
  const fs::path link = directory_.path() / "link";
  replaceFile(file_, std::string_view("old"));
  constexpr DWORD withoutRights = 2;  // SYMBOLIC_LINK_FLAG_ALLOW_UNPRIVILEGED_CREATE
  ::CreateSymbolicLinkW(link.c_str(), file_.c_str(), withoutRights);
  const DWORD attributes = ::GetFileAttributesW(link.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES || (attributes & FILE_ATTRIBUTE_REPARSE_POINT) == 0) {
    GTEST_SKIP() << "no link can be made: by this user, or by wine";
  }
  replaceFile(link, std::string_view("new"));
  EXPECT_NE(::GetFileAttributesW(link.c_str()) & FILE_ATTRIBUTE_REPARSE_POINT, 0u);
  EXPECT_EQ(readText(file_), "new");
}

TEST_F(WindowsFiles, ReplaceNeedsAFolderAndAFile) {
  EXPECT_THROW(replaceFile(directory_.path() / "none" / "file", std::string_view("x")), FileError);
  EXPECT_THROW(replaceFile(directory_.path(), std::string_view("x")), FileError);
  EXPECT_THROW(readText(directory_.path()), FileError);
  EXPECT_TRUE(storeFile(directory_.path() / "made" / "file", std::string_view("x")));
  EXPECT_FALSE(storeFile(directory_.path() / "made" / "file" / "below", std::string_view("x")));
}

TEST_F(WindowsFiles, DevicesAreWrittenNotReplaced) {
  const std::wstring name = L"\\\\.\\pipe\\speculum-test-" + std::to_wstring(::GetCurrentProcessId());
  HANDLE pipe = ::CreateNamedPipeW(name.c_str(), PIPE_ACCESS_INBOUND, PIPE_TYPE_BYTE, 1, 100, 100, 0, nullptr);
  ASSERT_NE(pipe, INVALID_HANDLE_VALUE);
  replaceFile(name, std::string_view("content"));
  std::array<char, 100> read{};
  DWORD count = 0;
  EXPECT_TRUE(::ReadFile(pipe, read.data(), read.size(), &count, nullptr));
  EXPECT_EQ(std::string_view(read.data(), count), "content");
  ::CloseHandle(pipe);
}

TEST_F(WindowsFiles, AFolderIsLockedOnce) {
  const auto lock = lockFolder(directory_.path());
  ASSERT_TRUE(lock);
  EXPECT_FALSE(lockFolder(directory_.path() / "." / "x" / ".."));
  const TemporaryDirectory other;
  auto second = lockFolder(other.path());
  EXPECT_TRUE(second);
  second.reset();
  EXPECT_TRUE(lockFolder(other.path()));
  EXPECT_FALSE(lockFolder(other.path() / "none"));
}

TEST(WindowsFolders, AreWholePathsAndDiffer) {
  for (const char* name : {"XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_PICTURES_DIR", "XDG_DOCUMENTS_DIR"}) {
    setEnvironment(name, "");
  }
  std::set<fs::path> folders;
  for (const fs::path& folder : {userCacheDir(), userConfigDir(), picturesDir(), documentsDir(), temporaryFolder()}) {
    EXPECT_TRUE(folder.is_absolute()) << folder;
    EXPECT_TRUE(folders.insert(folder.parent_path() / folder).second) << folder;
  }
  setEnvironment("XDG_CACHE_HOME", "Z:\\tmp\\\xc3\xa4");
  EXPECT_EQ(userCacheDir().generic_string(), "Z:/tmp/\xc3\xa4/speculum");
  EXPECT_TRUE(isFile(executablePath()));
  EXPECT_EQ(executablePath().extension(), ".exe");
}

TEST(WindowsMachine, IsDescribed) {
  EXPECT_EQ(machineDescription().find("unknown"), std::string::npos) << machineDescription();
  EXPECT_GT(peakResidentBytes(), 1u << 20);
  EXPECT_GT(millisecondsSinceStart(), 0.0);
  EXPECT_LT(millisecondsSinceStart(), 600e3);
}

TEST(WindowsProcess, GivesOutputAndExitCode) {
  const ProcessResult result = runProcess({executablePath().string(), "--fail"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.output, "out\nerr\n");
  EXPECT_EQ(runProcess({"a-program-that-does-not-exist"}).exitCode, 127);
  EXPECT_EQ(runProcess({"hostname"}).exitCode, 0) << "a program in PATH";
}

TEST(WindowsProcess, NamesThatAreNoUtf16AreRead) {
  EXPECT_EQ(win32::utf8(L"\xe4 \x93e1"), "\xc3\xa4 \xe9\x8f\xa1");
  EXPECT_EQ(win32::utf8(L"a\xd800z"), "a\xef\xbf\xbdz");
  EXPECT_EQ(win32::utf8(L""), "");
}

TEST(WindowsProcess, ArgumentsArriveAsTheyAre) {
  const std::vector<std::string> odd{"", "a b", "\"", "\\\"", "a\\\\", "tail\\", "\xc3\xa4 \xe9\x8f\xa1"};
  std::vector<std::string> command{executablePath().string(), "--print-arguments"};
  command.insert(command.end(), odd.begin(), odd.end());
  std::string expected;
  for (const std::string& argument : odd) {
    expected += argument + "\n";
  }
  EXPECT_EQ(runProcess(command).output, expected);
}

// cmd.exe itself takes the words apart.
TEST(WindowsProcess, ShellWordsSurviveTheShell) {
  EXPECT_EQ(shellWord("C:\\a.png"), "C:\\a.png");
  EXPECT_EQ(shellWord(""), "\"\"");
  EXPECT_EQ(shellWord("a\x1b"), "a\\x1b") << "a terminal acts on it";
  EXPECT_EQ(shellWord("C:\\%x"), "\"C:\\\\\"^%\"x\"");
  EXPECT_EQ(shellWord("a##b"), "\"a#\"^#\"b\"") << "a CI runner acts on ##";
  EXPECT_EQ(shellWord("a\"&b"), "\"a\"\\^\"\"&b\"") << "cmd.exe does not know backslashes before quotes";
  EXPECT_EQ(shellWord("%PATH%"), "\"\"^%\"PATH\"^%\"\"");  // wine's cmd.exe takes carets after quotes as they are
  const TemporaryDirectory directory;
  const fs::path output = directory.path() / "output";
  std::string line = shellWord(executablePath().string()) + " --print-arguments";
  std::string expected;
  for (const std::string word : {"a b", "1,0,0", "&", "tail\\ \\", "^", "::a", "\xc3\xa4 \xe9\x8f\xa1"}) {
    line += ' ' + shellWord(word);
    expected += word + "\n";
  }
  // A line that begins with a quote would lose it.
  ::_wsystem(win32::wide("cd . & " + line + " > " + shellWord(output.string())).c_str());
  EXPECT_EQ(readText(output), expected);
}

TEST(WindowsProcess, TalksLineByLine) {
  ChildProcess child({executablePath().string(), "--echo"}, ChildProcess::Input::pipe);
  EXPECT_EQ(child.readLine(0.0), std::nullopt);
  EXPECT_TRUE(child.running());
  EXPECT_FALSE(child.poll());
  // Another child must not keep the first one's pipes open.
  ChildProcess other({executablePath().string(), "--echo"}, ChildProcess::Input::pipe);
  child.write("one\ntwo\n");
  EXPECT_EQ(child.readLine(30.0), "got one");
  EXPECT_EQ(child.readLine(30.0), "got two");
  child.closeInput();
  EXPECT_EQ(child.readLine(30.0), std::nullopt);
  EXPECT_FALSE(child.running());
  EXPECT_EQ(child.wait().exitCode, 4);
  EXPECT_EQ(child.wait().output, "rest");
  EXPECT_TRUE(other.running());
}

TEST(WindowsProcess, KilledAndCrashedChildrenHaveExitCodes) {
  ChildProcess hung({executablePath().string(), "--echo"}, ChildProcess::Input::pipe);
  hung.kill();
  EXPECT_EQ(hung.wait().exitCode, 128 + 9);
  hung.write("nobody reads this\n");
  EXPECT_EQ(runProcess({executablePath().string(), "--crash"}).exitCode, 128 + 11);
}

TEST(WindowsProcess, VariablesAreUtf8) {
  setEnvironment("SPECULUM_ODD", oddName);
  EXPECT_EQ(environment("SPECULUM_ODD"), oddName);
  EXPECT_EQ(environment("SPECULUM_NONE"), "");
}

// What the tests start: this program under another name.
int helper(const std::string& what, const std::vector<const char*>& arguments) {
  if (what == "--print-arguments") {
    for (size_t i = 2; i < arguments.size(); ++i) {
      std::printf("%s\n", arguments[i]);
    }
  } else if (what == "--echo") {
    std::array<char, 100> line;
    while (std::fgets(line.data(), line.size(), stdin)) {
      std::printf("got %s", line.data());
      std::fflush(stdout);
    }
    std::printf("rest");
    return 4;
  } else if (what == "--fail") {
    std::printf("out\n");
    std::fflush(stdout);
    std::fprintf(stderr, "err\n");
    return 3;
  } else if (what == "--crash") {
    volatile int* nowhere = nullptr;
    *nowhere = 1;
  }
  return 0;
}

}  // namespace
}  // namespace speculum::test

int main(int argc, char** argv) {
  const std::vector<const char*> arguments = speculum::prepareProcess(argc, argv);
  for (const char* helper : {"--print-arguments", "--echo", "--fail", "--crash"}) {
    if (argc > 1 && arguments[1] == std::string_view(helper)) {
      return speculum::test::helper(helper, arguments);
    }
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
