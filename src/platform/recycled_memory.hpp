#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <vector>

namespace speculum {

// Memory for what is made anew each frame. A freed block is kept by the thread that freed it, until that thread asks
// for a block of about the same size, so that a frame like those before takes nothing from the heap. A thread keeps at
// most 16 MiB until it ends, in blocks of at most 1 MiB; larger ones come from the heap. A thread may free blocks that
// another one took.
namespace recycled {
// Aligned like memory of operator new. Throws std::bad_alloc.
void* take(size_t bytes);
void give(void* block, size_t bytes) noexcept;
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
    return static_cast<T*>(recycled::take(count * sizeof(T)));
  }
  void deallocate(T* block, size_t count) noexcept { recycled::give(block, count * sizeof(T)); }

  template <typename U>
  bool operator==(const RecyclingAllocator<U>&) const noexcept {
    return true;
  }
};

template <typename T>
using RecycledVector = std::vector<T, RecyclingAllocator<T>>;
using RecycledString = std::basic_string<char, std::char_traits<char>, RecyclingAllocator<char>>;

}  // namespace speculum
