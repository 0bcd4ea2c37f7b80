#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <utility>

namespace speculum {

// Keeps objects that the GPU may still use until the frame that is being recorded has finished.
class RetireQueue {
 public:
  template <typename T>
  void retire(T object) {
    entries_.push_back({frame_, std::make_shared<T>(std::move(object))});
  }
  // Retires an object, if there is one, and leaves none in its place.
  template <typename T>
  void take(T& object) {
    if (object) {
      retire(std::exchange(object, T()));
    }
  }
  void setFrame(uint64_t frame) { frame_ = frame; }  // number of the frame that is being recorded; numbers grow
  // Destroys what was retired in frames up to and including `finished`, in the order of retirement.
  void collect(uint64_t finished) {
    while (!entries_.empty() && entries_.front().frame <= finished) {
      entries_.pop_front();
    }
  }
  size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    uint64_t frame;
    std::shared_ptr<void> object;
  };
  std::deque<Entry> entries_;
  uint64_t frame_ = 0;
};

}  // namespace speculum
