#include "platform/recycled_memory.hpp"

#include <algorithm>
#include <array>
#include <bit>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/asan_interface.h>
#else
#define ASAN_POISON_MEMORY_REGION(block, bytes) ((void)(block), (void)(bytes))
#define ASAN_UNPOISON_MEMORY_REGION(block, bytes) ((void)(block), (void)(bytes))
#endif

namespace speculum::recycled {

namespace {

constexpr size_t mostKept = size_t{16} << 20;     // bytes, by each thread
constexpr size_t largestBlock = size_t{1} << 20;  // bytes; larger ones are rare, and rounding them up would waste much

struct FreeBlock {
  FreeBlock* next = nullptr;
};

// Blocks of 2^n bytes are in list n.
size_t listOf(size_t bytes) {
  return static_cast<size_t>(std::bit_width(std::max(bytes, sizeof(FreeBlock)) - 1));
}

// Needs no destructor, so that containers may still be freed while the thread ends.
struct FreeBlocks {
  std::array<FreeBlock*, std::numeric_limits<size_t>::digits> lists{};
  size_t kept = 0;       // bytes
  bool watched = false;  // an AtThreadEnd exists
  bool ended = false;
};
constinit thread_local FreeBlocks blocks;

void freeAll() noexcept {
  for (FreeBlock*& list : blocks.lists) {
    while (list) {
      ASAN_UNPOISON_MEMORY_REGION(list, sizeof(FreeBlock));
      FreeBlock* const next = list->next;
      ::operator delete(list);
      list = next;
    }
  }
  blocks.kept = 0;
}

struct AtThreadEnd {
  ~AtThreadEnd() {
    blocks.ended = true;
    freeAll();
  }
};

void watchThread() {
  static thread_local const AtThreadEnd atEnd;
  blocks.watched = true;
}

}  // namespace

void* take(size_t bytes) {
  if (bytes > largestBlock) {
    return ::operator new(bytes);
  }
  const size_t list = listOf(bytes);
  FreeBlock* const block = blocks.lists[list];
  if (!block) {
    return ::operator new (size_t{1} << list);
  }
  ASAN_UNPOISON_MEMORY_REGION(block, std::max(bytes, sizeof(FreeBlock)));
  blocks.lists[list] = block->next;
  blocks.kept -= size_t{1} << list;
  return block;
}

void give(void* memory, size_t bytes) noexcept {
  const size_t size = size_t{1} << listOf(bytes);
  if (bytes > largestBlock || blocks.ended) {
    ::operator delete(memory);
    return;
  }
  if (size > mostKept - blocks.kept) {
    freeAll();  // they may have the sizes that another scene called for
  }
  if (!blocks.watched) {
    watchThread();
  }
  FreeBlock*& list = blocks.lists[listOf(bytes)];
  list = new (memory) FreeBlock{list};
  blocks.kept += size;
  ASAN_POISON_MEMORY_REGION(memory, size);
}

}  // namespace speculum::recycled
