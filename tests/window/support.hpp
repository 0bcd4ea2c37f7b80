#pragma once

#include <chrono>
#include <thread>

#include "picture_support.hpp"
#include "scene/scene_loader.hpp"
#include "scene_text.hpp"
#include "test_headers.hpp"
#include "user_folders.hpp"
#include "window/workspace.hpp"

namespace speculum::testing_support {

inline constexpr int width = 900;
inline constexpr int height = 700;

inline constexpr double focalPixels = 0.5 * height * 1.7320508075688772;  // for a vertical field of view of 60 degrees

inline const Selection ball{Selection::Kind::object, 0};
inline const Selection lamp{Selection::Kind::light, 0};
inline const Selection ahead{Selection::Kind::mirror, 0};
inline const Selection behind{Selection::Kind::mirror, 1};

// A window's part of the workspace, without a display.
class FakeHost : public WorkspaceHost {
 public:
  void useScene(const Scene&) override {
    ++scenesUsed;
    if (std::exchange(failsNext, false)) {
      throw std::runtime_error("no memory");
    }
  }
  void dropCachedImages() override { ++drops; }
  glm::ivec2 pictureSize() const override { return size; }
  PixelRect freePicture() const override { return free.value_or(PixelRect{0, 0, size.x, size.y}); }
  double contentScale() const override { return 1.0; }
  std::string gpu() const override { return "0"; }
  void setClipboard(const std::string& text) override { clipboard = text; }
  void setTitle(const std::string& text) override { title = text; }
  void close() override { closed = true; }
  void toggleFullScreen() override {}
  void setPresentMode(size_t) override {}
  void togglePanels() override { panels = !panels; }
  void closeSidePanels() override { sidePanels = false; }
  bool showsPanels() const override { return panels; }
  void toggleHelp() override {}
  void toggleInspector() override { inspector = !inspector; }
  void openInspector() override { inspector = true; }
  bool inspectorCovers(const glm::dvec2& place) const override { return place.x > inspectorFrom; }
  bool closePopup() override { return std::exchange(popup, false); }

  int scenesUsed = 0;
  bool failsNext = false;
  int drops = 0;
  glm::ivec2 size{width, height};
  std::optional<PixelRect> free;
  std::string clipboard;
  std::string title;
  bool panels = true;
  bool sidePanels = true;
  bool closed = false;
  bool inspector = false;
  bool popup = false;
  double inspectorFrom = width;  // x of the inspector's left edge
};

// A workspace driven by commands, with folders of its own for what it writes.
class WorkspaceTest : public testing::Test {
 protected:
  explicit WorkspaceTest(const std::string& toml = corridorScene(), const Options& more = {}) : options_(more) {
    options_.scene = writeScene("workspace", toml).string();
    options_.size = {width, height};
    start();
  }

  // Begins a session of the program, after the end of the last one.
  void start() {
    workspace_.reset();
    workspace_ = std::make_unique<Workspace>(options_, host_);
    frame();
  }
  // Runs a frame without a picture.
  void frame(double seconds = 0.0) {
    workspace_->prepareView(seconds, true);
    workspace_->update();
    workspace_->view().playback.advance(seconds);
    workspace_->prepareView(0.0, true);
  }
  void send(const Command& command) {
    workspace_->apply(command);
    frame();
  }
  WatchedState watchedState() { return workspace_->watchedState(workspace_->state(workspace_->time())); }
  template <typename Done>
  void waitFor(const Done& done) {
    for (int i = 0; i < 6000 && !done(); ++i) {
      frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_TRUE(done());
  }

  void moveTo(const glm::dvec2& at, bool snap = false) { workspace_->pointerMoved(at, {width, height}, snap); }
  void press(bool down, bool shift = false, MouseButton button = MouseButton::left, bool overPanels = false) {
    workspace_->pointerButton({.button = button, .pressed = down, .shift = shift}, overPanels);
  }
  void click(const glm::dvec2& at, bool shift = false) {
    moveTo(at);
    press(true, shift);
    press(false, shift);
    frame();
  }
  void drag(const glm::dvec2& from, const glm::dvec2& by, MouseButton button = MouseButton::left) {
    moveTo(from);
    press(true, false, button);
    for (int i = 1; i <= 5; ++i) {
      moveTo(from + by * (i / 5.0));
    }
    press(false, false, button);
    frame();
  }
  // Drags along a ring of the handles through these angles, in degrees counter-clockwise from the right.
  void dragRing(const glm::dvec2& center, std::initializer_list<double> degrees, bool snap) {
    const auto onRing = [&](double angle) {
      return center + 92.0 * glm::dvec2(std::cos(glm::radians(angle)), -std::sin(glm::radians(angle)));
    };
    moveTo(onRing(*degrees.begin()), snap);
    press(true);
    for (const double angle : degrees) {
      moveTo(onRing(angle), snap);
    }
    press(false);
    frame();
  }
  // Returns the pixel of a world point. For a mirror image, reflect the point first.
  static glm::dvec2 pixel(const glm::dvec3& world) {
    return glm::dvec2(width, height) / 2.0 + focalPixels * glm::dvec2(world.x, 1.0 - world.y) / (1.5 - world.z);
  }
  void clickBall() { click(pixel({0.3, 1.0, 0.5})); }

  UiInput shown() const { return workspace_->shown(device_, workspace_->problem()); }
  ShownEdit edit() const { return shown().edit; }
  const Scene& scene() const { return workspace_->scene(); }
  Object object() const { return std::get<Object>(nodeOf(scene(), edit().selected)); }
  std::string status() const { return shown().status.text; }
  std::string shownScene() const { return shown().browser.scenes.at(shown().browser.shown).name; }
  Scene onDisk() const { return loadScene(options_.scene); }
  CameraPose camera() { return workspace_->state(workspace_->time()).camera; }
  glm::dvec3 eye() { return camera().eye; }
  glm::dvec3 forward() { return -glm::dvec3(glm::transpose(camera().worldToView)[2]); }
  template <typename Change>
  void changeSettings(const Change& change, bool continued = false) {
    Settings settings = workspace_->settings();
    change(settings);
    send(SetSettings{settings, continued});
  }
  void setExposure(double exposure, bool continued = false) {
    changeSettings([&](Settings& settings) { settings.view.exposure = exposure; }, continued);
  }
  // Sends AskWhatToOpen while programs are looked for in these folders.
  void askWhatToOpen(const std::string& folders) {
    const std::string path = environment("PATH");
    setEnvironment("PATH", folders);
    send(AskWhatToOpen{});
    setEnvironment("PATH", path);
  }
  // Acts as if a frame of that picture had been drawn and, if a capture is wanted, read back.
  void drawFrame(const Image8& picture = Image8(4, 4)) {
    const SceneState state = workspace_->state(workspace_->time());
    workspace_->frameDrawn(
        {scene(), state, workspace_->settings(), width, height}, [&] { return picture; },
        workspace_->capture().wanted() ? &picture : nullptr);
    frame();
  }

  UserFolders home_{"XDG_CONFIG_HOME", "XDG_PICTURES_DIR", "XDG_DOCUMENTS_DIR", "XDG_CACHE_HOME"};
  Options options_;
  FakeHost host_;
  ShownDevice device_;
  std::unique_ptr<Workspace> workspace_;
};

}  // namespace speculum::testing_support
