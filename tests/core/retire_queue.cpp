#include "core/retire_queue.hpp"
#include "test_headers.hpp"

namespace speculum::test {
namespace {

TEST(RetireQueue, DestroysWhatFinishedAndKeepsTheRest) {
  struct Probe {
    explicit Probe(int* c) : count(c) {}
    Probe(Probe&& other) noexcept : count(std::exchange(other.count, nullptr)) {}
    ~Probe() {
      if (count) {
        ++*count;
      }
    }
    int* count;
  };
  int destroyed = 0;
  RetireQueue queue;
  queue.setFrame(1);
  queue.retire(Probe(&destroyed));
  queue.setFrame(2);
  queue.retire(Probe(&destroyed));
  queue.collect(0);
  EXPECT_EQ(destroyed, 0);
  queue.collect(1);
  EXPECT_EQ(destroyed, 1);
  EXPECT_EQ(queue.size(), 1u);
  queue.collect(2);
  EXPECT_EQ(destroyed, 2);
}

}  // namespace
}  // namespace speculum::test
