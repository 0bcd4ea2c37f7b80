// Shadow maps: which lights have one, which faces are rendered and when, what their windows show. Without a GPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "frame/cube_face.hpp"
#include "frame/memory_fit.hpp"
#include "frame/shadow_map.hpp"
#include "frame_support.hpp"
#include "random.hpp"

namespace speculum {
namespace {

using testing_support::objectAt;

PointLight lightAt(const glm::dvec3& position) {
  return {.position = position, .glow = 0.0, .castsShadow = true};
}

// A floor before the camera with a box on it, and a lamp above.
Scene lampRoom() {
  Scene scene = testing_support::sceneWith({});
  scene.meshes = {testing_support::cube(0.5, 0.9)};
  scene.objects = {objectAt({0, -1, -5}, {8, 0.1, 8}), objectAt({0, -0.5, -5})};
  scene.lights = {lightAt({1, 2, -5})};
  return scene;
}

class ShadowFrames : public testing_support::PlanSequence {
 public:
  explicit ShadowFrames(Scene s) : PlanSequence(std::move(s)) { settings.effects.shadowLookup = ShadowLookup::map; }
  // Faces that the next frame renders.
  std::vector<int> rendered() {
    next();
    std::vector<int> faces;
    for (const ShadowMap& map : plan.shadowMaps) {
      for (int i = 0; i < 6; ++i) {
        if (map.faces[static_cast<size_t>(i)].rendered) {
          faces.push_back(i);
        }
      }
    }
    return faces;
  }
};

TEST(ShadowMap, ExistsWhereShadowsAreLookedUp) {
  ShadowFrames frames(lampRoom());
  ASSERT_EQ(frames.next().shadowMaps.size(), 1u);
  EXPECT_EQ(frames.plan.shadowMaps[0].name, "light 0");
  EXPECT_FALSE(frames.plan.effects.any()) << "no rays";
  frames.settings.effects.shadowLookup = ShadowLookup::traced;
  EXPECT_TRUE(frames.next().shadowMaps.empty());
  EXPECT_TRUE(frames.plan.effects.traces());
  frames.settings.effects.shadowLookup = ShadowLookup::map;
  frames.settings.effects.shadows = false;
  EXPECT_TRUE(frames.next().shadowMaps.empty());
  frames.settings.effects.shadows = true;
  frames.scene.camera.target = {0, 0, 1};
  EXPECT_TRUE(frames.next().shadowMaps.empty()) << "nothing in view";
}

TEST(ShadowMap, BouncedLightAndManyLightsTrace) {
  ShadowFrames frames(lampRoom());
  frames.scene.mirrors = {testing_support::wall({0, 0, -8}, 0, {6, 6})};
  frames.scene.mirrors[0].castsLight = true;
  EXPECT_TRUE(frames.next().shadowMaps.empty());
  EXPECT_TRUE(frames.plan.effects.shadowRays);
  frames.scene.mirrors.clear();
  frames.scene.lights.assign(mostShadowMaps, lightAt({1, 2, -5}));
  EXPECT_EQ(frames.next().shadowMaps.size(), mostShadowMaps);
  frames.scene.lights.push_back(lightAt({1, 2, -5}));
  EXPECT_TRUE(frames.next().shadowMaps.empty());
  EXPECT_TRUE(frames.plan.effects.shadowRays);
}

TEST(ShadowMap, OnlyChangedFacesAreRendered) {
  ShadowFrames frames(lampRoom());
  const std::vector<int> all = frames.rendered();
  EXPECT_TRUE(std::binary_search(all.begin(), all.end(), 3)) << "down to the floor";
  EXPECT_FALSE(std::binary_search(all.begin(), all.end(), 2)) << "nothing above";
  EXPECT_TRUE(frames.rendered().empty());
  frames.scene.camera.position.x += 0.01;
  frames.scene.camera.target.x += 0.01;
  EXPECT_TRUE(frames.rendered().empty()) << "a map does not depend on who looks";
  frames.scene.objects[1].color = glm::dvec3(0.5);
  EXPECT_TRUE(frames.rendered().empty()) << "nor on colors";
  frames.scene.objects[1].rotation.y += 1.0;
  EXPECT_EQ(frames.rendered(), std::vector<int>{3}) << "the box stands below the light";
  frames.scene.lights[0].position.y += 0.1;
  const std::vector<int> moved = frames.rendered();
  EXPECT_GE(moved.size(), 4u) << "all that are read";
  frames.settings.effects.shadowMapSize = 256;
  const std::vector<int> resized = frames.rendered();
  EXPECT_GE(resized.size(), moved.size());
  EXPECT_TRUE(frames.rendered().empty());
  frames.settings.reflection.skipUnchanged = false;
  EXPECT_EQ(frames.rendered(), resized);
  EXPECT_EQ(frames.rendered(), resized);
}

TEST(ShadowMap, FarLightHasOneFace) {
  ShadowFrames frames(lampRoom());
  EXPECT_EQ(onlyShadowFace(frames.next().shadowMaps), std::nullopt) << "the lamp is in the room";
  frames.scene.lights = {lightAt({-60, 20, -5})};
  EXPECT_EQ(onlyShadowFace(frames.next().shadowMaps), 0u);
  frames.scene.lights.push_back(lightAt({-60, 25, 0}));
  EXPECT_EQ(onlyShadowFace(frames.next().shadowMaps), 0u);
  frames.scene.lights[1] = lightAt({60, 25, 0});
  EXPECT_EQ(onlyShadowFace(frames.next().shadowMaps), std::nullopt) << "two lights, two faces";
  EXPECT_EQ(onlyShadowFace({}), std::nullopt);
}

// The face below the lamp of a room in which a box may spin beside the one that stands still.
class Layers : public ShadowFrames {
 public:
  explicit Layers(double speed = 90.0) : ShadowFrames(lampRoom()) {
    scene.objects.push_back(objectAt({1.5, -0.5, -5}));
    scene.objects.back().spin.y = speed;
  }
  const ShadowFace& down(double time) { return next(time).shadowMaps.at(0).faces.at(3); }
};

TEST(ShadowLayer, HoldsWhatStandsStill) {
  Layers frames;
  EXPECT_FALSE(frames.down(0.0).layer) << "nothing has moved yet";
  const ShadowFace first = frames.down(0.1);
  ASSERT_TRUE(first.layer);
  EXPECT_TRUE(first.layer->rendered);
  EXPECT_EQ(first.layer->pass.instances, (RecycledVector<int>{0, 1}));
  EXPECT_EQ(first.pass.instances, RecycledVector<int>{2});
  const ShadowFace next = frames.down(0.2);
  EXPECT_TRUE(next.rendered);
  EXPECT_FALSE(next.layer.value().rendered);
  EXPECT_EQ(next.pass.instances, RecycledVector<int>{2});
  EXPECT_FALSE(frames.down(0.2).rendered) << "the animation pauses";
  EXPECT_FALSE(frames.down(0.3).layer.value().rendered);
  frames.scene.objects[1].position.x -= 0.1;
  EXPECT_TRUE(frames.down(0.4).layer.value().rendered);
  frames.settings.reflection.skipUnchanged = false;
  EXPECT_FALSE(frames.down(0.5).layer);
  frames.settings.reflection.skipUnchanged = true;
  EXPECT_TRUE(frames.down(0.6).layer.value().rendered);
}

TEST(ShadowLayer, NeedsStillAndMovingCasters) {
  const auto hasLayer = [](Layers& frames) {
    frames.down(0.0);
    return frames.down(0.1).layer.has_value();
  };
  Layers still(0.0);
  EXPECT_FALSE(hasLayer(still));
  Layers turning;
  for (Object& object : turning.scene.objects) {
    object.spin.y = 90.0;
  }
  EXPECT_FALSE(hasLayer(turning));
  Layers mirror(0.0);
  mirror.scene.mirrors = {testing_support::wall({-1, 0, -5}, 0, {1, 1})};
  mirror.scene.mirrors[0].spin.y = 10.0;
  EXPECT_TRUE(hasLayer(mirror));
  EXPECT_TRUE(mirror.plan.shadowMaps[0].faces[3].pass.instances.empty());
}

TEST(ShadowLayer, NeedsALightThatStandsStill) {
  Layers frames;
  frames.scene.lights[0].orbit = Orbit{.center = {0, 2, -5}, .speed = 10.0};
  frames.down(0.0);
  const ShadowFace& face = frames.down(0.1);
  EXPECT_TRUE(face.rendered);
  EXPECT_FALSE(face.layer);
}

// In random scenes, every drawn point looks up a face that is rendered, within the face's window.
TEST(ShadowMap, VisiblePointsLieInReadFaces) {
  testing_support::Random random(7);
  int looked = 0;
  int unread = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Scene scene = lampRoom();
    scene.objects.clear();
    for (int i = 0; i < 8; ++i) {
      scene.objects.push_back(
          objectAt(random.inBox(6), {random.uniform(0.1, 3), random.uniform(0.1, 3), random.uniform(0.1, 3)}));
      scene.objects.back().rotation = 60.0 * random.inBox(1);
    }
    scene.lights = {lightAt(random.inBox(4)), lightAt(random.inBox(40))};
    scene.mirrors = {testing_support::wall(random.inBox(5), random.uniform(-180, 180), {3, 3})};
    scene.camera.position = random.inBox(8);
    scene.camera.target = random.inBox(3);
    ShadowFrames frames(scene);
    frames.settings.debug.skipHidden = false;
    frames.next();
    const SceneState state = evaluate(scene, 0.0);
    std::vector<const PlannedPass*> passes{&frames.plan.main};
    for (const PlannedPass& pass : frames.plan.passes) {
      passes.push_back(&pass);
    }
    for (const ShadowMap& map : frames.plan.shadowMaps) {
      unread += static_cast<int>(std::ranges::count(map.faces, false, &ShadowFace::read));
    }
    for (int sample = 0; sample < 400; ++sample) {
      const PlannedPass& pass = *passes[random.index(passes.size())];
      if (pass.instances.empty()) {
        continue;
      }
      const int instance = pass.instances[random.index(pass.instances.size())];
      const glm::dvec3 p = state.instances[static_cast<size_t>(instance)].worldFromMesh.point(random.inBox(0.5));
      if (!sphereVisible(pass.view, p, 0.0)) {
        continue;
      }
      for (const ShadowMap& map : frames.plan.shadowMaps) {
        const glm::dvec3 d = p - state.lights[static_cast<size_t>(map.light)].position;
        size_t in = 0;
        for (size_t f = 1; f < 6; ++f) {
          in = glm::dot(d, faceAxes()[f].forward) > glm::dot(d, faceAxes()[in].forward) ? f : in;
        }
        EXPECT_EQ(onlyShadowFace({&map, 1}).value_or(in), in);
        const ShadowFace& face = map.faces[in];
        ASSERT_TRUE(face.read) << "trial " << trial;
        const glm::dvec4 clip = face.projection.clip(face.pass.view.worldToView * d);
        const double inner = 1.0 - 2.0 * shadowBorder / map.size + 1e-9;
        EXPECT_LE(std::abs(clip.x / clip.w), inner);
        EXPECT_LE(std::abs(clip.y / clip.w), inner);
        ++looked;
      }
    }
  }
  EXPECT_GT(looked, 1000);
  EXPECT_GT(unread, 500);
}

TEST(ShadowMap, MemoryIncludesItAndLowersIt) {
  ShadowFrames frames(lampRoom());
  frames.next();
  FramePlan without = frames.plan;
  without.shadowMaps.clear();
  const uint64_t bytes = 6ull * 1024 * 1024 * (8 + 4);
  EXPECT_EQ(shadowBytes(frames.plan), bytes);
  Layers layers;
  layers.down(0.0);
  layers.down(0.1);
  EXPECT_EQ(shadowBytes(layers.plan), bytes + 6ull * 1024 * 1024 * 8);
  EXPECT_EQ(targetBytes(frames.plan, frames.settings), targetBytes(without, frames.settings) + bytes);
  const SceneState state = evaluate(frames.scene, 0.0);
  const FittedPlan fitted = planWithin({.budgetBytes = 10'000'000, .largestSide = 4096}, frames.scene, state,
                                       frames.settings, testing_support::width, testing_support::height);
  EXPECT_LT(fitted.settings.effects.shadowMapSize, 1024);
  EXPECT_NE(fitted.message.find("effects.shadow_map_size to 512"), std::string::npos) << fitted.message;
  const FittedPlan narrow = planWithin({.budgetBytes = 1ull << 40, .largestSide = 2048}, frames.scene, state,
                                       frames.settings, testing_support::width, testing_support::height);
  EXPECT_EQ(narrow.settings.effects.shadowMapSize, 512);
}

}  // namespace
}  // namespace speculum
