// The user's folders, the machine's memory and other programs.
#include <fnmatch.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <thread>

#include "error_message.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "platform/text.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"

namespace speculum::test {
namespace {

namespace fs = std::filesystem;

TEST(Folders, CacheDirectoryFollowsXdg) {
  setEnvironment("XDG_CACHE_HOME", "/somewhere");
  EXPECT_EQ(userCacheDir(), "/somewhere/speculum");
  setEnvironment("XDG_CACHE_HOME", "relative/is/ignored");
  setEnvironment("HOME", "/home/me");
  EXPECT_EQ(userCacheDir(), "/home/me/.cache/speculum");
}

// Neither $HOME nor folders of XDG are set, and $TMPDIR is a folder of the test.
class HomelessFolders : public testing::Test {
 protected:
  HomelessFolders() {
    for (const char* name :
         {"HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "XDG_PICTURES_DIR", "XDG_DOCUMENTS_DIR", "TMPDIR"}) {
      before_.emplace_back(name, environment(name));
      ::unsetenv(name);
    }
    setEnvironment("TMPDIR", parent_.string());
    useParent(01777);
    std::ofstream(victim_) << "precious";
  }
  ~HomelessFolders() override {
    for (const auto& [name, value] : before_) {
      value.empty() ? ::unsetenv(name.c_str()) : ::setenv(name.c_str(), value.c_str(), 1);
    }
  }
  // Begins with an empty $TMPDIR of that mode.
  void useParent(mode_t mode) {
    fs::remove_all(parent_);
    fs::create_directory(parent_);
    ::chmod(parent_.c_str(), mode);
  }
  // Says whether anything can be stored in each of the user's folders. The files of others must stay as they are.
  bool keepsAnything() {
    bool kept = false;
    for (const fs::path& folder : {userCacheDir(), userConfigDir(), picturesDir(), documentsDir()}) {
      kept = storeFile(folder / "file", "content") || storeFile(folder / "below" / "file", "content") || kept;
    }
    EXPECT_EQ(readText(victim_), "precious");
    return kept;
  }

  std::vector<std::pair<std::string, std::string>> before_;
  const TemporaryDirectory directory_;
  const fs::path parent_ = directory_.path() / "tmp";
  const fs::path own_ = parent_ / ("speculum-" + std::to_string(::geteuid()));
  const fs::path victim_ = directory_.path() / "victim";
};

TEST_F(HomelessFolders, AreTheUsersAlone) {
  for (const char* home : {"", "relative"}) {
    useParent(01777);
    setEnvironment("HOME", home);
    EXPECT_TRUE(keepsAnything());
    EXPECT_EQ(readText(userCacheDir() / "file"), "content");
    EXPECT_TRUE(keepsAnything()) << "the folder of the last run is used again";
    struct stat status {};
    ASSERT_EQ(::lstat(own_.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777, mode_t{0700});
    EXPECT_EQ(std::distance(fs::directory_iterator(parent_), fs::directory_iterator()), 1) << "all lie in it";
  }
}

TEST_F(HomelessFolders, KeepNothingWhereOthersMayWrite) {
  const fs::path theirs = directory_.path() / "theirs";
  fs::create_directories(theirs / ".cache" / "speculum");
  fs::create_directories(theirs / ".config" / "speculum");
  for (const char* folder : {".cache", ".config"}) {
    fs::create_symlink(victim_, theirs / folder / "speculum" / "file");
  }
  fs::permissions(theirs, fs::perms(0700));
  for (const fs::path& target : {theirs, victim_, directory_.path() / "none"}) {
    useParent(01777);
    fs::create_symlink(target, own_);
    EXPECT_FALSE(keepsAnything()) << target;
  }
  useParent(01777);
  std::ofstream(own_) << "a file";
  EXPECT_FALSE(keepsAnything());
  for (const int mode : {0777, 01777, 0770, 0755, 0750, 0707, 0701, 0710, 0720, 0704}) {
    useParent(01777);
    fs::copy(theirs, own_, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
    ::chmod(own_.c_str(), static_cast<mode_t>(mode));
    EXPECT_FALSE(keepsAnything()) << std::oct << mode;
  }
  for (const int mode : {0777, 0773}) {
    useParent(static_cast<mode_t>(mode));
    EXPECT_FALSE(keepsAnything()) << "names in it can be changed by others, mode " << std::oct << mode;
  }
  if (::geteuid() == 0) {
    useParent(01777);
    fs::copy(theirs, own_, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
    ::chmod(own_.c_str(), 0700);
    ASSERT_EQ(::chown(own_.c_str(), 12345, 12345), 0);
    EXPECT_FALSE(keepsAnything());
    useParent(01777);
    ASSERT_EQ(::chown(parent_.c_str(), 12345, 12345), 0);
    EXPECT_FALSE(keepsAnything());
  }
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

TEST(Folders, FontsHaveTheCharacters) {
  const std::vector<FontFace> fonts = fontsFor(U"\u10db\u10d8\U0010fffe");  // the last is no character
  ASSERT_EQ(fonts.size(), 1u);
  EXPECT_TRUE(isFile(fonts.front().file));
  EXPECT_TRUE(fontsFor(U"\U0010fffe").empty());
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

// Returns the escapes that JSON in ASCII needs for the text, such as \\n and \\u202e. Throws for what is not UTF-8.
std::set<std::string> escapesOf(const std::string& text) {
  const std::string json = nlohmann::json(text).dump(-1, ' ', true);
  std::set<std::string> escapes;
  for (size_t i = 0; (i = json.find('\\', i)) != std::string::npos;) {
    const size_t length = json[i + 1] == 'u' ? 6 : 2;
    escapes.insert(json.substr(i, length));
    i += length;
  }
  return escapes;
}

// GitHub's runner trims a line before it looks for ::, and finds ##[ anywhere in it.
void expectHarmless(const std::string& line) {
  static const std::regex hidden(R"(\\([nrtbf]|u00[0189].|u007f|u061c|u200[ef]|u202[89a-e]|u206.|ufd[de].|ufff[ef]))");
  for (const std::string& escape : escapesOf(line)) {
    EXPECT_FALSE(std::regex_match(escape, hidden)) << escape << " in " << line;
  }
  const size_t begin = line.find_first_not_of(" \xc2\xa0\xe3\x80");
  EXPECT_NE(line.compare(std::min(begin, line.size()), 2, "::"), 0) << line;
  EXPECT_EQ(line.find("##"), std::string::npos) << line;
}

// Systems without fnmatch() have the same patterns. A set that does not end is a bracket here, whatever it ends in.
TEST(Text, GlobsMatchAsFnmatchSays) {
  std::mt19937 random(1);
  const auto anyOf = [&](std::string_view bytes, size_t most) {
    std::string text(random() % (most + 1), '\0');
    std::ranges::generate(text, [&] { return bytes[random() % bytes.size()]; });
    return text;
  };
  // Puts longer characters, in the same order, in the place of letters.
  const auto wide = [](const std::string& text) {
    std::string all;
    for (const char c : text) {
      all += c == 'b' ? "\u00e4" : c == 'c' ? "\u20ac" : std::string(1, c);
    }
    return all;
  };
  int matches = 0;
  for (int i = 0; i < 200'000; ++i) {
    const std::string glob = anyOf("ab*?[]!-\\c^", 7);
    const std::string text = anyOf("abc-]![", 5);
    if (!glob.ends_with('-')) {
      const bool expected = ::fnmatch(glob.c_str(), text.c_str(), 0) == 0;
      ASSERT_EQ(matchesGlob(glob, text), expected) << "'" << glob << "' and '" << text << "'";
      ASSERT_EQ(matchesGlob(wide(glob), wide(text)), expected) << "'" << wide(glob) << "' and '" << wide(text) << "'";
      matches += expected;
    }
  }
  EXPECT_GT(matches, 5'000);
  EXPECT_TRUE(matchesGlob("[\xfc]?", "\xfc\xff"));  // bytes that are no characters
  EXPECT_FALSE(matchesGlob("*\u00a4", "\u00e4"));   // the second byte of the text is the pattern's code
  EXPECT_FALSE(matchesGlob("*??", "\u20ac"));
  EXPECT_FALSE(matchesGlob(std::string(60, '*') + "b", std::string(10'000, 'a')));  // in time that is linear in stars
}

TEST(Text, OneLineOfAnyBytesIsHarmless) {
  const std::vector<std::string> pieces{"\n",
                                        "\r",
                                        "\x1b[2J",
                                        "\x1b]0;t\x07",
                                        "\x7f",
                                        "\xc2\x85",
                                        "\xc2\x9b",
                                        "\xe2\x80\xa8",
                                        "\xe2\x80\xa9",
                                        "\xe2\x80\xae",
                                        "\xe2\x81\xa6",
                                        "\xd8\x9c",
                                        "\xef\xbf\xbe",
                                        "\xef\xbf\xbf",
                                        "\xed\xa0\x80",
                                        "\xed\xbf\xbf",
                                        "\xc0\x80",
                                        "\xe0\x80\x80",
                                        "\xf4\x90\x80\x80",
                                        "\xf0\x9f\xbf\xbe",
                                        "\xff",
                                        "\xe2",
                                        "\xf0\x9f",
                                        "::error::",
                                        "::add-mask::",
                                        "##[error]",
                                        "##vso[task]",
                                        "#",
                                        ":",
                                        " ",
                                        "\xc2\xa0",
                                        "\xe3\x80\x80",
                                        "a",
                                        "\xc3\xa9",
                                        "\xf0\x9f\x98\x80"};
  std::mt19937 random(1);
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (size_t k = random() % 8; k > 0; --k) {
      text += random() % 4 == 0 ? std::string(1, static_cast<char>(random())) : pieces[random() % pieces.size()];
    }
    const std::string line = oneLine(text);
    expectHarmless(line);
    ASSERT_EQ(oneLine(line), line) << "a message may go through it twice";
    for (std::string lines = indentedLines(text); !lines.empty();) {
      const size_t length = std::min(lines.find('\n'), lines.size());
      expectHarmless(lines.substr(0, length));
      lines.erase(0, length + 1);
    }
  }
}

TEST(Text, OneLineKeepsWhatCanBeRead) {
  for (const char* text :
       {"a: b::c # d", "\xc3\xa9t\xc3\xa9 \xe6\x97\xa5 \xf0\x9f\x98\x80", "C:\\models\\a.obj", "1 # 2:3", ""}) {
    EXPECT_EQ(oneLine(text), text);
  }
  EXPECT_EQ(oneLine("a\nb\x1b[2J\xff\xe2\x80\xae"), "a\\x0ab\\x1b[2J\\xff\\u202e");
  EXPECT_EQ(oneLine(" ::error::##[x]"), " \\x3a:error::#\\x23[x]");
  EXPECT_EQ(indentedLines("a\n::b\nreply {}"), "a\n  \\x3a:b\n  reply {}");
}

TEST(Text, LongLinesEndAtWholeCharacters) {
  for (size_t shift = 0; shift < 4; ++shift) {
    std::string text(shift, 'x');
    for (int i = 0; i < 5000; ++i) {
      text += "\xf0\x9f\x98\x80";
    }
    const std::string line = oneLine(text);
    EXPECT_LE(line.size(), 4000u + 3u);
    EXPECT_EQ(oneLine(line), line);
    expectHarmless(line);
  }
}

// Every other way to print would let foreign text through.
TEST(Text, NothingPrintsButPrintLine) {
  const std::map<std::string, int> others{
      {"cli/commands.cpp", 5},            // flushes the stream of --help, and shows the progress
      {"cli/compare_command.cpp", 1},     // a table of numbers
      {"cli/regress_command.cpp", 2},     // the worker's reply, and GitHub's commands
      {"cli/stats.cpp", 1},               // JSON, which escapes what is foreign, or CSV
      {"platform/process_posix.cpp", 1},  // a constant line, where memory is short
      {"platform/text.cpp", 1}};
  const std::regex call(R"((^|[^a-z])([fd]?printf|f?puts|putchar|fputc|fwrite)\(|std::(cout|cerr|clog))");
  std::map<std::string, int> found;
  const std::filesystem::path src = sourceDir() / "src";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(src)) {
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") {
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        const bool likely = line.find("printf") != line.npos || line.find("put") != line.npos ||
                            line.find("fwrite") != line.npos || line.find("std::c") != line.npos;
        if (likely && std::regex_search(line, call)) {
          ++found[entry.path().lexically_relative(src).string()];
        }
      }
    }
  }
  EXPECT_EQ(found, others);
}

TEST(Process, GivesOutputAndExitCode) {
  const ProcessResult result = runProcess({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(result.exitCode, 3);
  EXPECT_EQ(result.output, "out\nerr\n");
  EXPECT_EQ(runProcess({"a-program-that-does-not-exist"}).exitCode, 127);
}

TEST(Process, ShellWordsSurviveTheShell) {
  EXPECT_EQ(shellWord("a-b_c./d:e,f=g+h%i@j"), "a-b_c./d:e,f=g+h%i@j");
  std::string line = "printf '%s|'";
  std::string expected;
  for (const std::string word : {"", "a b", "it's $HOME", "\"", "\\", "*", "a\x1b[2J\n'b\\", "\xc3\xa4 \xe9\x8f\xa1"}) {
    line += ' ' + shellWord(word);
    expected += word + '|';
  }
  EXPECT_EQ(line.find('\x1b'), std::string::npos) << "a terminal acts on it";
  EXPECT_EQ(runProcess({"bash", "-c", line}).output, expected);
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

// Returns what of a process is left that ignored some signals from its start, let them be handled, and gets `signal`.
int endBySignal(int signal, const std::vector<int>& ignored) {
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) {
      ::signal(each, std::ranges::count(ignored, each) > 0 ? SIG_IGN : SIG_DFL);
    }
    installInterruptHandler();
    installInterruptHandler();  // as when a command starts again
    ::raise(signal);
    ::_exit(interruptRequested() ? 1 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

TEST(Process, IgnoredSignalsStayIgnored) {
  const std::vector<int> signals{SIGINT, SIGTERM, SIGHUP};
  for (unsigned set = 0; set < 8; ++set) {
    std::vector<int> ignored;
    for (unsigned i = 0; i < 3; ++i) {
      if ((set >> i & 1u) != 0) {
        ignored.push_back(signals[i]);
      }
    }
    for (const int signal : signals) {
      const int status = endBySignal(signal, ignored);
      ASSERT_TRUE(WIFEXITED(status));
      EXPECT_EQ(WEXITSTATUS(status), std::ranges::count(ignored, signal) > 0 ? 0 : 1) << signal << " of " << set;
    }
  }
}

TEST(Process, ChildrenEndAlthoughTerminationIsIgnored) {
  const auto before = std::signal(SIGTERM, SIG_IGN);
  ChildProcess({"sleep", "1000"});
  std::signal(SIGTERM, before);
}

}  // namespace
}  // namespace speculum::test
