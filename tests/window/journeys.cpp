// The window as a user drives it: real X events under a window manager, pictures compared. Single commands and panels
// are tested without a display.
#include <imgui_internal.h>
#include <sys/stat.h>

#include "core/handle.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "sampling.hpp"
#include "scene/scene_loader.hpp"
#include "test_paths.hpp"
#include "window/journeys_support.hpp"

// GLFW's function, called through here. A divisor of 2 stands for Wayland at a scale of 2, where a screen coordinate is
// two pixels.
static int sizeDivisor = 1;
extern "C" void __real_glfwGetWindowSize(GLFWwindow* window, int* width, int* height);
extern "C" void __wrap_glfwGetWindowSize(GLFWwindow* window, int* width, int* height) {
  __real_glfwGetWindowSize(window, width, height);
  *width /= sizeDivisor;
  *height /= sizeDivisor;
}

namespace speculum {
namespace {

using namespace testing_support;

size_t at(int x, int y) {
  return 4 * (static_cast<size_t>(y) * width + static_cast<size_t>(x));
}

TEST_F(Journey, KeysAndGamepadDriveTheWindow) {
  std::optional<GamepadState> pad = GamepadState{.leftY = -1.0f};
  demo_->setGamepadSource([&] { return pad; });
  const glm::dvec3 before = demo_->camera().eye;
  run(4);
  EXPECT_LT(demo_->camera().eye.z, before.z) << "forward";
  const auto push = [&](GamepadButton button) {
    pad = GamepadState{};
    pad->buttons[static_cast<size_t>(button)] = true;
    run(3);
  };
  push(GamepadButton::leftStick);
  EXPECT_EQ(demo_->camera().eye, before) << "back to the scene's camera";
  const Image8 with = picture();
  push(GamepadButton::back);
  EXPECT_NE(picture().rgba[at(30, 300)], with.rgba[at(30, 300)]) << "the panels are hidden";
  demo_->setGamepadSource([] { return std::nullopt; });
  press("Tab");
  press("Tab");
  const Image8 without = picture();
  EXPECT_NE(with.rgba[at(30, 300)], without.rgba[at(30, 300)]);
  press("Tab");
  EXPECT_EQ(picture().rgba[at(30, 300)], with.rgba[at(30, 300)]);
  click("panel.Log");
  const ImGuiWindow* focused = ImGui::GetCurrentContext()->NavWindow;
  press("ctrl+Tab");
  EXPECT_NE(ImGui::GetCurrentContext()->NavWindow, focused) << "it switches windows";
  EXPECT_EQ(picture().rgba[at(30, 300)], with.rgba[at(30, 300)]) << "and hides none";
  click("panel.Log");
  press("F1");
  const Image8 help = picture();
  EXPECT_FALSE(
      std::equal(with.rgba.begin() + at(450, 350), with.rgba.begin() + at(460, 350), help.rgba.begin() + at(450, 350)));
  press("Escape");
  EXPECT_FALSE(demo_->panels().help);
  press("Escape");
  EXPECT_FALSE(demo_->window().shouldClose()) << "Esc never quits";
  for (const int wanted : {1280, width}) {
    press("F11");
    EXPECT_TRUE(waitFor([&] { return demo_->renderer().displayExtent().width == uint32_t(wanted); }));
    EXPECT_EQ(demo_->window().fullScreen(), wanted == 1280);
  }
  EXPECT_EQ(demo_->renderer().displayExtent().height, uint32_t(height));
  xdotool({"key", "--window", window_, "ctrl+q"});
  EXPECT_TRUE(waitForClose());
}

class EditJourney : public Journey {
 protected:
  EditJourney() : Journey(corridorScene()) {}

