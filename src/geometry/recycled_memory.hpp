#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <vector>

namespace speculum {

// Memory of lists that each frame builds anew. A thread caches the blocks that it frees, in sizes of powers of two, and
// hands them out again. Beyond 16 MiB it returns all cached blocks to the heap, as it does when it ends. Blocks of more
// than 1 MiB are not cached. Any thread may free a block.
namespace recycled {
// Aligned as by operator new. Throws std::bad_alloc.
void* allocate(size_t bytes);
void deallocate(void* block, size_t bytes) noexcept;
}  // namespace recycled

// Allocator for the containers of the standard library.
template <typename T>
struct RecyclingAllocator {
  static_assert(alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);
  using value_type = T;

  RecyclingAllocator() = default;
  template <typename U>
  RecyclingAllocator(const RecyclingAllocator<U>&) noexcept {}

  T* allocate(size_t count) {
    if (count > std::numeric_limits<size_t>::max() / sizeof(T)) {
      throw std::bad_array_new_length();
    }
    return static_cast<T*>(recycled::allocate(count * sizeof(T)));
  }
  void deallocate(T* block, size_t count) noexcept { recycled::deallocate(block, count * sizeof(T)); }

  template <typename U>
  bool operator==(const RecyclingAllocator<U>&) const noexcept {
    return true;
  }
};

template <typename T>
using RecycledVector = std::vector<T, RecyclingAllocator<T>>;
using RecycledString = std::basic_string<char, std::char_traits<char>, RecyclingAllocator<char>>;

}  // namespace speculum
