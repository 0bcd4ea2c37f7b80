#include <thread>

#include "fuzz/heap_watch.hpp"
#include "geometry/recycled_memory.hpp"
#include "test_headers.hpp"

namespace speculum::test {
namespace {

TEST(RecycledMemory, FreedBlocksAreReused) {
  void* const block = recycled::allocate(100);
  recycled::deallocate(block, 100);
  EXPECT_EQ(recycled::allocate(120), block) << "both sizes round up to 128 bytes";
  void* const other = recycled::allocate(100);
  EXPECT_NE(other, block) << "it is in use";
  recycled::deallocate(other, 100);
  recycled::deallocate(block, 120);
  void* const larger = recycled::allocate(300);
  EXPECT_TRUE(larger != block && larger != other) << "the freed blocks are too small";
  recycled::deallocate(larger, 300);
}

TEST(RecycledMemory, BlocksOfAnySizeKeepTheirContents) {
  for (int round = 0; round < 2; ++round) {
    std::vector<RecycledVector<char>> all;
    for (const size_t size : {1, 7, 8, 9, 1000, 1 << 20, (1 << 20) + 1}) {
      all.emplace_back(size, static_cast<char>(size + round));
    }
    for (const RecycledVector<char>& bytes : all) {
      EXPECT_TRUE(std::ranges::all_of(bytes, [&](char c) { return c == static_cast<char>(bytes.size() + round); }));
    }
  }
  EXPECT_THROW(RecyclingAllocator<double>().allocate(SIZE_MAX / 4), std::bad_array_new_length);
}

TEST(RecycledMemory, BlocksMayBeFreedByAnotherThread) {
  RecycledVector<int> numbers(1000, 7);
  std::thread([&] { numbers = RecycledVector<int>(1000, 8); }).join();
  EXPECT_EQ(numbers, RecycledVector<int>(1000, 8)) << "the thread that allocated it has ended";
}

TEST(RecycledMemory, CachesABoundedNumberOfBytes) {
  std::thread([] {
    const auto allocationsOf = [](size_t blocks) {
      const size_t before = fuzz::allocations();
      std::vector<void*> all(blocks);
      std::ranges::generate(all, [] { return recycled::allocate(1 << 20); });
      std::ranges::for_each(all, [](void* block) { recycled::deallocate(block, 1 << 20); });
      return fuzz::allocations() - before - 1;  // 1: `all`
    };
    EXPECT_EQ(allocationsOf(16), 16u);
    EXPECT_EQ(allocationsOf(16), 0u);
    EXPECT_EQ(allocationsOf(17), 1u);
    EXPECT_EQ(allocationsOf(16), 15u) << "the 17th block emptied the cache";
  }).join();
}

TEST(RecycledMemory, ThreadsLeaveNothing) {
  const auto bytesInUse = [] {
    fuzz::restartHeapPeak();
    return fuzz::heapPeak();
  };
  size_t before = 0;
  for (int round = 0; round < 3; ++round) {
    before = round == 2 ? bytesInUse() : 0;  // the first thread takes memory that stays
    std::thread([] {
      static thread_local RecycledVector<int> numbers;  // is destroyed after the cache
      numbers.assign(10'000, 7);
      RecycledVector<int>(1000, 7).clear();
    }).join();
  }
  EXPECT_EQ(bytesInUse(), before);
}

}  // namespace
}  // namespace speculum::test