  static constexpr double focalPixels = 0.5 * height * 1.7320508075688772;
  const Object& ball() const { return shown().edit.scene->objects.at(0); }
};

TEST_F(EditJourney, HandlesAreDraggedInAMirrorImage) {
  const Image8 before = barePicture();
  const glm::dvec2 image(width / 2.0 + focalPixels * 0.3 / 6.0, height / 2.0);
  clickAt(image.x + 4, image.y);
  ASSERT_EQ(shown().edit.selected, (Selection{Selection::Kind::object, 0}));
  ASSERT_EQ(shown().edit.through, MirrorPath{0});
  // Drags upwards in the mirror image, where the ball is six metres away and a pixel is longer.
  dragFrom(image.x, image.y - 60, 0, -30);
  EXPECT_NEAR(ball().position.y, 1.0 + 6.0 * 30 / focalPixels, 2e-2);
  EXPECT_EQ(ball().position.x, 0.3);
  demo_->apply(SelectNode{});
  const Image8 moved = barePicture();
  EXPECT_NE(moved.rgba, before.rgba);
  press("ctrl+z");
  EXPECT_EQ(ball().position.y, 1.0);
  demo_->apply(SelectNode{});
  EXPECT_TRUE(barePicture().rgba == before.rgba) << "undone to the pixel";
}

TEST_F(EditJourney, FieldsLeaveSavingToTheWindow) {
  for (const char* key : {"n", "n", "shift+n"}) {  // the inspector that is open scrolls to the fields
    press(key);
  }
  ASSERT_EQ(shown().edit.selected, (Selection{Selection::Kind::mirror, 0}));
  ASSERT_LT(widget("edit.name").y, height - 20);
  click("edit.name");
  // Sends all keys before the next frame.
  xdotool({"key", "--window", window_, "--delay", "1", "End", "a", "b", "ctrl+s"});
  EXPECT_TRUE(waitFor([&] { return loadScene(options_.scene).mirrors.at(0).name == "aheadab"; }));
  EXPECT_FALSE(shown().edit.unsaved);
}

TEST_F(EditJourney, OpenMenusTakeTheKeys) {
  press("n");
  const size_t mirrors = shown().edit.scene->mirrors.size();
  click("menu.View");
  press("Delete");
  EXPECT_EQ(shown().edit.scene->mirrors.size(), mirrors);
  press("Escape");
  const bool help = demo_->panels().help;
  click("menu.Help");
  press("Down");
  press("Up");
  xdotool({"key", "--window", window_, "--delay", "1", "space"});  // down and up before the next frame
  run(5);
  EXPECT_NE(demo_->panels().help, help);
}

// On a Dvorak keyboard the comma is where W is on an American one, so it flies.
TEST_F(Journey, ShortcutsAvoidFlyKeysOnDvorak) {
  setKeyboard({"us", "-variant", "dvorak"});
  run(3);
  press("space");
  ASSERT_TRUE(shown().playback.paused);
  press("v");  // where an American keyboard has the full stop
  const double time = shown().playback.time;
  press("w");  // where it has the comma
  EXPECT_NEAR(shown().playback.time, time - timeStep, 1e-12);
  const glm::dvec3 before = demo_->camera().eye;
  xdotool({"keydown", "--window", window_, "comma"});
  run(4);
  xdotool({"keyup", "--window", window_, "comma"});
  run(2);
  EXPECT_LT(demo_->camera().eye.z, before.z - 1e-3) << "forward";
  EXPECT_NEAR(shown().playback.time, time - timeStep, 1e-12);
}

TEST_F(Journey, LettersOfShortcutsDoNotFly) {
  const glm::dvec3 before = demo_->camera().eye;
  const auto send = [&](const char* action, const char* key) { xdotool({action, "--window", window_, key}); };
  send("keydown", "ctrl");
  send("keydown", "d");
  run(2);
  send("keyup", "ctrl");  // before the letter, as fingers do
  run(4);
  EXPECT_EQ(demo_->camera().eye, before);
  send("keyup", "d");
  run(2);
  send("keydown", "d");
  run(4);
  send("keyup", "d");
  EXPECT_GT(demo_->camera().eye.x, before.x) << "alone it flies";
}

TEST_F(Journey, RandomResizesLeakNothing) {
  std::mt19937 random(42);
  std::uniform_int_distribution<int> side(1, 500);
  const auto resizeTo = [&](int w, int h) {
    demo_->window().resize(w, h);
    for (int i = 0; i < 2; ++i) {
      ASSERT_TRUE(demo_->step());
    }
  };
  demo_->setCapture(false);
  const auto settle = [&] {
    resizeTo(300, 200);
    run(40);  // unused targets are freed after 30 frames
    demo_->renderer().waitIdle();
  };
  setSetting("reflection.update_interval", "4");
  int reused = 0;
  for (int frame = 0; frame < 8; ++frame) {
    ASSERT_TRUE(demo_->step());
    const auto skipped = shown().frame.skipped;
    reused += std::ranges::any_of(skipped, [](const auto& s) { return s.reason == "unchanged"; });
    ASSERT_EQ(shown().frame.passes.size(), 3u) << "the pass of a reused image stays in the list";
  }
  EXPECT_GE(reused, 4);
  resizeTo(1, 1);  // mirrors become too small for passes, which takes another pipeline
  settle();
  const auto objects = liveObjects();
  for (int i = 0; i < (fullTests() ? 100 : 40); ++i) {
    resizeTo(i % 20 == 0 ? 1 : side(random), i % 20 == 0 ? 1 : side(random));
  }
  settle();
  EXPECT_EQ(liveObjects(), objects);
}

TEST_F(Journey, CloseButtonAsksAndSaves) {
  demo_->apply(SelectNode{{Selection::Kind::object, 0}});
  press("Delete");
  const auto close = [&] {
    ASSERT_EQ(runProcess({"wmctrl", "-c", "Speculum"}).exitCode, 0);
    ASSERT_TRUE(waitFor([&] { return shown().edit.prompt == Prompt::unsavedChanges; }));
    run(4);
  };
  close();
  const glm::dvec3 eye = demo_->camera().eye;
  xdotool({"keydown", "--window", window_, "w"});
  run(3);
  xdotool({"keyup", "--window", window_, "w"});
  EXPECT_EQ(demo_->camera().eye, eye) << "nobody flies under a prompt";
  press("Escape");
  EXPECT_EQ(shown().edit.prompt, Prompt::none);
  EXPECT_FALSE(demo_->window().shouldClose());
  close();
  xdotool({"key", "--window", window_, "Return"});  // the button that has the keyboard
  EXPECT_TRUE(waitForClose());
  EXPECT_TRUE(loadScene(options_.scene).objects.empty());
}

TEST_F(Journey, InputBetweenFramesGoesWhereMeant) {
  press("ctrl+shift+s");
  run(4);
  // Sends all keys before the next frame.
  xdotool({"type", "--window", window_, "--delay", "1", "abcd"});
  xdotool({"key", "--window", window_, "--delay", "1", "BackSpace", "BackSpace", "Left", "x"});
  EXPECT_TRUE(waitFor([&] { return demo_->panels().files.typed == "axb"; })) << demo_->panels().files.typed;
  press("Escape");
  EXPECT_EQ(shown().edit.prompt, Prompt::none);
  press("n");
  ASSERT_TRUE(shown().edit.selected);
  press("F2");  // closes the inspector, so that the main panel unfolds
  const PixelRect box = widget("pause");
  moveTo(width / 2, 30);
  // Sends all events before the next frame.
  xdotool({"mousemove", "--window", window_, std::to_string(box.x + 10), std::to_string(box.y + box.height / 2),
           "mousedown", "1", "mouseup", "1", "mousemove", "--window", window_, std::to_string(width / 2), "30"});
  run(5);
  EXPECT_TRUE(shown().edit.selected) << "no click into the picture";
  EXPECT_TRUE(shown().playback.paused);
}

TEST_F(Journey, ScreenshotsIncludeOrOmitPanels) {
  press("space");
  press("shift+F12");
  press("F12");
  ASSERT_EQ(home_.pictures().size(), 2u);
  const Image8 window = readImage8(home_.pictures()[0]);
  const Image8 bare = readImage8(home_.pictures()[1]);
  ASSERT_EQ(window.width, width);
  EXPECT_NE(window.rgba, bare.rgba);
  EXPECT_TRUE(barePicture().rgba == bare.rgba);
  press("Tab");
  press("F10");
  EXPECT_TRUE(contains(shown().status.text, "F10 stops."));
  bool seen = false;
  for (int i = 0; i < ImGui::GetDrawData()->CmdListsCount; ++i) {
    const ImDrawList& list = *ImGui::GetDrawData()->CmdLists[i];
    seen = seen || (list._OwnerName == std::string_view("##status") && list.CmdBuffer.Size > 0);
  }
  EXPECT_TRUE(seen) << "a full screen has no title";
  press("F10");
  EXPECT_TRUE(contains(shown().status.text, "Recorded "));
  // Pictures and recordings of one second share a name, so their order tells nothing.
  const std::vector<std::filesystem::path> files = home_.pictures();
  const auto recording =
      std::ranges::find_if(files, [](const auto& file) { return std::filesystem::is_directory(file); });
  ASSERT_NE(recording, files.end());
  EXPECT_TRUE(readImage8(*recording / "00001.png").rgba == bare.rgba) << "the message is in no picture";
}

TEST_F(Journey, TimeStandsWhereNothingMoves) {
  run(10);
  EXPECT_FALSE(shown().playback.paused);
  EXPECT_EQ(shown().playback.time, 0.0);
}

TEST_F(Journey, TimesOfFramesAreComplete) {
  click("panel.Performance");
  run(40);
  const FrameHistory& history = shown().frame.history;
  EXPECT_EQ(history.passNames(),
            (std::vector<std::string>{"mirror wall", "main view", "display", "overlay", "other work"}));
  const std::vector<float> gpu = history.series(FrameHistory::Figure::gpu);
  const auto passes = history.passSeries("main view");
  int complete = 0;
  for (size_t i = 0; i < gpu.size(); ++i) {
    complete += gpu[i] > 0.0f && passes[i] > 0.0f && passes[i] < gpu[i] + 0.001f;
  }
  EXPECT_GE(complete, 2) << "a frame now and then";
  EXPECT_LE(complete, 5) << "the others are not slowed";
  ASSERT_TRUE(shown().frame.passes[0].resolution);
  EXPECT_GT(shown().frame.passes[0].resolution->distance, 6.0) << "the light, seen in the mirror";
  press("Tab");
  run(4);
  EXPECT_TRUE(demo_->renderer().timings().passes.empty()) << "no panel shows them";
  EXPECT_GT(demo_->renderer().timings().gpuMs, 0.0);
  const ShownDevice& device = shown().device;
  EXPECT_EQ(device.name, demo_->device().info().name);
  EXPECT_EQ(device.renderPath, renderPathName(demo_->device().renderPath()));
  EXPECT_EQ(device.samples.front(), 1);
  EXPECT_GT(shown().frame.deviceBytes, 1u << 20);
  EXPECT_GE(shown().frame.budgetBytes, shown().frame.usedBytes);
  for (const FeatureRow& feature : device.features) {
    EXPECT_FALSE(feature.about.empty()) << feature.name;
  }
  EXPECT_EQ(demo_->renderer().presentMode(), PresentMode::immediate);
  demo_->apply(SetPresentMode{0});
  run(4);
  EXPECT_EQ(demo_->renderer().presentMode(), demo_->renderer().presentModes()[0]);
}

class TurningMirror : public Journey {
 protected:
  TurningMirror() : Journey(wallScene + "spin = [0, 90, 0]\n") {}

