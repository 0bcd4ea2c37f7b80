#include "geometry/recycled_memory.hpp"

#include <algorithm>
#include <array>
#include <bit>

#if __has_include(<sanitizer/asan_interface.h>)
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(block, bytes) ((void)(block), (void)(bytes))
#define ASAN_UNPOISON_MEMORY_REGION(block, bytes) ((void)(block), (void)(bytes))
#endif

namespace speculum::recycled {

namespace {

constexpr size_t mostCached = size_t{16} << 20;  // bytes, by each thread
// Bytes. Larger blocks are rare, and rounding them up would waste much.
constexpr size_t largestBlock = size_t{1} << 20;

// The first bytes of a cached block. They stay readable for AddressSanitizer, whose search for leaks follows them.
struct CachedBlock {
  CachedBlock* next = nullptr;
};

// Blocks of size class n have 2^n bytes.
size_t sizeClass(size_t bytes) {
  return static_cast<size_t>(std::bit_width(std::max(bytes, sizeof(CachedBlock)) - 1));
}

// Marks a block as unused for AddressSanitizer, except its first bytes.
void poison(void* block, size_t bytes) {
  ASAN_POISON_MEMORY_REGION(static_cast<char*>(block) + sizeof(CachedBlock), bytes - sizeof(CachedBlock));
}
// Marks bytes as in use.
void unpoison(void* block, size_t bytes) {
  ASAN_UNPOISON_MEMORY_REGION(block, bytes);
}

// Needs no destructor, so that containers may be freed until the thread has ended.
struct Cache {
  std::array<CachedBlock*, std::bit_width(largestBlock)> lists{};  // by size class
  size_t bytes = 0;
  bool emptiedAtEnd = false;  // the thread has an EmptiesCache
  bool ended = false;
};
constinit thread_local Cache cache;

void emptyCache() noexcept {
  for (CachedBlock*& list : cache.lists) {
    while (list) {
      CachedBlock* const next = list->next;
      ::operator delete(list);
      list = next;
    }
  }
  cache.bytes = 0;
}

struct EmptiesCache {
  ~EmptiesCache() {
    cache.ended = true;
    emptyCache();
  }
};

void emptyCacheAtEnd() {
  static thread_local const EmptiesCache atEnd;
  cache.emptiedAtEnd = true;
}

}  // namespace

void* allocate(size_t bytes) {
  if (bytes > largestBlock) {
    return ::operator new(bytes);
  }
  const size_t index = sizeClass(bytes);
  const size_t size = size_t{1} << index;
  void* block = cache.lists[index];
  if (block) {
    cache.lists[index] = cache.lists[index]->next;
    cache.bytes -= size;
  } else {
    block = ::operator new(size);
    poison(block, size);
  }
  unpoison(block, std::max(bytes, sizeof(CachedBlock)));
  return block;
}

void deallocate(void* block, size_t bytes) noexcept {
  if (bytes > largestBlock || cache.ended) {
    ::operator delete(block);
    return;
  }
  const size_t index = sizeClass(bytes);
  const size_t size = size_t{1} << index;
  if (!cache.emptiedAtEnd) {
    emptyCacheAtEnd();
  }
  if (size > mostCached - cache.bytes) {
    emptyCache();  // its blocks may have the sizes of another scene
  }
  cache.lists[index] = new (block) CachedBlock{cache.lists[index]};
  cache.bytes += size;
  poison(block, size);
}

}  // namespace speculum::recycled
