#include <chrono>
#include <thread>

#include "compare/picture_agreement.hpp"
#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "platform/files.hpp"
#include "platform/process.hpp"
#include "reference/ray_tracer.hpp"
#include "scene/scene_loader.hpp"
#include "test_headers.hpp"
#include "test_paths.hpp"
#include "virtual_display.hpp"

namespace speculum::testing_support {
namespace {

namespace fs = std::filesystem;

const fs::path sources = sourceDir() / "examples";

ProcessResult example(const std::string& name, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), (binaryDir() / "examples" / name).string());
  return runProcess(arguments);
}

// Draws a picture under validation, which must say nothing.
Image8 draw(const std::string& name, std::vector<std::string> arguments) {
  const fs::path file = binaryDir() / "tests" / ("example_" + name + ".png");
  arguments.insert(arguments.end(), {"--out", file.string(), "--validation"});
  const ProcessResult result = example(name, arguments);
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_EQ(result.output, "");
  return readImage8(file);
}

class Step : public testing::TestWithParam<std::string> {};

TEST_P(Step, BothPathsDrawTheSameBytes) {
  const std::vector<std::string> size{"--size", "161x90", "--time", "0.4"};
  std::vector<std::string> path = size;
  path.insert(path.end(), {"--render-path", "dynamic"});
  const Image8 dynamic = draw(GetParam(), path);
  path.back() = "renderpass";
  EXPECT_EQ(draw(GetParam(), path).rgba, dynamic.rgba);
  ASSERT_EQ(dynamic.width, 161);
  EXPECT_GT(std::set<uint8_t>(dynamic.rgba.begin(), dynamic.rgba.end()).size(), 50u) << "there is something in it";
}

// Devices without them say so; validation layers that do not know them are refused.
TEST_P(Step, ShaderObjectsDrawTheSameBytes) {
  const std::string file = (binaryDir() / "tests" / ("objects_" + GetParam() + ".png")).string();
  const std::vector<std::string> size{"--size", "161x90", "--out", file};
  std::vector<std::string> objects = size;
  objects.insert(objects.end(), {"--shaders", "objects"});
  const ProcessResult result = example(GetParam(), objects);
  if (contains(result.output, "has no VK_EXT_shader_object")) {
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1);
    return;
  }
  ASSERT_EQ(result.exitCode, 0) << result.output;
  const Image8 drawn = readImage8(file);
  objects.emplace_back("--validation");
  const ProcessResult validated = example(GetParam(), objects);
  if (validated.exitCode != 0) {
    EXPECT_TRUE(contains(validated.output, "the validation layer is older than")) << validated.output;
    EXPECT_EQ(validated.exitCode, 2);
  }
  ASSERT_EQ(example(GetParam(), size).exitCode, 0);
  EXPECT_EQ(readImage8(file).rgba, drawn.rgba);
}

INSTANTIATE_TEST_SUITE_P(Examples, Step, testing::Values("triangle", "offscreen", "one_mirror", "mirror_in_mirror"),
                         [](const auto& info) { return info.param; });

class MirrorStep : public testing::TestWithParam<std::string> {};

TEST_P(MirrorStep, PicturesAgreeWithTheTracer) {
  const Scene scene = loadScene(sources / GetParam() / "scene.toml");
  const RayTracer tracer(scene, evaluate(scene, 3.7));
  const TraceOptions options{.width = 320, .height = 180, .samples = 1, .maxDepth = 8};
  const Image8 truth = toDisplay(tracer.render(options)->image);
  const Image8 drawn = draw(GetParam(), {"--size", "320x180", "--time", "3.7"});
  const PictureAgreement agreement = difference(drawn, truth, 2);
  EXPECT_TRUE(agreement.holds()) << agreement.over << " of " << agreement.counted << " pixels";
}

