#include "core/spare_pipelines.hpp"

#include <algorithm>
#include <utility>

namespace speculum {

SparePipelines::Spare SparePipelines::take(const std::string& key) {
  const auto found = std::ranges::find(entries_, key, &Entry::key);
  if (found == entries_.end()) {
    return {};
  }
  Spare spare = std::move(found->spare);
  entries_.erase(found);
  return spare;
}

void SparePipelines::keepAtMost(size_t most) {
  most_ = most;
  while (entries_.size() > most_) {
    entries_.pop_front();
  }
}

void SparePipelines::keep(std::string key, Spare spare) {
  entries_.push_back({std::move(key), std::move(spare)});
  keepAtMost(most_);
}

}  // namespace speculum
