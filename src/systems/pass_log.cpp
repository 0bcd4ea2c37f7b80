#include "systems/pass_log.hpp"

#include <utility>

namespace speculum {

void PassLog::add(RecordedPass pass) {
  frame_.push_back(pass);
  picture_.push_back(std::move(pass));
}

void PassLog::joinLast() {
  picture_.pop_back();
  frame_.back().draws = 0;
}

std::span<const RecordedPass> PassLog::passesOf(uint64_t number) const {
  const auto& [recorded, passes] = frames_[number % frames_.size()];
  return recorded == number ? std::span(passes) : std::span<const RecordedPass>();
}

}  // namespace speculum