TEST_P(MirrorStep, NaiveIsComparedInOneLine) {
  const std::string file = (binaryDir() / "tests" / "example_naive.png").string();
  const ProcessResult result = example(GetParam(), {"--naive", "--size", "160x90", "--out", file});
  ASSERT_EQ(result.exitCode, 0) << result.output;
  double naive = 0.0, naiveMs = 0.0, exact = 0.0, exactMs = 0.0;
  ASSERT_EQ(std::sscanf(result.output.c_str(), "naive: FLIP %lf in %lf ms; exact: FLIP %lf in %lf ms\n", &naive,
                        &naiveMs, &exact, &exactMs),
            4)
      << result.output;
  EXPECT_EQ(std::ranges::count(result.output, '\n'), 1);
  EXPECT_GT(naive, 0.02);
  EXPECT_LT(exact, 0.002);
  EXPECT_GT(std::min(naiveMs, exactMs), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Examples, MirrorStep, testing::Values("one_mirror", "mirror_in_mirror"),
                         [](const auto& info) { return info.param; });

TEST(Examples, BadUsageIsOneLine) {
  const std::vector<std::vector<std::string>> mistakes = {{"--size", "3"},
                                                          {"--size", "0x9"},
                                                          {"--frames", "0"},
                                                          {"--frames", "many"},
                                                          {"--time", "nan"},
                                                          {"--time"},
                                                          {"--out", "a.jpg"},
                                                          {"--out", "/nowhere/a.png"},
                                                          {"--shaders", "none"},
                                                          {"--shaders", "objects", "--render-path", "renderpass"},
                                                          {"--fast"},
                                                          {"picture"},
                                                          {"--naive"},
                                                          {"--render-path", "both"}};
  for (const std::vector<std::string>& arguments : mistakes) {
    const ProcessResult result = example("triangle", arguments);
    EXPECT_EQ(result.exitCode, 2) << arguments[0] << ": " << result.output;
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << arguments[0] << ": " << result.output;
  }
}

TEST(Examples, StepsStayShort) {
  const auto lines = [](const fs::path& file) {
    const std::string text = readText(file);
    return std::ranges::count(text, '\n');
  };
  std::string before;
  for (const std::string name : {"triangle", "offscreen", "one_mirror", "mirror_in_mirror"}) {
    for (const auto& entry : fs::directory_iterator(sources / name)) {
      const std::string ending = entry.path().extension().string();
      if (ending == ".vert" || ending == ".frag" || ending == ".glsl") {
        EXPECT_LE(lines(entry.path()), 60) << entry.path();
      }
    }
    const fs::path main = sources / name / "main.cpp";
    EXPECT_LE(lines(main), 350);
    if (!before.empty()) {
      const std::string changes = runProcess({"diff", (sources / before / "main.cpp").string(), main.string()}).output;
      EXPECT_LE(std::ranges::count(changes, '\n'), 100) << before << " to " << name;
      const std::string step =
          runProcess({"diff", "-r", "-x", "*.toml", (sources / before).string(), (sources / name).string()}).output;
      EXPECT_LE(std::ranges::count(step, '\n'), 130) << before << " to " << name << " with shaders";
    }
    before = name;
  }
}

// The examples stand on core: what they show must not be done by the layers above it.
TEST(Examples, UseNoSystemsOfTheProgram) {
  for (const auto& entry : fs::recursive_directory_iterator(sources)) {
    if (entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") {
      const std::string text = readText(entry.path());
      for (const char* layer : {"\"settings/", "\"plan/", "\"systems/", "\"ui/", "\"session/", "\"window/", "\"cli/"}) {
        EXPECT_EQ(text.find(layer), std::string::npos) << entry.path() << ": " << layer;
      }
    }
  }
}

// Lays out files as cmake/install.cmake does.
TEST(Examples, InstalledProgramsFindTheirFiles) {
  const TemporaryDirectory prefix;
  const fs::path programs = prefix.path() / "libexec" / "speculum" / "examples";
  const fs::path data = prefix.path() / "share" / "speculum";
  fs::create_directories(programs);
  fs::create_directories(data);
  fs::copy_file(binaryDir() / "examples" / "one_mirror", programs / "one_mirror");
  fs::create_directory_symlink(binaryDir() / "examples" / "shaders", programs / "shaders");
  fs::create_directory_symlink(sourceDir() / "models", data / "models");
  fs::create_directory_symlink(sources, data / "examples");
  const std::string out = (prefix.path() / "picture.png").string();
  const ProcessResult result =
      runProcess({(programs / "one_mirror").string(), "--size", "16x9", "--naive", "--out", out});
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_TRUE(isFile(out));
}

using WindowRun = std::pair<std::string, std::string>;  // name and render path
class WindowStep : public testing::TestWithParam<WindowRun> {};

TEST_P(WindowStep, ResizesAndMinimises) {
  static const test::VirtualDisplay display;  // a second one may get the number of the first, which still ends
  const auto& [name, path] = GetParam();
  ChildProcess child(
      {(binaryDir() / "examples" / name).string(), "--size", "320x200", "--validation", "--render-path", path});
  const auto xdotool = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "xdotool");
    return runProcess(arguments);
  };
  std::string window;
  for (int i = 0; i < 600 && window.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    window = xdotool({"search", "--name", "^" + name + "$"}).output;
  }
  window = window.substr(0, window.find('\n'));
  const auto frames = [] { std::this_thread::sleep_for(std::chrono::milliseconds(150)); };
  for (const std::vector<std::string>& action :
       std::vector<std::vector<std::string>>{{"windowsize", window, "211", "130"},
                                             {"windowminimize", window},
                                             {"windowmap", window},
                                             {"windowsize", window, "1", "130"},
                                             // larger than before, and than the OffScreen of `offscreen`
                                             {"windowsize", window, "613", "261"}}) {
    frames();
    const ProcessResult done = xdotool(action);
    ASSERT_EQ(done.exitCode, 0) << action.front() << ": " << done.output;
  }
  frames();
  EXPECT_TRUE(child.running());
  xdotool({"keydown", "--window", window, "Escape"});
  const ProcessResult result = child.wait();
  xdotool({"keyup", "Escape"});  // the display would repeat it for the next window
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_EQ(result.output, "");
}

// Different names, so that no window of the run before is found.
INSTANTIATE_TEST_SUITE_P(Examples, WindowStep,
                         testing::Values(WindowRun{"triangle", "dynamic"}, WindowRun{"offscreen", "renderpass"},
                                         WindowRun{"one_mirror", "dynamic"},
                                         WindowRun{"mirror_in_mirror", "renderpass"}),
                         [](const auto& info) { return info.param.first; });

TEST(Examples, WindowEndsAfterItsFrames) {
  const test::VirtualDisplay display;
  const ProcessResult result = example("triangle", {"--size", "160x100", "--frames", "3", "--validation"});
  EXPECT_EQ(result.exitCode, 0) << result.output;
  EXPECT_EQ(result.output, "");
}

}  // namespace
}  // namespace speculum::testing_support
