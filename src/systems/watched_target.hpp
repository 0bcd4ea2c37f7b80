#pragma once

#include <optional>

#include "core/pass.hpp"
#include "core/retire_queue.hpp"
#include "frame/debug_view.hpp"
#include "frame/frame_plan.hpp"

namespace speculum {

// The target that a debug view shows, in the picture that is drawn and in the last complete one, and its depth. Passes
// share depth images, so the pass that is watched gets one of its own, and a second one while several frames draw it:
// the first is shown until they end. Nothing exists on the GPU while no depth is shown.
class WatchedTarget {
 public:
  struct Target {
    int pass = 0;     // as DebugView::pass
    MirrorPath path;  // of the pass's view
    TargetKind kind = TargetKind::color;
    glm::ivec2 size{0};  // texels
    double near = 0.0;   // metres from the eye to the near plane
  };

  explicit WatchedTarget(Device& device) : device_(device) {}

  // Begins a frame of the plan. A target is watched from the beginning of a picture on. A picture that is shown again
  // keeps the target that was watched in it, unless the target that is asked for isAlwaysThere().
  void begin(const FramePlan& plan, const std::optional<DebugView>& debug, RetireQueue& retired);
  // Index in FramePlan::passes of the mirror pass whose image is watched; none for the main view.
  std::optional<int> mirrorPass() const;
  // Call it before each part of pass `index`: makes the pass write its depth here if that is watched.
  void prepare(const FramePlan& plan, size_t index, PassDesc& pass, RetireQueue& retired);
  // Ends a picture, whose target can now be shown.
  void finish(const FramePlan& plan, VkCommandBuffer commands, RetireQueue& retired);

  // Returns the target of the last complete picture if `debug` shows it; else null.
  const Target* shown(const FramePlan& plan, const DebugView& debug) const;
  // Says whether shown() has that target.
  bool keeps(const MirrorPath& path, TargetKind kind) const;
  bool hasDepth() const { return static_cast<bool>(depth_); }
  // Depth of the last complete picture; hasDepth() is required.
  Image& depth() { return depth_; }
  VkDescriptorImageInfo depthDescriptor() const { return depth_.descriptor(sampler_.get()); }

 private:
  void releaseDepth(RetireQueue& retired);

  Device& device_;
  std::optional<Target> watched_;
  std::optional<Target> shown_;
  Image depth_;
  Image nextDepth_;  // unfinished
  SamplerHandle sampler_;
};

}  // namespace speculum
