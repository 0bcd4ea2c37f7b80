// A window whose device runs out of memory goes on with less.
#include "app/screenshot.hpp"
#include "demo_window_support.hpp"
#include "frame/settings.hpp"
#include "scarce_memory.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// A texture of 256 x 256 RGBA16F texels with its levels takes 683 KiB and what the driver adds; nothing else of the
// scene is of such a size.
constexpr uint64_t fewest = 690'000;
constexpr uint64_t most = 760'000;

const std::string textured = R"(
[environment]
background = [0.2, 0.3, 0.4]
ambient = [0.3, 0.3, 0.3]
[camera]
position = [0, 1, 4]
target = [0, 1, 0]
[settings]
"view.samples" = 1
[[object]]
model = "MODELS/column.obj"
)";

class ScarceMemory : public DemoWindow {
 protected:
  ~ScarceMemory() override { giveMemory(); }

  std::filesystem::path open(const std::string& name) {
    const std::filesystem::path file = writeScene(name, textured);
    const int before = demo_->model().scene;
    demo_->openFile(file);
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (demo_->model().scene == before && Clock::now() < end) {
      run(1);
    }
    EXPECT_NE(demo_->model().scene, before);
    run(6);
    return file;
  }
  // Of the window without its panel.
  Image8 shown() {
    press("Tab");
    press("Escape");
    Image8 image = pictureOf(picture());
    press("Tab");
    return image;
  }
  Image8 expected(const std::filesystem::path& file, const std::string& textures) {
    Options options = headless(file, {width, height});
    set(options,
        {{"effects.textures", textures}, {"view.exposure", settingValue(demo_->model().settings, "view.exposure")}});
    return draw(options);
  }
};

TEST_F(ScarceMemory, TexturesThatDoNotFitAreLeftOutAndTheWindowLives) {
  press("space");
  refuseMemory(fewest, most);
  const std::filesystem::path file = open("scarce");
  EXPECT_GT(refusedAllocations(), 0);
  const std::string& message = demo_->model().message;
  EXPECT_EQ(message.find("drawn without textures until a setting is changed: allocate "), 0u) << message;
  EXPECT_NE(message.find("VK_ERROR_OUT_OF_DEVICE_MEMORY"), std::string::npos) << message;
  EXPECT_NE(demo_->model().log.history->lines().back().text.find(message), std::string::npos);
  EXPECT_TRUE(demo_->model().settings.effects.textures) << "the person's choice stays";
  const int refused = refusedAllocations();
  const Image8 without = shown();
  EXPECT_EQ(refusedAllocations(), refused) << "not tried in every frame";
  EXPECT_EQ(without.rgba, expected(file, "false").rgba);
  const auto told = [&] {
    const std::vector<LogLine>& lines = demo_->model().log.history->lines();
    return std::count_if(lines.begin(), lines.end(),
                         [&](const LogLine& line) { return line.text.find(message) != std::string::npos; });
  };
  EXPECT_EQ(told(), 1);
  drag("view.exposure", 0.5, 40);
  EXPECT_EQ(refusedAllocations(), 2 * refused) << "tried once the slider was let go";
  EXPECT_EQ(told(), 1) << "the same again";
  giveMemory();
  run(5);
  EXPECT_NE(message, "") << "nothing was changed";
  drag("view.exposure", 0.5, 10);
  run(5);
  EXPECT_EQ(message, "");
  const Image8 with = shown();
  EXPECT_EQ(with.rgba, expected(file, "true").rgba);
  EXPECT_NE(with.rgba, expected(file, "false").rgba);
  expectQuiet();
}

}  // namespace
}  // namespace speculum
