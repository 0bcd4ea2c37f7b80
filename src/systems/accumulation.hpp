#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "core/renderer.hpp"
#include "plan/refined_tiles.hpp"
#include "systems/frame_buffers.hpp"
#include "systems/pass_log.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// Sum of the pictures of a mean (view.accumulate), in linear 32-bit float. Pictures are added one at a time, one in
// each frame, and in between the display pass shows the mean of those added so far. Nothing exists on the GPU before
// the first and after release().
//
// MainPicture owns it and adds the pictures that are drawn. To draw a mean, draw frames with view.accumulate above 1
// and plans made for pictures 0, 1, 2, ...; picture 0 begins a new mean. Scene, time, camera, settings and size must
// stay the same between them. A plan for a picture beyond the last shows the mean again and draws nothing.
//
// With view.accumulate_error, later pictures are drawn in the tiles that refined() has. The sum of a texel of another
// tile grows by its mean with each picture, so that all texels have the same number of pictures.
class Accumulation {
 public:
  explicit Accumulation(Renderer& renderer);

  // Adds the picture in `radiance`, which is in the layout for being sampled, as number `picture`. Throws
  // std::logic_error unless it is picture 0, or the next one and as large as the others. `refined`: the tiles that were
  // drawn; null: all.
  RecordedPass add(Frame& frame, const VkDescriptorImageInfo& radiance, VkExtent2D extent, int picture,
                   const RefinedTiles* refined);
  // Returns the tiles for which the next picture is to be drawn; null: all. `curve` displays the mean. Reads the sum
  // back after the pictures of decidesTiles() and startsHalf(); adds the time to `waitedMs`.
  std::shared_ptr<const RefinedTiles> refined(const DisplayCurve& curve, const ViewSettings& settings,
                                              double& waitedMs);
  void release(RetireQueue& retired);

  int pictures() const { return pictures_; }  // number of pictures in the sum
  Image& sum() { return images_[current_]; }  // alpha is the number of pictures
  VkDescriptorImageInfo descriptor() const { return images_[current_].descriptor(sampler_.get()); }

 private:
  void begin(VkExtent2D extent, RetireQueue& retired);

  Renderer& renderer_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  PipelineVariants<bool> pipelines_;  // holds one pipeline
  SamplerHandle sampler_;
  std::array<Image, 2> images_;  // one is read while the other is written: not every device blends 32-bit floats
  size_t current_ = 0;
  int pictures_ = 0;
  FrameBuffers tiles_;
  std::map<int, std::vector<float>> halves_;  // sums that later decisions need, by their number of pictures
  std::shared_ptr<RefinedTiles> refined_;     // null: nothing was decided
};

}  // namespace speculum
