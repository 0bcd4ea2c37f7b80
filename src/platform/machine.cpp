#include "platform/machine.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <string_view>
#include <thread>

#include "platform/process.hpp"

namespace speculum {

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
