#include "platform/machine.hpp"
#include "platform/win32.hpp"

#include <array>
#include <new>
#include <thread>

namespace speculum {

namespace {

std::string registryText(const wchar_t* key, const wchar_t* value) {
  std::array<wchar_t, 256> text{};
  DWORD bytes = sizeof text;
  return ::RegGetValueW(HKEY_LOCAL_MACHINE, key, value, RRF_RT_REG_SZ, nullptr, text.data(), &bytes) == ERROR_SUCCESS
             ? win32::utf8(text.data())
             : "unknown";
}

uint64_t ticksOf(FILETIME time) {
  return static_cast<uint64_t>(time.dwHighDateTime) << 32 | time.dwLowDateTime;
}

struct NoMemory : std::bad_alloc {
  const char* what() const noexcept override {
    return "there is not enough memory (use smaller models, fewer or smaller textures, or a smaller --size)";
  }
};

}  // namespace

std::string memoryLimitAdvice() {
  return {};
}

void explainLackOfMemory() {
  std::set_new_handler([] { throw NoMemory(); });
}

std::string machineDescription() {
  return registryText(L"HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0", L"ProcessorNameString") + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " threads, " +
         registryText(L"SOFTWARE\\Microsoft\\Windows NT\\CurrentVersion", L"ProductName");
}

uint64_t peakResidentBytes() {
  PROCESS_MEMORY_COUNTERS counters{};
  ::GetProcessMemoryInfo(::GetCurrentProcess(), &counters, sizeof counters);
  return counters.PeakWorkingSetSize;
}

double millisecondsSinceStart() {
  FILETIME started{};
  FILETIME unused{};
  FILETIME now{};
  ::GetSystemTimePreciseAsFileTime(&now);
  const bool known = ::GetProcessTimes(::GetCurrentProcess(), &started, &unused, &unused, &unused) != 0;
  return known ? 1e-4 * static_cast<double>(ticksOf(now) - ticksOf(started)) : 0.0;  // ticks of 100 ns
}

// The heap of Windows keeps what is freed by itself.
void keepFreedMemory() {}
void releaseFreedMemory() {}

}  // namespace speculum
