#include <GLFW/glfw3.h>

#include <chrono>

#include "core/fixture.hpp"
#include "error_message.hpp"
#include "log_capture.hpp"
#include "platform/process.hpp"
#include "test_paths.hpp"
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

// Polls the window's events until `done` holds; false after a minute, which only what hangs takes.
bool waitUntil(Window& window, const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
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
  void TearDown() override { EXPECT_EQ(device_.validationMessages(), 0); }

  VirtualDisplay display_;
  Window window_{WindowOptions{.title = "core test", .width = 320, .height = 200}};
  Device device_{deviceFor(window_, GetParam())};
  Renderer renderer_{device_, inWindow(window_)};
};

TEST_P(WindowTest, DrawnFramesAreReadBack) {
  SmallScene scene(renderer_, renderer_.displayExtent(), 4);
  for (int i = 0; i < 50; ++i) {
    window_.pollEvents();
    ASSERT_TRUE(scene.frame(i == 49));
  }
  const Pixels pixels = renderer_.readback();
  EXPECT_EQ(pixels.extent.width, renderer_.displayExtent().width);
  const uint8_t* corner = &pixels.rgba[4 * (pixels.extent.width - 1)];
  EXPECT_EQ(std::vector(corner, corner + 3), (std::vector<uint8_t>{64, 32, 191}));
}

TEST_P(WindowTest, ResizesDownToOnePixelLeakNothing) {
  SmallScene scene(renderer_, renderer_.displayExtent(), 4);
  const auto settle = [&](int width, int height) {
    window_.resize(width, height);
    return waitUntil(window_, [&] {
      scene.frame();
      const VkExtent2D extent = renderer_.displayExtent();
      return extent.width == uint32_t(width) && extent.height == uint32_t(height);
    });
  };
  ASSERT_TRUE(settle(320, 200));
  ASSERT_TRUE(scene.frame() && scene.frame());
  renderer_.waitIdle();
  const auto objects = liveObjects();
  const uint64_t bytes = device_.allocatedBytes();
  uint32_t random = 7;
  for (int i = 0; i < manyResizes(); ++i) {
    random = random * 1664525 + 1013904223;
    window_.resize(1 + (random >> 24) % 200, 1 + (random >> 16) % 200);
    window_.pollEvents();
    scene.frame();
  }
  EXPECT_TRUE(settle(1, 1));
  EXPECT_TRUE(settle(320, 200));
  scene.frame();
  scene.frame();
  renderer_.waitIdle();
  EXPECT_EQ(liveObjects(), objects);
  EXPECT_EQ(device_.allocatedBytes(), bytes);
}

TEST_P(WindowTest, IconifiedDrawsNothingAndComesBack) {
  SmallScene scene(renderer_, renderer_.displayExtent(), 1);
  ASSERT_TRUE(scene.frame());
  window_.iconify();
  ASSERT_TRUE(waitUntil(window_, [&] { return window_.iconified(); }));
  const uint64_t before = renderer_.frameNumber();
  for (int i = 0; i < 10; ++i) {
    window_.pollEvents();
    EXPECT_FALSE(scene.frame());
  }
  EXPECT_EQ(renderer_.frameNumber(), before);
  window_.restore();
  ASSERT_TRUE(waitUntil(window_, [&] { return !window_.iconified(); }));
  EXPECT_TRUE(scene.frame());
  EXPECT_TRUE(scene.frame());
}

INSTANTIATE_TEST_SUITE_P(Paths, WindowTest, testing::Values(RenderPath::dynamic, RenderPath::renderPass),
                         [](const auto& info) { return std::string(renderPathName(info.param)); });

