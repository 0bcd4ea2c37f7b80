#pragma once

#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#include "plan/frame_plan.hpp"

namespace speculum {

// Finds passes by their id, so that lists of thousands can be joined. T derives from PassId.
template <typename T>
class PassIndex {
 public:
  // `passes` must outlive the index, and nothing else may insert into it. No two of them have the same id.
  explicit PassIndex(std::vector<T>& passes) : passes_(passes) { number(0); }

  // Returns the place of the pass with the id of `pass`. If there is none, inserts `pass` at `place`.
  size_t findOrInsert(const T& pass, size_t place) {
    const auto [found, isNew] = places_.try_emplace(pass, place);
    if (isNew) {
      passes_.insert(passes_.begin() + static_cast<std::ptrdiff_t>(place), pass);
      number(place + 1);
    }
    return found->second;
  }

 private:
  struct Less {
    bool operator()(const PassId& a, const PassId& b) const { return key(a) < key(b); }
    static auto key(const PassId& id) { return std::tie(id.kind, id.path, id.instance, id.light, id.face); }
  };

  void number(size_t first) {
    for (size_t i = first; i < passes_.size(); ++i) {
      places_[passes_[i]] = i;
    }
  }

  std::vector<T>& passes_;
  std::map<PassId, size_t, Less> places_;
};

}  // namespace speculum
