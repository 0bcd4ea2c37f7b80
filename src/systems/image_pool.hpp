#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/off_screen.hpp"

namespace speculum {

// Targets for mirror images and environment maps, which keep their samples. A target is taken for a pass and released
// as soon as the pass that samples it is recorded, so that a frame needs no more than the images alive at one time.
// Targets serve later frames, and are dropped after framesKept frames without use.
class ImagePool {
 public:
  static constexpr int framesKept = 30;  // without need of a target

  // Targets are called by `name` and a number.
  ImagePool(Device& device, SharedDepth& depth, std::string name);

  // A target that covers `extent`, free until release().
  OffScreen& acquire(VkExtent2D extent, RetireQueue& retired);
  void release(const OffScreen& target);
  void endFrame(RetireQueue& retired);
  void clear(RetireQueue& retired);  // drops every target; none may be taken
  bool empty() const { return entries_.empty(); }
  uint64_t bytes() const;  // of all targets, without the depth

 private:
  struct Entry {
    std::unique_ptr<OffScreen> target;
    bool taken = false;
    int idleFrames = 0;
  };

  Device& device_;
  SharedDepth& depth_;
  std::string name_;
  std::vector<Entry> entries_;
  int made_ = 0;
};

}  // namespace speculum
