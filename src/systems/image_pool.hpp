#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/off_screen.hpp"

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
  bool empty() const { return entries_.empty(); }
  uint64_t bytes() const;  // of all targets, without the shared depth

 private:
  struct Entry {
    std::unique_ptr<OffScreen> target;
    bool taken = false;
    int idleFrames = 0;
  };

  std::vector<Entry>::iterator entryOf(const OffScreen& target);

  Device& device_;
  SharedDepth& depth_;
  std::string name_;
  std::vector<Entry> entries_;
  int made_ = 0;
};

}  // namespace speculum
