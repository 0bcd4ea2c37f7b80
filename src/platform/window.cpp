#include "platform/window.hpp"

#include <GLFW/glfw3.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "platform/process.hpp"
#include "platform/text.hpp"
#include "vulkan_loader.hpp"

namespace speculum {

namespace {

// GLFW's codes in the order of GamepadButton.
constexpr std::array<int, static_cast<size_t>(GamepadButton::count)> buttonCodes{
    GLFW_GAMEPAD_BUTTON_A,          GLFW_GAMEPAD_BUTTON_B,           GLFW_GAMEPAD_BUTTON_X,
    GLFW_GAMEPAD_BUTTON_Y,          GLFW_GAMEPAD_BUTTON_LEFT_BUMPER, GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER,
    GLFW_GAMEPAD_BUTTON_BACK,       GLFW_GAMEPAD_BUTTON_START,       GLFW_GAMEPAD_BUTTON_LEFT_THUMB,
    GLFW_GAMEPAD_BUTTON_RIGHT_THUMB};

static_assert(static_cast<int>(Key::leftBracket) == GLFW_KEY_LEFT_BRACKET &&
                  static_cast<int>(Key::rightBracket) == GLFW_KEY_RIGHT_BRACKET &&
                  static_cast<int>(Key::tab) == GLFW_KEY_TAB && static_cast<int>(Key::del) == GLFW_KEY_DELETE &&
                  static_cast<int>(Key::f2) == GLFW_KEY_F2 && static_cast<int>(Key::f12) == GLFW_KEY_F12 &&
                  static_cast<int>(Key::leftControl) == GLFW_KEY_LEFT_CONTROL &&
                  static_cast<int>(Key::rightControl) == GLFW_KEY_RIGHT_CONTROL,
              "codes of Key are GLFW's");

// Returns the character on a key; empty for keys without one.
std::string_view printedOn(int code, int scancode) {
  const bool character = code >= GLFW_KEY_SPACE && code <= GLFW_KEY_WORLD_2;
  const char* name = character ? glfwGetKeyName(code, scancode) : nullptr;
  return name ? name : "";
}

// Returns the characters on the keys that fly, in the present layout.
std::string printedWhereFlying() {
  std::string printed;
  for (const int code : {GLFW_KEY_W, GLFW_KEY_A, GLFW_KEY_S, GLFW_KEY_D, GLFW_KEY_Q, GLFW_KEY_E}) {
    printed += printedOn(code, 0);
  }
  return printed;
}

VkExtent2D extentOf(int width, int height) {
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

bool isCommand(int key, int modifiers) {
  const bool modifier = key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
  const bool character = key > GLFW_KEY_SPACE && key <= GLFW_KEY_WORLD_2;  // Space presses widgets
  return !modifier && (!character || (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) != 0);
}

// Returns the key for shortcuts of text fields, by its printed letter. Typed text comes as characters.
int meantCode(int key, std::string_view printed) {
  const bool letter = printed.size() == 1 && printed[0] >= 'a' && printed[0] <= 'z';
  return letter ? GLFW_KEY_A + (printed[0] - 'a') : key;
}

std::vector<ScreenRect> workAreas() {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  std::vector<ScreenRect> areas(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    ScreenRect& area = areas[i];
    glfwGetMonitorWorkarea(monitors[i], &area.x, &area.y, &area.width, &area.height);
  }
  return areas;
}

// All windows: GLFW reports changes of monitors without naming a window.
std::vector<Window*>& openWindows() {
  static std::vector<Window*> windows;
  return windows;
}

// Returns the monitor under the window's centre, or the first one if none is there; null without monitors.
GLFWmonitor* monitorUnder(const ScreenRect& window) {
  const int x = window.x + window.width / 2;
  const int y = window.y + window.height / 2;
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    int left = 0;
    int top = 0;
    glfwGetMonitorPos(monitors[i], &left, &top);
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    if (mode && x >= left && y >= top && x < left + mode->width && y < top + mode->height) {
      return monitors[i];
    }
  }
  return count > 0 ? monitors[0] : nullptr;
}

[[noreturn]] void fail(const std::string& what, const std::string& remedy) {
  const char* description = nullptr;
  glfwGetError(&description);
  throw std::runtime_error(what + (description ? std::string(": ") + description : "") + " (" + remedy + ")");
}

[[noreturn]] void failAtSurface(const std::string& what) {
  fail(what, "install the driver of the graphics card, or Mesa's: mesa-vulkan-drivers");
}

constexpr int grip = 48;  // width and height in pixels of a window's visible part by which a user can move it

int overlap(int a, int aSize, int b, int bSize) {
  return std::min(a + aSize, b + bSize) - std::max(a, b);
}

bool canBeGripped(const ScreenRect& window, const ScreenRect& area) {
  return overlap(window.x, window.width, area.x, area.width) >= std::min(grip, window.width) &&
         overlap(window.y, window.height, area.y, area.height) >= std::min(grip, window.height);
}

}  // namespace

std::optional<ScreenRect> rescuedWindow(const ScreenRect& window, std::span<const ScreenRect> workAreas) {
  if (workAreas.empty() ||
      std::ranges::any_of(workAreas, [&](const ScreenRect& area) { return canBeGripped(window, area); })) {
    return std::nullopt;
  }
  const ScreenRect& area = workAreas.front();
  const int width = std::min(window.width, area.width);
  const int height = std::min(window.height, area.height);
  return ScreenRect{area.x + (area.width - width) / 2, area.y + (area.height - height) / 2, width, height};
}

void chooseWindowPlatform(const std::optional<std::string>& platform) {
  const bool wayland = platform == "wayland";
#if GLFW_VERSION_MAJOR > 3 || GLFW_VERSION_MINOR >= 4
  // Wayland's library complains on standard error if it is tried without this variable.
  if (platform || (glfwPlatformSupported(GLFW_PLATFORM_X11) && environment("XDG_RUNTIME_DIR").empty())) {
    glfwInitHint(GLFW_PLATFORM, wayland ? GLFW_PLATFORM_WAYLAND : GLFW_PLATFORM_X11);
  }
#else
  const std::string installed = glfwGetVersionString();
  if (platform && installed.find(wayland ? "Wayland" : "X11") == std::string::npos) {
    throw std::runtime_error("--platform: GLFW is installed as '" + installed + "' (install " +
                             (wayland ? "libglfw3-wayland" : "libglfw3") + " for " + *platform + ")");
  }
#endif
}

void onDisplayLost(void (*last)()) {
  static void (*called)() = nullptr;
  called = last;
  using Handler = int (*)(void* display);
  // GLFW has loaded X11's library if windows use X11.
  if (const auto setHandler =
          reinterpret_cast<Handler (*)(Handler)>(loadedFunction("libX11.so.6", "XSetIOErrorHandler"))) {
    setHandler([](void*) {
      called();
      return 0;
    });
  }
}

Window::Library::Library() {
  // No warning: GLFW reports what a window system lacks too, and what ends the program is said there.
  // Each is said once, because under Wayland every frame asks for something that it lacks, the window's position.
  glfwSetErrorCallback([](int, const char* text) {
    static std::set<std::string> said;
    if (said.insert(text).second) {
      spdlog::info("GLFW: {}", oneLine(text));
    }
  });
  if (!glfwInit()) {
    fail("no window system",
         "is DISPLAY set? without a display, `speculum render` and examples write a picture with --out F.png");
  }
}

Window::Library::~Library() {
  glfwTerminate();
}

void Window::Destroy::operator()(GLFWwindow* window) const {
  glfwDestroyWindow(window);
}

Window::Window(const WindowOptions& options) {
  findVulkanFunction("vkGetInstanceProcAddr");  // throws, with what to install, if there is no loader
  if (!glfwVulkanSupported()) {
    failAtSurface("the window system offers no Vulkan surface");
  }
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
  // By these names desktops find the file speculum.desktop, and with it the window's icon.
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "speculum");
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "speculum");
#ifdef GLFW_WAYLAND_APP_ID
  glfwWindowHintString(GLFW_WAYLAND_APP_ID, "speculum");
