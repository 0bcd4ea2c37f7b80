// Mirrors that a view sees, found by the hierarchy of mirrors, against a look at every mirror; and the list of the
// others with their reasons.
#include "plan/mirror_sight.hpp"
#include "plan/support.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

class SkippedMirrors : public testing::TestWithParam<unsigned> {
 protected:
  Random random{GetParam()};

  // Mirrors of all sizes: on walls, which share planes and edges, in a crowd, and around the eye; most of them turn.
  Scene scene() {
    const glm::dvec3 origin = random.chance(0.3) ? random.inBox(1e7) : glm::dvec3(0.0);
    Scene scene;
    const int count = static_cast<int>(std::pow(10.0, random.uniform(0.0, 2.3)));
    const bool onWalls = random.chance(0.5);
    for (int i = 0; i < count; ++i) {
      Mirror mirror;
      if (onWalls) {
        const bool front = i % 2 == 0;
        mirror = wall({i / 2 % 8 - 4.0, i / 16 - 3.0, front ? -6.0 : 6.0}, front ? 0.0 : 180.0, {1, 1});
      } else {
        mirror =
            wall(random.inBox(8.0), 0.0, glm::dvec2(std::pow(10.0, random.uniform(-4.0, 2.0)), random.uniform(0.1, 3)));
        mirror.rotation = 180.0 * random.inBox(1.0);
        mirror.spin = random.chance(0.5) ? 90.0 * random.inBox(1.0) : glm::dvec3(0.0);
        if (random.chance(0.05)) {
          mirror.size = glm::dvec2(1e11);
        }
      }
      mirror.position += origin;
      mirror.twoSided = random.chance(0.5);
      scene.mirrors.push_back(mirror);
    }
    scene.camera.position = origin + random.inBox(3.0);
    scene.camera.target = scene.camera.position + random.inBox(1.0);
    return scene;
  }
};

// Says whether the lines of sight of the view meet the mirror's plane only before they pass its own mirror.
bool liesBefore(const SceneState& state, const View& view, int mirror) {
  View through = view;
  through.clip.reset();
  const Polygon window = view.path.empty() ? Polygon() : visiblePart(through, state.mirrors[view.path.back()].polygon);
  const double height = heightAbove(state.mirrors[mirror], view.eye);
  return height != 0.0 && !window.empty() && std::ranges::all_of(window, [&](const glm::dvec3& p) {
           return height * heightAbove(state.mirrors[mirror], p) <= 0.0;
         });
}

bool isSeen(const Scene& scene, const SceneState& state, const View& view, int mirror) {
  const MirrorState& placed = state.mirrors[mirror];
  return (view.path.empty() || state.mirrors[view.path.back()].plane != placed.plane) &&
         !isBehindEye(view, placed.polygon) && !sightOf(scene, state, view, view, mirror).visible.empty() &&
         !liesBefore(state, view, mirror);
}

// The reason of a mirror that is not seen.
SkipReason reasonOf(const Scene& scene, const SceneState& state, const View& view, int mirror) {
  return isBehindEye(view, state.mirrors[mirror].polygon)                                ? SkipReason::behind
         : showsBack(scene.mirror(mirror), heightAbove(state.mirrors[mirror], view.eye)) ? SkipReason::backface
                                                                                         : SkipReason::outside;
}

