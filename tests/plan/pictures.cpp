#include "plan/refined_tiles.hpp"
#include "plan/support.hpp"
#include "support/random.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// Root mean square error of a mean's coverage, over straight edges and thin lines, half of them nearly along an axis.
double edgeError(const Settings& settings, const std::vector<glm::dvec2>& samples, int pictures) {
  constexpr int edges = 1000;
  Random random(11);
  double squares = 0.0;
  for (int i = 0; i < edges; ++i) {
    const double turn = i % 2 == 0 ? random.uniform(0.0, 6.2831853) : 1.5707963 * i + random.uniform(-0.02, 0.02);
    const glm::dvec2 across(std::cos(turn), std::sin(turn));
    const double begin = random.uniform(-0.8, 0.8);
    const double end = begin + (i % 3 == 0 ? random.uniform(0.0, 0.6) : 9.0);
    const auto covers = [&](const glm::dvec2& p) {
      const double at = glm::dot(across, p);
      return at > begin && at < end ? 1.0 : 0.0;
    };
    double truth = 0.0;
    constexpr int fine = 40;
    for (int k = 0; k < fine * fine; ++k) {
      truth += covers((glm::dvec2(k % fine, k / fine) + 0.5) / double(fine) - 0.5) / (fine * fine);
    }
    double mean = 0.0;
    for (int k = 0; k < pictures; ++k) {
      for (const glm::dvec2& sample : samples) {
        mean += covers(sample + pictureOffset(k, settings)) / static_cast<double>(pictures * samples.size());
      }
    }
    squares += (mean - truth) * (mean - truth) / edges;
  }
  return std::sqrt(squares);
}

TEST(PictureOffset, EdgesConvergeFromTheFirstPictureOn) {
  Settings settings;
  settings.view.samples = settings.reflection.samples = 1;
  EXPECT_EQ(pictureOffset(0, settings), glm::dvec2(0.0));
  double last = 1.0;
  for (const auto& [pictures, bound] :
       {std::pair(1, 0.26), std::pair(2, 0.22), std::pair(3, 0.185), std::pair(4, 0.115), std::pair(8, 0.065),
        std::pair(16, 0.044), std::pair(32, 0.03), std::pair(64, 0.026), std::pair(128, 0.0245), std::pair(256, 0.017),
        std::pair(1024, 0.011)}) {
    const double error = edgeError(settings, {{0.0, 0.0}}, pictures);
    EXPECT_LT(error, last) << pictures;
    EXPECT_LT(error, bound) << pictures;
    last = error;
  }
}

TEST(PictureOffset, EverySixtyFourFillTheReferencesGrid) {
  Settings settings;
  settings.view.samples = settings.reflection.samples = 1;
  for (int block = 0; block < 16; ++block) {
    std::set<std::pair<int, int>> cells;
    for (int i = 0; i < 64; ++i) {
      const glm::dvec2 cell = 8.0 * (pictureOffset(64 * block + i, settings) + 0.5);
      cells.emplace(static_cast<int>(std::floor(cell.x)), static_cast<int>(std::floor(cell.y)));
      EXPECT_TRUE(block > 0 || i == 0 || glm::length(glm::fract(cell) - 0.5) < 1e-12) << i;
    }
    EXPECT_EQ(cells.size(), 64u);
    EXPECT_EQ(cells.begin()->first, 0);
    EXPECT_EQ(cells.rbegin()->first, 7);
  }
}

TEST(PictureOffset, GridShrinksWithSampleCount) {
  const std::vector<glm::dvec2> standard{{-0.125, -0.375}, {0.375, -0.125}, {-0.375, 0.125}, {0.125, 0.375}};
  Settings settings;
  const double one = edgeError(settings, standard, 1);
  EXPECT_LT(edgeError(settings, standard, 4), 0.65 * one);
  EXPECT_LT(edgeError(settings, standard, 8), 0.5 * one);
  const auto farthest = [&] {
    double far = 0.0;
    for (int k = 0; k < singleSamplePictures; ++k) {
      const glm::dvec2 offset = glm::abs(pictureOffset(k, settings));
      far = std::max({far, offset.x, offset.y});
    }
    return far;
  };
  EXPECT_LT(farthest(), 0.18);
  settings.reflection.samples = 1;
  EXPECT_GT(farthest(), 0.43) << "mirror images of one sample leave all of it open";
}

TEST(PictureOffset, MovesAllViewsAlike) {
  const Scene scene = corridor();
  const SceneState state = evaluate(scene, 0.0);
  Settings settings;
  settings.view.accumulate = 64;
  settings.view.scale = 0.5;
  const Settings drawn = pictureSettings(settings);
  EXPECT_EQ(drawn.view.samples, 1);
  EXPECT_EQ(drawn.reflection.samples, 1);
  const FramePlan first = planFrame({scene, state, drawn, {width, height}, {}, 0});
  EXPECT_EQ(first.projection, planOf(scene).projection);
  Random random(5);
  for (const int picture : {1, 2, 40, 63}) {
    const FramePlan p = planFrame({scene, state, drawn, {width, height}, {}, picture});
    const glm::dvec2 moved = -2.0 * pictureOffset(picture, drawn) / p.main().view.pictureSize;
    ASSERT_EQ(p.passes.size(), first.passes.size());
    for (const Pass& pass : p.passes) {
      const View& view = pass.view;
      for (int k = 0; k < 20; ++k) {
        const glm::dvec3 direction = random.direction();
        const std::vector<glm::dvec3> point{view.eye + direction};
        const glm::dvec4 before = toClip(view, first.projection, point).front();
        const glm::dvec4 after = toClip(view, p.projection, point).front();
        EXPECT_NEAR(glm::length(after - before - glm::dvec4(moved * before.w, 0.0, 0.0)), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(p.projection.matrix() * glm::dvec4(view.worldToView * direction, 1.0) - after), 0.0,
                    1e-12);
        if (pass.id.kind == PassKind::main) {
          const bool inside = std::abs(after.x) <= after.w && std::abs(after.y) <= after.w;
          EXPECT_EQ(sphereVisible(view, point.front(), 0.0), inside);
        }
      }
    }
  }
  EXPECT_TRUE(planFrame({scene, state, drawn, {width, height}, {}, 64}).mainReused());
}

}  // namespace
}  // namespace speculum
