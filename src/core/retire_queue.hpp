#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "core/handle.hpp"

namespace speculum {

// Keeps objects that the GPU may still use until the frame that is being recorded has finished.
class RetireQueue {
 public:
  template <typename T>
  void retire(T object) {
    entries_.push_back({frame_, {new T(std::move(object)), [](void* kept) { delete static_cast<T*>(kept); }}});
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
    std::unique_ptr<void, void (*)(void*)> object;
  };
  std::deque<Entry> entries_;
  uint64_t frame_ = 0;
};

// Pipelines that nobody uses at present. Drivers take milliseconds to seconds to make one, and the same one is often
// wanted again: when a setting is changed back, or by the next scene.
class SparePipelines {
 public:
  struct Spare {
    PipelineLayoutHandle layout;
    PipelineHandle pipeline;
  };

  // Keeps at most so many from now on; none at first.
  void keepAtMost(size_t most) {
    most_ = most;
    while (entries_.size() > most_) {
      entries_.pop_front();
    }
  }
  // Hands out the pipeline of this key; null handles if there is none.
  Spare take(const std::string& key) {
    const auto found = std::ranges::find(entries_, key, &Entry::key);
    if (found == entries_.end()) {
      return {};
    }
    Spare spare = std::move(found->spare);
    entries_.erase(found);
    return spare;
  }
  // Keeps a pipeline that no frame uses any more. The one that came first goes if there are too many.
  void keep(std::string key, Spare spare) {
    entries_.push_back({std::move(key), std::move(spare)});
    keepAtMost(most_);
  }

 private:
  struct Entry {
    std::string key;
    Spare spare;
  };
  size_t most_ = 0;
  std::deque<Entry> entries_;  // in the order in which they came
};

}  // namespace speculum
