#include <spdlog/spdlog.h>

#include <chrono>
#include <functional>

#include "core_fixture.hpp"
#include "virtual_display.hpp"

namespace speculum::test {
namespace {

RendererOptions inWindow(Window& window, PresentMode mode = PresentMode::immediate) {
  RendererOptions options = headless({1, 1});
  options.window = &window;
  options.presentMode = mode;
  return options;
}

DeviceOptions deviceFor(Window& window, RenderPath path = RenderPath::automatic) {
  DeviceOptions options = validated(path);
  options.window = &window;
  return options;
}

// Polls the window's events until `done` holds; false after five seconds.
bool waitUntil(Window& window, const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!done()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    window.waitEvents(0.02);
  }
  return true;
}

class WindowTest : public testing::TestWithParam<RenderPath> {
 protected:
  VirtualDisplay display_;
  Window window_{WindowOptions{.title = "core test", .width = 320, .height = 200}};
};

TEST_P(WindowTest, DrawsFramesWithoutAMessageAndReadsThemBack) {
  Device device(deviceFor(window_, GetParam()));
  Renderer renderer(device, inWindow(window_));
  SmallScene scene(renderer, renderer.displayExtent(), 4);
  for (int i = 0; i < 50; ++i) {
    window_.pollEvents();
    ASSERT_TRUE(scene.frame(i == 49));
  }
  const Pixels pixels = renderer.readback();
  EXPECT_EQ(pixels.extent.width, renderer.displayExtent().width);
  const uint8_t* corner = &pixels.rgba[4 * (pixels.extent.width - 1)];
  EXPECT_EQ(corner[0], 64);
  EXPECT_EQ(corner[1], 32);
  EXPECT_EQ(corner[2], 191);
  EXPECT_EQ(device.validationMessages(), 0) << messagesOf(device);
}

TEST_P(WindowTest, TwoHundredResizesDownToOnePixelLeakNothing) {
  Device device(deviceFor(window_, GetParam()));
  Renderer renderer(device, inWindow(window_));
  SmallScene scene(renderer, renderer.displayExtent(), 4);
  const auto settle = [&](int width, int height) {
    window_.resize(width, height);
    return waitUntil(window_, [&] {
      scene.frame();
      const VkExtent2D extent = renderer.displayExtent();
      return extent.width == uint32_t(width) && extent.height == uint32_t(height);
    });
  };
  ASSERT_TRUE(settle(320, 200));
  ASSERT_TRUE(scene.frame() && scene.frame());
  renderer.waitIdle();
  const auto objects = liveObjects();
  const uint64_t bytes = device.allocatedBytes();
  uint32_t random = 7;
  for (int i = 0; i < 200; ++i) {
    random = random * 1664525 + 1013904223;
    window_.resize(1 + (random >> 24) % 200, 1 + (random >> 16) % 200);
    window_.pollEvents();
    scene.frame();
  }
  EXPECT_TRUE(settle(1, 1));
  EXPECT_TRUE(settle(320, 200));
  scene.frame();
  scene.frame();
  renderer.waitIdle();
  EXPECT_EQ(liveObjects(), objects);
  EXPECT_EQ(device.allocatedBytes(), bytes);
  EXPECT_EQ(device.validationMessages(), 0) << messagesOf(device);
}

TEST_P(WindowTest, IconifiedDrawsNothingAndComesBack) {
  Device device(deviceFor(window_, GetParam()));
  Renderer renderer(device, inWindow(window_));
  SmallScene scene(renderer, renderer.displayExtent(), 1);
  ASSERT_TRUE(scene.frame());
  window_.iconify();
  ASSERT_TRUE(waitUntil(window_, [&] { return window_.iconified(); }));
  const uint64_t before = renderer.frameNumber();
  for (int i = 0; i < 10; ++i) {
    window_.pollEvents();
    EXPECT_FALSE(scene.frame());
  }
  EXPECT_EQ(renderer.frameNumber(), before);
  window_.restore();
  ASSERT_TRUE(waitUntil(window_, [&] { return !window_.iconified(); }));
  EXPECT_TRUE(scene.frame());
  EXPECT_TRUE(scene.frame());
  EXPECT_EQ(device.validationMessages(), 0) << messagesOf(device);
}

INSTANTIATE_TEST_SUITE_P(Paths, WindowTest, testing::Values(RenderPath::dynamic, RenderPath::renderPass),
                         [](const auto& info) { return std::string(renderPathName(info.param)); });

TEST(WindowBarriers, PresentingIsMissedWhenItsBarrierIsLeftOut) {
  const VirtualDisplay display;
  Window window(WindowOptions{.width = 64, .height = 48});
  Device device(deviceFor(window, RenderPath::renderPass));
  Renderer renderer(device, inWindow(window));
  SmallScene scene(renderer, renderer.displayExtent(), 4);
  spdlog::set_level(spdlog::level::off);
  device.barriers().omit(BarrierKind::swapchainToPresent);
  scene.frame();
  renderer.waitIdle();
  spdlog::set_level(spdlog::level::info);
  const std::vector<std::string> messages = device.lastValidationMessages();
  ASSERT_FALSE(messages.empty());
  EXPECT_NE(messages.front().find("SYNC-HAZARD"), std::string::npos) << messages.front();
}

TEST(WindowOptions, FifoIsAlwaysThere) {
  const VirtualDisplay display;
  Window window(WindowOptions{.width = 64, .height = 48});
  Device device(deviceFor(window));
  const SwapChain chain(device, window, PresentMode::fifo);
  EXPECT_EQ(chain.presentMode(), PresentMode::fifo);
  EXPECT_GE(chain.imageCount(), 2u);
  EXPECT_EQ(device.validationMessages(), 0) << messagesOf(device);
}

TEST(WindowErrors, NoDisplaySaysWhatToDo) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  try {
    const Window window(WindowOptions{});
    FAIL() << "a window opened without a display";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("render command"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace speculum::test