#endif
  window_.reset(glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr));
  if (!window_) {
    fail("the window could not be opened",
         "without a display, `speculum render` and examples write a picture with --out F.png");
  }
  float unused = 1.0f;
  glfwGetWindowContentScale(window_.get(), &contentScale_, &unused);
  readSizes();
  installCallbacks();
  openWindows().push_back(this);
}

Window::~Window() {
  listener_ = {};  // what it calls may be gone
  std::erase(openWindows(), this);
}

Window* Window::of(GLFWwindow* window) {
  return static_cast<Window*>(glfwGetWindowUserPointer(window));
}

void Window::installCallbacks() {
  glfwSetWindowUserPointer(window_.get(), this);
  // Under Wayland, GLFW calls only the first of these two for a size that the program has set.
  glfwSetFramebufferSizeCallback(window_.get(), [](GLFWwindow* w, int, int) {
    of(w)->readSizes();
    of(w)->resized_ = of(w)->active_ = true;
  });
  glfwSetWindowSizeCallback(window_.get(), [](GLFWwindow* w, int, int) { of(w)->readSizes(); });
  glfwSetWindowRefreshCallback(window_.get(), [](GLFWwindow* w) { of(w)->active_ = true; });
  glfwSetWindowFocusCallback(window_.get(), [](GLFWwindow* w, int focused) {
    of(w)->notify({.kind = InputEvent::Kind::focus, .down = focused == GLFW_TRUE});
  });
  glfwSetWindowIconifyCallback(window_.get(), [](GLFWwindow* w, int iconified) {
    of(w)->iconified_ = iconified == GLFW_TRUE;
    of(w)->active_ = true;
  });
  glfwSetWindowCloseCallback(window_.get(), [](GLFWwindow* w) { of(w)->active_ = true; });
  glfwSetCursorEnterCallback(window_.get(), [](GLFWwindow* w, int entered) {
    of(w)->notify({.kind = InputEvent::Kind::enter, .down = entered == GLFW_TRUE});
  });
  glfwSetCharCallback(window_.get(), [](GLFWwindow* w, unsigned character) {
    of(w)->notify({.kind = InputEvent::Kind::text, .code = static_cast<int>(character)});
  });
  glfwSetWindowContentScaleCallback(window_.get(), [](GLFWwindow* w, float x, float) { of(w)->followContentScale(x); });
  glfwSetMonitorCallback([](GLFWmonitor*, int) {
    for (Window* window : openWindows()) {
      window->followMonitors(workAreas());
    }
  });
  glfwSetKeyCallback(window_.get(), [](GLFWwindow* w, int code, int scancode, int action, int modifiers) {
    // Copies the name, because the next call of glfwGetKeyName may overwrite it.
    const std::string printed(printedOn(code, scancode));
    const bool control = (modifiers & GLFW_MOD_CONTROL) != 0;
    if (action == GLFW_PRESS && control) {
      of(w)->withControl_.insert(code);
    } else if (action != GLFW_REPEAT) {
      of(w)->withControl_.erase(code);
    }
    of(w)->notify(
        {.kind = InputEvent::Kind::key,
         .code = meantCode(code, printed),
         .down = action != GLFW_RELEASE,
         .command = isCommand(code, modifiers),
         .key = {meaningOfKey(static_cast<Key>(code), printed, control, printedWhereFlying()), action != GLFW_RELEASE,
                 action == GLFW_REPEAT, (modifiers & GLFW_MOD_SHIFT) != 0, control, (modifiers & GLFW_MOD_ALT) != 0}});
  });
  glfwSetMouseButtonCallback(window_.get(), [](GLFWwindow* w, int button, int action, int modifiers) {
    of(w)->notify({.kind = InputEvent::Kind::button,
                   .code = button,
                   .down = action == GLFW_PRESS,
                   .shift = (modifiers & GLFW_MOD_SHIFT) != 0});
  });
  glfwSetCursorPosCallback(window_.get(), [](GLFWwindow* w, double x, double y) {
    of(w)->notify({.kind = InputEvent::Kind::pointer, .x = x, .y = y});
  });
  glfwSetDropCallback(window_.get(), [](GLFWwindow* w, int count, const char** names) {
    of(w)->notify({.kind = InputEvent::Kind::drop, .dropped = {names, names + count}});
  });
  glfwSetScrollCallback(window_.get(), [](GLFWwindow* w, double dx, double dy) {
    of(w)->notify({.kind = InputEvent::Kind::wheel, .x = dx, .y = dy});
  });
}

