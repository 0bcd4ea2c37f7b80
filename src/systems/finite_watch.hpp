#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/off_screen.hpp"
#include "core/renderer.hpp"
#include "shaders/gpu_data.h"
#include "systems/pass_log.hpp"
#include "systems/pipeline_variants.hpp"

namespace speculum {

// A finding in a target of a pass: a value that is NaN, infinite, below 0 or above 65504, the largest half float.
struct NonFinite {
  PassId id;
  bool samples = false;  // found in the samples, not in the resolved image
  std::string pass;      // name for the user
  int x = 0;             // pixel of the pass's target, from its top left; the first one row by row
  int y = 0;
  int sample = 0;
  glm::vec4 value{0.0f};  // radiance, and disparity as stored: gpu::disparityLength / w
  uint64_t count = 0;     // number of samples with such values in the target
};
std::string describe(const NonFinite& found);  // one line

// Searches targets of radiance for NonFinite values on the GPU, as soon as their passes have drawn them:
// debug.check_finite. Nothing exists on the GPU before begin() and after release().
class FiniteWatch {
 public:
  explicit FiniteWatch(Renderer& renderer)
      : renderer_(renderer), device_(renderer.device()), pipelines_(renderer.pipelines()) {}

  // Begins a frame in which up to `targets` images are checked.
  void begin(const Frame& frame, size_t targets);
  // Checks the upper left part, `used` pixels, of the image that an ended pass drew; `descriptor` is the image's. The
  // image is then in the layout for being sampled. `samples` says that the image is multisampled, not resolved.
  void check(Frame& frame, const RecordedPass& pass, bool samples, Image& image,
             const VkDescriptorImageInfo& descriptor, VkExtent2D used);
  // Checks the samples that a target resolves, if there are any, and then its output. The mean of samples alone hides
  // negative values in one of them. Does nothing in a frame without begin().
  void check(Frame& frame, const RecordedPass& pass, OffScreen& target, VkExtent2D used);
  // Makes the frame's results visible to the CPU, once the frame has finished.
  void end(Frame& frame) { Barriers::computeToHost(frame.commands); }
  // Releases the GPU's objects as soon as the frames that were watched have finished.
  void release();

  // Reads the results of the frames that have finished. Logs a frame's first finding, once for each pass, as an error.
  void collect();
  // Findings of the last finished frame that had any: one for each target, in the order of recording.
  const std::vector<NonFinite>& findings() const { return findings_; }
  uint64_t findingsFrame() const { return findingsFrame_; }  // number of that frame; 0: nothing was ever found
  uint64_t count() const { return count_; }                  // samples found since the start

 private:
  struct Target {
    PassId id;
    bool samples = false;
    std::string name;
    VkExtent2D used{0, 0};
  };
  struct Slot {
    Buffer results;
    std::vector<Target> targets;
    uint64_t frame = 0;  // number of the frame that is watched; 0: none
  };
  struct Variant {
    bool multisampled;
    bool looksUp;  // reads the value that the search has found
    auto operator<=>(const Variant&) const = default;
  };
  const Pipeline& pipeline(const Variant& variant);
  void read(Slot& slot);

  Renderer& renderer_;
  Device& device_;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  PipelineVariants<Variant> pipelines_;
  std::array<Slot, framesInFlight> slots_;
  std::vector<NonFinite> findings_;
  uint64_t findingsFrame_ = 0;
  uint64_t count_ = 0;
  std::vector<std::pair<PassId, bool>> reported_;  // logged passes, and whether by their samples' finding
};

}  // namespace speculum
