#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/device.hpp"
#include "core/image.hpp"
#include "core/retire_queue.hpp"
#include "core/shader_library.hpp"

namespace speculum {

// The driver's compiled pipelines on disk, one file per GPU and driver. Damaged and foreign files are ignored.
class PipelineCache {
 public:
  // `directory` empty: nothing is read or written.
  PipelineCache(Device& device, const std::filesystem::path& directory);
  ~PipelineCache();  // saves
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;

  VkPipelineCache get() const { return cache_.get(); }
  const std::filesystem::path& file() const { return file_; }
  bool loaded() const { return loaded_; }  // whether a file was found and taken
  bool save() const;                       // true if written, or nothing was to be written

 private:
  Device& device_;
  std::filesystem::path file_;
  bool loaded_ = false;
  PipelineCacheHandle cache_;
};

// Properties in which the project's one-subpass render passes differ. Attachments: color, resolve, depth.
struct RenderPassKey {
  VkFormat color = VK_FORMAT_UNDEFINED;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  bool resolve = false;
  bool loadColor = false;
  bool storeColor = true;
  bool loadDepth = false;
  bool storeDepth = false;
  VkImageLayout colorLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;

  auto operator<=>(const RenderPassKey&) const = default;
};

// Render passes by key, each made on its first use.
class RenderPassCache {
 public:
  explicit RenderPassCache(Device& device) : device_(device) {}

  VkRenderPass renderPass(const RenderPassKey& key);

 private:
  Device& device_;
  std::map<RenderPassKey, RenderPassHandle> renderPasses_;
};

// A specialisation constant of shaders: its constant_id, and the bits of its value.
struct SpecialisedConstant {
  uint32_t number = 0;
  uint32_t value = 0;
};

// State of a graphics pipeline. Viewport, scissor, front face, cull mode and the width of lines are dynamic.
struct GraphicsPipelineDesc {
  std::string name;
  std::string vert;                               // e.g. "scene.vert"
  std::optional<std::string> frag;                // none: only depth is written
  std::vector<SpecialisedConstant> constants;     // of both shaders, each of which takes those that it declares
  std::vector<VkDescriptorSetLayout> setLayouts;  // of descriptorSetLayout()
  uint32_t pushConstantBytes = 0;                 // offset 0, vertex and fragment stage
  VkFormat color = colorFormat;
  VkFormat depth = depthFormat;  // VK_FORMAT_UNDEFINED: the pass has no depth
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  bool depthTest = true;
  bool depthWrite = true;
  VkCompareOp depthCompare = VK_COMPARE_OP_GREATER;  // reversed Z
  bool depthClamp = true;                            // nothing is cut at the near plane; ignored where not supported
  bool sampleShading = false;                        // one invocation per sample; ignored where not supported
  bool adds = false;                                 // additive blending of color and alpha; else they replace
  bool lines = false;                                // wireframe; filled where not supported
  bool mayDrawLines = false;  // PassScope::drawLines decides instead, with DeviceCaps::dynamicPolygonMode
  std::vector<VkVertexInputBindingDescription> vertexBindings;
  std::vector<VkVertexInputAttributeDescription> vertexAttributes;
};

struct ComputePipelineDesc {
  std::string name;
  std::string comp;  // e.g. "check_finite.comp"
  std::vector<SpecialisedConstant> constants;
  std::vector<VkDescriptorSetLayout> setLayouts;  // of descriptorSetLayout()
  uint32_t pushConstantBytes = 0;                 // offset 0
};

// Returns the number of groups of `side` invocations that cover `size` pixels.
constexpr uint32_t groupCount(uint32_t size, uint32_t side) {
  return (size + side - 1) / side;
}

using PipelineDesc = std::variant<GraphicsPipelineDesc, ComputePipelineDesc>;

class Pipeline;

// Makes pipelines, and rebuilds them when a shader changed.
class PipelineFactory {
 public:
  PipelineFactory(Device& device, ShaderLibrary& shaders, RenderPassCache& renderPasses, PipelineCache& cache,
                  RetireQueue& retired)
      : device_(device), shaders_(shaders), renderPasses_(renderPasses), cache_(cache), retired_(retired) {}

  // Compiles changed shaders and rebuilds the pipelines that use them; old ones are retired. Returns whether any was
  // rebuilt.
  bool reload();
  uint64_t revision() const { return revision_; }  // counts the times that reload() rebuilt pipelines
  size_t count() const { return pipelines_.size(); }
  const std::string& errors() const { return shaders_.errors(); }
  bool watching() const { return shaders_.watching(); }

 private:
  friend class Pipeline;
  // Returns what tells the pipelines of a device apart.
  std::string keyOf(const PipelineDesc& desc);
  PipelineHandle build(const PipelineDesc& desc, VkPipelineLayout layout);
  VkPipeline buildPipeline(const GraphicsPipelineDesc& desc, VkPipelineLayout layout);
  VkPipeline buildPipeline(const ComputePipelineDesc& desc, VkPipelineLayout layout);

  Device& device_;
  ShaderLibrary& shaders_;
  RenderPassCache& renderPasses_;
  PipelineCache& cache_;
  RetireQueue& retired_;
  std::vector<Pipeline*> pipelines_;
  uint64_t revision_ = 0;
};

// A graphics or compute pipeline and its layout, made or taken from the device's spare ones. It must not move, because
// hot reload keeps its address; hold it by unique_ptr or std::optional. The factory outlives it.
class Pipeline {
 public:
  Pipeline(PipelineFactory& factory, PipelineDesc desc);
  ~Pipeline();  // the Vulkan objects go to the retire queue, and then to the device's spare ones
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  void bind(VkCommandBuffer commands) const { vkCmdBindPipeline(commands, bindPoint(), pipeline_.get()); }
  // Binds descriptor sets from `index` on. `offsets` are those of their dynamic buffers, in bytes, in the order of
  // bindings.
  void bindSets(VkCommandBuffer commands, uint32_t index, std::span<const VkDescriptorSet> sets,
                std::span<const uint32_t> offsets = {}) const;
  void bindSet(VkCommandBuffer commands, uint32_t index, VkDescriptorSet set) const {
    bindSets(commands, index, {&set, 1});
  }
  template <typename T>
  void push(VkCommandBuffer commands, const T& constants) const {
    pushBytes(commands, &constants, sizeof constants);
  }
  // Binds the pipeline with its only set and its push constants.
  template <typename T>
  void bind(VkCommandBuffer commands, VkDescriptorSet set, const T& constants) const {
    bind(commands);
    bindSet(commands, 0, set);
    push(commands, constants);
  }

 private:
  friend class PipelineFactory;
  VkPipelineBindPoint bindPoint() const;
  void pushBytes(VkCommandBuffer commands, const void* data, uint32_t bytes) const;

  PipelineFactory& factory_;
  PipelineDesc desc_;
  std::string key_;
  PipelineLayoutHandle layout_;
  PipelineHandle pipeline_;
};

}  // namespace speculum
