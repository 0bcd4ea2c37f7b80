// A window goes on with less if its device runs out of memory.
#include "faults/scarce_memory.hpp"
#include "window/journeys_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// A texture of 256 x 256 RGBA16F texels with its levels takes 683 KiB and what the driver adds; nothing else of the
// scene is of such a size.
constexpr uint64_t fewest = 690'000;
constexpr uint64_t most = 760'000;

std::string texturedScene() {
  return replaced(wallScene.substr(0, wallScene.find("[[light]]")), "sphere", "column");
}

class ScarceMemory : public Journey {
 protected:
  ~ScarceMemory() override { stopRefusingMemory(); }

  std::filesystem::path open(const std::string& name) {
    const std::filesystem::path file = writeScene(name, texturedScene());
    demo_->apply(OpenScene{file});
    EXPECT_TRUE(waitFor([&] { return shownScene().name == name; }));
    run(6);
    return file;
  }
  Image8 expected(const std::filesystem::path& file, const std::string& textures) {
    Options options =
        headless(file, {width, height},
                 {{"effects.textures", textures}, {"view.exposure", settingValue(shown().settings, "view.exposure")}});
    return draw(options);
  }
};

TEST_F(ScarceMemory, TexturesBeyondMemoryAreLeftOut) {
  press("space");
  refuseMemory(fewest, most);
  const std::filesystem::path file = open("scarce");
  EXPECT_GT(refusedAllocations(), 0);
  const std::string message = shown().message;
  EXPECT_TRUE(startsWith(message, "drawn without textures until a setting is changed: allocate "));
  EXPECT_TRUE(contains(message, "VK_ERROR_OUT_OF_DEVICE_MEMORY"));
  EXPECT_TRUE(contains(shown().log.lines().back().text, message));
  EXPECT_TRUE(shown().settings.effects.textures) << "the user's choice stays";
  const int refused = refusedAllocations();
  click("message.dismiss");
  const Image8 without = barePicture();
  EXPECT_EQ(refusedAllocations(), refused) << "not tried in every frame";
  EXPECT_EQ(without.rgba, expected(file, "false").rgba);
  const auto told = [&] {
    const std::vector<LogLine>& lines = shown().log.lines();
    return std::ranges::count_if(lines,
                                 [&](const LogLine& line) { return line.text.find(message) != std::string::npos; });
  };
  EXPECT_EQ(told(), 1);
  const PixelRect slider = widget("view.exposure");
  dragFrom(slider.x + slider.width / 2.0, slider.y + slider.height / 2.0, 40, 0);
  EXPECT_EQ(refusedAllocations(), 2 * refused) << "tried once the slider was let go";
  EXPECT_EQ(told(), 1) << "the same again";
  stopRefusingMemory();
  run(5);
  EXPECT_NE(shown().message, "") << "nothing was changed";
  setSetting("view.exposure", "1.5");
  run(5);
  EXPECT_EQ(shown().message, "");
  const Image8 with = barePicture();
  EXPECT_EQ(with.rgba, expected(file, "true").rgba);
  EXPECT_NE(with.rgba, expected(file, "false").rgba);
}

// Memory of targets and of copies, which no effect could do without.
TEST_F(ScarceMemory, UndrawableStepsAreTakenBack) {
  press("space");
  const Image8 before = barePicture();
  for (const bool copies : {true, false}) {
    const int refused = refusedAllocations();
    refuseMemory(1u << 18, UINT64_MAX);
    if (copies) {
      Object many = shown().edit.scene->objects.at(0);
      many.copies = {.count = 100'000, .step = {0.01, 0, 0}};
      demo_->apply(EditNode{{Selection::Kind::object, 0}, many});
    } else {
      Settings settings = shown().settings;
      settings.view.samples = 4;
      demo_->apply(SetSettings{settings});
    }
    ASSERT_TRUE(waitFor([&] { return refusedAllocations() > refused; })) << copies;
    stopRefusingMemory();  // what was drawn before fits again
    run(5);
    EXPECT_TRUE(startsWith(shown().message, "Cannot ")) << copies;
    EXPECT_EQ(shown().edit.scene->objects.at(0).copies, Copies());
    EXPECT_EQ(shown().settings.view.samples, 1);
    click("message.dismiss");
    EXPECT_TRUE(barePicture().rgba == before.rgba) << copies;
  }
}

// Turns the check of queue submissions off: it crashes in vkDeviceWaitIdle while an image is acquired (layer of
// 1.3.239).
class NoSubmissionCheck {
 public:
  NoSubmissionCheck() { setenv(name, "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT", 1); }
  ~NoSubmissionCheck() { before_.empty() ? unsetenv(name) : setenv(name, before_.c_str(), 1); }

 private:
  static constexpr const char* name = "VK_LAYER_ENABLES";
  std::string before_ = environment(name);
};

class EndingMemory : private NoSubmissionCheck, public ScarceMemory {};

// A larger window does not fit. To take back the user's last step does not help, so it is made again, the window ends,
// and the next start offers the changes.
TEST_F(EndingMemory, KeepsChanges) {
  demo_->apply(SelectNode{{Selection::Kind::object, 0}});
  demo_->apply(RemoveSelected{});
  run(5);
  refuseMemory(1u << 18, UINT64_MAX);
  demo_->setCapture(false);  // whose buffer would not fit either
  demo_->window().resize(width + 40, height + 40);
  std::string problem;
  for (int i = 0; i < 200 && problem.empty(); ++i) {
    try {
      demo_->step();
    } catch (const std::exception& error) {
      problem = error.what();
    }
  }
  EXPECT_TRUE(contains(problem, "VK_ERROR_OUT_OF_DEVICE_MEMORY")) << problem;
  stopRefusingMemory();
  demo_.reset();
  start();
  EXPECT_EQ(shown().edit.prompt, Prompt::recovery);
  const size_t objects = shown().edit.scene->objects.size();
  const std::filesystem::path kept = shown().edit.proposedFile;
  click("recovery.open");
  EXPECT_TRUE(waitFor([&] { return shown().edit.scene->file == kept; }));
  run(5);
  EXPECT_EQ(shown().edit.scene->objects.size() + 1, objects);
}

}  // namespace
}  // namespace speculum
