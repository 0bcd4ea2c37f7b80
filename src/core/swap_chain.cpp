#include "core/swap_chain.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <stdexcept>

namespace speculum {

namespace {

VkSurfaceCapabilitiesKHR capabilities(const Device& device) {
  VkSurfaceCapabilitiesKHR caps{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device.physical(), device.surface(), &caps), "query the surface");
  return caps;
}

VkExtent2D chooseExtent(const VkSurfaceCapabilitiesKHR& caps, const Window& window) {
  VkExtent2D extent = caps.currentExtent;
  if (extent.width == UINT32_MAX) {
    extent = window.framebufferExtent();
    if (extent.width == 0 || extent.height == 0) {
      return {0, 0};
    }
    extent.width = std::clamp(extent.width, caps.minImageExtent.width, caps.maxImageExtent.width);
    extent.height = std::clamp(extent.height, caps.minImageExtent.height, caps.maxImageExtent.height);
  }
  return extent;
}

// At least three: one is shown, one waits, one is drawn.
uint32_t chooseImageCount(const VkSurfaceCapabilitiesKHR& caps) {
  const uint32_t wanted = std::max(caps.minImageCount, 3u);
  return caps.maxImageCount == 0 ? wanted : std::min(wanted, caps.maxImageCount);
}

VkCompositeAlphaFlagBitsKHR chooseAlpha(const VkSurfaceCapabilitiesKHR& caps) {
  return caps.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                                                                          : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
}

VkPresentModeKHR vulkanMode(PresentMode mode) {
  return mode == PresentMode::mailbox     ? VK_PRESENT_MODE_MAILBOX_KHR
         : mode == PresentMode::immediate ? VK_PRESENT_MODE_IMMEDIATE_KHR
                                          : VK_PRESENT_MODE_FIFO_KHR;
}

}  // namespace

std::string_view presentModeName(PresentMode mode) {
  return mode == PresentMode::mailbox ? "mailbox" : mode == PresentMode::immediate ? "immediate" : "fifo";
}

SwapChain::SwapChain(Device& device, Window& window, PresentMode mode) : device_(device), window_(window) {
  chooseFormat();
  choosePresentMode(mode);
  recreate();
}

void SwapChain::chooseFormat() {
  const auto formats = enumerate<VkSurfaceFormatKHR>("list formats", vkGetPhysicalDeviceSurfaceFormatsKHR,
                                                     device_.physical(), device_.surface());
  for (const auto& [offered, drawn] : {std::pair{VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_B8G8R8A8_UNORM},
                                       {VK_FORMAT_R8G8B8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM},
                                       {VK_FORMAT_B8G8R8A8_SRGB, VK_FORMAT_B8G8R8A8_UNORM},
                                       {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_R8G8B8A8_UNORM}}) {
    for (const VkSurfaceFormatKHR& format : formats) {
      if (format.format == offered && format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR) {
        surfaceFormat_ = format;
        format_ = drawn;
        return;
      }
    }
  }
  throw std::runtime_error("the window's surface has no format of 8 bits, UNORM or sRGB (use the render command)");
}

std::vector<PresentMode> SwapChain::presentModes() const {
  const auto modes = enumerate<VkPresentModeKHR>("list present modes", vkGetPhysicalDeviceSurfacePresentModesKHR,
                                                 device_.physical(), device_.surface());
  std::vector<PresentMode> offered;
  for (const PresentMode mode : {PresentMode::fifo, PresentMode::mailbox, PresentMode::immediate}) {
    if (std::ranges::find(modes, vulkanMode(mode)) != modes.end()) {
      offered.push_back(mode);
    }
  }
  return offered;
}

void SwapChain::choosePresentMode(PresentMode wanted) {
  const std::vector<PresentMode> offered = presentModes();
  const bool present = std::ranges::find(offered, wanted) != offered.end();
  mode_ = present ? wanted : PresentMode::fifo;
  stale_ = true;
  if (!present) {
    spdlog::warn("the wanted present mode is not available here; FIFO is used");
  }
}

bool SwapChain::recreate() {
  device_.waitIdle();
  try {
    create();
  } catch (const SurfaceLostError&) {
    device_.renewSurface(window_);
    create();
  }
  return !stale_;
}

