#pragma once

#include <deque>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/device.hpp"

namespace speculum {

struct DescriptorBinding {
  uint32_t binding = 0;
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
  uint32_t count = 1;
  VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
};

// Returns the device's layout with these bindings, which lasts as long as the device. Whoever asks first names it.
VkDescriptorSetLayout descriptorSetLayout(Device& device, std::span<const DescriptorBinding> bindings,
                                          const std::string& name);
// Does the same for bindings 0, 1, ... of these types.
VkDescriptorSetLayout descriptorSetLayout(Device& device, std::initializer_list<VkDescriptorType> types,
                                          VkShaderStageFlags stages, const std::string& name);

// Hands out sets and grows by whole pools of 64 sets with 1024 image descriptors; a set must fit into one pool. Sets
// live until reset() or the allocator's end; they are not freed singly.
class DescriptorAllocator {
 public:
  explicit DescriptorAllocator(Device& device) : device_(&device) {}

  VkDescriptorSet allocate(VkDescriptorSetLayout layout);
  void reset();

 private:
  DescriptorPoolHandle createPool() const;

  Device* device_;
  std::vector<DescriptorPoolHandle> pools_;
  size_t current_ = 0;
  size_t setsInCurrent_ = 0;
};

// Collects writes to a descriptor set. update() applies them all at once.
class DescriptorWriter {
 public:
  DescriptorWriter& buffer(uint32_t binding, VkDescriptorType type, const VkDescriptorBufferInfo& info);
  DescriptorWriter& texels(uint32_t binding, VkBufferView view);
  DescriptorWriter& image(uint32_t binding, const VkDescriptorImageInfo& info);  // combined with its sampler
  DescriptorWriter& structure(uint32_t binding, VkAccelerationStructureKHR structure);
  void update(Device& device, VkDescriptorSet set);

 private:
  VkWriteDescriptorSet& add(uint32_t binding, VkDescriptorType type);

  std::deque<VkDescriptorBufferInfo> buffers_;
  std::deque<VkBufferView> texels_;
  std::deque<VkDescriptorImageInfo> images_;
  std::deque<std::pair<VkWriteDescriptorSetAccelerationStructureKHR, VkAccelerationStructureKHR>> structures_;
  std::vector<VkWriteDescriptorSet> writes_;
};

}  // namespace speculum
