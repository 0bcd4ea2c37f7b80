#pragma once

#include <functional>

#include "demo_window_support.hpp"
#include "scene/scene_loader.hpp"

namespace speculum::testing_support {

// The eye between two mirrors that face each other; the ball is seen directly, in one mirror and in both.
inline const std::string corridor = R"(
[environment]
background = [0.2, 0.3, 0.4]
ambient = [0.3, 0.3, 0.3]
[camera]
position = [0, 1, 1.5]
target = [0, 1, -2]
[settings]
"view.samples" = 1
"reflection.samples" = 1
[[object]]
name = "ball"
model = "MODELS/sphere.obj"
position = [0.3, 1, 0.5]
scale = 0.2
[[light]]
name = "lamp"
position = [-0.5, 1.5, 0]
radius = 0.05
intensity = 4
# In front of the eye.
[[mirror]]
name = "ahead"
position = [0, 1, -2]
size = [3, 2]
[[mirror]]
name = "behind"
position = [0, 1, 2]
rotation = [0, 180, 0]
size = [3, 2]
)";

inline constexpr double focalPixels = 0.5 * height * 1.7320508075688772;  // of 60 degrees

inline const Selection ball{Selection::Kind::object, 0};
inline const Selection lamp{Selection::Kind::light, 0};
inline const Selection ahead{Selection::Kind::mirror, 0};
inline const Selection behind{Selection::Kind::mirror, 1};

class EditWindow : public DemoWindow {
 protected:
  explicit EditWindow(const Options& more = {}) : DemoWindow(corridor, more) { press("Tab"); }
  explicit EditWindow(const std::string& toml) : DemoWindow(toml) { press("Tab"); }

  using DemoWindow::click;
  void click(int x, int y) {
    moveTo(x, y);
    xdotool({"mousedown", "1"});
    run(2);
    xdotool({"mouseup", "1"});
    run(3);
  }
  void clickBall() { click(pixel({0.3, 1.0, 0.5}).x, 350); }
  void dragPointer(int x, int y, int dx, int dy) {
    moveTo(x, y);
    xdotool({"mousedown", "1"});
    run(2);
    for (int i = 1; i <= 5; ++i) {
      moveTo(x + dx * i / 5, y + dy * i / 5);
    }
    xdotool({"mouseup", "1"});
    run(3);
  }
  // Of a point of the world, whose reflections have been unfolded.
  glm::ivec2 pixel(const glm::dvec3& world) const {
    return {width / 2 + static_cast<int>(std::lround(focalPixels * world.x / (1.5 - world.z))),
            height / 2 - static_cast<int>(std::lround(focalPixels * (world.y - 1.0) / (1.5 - world.z)))};
  }
  const UiEdit& edit() const { return demo_->model().edit; }
  Object object() const { return std::get<Object>(edit().thing); }
  // Without the panel, what shows the selection, and messages.
  std::vector<uint8_t> bare() {
    while (edit().selected || !demo_->model().status.text.empty()) {
      press("Escape");
    }
    return picture().rgba;
  }
  std::string shownScene() const { return demo_->model().scenes[static_cast<size_t>(demo_->model().scene)]; }
  void waitFor(const std::function<bool()>& done) {
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (!done() && Clock::now() < end) {
      ASSERT_TRUE(demo_->step());
    }
    EXPECT_TRUE(done());
    run(3);
  }
  Scene onDisk() { return loadScene(options_.scene); }
  bool stepUntilClosed() {
    const auto end = Clock::now() + std::chrono::seconds(10);
    while (Clock::now() < end) {
      if (!demo_->step()) {
        return true;
      }
    }
    return false;
  }
  // Presses a button of the question about unsaved changes, without a frame after it: the window may be gone.
  void answer(const std::string& name) {
    const PixelRect button = widget("edit.ask." + name);
    moveTo(button.x + 10, button.y + 5);
    xdotool({"mousedown", "1"});
    run(3);
    xdotool({"mouseup", "1"});
  }
  void askToClose() {
    const ProcessResult closed = runProcess({"wmctrl", "-c", "Speculum"});
    ASSERT_EQ(closed.exitCode, 0) << closed.output;
    const auto end = Clock::now() + std::chrono::seconds(10);
    while (!edit().asksSave && Clock::now() < end) {
      ASSERT_TRUE(demo_->step()) << "it must not close unasked";
    }
    run(5);
  }
};

}  // namespace speculum::testing_support