void Window::readSizes() {
  int width = 0;
  int height = 0;
  glfwGetFramebufferSize(window_.get(), &width, &height);
  framebuffer_ = extentOf(width, height);
  glfwGetWindowSize(window_.get(), &width, &height);
  size_ = extentOf(width, height);
}

void Window::notify(const InputEvent& event) {
  active_ = true;
  if (listener_) {
    listener_(event);
  }
}

void Window::pollEvents() {
  glfwPollEvents();
}

void Window::waitEvents(double timeoutSeconds) {
  glfwWaitEventsTimeout(timeoutSeconds);
}

bool Window::shouldClose() const {
  return glfwWindowShouldClose(window_.get());
}

void Window::requestClose() {
  glfwSetWindowShouldClose(window_.get(), GLFW_TRUE);
}

void Window::refuseClose() {
  glfwSetWindowShouldClose(window_.get(), GLFW_FALSE);
}

void Window::resize(int width, int height) {
  glfwSetWindowSize(window_.get(), width, height);
}

double Window::refreshRate() const {
  GLFWmonitor* monitor = monitorUnder(place());
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  return mode && mode->refreshRate > 0 ? mode->refreshRate : 60.0;
}

bool Window::fullScreen() const {
  return glfwGetWindowMonitor(window_.get()) != nullptr;
}

