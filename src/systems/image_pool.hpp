#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/off_screen.hpp"

namespace speculum {

inline uint64_t area(VkExtent2D extent) {  // texels
  return uint64_t{extent.width} * extent.height;
}

// Pool of targets for mirror images and environment maps, which keep their samples. A pass acquires a target, which is
// released as soon as the pass that samples it is recorded, so that a frame needs no more than the images alive at one
// time. Later frames use the targets again; those unused for framesKept frames are dropped.
class ImagePool {
 public:
  static constexpr int framesKept = 30;

  // The debug names of targets are `name` and a number.
  ImagePool(Device& device, SharedDepth& depth, std::string name);

  // Returns a target that covers `extent` and is taken until release().
  OffScreen& acquire(VkExtent2D extent, RetireQueue& retired);
  void release(const OffScreen& target);
  std::unique_ptr<OffScreen> remove(const OffScreen& target);  // gives it away
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