  bool encodes() {
    run(4);
    return std::ranges::count(shown().frame.passes, PassKind::display, &PassRow::kind) == 0;
  }
};

TEST_F(TurningMirror, IsEncodedWhileNothingReadsItsRadiance) {
  EXPECT_TRUE(encodes());
  const auto before = std::filesystem::file_time_type::clock::now() - std::chrono::milliseconds(20);
  demo_->apply(OpenScene{writeScene("turning", wallScene + "spin = [0, 90, 0]\n")});
  ASSERT_TRUE(waitFor([&] { return shownScene().name == "turning"; }));
  EXPECT_TRUE(encodes());
  EXPECT_TRUE(std::ranges::any_of(std::filesystem::directory_iterator(userCacheDir() / "thumbnails"),
                                  [&](const auto& file) { return file.last_write_time() >= before; }))
      << "the first picture, which is stored, was not encoded";
  click("panel.Targets");
  run(3);
  click("targets.one");
  EXPECT_FALSE(encodes()) << "the panel shows it";
  const PixelRect canvas = widget("targets.canvas");
  moveTo(canvas.x + canvas.width / 2.0, canvas.y + canvas.height / 2.0);
  run(4);
  EXPECT_TRUE(shown().frame.target.value);
  click("panel.Targets");
  EXPECT_TRUE(encodes());
  press("c");
  EXPECT_FALSE(encodes()) << "A | B shows two pictures";
  press("c");
  EXPECT_TRUE(encodes());
  demo_->apply(SetPaused{true});
  run(20);
  EXPECT_FALSE(encodes()) << "the still picture is shown again";
  const Image8 still = barePicture();
  setSetting("debug.encode_early", "false");
  EXPECT_TRUE(barePicture().rgba == still.rgba);
}

// The wall mirror shows the door, whose back is seen directly.
class TwoMirrors : public Journey {
 protected:
  TwoMirrors()
      : Journey(wallScene + R"(
[[mirror]] name = "door", position = [1.6, 1.2, 0.5], rotation = [0, 200, 0], size = [1, 1.6]
)") {
    demo_->window().resize(across, height);
    EXPECT_TRUE(waitFor([&] { return demo_->renderer().displayExtent().width == uint32_t{across}; }));
    click("panel.Passes");
    run(3);
  }

