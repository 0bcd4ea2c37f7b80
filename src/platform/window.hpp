#pragma once

#include <vulkan/vulkan.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "platform/keys.hpp"

struct GLFWwindow;

namespace speculum {

enum class MouseButton { left, right, middle };

struct KeyEvent {
  Key key = Key::unknown;
  bool pressed = false;
  bool repeat = false;
  bool shift = false;
  bool control = false;
  bool alt = false;
};
struct MouseButtonEvent {
  MouseButton button = MouseButton::left;
  bool pressed = false;
  bool shift = false;
};

struct InputEvent {
  enum class Kind { key, text, button, pointer, wheel, focus, enter, drop };
  Kind kind = Kind::key;
  int code = 0;          // GLFW's code of the key (by its printed letter) or button; the character of a text
  bool down = false;     // key or button is pressed; window has the focus; pointer is in the window
  bool command = false;  // a key without a character that is no modifier, or any key with Control or Alt
  double x = 0.0;        // of pointer (screen coordinates of the window, origin top left) and wheel (notches)
  double y = 0.0;
  KeyEvent key;                                // of a key, for shortcuts
  bool shift = false;                          // of a button: Shift was held
  bool again = false;                          // of a button: pressed soon after its last press; set by InputQueue
  std::vector<std::filesystem::path> dropped;  // files
};

struct WindowOptions {
  std::string title = "Speculum";
  int width = 1280;  // screen coordinates
  int height = 720;
  bool visible = true;
};

// Makes GLFW open windows by "x11" or "wayland", or by what the session has. Call it before the first window. GLFW
// before 3.4 is built for only one of the two; throws std::runtime_error if it is built for the other one.
void chooseWindowPlatform(const std::optional<std::string>& platform);

// Makes the library of X11 call `last` before it ends the process, as it does when the server is gone. Call this
// function once there is a window.
void onDisplayLost(void (*last)());

// A rectangle in screen coordinates of the desktop.
struct ScreenRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const ScreenRect&) const = default;
};

// Returns where to put a window that cannot be gripped because too little of it lies on any monitor's work area: in the
// middle of the first work area, no larger than that. Nothing if the window may stay, or if there is no monitor.
std::optional<ScreenRect> rescuedWindow(const ScreenRect& window, std::span<const ScreenRect> workAreas);

// A window of the desktop. Use it from the main thread only.
class Window {
 public:
  // Throws std::runtime_error when there is no display or no Vulkan surface support.
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void pollEvents();
  void waitEvents(double timeoutSeconds);  // sleeps until something happens
  bool shouldClose() const;
  void requestClose();
  void refuseClose();  // takes back a request to close

  // Sizes that the events polled last have reported: asking the X server would wait for the picture that it copies.
  VkExtent2D framebufferExtent() const { return framebuffer_; }  // pixels; 0x0 is possible
  VkExtent2D size() const { return size_; }                      // screen coordinates
  void resize(int width, int height);                            // screen coordinates
  // Covers the monitor under the window's centre, or restores position and size. Does nothing while iconified.
  void setFullScreen(bool on);
  bool fullScreen() const;
  double refreshRate() const;  // Hz, of the monitor under the window's centre; 60 if unknown
  void iconify();
  void restore();
  // X11 keeps the size of an iconified window, so the size does not show it.
  bool iconified() const { return iconified_; }
  bool paused() const;  // iconified, or without a pixel
  bool takeResized();   // whether the framebuffer changed its size since the last call
  // Says whether anything happened to the window since the last call: a key, the pointer, focus, size, uncovering.
  bool takeActivity() { return std::exchange(active_, false); }
  std::optional<GamepadState> gamepad() const;  // the first one, if there is any
  float contentScale() const { return contentScale_; }
  // Call when monitors came, went or changed. Moves a window that no monitor shows onto one, and ends full screen on a
  // monitor that is gone. `workAreas` are those of the present monitors.
  void followMonitors(std::span<const ScreenRect> workAreas);
  void followContentScale(float scale);  // call when the window is on a monitor of another scale
  bool keyDown(Key key) const;
  bool keyDownAlone(Key key) const;  // it is down, and Ctrl was not when it was pressed
  void setTitle(const std::string& title);
  void setClipboard(const std::string& text);
  std::string clipboard() const;  // empty if it holds no text
  // Calls `listener` with every event.
  void setListener(std::function<void(const InputEvent&)> listener) { listener_ = std::move(listener); }

  GLFWwindow* native() const { return window_.get(); }
  std::vector<const char*> requiredInstanceExtensions() const;
  VkSurfaceKHR createSurface(VkInstance instance) const;  // owned by the caller

 private:
  struct Library {
    Library();
    ~Library();
  };
  struct Destroy {
    void operator()(GLFWwindow* window) const;
  };
  static Window* of(GLFWwindow* window);
  void installCallbacks();
  void readSizes();
  void notify(const InputEvent& event);
  ScreenRect place() const;
  void setPlace(const ScreenRect& place);

  Library library_;
  std::unique_ptr<GLFWwindow, Destroy> window_;
  std::function<void(const InputEvent&)> listener_;
  ScreenRect windowed_;        // place and size before full screen
  std::set<int> withControl_;  // GLFW's codes of keys that were pressed with Ctrl and are down
  bool covers_ = false;        // covers a monitor as full screen
  float contentScale_ = 1.0f;
  VkExtent2D framebuffer_{};
  VkExtent2D size_{};
  bool iconified_ = false;
  bool resized_ = false;
  bool active_ = true;
};

}  // namespace speculum
