#include "heap_watch.hpp"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<size_t> inUse{0};
std::atomic<size_t> most{0};
std::atomic<size_t> calls{0};

}  // namespace

void* operator new(size_t size) {
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  ++calls;
  const size_t now = inUse += malloc_usable_size(memory);
  for (size_t before = most; before < now && !most.compare_exchange_weak(before, now);) {
  }
  return memory;
}

// Replaces the library's own, whose memory the delete below could not free.
void* operator new(size_t size, const std::nothrow_t&) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

void operator delete(void* memory) noexcept {
  inUse -= malloc_usable_size(memory);
  std::free(memory);
}

void operator delete(void* memory, size_t) noexcept {
  operator delete(memory);
}

namespace speculum::fuzz {

void restartHeapPeak() {
  most = inUse.load();
}

size_t heapPeak() {
  return most;
}

size_t allocations() {
  return calls;
}

}  // namespace speculum::fuzz