  static constexpr int across = 1270;  // there is room for the picture between two panels

  // That the picture differs from `without` along these lines, and nowhere else.
  void expectOutline(const Image8& without, const std::vector<PixelLine>& lines, const std::string& name) {
    const Image8 with = picture();
    int changed = 0;
    const auto covered = [](int x, int y) {
      return std::ranges::any_of(ImGui::GetCurrentContext()->Windows, [&](const ImGuiWindow* window) {
        return window->Active && !window->Hidden && window->Rect().Contains(ImVec2(float(x), float(y)));
      });
    };
    for (int y = 30; y < height; ++y) {  // below the menus
      for (int x = 440; x < across; ++x) {
        if (std::equal(with.at(x, y), with.at(x, y) + 3, without.at(x, y)) || covered(x, y)) {
          continue;
        }
        ++changed;
        double nearest = 1e9;
        for (const PixelLine& line : lines) {
          const glm::dvec2 along = line.b - line.a;
          const glm::dvec2 p = glm::dvec2(x, y) + 0.5 - line.a;
          const double t = std::clamp(glm::dot(p, along) / std::max(glm::dot(along, along), 1e-6), 0.0, 1.0);
          nearest = std::min(nearest, glm::length(p - t * along));
        }
        ASSERT_LT(nearest, 6.0) << name << ": " << x << " " << y;
      }
    }
    EXPECT_GT(changed, 100) << name;
  }
};

TEST_F(TwoMirrors, PointedPassesAndMirrorsAreOutlined) {
  press("space");
  moveTo(200, 22);  // the title bar
  const Image8 without = picture();
  const PixelRect row = widget("pass.mirror wall > door");
  moveTo(row.x + row.width / 2, row.y + row.height / 2);
  run(3);
  ASSERT_EQ(shown().frame.outlinedPath, (MirrorPath{0, 1}));
  expectOutline(without, shown().frame.outline, "door in wall");
  click("skipped in main view");
  const PixelRect door = widget("skipped.door");
  moveTo(door.x + door.width / 2, door.y + door.height / 2);
  run(3);
  ASSERT_EQ(shown().frame.outlinedPath, MirrorPath{1});
  expectOutline(without, shown().frame.outline, "door");
  // Its corners: 0.5 m beside and 0.8 m above and below the middle, turned by 200 degrees, four metres from the eye.
  const double turn = glm::radians(200.0);
  const std::vector<PixelLine> outline = shown().frame.outline;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.8, 0.8}) {
      const glm::dvec3 p(1.6 + x * std::cos(turn), 0.2 + y, 4.0 - (0.5 - x * std::sin(turn)));
      const glm::dvec2 corner =
          0.5 * glm::dvec2(across, height) + 0.5 * height * std::sqrt(3.0) * glm::dvec2(p.x, -p.y) / p.z;
      const auto meets = [&](const PixelLine& line) {
        return std::min(glm::distance(line.a, corner), glm::distance(line.b, corner)) < 0.01;
      };
      const bool inside = corner.x > 0.0 && corner.x < across && corner.y > 0.0 && corner.y < height;
      EXPECT_EQ(std::ranges::any_of(outline, meets), inside) << corner.x << " " << corner.y;
    }
  }
  // Between the command and the next frame's list the row is one of a mirror that is gone.
  demo_->apply(SelectNode{{Selection::Kind::mirror, 1}});
  demo_->apply(RemoveSelected{});
  const auto gone = [&] {
    for (int i = 0; i < 4; ++i) {
      run(1);
      EXPECT_TRUE(shown().frame.outline.empty());
    }
  };
  gone();
  demo_->apply(Undo{});
  run(4);
  const PixelRect again = widget("skipped.door");
  moveTo(again.x + again.width / 2, again.y + again.height / 2);
  ASSERT_TRUE(waitFor([&] { return !shown().frame.outline.empty(); }));
  demo_->apply(OpenScene{writeScene("other", wallScene)});
  demo_->apply(DiscardChanges{});
  ASSERT_TRUE(waitFor([&] { return shownScene().name == "other"; }));
  gone();
}

