#pragma once

#include <map>
#include <optional>

#include "plan/target_memory.hpp"
#include "systems/frame_data.hpp"
#include "systems/scene_targets.hpp"

namespace speculum {

// Owns the targets of mirror passes: those of this frame while their images are needed, and those of cached images
// until the next frame. Nothing exists while no frame has a mirror image.
class MirrorTargets {
 public:
  explicit MirrorTargets(Device& device) : device_(device) {}

  // Images that the next plan may reuse.
  const RecycledVector<CachedImage>& cachedImages() const { return cachedImages_; }
  void restart();  // drops the cached images and, in the next frame, every target

  // Begins the plan's picture and takes over the cached images that it reuses. `watched` is the pass whose image a
  // TargetDisplay shows: the image is kept until the next picture is complete, or as long as this picture is shown
  // again.
  void begin(const FramePlan& plan, std::optional<int> watched, RetireQueue& retired);
  // Returns targets for the passes of a range, in order, each with a depth image that no other pass of the range has.
  // The images that the range looks up stay untouched.
  std::vector<PassTargets> acquire(const FramePlan& plan, const ConcurrentPasses& range, RetireQueue& retired);
  // Releases the images that a recorded pass looked up.
  void releaseShown(const FramePlan& plan, const Pass& pass);
  // Ends a complete picture: keeps the images that the next plan may reuse, and drops targets that have long been idle.
  void end(const FramePlan& plan, RetireQueue& retired);

  // Target of a mirror pass that is drawn, by index into plan.passes.
  OffScreen& operator[](size_t pass) { return *targets_[pass]; }
  // Image of the watched pass in the last complete picture. It exists while tiles of the next one are drawn, or while
  // that picture is shown again; else null.
  OffScreen* earlierWatched() { return earlierWatched_.get(); }
  std::span<const MirrorImage> images() const { return images_; }  // of plan.passes, by index; set once acquired
  // Parallel to FramePlan::cached; set where an earlier frame rendered the image.
  std::span<const MirrorImage> cached() const { return cachedDescriptors_; }

 private:
  // A depth image that passes use in turn. In each range, the largest pass with the image's sample count uses the first
  // one, the next largest the second, and so on.
  struct Depth {
    std::unique_ptr<SharedDepth> image;
    int idleFrames = 0;
    VkExtent2D needed{0, 0};  // largest extent since the image was last fitted
    int frames = 0;           // frames since the image was last fitted
  };
  // Targets of one sample count.
  struct Pool {
    std::vector<Depth> depths;  // the first one exists as long as `images`
    std::unique_ptr<ImagePool> images;
  };
  VkSampleCountFlagBits samplesOf(const Pass& pass) { return device_.sampleCount(pass.quality.samples); }
  ImagePool& poolOf(const OffScreen& target) { return *pools_.at(target.samples()).images; }
  void takeCached(const FramePlan& plan);
  void takeWatched(const FramePlan& plan, RetireQueue& retired);
  bool isNeededLater(const FramePlan& plan, int pass) const;
  SharedDepth& depth(VkSampleCountFlagBits samples, size_t place, VkExtent2D needed);
  static void fitDepth(std::vector<Depth>& depths, RetireQueue& retired);
  static void dropDepth(std::vector<Depth>& depths, size_t from, RetireQueue& retired);

  Device& device_;
  std::map<VkSampleCountFlagBits, Pool> pools_;
  std::vector<OffScreen*> targets_;
  std::vector<MirrorImage> images_;
  RecycledVector<CachedImage> cachedImages_;
  std::vector<OffScreen*> cachedTargets_;  // parallel to cachedImages_ between frames, to FramePlan::cached within one
  std::vector<MirrorImage> cachedDescriptors_;
  std::optional<int> watched_;
  OffScreen* watchedImage_ = nullptr;  // of the last picture, in the pool
  std::unique_ptr<OffScreen> earlierWatched_;
  bool restart_ = false;
};

}  // namespace speculum
