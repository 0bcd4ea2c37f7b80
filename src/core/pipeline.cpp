#include "core/pipeline.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <utility>

#include "platform/bytes.hpp"
#include "platform/files.hpp"

namespace speculum {

namespace {

VkShaderStageFlags pushStages(const PipelineDesc& desc) {
  return std::holds_alternative<ComputePipelineDesc>(desc) ? VK_SHADER_STAGE_COMPUTE_BIT
                                                           : VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
}

const std::string& nameOf(const PipelineDesc& desc) {
  return std::visit([](const auto& d) -> const std::string& { return d.name; }, desc);
}

// One shader stage with its constants; keeps what the create info points to.
class Stage {
 public:
  Stage(VkShaderStageFlagBits stage, VkShaderModule module, const std::vector<SpecialisedConstant>& constants) {
    for (const SpecialisedConstant& constant : constants) {
      entries_.push_back({constant.number, static_cast<uint32_t>(values_.size() * sizeof(uint32_t)), sizeof(uint32_t)});
      values_.push_back(constant.value);
    }
    specialization_ = {static_cast<uint32_t>(entries_.size()), entries_.data(), values_.size() * sizeof(uint32_t),
                       values_.data()};
    info_ = {.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
             .stage = stage,
             .module = module,
             .pName = "main",
             .pSpecializationInfo = constants.empty() ? nullptr : &specialization_};
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  const VkPipelineShaderStageCreateInfo& info() const { return info_; }

 private:
  std::vector<VkSpecializationMapEntry> entries_;
  std::vector<uint32_t> values_;
  VkSpecializationInfo specialization_{};
  VkPipelineShaderStageCreateInfo info_{};
};

constexpr VkColorComponentFlags allColor =
    VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;

PipelineLayoutHandle createLayout(Device& device, const PipelineDesc& desc) {
  const uint32_t pushBytes = std::visit([](const auto& d) { return d.pushConstantBytes; }, desc);
  const std::vector<VkDescriptorSetLayout>& sets =
      std::visit([](const auto& d) -> const std::vector<VkDescriptorSetLayout>& { return d.setLayouts; }, desc);
  const VkPushConstantRange range{pushStages(desc), 0, pushBytes};
  return device.create(vkCreatePipelineLayout,
                       {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                        .setLayoutCount = static_cast<uint32_t>(sets.size()),
                        .pSetLayouts = sets.data(),
                        .pushConstantRangeCount = pushBytes > 0 ? 1u : 0u,
                        .pPushConstantRanges = &range},
                       nameOf(desc));
}

bool uses(const PipelineDesc& desc, const std::vector<std::string>& shaders) {
  const auto listed = [&](const std::string& name) { return std::ranges::find(shaders, name) != shaders.end(); };
  if (const auto* compute = std::get_if<ComputePipelineDesc>(&desc)) {
    return listed(compute->comp);
  }
  const auto& graphics = std::get<GraphicsPipelineDesc>(desc);
  return listed(graphics.vert) || (graphics.frag && listed(*graphics.frag));
}

template <typename T>
void append(std::string& key, const T& value) {
  static_assert(std::has_unique_object_representations_v<T>, "bytes between members would count");
  key.append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <typename T>
void append(std::string& key, const std::vector<T>& values) {
  append(key, values.size());
  for (const T& value : values) {
    append(key, value);
  }
}

// A pipeline whose last frame has finished when this is destroyed.
struct Retired {
  Device& device;
  std::string key;
  SparePipelines::Spare spare;

  Retired(Device& owner, std::string itsKey, SparePipelines::Spare itsSpare)
      : device(owner), key(std::move(itsKey)), spare(std::move(itsSpare)) {}
  Retired(Retired&&) = default;
  ~Retired() {
    if (spare.pipeline) {
      device.sparePipelines().keep(std::move(key), std::move(spare));
    }
  }
};

VkAttachmentDescription attachmentOf(VkFormat format, VkSampleCountFlagBits samples, bool load, bool store,
                                     VkImageLayout layout) {
  // Render passes keep the layout: barriers change layouts.
  return {.format = format,
          .samples = samples,
          .loadOp = load ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR,
          .storeOp = store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE,
          .stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE,
          .stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
          .initialLayout = layout,
          .finalLayout = layout};
}

constexpr VkImageLayout resolveLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
constexpr VkImageLayout depthLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;

RenderPassHandle create(Device& device, const RenderPassKey& key) {
  std::vector<VkAttachmentDescription> attachments = {
      attachmentOf(key.color, key.samples, key.loadColor, key.storeColor, key.colorLayout)};
  const VkAttachmentReference color{0, key.colorLayout};
  const VkAttachmentReference resolve{1, resolveLayout};
  const VkAttachmentReference depth{key.resolve ? 2u : 1u, depthLayout};
  if (key.resolve) {
    attachments.push_back(attachmentOf(key.color, VK_SAMPLE_COUNT_1_BIT, false, true, resolveLayout));
    attachments.back().loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  }
  if (key.depth != VK_FORMAT_UNDEFINED) {
    attachments.push_back(attachmentOf(key.depth, key.samples, key.loadDepth, key.storeDepth, depthLayout));
  }
  const VkSubpassDescription subpass{.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS,
                                     .colorAttachmentCount = 1,
                                     .pColorAttachments = &color,
                                     .pResolveAttachments = key.resolve ? &resolve : nullptr,
                                     .pDepthStencilAttachment = key.depth != VK_FORMAT_UNDEFINED ? &depth : nullptr};
  return device.create(vkCreateRenderPass,
                       {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                        .attachmentCount = static_cast<uint32_t>(attachments.size()),
                        .pAttachments = attachments.data(),
                        .subpassCount = 1,
                        .pSubpasses = &subpass},
                       "samples " + std::to_string(key.samples));
}

// Precedes the driver's data in the file. Drivers check their own header only, and some trust what follows it.
struct FileHeader {
  char magic[8] = {'S', 'P', 'E', 'C', 'P', 'C', '0', '1'};
  uint64_t bytes = 0;
  uint64_t hash = 0;
};

std::string fileName(const VkPhysicalDeviceProperties& properties) {
  std::string name = "pipelines_";
  for (const uint8_t byte : properties.pipelineCacheUUID) {
    constexpr const char* digits = "0123456789abcdef";
    name += {digits[byte >> 4], digits[byte & 15]};
  }
  return name + "_" + std::to_string(properties.driverVersion) + ".bin";
}

// Returns the driver's part of a whole and undamaged file; empty otherwise.
std::span<const uint8_t> payload(std::span<const uint8_t> file) {
  FileHeader header;
  const FileHeader expected;
  if (file.size() < sizeof header) {
    return {};
  }
  std::memcpy(&header, file.data(), sizeof header);
  const std::span<const uint8_t> data = file.subspan(sizeof header);
  const bool whole = std::memcmp(header.magic, expected.magic, sizeof header.magic) == 0 &&
                     header.bytes == data.size() && header.hash == fnv1a(std::as_bytes(data));
  return whole ? data : std::span<const uint8_t>{};
}

}  // namespace

VkRenderPass RenderPassCache::renderPass(const RenderPassKey& key) {
  RenderPassHandle& handle = renderPasses_[key];
  if (!handle) {
    handle = create(device_, key);
  }
  return handle.get();
}

std::string PipelineFactory::keyOf(const PipelineDesc& desc) {
  std::string key = nameOf(desc) + '\0';
  // Whoever adds a member to a description is stopped here by the compiler.
  if (const auto* compute = std::get_if<ComputePipelineDesc>(&desc)) {
    const auto& [name, comp, constants, setLayouts, pushConstantBytes] = *compute;
    append(key, shaders_.fingerprint(comp));
    append(key, constants);
    append(key, setLayouts);
    append(key, pushConstantBytes);
  } else {
    const auto& [name, vert, frag, constants, setLayouts, pushConstantBytes, color, depth, samples, depthTest,
                 depthWrite, depthCompare, depthClamp, sampleShading, adds, lines, mayDrawLines, vertexBindings,
                 vertexAttributes] = std::get<GraphicsPipelineDesc>(desc);
    append(key, shaders_.fingerprint(vert));
    append(key, frag ? shaders_.fingerprint(*frag) : 0);
    append(key, constants);
    append(key, setLayouts);
    append(key, pushConstantBytes);
    append(key, std::array{color, depth});
    append(key, samples);
    append(key, depthCompare);
    append(key, std::array{depthTest, depthWrite, depthClamp, sampleShading, adds, lines, mayDrawLines});
    append(key, vertexBindings);
    append(key, vertexAttributes);
  }
  return key;
}

bool PipelineFactory::reload() {
  const std::vector<std::string> changed = shaders_.poll();
  bool rebuilt = false;
  for (Pipeline* pipeline : pipelines_) {
    if (uses(pipeline->desc_, changed)) {
      retired_.retire(std::exchange(pipeline->pipeline_, build(pipeline->desc_, pipeline->layout_.get())));
      pipeline->key_ = keyOf(pipeline->desc_);
      spdlog::info("pipeline {} was rebuilt", nameOf(pipeline->desc_));
      rebuilt = true;
    }
  }
  revision_ += rebuilt;
  return rebuilt;
}

PipelineHandle PipelineFactory::build(const PipelineDesc& desc, VkPipelineLayout layout) {
  const VkPipeline pipeline = std::visit([&](const auto& d) { return buildPipeline(d, layout); }, desc);
  device_.setName(pipeline, nameOf(desc));
  return {device_.get(), pipeline};
}

VkPipeline PipelineFactory::buildPipeline(const ComputePipelineDesc& desc, VkPipelineLayout layout) {
  const Stage comp(VK_SHADER_STAGE_COMPUTE_BIT, shaders_.module(desc.comp), desc.constants);
  const VkComputePipelineCreateInfo info{
      .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO, .stage = comp.info(), .layout = layout};
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(device_.get(), cache_.get(), 1, &info, nullptr, &pipeline),
        "create pipeline " + desc.name);
  return pipeline;
}

VkPipeline PipelineFactory::buildPipeline(const GraphicsPipelineDesc& desc, VkPipelineLayout layout) {
  const Stage vert(VK_SHADER_STAGE_VERTEX_BIT, shaders_.module(desc.vert), desc.constants);
  std::vector<VkPipelineShaderStageCreateInfo> stages = {vert.info()};
  std::optional<Stage> frag;
  if (desc.frag) {
    frag.emplace(VK_SHADER_STAGE_FRAGMENT_BIT, shaders_.module(*desc.frag), desc.constants);
    stages.push_back(frag->info());
  }
  const DeviceCaps& caps = device_.caps();
  std::vector<VkDynamicState> dynamicStates = {VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                               VK_DYNAMIC_STATE_FRONT_FACE, VK_DYNAMIC_STATE_CULL_MODE};
  if (desc.mayDrawLines && caps.dynamicPolygonMode) {
    dynamicStates.push_back(VK_DYNAMIC_STATE_POLYGON_MODE_EXT);
  }
  if (desc.lines || desc.mayDrawLines) {
    dynamicStates.push_back(VK_DYNAMIC_STATE_LINE_WIDTH);
  }
  const VkPipelineDynamicStateCreateInfo dynamicState{.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
                                                      .dynamicStateCount = static_cast<uint32_t>(dynamicStates.size()),
                                                      .pDynamicStates = dynamicStates.data()};
  const VkPipelineVertexInputStateCreateInfo vertexInput{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
      .vertexBindingDescriptionCount = static_cast<uint32_t>(desc.vertexBindings.size()),
      .pVertexBindingDescriptions = desc.vertexBindings.data(),
      .vertexAttributeDescriptionCount = static_cast<uint32_t>(desc.vertexAttributes.size()),
      .pVertexAttributeDescriptions = desc.vertexAttributes.data()};
  const VkPipelineInputAssemblyStateCreateInfo assembly{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
      .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
  const VkPipelineViewportStateCreateInfo viewport{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO, .viewportCount = 1, .scissorCount = 1};
  const VkPipelineRasterizationStateCreateInfo raster{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
      .depthClampEnable = desc.depthClamp && caps.depthClamp,
      .polygonMode = desc.lines && caps.fillModeNonSolid ? VK_POLYGON_MODE_LINE : VK_POLYGON_MODE_FILL,
      .lineWidth = 1.0f};
  const VkPipelineMultisampleStateCreateInfo samples{
      .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
      .rasterizationSamples = desc.samples,
      .sampleShadingEnable = desc.sampleShading && caps.sampleRateShading,
      .minSampleShading = 1.0f};
  const VkFormat depthUsed = desc.depth == depthFormat ? caps.depthFormat : desc.depth;
  const bool hasDepth = depthUsed != VK_FORMAT_UNDEFINED;
  const VkPipelineDepthStencilStateCreateInfo depth{.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
                                                    .depthTestEnable = hasDepth && desc.depthTest,
                                                    .depthWriteEnable = hasDepth && desc.depthWrite,
                                                    .depthCompareOp = desc.depthCompare};
  const VkPipelineColorBlendAttachmentState attachment{.blendEnable = desc.adds,
                                                       .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                                       .dstColorBlendFactor = VK_BLEND_FACTOR_ONE,
                                                       .colorBlendOp = VK_BLEND_OP_ADD,
                                                       .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                       .dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
                                                       .alphaBlendOp = VK_BLEND_OP_ADD,
                                                       .colorWriteMask = desc.frag ? allColor : 0};
  const VkPipelineColorBlendStateCreateInfo blend{.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
                                                  .attachmentCount = 1,
                                                  .pAttachments = &attachment};
  VkGraphicsPipelineCreateInfo info{.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                    .stageCount = static_cast<uint32_t>(stages.size()),
                                    .pStages = stages.data(),
                                    .pVertexInputState = &vertexInput,
                                    .pInputAssemblyState = &assembly,
                                    .pViewportState = &viewport,
                                    .pRasterizationState = &raster,
                                    .pMultisampleState = &samples,
                                    .pDepthStencilState = &depth,
                                    .pColorBlendState = &blend,
                                    .pDynamicState = &dynamicState,
                                    .layout = layout};
  const VkPipelineRenderingCreateInfo rendering{.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                .colorAttachmentCount = 1,
                                                .pColorAttachmentFormats = &desc.color,
                                                .depthAttachmentFormat = depthUsed};
  if (device_.renderPath() == RenderPath::dynamic) {
    info.pNext = &rendering;
  } else {
    info.renderPass = renderPasses_.renderPass({.color = desc.color,
                                                .depth = depthUsed,
                                                .samples = desc.samples,
                                                .resolve = desc.samples != VK_SAMPLE_COUNT_1_BIT});
  }
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(device_.get(), cache_.get(), 1, &info, nullptr, &pipeline),
        "create pipeline " + desc.name);
  return pipeline;
}

Pipeline::Pipeline(PipelineFactory& factory, PipelineDesc desc)
    : factory_(factory), desc_(std::move(desc)), key_(factory.keyOf(desc_)) {
  SparePipelines::Spare spare = factory.device_.sparePipelines().take(key_);
  if (!spare.pipeline) {
    spare.layout = createLayout(factory.device_, desc_);
    spare.pipeline = factory.build(desc_, spare.layout.get());
  }
  layout_ = std::move(spare.layout);
  pipeline_ = std::move(spare.pipeline);
  factory_.pipelines_.push_back(this);
}

Pipeline::~Pipeline() {
  std::erase(factory_.pipelines_, this);
  factory_.retired_.retire(Retired{factory_.device_, std::move(key_), {std::move(layout_), std::move(pipeline_)}});
}

VkPipelineBindPoint Pipeline::bindPoint() const {
  return std::holds_alternative<ComputePipelineDesc>(desc_) ? VK_PIPELINE_BIND_POINT_COMPUTE
                                                            : VK_PIPELINE_BIND_POINT_GRAPHICS;
}

void Pipeline::bindSets(VkCommandBuffer commands, uint32_t index, std::span<const VkDescriptorSet> sets,
                        std::span<const uint32_t> offsets) const {
  vkCmdBindDescriptorSets(commands, bindPoint(), layout_.get(), index, static_cast<uint32_t>(sets.size()), sets.data(),
                          static_cast<uint32_t>(offsets.size()), offsets.data());
}

void Pipeline::pushBytes(VkCommandBuffer commands, const void* data, uint32_t bytes) const {
  vkCmdPushConstants(commands, layout_.get(), pushStages(desc_), 0, bytes, data);
}

PipelineCache::PipelineCache(Device& device, const std::filesystem::path& directory) : device_(device) {
  std::vector<uint8_t> content;
  std::span<const uint8_t> data;
  if (!directory.empty()) {
    file_ = directory / fileName(device.properties());
    if (std::optional<std::vector<uint8_t>> found = readFileIfAny(file_)) {
      content = std::move(*found);
      data = payload(content);
      loaded_ = !data.empty();
      if (!loaded_) {
        spdlog::info("pipeline cache {} is damaged and is not used", file_.string());
      }
    }
  }
  cache_ = device.create(vkCreatePipelineCache,
                         {.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO,
                          .initialDataSize = data.size(),
                          .pInitialData = data.data()},
                         "pipeline cache");
}

PipelineCache::~PipelineCache() {
  if (!save()) {
    spdlog::warn("pipeline cache {} could not be written", file_.string());
  }
}

bool PipelineCache::save() const {
  if (file_.empty()) {
    return true;
  }
  size_t bytes = 0;
  if (vkGetPipelineCacheData(device_.get(), cache_.get(), &bytes, nullptr) != VK_SUCCESS) {
    return false;
  }
  FileHeader header;
  std::vector<uint8_t> content(sizeof header + bytes);
  if (vkGetPipelineCacheData(device_.get(), cache_.get(), &bytes, content.data() + sizeof header) != VK_SUCCESS) {
    return false;
  }
  content.resize(sizeof header + bytes);
  header.bytes = bytes;
  header.hash = fnv1a(std::as_bytes(std::span(content).subspan(sizeof header)));
  std::memcpy(content.data(), &header, sizeof header);
  return storeFile(file_, content);
}

}  // namespace speculum