struct OwnShaders {
  explicit OwnShaders(const std::string& appended) { writeShaders(shaders.path(), "scene_shading.glsl", appended); }
  Options options() const {
    Options options;
    options.shaderDir = shaders.path();
    options.settings = {{"debug.check_finite", "true"}};
    return options;
  }
  // Makes the file look as if it was edited a second later.
  void touch(const std::filesystem::path& file) const {
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(1));
  }
  TemporaryDirectory shaders;
};

class NegativeLight : protected OwnShaders, public Journey {
 protected:
  NegativeLight() : OwnShaders("  color.b = -1.0;\n"), Journey(wallScene, options()) { showsNonFinite_ = true; }
};

TEST_F(NegativeLight, IsLocatedUntilItIsGone) {
  EXPECT_TRUE(waitFor([&] { return !shown().message.empty(); }));
  EXPECT_TRUE(startsWith(shown().message, "mirror wall: pixel "));
  EXPECT_GT(demo_->nonFinite(), 0u);
  const std::filesystem::path shader = shaders.path() / "scene_shading.glsl";
  std::filesystem::copy_file(sourceFile("shaders/scene_shading.glsl"), shader,
                             std::filesystem::copy_options::overwrite_existing);
  touch(shader);
  EXPECT_TRUE(waitFor([&] { return shown().message.empty(); }));
  run(3);
  const uint64_t found = demo_->nonFinite();
  run(3);
  EXPECT_EQ(demo_->nonFinite(), found);
  const char* drawn = demo_->device().info().isCpu() ? "scene_handed.frag" : "scene.frag";
  std::ofstream(shaders.path() / drawn, std::ios::app) << "\nthis is not GLSL\n";
  touch(shaders.path() / drawn);
  EXPECT_TRUE(waitFor([&] { return contains(shown().message, drawn); })) << shown().message;
}

