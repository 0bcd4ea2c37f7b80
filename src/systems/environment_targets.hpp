#pragma once

#include "systems/frame_data.hpp"
#include "systems/image_pool.hpp"

namespace speculum {

// The targets of environment maps: six faces in each, three to a row. Nothing exists while no frame has a map.
class EnvironmentTargets {
 public:
  explicit EnvironmentTargets(Device& device) : device_(device) {}

  // Maps that the next plan may reuse.
  std::span<const EnvironmentMap> cached() const { return cached_; }
  void restart();  // drops the cached maps

  // Takes targets for the plan's maps and frees those of other maps. Call it at the start of the plan's frame.
  void prepare(const FramePlan& plan, RetireQueue& retired);
  OffScreen& operator[](size_t map) { return *targets_[map]; }
  void endFrame(const FramePlan& plan, RetireQueue& retired);
  uint64_t bytes() const { return pool_ ? pool_->bytes() + depth_->bytes() : 0; }

 private:
  void release(RetireQueue& retired);

  Device& device_;
  std::unique_ptr<SharedDepth> depth_;
  std::unique_ptr<ImagePool> pool_;
  std::vector<OffScreen*> targets_;  // parallel to cached_ between frames, to the plan's maps within one
  RecycledVector<EnvironmentMap> cached_;
  bool restart_ = false;
};

}  // namespace speculum
