#pragma once

#include <filesystem>

#include "core/renderer.hpp"

// What is used here of VK_EXT_shader_object, for headers older than 1.3.246, such as Debian 12's.
#ifndef VK_EXT_shader_object
#define VK_EXT_SHADER_OBJECT_EXTENSION_NAME "VK_EXT_shader_object"
VK_DEFINE_NON_DISPATCHABLE_HANDLE(VkShaderEXT)
inline constexpr auto VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_OBJECT_FEATURES_EXT = VkStructureType(1000482000);
inline constexpr auto VK_STRUCTURE_TYPE_SHADER_CREATE_INFO_EXT = VkStructureType(1000482002);
enum VkShaderCodeTypeEXT { VK_SHADER_CODE_TYPE_SPIRV_EXT = 1 };
inline constexpr VkFlags VK_SHADER_CREATE_LINK_STAGE_BIT_EXT = 1;
struct VkPhysicalDeviceShaderObjectFeaturesEXT {
  VkStructureType sType;
  void* pNext;
  VkBool32 shaderObject;
};
struct VkShaderCreateInfoEXT {
  VkStructureType sType;
  const void* pNext;
  VkFlags flags;
  VkShaderStageFlagBits stage;
  VkShaderStageFlags nextStage;
  VkShaderCodeTypeEXT codeType;
  size_t codeSize;
  const void* pCode;
  const char* pName;
  uint32_t setLayoutCount;
  const VkDescriptorSetLayout* pSetLayouts;
  uint32_t pushConstantRangeCount;
  const VkPushConstantRange* pPushConstantRanges;
  const VkSpecializationInfo* pSpecializationInfo;
};
using PFN_vkCreateShadersEXT = VkResult(VKAPI_PTR*)(VkDevice, uint32_t, const VkShaderCreateInfoEXT*,
                                                    const VkAllocationCallbacks*, VkShaderEXT*);
using PFN_vkDestroyShaderEXT = void(VKAPI_PTR*)(VkDevice, VkShaderEXT, const VkAllocationCallbacks*);
using PFN_vkCmdBindShadersEXT = void(VKAPI_PTR*)(VkCommandBuffer, uint32_t, const VkShaderStageFlagBits*,
                                                 const VkShaderEXT*);
#endif

namespace speculum::examples {

// A vertex and a fragment shader as shader objects: no pipeline, all state is recorded. They draw in dynamic rendering
// only. The frames that use them must have finished before they are destroyed.
class ShaderObjects {
 public:
  static void require(DeviceOptions& options);  // adds what the device must be made with

  ShaderObjects(Device& device, const std::filesystem::path& spirvDir, const GraphicsPipelineDesc& desc);
  ~ShaderObjects();
  ShaderObjects(const ShaderObjects&) = delete;
  ShaderObjects& operator=(const ShaderObjects&) = delete;

  void bind(const PassScope& pass, VkDescriptorSet set) const;
  void push(const PassScope& pass, const void* data, uint32_t bytes) const;

 private:
  static constexpr VkShaderStageFlags stages_ = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

  Device& device_;
  GraphicsPipelineDesc desc_;
  PipelineLayoutHandle layout_;
  VkShaderEXT shaders_[2] = {};  // vertex, fragment
#define FUNCTION(name) PFN_##name name = device_.function<PFN_##name>(#name)
  FUNCTION(vkDestroyShaderEXT);
  FUNCTION(vkCmdBindShadersEXT);
  FUNCTION(vkCmdSetVertexInputEXT);
  FUNCTION(vkCmdSetPolygonModeEXT);
  FUNCTION(vkCmdSetRasterizationSamplesEXT);
  FUNCTION(vkCmdSetSampleMaskEXT);
  FUNCTION(vkCmdSetAlphaToCoverageEnableEXT);
  FUNCTION(vkCmdSetDepthClampEnableEXT);
  FUNCTION(vkCmdSetColorBlendEnableEXT);
  FUNCTION(vkCmdSetColorWriteMaskEXT);
#undef FUNCTION
};

}  // namespace speculum::examples
