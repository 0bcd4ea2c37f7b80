// reflection.update_interval: when mirror images are rendered anew, by the planner alone.
#include "frame/frame_plan.hpp"
#include "frame/image_reuse.hpp"
#include "frame/memory_fit.hpp"
#include "frame_support.hpp"
#include "geometry/affine.hpp"
#include "image/color.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using namespace testing_support;

// Six mirrors in a row before the camera, which stands at the origin and looks along -z.
Scene row() {
  Scene scene = sceneWith({});
  for (int i = 0; i < 6; ++i) {
    scene.mirrors.push_back(wall({i - 2.5, 0, -5}, 0, {0.8, 1.5}));
  }
  return scene;
}

// Plans frame after frame with an interval, whether or not anything changes.
PlanSequence withInterval(Scene scene, int interval) {
  return PlanSequence(std::move(scene), interval, false);
}

std::string firstUnchanged(const FramePlan& plan) {
  const auto it = std::ranges::find(plan.skipped, SkipReason::unchanged, &SkippedMirror::reason);
  return it == plan.skipped.end() ? "" : it->detail;
}

TEST(CachedImages, MirrorsTakeTurnsAfterTheFirstFrame) {
  for (const double step : {0.0, 0.002}) {
    PlanSequence sequence = withInterval(row(), 3);
    std::map<int, std::vector<int>> frames;  // by mirror: frames in which it had a pass
    for (int frame = 0; frame < 15; ++frame) {
      sequence.next();
      ASSERT_EQ(sequence.plan.cached.size(), 6u);
      EXPECT_EQ(sequence.plan.passes.size() + count(sequence.plan, SkipReason::unchanged), 6u);
      if (frame == 0) {
        EXPECT_EQ(sequence.plan.passes.size(), 6u);
      } else if (frame > 1) {
        EXPECT_EQ(sequence.plan.passes.size(), 2u) << "frame " << frame << ", step " << step;
      }
      for (const PlannedPass& pass : sequence.plan.passes) {
        frames[pass.view.path[0]].push_back(frame);
      }
      sequence.moveCamera({step, 0, 0});
    }
    for (const auto& [mirror, fresh] : frames) {
      for (size_t i = 1; i < fresh.size(); ++i) {
        if (fresh[i - 1] >= 3) {
          EXPECT_EQ(fresh[i] - fresh[i - 1], 3) << "mirror " << mirror << ", step " << step;
        }
      }
    }
  }
}

TEST(CachedImages, ReusedImagesAreListedWithTheirAge) {
  PlanSequence sequence = withInterval(row(), 4);
  sequence.next();
  sequence.next();
  ASSERT_EQ(count(sequence.plan, SkipReason::unchanged), 5) << "the fourth mirror comes due after one frame";
  EXPECT_EQ(firstUnchanged(sequence.plan), "image of the last frame");
  for (const MirrorDraw& draw : sequence.plan.main.mirrors) {
    EXPECT_NE(draw.cached.has_value(), draw.pass >= 0);
    EXPECT_FALSE(draw.cached && draw.cached->moved) << "nothing moved";
  }
  sequence.moveCamera({0.001, 0, 0});
  sequence.next();  // the first images had no margin
  EXPECT_EQ(sequence.plan.passes.size(), 6u);
  sequence.moveCamera({0.001, 0, 0});
  sequence.next();
  ASSERT_GT(count(sequence.plan, SkipReason::unchanged), 0);
  EXPECT_EQ(firstUnchanged(sequence.plan), "image of the last frame, reprojected");
  for (const MirrorDraw& draw : sequence.plan.main.mirrors) {
    if (draw.cached) {
      EXPECT_TRUE(draw.cached->moved);
      EXPECT_EQ(sequence.plan.cached[static_cast<size_t>(draw.cached->image)].mirror, draw.mirror);
    }
  }
}

TEST(CachedImages, NestedMirrorsAreRenderedWithTheirParent) {
  PlanSequence sequence = withInterval(corridor(), 3);
  const size_t whole = sequence.next().passes.size();
  EXPECT_EQ(whole, 4u);
  EXPECT_EQ(sequence.plan.cached.size(), 1u) << "mirrors in mirrors have none";
  const int deeper = count(sequence.plan, SkipReason::maxDepth);
  EXPECT_GT(deeper, 0);
  for (int frame = 1; frame < 7; ++frame) {
    sequence.next();
    EXPECT_EQ(sequence.plan.passes.size(), frame % 3 == 0 ? whole : 0u) << "frame " << frame;
    EXPECT_EQ(count(sequence.plan, SkipReason::unchanged), frame % 3 == 0 ? 0 : 1);
    EXPECT_EQ(count(sequence.plan, SkipReason::maxDepth), frame % 3 == 0 ? deeper : 0)
        << "nothing seen in a reused image is listed";
  }
}

