#include "shader_objects.hpp"

#include "platform/files.hpp"

namespace speculum::examples {

void ShaderObjects::require(DeviceOptions& options) {
  // Layers wrap handles, and one that does not know shader objects would hand the wrapped ones to the driver.
  for (const auto& layer : enumerate<VkLayerProperties>("list Vulkan layers", vkEnumerateInstanceLayerProperties)) {
    const bool isUsed = options.validation && std::string_view(layer.layerName) == "VK_LAYER_KHRONOS_validation";
    if (isUsed && layer.specVersion < VK_MAKE_API_VERSION(0, 1, 3, 246)) {
      throw std::runtime_error(
          "--shaders objects: the validation layer is older than 1.3.246 (leave out --validation, or update it)");
    }
  }
  static VkPhysicalDeviceShaderObjectFeaturesEXT features{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_OBJECT_FEATURES_EXT, .pNext = nullptr, .shaderObject = VK_TRUE};
  options.extensions = {VK_EXT_SHADER_OBJECT_EXTENSION_NAME};
  options.features = &features;
  options.renderPath = RenderPath::dynamic;
}

ShaderObjects::ShaderObjects(Device& device, const std::filesystem::path& spirvDir, const GraphicsPipelineDesc& desc)
    : device_(device), desc_(desc) {
  const VkPushConstantRange range{stages_, 0, desc.pushConstantBytes};
  const auto sets = static_cast<uint32_t>(desc.setLayouts.size());
  const uint32_t ranges = desc.pushConstantBytes > 0 ? 1 : 0;
  layout_ = device.create(vkCreatePipelineLayout,
                          {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                           .setLayoutCount = sets,
                           .pSetLayouts = desc.setLayouts.data(),
                           .pushConstantRangeCount = ranges,
                           .pPushConstantRanges = &range},
                          desc.name);
  const SpecialisedConstant& constant = desc.constants.front();
  const VkSpecializationMapEntry entry{constant.number, 0, sizeof constant.value};
  const VkSpecializationInfo constants{1, &entry, sizeof constant.value, &constant.value};
  const auto info = [&](VkShaderStageFlagBits stage, VkShaderStageFlags next, const std::vector<uint8_t>& code) {
    return VkShaderCreateInfoEXT{.sType = VK_STRUCTURE_TYPE_SHADER_CREATE_INFO_EXT,
                                 .pNext = nullptr,
                                 .flags = VK_SHADER_CREATE_LINK_STAGE_BIT_EXT,
                                 .stage = stage,
                                 .nextStage = next,
                                 .codeType = VK_SHADER_CODE_TYPE_SPIRV_EXT,
                                 .codeSize = code.size(),
                                 .pCode = code.data(),
                                 .pName = "main",
                                 .setLayoutCount = sets,
                                 .pSetLayouts = desc.setLayouts.data(),
                                 .pushConstantRangeCount = ranges,
                                 .pPushConstantRanges = &range,
                                 .pSpecializationInfo = &constants};
  };
  const std::vector<uint8_t> vert = readFile(spirvDir / (desc.vert + ".spv"));
  const std::vector<uint8_t> frag = readFile(spirvDir / (*desc.frag + ".spv"));
  const VkShaderCreateInfoEXT infos[] = {info(VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_FRAGMENT_BIT, vert),
                                         info(VK_SHADER_STAGE_FRAGMENT_BIT, 0, frag)};
  check(device.function<PFN_vkCreateShadersEXT>("vkCreateShadersEXT")(device.get(), 2, infos, nullptr, shaders_),
        "create the shader objects of " + desc.name);
}

ShaderObjects::~ShaderObjects() {
  for (const VkShaderEXT shader : shaders_) {
    vkDestroyShaderEXT(device_.get(), shader, nullptr);
  }
}

// Records all that a pipeline would hold. PassScope has set front face and cull mode.
void ShaderObjects::bind(const PassScope& pass, VkDescriptorSet set) const {
  const VkCommandBuffer commands = pass.commands();
  vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
  const VkShaderStageFlagBits stages[] = {VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_FRAGMENT_BIT,
                                          VK_SHADER_STAGE_GEOMETRY_BIT};
  const VkShaderEXT shaders[] = {shaders_[0], shaders_[1], VK_NULL_HANDLE};
  // An enabled geometry stage must be bound, to none.
  vkCmdBindShadersEXT(commands, device_.caps().primitiveId ? 3 : 2, stages, shaders);
  const Viewport& area = pass.desc().viewport;
  const VkViewport viewport{area.x, area.y, area.width, area.height, 0.0f, 1.0f};
  vkCmdSetViewportWithCount(commands, 1, &viewport);
  vkCmdSetScissorWithCount(commands, 1, &pass.desc().scissor);
  std::vector<VkVertexInputBindingDescription2EXT> bindings;
  for (const auto& [binding, stride, rate] : desc_.vertexBindings) {
    bindings.push_back({VK_STRUCTURE_TYPE_VERTEX_INPUT_BINDING_DESCRIPTION_2_EXT, nullptr, binding, stride, rate, 1});
  }
  std::vector<VkVertexInputAttributeDescription2EXT> attributes;
  for (const auto& [location, binding, format, offset] : desc_.vertexAttributes) {
    attributes.push_back(
        {VK_STRUCTURE_TYPE_VERTEX_INPUT_ATTRIBUTE_DESCRIPTION_2_EXT, nullptr, location, binding, format, offset});
  }
  vkCmdSetVertexInputEXT(commands, static_cast<uint32_t>(bindings.size()), bindings.data(),
                         static_cast<uint32_t>(attributes.size()), attributes.data());
  vkCmdSetPrimitiveTopology(commands, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST);
  vkCmdSetPrimitiveRestartEnable(commands, VK_FALSE);
  vkCmdSetRasterizerDiscardEnable(commands, VK_FALSE);
  vkCmdSetPolygonModeEXT(commands, VK_POLYGON_MODE_FILL);
  vkCmdSetRasterizationSamplesEXT(commands, VK_SAMPLE_COUNT_1_BIT);
  const VkSampleMask allSamples = ~0u;
  vkCmdSetSampleMaskEXT(commands, VK_SAMPLE_COUNT_1_BIT, &allSamples);
  vkCmdSetAlphaToCoverageEnableEXT(commands, VK_FALSE);
  vkCmdSetDepthTestEnable(commands, desc_.depthTest);
  vkCmdSetDepthWriteEnable(commands, desc_.depthWrite);
  vkCmdSetDepthCompareOp(commands, desc_.depthCompare);
  vkCmdSetDepthBiasEnable(commands, VK_FALSE);
  vkCmdSetStencilTestEnable(commands, VK_FALSE);
  vkCmdSetDepthClampEnableEXT(commands, desc_.depthClamp && device_.caps().depthClamp);
  const VkBool32 blends = VK_FALSE;
  vkCmdSetColorBlendEnableEXT(commands, 0, 1, &blends);
  const VkColorComponentFlags allColor = 0xf;
  vkCmdSetColorWriteMaskEXT(commands, 0, 1, &allColor);
}

void ShaderObjects::push(const PassScope& pass, const void* data, uint32_t bytes) const {
  vkCmdPushConstants(pass.commands(), layout_.get(), stages_, 0, bytes, data);
}

}  // namespace speculum::examples
