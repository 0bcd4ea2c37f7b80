#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/image.hpp"
#include "platform/window.hpp"

namespace speculum {

enum class PresentMode { fifo, mailbox, immediate };
std::string_view presentModeName(PresentMode mode);  // fifo, mailbox, immediate

// The window's images. Made anew when the window's size changes or the surface says so.
class SwapChain {
 public:
  SwapChain(Device& device, Window& window, PresentMode mode);

  // Recreates the chain after waiting until the device is idle. Recreates a lost surface, once. Returns false and
  // leaves the chain stale for a window without pixels.
  bool recreate();
  bool stale() const { return stale_; }  // must be recreated

  // Returns the index of an image for which `acquired` will be signalled; nothing when the chain is stale, or if no
  // image was free within a second, as may happen to a covered window. Logs once if that lasts for a minute.
  std::optional<uint32_t> acquire(VkSemaphore acquired);
  // Shows the image once its renderFinished() is signalled.
  void present(uint32_t image);

  VkExtent2D extent() const { return extent_; }
  VkFormat format() const { return format_; }  // UNORM, of what is drawn
  // Says whether the surface has sRGB formats only. They would encode once more what is drawn, so a picture of format()
  // is copied into an image instead, bit by bit.
  bool copied() const { return surfaceFormat_.format != format_; }
  PresentMode presentMode() const { return mode_; }  // in use: FIFO where the wanted one is missing
  std::vector<PresentMode> presentModes() const;     // that the surface offers
  // Sets the mode, or FIFO if the surface does not offer it, and makes the chain stale.
  void choosePresentMode(PresentMode wanted);
  bool copyable() const { return copyable_; }  // whether its images can be read back
  Image& image(uint32_t index) { return images_[index]; }
  uint32_t imageCount() const { return static_cast<uint32_t>(images_.size()); }
  VkSemaphore renderFinished(uint32_t index) const { return renderFinished_[index].get(); }

 private:
  void chooseFormat();
  void create();
  // Says whether a call on the chain succeeded; if its result means that the chain is stale, marks it so. Throws for
  // other errors.
  bool check(VkResult result, std::string_view what);

  Device& device_;
  Window& window_;
  PresentMode mode_ = PresentMode::fifo;
  bool stale_ = true;
  bool copyable_ = false;
  int timeouts_ = 0;  // of acquire(), one after the other
  VkSurfaceFormatKHR surfaceFormat_{};
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkExtent2D extent_{0, 0};
  SwapchainHandle swapchain_;
  std::vector<Image> images_;
  // One for each image: presentation may still wait on a semaphore when its frame in flight is used again.
  std::vector<SemaphoreHandle> renderFinished_;
};

}  // namespace speculum
