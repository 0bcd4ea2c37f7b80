// Device, log, present mode, and what points at passes in the picture.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <functional>

#include "demo_window_support.hpp"
#include "image/color.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// The wall mirror shows the door, whose back is seen directly.
const std::string twoMirrors = windowScene + R"(
[[mirror]]
name = "door"
position = [1.6, 1.2, 0.5]
rotation = [0, 200, 0]
size = [1, 1.6]
)";

class Panels : public DemoWindow {
 protected:
  explicit Panels(const std::string& toml = windowScene) : DemoWindow(toml) {}

  // Wheel clicks downwards over the panel until the widget is there.
  void scrollTo(const std::string& key) {
    const auto within = [&] {
      for (const auto& [name, rect] : demo_->model().widgets) {
        if (name == key && rect.y > 40 && rect.y + rect.height < height - 70) {
          return true;
        }
      }
      return false;
    };
    moveTo(25, 400);
    for (int i = 0; i < 30 && !within(); ++i) {
      xdotool({"click", "5"});
      run(2);
    }
    ASSERT_TRUE(within()) << key;
  }
};

TEST_F(Panels, DeviceShowsWhatTheDeviceIs) {
  const Pixels before = picture();
  click("panel.Device");
  const UiDevice& shown = demo_->model().device;
  const Device& device = demo_->device();
  EXPECT_EQ(shown.name, device.info().name);
  EXPECT_EQ(shown.driver, device.info().driver);
  EXPECT_EQ(shown.renderPath, renderPathName(device.renderPath()));
  EXPECT_EQ(shown.samples.find("1 "), 0u);
  EXPECT_EQ(shown.samples.find("8") != std::string::npos, (device.caps().sampleCounts & VK_SAMPLE_COUNT_8_BIT) != 0);
  EXPECT_GT(demo_->model().deviceBytes, 1u << 20);
  EXPECT_GE(shown.budgetBytes, shown.usedBytes);
  for (const UiFeature& feature : shown.features) {
    EXPECT_FALSE(feature.about.empty()) << feature.name;
    if (feature.name == "dynamic rendering") {
      EXPECT_EQ(feature.present, device.caps().dynamicRendering);
    }
  }
  EXPECT_NE(before.rgba, picture().rgba);
  expectQuiet();
}

TEST_F(Panels, LogShowsFiltersAndCopies) {
  click("panel.Log");
  spdlog::info("the quick brown fox");
  spdlog::error("a lazy dog");
  run(2);
  click("log.copy");
  const std::string all = demo_->window().clipboard();
  EXPECT_NE(all.find("info: the quick brown fox\n"), std::string::npos) << all;
  EXPECT_NE(all.find("error: a lazy dog\n"), std::string::npos) << all;
  EXPECT_NE(all.find("GPU "), std::string::npos) << "what was said at the start";
  click("log.filter");
  for (const char* key : {"d", "o", "g"}) {
    press(key);
  }
  click("log.copy");
  EXPECT_EQ(demo_->window().clipboard(), "error: a lazy dog\n");
  click("log.clear");
  EXPECT_TRUE(demo_->model().log.history->lines().empty());
  expectQuiet();
}

TEST_F(Panels, ThePresentModeIsChosenAmongThoseOffered) {
  const UiModel& model = demo_->model();
  ASSERT_FALSE(model.presentModes.empty());
  EXPECT_EQ(demo_->renderer().presentMode(), PresentMode::immediate);
  click("section.window");
  click("present.fifo");
  run(5);
  EXPECT_EQ(demo_->renderer().presentMode(), PresentMode::fifo);
  click("present.immediate");
  run(5);
  EXPECT_EQ(demo_->renderer().presentMode(), PresentMode::immediate);
  expectQuiet();
}

class PanelsWithTwoMirrors : public Panels {
 protected:
  PanelsWithTwoMirrors() : Panels(twoMirrors) {}

  // That pointing at the widget draws along these lines of the picture, and nothing else.
  void expectOutline(const std::string& key, const std::function<std::vector<PixelLine>()>& outline) {
    scrollTo(key);
    const PixelRect row = widget(key);
    moveTo(row.x + row.width / 2, 22);  // the title bar
    run(2);
    const Pixels without = picture();
    moveTo(row.x + row.width / 2, row.y + row.height / 2);
    run(2);
    const Pixels with = picture();
    lines_ = outline();
    int changed = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 440; x < width; ++x) {
        const size_t at = 4 * (static_cast<size_t>(y) * width + x);
        if (!std::equal(&with.rgba[at], &with.rgba[at] + 3, &without.rgba[at])) {
          ++changed;
          double nearest = 1e9;
          for (const PixelLine& line : lines_) {
            const glm::dvec2 along = line.b - line.a;
            const glm::dvec2 p = glm::dvec2(x, y) + 0.5 - line.a;
            const double t = std::clamp(glm::dot(p, along) / std::max(glm::dot(along, along), 1e-6), 0.0, 1.0);
            nearest = std::min(nearest, glm::length(p - t * along));
          }
          ASSERT_LT(nearest, 6.0) << key << ": " << x << " " << y;
        }
      }
    }
    EXPECT_GT(changed, 100) << key;
  }

  std::vector<PixelLine> lines_;
};

