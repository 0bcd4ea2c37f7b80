#pragma once

#include <array>
#include <optional>

#include "core/renderer.hpp"
#include "frame/debug_view.hpp"
#include "shaders/gpu_data.h"
#include "systems/pipeline_variants.hpp"

namespace speculum {

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
  DescriptorSetLayoutHandle layout_;
  PipelineVariants<bool> pipelines_;  // for an image with several samples, or with one
  std::array<Slot, framesInFlight> slots_;
  std::optional<TexelValue> value_;
  uint64_t valueFrame_ = 0;
};

}  // namespace speculum
