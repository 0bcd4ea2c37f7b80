#pragma once

#include <algorithm>
#include <deque>
#include <string>
#include <utility>

#include "core/handle.hpp"

namespace speculum {

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
