#pragma once

#include <map>
#include <memory>

#include "core/pass.hpp"
#include "core/pipeline.hpp"
#include "settings/settings.hpp"
#include "shaders/gpu_data.h"
#include "systems/pass_log.hpp"

namespace speculum {

// What the pipelines of a pass have in common.
struct PassFormat {
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkFormat color = colorFormat;
  uint32_t encoding = gpu::encodingNone;

  auto operator<=>(const PassFormat&) const = default;
  // Returns the description for such a pass.
  GraphicsPipelineDesc describe(GraphicsPipelineDesc desc) const {
    desc.samples = samples;
    desc.color = color;
    desc.constants.push_back({gpu::constantEncoding, encoding});
    return desc;
  }
};
// Returns the constant of shaders/gpu_data.h that chooses the curve.
inline uint32_t encodingOf(ToneMap toneMap) {
  return toneMap == ToneMap::aces ? gpu::encodingAces : gpu::encodingClamp;
}
// A scene that is drawn into the display image is encoded.
inline PassFormat formatOf(const PassDesc& pass, const Settings& settings) {
  const bool encodes = pass.targets.role == TargetRole::swapchain;
  return {pass.targets.samples(), pass.targets.color->format(),
          encodes ? encodingOf(settings.view.toneMap) : gpu::encodingNone};
}

// Pipelines of one system, one for each value of Variant. Each is made on its first use.
template <typename Variant>
class PipelineVariants {
 public:
  explicit PipelineVariants(PipelineFactory& factory) : factory_(factory) {}

  // Returns the pipeline of a variant. If it does not exist yet, describe() returns its description.
  template <typename Describe>
  const Pipeline& get(const Variant& variant, Describe describe) {
    Entry& entry = entries_[variant];
    entry.idleFrames = 0;
    if (!entry.pipeline) {
      entry.pipeline = std::make_unique<Pipeline>(factory_, describe());
    }
    return *entry.pipeline;
  }

  // Drops the pipelines for which idle(variant) was true in more than idleFramesKept frames since their last use.
  template <typename Idle>
  void endFrame(Idle idle) {
    for (auto& [variant, entry] : entries_) {
      entry.idleFrames += idle(variant);
    }
    std::erase_if(entries_, [](const auto& item) { return item.second.idleFrames > idleFramesKept; });
  }

  template <typename Predicate>
  void dropIf(Predicate predicate) {
    std::erase_if(entries_, [&](const auto& item) { return predicate(item.first); });
  }
  void clear() { entries_.clear(); }
  size_t size() const { return entries_.size(); }

  template <typename Visit>
  void forEach(Visit visit) const {
    for (const auto& [variant, entry] : entries_) {
      visit(variant);
    }
  }

 private:
  struct Entry {
    std::unique_ptr<Pipeline> pipeline;
    int idleFrames = 0;
  };
  PipelineFactory& factory_;
  std::map<Variant, Entry> entries_;
};

}  // namespace speculum