TEST_F(Journey, PanelsComeBeforeTheFirstPicture) {
  std::vector<std::string> lines;
  for (const LogLine& line : shown().log.lines()) {
    for (const char* start : {"panels shown", "first picture"}) {
      if (line.text.starts_with(start)) {
        lines.emplace_back(start);
      }
    }
  }
  EXPECT_EQ(lines, (std::vector<std::string>{"panels shown", "first picture"}));
}

TEST_F(Journey, TextIsReadable) {
  const ImFont& font = *ImGui::GetFont();
  EXPECT_FALSE(contains(font.GetDebugName(), "ProggyClean"));
  for (ImWchar digit = '1'; digit <= '9'; ++digit) {
    EXPECT_EQ(font.FindGlyph(digit)->AdvanceX, font.FindGlyph('0')->AdvanceX);
  }
  const auto luminance = [](const glm::vec3& c) {
    return 0.2126 * srgbDecode(c.x) + 0.7152 * srgbDecode(c.y) + 0.0722 * srgbDecode(c.z);
  };
  const auto styled = [](ImGuiCol color) {
    const ImVec4 c = ImGui::GetStyleColorVec4(color);
    return glm::vec3(c.x, c.y, c.z);
  };
  for (const char* theme : {"theme.dark", "theme.light"}) {
    click("menu.Window");
    run(2);
    click(theme);
    run(2);
    for (const glm::vec3& text : {styled(ImGuiCol_Text), styled(ImGuiCol_TextDisabled),
                                  panels::onTheme(panels::warningColor), panels::onTheme(panels::errorColor)}) {
      const double a = luminance(text) + 0.05;
      const double b = luminance(styled(ImGuiCol_WindowBg)) + 0.05;
      EXPECT_GT(std::max(a, b) / std::min(a, b), 4.5) << theme;
    }
  }
}

