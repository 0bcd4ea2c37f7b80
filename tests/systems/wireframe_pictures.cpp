#include "sampling.hpp"
#include "scene_text.hpp"
#include "studio.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize wireSize{240, 136};

long lit(const Image8& picture) {
  const std::vector<bool> black = blackPixels(picture);
  return std::ranges::count(black, false);
}

// Random objects behind the eye, which a mirror shows; some are too near its edges to be seen but for thick lines.
std::filesystem::path sceneBehind(Random& random) {
  std::ostringstream toml;
  toml << "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nvertical_fov = 60\n[environment]\n"
          "ambient = [1, 1, 1]\n[[mirror]]\nposition = [0, 0, -2]\nsize = [1.5, 1.1]\n";
  const std::array models{"block", "teapot"};
  for (int i = 0; i < 8; ++i) {
    toml << "[[object]]\nmodel = \"MODELS/" << models[static_cast<size_t>(i) % models.size()] << ".obj\"\nposition = "
         << text(glm::dvec3(random.uniform(-3, 3), random.uniform(-2, 2), random.uniform(6, 9)))
         << "\nrotation = " << text(random.inBox(180.0)) << "\nscale = " << random.uniform(0.2, 1.2) << "\n";
  }
  return writeScene("behind", toml.str());
}

// An image as large as a wall shows, at the pixels of a small mirror, what the mirror shows.
TEST(Wireframe, WideLinesReachIntoImages) {
  Random random(21);
  const int scenes = fullTests() ? 200 : 6;
  int covered = 0;
  for (int i = 0; i < scenes; ++i) {
    Studio studio(headless(sceneBehind(random), wireSize, {{"view.wireframe", "true"}, {"view.line_width", "13"}}));
    studio.settings.view.samples = studio.settings.reflection.samples = i % 2 == 0 ? 1 : 4;
    studio.settings.debug.cullClusters = i % 3 != 0;
    const Image8 small = studio.fresh();
    studio.scene.mirrors[0].size = {30.0, 30.0};
    studio.settings.debug.cullClusters = studio.settings.debug.maskPasses = false;
    const Image8 wall = studio.fresh();
    const double scale = wireSize.height / (2.0 * std::tan(glm::radians(30.0)) * 6.0);  // pixels a metre in the mirror
    const glm::ivec2 half(glm::floor(0.5 * scale * glm::dvec2(1.5, 1.1) - 2.0));
    // Which pixels lines cover: those of equal depth change their order, and so colors, with the rectangle drawn.
    const std::vector<bool> black = blackPixels(small);
    const std::vector<bool> expected = blackPixels(wall);
    int different = 0;
    for (int y = -half.y; y < half.y; ++y) {
      for (int x = -half.x; x < half.x; ++x) {
        const auto k = static_cast<size_t>((wireSize.height / 2 + y) * wireSize.width + wireSize.width / 2 + x);
        covered += !expected[k];
        different += black[k] != expected[k];
      }
    }
    // Ends of lines move by rounding with the rectangle; a line that is left out has 13 pixels across.
    if (different > 6) {
      ADD_FAILURE() << "scene " << i << ": " << different << " pixels";
      writeEvidence(small, wall, "wide_lines_" + std::to_string(i));
    }
  }
  EXPECT_GT(covered, 50 * scenes);
}

TEST(Wireframe, LinesAreAsWideAsAsked) {
  Studio studio(headless(writeScene("block", R"(
[camera] position = [0, 0, 4], target = [0, 0, 0]
[environment] ambient = [1, 1, 1]
[[object]] model = "MODELS/block.obj", rotation = [20, 30, 0]
[[mirror]] position = [0, 0, -2], size = [9, 9]
)"),
                         wireSize, {{"view.wireframe", "true"}, {"view.samples", "1"}, {"reflection.samples", "1"}}));
  const auto litAt = [&](double width, double viewScale = 1.0, double mirrorScale = 1.0) {
    studio.settings.view.lineWidth = width;
    studio.settings.view.scale = viewScale;
    studio.settings.reflection.scale = mirrorScale;
    return static_cast<double>(lit(studio.fresh()));
  };
  const double thin = litAt(1.0);
  const double wide = litAt(5.0);
  EXPECT_GT(wide, 2.0 * thin);
  EXPECT_LT(wide, 5.5 * thin);
  EXPECT_NEAR(litAt(5.0, 0.5), wide, 0.4 * wide) << "pixels of the picture, whatever its resolution";
  EXPECT_NEAR(litAt(5.0, 1.0, 0.5), wide, 0.4 * wide);
}

TEST(Wireframe, HybridShadowsAreThoseOfRays) {
  const Options options = headless(writeScene("lit", R"(
[camera] position = [0, 1, 4], target = [0, 0, 0]
[[object]] model = "MODELS/block.obj", position = [0, -1, 0], scale = [4, 0.2, 4]
[[object]] model = "MODELS/teapot.obj"
[[light]] position = [1, 4, 2], intensity = 40, casts_shadow = true
)"),
                                   wireSize, {{"view.wireframe", "true"}, {"effects.shadow_lookup", "traced"}});
  Options hybrid = options;
  set(hybrid, {{"effects.shadow_lookup", "hybrid"}});
  const Image8 traced = draw(options);
  EXPECT_GT(lit(traced), 1000);
  EXPECT_EQ(draw(hybrid).rgba, traced.rgba);
}

TEST(Wireframe, NeedsNoPipelinesWhereThePolygonModeIsDynamic) {
  Studio studio(headless(sceneFile("gallery"), wireSize, {{"debug.check_finite", "false"}}));
  const PipelineFactory& pipelines = Gpu::shared().renderer.pipelines();
  const Image8 filled = studio.fresh();
  const size_t before = pipelines.count();
  studio.settings.view.wireframe = true;
  const Image8 lines = studio.fresh();
  EXPECT_NE(lines.rgba, filled.rgba);
  EXPECT_EQ(pipelines.count() == before, Gpu::shared().device.caps().dynamicPolygonMode);
  studio.settings.view.wireframe = false;
  EXPECT_EQ(studio.fresh().rgba, filled.rgba);
}

}  // namespace
}  // namespace speculum