// frame_settings.cpp tests which settings images show.
TEST(CachedImages, ChangedSettingsAndSizesRenderAnew) {
  const auto freshAfter = [](auto change) {
    PlanSequence sequence = withInterval(row(), 100);
    sequence.next();
    change(sequence.settings);
    return sequence.next().passes.size();
  };
  EXPECT_EQ(freshAfter([](Settings&) {}), 0u);
  EXPECT_EQ(freshAfter([](Settings& s) { s.view.exposure = 2.0; }), 0u);
  EXPECT_EQ(freshAfter([](Settings& s) { s.reflection.scale = 0.5; }), 6u);
  EXPECT_EQ(freshAfter([](Settings& s) { s.reflection.updateInterval = 1; }), 6u);

  PlanSequence sequence = withInterval(row(), 100);
  sequence.next();
  const FramePlan larger = planFrame(sequence.scene, evaluate(sequence.scene, 0.0), sequence.settings, width + 1,
                                     height, {.images = sequence.plan.cached});
  EXPECT_EQ(larger.passes.size(), 6u);
}

TEST(CachedImages, CutsRenderAnewAndForgetUnseenMirrors) {
  PlanSequence sequence = withInterval(row(), 100);
  sequence.next();
  sequence.next();
  sequence.moveCamera({0.5, 0, 0});
  sequence.next();
  EXPECT_EQ(count(sequence.plan, SkipReason::unchanged), 0);
  sequence.moveCamera({50, 0, 0});
  EXPECT_TRUE(sequence.next().cached.empty());
  sequence.moveCamera({-50, 0, 0});
  sequence.next();
  EXPECT_EQ(sequence.plan.passes.size(), 6u);
  EXPECT_EQ(sequence.plan.cached.size(), 6u);
}

// A reused image covers every ray through the mirror's visible region, at every distance.
TEST(CachedImages, ReusedImagesCoverTheVisibleRegion) {
  int reprojected = 0;
  for (int seed = 0; seed < 40; ++seed) {
    PlanSequence sequence = withInterval(row(), 5);
    for (int frame = 0; frame < 12; ++frame) {
      const double t = 0.01 * frame * (1 + seed % 7);
      sequence.scene.camera.position = {std::sin(seed + t), 0.3 * std::sin(2.0 * seed + t), -t};
      sequence.scene.camera.target = sequence.scene.camera.position + glm::dvec3(0.3 * std::sin(t), 0, -1);
      const FramePlan& plan = sequence.next();
      for (const MirrorDraw& draw : plan.main.mirrors) {
        ASSERT_TRUE(draw.cached || draw.pass >= 0 || count(plan, SkipReason::minPixels) > 0);
        if (!draw.cached || !draw.cached->moved) {
          continue;
        }
        ++reprojected;
        const CachedImage& image = plan.cached[static_cast<size_t>(draw.cached->image)];
        for (const glm::dvec3& corner : visiblePart(plan.main.view, draw.polygon)) {
          const glm::dvec4 clip = plan.projection.clip(plan.main.view.worldToView * (corner - plan.main.view.eye));
          const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * plan.main.view.pictureSize;
          for (const double part : {0.0, 0.01, 0.1, 0.5, 1.0}) {
            const glm::dvec3 texel = draw.cached->texelFromPixel * glm::dvec3(pixel, 1.0) +
                                     draw.cached->texelFromDisparity * (part / clip.w);
            ASSERT_GT(texel.z, 0.0);
            const glm::dvec2 place = glm::dvec2(texel) / texel.z;
            EXPECT_GE(std::min(place.x, place.y), 0.4999);
            EXPECT_LE(place.x, image.view.rect.width - 0.4999);
            EXPECT_LE(place.y, image.view.rect.height - 0.4999);
          }
        }
      }
    }
  }
  EXPECT_GT(reprojected, 200) << "too few to judge by";
}