TEST_P(SkippedMirrors, AreThoseOfALookAtEveryMirror) {
  const Scene scene = this->scene();
  Settings settings;
  settings.reflection.maxPasses = 40;
  for (const double time : {0.0, 0.7}) {
    const SceneState state = evaluate(scene, time);
    const FramePlan plan = planFrame({scene, state, settings, {width, height}});
    const RecycledVector<SkippedMirror> all = skippedMirrors(scene, state, plan, SIZE_MAX);
    EXPECT_EQ(all.size(), skippedCount(plan));
    size_t unseen = 0;
    for (const Pass& pass : plan.passes) {
      for (int i = 0; i < static_cast<int>(scene.mirrorCount()); ++i) {
        MirrorPath path = pass.view.path;
        if (!path.empty() && path.back() == i) {
          continue;
        }
        path.push_back(i);
        const bool drawn = std::ranges::find(pass.mirrors, i, &MirrorDraw::mirror) != pass.mirrors.end();
        const auto listed = std::ranges::find(all, path, &SkippedMirror::path);
        if (isSeen(scene, state, pass.view, i)) {
          EXPECT_TRUE(drawn || skipOf(plan, path)) << "time " << time << ", mirror " << i;
        } else {
          ++unseen;
          EXPECT_FALSE(drawn || skipOf(plan, path)) << "time " << time << ", mirror " << i;
          ASSERT_NE(listed, all.end());
          EXPECT_EQ(listed->reason, reasonOf(scene, state, pass.view, i));
        }
      }
    }
    EXPECT_EQ(all.size(), unseen + plan.skipped.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SkippedMirrors, testing::ValuesIn(sampledSeeds(300, 15)),
                         testing::PrintToStringParamName());

// A mirror beside the eye is seen in the large one that the eye looks at, wherever that one has its corners and its
// centre, up to the rounding of these. One that begins at the large mirror's plane and lies behind it is not seen.
TEST(HugeMirrors, ShowMirrorsBeforeThemOnly) {
  Random random(7);
  for (int i = 0; i < 400; ++i) {
    const double size = std::pow(10.0, random.uniform(6.0, 15.0));
    const bool turned = random.chance(0.5);
    const glm::dvec3 rotation = turned ? 180.0 * random.inBox(1.0) : glm::dvec3(0.0);
    const glm::dmat3 axes = rotationFromDegrees(rotation);
    const double distance = turned ? 1.0 + 2e-14 * size : random.uniform(0.01, 10.0);
    const glm::dvec2 center = 0.4 * size * glm::dvec2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    Mirror huge{.position = axes * glm::dvec3(center, -distance), .rotation = rotation, .size = glm::dvec2(size)};
    if (random.chance(0.5)) {
      const MirrorState state = evaluate(testing_support::sceneWith({huge}), 0.0).mirrors[0];
      huge = {.polygon = state.polygon};
    }
    Mirror beside;
    beside.polygon = {axes * glm::dvec3(0.8, -0.3, -0.1) * distance, axes * glm::dvec3(0.5, -0.3, 0.3) * distance,
                      axes * glm::dvec3(0.5, 0.3, 0.3) * distance, axes * glm::dvec3(0.8, 0.3, -0.1) * distance};
    Mirror behind;
    behind.polygon = {axes * glm::dvec3(0.5, -0.3, -1.0) * distance, axes * glm::dvec3(0.5, 0.3, -1.0) * distance,
                      axes * glm::dvec3(0.8, 0.3, -2.0) * distance, axes * glm::dvec3(0.8, -0.3, -2.0) * distance};
    beside.twoSided = behind.twoSided = true;
    Scene scene = testing_support::sceneWith({huge, beside, behind});
    scene.camera.target = axes * glm::dvec3(0.0, 0.0, -1.0);
    scene.camera.up = axes * glm::dvec3(0.0, 1.0, 0.0);
    const FramePlan plan = planOf(scene);
    const auto seen = [&](int mirror) {
      return std::ranges::any_of(plan.drawnMirrors(), [&](const Pass& pass) {
        return pass.view.path == MirrorPath{0, mirror};
      });
    };
    EXPECT_TRUE(seen(1)) << size << (turned ? " turned" : "") << " from " << distance;
    const SkippedMirror* skip = skipOf(plan, {0, 2});
    EXPECT_TRUE(skip && skip->reason != SkipReason::minPixels) << size << (turned ? " turned" : "");
  }
}

// An edge of the second mirror lies in the plane of the first but for the rounding of its rotation.
TEST(SkippedMirrorList, RoundingLiftsNoEdgeOffAPlane) {
  Mirror wall;
  wall.polygon = {{0, -1, -2}, {0, -1, 2}, {0, 1, 2}, {0, 1, -2}};
  wall.twoSided = true;
  for (int degrees = 91; degrees < 180; ++degrees) {
    Mirror behind{.rotation = {0, degrees, 0}, .size = {2, 1.5}};
    behind.position = {std::cos(glm::radians(static_cast<double>(degrees))), 0, 0.1};
    behind.twoSided = true;
    Scene scene = testing_support::sceneWith({wall, behind});
    scene.camera.position = {3, 0, 1};
    scene.camera.target = {0, 0, 0};
    const FramePlan plan = planOf(scene);
    const SkippedMirror* skip = skipOf(plan, {0, 1});
    EXPECT_TRUE(skip && skip->reason == SkipReason::outside) << degrees;
  }
}

TEST(SkippedMirrorList, IsOrderedByPathUpToTheLimit) {
  const Scene scene = corridor();
  const SceneState state = evaluate(scene, 0.0);
  const FramePlan plan = planFrame({scene, state, {}, {width, height}});
  const RecycledVector<SkippedMirror> all = skippedMirrors(scene, state, plan, SIZE_MAX);
  ASSERT_EQ(all.size(), skippedCount(plan));
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all.front().path, MirrorPath{1}) << "behind the eye";
  EXPECT_TRUE(std::ranges::is_sorted(all, {}, [](const SkippedMirror& skip) { return depthOf(skip.path); }));
  for (size_t most = 0; most <= all.size() + 1; ++most) {
    const RecycledVector<SkippedMirror> first = skippedMirrors(scene, state, plan, most);
    ASSERT_EQ(first.size(), std::min(most, all.size()));
    const std::span expected = std::span(all).first(first.size());
    EXPECT_TRUE(std::ranges::equal(first, expected, {}, &SkippedMirror::path, &SkippedMirror::path));
  }
}

// What makes it safe to leave out mirrors by the boxes around them.
TEST(BoxVisible, HoldsWhereItsPointsMayBeSeen) {
  Random random(5);
  int missed = 0;
  for (int round = 0; round < 20'000; ++round) {
    const double far = round % 2 == 0 ? 0.0 : std::pow(10.0, random.uniform(0, 9));
    const glm::dvec3 origin = far * random.direction();
    View view{.eye = origin + random.inBox(1.0)};
    for (int i = 0; i < 4; ++i) {
      view.cone.push_back(glm::normalize(random.inBox(1.0) - glm::dvec3(0, 0, 1)));
    }
    if (round % 3 == 0) {
      view.clip = Plane{origin + random.inBox(1.0), random.direction()};
    }
    const double size = std::pow(10.0, random.uniform(-12, 1));
    const glm::dvec3 center = view.eye + random.inBox(3.0);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 4; ++i) {
      points.push_back(center + random.inBox(size));
    }
    if (round % 5 == 0) {  // in the plane of a side, where rounding decides
      for (glm::dvec3& p : points) {
        p -= glm::dot(view.cone[0], p - view.eye) * view.cone[0];
      }
    }
    const bool box = boxVisible(view, Bounds::around(points));
    EXPECT_TRUE(box || !hullVisible(view, points));
    missed += !box;
  }
  EXPECT_GT(missed, 5000);
}

}  // namespace
}  // namespace speculum
