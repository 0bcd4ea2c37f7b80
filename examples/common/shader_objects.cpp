#include "shader_objects.hpp"

#include <algorithm>

#include "platform/files.hpp"

namespace speculum::examples {

namespace {

constexpr VkShaderStageFlags drawStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr VkColorComponentFlags allColor =
    VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;

// Layers wrap handles, and one that does not know shader objects would hand the wrapped ones to the driver.
bool validationKnowsThem() {
  const auto layers = enumerate<VkLayerProperties>("list Vulkan layers", vkEnumerateInstanceLayerProperties);
  return std::ranges::any_of(layers, [](const VkLayerProperties& layer) {
    return std::string_view(layer.layerName) == "VK_LAYER_KHRONOS_validation" &&
           layer.specVersion >= VK_MAKE_API_VERSION(0, 1, 3, 246);
  });
}

}  // namespace

void ShaderObjects::require(DeviceOptions& options) {
  if (options.validation && !validationKnowsThem()) {
    throw std::runtime_error(
        "--shaders objects: the validation layer is older than 1.3.246 (leave out --validation, or update it)");
  }
  static VkPhysicalDeviceShaderObjectFeaturesEXT features{
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_OBJECT_FEATURES_EXT, .pNext = nullptr, .shaderObject = VK_TRUE};
  options.extensions = {VK_EXT_SHADER_OBJECT_EXTENSION_NAME};
  options.features = &features;
  options.renderPath = RenderPath::dynamic;
}

ShaderObjects::ShaderObjects(Device& device, const std::filesystem::path& spirvDir, const GraphicsPipelineDesc& desc)
    : device_(device), desc_(desc) {
  loadFunctions();
  const VkPushConstantRange range{drawStages, 0, desc.pushConstantBytes};
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
  const std::vector<uint8_t> codes[2] = {readFile(spirvDir / (desc.vert + ".spv")),
                                         readFile(spirvDir / (*desc.frag + ".spv"))};
  VkShaderCreateInfoEXT infos[2];
  for (const int i : {0, 1}) {
    infos[i] = {.sType = VK_STRUCTURE_TYPE_SHADER_CREATE_INFO_EXT,
                .flags = VK_SHADER_CREATE_LINK_STAGE_BIT_EXT,
                .stage = i == 0 ? VK_SHADER_STAGE_VERTEX_BIT : VK_SHADER_STAGE_FRAGMENT_BIT,
                .nextStage = i == 0 ? VkShaderStageFlags{VK_SHADER_STAGE_FRAGMENT_BIT} : 0,
                .codeType = VK_SHADER_CODE_TYPE_SPIRV_EXT,
                .codeSize = codes[i].size(),
                .pCode = codes[i].data(),
                .pName = "main",
                .setLayoutCount = sets,
                .pSetLayouts = desc.setLayouts.data(),
                .pushConstantRangeCount = ranges,
                .pPushConstantRanges = &range,
                .pSpecializationInfo = i == 0 ? nullptr : &constants};
  }
  check(device.function<PFN_vkCreateShadersEXT>("vkCreateShadersEXT")(device.get(), 2, infos, nullptr, shaders_),
        "create the shader objects of " + desc.name);
}

ShaderObjects::~ShaderObjects() {
  for (const VkShaderEXT shader : shaders_) {
    destroy_(device_.get(), shader, nullptr);
  }
}

void ShaderObjects::loadFunctions() {
  destroy_ = device_.function<PFN_vkDestroyShaderEXT>("vkDestroyShaderEXT");
  bindShaders_ = device_.function<PFN_vkCmdBindShadersEXT>("vkCmdBindShadersEXT");
  setVertexInput_ = device_.function<PFN_vkCmdSetVertexInputEXT>("vkCmdSetVertexInputEXT");
  setPolygonMode_ = device_.function<PFN_vkCmdSetPolygonModeEXT>("vkCmdSetPolygonModeEXT");
  setSamples_ = device_.function<PFN_vkCmdSetRasterizationSamplesEXT>("vkCmdSetRasterizationSamplesEXT");
  setSampleMask_ = device_.function<PFN_vkCmdSetSampleMaskEXT>("vkCmdSetSampleMaskEXT");
  setAlphaToCoverage_ = device_.function<PFN_vkCmdSetAlphaToCoverageEnableEXT>("vkCmdSetAlphaToCoverageEnableEXT");
  setDepthClamp_ = device_.function<PFN_vkCmdSetDepthClampEnableEXT>("vkCmdSetDepthClampEnableEXT");
  setBlend_ = device_.function<PFN_vkCmdSetColorBlendEnableEXT>("vkCmdSetColorBlendEnableEXT");
  setWriteMask_ = device_.function<PFN_vkCmdSetColorWriteMaskEXT>("vkCmdSetColorWriteMaskEXT");
}

void ShaderObjects::bind(const PassScope& pass, VkDescriptorSet set) const {
  const VkShaderStageFlagBits stages[] = {VK_SHADER_STAGE_VERTEX_BIT, VK_SHADER_STAGE_FRAGMENT_BIT,
                                          VK_SHADER_STAGE_GEOMETRY_BIT};
  const VkShaderEXT shaders[] = {shaders_[0], shaders_[1], VK_NULL_HANDLE};
  // An enabled geometry stage must be bound, to none.
  bindShaders_(pass.commands(), device_.caps().primitiveId ? 3 : 2, stages, shaders);
  setState(pass);
  vkCmdBindDescriptorSets(pass.commands(), VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
}

// Records all that a pipeline would hold. PassScope has set front face and cull mode.
void ShaderObjects::setState(const PassScope& pass) const {
  const VkCommandBuffer commands = pass.commands();
  const Viewport& area = pass.desc().viewport;
  const VkViewport viewport{area.x, area.y, area.width, area.height, 0.0f, 1.0f};
  vkCmdSetViewportWithCount(commands, 1, &viewport);
  vkCmdSetScissorWithCount(commands, 1, &pass.desc().scissor);
  std::vector<VkVertexInputBindingDescription2EXT> bindings;
  for (const VkVertexInputBindingDescription& one : desc_.vertexBindings) {
    bindings.push_back({.sType = VK_STRUCTURE_TYPE_VERTEX_INPUT_BINDING_DESCRIPTION_2_EXT,
                        .binding = one.binding,
                        .stride = one.stride,
                        .inputRate = one.inputRate,
                        .divisor = 1});
  }
  std::vector<VkVertexInputAttributeDescription2EXT> attributes;
  for (const VkVertexInputAttributeDescription& one : desc_.vertexAttributes) {
    attributes.push_back({.sType = VK_STRUCTURE_TYPE_VERTEX_INPUT_ATTRIBUTE_DESCRIPTION_2_EXT,
                          .location = one.location,
                          .binding = one.binding,
                          .format = one.format,
                          .offset = one.offset});
  }
  setVertexInput_(commands, static_cast<uint32_t>(bindings.size()), bindings.data(),
                  static_cast<uint32_t>(attributes.size()), attributes.data());
  vkCmdSetPrimitiveTopology(commands, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST);
  vkCmdSetPrimitiveRestartEnable(commands, VK_FALSE);
  vkCmdSetRasterizerDiscardEnable(commands, VK_FALSE);
  setPolygonMode_(commands, VK_POLYGON_MODE_FILL);
  setSamples_(commands, VK_SAMPLE_COUNT_1_BIT);
  const VkSampleMask allSamples = ~0u;
  setSampleMask_(commands, VK_SAMPLE_COUNT_1_BIT, &allSamples);
  setAlphaToCoverage_(commands, VK_FALSE);
  vkCmdSetDepthTestEnable(commands, desc_.depthTest);
  vkCmdSetDepthWriteEnable(commands, desc_.depthWrite);
  vkCmdSetDepthCompareOp(commands, desc_.depthCompare);
  vkCmdSetDepthBiasEnable(commands, VK_FALSE);
  vkCmdSetStencilTestEnable(commands, VK_FALSE);
  setDepthClamp_(commands, desc_.depthClamp && device_.caps().depthClamp);
  const VkBool32 blends = VK_FALSE;
  setBlend_(commands, 0, 1, &blends);
  setWriteMask_(commands, 0, 1, &allColor);
}

void ShaderObjects::push(const PassScope& pass, const void* data, uint32_t bytes) const {
  vkCmdPushConstants(pass.commands(), layout_.get(), drawStages, 0, bytes, data);
}

}  // namespace speculum::examples