// The lookup finds a point's texel when the camera, the mirror or both have moved.
TEST(CachedImages, LookupFindsThePointInTheImage) {
  const Projection projection(1.0, 1.5, 0.001);
  const auto mirrorView = [&](const glm::dvec3& eye, const glm::dvec3& target, double yaw, View& parent) {
    parent = mainView(lookAt(eye, target, {0, 1, 0}, 57.3, 0.001), projection, 600, 400);
    const Plane plane{{1e6, 0, -3}, rotationFromDegrees({3, yaw, 0})[2]};
    return reflectedView(parent, 0, plane, {}, {-20, 30, 500, 300}, {300, 200});
  };
  View parentThen;
  View parentNow;
  const View then = mirrorView({1e6, 1, 2}, {1e6, 0, -3}, 5.0, parentThen);
  const View now = mirrorView({1e6 + 0.1, 1.05, 2.1}, {1e6 + 0.2, 0, -3}, 6.0, parentNow);
  const CachedLookup lookup = cachedLookup({.view = then, .projection = projection}, parentNow, now, projection);
  for (const glm::dvec3& point : {glm::dvec3(1e6, 0.5, 4), glm::dvec3(1e6 + 2, 1, 0), glm::dvec3(1e6 - 50, 9, 200)}) {
    const glm::dvec4 clipNow = projection.clip(now.worldToView * (point - now.eye));
    const glm::dvec4 clipThen = projection.clip(then.worldToView * (point - then.eye));
    const glm::dvec2 pixel = (glm::dvec2(clipNow) / clipNow.w * 0.5 + 0.5) * parentNow.pictureSize;
    const glm::dvec2 expected =
        (glm::dvec2(clipThen) / clipThen.w * 0.5 + 0.5) * then.pictureSize - glm::dvec2(then.rect.x, then.rect.y);
    const glm::dvec3 texel =
        lookup.texelFromPixel * glm::dvec3(pixel, 1.0) + lookup.texelFromDisparity * (1.0 / clipNow.w);
    EXPECT_NEAR(texel.x / texel.z, expected.x, 1e-6);
    EXPECT_NEAR(texel.y / texel.z, expected.y, 1e-6);
    EXPECT_NEAR(texel.z, clipThen.w / clipNow.w, 1e-9);
  }
}

TEST(CachedImages, MarginFollowsTheMotion) {
  PlanSequence sequence = withInterval(corridor(), 6);
  const PixelRect plain = sequence.next().passes.back().view.rect;
  sequence.moveCamera({0.01, 0, 0});
  const PixelRect slow = sequence.next().passes.back().view.rect;
  EXPECT_GT(slow.width, plain.width + 2);
  EXPECT_LT(slow.width, plain.width + 60);
  EXPECT_LE(slow.height, plain.height + 2 * largestMargin * height + 2);
  for (int frame = 0; frame < 12; ++frame) {
    sequence.next();
  }
  EXPECT_EQ(sequence.plan.cached[0].view.rect.height, plain.height) << "two turns after the motion there is none";
}

TEST(CachedImages, MemoryIncludesReusedImages) {
  PlanSequence sequence = withInterval(corridor(), 3);
  sequence.next();
  const uint64_t image = static_cast<uint64_t>(sequence.plan.cached[0].view.rect.area()) * 4 * 8;
  const FramePlan reused = sequence.next();
  ASSERT_TRUE(reused.passes.empty());
  FramePlan without = reused;
  without.cached.clear();
  EXPECT_EQ(targetBytes(reused, sequence.settings), targetBytes(without, sequence.settings) + image);
}

TEST(CachedImages, MarginsStayWithinTheLargestSide) {
  Scene scene = corridor();
  Settings settings;
  settings.reflection.updateInterval = 4;
  std::vector<CachedImage> cached;
  for (int frame = 0; frame < 8; ++frame) {
    const FittedPlan fitted = planWithin({.budgetBytes = 1ull << 40, .largestSide = width}, scene, evaluate(scene, 0.0),
                                         settings, width, height, {.images = cached});
    for (const PlannedPass& pass : fitted.plan.passes) {
      EXPECT_LE((overscan(pass.view) * pass.view.pictureSize).x, width);
      EXPECT_LE(pass.view.rect.width, width);
    }
    cached = fitted.plan.cached;
    scene.camera.position.z -= 0.3;
  }
}

}  // namespace
}  // namespace speculum
