#include <dlfcn.h>
#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "platform/process.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

std::atomic<bool> interruptFlag{false};

bool isIgnored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

std::string outOfMemory;  // message for the user, made while there is memory

struct NoMemory : std::bad_alloc {
  const char* what() const noexcept override { return outOfMemory.c_str(); }
};

// Allocates no memory, since a signal handler calls it.
[[noreturn]] void endOutOfMemory() {
  ::dprintf(STDERR_FILENO, "%s\n", outOfMemory.c_str());
  ::_exit(2);
}

}  // namespace

int ChildProcess::waitFor(intptr_t child) {
  int status = 0;
  while (::waitpid(static_cast<pid_t>(child), &status, 0) < 0) {
    if (errno != EINTR) {
      return -1;
    }
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, Input input) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  int ends[2] = {-1, -1};
  // The input is a socket and not a pipe, because writing to a socket whose reader is gone need not raise SIGPIPE.
  int inputEnds[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0 ||
      (input == Input::pipe && ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, inputEnds) != 0)) {
    for (const int end : ends) {
      ::close(end);
    }
    throw std::runtime_error("no pipe could be made for " + arguments.front());
  }
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  if (input == Input::pipe) {
    ::posix_spawn_file_actions_adddup2(&actions, inputEnds[0], STDIN_FILENO);
  }
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  pid_t child = 0;
  if (::posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ) == 0) {
    child_ = child;
  } else {
    result_ = {127, arguments.front() + ": cannot be run"};
  }
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  descriptor_ = ends[0];
  if (input == Input::pipe) {
    ::close(inputEnds[0]);
    input_ = inputEnds[1];
  }
}

ChildProcess::~ChildProcess() {
  if (child_ != 0) {
    ::kill(child_, isIgnored(SIGTERM) ? SIGKILL : SIGTERM);  // a child ignores the signals that this process ignores
    waitFor(child_);
  }
  closeInput();
  ::close(descriptor_);
}

bool ChildProcess::read() {
  char block[4096];
  ssize_t count = 0;
  do {
    count = ::read(descriptor_, block, sizeof block);
  } while (count < 0 && errno == EINTR);
  result_.output.append(block, static_cast<size_t>(std::max<ssize_t>(count, 0)));
  return count > 0;
}

bool ChildProcess::readable(Clock::time_point end) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
  pollfd output{.fd = static_cast<int>(descriptor_), .events = POLLIN};
  return ::poll(&output, 1, static_cast<int>(std::max<int64_t>(left.count(), 0))) > 0;
}

void ChildProcess::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::send(input_, text.data(), text.size(), MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) {
      return;
    }
    text.remove_prefix(static_cast<size_t>(std::max<ssize_t>(count, 0)));
  }
}

void ChildProcess::closeInput() {
  if (input_ >= 0) {
    ::close(std::exchange(input_, -1));
  }
}

void ChildProcess::kill() {
  if (child_ != 0) {
    ::kill(child_, SIGKILL);
  }
}

std::string shellWord(const std::string& argument) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_./:,=+%@").find(c) != std::string_view::npos;
  };
  if (!argument.empty() && std::ranges::all_of(argument, plain)) {
    return argument;
  }
  const bool hidden = oneLine(argument) != argument;
  std::string text = hidden ? "$'" : "'";
  for (const char c : argument) {
    text += hidden && !plain(c) ? fmt::format("\\{:03o}", static_cast<unsigned char>(c))
            : c == '\''         ? std::string("'\\''")
                                : std::string(1, c);
  }
  return text + "'";
}

std::vector<const char*> prepareProcess(int argc, const char* const* argv) {
  return {argv, argv + argc};
}

void showFailure(const std::string&) {}

const char* const renderDocLibrary = "librenderdoc.so";

void* loadedFunction(const char* library, const char* name) {
  void* const loaded = ::dlopen(library, RTLD_NOW | RTLD_NOLOAD);
  return loaded ? ::dlsym(loaded, name) : nullptr;
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
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (!isIgnored(signal)) {
      ::sigaction(signal, &action, nullptr);
    }
  }
}

bool interruptRequested() {
  return interruptFlag;
}

void letLargeWritesFail() {
  ::signal(SIGXFSZ, SIG_IGN);
}

void letBrokenPipesFail() {
  ::signal(SIGPIPE, SIG_IGN);
}

std::string memoryLimitAdvice() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return {};
  }
  return " (this process may use " + std::to_string(limit.rlim_cur >> 20) + " MiB of address space: raise ulimit -v)";
}

void explainLackOfMemory() {
  const std::string limit = memoryLimitAdvice();
  outOfMemory =
      "there is not enough memory (use smaller models, fewer or smaller textures, or a smaller --size)" + limit;
  std::set_new_handler([] { throw NoMemory(); });
  if (!limit.empty()) {
    std::set_terminate(endOutOfMemory);
    for (const int fault : {SIGABRT, SIGSEGV, SIGBUS}) {
      std::signal(fault, [](int) { endOutOfMemory(); });
    }
  }
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

void releaseFreedMemory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

}  // namespace speculum

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// Drivers stay loaded to the end, so that the suppressions of leaks and races can name them.
extern "C" int dlclose(void*) noexcept {
  return 0;
}
#endif
