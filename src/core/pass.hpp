#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/image.hpp"

namespace speculum {

class GpuTimer;
class RenderPassCache;
class RetireQueue;

// Use of a pass's targets, which decides the barriers that guard them.
enum class TargetRole { offscreen, main, swapchain };

// With `resolve`, `color` is multisampled and the pass's output is the resolved image; without it the output is `color`
// with the samples it has. Any extent not below the render area will do.
struct PassTargets {
  Image* color = nullptr;
  Image* resolve = nullptr;
  Image* depth = nullptr;
  TargetRole role = TargetRole::offscreen;

  Image& output() const { return resolve ? *resolve : *color; }
  VkSampleCountFlagBits samples() const { return color->samples(); }
};

// Viewport in pixels of the target. It may exceed the target: for a part of the picture it has the picture's size, at
// minus the part's corner.
struct Viewport {
  float x = 0.0f;
  float y = 0.0f;
  float width = 0.0f;
  float height = 0.0f;
};

struct PassDesc {
  std::string name;
  PassTargets targets;
  // Pixels of the target; only these are cleared and written. Outside them
  // - resolved or single-sample offscreen color is kept,
  // - multisampled color is kept if `loadColor` or `keepsSamples`,
  // - depth is kept if `loadDepth`, or `storeDepth` and `keepsSamples`,
  // - swapchain images are kept if `loadColor`.
  VkRect2D renderArea{};
  Viewport viewport;
  VkRect2D scissor{};  // pixels of the target, within the render area
  VkFrontFace frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
  std::array<float, 4> clearColor{0.0f, 0.0f, 0.0f, 1.0f};
  float clearDepth = 0.0f;  // reversed Z: infinitely far
  bool loadColor = false;   // else cleared
  bool loadDepth = false;
  bool storeDepth = false;
  bool storeSamples = false;       // keeps multisampled color for passes that load or read it
  bool keepsSamples = false;       // keeps multisampled color outside the render area too
  bool collectStatistics = false;  // triangles after clipping and fragment shader invocations
  bool grouped = false;            // SharedBarriers records the pass's barriers, not the pass itself
  bool pauses = false;             // compute shaders read `color`, with all its samples, after PassScope::pause
  bool overlay = false;            // loads and stores the display image
  bool inRenderPass = false;       // a VkRenderPass on either render path
};

// Describes a pass over all of `targets`: render area, viewport and scissor cover the output.
PassDesc fullPass(std::string name, const PassTargets& targets);

// Barriers of one pass, or of several that touch none of each other's targets: all before the first and all after the
// last, so that the device may draw the passes side by side. The passes, at least one, have PassDesc::grouped set,
// outlive the group, are begun and ended within it, and are alike in role, samples and in what they load.
class SharedBarriers {
 public:
  SharedBarriers(const Barriers& barriers, VkCommandBuffer commands, std::span<const PassDesc> passes);
  SharedBarriers(const SharedBarriers&) = delete;
  SharedBarriers& operator=(const SharedBarriers&) = delete;
  ~SharedBarriers();

 private:
  const Barriers& barriers_;
  VkCommandBuffer commands_;
  std::span<const PassDesc> passes_;
};

// A pass that is being recorded, from construction to end: debug label, timestamps, statistics, barriers, rendering on
// the device's render path. Viewport, scissor and front face are set, and nothing is culled. Made by
// Renderer::beginPass. A pass that pauses renders twice: between pause() and resume() commands outside rendering may be
// recorded.
class PassScope {
 public:
  PassScope(const PassScope&) = delete;
  PassScope& operator=(const PassScope&) = delete;
  ~PassScope();

  VkCommandBuffer commands() const { return commands_; }
  const PassDesc& desc() const { return desc_; }
  VkSampleCountFlagBits samples() const { return desc_.targets.samples(); }
  bool hasLabels() const { return device_.functions().beginLabel != nullptr; }
  // Begins a debug label within the pass's own label; endLabel() ends it.
  void beginLabel(std::string_view name) const { device_.beginLabel(commands_, name); }
  void endLabel() const { device_.endLabel(commands_); }
  // Draws edges of triangles, `width` pixels wide, or fills triangles. Call it after a pipeline with
  // GraphicsPipelineDesc::mayDrawLines is bound; without DeviceCaps::dynamicPolygonMode it only sets the width.
  void drawLines(bool lines, float width) const;
  bool drawsEither() const { return device_.caps().dynamicPolygonMode; }
  // Culls these sides of triangles from here on.
  void cull(VkCullModeFlags sides) const { device_.functions().setCullMode(commands_, sides); }
  // Ends the first rendering of a pass that pauses.
  void pause();
  // Begins the second rendering of a pass that pauses, which loads what the first one has stored. `desc` has the same
  // render area.
  void resume(PassDesc desc);
  // Counts the samples that pass the depth test from here to the pass's end or pause. Call it at most once a pass; does
  // nothing without PassDesc::collectStatistics. lavapipe compiles each shader once more for draws that are counted.
  void countSamples();

 private:
  friend class Renderer;
  PassScope(Device& device, RenderPassCache& renderPasses, RetireQueue& retired, GpuTimer& timer,
            VkCommandBuffer commands, PassDesc desc);
  void begin();
  void end();
  void beginDynamic();
  void beginRenderPass();

  Device& device_;
  RenderPassCache& renderPasses_;
  RetireQueue& retired_;
  GpuTimer& timer_;
  VkCommandBuffer commands_;
  PassDesc desc_;
  std::optional<SharedBarriers> group_;  // the pass's own barriers; none if it is grouped or the overlay
  bool dynamic_;
  bool rendering_ = false;
  int timerSlot_;
};

}  // namespace speculum