ScreenRect Window::place() const {
  ScreenRect rect;
  glfwGetWindowPos(window_.get(), &rect.x, &rect.y);
  glfwGetWindowSize(window_.get(), &rect.width, &rect.height);
  return rect;
}

void Window::setPlace(const ScreenRect& place) {
  glfwSetWindowMonitor(window_.get(), nullptr, place.x, place.y, place.width, place.height, GLFW_DONT_CARE);
}

void Window::setFullScreen(bool on) {
  // GLFW 3.3 would wait without end for a window that is not on the screen, as long as there are other events.
  if (on == fullScreen() || !glfwGetWindowAttrib(window_.get(), GLFW_VISIBLE)) {
    return;
  }
  covers_ = false;
  if (!on) {
    // The monitor of the old place may be gone.
    return setPlace(rescuedWindow(windowed_, workAreas()).value_or(windowed_));
  }
  windowed_ = place();
  GLFWmonitor* monitor = monitorUnder(windowed_);
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (mode) {
    glfwSetWindowMonitor(window_.get(), monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
    covers_ = true;
  }
}

// GLFW has already turned a full screen window whose monitor is gone into a window of the monitor's size.
void Window::followMonitors(std::span<const ScreenRect> workAreas) {
  active_ = true;
  if (fullScreen()) {
    return;
  }
  const bool left = std::exchange(covers_, false);
  const ScreenRect wanted = left ? windowed_ : place();
  if (const auto back = rescuedWindow(wanted, workAreas)) {
    setPlace(*back);
  } else if (left) {
    setPlace(wanted);
  }
}

void Window::followContentScale(float scale) {
  active_ = true;
  contentScale_ = scale;
}

void Window::iconify() {
  glfwIconifyWindow(window_.get());
}

void Window::restore() {
  glfwRestoreWindow(window_.get());
}

bool Window::paused() const {
  return iconified_ || framebuffer_.width == 0 || framebuffer_.height == 0;
}

bool Window::takeResized() {
  return std::exchange(resized_, false);
}

std::optional<GamepadState> Window::gamepad() const {
  GLFWgamepadstate state{};
  if (!glfwGetGamepadState(GLFW_JOYSTICK_1, &state)) {
    return std::nullopt;
  }
  const auto stick = [&](int axis) { return withoutDeadZone(state.axes[axis]); };
  // A released trigger is at -1.
  const auto trigger = [&](int axis) { return withoutDeadZone(0.5f * (state.axes[axis] + 1.0f)); };
  GamepadState pad{.leftX = stick(GLFW_GAMEPAD_AXIS_LEFT_X),
                   .leftY = stick(GLFW_GAMEPAD_AXIS_LEFT_Y),
                   .rightX = stick(GLFW_GAMEPAD_AXIS_RIGHT_X),
                   .rightY = stick(GLFW_GAMEPAD_AXIS_RIGHT_Y),
                   .leftTrigger = trigger(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER),
                   .rightTrigger = trigger(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER)};
  for (size_t i = 0; i < pad.buttons.size(); ++i) {
    pad.buttons[i] = state.buttons[buttonCodes[i]] == GLFW_PRESS;
  }
  pad.directionPad =
      std::any_of(state.buttons + GLFW_GAMEPAD_BUTTON_DPAD_UP, state.buttons + GLFW_GAMEPAD_BUTTON_DPAD_LEFT + 1,
                  [](unsigned char button) { return button == GLFW_PRESS; });
  return pad;
}

bool Window::keyDown(Key key) const {
  return glfwGetKey(window_.get(), static_cast<int>(key)) == GLFW_PRESS;
}

bool Window::keyDownAlone(Key key) const {
  return keyDown(key) && !withControl_.contains(static_cast<int>(key));
}

void Window::setTitle(const std::string& title) {
  glfwSetWindowTitle(window_.get(), title.c_str());
}

void Window::setClipboard(const std::string& text) {
  glfwSetClipboardString(window_.get(), text.c_str());
}

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(window_.get());
  return text ? text : "";
}

std::vector<const char*> Window::requiredInstanceExtensions() const {
  uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (!names) {
    failAtSurface("the window system offers no Vulkan surface");
  }
  return {names, names + count};
}

VkSurfaceKHR Window::createSurface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(instance, window_.get(), nullptr, &surface) != VK_SUCCESS) {
    failAtSurface("the window's Vulkan surface could not be made");
  }
  return surface;
}

}  // namespace speculum
