#include "core/descriptors.hpp"

#include <array>

namespace speculum {

VkDescriptorSetLayout descriptorSetLayout(Device& device, std::span<const DescriptorBinding> bindings,
                                          const std::string& name) {
  std::vector<VkDescriptorSetLayoutBinding> layoutBindings;
  std::vector<std::array<uint32_t, 4>> key;
  for (const DescriptorBinding& binding : bindings) {
    layoutBindings.push_back({.binding = binding.binding,
                              .descriptorType = binding.type,
                              .descriptorCount = binding.count,
                              .stageFlags = binding.stages});
    key.push_back({binding.binding, static_cast<uint32_t>(binding.type), binding.count, binding.stages});
  }
  DescriptorSetLayoutHandle& layout = device.setLayouts()[key];
  if (!layout) {
    layout = device.create(vkCreateDescriptorSetLayout,
                           {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                            .bindingCount = static_cast<uint32_t>(layoutBindings.size()),
                            .pBindings = layoutBindings.data()},
                           name);
  }
  return layout.get();
}

VkDescriptorSetLayout descriptorSetLayout(Device& device, std::initializer_list<VkDescriptorType> types,
                                          VkShaderStageFlags stages, const std::string& name) {
  std::vector<DescriptorBinding> bindings;
  for (const VkDescriptorType type : types) {
    bindings.push_back({.binding = static_cast<uint32_t>(bindings.size()), .type = type, .stages = stages});
  }
  return descriptorSetLayout(device, bindings, name);
}

DescriptorPoolHandle DescriptorAllocator::createPool() const {
  constexpr uint32_t sets = 64;
  std::vector<VkDescriptorPoolSize> sizes{
      {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 2 * sets},       {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, sets},
      {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 4 * sets},       {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER_DYNAMIC, sets},
      {VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, 2 * sets}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 16 * sets},
  };
  if (device_->caps().rayQueries) {
    sizes.push_back({VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, sets});
  }
  return device_->create(vkCreateDescriptorPool,
                         {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                          .maxSets = sets,
                          .poolSizeCount = static_cast<uint32_t>(sizes.size()),
                          .pPoolSizes = sizes.data()},
                         "descriptor sets");
}

VkDescriptorSet DescriptorAllocator::allocate(VkDescriptorSetLayout layout) {
  for (;;) {
    const bool fresh = current_ == pools_.size();
    if (fresh) {
      pools_.push_back(createPool());
    }
    const VkDescriptorSetAllocateInfo info{.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                           .descriptorPool = pools_[current_].get(),
                                           .descriptorSetCount = 1,
                                           .pSetLayouts = &layout};
    VkDescriptorSet set = VK_NULL_HANDLE;
    const VkResult result = vkAllocateDescriptorSets(device_->get(), &info, &set);
    if (result == VK_SUCCESS) {
      ++setsInCurrent_;
      return set;
    }
    // Gives up if the set does not fit into an empty pool: it would fit into no other.
    if (setsInCurrent_ == 0 || (result != VK_ERROR_OUT_OF_POOL_MEMORY && result != VK_ERROR_FRAGMENTED_POOL)) {
      throwVulkanError(result, "allocate a descriptor set");
    }
    ++current_;
    setsInCurrent_ = 0;
  }
}

void DescriptorAllocator::reset() {
  for (const DescriptorPoolHandle& pool : pools_) {
    check(vkResetDescriptorPool(device_->get(), pool.get(), 0), "reset a descriptor pool");
  }
  current_ = 0;
  setsInCurrent_ = 0;
}

VkWriteDescriptorSet& DescriptorWriter::add(uint32_t binding, VkDescriptorType type) {
  return writes_.emplace_back(VkWriteDescriptorSet{.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                                                   .dstBinding = binding,
                                                   .descriptorCount = 1,
                                                   .descriptorType = type});
}

DescriptorWriter& DescriptorWriter::buffer(uint32_t binding, VkDescriptorType type,
                                           const VkDescriptorBufferInfo& info) {
  add(binding, type).pBufferInfo = &buffers_.emplace_back(info);
  return *this;
}

DescriptorWriter& DescriptorWriter::texels(uint32_t binding, VkBufferView view) {
  add(binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER).pTexelBufferView = &texels_.emplace_back(view);
  return *this;
}

DescriptorWriter& DescriptorWriter::image(uint32_t binding, const VkDescriptorImageInfo& info) {
  add(binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER).pImageInfo = &images_.emplace_back(info);
  return *this;
}

DescriptorWriter& DescriptorWriter::structure(uint32_t binding, VkAccelerationStructureKHR structure) {
  auto& [info, handle] = structures_.emplace_back(
      VkWriteDescriptorSetAccelerationStructureKHR{
          .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR, .accelerationStructureCount = 1},
      structure);
  info.pAccelerationStructures = &handle;
  add(binding, VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR).pNext = &info;
  return *this;
}

void DescriptorWriter::update(Device& device, VkDescriptorSet set) {
  for (VkWriteDescriptorSet& write : writes_) {
    write.dstSet = set;
  }
  vkUpdateDescriptorSets(device.get(), static_cast<uint32_t>(writes_.size()), writes_.data(), 0, nullptr);
}

}  // namespace speculum