TEST_F(PanelsWithTwoMirrors, PointingAtAPassOutlinesItsMirror) {
  press("space");
  for (const std::string name : {"mirror wall", "mirror wall > door"}) {
    const auto& passes = demo_->model().passes;
    const auto pass = std::find_if(passes.begin(), passes.end(), [&](const UiPass& p) { return p.name == name; });
    ASSERT_NE(pass, passes.end()) << name;
    ASSERT_GE(pass->outline.size(), 3u);
    const std::vector<glm::vec2> outline = pass->outline;
    expectOutline("pass." + name, [&] {
      std::vector<PixelLine> lines;
      for (size_t i = 0; i < outline.size(); ++i) {
        lines.push_back({outline[i], outline[(i + 1) % outline.size()]});
      }
      return lines;
    });
  }
  expectQuiet();
}

TEST_F(PanelsWithTwoMirrors, PointingAtASkippedMirrorOutlinesIt) {
  press("space");
  const auto& skipped = demo_->model().skipped;
  const auto door =
      std::find_if(skipped.begin(), skipped.end(), [](const UiSkipped& s) { return s.mirrors == std::vector<int>{1}; });
  ASSERT_NE(door, skipped.end()) << "its back is seen";
  scrollTo("skipped in main view");
  const PixelRect list = widget("skipped in main view");
  moveTo(list.x + 10, list.y + list.height / 2);
  xdotool({"click", "1"});
  run(3);
  expectOutline("skipped.door", [&] { return demo_->model().skippedOutline; });
  // Its corners: 0.5 m beside and 0.8 m above and below the middle, turned by 200 degrees, four metres from the eye.
  const double turn = glm::radians(200.0);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.8, 0.8}) {
      const glm::dvec3 p(1.6 + x * std::cos(turn), 0.2 + y, 4.0 - (0.5 - x * std::sin(turn)));
      const glm::dvec2 at =
          0.5 * glm::dvec2(width, height) + 0.5 * height * std::sqrt(3.0) * glm::dvec2(p.x, -p.y) / p.z;
      const auto meets = [&](const PixelLine& line) {
        return std::min(glm::distance(line.a, at), glm::distance(line.b, at)) < 0.01;
      };
      const bool inside = at.x > 0.0 && at.x < width && at.y > 0.0 && at.y < height;
      EXPECT_EQ(std::any_of(lines_.begin(), lines_.end(), meets), inside) << at.x << " " << at.y;
    }
  }
  expectQuiet();
}

class PanelsWithASkippedRow : public PanelsWithTwoMirrors {
 protected:
  // The pointer on the row of the door, whose back is seen; its outline is drawn.
  void pointAtTheDoor() {
    press("space");
    scrollTo("skipped in main view");
    click("skipped in main view");
    scrollTo("skipped.door");
    const PixelRect row = widget("skipped.door");
    moveTo(row.x + row.width / 2, row.y + row.height / 2);
    run(2);
    ASSERT_EQ(demo_->model().outlinedSkipped, std::vector<int>{1});
  }
  void expectNoOutline() {
    EXPECT_TRUE(demo_->model().outlinedSkipped.empty());
    EXPECT_TRUE(demo_->model().skippedOutline.empty());
  }
};

TEST_F(PanelsWithASkippedRow, AMirrorThatIsPointedAtIsDeleted) {
  press("n");
  press("n");
  ASSERT_EQ(demo_->model().edit.selected, (Selection{Selection::Kind::mirror, 1}));
  pointAtTheDoor();
  const size_t things = demo_->model().edit.things.size();
  xdotool({"key", "--window", windowId(), "Delete"});
  // Between the event and the next frame's list the row is one of a mirror that is gone.
  for (int i = 0; i < 6; ++i) {
    run(1);
    expectNoOutline();
  }
  EXPECT_EQ(demo_->model().edit.things.size(), things - 1);
  press("ctrl+z");
  EXPECT_EQ(demo_->model().edit.things.size(), things);
  expectQuiet();
}

TEST_F(PanelsWithASkippedRow, AnotherSceneComesWhileItIsPointedAt) {
  pointAtTheDoor();
  const int before = demo_->model().scene;
  demo_->openFile(writeScene("other", twoMirrors));
  const auto end = Clock::now() + std::chrono::seconds(20);
  while (demo_->model().scene == before && Clock::now() < end) {
    run(1);
  }
  ASSERT_NE(demo_->model().scene, before);
  expectNoOutline();
  expectQuiet();
}

