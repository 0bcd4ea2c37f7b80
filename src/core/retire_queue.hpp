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
  void retire(T&& object) {
    entries_.push_back({frame_, std::make_unique<Holder<std::remove_cvref_t<T>>>(std::forward<T>(object))});
  }
  void setFrame(uint64_t frame) { frame_ = frame; }  // numbers of frames grow
  // Destroys what was retired in frames up to and with `finished`, in the order of retirement.
  void collect(uint64_t finished);
  size_t size() const { return entries_.size(); }

 private:
  struct Object {
    virtual ~Object() = default;
  };
  template <typename T>
  struct Holder : Object {
    explicit Holder(T&& o) : object(std::move(o)) {}
    T object;
  };
  struct Entry {
    uint64_t frame;
    std::unique_ptr<Object> object;
  };
  std::deque<Entry> entries_;
  uint64_t frame_ = 0;
};

}  // namespace speculum
