#include "core/pass.hpp"

#include <cstring>
#include <utility>
#include <vector>

#include "core/gpu_timer.hpp"
#include "core/pipeline.hpp"
#include "core/retire_queue.hpp"

namespace speculum {

namespace {

VkClearValue colorClear(const PassDesc& desc) {
  VkClearValue value{};
  std::memcpy(value.color.float32, desc.clearColor.data(), sizeof value.color.float32);
  return value;
}

VkClearValue depthClear(const PassDesc& desc) {
  return {.depthStencil = {desc.clearDepth, 0}};
}

VkAttachmentStoreOp storeOp(bool store) {
  return store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
}

bool storesColor(const PassDesc& desc) {
  return !desc.targets.resolve || desc.storeSamples;
}

// Kinds of the barriers before a pass, for targets of one role.
struct TargetBarriers {
  BarrierKind color;
  BarrierKind samples;
  BarrierKind depth;
};

TargetBarriers barriersBefore(TargetRole role) {
  switch (role) {
    case TargetRole::offscreen:
      return {BarrierKind::offscreenBeforeWrite, BarrierKind::offscreenSamplesBeforeWrite,
              BarrierKind::offscreenDepthBeforeWrite};
    case TargetRole::main:
      return {BarrierKind::mainBeforeWrite, BarrierKind::mainSamplesBeforeWrite, BarrierKind::mainDepthBeforeWrite};
    case TargetRole::swapchain:
      break;
  }
  return {BarrierKind::swapchainBeforeWrite, BarrierKind::swapchainBeforeWrite, BarrierKind::mainDepthBeforeWrite};
}

// Makes the images' content undefined, also outside a pass's render area.
void discard(std::span<Image* const> images) {
  for (Image* image : images) {
    image->setLayout(VK_IMAGE_LAYOUT_UNDEFINED);
  }
}

}  // namespace

PassDesc fullPass(std::string name, const PassTargets& targets) {
  const VkExtent2D extent = targets.output().extent();
  return {.name = std::move(name),
          .targets = targets,
          .renderArea = {{0, 0}, extent},
          .viewport = {0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height)},
          .scissor = {{0, 0}, extent}};
}

SharedBarriers::SharedBarriers(const Barriers& barriers, VkCommandBuffer commands, std::span<const PassDesc> passes)
    : barriers_(barriers), commands_(commands), passes_(passes) {
  std::vector<Image*> samples;
  std::vector<Image*> outputs;
  std::vector<Image*> depths;
  for (const PassDesc& pass : passes) {
    if (pass.targets.samples() != VK_SAMPLE_COUNT_1_BIT) {
      samples.push_back(pass.targets.color);
    }
    if (pass.targets.output().samples() == VK_SAMPLE_COUNT_1_BIT) {
      outputs.push_back(&pass.targets.output());
    }
    if (pass.targets.depth) {
      depths.push_back(pass.targets.depth);
    }
  }
  const PassDesc& any = passes.front();
  if (!any.loadColor && !any.keepsSamples) {
    discard(samples);
  }
  if (!any.loadDepth && !(any.storeDepth && any.keepsSamples)) {
    discard(depths);
  }
  if (any.targets.role == TargetRole::swapchain && !any.loadColor) {
    discard(outputs);
  }
  const TargetBarriers kinds = barriersBefore(any.targets.role);
  barriers_.record(commands_, kinds.samples, samples);
  barriers_.record(commands_, kinds.color, outputs);
  barriers_.record(commands_, kinds.depth, depths);
}

SharedBarriers::~SharedBarriers() {
  const TargetRole role = passes_.front().targets.role;
  if (role == TargetRole::swapchain) {
    return;
  }
  const BarrierKind kind = passes_.front().pauses     ? BarrierKind::surfacesToShade
                           : role == TargetRole::main ? BarrierKind::mainToSample
                                                      : BarrierKind::offscreenToSample;
  std::vector<Image*> outputs;
  for (const PassDesc& pass : passes_) {
    outputs.push_back(&pass.targets.output());
  }
  barriers_.record(commands_, kind, outputs);
}

PassScope::PassScope(Device& device, RenderPassCache& renderPasses, RetireQueue& retired, GpuTimer& timer,
                     VkCommandBuffer commands, PassDesc desc)
    : device_(device),
      renderPasses_(renderPasses),
      retired_(retired),
      timer_(timer),
      commands_(commands),
      desc_(std::move(desc)),
      dynamic_(!desc_.inRenderPass && device.renderPath() == RenderPath::dynamic) {
  device_.beginLabel(commands_, desc_.name);
  timerSlot_ = timer_.begin(commands_, desc_.name, desc_.collectStatistics);
  begin();
}

