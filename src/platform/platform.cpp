#include "platform/platform.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace speculum {

namespace fs = std::filesystem;

namespace {

std::atomic<bool> interruptFlag{false};

fs::path userDir(const char* variable, const char* fallback) {
  // The XDG base directory specification tells to ignore relative paths.
  const fs::path base = environment(variable);
  if (base.is_absolute()) {
    return base / "speculum";
  }
  const std::string home = environment("HOME");
  return (home.empty() ? fs::temp_directory_path() : fs::path(home) / fallback) / "speculum";
}

// The folder that xdg-user-dirs has noted, say XDG_PICTURES_DIR="$HOME/..." or an absolute path.
fs::path notedDir(const std::string& variable, const std::string& home) {
  std::ifstream file(userConfigDir().parent_path() / "user-dirs.dirs");
  const std::string key = variable + "=\"";
  for (std::string line; std::getline(file, line);) {
    const size_t end = line.rfind('"');
    if (line.rfind(key, 0) != 0 || end < key.size()) {
      continue;
    }
    const std::string value = line.substr(key.size(), end - key.size());
    return value.rfind("$HOME/", 0) == 0 ? fs::path(home) / value.substr(6) : fs::path(value);
  }
  return {};
}

std::string readAll(int descriptor) {
  std::string text;
  char block[4096];
  for (;;) {
    const ssize_t count = ::read(descriptor, block, sizeof block);
    if (count > 0) {
      text.append(block, static_cast<size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      return text;
    }
  }
}

int waitFor(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      return -1;
    }
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

fs::path desktopDir(const std::string& variable, const char* fallback) {
  const std::string home = environment("HOME");
  for (const fs::path& folder : {fs::path(environment(variable)), notedDir(variable, home)}) {
    if (folder.is_absolute()) {
      return folder;
    }
  }
  return home.empty() ? fs::temp_directory_path() : fs::path(home) / fallback;
}

}  // namespace

fs::path executablePath() {
  return fs::read_symlink("/proc/self/exe");
}

fs::path userCacheDir() {
  return userDir("XDG_CACHE_HOME", ".cache");
}

fs::path userConfigDir() {
  return userDir("XDG_CONFIG_HOME", ".config");
}

fs::path picturesDir() {
  return desktopDir("XDG_PICTURES_DIR", "Pictures");
}

fs::path documentsDir() {
  return desktopDir("XDG_DOCUMENTS_DIR", "Documents");
}

bool isWritable(const fs::path& file) {
  std::error_code none;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  return ::access((fs::exists(file, none) ? file : folder).c_str(), W_OK) == 0;
}

fs::path dataDirectory(std::string_view name) {
  const fs::path exe = executablePath().parent_path();
  const fs::path up = exe.parent_path();
  // Built: beside the program, a folder higher for test programs, then up to the source tree.
  const fs::path candidates[] = {exe / name, up / "share" / "speculum" / name, up / name, up.parent_path() / name,
                                 up.parent_path().parent_path() / name};
  std::string places;
  for (const fs::path& candidate : candidates) {
    std::error_code error;
    if (fs::is_directory(candidate, error)) {
      return candidate;
    }
    places += (places.empty() ? "" : ", ") + candidate.string();
  }
  throw std::runtime_error("no directory '" + std::string(name) + "' was found; looked at " + places +
                           " (build the project, or install it with cmake --install)");
}

ProcessResult runProcess(const std::vector<std::string>& arguments) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe could be made for " + arguments.front());
  }
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  pid_t child = 0;
  const int failure = ::posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  ProcessResult result;
  if (failure != 0) {
    result = {127, arguments.front() + ": cannot be run"};
  } else {
    result.output = readAll(ends[0]);
    result.exitCode = waitFor(child);
  }
  ::close(ends[0]);
  return result;
}

std::string machineDescription() {
  const auto valueAfter = [](const char* file, std::string_view start) -> std::string {
    std::ifstream stream(file);
    for (std::string line; std::getline(stream, line);) {
      if (line.starts_with(start)) {
        line.erase(0, line.find_first_of(":=") + 1);
        std::erase(line, '"');
        return line.substr(std::min(line.find_first_not_of(' '), line.size()));
      }
    }
    return "unknown";
  };
  return valueAfter("/proc/cpuinfo", "model name") + ", " + std::to_string(std::thread::hardware_concurrency()) +
         " threads, " + valueAfter("/etc/os-release", "PRETTY_NAME");
}

uint64_t peakResidentBytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;
}

void keepFreedMemory() {
#ifdef __GLIBC__
  if (!environment("MALLOC_TRIM_THRESHOLD_").empty() || !environment("MALLOC_MMAP_THRESHOLD_").empty()) {
    return;
  }
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
  // Setting one threshold freezes the other at 128 KiB, above which every block is mapped and unmapped.
  ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
}

bool replaceFile(const fs::path& file, std::span<const uint8_t> content) {
  std::error_code error;
  if (file.has_parent_path()) {
    fs::create_directories(file.parent_path(), error);
  }
  const fs::path fresh = file.string() + ".new" + std::to_string(::getpid());
  std::ofstream stream(fresh, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) {
    fs::remove(fresh, error);
    return false;
  }
  fs::rename(fresh, file, error);
  if (error) {
    std::error_code ignored;
    fs::remove(fresh, ignored);
    return false;
  }
  return true;
}

std::optional<std::vector<uint8_t>> readFile(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) {
    return std::nullopt;
  }
  std::ifstream stream(file, std::ios::binary);
  std::vector<uint8_t> content{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream && !stream.eof()) {
    return std::nullopt;
  }
  return content;
}

std::optional<double> modificationTime(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    return std::nullopt;
  }
  return static_cast<double>(status.st_mtim.tv_sec) + 1e-9 * static_cast<double>(status.st_mtim.tv_nsec);
}

void setEnvironment(const std::string& name, const std::string& value) {
  ::setenv(name.c_str(), value.c_str(), 1);
}

std::string environment(const std::string& name) {
  const char* value = std::getenv(name.c_str());
  return value ? value : "";
}

bool isTerminal(int fileDescriptor) {
  return ::isatty(fileDescriptor) != 0;
}

void installInterruptHandler() {
  struct sigaction action {};
  action.sa_handler = [](int) { interruptFlag = true; };
  // A second Ctrl-C ends the process even if the flag is not looked at.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool interruptRequested() {
  return interruptFlag;
}

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (fs::temp_directory_path() / "speculum-XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    throw std::runtime_error("no temporary directory could be made at " + name + " (is it writable?)");
  }
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace speculum

#ifdef __SANITIZE_ADDRESS__
// Drivers stay loaded to the end, so that the leak checker's suppressions can name them.
extern "C" int dlclose(void*) {
  return 0;
}
#endif
