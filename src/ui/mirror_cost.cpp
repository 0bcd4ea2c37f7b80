#include "ui/mirror_cost.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "ui/panels.hpp"

namespace speculum {

std::string mirrorCost(const FrameView& frame, int mirror) {
  int passes = 0;
  double ms = 0.0;
  double texels = 0.0;
  bool reused = true;
  for (const PassView& pass : frame.passes) {
    if (pass.kind == PassKind::mirror && pass.path.back() == mirror) {
      ++passes;
      ms += pass.timed && !pass.reused ? pass.gpuMs : 0.0;
      reused = reused && pass.reused;
      texels += pass.areaPx;
    }
  }
  if (passes > 0) {
    return fmt::format("{} {}, {:.0f} texels", passes, passes == 1 ? "pass" : "passes", texels) +
           (reused     ? ", reused"
            : ms > 0.0 ? ", " + panels::duration(ms) + " on the GPU"
                       : "");
  }
  const auto skipped = std::ranges::find(frame.skipped, std::vector{mirror}, &SkippedView::path);
  return skipped == frame.skipped.end() ? "No pass" : "No pass: " + skipped->reason;
}

}  // namespace speculum