TEST_F(Journey, SizesFollowTheScaleOfTheMonitor) {
  const PixelRect before = widget("time");
  demo_.reset();
  const ProcessResult set =
      runProcess({"xprop", "-root", "-f", "RESOURCE_MANAGER", "8s", "-set", "RESOURCE_MANAGER", "Xft.dpi:\t192\n"});
  ASSERT_EQ(set.exitCode, 0) << set.output;
  start();
  ASSERT_EQ(demo_->window().contentScale(), 2.0f);
  EXPECT_NEAR(widget("time").height, 2 * before.height, 2);
  demo_->window().followContentScale(1.0f);  // to another monitor
  run(3);
  EXPECT_EQ(widget("time").height, before.height);
  setSetting("ui.scale", "1.5");
  run(3);
  EXPECT_NEAR(widget("time").height, 1.5 * before.height, 2);
  setSetting("ui.scale", "1");
  run(3);
  EXPECT_EQ(widget("time").height, before.height);
  demo_.reset();
  sizeDivisor = 2;
  start();
  sizeDivisor = 1;
  ASSERT_EQ(ImGui::GetIO().DisplaySize.x * 2.0f, width);
  EXPECT_NEAR(widget("time").height, before.height, 1) << "the monitor's scale is in the screen coordinates";
  EXPECT_EQ(ImGui::GetFont()->FontSize, 30.0f) << "sharp letters";
  runProcess({"xprop", "-root", "-remove", "RESOURCE_MANAGER"});
  EXPECT_TRUE(std::filesystem::exists(home_.path() / "XDG_CONFIG_HOME" / "speculum" / "layout.ini"));
  EXPECT_FALSE(std::filesystem::exists("imgui.ini"));
}

TEST_F(Journey, LayoutIsReadAndWrittenLikeOtherFiles) {
  demo_.reset();
  const std::filesystem::path layout = home_.path() / "XDG_CONFIG_HOME" / "speculum" / "layout.ini";
  const std::filesystem::path elsewhere = home_.path() / "elsewhere.ini";
  std::filesystem::rename(layout, elsewhere);
  const std::string before = readText(elsewhere);
  std::filesystem::create_symlink(elsewhere, layout);
  std::ofstream(elsewhere) << before << "[Panel][Of another version]\nSize=30,40\n\n";
  start();
  demo_.reset();
  EXPECT_TRUE(std::filesystem::is_symlink(layout));
  EXPECT_TRUE(contains(readText(elsewhere), "[Panel][Of another version]")) << "what was read is kept";
  std::filesystem::remove(layout);
  ASSERT_EQ(mkfifo(layout.c_str(), 0600), 0);
  start();  // waits for nobody
  run(3);
  demo_.reset();
  EXPECT_TRUE(std::filesystem::is_fifo(layout));
  start();
}

