#include "systems/environment_targets.hpp"

#include <utility>

namespace speculum {

void EnvironmentTargets::restart() {
  targets_.clear();
  restart_ = true;
}

void EnvironmentTargets::release(RetireQueue& retired) {
  retired.take(pool_);
  retired.take(depth_);
}

void EnvironmentTargets::prepare(const FramePlan& plan, RetireQueue& retired) {
  const std::span<const Cube> maps = cubesOf(plan.cubes, PassKind::environment);
  targets_ = ImagePool::reused(maps, std::move(targets_), [&](const OffScreen& unused) { pool_->release(unused); });
  if (std::exchange(restart_, false)) {
    release(retired);
  }
  for (size_t i = 0; i < maps.size(); ++i) {
    if (targets_[i]) {
      continue;
    }
    if (!depth_) {
      depth_ = std::make_unique<SharedDepth>(device_, VK_SAMPLE_COUNT_1_BIT, "environment maps");
      pool_ = std::make_unique<ImagePool>(device_, *depth_, "environment map");
    }
    const auto size = static_cast<uint32_t>(maps[i].size);
    targets_[i] = &pool_->acquire({3 * size, 2 * size}, retired);
  }
}

void EnvironmentTargets::endFrame(RetireQueue& retired) {
  if (pool_) {
    pool_->endFrame(retired);
    if (pool_->empty()) {
      release(retired);
    }
  }
}

}  // namespace speculum
