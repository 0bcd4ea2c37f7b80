#pragma once

#include <filesystem>

#include "core/renderer.hpp"
#include "shader_object_api.hpp"

namespace speculum::examples {

// A vertex and a fragment shader as shader objects (VK_EXT_shader_object): no pipeline, all state is recorded. They
// draw in dynamic rendering only. The frames that use them must have finished before they are destroyed.
class ShaderObjects {
 public:
  // Adds what the device must be made with. Call it before there is a device.
  static void require(DeviceOptions& options);

  ShaderObjects(Device& device, const std::filesystem::path& spirvDir, const GraphicsPipelineDesc& desc);
  ~ShaderObjects();
  ShaderObjects(const ShaderObjects&) = delete;
  ShaderObjects& operator=(const ShaderObjects&) = delete;

  void bind(const PassScope& pass, VkDescriptorSet set) const;
  void push(const PassScope& pass, const void* data, uint32_t bytes) const;

 private:
  void loadFunctions();
  void setState(const PassScope& pass) const;

  Device& device_;
  GraphicsPipelineDesc desc_;
  PipelineLayoutHandle layout_;
  VkShaderEXT shaders_[2] = {};  // vertex, fragment
  PFN_vkDestroyShaderEXT destroy_ = nullptr;
  PFN_vkCmdBindShadersEXT bindShaders_ = nullptr;
  PFN_vkCmdSetVertexInputEXT setVertexInput_ = nullptr;
  PFN_vkCmdSetPolygonModeEXT setPolygonMode_ = nullptr;
  PFN_vkCmdSetRasterizationSamplesEXT setSamples_ = nullptr;
  PFN_vkCmdSetSampleMaskEXT setSampleMask_ = nullptr;
  PFN_vkCmdSetAlphaToCoverageEnableEXT setAlphaToCoverage_ = nullptr;
  PFN_vkCmdSetDepthClampEnableEXT setDepthClamp_ = nullptr;
  PFN_vkCmdSetColorBlendEnableEXT setBlend_ = nullptr;
  PFN_vkCmdSetColorWriteMaskEXT setWriteMask_ = nullptr;
};

}  // namespace speculum::examples