void PassScope::begin() {
  if (desc_.overlay) {
    device_.barriers().record(commands_, BarrierKind::swapchainBeforeOverlay, *desc_.targets.color);
  } else if (!desc_.grouped) {
    group_.emplace(device_.barriers(), commands_, std::span(&desc_, 1));
  }
  if (dynamic_) {
    beginDynamic();
  } else {
    beginRenderPass();
  }
  rendering_ = true;  // only now: the destructor must not end what could not begin
  const VkViewport viewport{
      desc_.viewport.x, desc_.viewport.y, desc_.viewport.width, desc_.viewport.height, 0.0f, 1.0f};
  vkCmdSetViewport(commands_, 0, 1, &viewport);
  vkCmdSetScissor(commands_, 0, 1, &desc_.scissor);
  device_.functions().setFrontFace(commands_, desc_.frontFace);
  cull(VK_CULL_MODE_NONE);
}

void PassScope::drawLines(bool lines, float width) const {
  if (device_.functions().setPolygonMode) {
    device_.functions().setPolygonMode(commands_, lines ? VK_POLYGON_MODE_LINE : VK_POLYGON_MODE_FILL);
  }
  vkCmdSetLineWidth(commands_, lines ? device_.lineWidth(width) : 1.0f);
}

void PassScope::countSamples() {
  if (desc_.collectStatistics) {
    timer_.beginSamples(commands_, timerSlot_);
  }
}

void PassScope::end() {
  if (!std::exchange(rendering_, false)) {
    return;
  }
  if (dynamic_) {
    device_.functions().endRendering(commands_);
  } else {
    vkCmdEndRenderPass(commands_);
  }
  group_.reset();
}

void PassScope::pause() {
  timer_.endSamples(commands_, timerSlot_);
  end();
  timer_.endStatistics(commands_, timerSlot_);
}

void PassScope::resume(PassDesc desc) {
  desc_ = std::move(desc);
  begin();
}

PassScope::~PassScope() {
  pause();
  timer_.end(commands_, timerSlot_);
  device_.endLabel(commands_);
}

void PassScope::beginDynamic() {
  const PassTargets& targets = desc_.targets;
  VkRenderingAttachmentInfo color{
      .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
      .imageView = targets.color->view(),
      .imageLayout = desc_.overlay ? overlayLayout : VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
      .loadOp = desc_.loadColor ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR,
      .storeOp = storeOp(storesColor(desc_)),
      .clearValue = colorClear(desc_)};
  if (targets.resolve) {
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = targets.resolve->view();
    color.resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  }
  VkRenderingAttachmentInfo depth{.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  if (targets.depth) {
    depth.imageView = targets.depth->view();
    depth.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
    depth.loadOp = desc_.loadDepth ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR;
    depth.storeOp = storeOp(desc_.storeDepth);
    depth.clearValue = depthClear(desc_);
  }
  const VkRenderingInfo info{.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                             .renderArea = desc_.renderArea,
                             .layerCount = 1,
                             .colorAttachmentCount = 1,
                             .pColorAttachments = &color,
                             .pDepthAttachment = targets.depth ? &depth : nullptr};
  device_.functions().beginRendering(commands_, &info);
}

void PassScope::beginRenderPass() {
  const PassTargets& targets = desc_.targets;
  const VkRenderPass renderPass =
      renderPasses_.renderPass({.color = targets.color->format(),
                                .depth = targets.depth ? targets.depth->format() : VK_FORMAT_UNDEFINED,
                                .samples = targets.samples(),
                                .resolve = targets.resolve != nullptr,
                                .loadColor = desc_.loadColor,
                                .storeColor = storesColor(desc_),
                                .loadDepth = targets.depth && desc_.loadDepth,
                                .storeDepth = targets.depth && desc_.storeDepth,
                                .colorLayout = targets.color->layout()});
  std::vector<VkImageView> views = {targets.color->view()};
  std::vector<VkClearValue> clears = {colorClear(desc_)};
  if (targets.resolve) {
    views.push_back(targets.resolve->view());
    clears.emplace_back();
  }
  if (targets.depth) {
    views.push_back(targets.depth->view());
    clears.push_back(depthClear(desc_));
  }
  const VkExtent2D extent = targets.output().extent();
  FramebufferHandle framebuffer = device_.create(vkCreateFramebuffer,
                                                 {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                                  .renderPass = renderPass,
                                                  .attachmentCount = static_cast<uint32_t>(views.size()),
                                                  .pAttachments = views.data(),
                                                  .width = extent.width,
                                                  .height = extent.height,
                                                  .layers = 1},
                                                 desc_.name);
  const VkRenderPassBeginInfo info{.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO,
                                   .renderPass = renderPass,
                                   .framebuffer = framebuffer.get(),
                                   .renderArea = desc_.renderArea,
                                   .clearValueCount = static_cast<uint32_t>(clears.size()),
                                   .pClearValues = clears.data()};
  vkCmdBeginRenderPass(commands_, &info, VK_SUBPASS_CONTENTS_INLINE);
  retired_.retire(std::move(framebuffer));
}

}  // namespace speculum
