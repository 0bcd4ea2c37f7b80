#pragma once

#include <array>
#include <optional>

#include "core/pass.hpp"
#include "core/renderer.hpp"
#include "core/retire_queue.hpp"
#include "plan/frame_plan.hpp"
#include "shaders/gpu_data.h"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// The watched target, which a TargetDisplay asks for: in the picture that is drawn, and in the last complete one. Owns
// its depth, if that is shown: passes share depth images, so the watched pass gets an image of its own, and a second
// one while several frames draw the pass, because the first is shown until they end. Nothing exists on the GPU while no
// depth is shown.
class WatchedTarget {
 public:
  struct Target {
    int pass = 0;     // as TargetDisplay::pass
    MirrorPath path;  // of the pass's view
    TargetKind kind = TargetKind::color;
    glm::ivec2 size{0};  // texels
    double near = 0.0;   // metres from the eye to the near plane
  };

  explicit WatchedTarget(Device& device) : device_(device) {}

  // Begins a frame of the plan. A target is watched from the beginning of a picture on. A picture that is shown again
  // keeps the target that was watched in it, unless the target that is asked for isAlwaysThere().
  void begin(const FramePlan& plan, const std::optional<TargetDisplay>& debug, RetireQueue& retired);
  bool watches() const { return watched_.has_value(); }
  // Index in FramePlan::passes of the mirror pass whose image is watched; none for the main view.
  std::optional<int> mirrorPass() const;
  // Call it before each part of pass `index`: if the depth of the pass is watched, makes the pass write it to an image
  // of this object.
  void prepare(const FramePlan& plan, size_t index, PassDesc& pass, RetireQueue& retired);
  // Ends a picture, whose target can now be shown.
  void finish(const FramePlan& plan, VkCommandBuffer commands, RetireQueue& retired);

  // Returns the target of the last complete picture if `debug` shows it; else null.
  const Target* shown(const FramePlan& plan, const TargetDisplay& debug) const;
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

// Reads a texel of a target back from the GPU. Nothing exists on the GPU before probe() and after release().
class TexelProbe {
 public:
  explicit TexelProbe(Renderer& renderer)
      : renderer_(renderer), device_(renderer.device()), pipelines_(renderer.pipelines()) {}

  // Reads a texel of a color target or a depth that can be sampled; `descriptor` is the image's. Its layout stays.
  void probe(Frame& frame, Image& image, const VkDescriptorImageInfo& descriptor, const glm::ivec2& texel);
  // Releases the GPU's objects as soon as the frames that were probed have finished, and drops the value.
  void release();
  // Value in the last probed frame that has finished, if there is one.
  const std::optional<TexelValue>& value();

 private:
  struct Slot {
    Buffer result;
    TexelValue pending;  // texel and kind; the value follows
    uint64_t frame = 0;  // number of the frame that probes; 0: none
  };
  void collect();

  Renderer& renderer_;
  Device& device_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  PipelineVariants<bool> pipelines_;  // for an image with several samples, or with one
  std::array<Slot, framesInFlight> slots_;
  std::optional<TexelValue> value_;
  uint64_t valueFrame_ = 0;
};

}  // namespace speculum