void SwapChain::create() {
  images_.clear();
  renderFinished_.clear();
  stale_ = true;
  const SwapchainHandle old = std::move(swapchain_);
  const VkSurfaceCapabilitiesKHR caps = capabilities(device_);
  extent_ = chooseExtent(caps, window_);
  if (extent_.width == 0 || extent_.height == 0) {
    return;
  }
  copyable_ = caps.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  if (copied() && !(caps.supportedUsageFlags & VK_IMAGE_USAGE_TRANSFER_DST_BIT)) {
    throw std::runtime_error(
        "the window's surface has sRGB formats only, into which no picture can be copied (use the render command)");
  }
  const VkImageUsageFlags copies =
      (copyable_ ? VK_IMAGE_USAGE_TRANSFER_SRC_BIT : 0) | (copied() ? VK_IMAGE_USAGE_TRANSFER_DST_BIT : 0);
  const uint32_t families[] = {device_.queueFamily(), device_.presentFamily()};
  const bool shared = families[0] != families[1];
  const VkSwapchainCreateInfoKHR info{
      .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
      .surface = device_.surface(),
      .minImageCount = chooseImageCount(caps),
      .imageFormat = surfaceFormat_.format,
      .imageColorSpace = surfaceFormat_.colorSpace,
      .imageExtent = extent_,
      .imageArrayLayers = 1,
      .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | copies,
      .imageSharingMode = shared ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE,
      .queueFamilyIndexCount = shared ? 2u : 0u,
      .pQueueFamilyIndices = families,
      .preTransform = caps.currentTransform,
      .compositeAlpha = chooseAlpha(caps),
      .presentMode = vulkanMode(mode_),
      .clipped = VK_TRUE,
      .oldSwapchain = old.get()};
  const auto createSwapchain = [](auto... arguments) {
    const std::shared_lock lock(loaderMutex());
    return vkCreateSwapchainKHR(arguments...);
  };
  swapchain_ = device_.create<VkSwapchainCreateInfoKHR, VkSwapchainKHR>(createSwapchain, info, "swapchain");
  for (VkImage image :
       enumerate<VkImage>("list swapchain images", vkGetSwapchainImagesKHR, device_.get(), swapchain_.get())) {
    const std::string name = "swapchain image " + std::to_string(images_.size());
    images_.emplace_back(device_, image, ImageDesc{.extent = extent_, .format = surfaceFormat_.format, .name = name});
    renderFinished_.push_back(device_.create(vkCreateSemaphore, {.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO},
                                             name + " render finished"));
  }
  stale_ = false;
  spdlog::info("swapchain of {} images, {}x{}, {}{}", images_.size(), extent_.width, extent_.height,
               presentModeName(mode_), copied() ? ", sRGB" : "");
}

bool SwapChain::check(VkResult result, std::string_view what) {
  if (result == VK_SUCCESS || result == VK_TIMEOUT || result == VK_NOT_READY) {
    return result == VK_SUCCESS;
  }
  if (result != VK_ERROR_OUT_OF_DATE_KHR && result != VK_ERROR_SURFACE_LOST_KHR && result != VK_SUBOPTIMAL_KHR) {
    throwVulkanError(result, what);
  }
  stale_ = true;
  return result == VK_SUBOPTIMAL_KHR;
}

std::optional<uint32_t> SwapChain::acquire(VkSemaphore acquired) {
  constexpr uint64_t patience = 1'000'000'000;  // nanoseconds
  uint32_t index = 0;
  const VkResult result =
      vkAcquireNextImageKHR(device_.get(), swapchain_.get(), patience, acquired, VK_NULL_HANDLE, &index);
  timeouts_ = result == VK_TIMEOUT || result == VK_NOT_READY ? timeouts_ + 1 : 0;
  if (timeouts_ == 60) {
    spdlog::warn("the window has got no image to draw into for a minute: is it covered?");
  }
  // A suboptimal image is still drawn: the semaphore will be signalled.
  return check(result, "acquire a swapchain image") ? std::optional(index) : std::nullopt;
}

void SwapChain::present(uint32_t image) {
  const VkSemaphore finished = renderFinished(image);
  const VkSwapchainKHR swapchain = swapchain_.get();
  const VkPresentInfoKHR info{.sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
                              .waitSemaphoreCount = 1,
                              .pWaitSemaphores = &finished,
                              .swapchainCount = 1,
                              .pSwapchains = &swapchain,
                              .pImageIndices = &image};
  check(vkQueuePresentKHR(device_.presentQueue(), &info), "present");
}

}  // namespace speculum
