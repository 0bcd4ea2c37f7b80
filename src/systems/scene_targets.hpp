#pragma once

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/off_screen.hpp"
#include "core/pass.hpp"
#include "systems/frame_data.hpp"

namespace speculum {

// Pool of targets for mirror images and environment maps, whose outputs keep all samples. A pass acquires a target,
// which is released as soon as the pass that samples it is recorded, so that a frame needs no more than the images
// alive at one time. Later frames use the targets again; those unused for framesKept frames are dropped.
class ImagePool {
 public:
  static constexpr int framesKept = 30;

  // The debug names of targets are `name` and a number.
  ImagePool(Device& device, SharedDepth& depth, std::string name)
      : device_(device), depth_(depth), name_(std::move(name)) {}

  // Returns a target that covers `extent` and is taken until release().
  OffScreen& acquire(VkExtent2D extent, RetireQueue& retired);
  void release(const OffScreen& target);
  std::unique_ptr<OffScreen> remove(const OffScreen& target);  // gives the target to the caller
  // Returns, for each of `images`, the target of the cached image that it reuses; null if it is to be rendered.
  // `targets` are those of the cached images. What no image reuses is released.
  template <typename Cached>
  static std::vector<OffScreen*> reused(std::span<const Cached> images, std::vector<OffScreen*> targets,
                                        const std::function<void(const OffScreen&)>& release) {
    std::vector<OffScreen*> reused;
    for (const Cached& image : images) {
      reused.push_back(image.cacheIndex >= 0 ? std::exchange(targets[image.cacheIndex], nullptr) : nullptr);
    }
    for (const OffScreen* unused : targets) {
      if (unused) {
        release(*unused);
      }
    }
    return reused;
  }
  void endFrame(RetireQueue& retired);
  bool empty() const { return free_.empty() && taken_.empty(); }
  uint64_t bytes() const;  // of all targets, without the shared depth

 private:
  struct Entry {
    std::unique_ptr<OffScreen> target;
    int number = 0;  // of targets made before it
    int idleFrames = 0;
  };
  using Order = std::pair<uint64_t, int>;  // area and number: the smallest target is taken first

  Device& device_;
  SharedDepth& depth_;
  std::string name_;
  std::map<Order, Entry> free_;
  std::unordered_map<const OffScreen*, Entry> taken_;
  int made_ = 0;
};

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