TEST(WindowBarriers, MissingPresentBarrierIsReported) {
  const VirtualDisplay display;
  Window window(WindowOptions{.width = 64, .height = 48});
  Device device(deviceFor(window, RenderPath::renderPass));
  Renderer renderer(device, inWindow(window));
  SmallScene scene(renderer, renderer.displayExtent(), 4);
  const LogCapture log;  // the message is expected
  device.barriers().omit(BarrierKind::swapchainToPresent);
  scene.frame();
  renderer.waitIdle();
  EXPECT_TRUE(contains(log.validationMessage(), "SYNC-HAZARD")) << log.text();
}

TEST(WindowCapture, NeedsNoCopyableSwapchain) {
  const VirtualDisplay display;
  Window window(WindowOptions{.width = 64, .height = 48});
  const DeviceOptions options = deviceFor(window);
  setEnvironment("VK_ADD_LAYER_PATH", (binaryDir() / "tests" / "fault_layer").string());
  setEnvironment("VK_INSTANCE_LAYERS", "VK_LAYER_SPECULUM_fault");
  setEnvironment("SPECULUM_HIDE", "transfer_src");
  {
    Device device(options);
    Renderer renderer(device, inWindow(window));
    SmallScene scene(renderer, renderer.displayExtent(), 4);
    for (int i = 0; i < 9; ++i) {
      window.pollEvents();
      ASSERT_TRUE(scene.frame(i % 4 > 1)) << i;
    }
    const std::vector<uint8_t> pixels = renderer.readback().rgba;
    EXPECT_EQ(std::vector(pixels.begin(), pixels.begin() + 3), (std::vector<uint8_t>{64, 32, 191}));
    EXPECT_EQ(device.validationMessages(), 0);
  }
  unsetenv("VK_INSTANCE_LAYERS");
}

// What is read back is what is copied into the window.
TEST(WindowFormats, SurfacesWithSrgbOnlyShowTheSame) {
  const VirtualDisplay display;
  Window window(WindowOptions{.width = 64, .height = 48});
  const DeviceOptions options = deviceFor(window);
  const auto draw = [&](const std::string& hidden) {
    setEnvironment("VK_ADD_LAYER_PATH", (binaryDir() / "tests" / "fault_layer").string());
    setEnvironment("VK_INSTANCE_LAYERS", "VK_LAYER_SPECULUM_fault");
    setEnvironment("SPECULUM_HIDE", hidden);
    std::vector<uint8_t> pixels;
    {
      Device device(options);
      Renderer renderer(device, inWindow(window));
      EXPECT_EQ(renderer.copiesDisplay(), contains(hidden, "unorm_formats"));
      SmallScene scene(renderer, renderer.displayExtent(), 4);
      for (int i = 0; i < 9; ++i) {
        window.pollEvents();
        EXPECT_TRUE(scene.frame(i % 4 > 1)) << i;
      }
      pixels = renderer.readback().rgba;
      EXPECT_EQ(device.validationMessages(), 0);
    }
    unsetenv("VK_INSTANCE_LAYERS");
    return pixels;
  };
  const std::vector<uint8_t> plain = draw("");
  EXPECT_EQ(draw("unorm_formats"), plain);
  EXPECT_EQ(draw("unorm_formats transfer_src"), plain);
}

TEST(WindowLog, NewSwapchainsAndErrorsOfGlfwAreSaid) {
  const VirtualDisplay display;
  const LogCapture log;
  Window window(WindowOptions{.width = 64, .height = 48});
  Device device(deviceFor(window));
  Renderer renderer(device, inWindow(window));
  EXPECT_TRUE(contains(log.text(), "info: swapchain of ")) << log.text();
  EXPECT_TRUE(contains(log.text(), ", 64x48, immediate")) << log.text();
  window.resize(80, 60);
  ASSERT_TRUE(waitUntil(window, [&] {
    renderer.waitIdle();
    if (std::optional<Frame> frame = renderer.beginFrame()) {
      { const PassScope pass = renderer.beginPass(*frame, fullPass("test", renderer.displayTargets(*frame))); }
      renderer.endFrame(*frame);
    }
    return renderer.displayExtent().width == 80;
  }));
  EXPECT_TRUE(contains(log.text(), ", 80x60, immediate")) << log.text();
  glfwWindowHint(-1, 0);
  EXPECT_TRUE(contains(log.text(), "info: GLFW: Invalid window hint")) << log.text();
}

