#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "core/descriptors.hpp"
#include "core/gpu_timer.hpp"
#include "core/off_screen.hpp"
#include "core/pipeline.hpp"
#include "core/swap_chain.hpp"
#include "core/uploader.hpp"

namespace speculum {

inline constexpr uint32_t framesInFlight = 2;

struct RendererOptions {
  Window* window = nullptr;      // null: an image of `extent` takes the swapchain's place
  VkExtent2D extent{1280, 720};  // headless only
  PresentMode presentMode = PresentMode::fifo;
  std::filesystem::path spirvDir;                         // empty: dataDirectory("shaders")
  std::filesystem::path shaderDir;                        // GLSL to watch; empty: none
  std::optional<std::filesystem::path> pipelineCacheDir;  // none: userCacheDir(); empty path: no file
};

// Display-referred pixels as they were in the swapchain image: RGBA, 8 bits each, rows from the top.
struct Pixels {
  VkExtent2D extent{0, 0};
  std::vector<uint8_t> rgba;
};

class Renderer;

// A frame that is being recorded. Valid from beginFrame to endFrame.
struct Frame {
  VkCommandBuffer commands = VK_NULL_HANDLE;   // null once Renderer::submitPart has failed: the frame cannot end
  uint32_t index = 0;                          // frame in flight, 0 or 1: choose per-frame buffers by it
  uint32_t imageIndex = 0;                     // index of the swapchain's image; 0 when headless
  uint64_t number = 0;                         // counts from 1
  VkExtent2D extent{0, 0};                     // of the display image
  DescriptorAllocator* descriptors = nullptr;  // sets from it live for this frame only
  RetireQueue* retired = nullptr;
  bool capture = false;   // set it before the display image is drawn to make Renderer::readback possible
  bool captured = false;  // by Renderer::captureNow
  bool acquired = false;  // a swapchain image is acquired for this frame
  double waitedMs = 0.0;  // time spent waiting for the GPU within the frame
};

// Two frames in flight on one queue, into a window's swapchain or an image in its place. Frames are ordered by
// barriers.
class Renderer {
 public:
  Renderer(Device& device, const RendererOptions& options);
  ~Renderer() = default;
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Waits for the GPU as beginFrame() does, but not for the window. Input that is read afterwards is as new as the
  // frame can show.
  void waitForFrame() { finish(slots_[(frameNumber_ + 1) % framesInFlight]); }
  // Begins a frame once the GPU has finished the frame before the last one. Returns nothing while the window is paused
  // or gives no swapchain image.
  std::optional<Frame> beginFrame();
  // Begins a pass of the frame. It ends when the scope is destroyed.
  PassScope beginPass(Frame& frame, const PassDesc& desc);
  // Begins the pass that draws over the display image, which it loads and stores. `inRenderPass`: within a VkRenderPass
  // on either render path.
  PassScope beginOverlay(Frame& frame, bool inRenderPass);
  // Submits the frame's commands so far, so that no submission takes long, and waits until the GPU has finished them,
  // which bounds the memory of many parts. Call it between two passes; `frame.commands` changes.
  void submitPart(Frame& frame);
  // Captures the display image as it is. What is drawn over it later is shown, but readback() does not return it. Call
  // it between two passes of a frame that has `capture` set.
  void captureNow(Frame& frame);
  // Submits the frame's commands.
  void endFrame(Frame& frame);
  // Shows the frame submitted last. Mesa's drivers for CPUs draw it and send it to the window system within this call,
  // so that whatever needs neither its picture nor new events is best done between endFrame() and present(). The
  // next beginFrame() calls it if nobody has.
  void present();

  // Returns the display image as targets of a pass: UNORM color, no depth, TargetRole::swapchain.
  PassTargets displayTargets(Frame& frame) { return {.color = &displayImage(frame), .role = TargetRole::swapchain}; }
  // Says whether pictures are copied into the window's images, which are sRGB.
  bool copiesDisplay() const { return !headless() && swapChain_->copied(); }
  VkFormat displayFormat() const { return headless() ? headlessFormat : swapChain_->format(); }
  VkExtent2D displayExtent() const { return headless() ? headlessImage_.extent() : swapChain_->extent(); }
  // At least 2, which Dear ImGui requires.
  uint32_t displayImageCount() const { return std::max(framesInFlight, headless() ? 1 : swapChain_->imageCount()); }
  // Returns a render pass that fits beginOverlay(). It may change when displayFormat() does.
  VkRenderPass overlayRenderPass();
  // Present modes of the window; none when headless. A new mode applies from the next frame on.
  std::vector<PresentMode> presentModes() const;
  std::optional<PresentMode> presentMode() const;
  void setPresentMode(PresentMode mode);
  // Throws std::logic_error if there is a window.
  void resizeHeadless(VkExtent2D extent);

