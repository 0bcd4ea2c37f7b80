#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "platform/gamepad.hpp"

struct GLFWwindow;

namespace speculum {

// Keys with a meaning in the program, by GLFW's codes; keys that print something have the code of that character.
enum class Key {
  unknown = -1,
  space = ' ',
  comma = ',',
  period = '.',
  a = 'A',
  b,
  d = 'D',
  e,
  f,
  g,
  m = 'M',
  n,
  o,
  q = 'Q',
  r,
  s,
  w = 'W',
  y = 'Y',
  z,
  leftBracket = '[',
  rightBracket = ']',
  escape = 256,
  enter,
  tab,
  del = 261,
  f1 = 290,
  f2,
  f10 = 299,
  f11,
  f12,
  leftShift = 340,
  leftControl,
  rightShift = 344,
  rightControl
};
// Returns the meaning of the key at `place` of an American keyboard with the character `printed` on it (empty: none or
// unknown). The six keys that fly are identified by their place; all others, and all keys with Control, by their
// character, or by their place if the character is not Latin. `printedWhereFlying` are the characters on the six fly
// keys: a shortcut whose character is one of them has the key that it has on an American keyboard, unless another
// shortcut is printed on that key.
Key meaningOfKey(Key place, std::string_view printed, bool control, std::string_view printedWhereFlying);

enum class MouseButton { left, right, middle };

struct KeyEvent {
  Key key = Key::unknown;
  bool pressed = false;
  bool repeat = false;
  bool shift = false;
  bool control = false;
};
struct MouseButtonEvent {
  MouseButton button = MouseButton::left;
  bool pressed = false;
  bool shift = false;
};

// An event as the panels take it.
struct InputEvent {
  enum class Kind { key, text, button, pointer, wheel, focus, enter };
  Kind kind = Kind::key;
  int code = 0;          // GLFW's of the key, by its printed letter, or of the button; the character
  bool down = false;     // of key and button; the window has the focus, or the pointer is in it
  bool command = false;  // a key without a character that is no modifier, or any key with Control or Alt
  double x = 0.0;        // of pointer (screen coordinates) and wheel (notches)
  double y = 0.0;
};

// Functions that the window calls on events; empty ones are skipped. Positions are in screen coordinates of the window,
// origin top left.
struct WindowCallbacks {
  std::function<void(const KeyEvent&)> key;
  std::function<void(const MouseButtonEvent&)> mouseButton;
  std::function<void(double x, double y)> cursor;
  std::function<void(double dx, double dy)> scroll;
  std::function<void(const std::vector<std::filesystem::path>& files)> drop;
};

struct WindowOptions {
  std::string title = "Speculum";
  int width = 1280;  // screen coordinates
  int height = 720;
  bool visible = true;
};

// Makes GLFW open windows by "x11" or "wayland", or by what the session has. Call it before the first window. GLFW
// before 3.4 is built for only one of them; throws std::runtime_error if that is the other.
void chooseWindowPlatform(const std::optional<std::string>& platform);

// Calls `last` before the library of X11 ends the process, as it does when the server is gone. Call it with a window.
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

  VkExtent2D framebufferExtent() const;  // pixels; 0x0 is possible
  VkExtent2D size() const;               // screen coordinates
  void resize(int width, int height);    // screen coordinates
  // Covers the monitor under the window's centre, or restores position and size. Does nothing while iconified.
  void setFullScreen(bool on);
  bool fullScreen() const;
  double refreshRate() const;  // Hz, of the monitor under the window's centre; 60 if unknown
  void iconify();
  void restore();
  // X11 keeps the size of an iconified window, so the size does not show it.
  bool iconified() const;
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
  void setTitle(const std::string& title);
  void setClipboard(const std::string& text);
  std::string clipboard() const;  // empty if it holds no text
  void setCallbacks(WindowCallbacks callbacks) { callbacks_ = std::move(callbacks); }
  // Calls `listener` with every event, after the callbacks; an empty one ends that.
  void setListener(std::function<void(const InputEvent&)> listener) { listener_ = std::move(listener); }
  // Handles files as if they had been dropped on the window.
  void dropFiles(const std::vector<std::filesystem::path>& files);

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
  void tell(const InputEvent& event);
  ScreenRect place() const;
  void setPlace(const ScreenRect& place);

  Library library_;
  std::unique_ptr<GLFWwindow, Destroy> window_;
  WindowCallbacks callbacks_;
  std::function<void(const InputEvent&)> listener_;
  ScreenRect windowed_;  // before full screen
  bool covers_ = false;  // covers a monitor as full screen
  float contentScale_ = 1.0f;
  bool resized_ = false;
  bool active_ = true;
};

}  // namespace speculum