TEST(WindowOptions, FifoIsAlwaysOffered) {
  const VirtualDisplay display;
  Window window(WindowOptions{.width = 64, .height = 48});
  Device device(deviceFor(window));
  const SwapChain chain(device, window, PresentMode::fifo);
  EXPECT_EQ(chain.presentMode(), PresentMode::fifo);
  EXPECT_GE(chain.imageCount(), 2u);
  EXPECT_EQ(device.validationMessages(), 0);
}

// Tests characters of German, French, American and Russian keyboards.
TEST(WindowKeys, LettersFollowPrintFlyKeysFollowPlace) {
  EXPECT_EQ(meaningOfKey(Key::y, "z", true, "wasdqe"), Key::z);
  EXPECT_EQ(meaningOfKey(Key::z, "y", true, "wasdqe"), Key::y);
  EXPECT_EQ(meaningOfKey(Key::z, "w", true, "wasdqe"), Key::w);
  EXPECT_EQ(meaningOfKey(Key::w, "z", true, "wasdqe"), Key::z);
  EXPECT_EQ(meaningOfKey(Key::w, "z", false, "wasdqe"), Key::w) << "forwards";
  EXPECT_EQ(meaningOfKey(Key::a, "q", false, "wasdqe"), Key::a) << "left";
  EXPECT_EQ(meaningOfKey(Key::unknown, "m", false, "wasdqe"), Key::m);
  EXPECT_EQ(meaningOfKey(Key::m, ",", false, "wasdqe"), Key::comma);
  EXPECT_EQ(meaningOfKey(Key::b, "k", true, "wasdqe"), Key::unknown);
  EXPECT_EQ(meaningOfKey(Key::leftBracket, "\u00fc", false, "wasdqe"), Key::leftBracket);
  EXPECT_EQ(meaningOfKey(Key::comma, ";", false, "wasdqe"), Key::comma);
  EXPECT_EQ(meaningOfKey(Key::z, "Z", true, "wasdqe"), Key::z);
  EXPECT_EQ(meaningOfKey(Key::z, "\u044f", true, "wasdqe"), Key::z);
  EXPECT_EQ(meaningOfKey(Key::escape, "", true, "wasdqe"), Key::escape);
}

struct KeyboardLayout {
  const char* name;
  std::string printed;  // on the three rows of letters, "qwertyuiop[]asdfghjkl;'zxcvbnm,./" on an American keyboard
};
// ~ stands for a character that is not ASCII.
const KeyboardLayout layouts[] = {
    {"American", "qwertyuiop[]asdfghjkl;'zxcvbnm,./"}, {"German", "qwertzuiop~+asdfghjkl~~yxcvbnm,.-"},
    {"French", "azertyuiop^$qsdfghjklm~wxcvbn,;:!"},   {"Dvorak", "',.pyfgcrl/=aoeuidhtns-;qjkxbmwvz"},
    {"Colemak", "qwfpgjluy;[]arstdhneio'zxcvbkm,./"},  {"Bepo", "b~po~^vdljzwauie,ctsrnm~yx.k'qghf"}};
const std::string flyingKeys = "wasdqe";
const std::string shortcuts = "bcmfgnx,.";

Key keyAt(char american) {
  return meaningOfKey(Key::unknown, std::string(1, american), true, flyingKeys);
}