// The program with a window on a display of its own: an object is deleted, then the script's last part ends the window.
// `begin` is its first part.
ProcessResult endEditedWindow(const std::string& end, const std::string& begin = "") {
  const UserFolders home{"XDG_CONFIG_HOME", "XDG_CACHE_HOME"};
  const std::string start =
      R"(coproc X { exec Xvfb -displayfd 1 -screen 0 640x480x24 -nolisten tcp -noreset 2>/dev/null; }
    server=$X_PID; read -r number <&${X[0]}; export DISPLAY=:$number
    "$0" --scene "$1" --size 320x240 --set view.samples=1 --set reflection.samples=1 & pid=$!
    window=$(xdotool search --sync --onlyvisible --pid $pid | head -1)
    until xdotool getwindowname $window | grep -q '^window_end\*'; do
      xdotool key --window $window n; sleep 1; xdotool key --window $window Delete; sleep 1
    done
    )";
  const std::string program = (binaryDir() / "speculum").string();
  const std::string scene = writeScene("window_end", wallScene).string();
  return runProcess({"timeout", "300", "bash", "-c",
                     begin + start + end + "; wait $pid; code=$?; kill $server 2>/dev/null; exit $code", program,
                     scene});
}

TEST(EndedWindow, KeepsUnsavedWork) {
  const ProcessResult killed =
      endEditedWindow("sleep 2; kill -KILL $pid; ls \"$XDG_CONFIG_HOME/speculum/unsaved/1/window_end.toml\"");
  EXPECT_EQ(killed.exitCode, 128 + 9);
  EXPECT_TRUE(contains(killed.output, "/unsaved/1/window_end.toml\n")) << killed.output;
  EXPECT_FALSE(contains(killed.output, "cannot access"));
  for (const auto& [end, exitCode] : {std::pair("kill -TERM $pid", 0), std::pair("kill $server", 2)}) {
    const ProcessResult result = endEditedWindow(end);
    EXPECT_EQ(result.exitCode, exitCode) << end;
    EXPECT_TRUE(startsWith(result.output, "warning: unsaved changes are kept in ")) << end;
  }
}

// The window comes back, and offers what was kept.
TEST(EndedWindow, LostDeviceKeepsUnsavedWork) {
  const std::string layer = (binaryDir() / "tests" / "fault_layer").string();
  const ProcessResult result = endEditedWindow(
      R"(touch "$SPECULUM_FAULT_AFTER"; xdotool key --window $window w 2>/dev/null
      until xdotool search --onlyvisible --name '^window_end - ' 2>/dev/null | grep -q .; do sleep 0.2; done
      kill -TERM $pid)",
      "export VK_ADD_LAYER_PATH='" + layer + "' VK_INSTANCE_LAYERS=VK_LAYER_SPECULUM_fault NODEVICE_SELECT=1\n" +
          "export SPECULUM_FAULT='vkQueueSubmit 1 " + std::to_string(VK_ERROR_DEVICE_LOST) +
          "' SPECULUM_FAULT_AFTER=\"$1.lost\"; rm -f \"$1.lost\"\n");
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_TRUE(startsWith(result.output, "warning: unsaved changes are kept in "));
  EXPECT_TRUE(contains(result.output, "starting again"));
}

TEST(EndedWindow, NeedsNoReaderOfItsOutput) {
  const UserFolders home{"XDG_CONFIG_HOME", "XDG_CACHE_HOME"};
  const test::VirtualDisplay display;
  const std::string script =
      R"({ "$0" --scene no_mirror --size 64x36 --frames 2 --log-level info; echo $? >"$1"; } 2>&1 | true)";
  const std::filesystem::path code = home.path() / "code";
  runProcess({"timeout", "300", "bash", "-c", script, (binaryDir() / "speculum").string(), code.string()});
  EXPECT_EQ(readText(code), "0\n");
}

// An empty file hides the system's Vulkan loader.
TEST(EndedWindow, MissingLoaderIsNamed) {
  const UserFolders home{"XDG_CONFIG_HOME", "XDG_CACHE_HOME"};
  const test::VirtualDisplay display;
  replaceFile(home.path() / "libvulkan.so.1", std::string_view());
  const ProcessResult result = runProcess({"timeout", "60", "env", "LD_LIBRARY_PATH=" + home.path().string(),
                                           (binaryDir() / "speculum").string(), "--frames", "1"});
  EXPECT_EQ(result.exitCode, 2) << result.output;
  EXPECT_TRUE(startsWith(result.output, "Vulkan is missing: ")) << result.output;
  EXPECT_TRUE(contains(result.output, "install libvulkan1")) << result.output;
  EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
}

}  // namespace
}  // namespace speculum
