#include "platform/machine.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "platform/process.hpp"
#include "test_headers.hpp"

namespace speculum::test {
namespace {

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

}  // namespace
}  // namespace speculum::test