  // Returns the display image of the last frame that had `capture` set. Waits for the GPU. Throws std::logic_error if
  // there was no such frame.
  Pixels readback();
  void waitIdle();  // also collects timings and retired objects

  // Timings of the last frame that has finished; after waitIdle() that is the last one recorded.
  const FrameTimings& timings() const {
    return (slots_[0].timings.frame > slots_[1].timings.frame ? slots_[0] : slots_[1]).timings;
  }
  // Timings of frame number `frame`; null unless it has finished and is one of the last two.
  const FrameTimings* timingsOf(uint64_t frame) const;
  // Applies to frames that begin from now on. TimerDetail::samples at first.
  void setTimerDetail(TimerDetail detail) { timerDetail_ = detail; }
  uint64_t frameNumber() const { return frameNumber_; }
  // Rebuilds pipelines whose shaders changed on disk, and says whether there were any. Call it between frames. Cheap
  // when no directory is watched.
  bool reloadShaders() { return pipelines_.reload(); }

  // Says whether the device rounds down when it adds to a 16-bit float target or averages its samples. Draws one pixel
  // to find out, when it is first asked, and waits for the GPU then.
  bool roundsSumsDown();

  Device& device() { return device_; }
  PipelineFactory& pipelines() { return pipelines_; }
  Uploader& uploader() { return uploader_; }
  RetireQueue& retired() { return retired_; }
  bool headless() const { return !swapChain_; }
  PipelineCache& pipelineCache() { return pipelineCache_; }

 private:
  static constexpr VkFormat headlessFormat = VK_FORMAT_R8G8B8A8_UNORM;
  struct Slot {
    Slot(Device& device, const std::string& name);
    CommandPool pool;
    SemaphoreHandle acquired;
    FenceHandle finished;
    DescriptorAllocator descriptors;
    GpuTimer timer;
    FrameTimings timings;  // of the frame finished last
    uint64_t number = 0;   // of the frame submitted last; 0: none is pending
    Buffer capture;
    VkExtent2D captureExtent{0, 0};
  };
  void finish(Slot& slot);
  std::optional<uint32_t> acquireImage(Slot& slot);
  Image& displayImage(const Frame& frame);
  // Says whether the frame is drawn into an image of its own, because the swapchain's cannot be copied or is sRGB.
  bool drawsAside(const Frame& frame) const {
    return !headless() && (swapChain_->copied() || (frame.capture && !swapChain_->copyable()));
  }
  void copyToSwapChain(Frame& frame);
  void recordCapture(Slot& slot, const Frame& frame);
  void submit(Slot& slot, const Frame& frame, bool presents);
  Image makeDisplayImage(VkExtent2D extent, VkFormat format);

  Device& device_;
  Window* window_;
  RenderPassCache renderPasses_;
  ShaderLibrary shaders_;
  PipelineCache pipelineCache_;
  Uploader uploader_;
  std::optional<SwapChain> swapChain_;
  Image headlessImage_;
  Image asideImage_;
  std::optional<uint32_t> unusedImage_;     // of the swapchain: acquired for a frame that was drawn aside
  std::optional<uint32_t> submittedImage_;  // of the swapchain: not presented yet
  std::array<Slot, framesInFlight> slots_;
  RetireQueue retired_;
  PipelineFactory pipelines_;
  TimerDetail timerDetail_ = TimerDetail::samples;
  uint64_t frameNumber_ = 0;
  bool recording_ = false;
  std::optional<bool> roundsSumsDown_;
  std::optional<uint32_t> captureSlot_;  // slot of the latest capture
  IdleGuard idle_;
};

}  // namespace speculum
