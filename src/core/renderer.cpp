#include "core/renderer.hpp"

#include <chrono>
#include <stdexcept>

#include "platform/files.hpp"

namespace speculum {

Renderer::Slot::Slot(Device& device, const std::string& name)
    : pool(device, name),
      acquired(device.create(vkCreateSemaphore, {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO},
                             name + " image acquired")),
      finished(device.create(vkCreateFence, {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO}, name + " finished")),
      descriptors(device),
      timer(device, name) {}

Renderer::Renderer(Device& device, const RendererOptions& options)
    : device_(device),
      window_(options.window),
      renderPasses_(device),
      shaders_(device, options.spirvDir.empty() ? dataDirectory("shaders") : options.spirvDir, options.shaderDir),
      pipelineCache_(device, options.pipelineCacheDir.value_or(userCacheDir())),
      uploader_(device),
      slots_{Slot(device, "frame in flight 0"), Slot(device, "frame in flight 1")},
      pipelines_(device, shaders_, renderPasses_, pipelineCache_, retired_),
      idle_(device) {
  if (window_) {
    swapChain_.emplace(device, *window_, options.presentMode);
  } else {
    headlessImage_ = makeDisplayImage(options.extent, headlessFormat);
  }
}

Image Renderer::makeDisplayImage(VkExtent2D extent, VkFormat format) {
  return Image(device_, {.extent = extent,
                         .format = format,
                         .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                         .name = "display image"});
}

void Renderer::resizeHeadless(VkExtent2D extent) {
  if (!headless()) {
    throw std::logic_error("resizeHeadless is for a renderer without a window");
  }
  retired_.retire(std::exchange(headlessImage_, makeDisplayImage(extent, headlessFormat)));
}

void Renderer::finish(Slot& slot) {
  if (slot.number == 0) {
    return;
  }
  device_.await(slot.finished.get(), "wait for a frame");
  slot.timings = slot.timer.read();
  retired_.collect(slot.number);
  slot.number = 0;
}

const FrameTimings* Renderer::timingsOf(uint64_t frame) const {
  const auto slot = std::ranges::find_if(slots_, [&](const Slot& s) { return s.timings.frame == frame; });
  return slot == slots_.end() ? nullptr : &slot->timings;
}

void Renderer::waitIdle() {
  const bool firstIsOlder = slots_[0].number < slots_[1].number;
  finish(slots_[firstIsOlder ? 0 : 1]);
  finish(slots_[firstIsOlder ? 1 : 0]);
  // While a frame is recorded its image is acquired but nothing waits for that yet. There the validation layer of
  // Debian 12 (1.3.239) crashes in vkDeviceWaitIdle, and the fences above have said all.
  if (!recording_) {
    device_.waitIdle();
  }
  // Objects retired while a frame is recorded may be in its commands.
  retired_.collect(recording_ ? frameNumber_ - 1 : frameNumber_);
}

std::optional<uint32_t> Renderer::acquireImage(Slot& slot) {
  if (headless()) {
    return 0;
  }
  if (window_->paused()) {
    return std::nullopt;
  }
  if (window_->takeResized() || swapChain_->stale()) {
    unusedImage_.reset();
    if (!swapChain_->recreate()) {
      return std::nullopt;
    }
  }
  if (unusedImage_) {
    return unusedImage_;
  }
  if (const std::optional<uint32_t> image = swapChain_->acquire(slot.acquired.get())) {
    return image;
  }
  // Recreates a swapchain that just became stale and tries once more in this frame.
  return swapChain_->stale() && swapChain_->recreate() ? swapChain_->acquire(slot.acquired.get()) : std::nullopt;
}

std::optional<Frame> Renderer::beginFrame() {
  const auto index = static_cast<uint32_t>((frameNumber_ + 1) % framesInFlight);
  Slot& slot = slots_[index];
  present();
  finish(slot);
  const std::optional<uint32_t> image = acquireImage(slot);
  if (!image) {
    return std::nullopt;
  }
  ++frameNumber_;
  recording_ = true;
  retired_.setFrame(frameNumber_);
  slot.descriptors.reset();
  const VkCommandBuffer commands = slot.pool.begin();
  slot.timer.reset(frameNumber_, timerDetail_);
  return Frame{.commands = commands,
               .index = index,
               .imageIndex = *image,
               .number = frameNumber_,
               .extent = displayExtent(),
               .descriptors = &slot.descriptors,
               .retired = &retired_,
               .acquired = !headless() && !unusedImage_};
}

bool Renderer::roundsSumsDown() {
  if (!roundsSumsDown_) {
    Image sum(device_, {.extent = {1, 1},
                        .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                        .name = "rounding"});
    const Pipeline pipeline(pipelines_, GraphicsPipelineDesc{.name = "rounding",
                                                             .vert = "full_screen.vert",
                                                             .frag = "sum_rounding.frag",
                                                             .depth = VK_FORMAT_UNDEFINED,
                                                             .adds = true});
    PassDesc desc = fullPass("rounding", {.color = &sum});
    desc.clearColor.fill(1.0f);
    GpuTimer timer(device_, desc.name);
    uploader_.run([&](VkCommandBuffer commands) {
      timer.reset(0, timerDetail_);
      const PassScope scope(device_, renderPasses_, retired_, timer, commands, desc);
      pipeline.bind(commands);
      vkCmdDraw(commands, 3, 1, 0, 0);
    });
    roundsSumsDown_ = uploader_.readFloats(sum)[0] == 1.0f;
  }
  return *roundsSumsDown_;
}

PassScope Renderer::beginPass(Frame& frame, const PassDesc& desc) {
  return PassScope(device_, renderPasses_, retired_, slots_[frame.index].timer, frame.commands, desc);
}

PassScope Renderer::beginOverlay(Frame& frame, bool inRenderPass) {
  PassDesc desc = fullPass("overlay", displayTargets(frame));
  desc.loadColor = true;
  desc.overlay = true;
  desc.inRenderPass = inRenderPass;
  return beginPass(frame, desc);
}

void Renderer::submitPart(Frame& frame) {
  Slot& slot = slots_[frame.index];
  slot.timer.finish(frame.commands);
  const VkCommandBuffer commands = std::exchange(frame.commands, VK_NULL_HANDLE);
  check(vkEndCommandBuffer(commands), "end a part of a frame's commands");
  const VkSubmitInfo info{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
  const auto start = std::chrono::steady_clock::now();
  device_.submit(info, slot.finished.get(), "submit a part of a frame");
  device_.await(slot.finished.get(), "wait for a part of a frame");
  frame.waitedMs += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  const VkCommandBuffer next = slot.pool.begin();
  slot.timer.resume();
  frame.commands = next;
}

void Renderer::captureNow(Frame& frame) {
  recordCapture(slots_[frame.index], frame);
  frame.captured = true;
}

void Renderer::endFrame(Frame& frame) {
  Slot& slot = slots_[frame.index];
  slot.timer.finish(frame.commands);
  if (frame.capture && !frame.captured) {
    recordCapture(slot, frame);
  }
  const bool presents = !headless() && (copiesDisplay() || !drawsAside(frame));
  if (presents) {
    if (copiesDisplay()) {
      copyToSwapChain(frame);
    }
    device_.barriers().record(frame.commands, BarrierKind::swapchainToPresent, swapChain_->image(frame.imageIndex));
  }
  check(vkEndCommandBuffer(frame.commands), "end a frame's commands");
  submit(slot, frame, presents);
  slot.number = frame.number;
  recording_ = false;
  unusedImage_ = headless() || presents ? std::nullopt : std::optional(frame.imageIndex);
  submittedImage_ = presents ? std::optional(frame.imageIndex) : std::nullopt;
}

void Renderer::copyToSwapChain(Frame& frame) {
  Image& picture = displayImage(frame);
  Image& shown = swapChain_->image(frame.imageIndex);
  device_.barriers().record(frame.commands, BarrierKind::readbackToCopy, picture);
  Barriers::acquiredToCopy(frame.commands, shown);
  const VkImageSubresourceLayers all{VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  const VkImageCopy region{
      .srcSubresource = all, .dstSubresource = all, .extent = {picture.extent().width, picture.extent().height, 1}};
  vkCmdCopyImage(frame.commands, picture.get(), picture.layout(), shown.get(), shown.layout(), 1, &region);
  device_.barriers().record(frame.commands, BarrierKind::readbackFromCopy, picture,
                            VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
}

void Renderer::present() {
  if (const std::optional<uint32_t> image = std::exchange(submittedImage_, std::nullopt)) {
    swapChain_->present(*image);
  }
}

void Renderer::submit(Slot& slot, const Frame& frame, bool presents) {
  const VkSemaphore acquired = slot.acquired.get();
  const VkSemaphore finished = presents ? swapChain_->renderFinished(frame.imageIndex) : VK_NULL_HANDLE;
  const VkPipelineStageFlags stage = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  const VkSubmitInfo info{.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO,
                          .waitSemaphoreCount = frame.acquired,
                          .pWaitSemaphores = &acquired,
                          .pWaitDstStageMask = &stage,
                          .commandBufferCount = 1,
                          .pCommandBuffers = &frame.commands,
                          .signalSemaphoreCount = presents,
                          .pSignalSemaphores = &finished};
  device_.submit(info, slot.finished.get(), "submit a frame");
}

Image& Renderer::displayImage(const Frame& frame) {
  if (!drawsAside(frame)) {
    return headless() ? headlessImage_ : swapChain_->image(frame.imageIndex);
  }
  if (!asideImage_ || !sameExtent(asideImage_.extent(), frame.extent)) {
    retired_.retire(std::exchange(asideImage_, makeDisplayImage(frame.extent, displayFormat())));
  }
  return asideImage_;
}

VkRenderPass Renderer::overlayRenderPass() {
  return renderPasses_.renderPass({.color = displayFormat(), .loadColor = true, .colorLayout = overlayLayout});
}

std::vector<PresentMode> Renderer::presentModes() const {
  return headless() ? std::vector<PresentMode>() : swapChain_->presentModes();
}

std::optional<PresentMode> Renderer::presentMode() const {
  return headless() ? std::nullopt : std::optional(swapChain_->presentMode());
}

void Renderer::setPresentMode(PresentMode mode) {
  if (!headless() && mode != swapChain_->presentMode()) {
    swapChain_->choosePresentMode(mode);
  }
}

void Renderer::recordCapture(Slot& slot, const Frame& frame) {
  Image& image = displayImage(frame);
  const VkExtent2D extent = image.extent();
  const VkDeviceSize bytes = 4 * areaOf(extent);
  if (slot.capture.bytes() != bytes) {
    slot.capture = Buffer(device_, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, BufferMemory::host, "capture");
  }
  slot.captureExtent = extent;
  captureSlot_ = frame.index;
  device_.barriers().record(frame.commands, BarrierKind::readbackToCopy, image);
  const VkBufferImageCopy region{.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                 .imageExtent = {extent.width, extent.height, 1}};
  vkCmdCopyImageToBuffer(frame.commands, image.get(), image.layout(), slot.capture.get(), 1, &region);
  device_.barriers().record(frame.commands, BarrierKind::readbackFromCopy, image,
                            VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  Barriers::copyToHost(frame.commands);
}

Pixels Renderer::readback() {
  if (!captureSlot_) {
    throw std::logic_error("readback needs a frame with `capture` set");
  }
  waitIdle();
  const Slot& slot = slots_[*captureSlot_];
  const auto* data = reinterpret_cast<const uint8_t*>(slot.capture.mapped());
  Pixels pixels{slot.captureExtent, {data, data + slot.capture.bytes()}};
  if (displayFormat() == VK_FORMAT_B8G8R8A8_UNORM) {
    for (size_t i = 0; i < pixels.rgba.size(); i += 4) {
      std::swap(pixels.rgba[i], pixels.rgba[i + 2]);
    }
  }
  return pixels;
}

}  // namespace speculum
