#include "systems/pass_log.hpp"

namespace speculum {

void PictureSums::add(std::span<const RecordedPass> passes, const FrameTimings& timings) {
  if (!passes.empty() && passes[0].kind == PassKind::display) {
    place_ = passes_.size();  // a frame that shows a mean again displays it and draws nothing
  }
  PassIndex<TimedPass> index(passes_);
  for (size_t i = 0; i < passes.size(); ++i) {
    TimedPass pass{passes[i], {}};
    pass.draws = 0;
    const size_t place = index.findOrInsert(pass, place_);
    TimedPass& sum = passes_[place];
    sum.draws += passes[i].draws;
    if (i < timings.passes.size()) {
      sum.timing += timings.passes[i];
    }
    place_ = place + 1;
  }
}

}  // namespace speculum
