#pragma once

#include <memory>
#include <string>

#include "core/off_screen.hpp"
#include "core/pass.hpp"
#include "systems/frame_info.hpp"
#include "systems/image_pool.hpp"

namespace speculum {

// The targets of environment maps: six faces in each, three to a row. Nothing exists while no frame has a map.
class EnvironmentTargets {
 public:
  explicit EnvironmentTargets(Device& device) : device_(device) {}

  void restart();  // drops the targets in the next frame

  // Takes targets for the plan's maps and frees those of other maps. Call it at the start of the plan's picture.
  void prepare(const FramePlan& plan, RetireQueue& retired);
  // Makes descriptors of the maps, and returns them as FrameInfo::maps.
  std::span<const VkDescriptorSet> bind(const Frame& frame, const FramePlan& plan, VkDescriptorSetLayout layout);
  // Target of the map that the pass is a face of.
  OffScreen& of(const FramePlan& plan, const Pass& face) { return *targets_[face.cube - shadowMaps(plan)]; }
  void endFrame(RetireQueue& retired);
  uint64_t bytes() const { return pool_ ? pool_->bytes() + depth_->bytes() : 0; }

 private:
  static size_t shadowMaps(const FramePlan& plan) { return cubesOf(plan.cubes, PassKind::shadow).size(); }
  void release(RetireQueue& retired);

  Device& device_;
  std::unique_ptr<SharedDepth> depth_;
  std::unique_ptr<ImagePool> pool_;
  std::vector<OffScreen*> targets_;    // of the environment maps of the plan that was prepared last
  std::vector<VkDescriptorSet> sets_;  // of the frame
  bool restart_ = false;
};

// Returns the viewport that places the picture so that the target's corner shows the corner of the view's rectangle.
Viewport viewportOf(const View& view);
// Returns the color that scenePass() clears with: the background, as a target stores it in picture `picture` of a mean.
glm::vec3 storedBackground(const Environment& environment, const View& view, int picture);
// Describes a pass of the plan that draws the scene into `area` of its targets.
PassDesc scenePass(const FrameInfo& info, const Pass& pass, const PassTargets& targets, const VkRect2D& area,
                   const Viewport& viewport);

}  // namespace speculum
