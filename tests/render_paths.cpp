#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <map>
#include <memory>

#include "image/picture_files.hpp"
#include "picture_support.hpp"
#include "sampling.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// Golden pictures hold on any CPU and Mesa: 3/255 a channel on 99.9 % of the pixels, no 3x3 block wholly over.
constexpr int tolerance = 3;
constexpr double animatedTime = 2.5;  // seconds

struct GoldenCase {
  std::string scene;
  double time = 0.0;
  int maxDepth = -1;  // -1: the scene's own

  std::string name() const {
    return scene + (time > 0.0 ? "_moved" : "") + (maxDepth >= 0 ? "_depth" + std::to_string(maxDepth) : "");
  }
  std::filesystem::path file() const { return sourceFile("tests/golden/" + name() + ".png"); }
};

std::vector<GoldenCase> goldenCases() {
  std::vector<GoldenCase> cases;
  for (const std::string scene :
       {"gallery", "single_plane", "facing_mirrors", "many_mirrors", "mirror_maze", "no_mirror", "outdoors"}) {
    cases.push_back({scene});
    cases.push_back({scene, animatedTime});
    if (scene == "gallery" || scene == "facing_mirrors" || scene == "many_mirrors") {
      for (int depth = 0; depth <= 4; ++depth) {
        cases.push_back({scene, 0.0, depth});
      }
    }
  }
  return cases;
}

constexpr PictureSize goldenSize{640, 360};

// The session of the last scene on each path and at each width; the next case may be of the same scene.
struct Kept {
  std::string scene;
  std::unique_ptr<Session> session;
};
std::map<std::pair<RenderPath, int>, Kept> kept;

Session& sessionOf(const std::string& scene, RenderPath path, PictureSize size) {
  Kept& last = kept[{path, size.width}];
  if (last.scene != scene) {
    Options options = headless(sourceFile("scenes/" + scene + ".toml"), size);
    options.renderPath = path;
    last.session = std::make_unique<Session>(options);
    last.scene = scene;
  }
  return *last.session;
}

Image8 drawCase(const GoldenCase& golden, RenderPath path, PictureSize size = goldenSize) {
  Session& session = sessionOf(golden.scene, path, size);
  Settings settings = settingsOf(session.scene());
  settings.debug.checkFinite = true;
  if (golden.maxDepth >= 0) {
    settings.reflection.maxDepth = golden.maxDepth;
  }
  session.setSettings(settings);
  session.restart();
  session.draw(golden.time, true);
  Image8 picture = session.picture();
  expectQuiet(session);
  return picture;
}

class Golden : public testing::TestWithParam<GoldenCase> {
 protected:
  static void TearDownTestSuite() { kept.clear(); }
};

TEST_P(Golden, IsDrawnAlikeOnBothPaths) {
  ASSERT_TRUE(std::filesystem::exists(GetParam().file())) << "scripts/test --update-golden draws it";
  const Image8 expected = readImage8(GetParam().file());
  const Image8 dynamic = drawCase(GetParam(), RenderPath::dynamic);
  expectAlike(dynamic, expected, tolerance, GetParam().name());
  const PictureSize size = fullTests() ? goldenSize : PictureSize{160, 90};
  const Image8 classic = drawCase(GetParam(), RenderPath::renderPass, size);
  EXPECT_EQ(classic.rgba, drawCase(GetParam(), RenderPath::dynamic, size).rgba) << "the render paths differ";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::ValuesIn(goldenCases()),
                         [](const auto& info) { return info.param.name(); });

void updateAll() {
  for (const GoldenCase& golden : goldenCases()) {
    writePng(golden.file(), drawCase(golden, RenderPath::automatic));
    std::printf("%s\n", golden.file().c_str());
  }
  kept.clear();
}

}  // namespace
}  // namespace speculum

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "--update") == 0) {
    speculum::updateAll();
    return 0;
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