TEST_F(Panels, WindowsStandBesideEachOtherAndComeBackFromATinyWindow) {
  press("F2");
  for (const char* name : {"panel.Performance", "panel.Log"}) {
    click(name);
  }
  const PixelRect list = widget("edit.add_mirror");
  const PixelRect copy = widget("log.copy");
  const PixelRect csv = widget("performance.copy");
  EXPECT_LT(list.y + list.height, csv.y);
  EXPECT_LT(csv.y + csv.height, copy.y);
  EXPECT_LT(copy.y + copy.height, height);
  demo_->window().resize(300, 200);
  run(8);
  demo_->window().resize(width, height);
  run(8);
  EXPECT_EQ(widget("log.copy").y, copy.y);
  EXPECT_EQ(widget("log.copy").x, copy.x);
  // Moved by its title.
  moveTo(copy.x - 100, copy.y - 16);
  xdotool({"mousedown", "1"});
  run(3);
  moveTo(copy.x - 200, copy.y - 116);
  xdotool({"mouseup", "1"});
  run(3);
  const PixelRect moved = widget("log.copy");
  EXPECT_EQ(moved.x, copy.x - 100);
  demo_->window().resize(500, 300);
  run(8);
  EXPECT_LT(widget("log.copy").x, 500);
  EXPECT_LT(widget("log.copy").y, 300);
  demo_->window().resize(width, height);
  run(8);
  EXPECT_EQ(widget("log.copy").x, moved.x) << "what a tiny window forced is forgotten";
  EXPECT_EQ(widget("log.copy").y, moved.y);
  demo_.reset();
  start();
  EXPECT_EQ(widget("log.copy").x, moved.x) << "the layout file has it";
  scrollTo("section.window");
  click("section.window");
  scrollTo("window.reset");
  click("window.reset");
  run(3);
  EXPECT_GT(widget("log.copy").x, moved.x + 50);
  expectQuiet();
}

TEST_F(Panels, TargetsZoomAndMove) {
  press("space");
  click("panel.Targets");
  run(3);
  const UiTargets& targets = demo_->model().targets;
  const UiModel& model = demo_->model();
  ASSERT_GE(model.debugPass, 0);
  EXPECT_EQ(model.passes[static_cast<size_t>(model.debugPass)].name, "main view");
  EXPECT_EQ(targets.size, glm::ivec2(width, height));
  const PixelRect canvas = widget("targets.canvas");
  EXPECT_NEAR(targets.shownZoom, std::min(double(canvas.width) / width, double(canvas.height) / height), 1e-6);
  click("targets.one");
  EXPECT_EQ(targets.shownZoom, 1.0);
  const int x = canvas.x + canvas.width / 2;
  const int y = canvas.y + canvas.height / 2;
  moveTo(x, y);
  const glm::dvec2 before = targets.center;
  xdotool({"mousedown", "1"});
  run(2);
  moveTo(x - 20, y - 10);
  xdotool({"mouseup", "1"});
  run(2);
  EXPECT_NEAR(targets.center.x - before.x, 20.0, 1e-6);
  EXPECT_NEAR(targets.center.y - before.y, 10.0, 1e-6);
  xdotool({"click", "4"});
  run(3);
  EXPECT_GT(targets.shownZoom, 1.1);
  // What stands under the pointer is what the picture shows there.
  run(4);
  ASSERT_TRUE(targets.pointed && targets.value);
  const UiTexel value = *targets.value;
  ASSERT_EQ(value.texel, *targets.pointed);
  EXPECT_FALSE(value.depth);
  press("Tab");
  const Pixels plain = picture();
  EXPECT_FALSE(targets.value) << "nobody points";
  const uint8_t* there = &plain.rgba[4 * (static_cast<size_t>(value.texel.y) * width + value.texel.x)];
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(there[i], 255.0 * srgbEncode(std::clamp(value.value[i], 0.0, 1.0)), 0.6);
  }
  press("Tab");
  click("targets.depth");
  moveTo(x, y);
  run(4);
  ASSERT_TRUE(targets.value && targets.value->depth);
  EXPECT_GT(targets.value->metres, 3.0);
  const Pixels grey = picture();
  const uint8_t* middle = &grey.rgba[4 * (static_cast<size_t>(y) * width + x)];
  EXPECT_EQ(middle[0], middle[1]);
  EXPECT_EQ(middle[1], middle[2]);
  click("targets.mask");
  run(3);
  EXPECT_EQ(targets.mask.size(), 4u) << "the main view has none";
  EXPECT_EQ(targets.mirrors.size(), 1u);
  click("targets.fit");
  EXPECT_EQ(targets.zoom, 0.0);
  click("panel.Targets");
  run(3);
  EXPECT_EQ(model.debugPass, -1);
  expectQuiet();
}

}  // namespace
}  // namespace speculum
