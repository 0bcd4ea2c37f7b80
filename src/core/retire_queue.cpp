#include "core/retire_queue.hpp"

namespace speculum {

void RetireQueue::collect(uint64_t finished) {
  while (!entries_.empty() && entries_.front().frame <= finished) {
    entries_.pop_front();
  }
}

}  // namespace speculum
