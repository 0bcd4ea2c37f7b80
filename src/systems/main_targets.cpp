#include "systems/main_targets.hpp"

#include <utility>

namespace speculum {

void MainTargets::begin(const Settings& settings, const FramePlan& plan, bool displayed, RetireQueue& retired) {
  if (!plan.tiles) {
    finish(retired);
  } else if (displayed && !earlier_) {
    earlier_ = std::move(drawn_);
  }
  const VkExtent2D extent = extentOf(plan.main().view.rect.width, plan.main().view.rect.height);
  const VkSampleCountFlagBits samples = device_.sampleCount(settings.view.samples);
  const bool readSamples = (settings.debug.checkFinite || plan.effects.any()) && samples != VK_SAMPLE_COUNT_1_BIT;
  if (!drawn_ || drawn_->samples() != samples || drawn_->desc().readSamples != readSamples) {
    const OffScreenDesc desc{.name = "main view",
                             .extent = extent,
                             .samples = samples,
                             .readSamples = readSamples,
                             .role = TargetRole::main};
    std::unique_ptr<OffScreen> before = std::exchange(drawn_, std::make_unique<OffScreen>(device_, desc, retired));
    retired.take(before);
  }
  drawn_->resize(extent, retired);
}

}  // namespace speculum
