#include "systems/pass_log.hpp"

#include <algorithm>

namespace speculum {

void PictureSums::add(std::span<const RecordedPass> passes, const FrameTimings& timings) {
  for (size_t i = 0; i < passes.size(); ++i) {
    const PassId& id = passes[i];
    auto sum = std::ranges::find_if(passes_, [&](const PassId& pass) { return pass == id; });
    if (sum == passes_.end()) {
      sum = passes_.insert(passes_.begin() + static_cast<std::ptrdiff_t>(place_), TimedPass{passes[i], {}});
    } else {
      sum->draws += passes[i].draws;
    }
    if (i < timings.passes.size()) {
      sum->timing += timings.passes[i];
    }
    place_ = static_cast<size_t>(sum - passes_.begin()) + 1;
  }
}

}  // namespace speculum
