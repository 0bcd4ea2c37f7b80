#pragma once

#include "systems/frame_data.hpp"
#include "systems/image_pool.hpp"

namespace speculum {

// The targets of environment maps: six faces in each, three to a row. Nothing exists while no frame has a map.
class EnvironmentTargets {
 public:
  explicit EnvironmentTargets(Device& device) : device_(device) {}

  void restart();  // drops the targets in the next frame

  // Takes targets for the plan's maps and frees those of other maps. Call it at the start of the plan's frame.
  void prepare(const FramePlan& plan, RetireQueue& retired);
  // Target of a map, by its index among the environment maps.
  OffScreen& operator[](size_t map) { return *targets_[map]; }
  void endFrame(RetireQueue& retired);
  uint64_t bytes() const { return pool_ ? pool_->bytes() + depth_->bytes() : 0; }

 private:
  void release(RetireQueue& retired);

  Device& device_;
  std::unique_ptr<SharedDepth> depth_;
  std::unique_ptr<ImagePool> pool_;
  std::vector<OffScreen*> targets_;  // of the environment maps of the plan that was prepared last
  bool restart_ = false;
};

}  // namespace speculum
