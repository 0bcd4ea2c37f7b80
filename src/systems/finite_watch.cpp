#include "systems/finite_watch.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>

namespace speculum {

namespace {

// Distance in bytes between results in the buffer: no device requires a larger alignment of descriptor offsets.
constexpr VkDeviceSize resultStride = 256;
constexpr VkDeviceSize targetResultBytes = 2 * resultStride;
constexpr uint32_t groupWidth = 16;
constexpr uint32_t groupHeight = 8;

VkDescriptorBufferInfo searchOf(const Buffer& buffer, size_t target) {
  return {buffer.get(), target * targetResultBytes, sizeof(gpu::CheckSearch)};
}

VkDescriptorBufferInfo foundOf(const Buffer& buffer, size_t target) {
  return {buffer.get(), target * targetResultBytes + resultStride, sizeof(gpu::CheckFound)};
}

template <typename T>
T readAt(const Buffer& buffer, const VkDescriptorBufferInfo& info) {
  T data{};
  std::memcpy(&data, buffer.mapped() + info.offset, sizeof data);
  return data;
}

}  // namespace

std::string describe(const NonFinite& found) {
  return fmt::format(
      "{}: pixel {}, {}, sample {}: radiance {}, {}, {} and disparity {} (in 16/m) are not all finite and within 0 .. "
      "65504 ({} such samples in this pass)",
      found.pass, found.x, found.y, found.sample, found.value.r, found.value.g, found.value.b, found.value.a,
      found.count);
}

void FiniteWatch::begin(const Frame& frame, size_t targets) {
  collect();
  if (!layout_) {
    constexpr VkDescriptorType storage = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    layout_ = descriptorSetLayout(device_, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, storage, storage},
                                  VK_SHADER_STAGE_COMPUTE_BIT, "check finite");
  }
  Slot& slot = slots_[frame.index];
  if (slot.results.bytes() < targets * targetResultBytes) {
    slot.results = Buffer(device_, targets * targetResultBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, BufferMemory::host,
                          "check finite " + std::to_string(frame.index));
  }
  const gpu::CheckSearch nothing{.pixel = ~0u};
  for (size_t i = 0; i < targets; ++i) {
    slot.results.write(std::as_bytes(std::span(&nothing, 1)), searchOf(slot.results, i).offset);
  }
  slot.targets.clear();
  slot.frame = frame.number;
}

const Pipeline& FiniteWatch::pipeline(const Variant& variant) {
  return pipelines_.get(variant, [&] {
    return ComputePipelineDesc{.name = variant.looksUp ? "look up what is not finite" : "check finite",
                               .comp = std::string(variant.looksUp ? "check_finite_look_up" : "check_finite") +
                                       (variant.multisampled ? "_samples.comp" : ".comp"),
                               .setLayouts = {layout_},
                               .pushConstantBytes = sizeof(gpu::CheckConstants)};
  });
}

void FiniteWatch::check(Frame& frame, const RecordedPass& pass, bool samples, Image& image,
                        const VkDescriptorImageInfo& descriptor, VkExtent2D used) {
  Slot& slot = slots_[frame.index];
  const VkDescriptorBufferInfo search = searchOf(slot.results, slot.targets.size());
  const VkDescriptorBufferInfo found = foundOf(slot.results, slot.targets.size());
  slot.targets.push_back({pass, samples, pass.name + (samples ? " (samples)" : ""), used});
  const VkDescriptorSet set = frame.descriptors->allocate(layout_);
  DescriptorWriter()
      .image(0, descriptor)
      .buffer(1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, search)
      .buffer(2, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, found)
      .update(device_, set);
  const bool multisampled = image.samples() != VK_SAMPLE_COUNT_1_BIT;
  const auto dispatch = [&](bool looksUp, uint32_t x, uint32_t y) {
    pipeline({multisampled, looksUp}).bind(frame.commands, set, gpu::CheckConstants{{used.width, used.height}});
    vkCmdDispatch(frame.commands, x, y, 1);
  };
  device_.beginLabel(frame.commands, "check " + pass.name);
  device_.barriers().record(frame.commands, BarrierKind::targetToCheck, image);
  dispatch(false, groupCount(used.width, groupWidth), groupCount(used.height, groupHeight));
  device_.barriers().record(frame.commands, BarrierKind::checkToLookUp, search);
  dispatch(true, 1, 1);
  device_.barriers().record(frame.commands, BarrierKind::checkToWrite, image);
  device_.endLabel(frame.commands);
}

void FiniteWatch::check(Frame& frame, const RecordedPass& pass, OffScreen& target, VkExtent2D used) {
  if (slots_[frame.index].frame != frame.number) {
    return;
  }
  if (Image* samples = target.samplesImage()) {
    check(frame, pass, true, *samples, target.samplesDescriptor(), used);
  }
  check(frame, pass, false, target.color(), target.descriptor(), used);
}

void FiniteWatch::release() {
  collect();
  if (std::ranges::any_of(slots_, [](const Slot& slot) { return slot.frame != 0; })) {
    return;
  }
  pipelines_.clear();
  slots_ = {};
}

void FiniteWatch::collect() {
  // Reads the older frame first.
  const bool firstIsOlder = slots_[0].frame < slots_[1].frame;
  read(slots_[firstIsOlder ? 0 : 1]);
  read(slots_[firstIsOlder ? 1 : 0]);
}

void FiniteWatch::read(Slot& slot) {
  if (slot.frame == 0 || slot.frame > renderer_.timings().frame) {
    return;
  }
  std::vector<NonFinite> found;
  for (size_t i = 0; i < slot.targets.size(); ++i) {
    const auto search = readAt<gpu::CheckSearch>(slot.results, searchOf(slot.results, i));
    if (search.any != 0) {
      const auto value = readAt<gpu::CheckFound>(slot.results, foundOf(slot.results, i));
      const Target& target = slot.targets[i];
      found.push_back({.id = target.id,
                       .samples = target.samples,
                       .pass = target.name,
                       .x = static_cast<int>(search.pixel % target.used.width),
                       .y = static_cast<int>(search.pixel / target.used.width),
                       .sample = static_cast<int>(value.sampleIndex),
                       .value = value.value,
                       .count = search.count});
      count_ += search.count;
    }
  }
  if (!found.empty()) {
    // Reports only the first finding of a frame, which usually causes those that follow.
    const std::pair<PassId, bool> first(found.front().id, found.front().samples);
    if (std::ranges::find(reported_, first) == reported_.end()) {
      reported_.push_back(first);
      spdlog::error("debug.check_finite: {}", describe(found.front()));
    }
    findings_ = std::move(found);
    findingsFrame_ = slot.frame;
  }
  slot.frame = 0;
}

}  // namespace speculum