TEST(WindowKeys, ShortcutsAvoidFlyKeysOnEveryLayout) {
  for (const KeyboardLayout& layout : layouts) {
    const std::string& places = layouts[0].printed;
    std::string flying;
    for (const char key : flyingKeys) {
      flying += layout.printed[places.find(key)];
    }
    std::string reached;
    for (size_t i = 0; i < places.size(); ++i) {
      const std::string printed = layout.printed[i] == '~' ? "\u00e9" : layout.printed.substr(i, 1);
      const Key place = keyAt(places[i]);
      const Key meant = meaningOfKey(place, printed, false, flying);
      const bool flies = flyingKeys.find(places[i]) != std::string::npos;
      for (const char key : flyingKeys) {
        EXPECT_EQ(meant == keyAt(key), places[i] == key) << layout.name << ": " << printed;
      }
      for (const char shortcut : shortcuts) {
        reached += meant == keyAt(shortcut) ? std::string(1, shortcut) : "";
        if (printed[0] == shortcut && !flies) {
          EXPECT_EQ(meant, keyAt(shortcut)) << layout.name << ": " << printed;
        }
      }
    }
    for (const char shortcut : shortcuts) {
      EXPECT_TRUE(contains(reached, std::string(1, shortcut))) << layout.name << ": " << shortcut;
    }
  }
}

TEST(WindowMonitors, WindowsThatNoMonitorShowsAreRescued) {
  const std::vector<ScreenRect> two{{0, 30, 1920, 1050}, {1920, 0, 1280, 1024}};
  EXPECT_FALSE(rescuedWindow({100, 100, 800, 600}, two));
  EXPECT_FALSE(rescuedWindow({3100, 900, 800, 600}, two)) << "there is enough to take hold of";
  EXPECT_FALSE(rescuedWindow({5000, 100, 800, 600}, {})) << "nowhere to go";
  const std::vector<ScreenRect> one{two.front()};
  EXPECT_EQ(rescuedWindow({2000, 100, 800, 600}, one), (ScreenRect{560, 255, 800, 600}));
  EXPECT_EQ(rescuedWindow({1910, 100, 800, 600}, one), (ScreenRect{560, 255, 800, 600})) << "a sliver";
  EXPECT_EQ(rescuedWindow({0, -5000, 4000, 3000}, one), one.front()) << "no larger than what is there";
}

TEST(WindowMonitors, FullScreenEndsWithItsMonitor) {
  const VirtualDisplay display;
  Window window(WindowOptions{.width = 320, .height = 200});
  const std::vector<ScreenRect> monitors{{0, 0, 1280, 900}};
  const auto sized = [&](uint32_t width, uint32_t height) {
    return waitUntil(window, [&] { return window.size().width == width && window.size().height == height; });
  };
  ASSERT_TRUE(sized(320, 200));
  window.setFullScreen(true);
  ASSERT_TRUE(sized(1280, 900));
  // Does what GLFW does when a monitor goes, before it reports that.
  glfwSetWindowMonitor(window.native(), nullptr, 0, 0, 1280, 900, GLFW_DONT_CARE);
  ASSERT_FALSE(window.fullScreen());
  window.takeActivity();
  window.followMonitors(monitors);
  EXPECT_TRUE(sized(320, 200));
  EXPECT_TRUE(window.takeActivity());
  glfwSetWindowPos(window.native(), 700, 500);
  int x = 0;
  const auto at = [&](int wanted) {
    return waitUntil(window, [&] {
      glfwGetWindowPos(window.native(), &x, nullptr);
      return std::abs(x - wanted) < 5;
    });
  };
  ASSERT_TRUE(at(700)) << x;
  window.followMonitors(monitors);
  EXPECT_TRUE(at(700)) << x;
  const std::vector<ScreenRect> smaller{{0, 0, 640, 480}};
  window.followMonitors(smaller);
  EXPECT_TRUE(at(160)) << x;
  EXPECT_TRUE(sized(320, 200));
}

TEST(WindowErrors, NoDisplaySaysWhatToDo) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  EXPECT_TRUE(contains(messageOf([] { const Window window(WindowOptions{}); }), "with --out F.png"));
}

}  // namespace
}  // namespace speculum::test
