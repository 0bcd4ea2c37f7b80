#include "platform/machine.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <ctime>
#include <exception>
#include <fstream>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>

#include "platform/process.hpp"

namespace speculum {

namespace {

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

double millisecondsSinceStart() {
  // proc(5): the 22nd field of stat, in clock ticks since the machine started. The 2nd, in brackets, may hold blanks.
  std::ifstream file("/proc/self/stat");
  std::string stat;
  std::getline(file, stat);
  std::istringstream fields(stat.substr(std::min(stat.rfind(')') + 1, stat.size())));
  std::string field;
  for (int i = 3; i < 22; ++i) {
    fields >> field;
  }
  double ticks = 0.0;
  timespec now{};
  if (!(fields >> ticks) || ::clock_gettime(CLOCK_BOOTTIME, &now) != 0) {
    return 0.0;
  }
  const double started = 1e3 * ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec) - started;
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
