// Shadow maps: which lights have one, which faces are rendered and when, what their windows show. Without a GPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plan/cube_face.hpp"
#include "plan/fitted_plan.hpp"
#include "plan/shadow_map.hpp"
#include "plan/support.hpp"
#include "plan/target_memory.hpp"
#include "random.hpp"
#include "scene/scene_loader.hpp"
#include "test_paths.hpp"

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
    for (const Cube& map : testing_support::shadowMapsOf(plan)) {
      for (size_t i = 0; i < 6; ++i) {
        if (testing_support::faceOf(plan, map, i).drawn()) {
          faces.push_back(static_cast<int>(i));
        }
      }
    }
    return faces;
  }
};

TEST(ShadowMap, ExistsWhereShadowsAreLookedUp) {
  ShadowFrames frames(lampRoom());
  ASSERT_EQ(testing_support::shadowMapsOf(frames.next()).size(), 1u);
  EXPECT_EQ(testing_support::shadowMapsOf(frames.plan)[0].name, "light 0");
  EXPECT_FALSE(frames.plan.effects.any()) << "no rays";
  frames.settings.effects.shadowLookup = ShadowLookup::traced;
  EXPECT_TRUE(testing_support::shadowMapsOf(frames.next()).empty());
  EXPECT_TRUE(frames.plan.effects.traces());
  frames.settings.effects.shadowLookup = ShadowLookup::map;
  frames.settings.effects.shadows = false;
  EXPECT_TRUE(testing_support::shadowMapsOf(frames.next()).empty());
  frames.settings.effects.shadows = true;
  frames.scene.camera.target = {0, 0, 1};
  EXPECT_TRUE(testing_support::shadowMapsOf(frames.next()).empty()) << "nothing in view";
}

TEST(ShadowMap, BouncedLightAndManyLightsTrace) {
  ShadowFrames frames(lampRoom());
  frames.scene.mirrors = {testing_support::wall({0, 0, -8}, 0, {6, 6})};
  frames.scene.mirrors[0].castsLight = true;
  EXPECT_TRUE(testing_support::shadowMapsOf(frames.next()).empty());
  EXPECT_TRUE(frames.plan.effects.shadowRays);
  frames.scene.mirrors.clear();
  frames.scene.lights.assign(mostShadowMaps, lightAt({1, 2, -5}));
  EXPECT_EQ(testing_support::shadowMapsOf(frames.next()).size(), mostShadowMaps);
  frames.scene.lights.push_back(lightAt({1, 2, -5}));
  EXPECT_TRUE(testing_support::shadowMapsOf(frames.next()).empty());
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
  EXPECT_EQ(onlyShadowFace(frames.next()), std::nullopt) << "the lamp is in the room";
  frames.scene.lights = {lightAt({-60, 20, -5})};
  EXPECT_EQ(onlyShadowFace(frames.next()), 0u);
  frames.scene.lights.push_back(lightAt({-60, 25, 0}));
  EXPECT_EQ(onlyShadowFace(frames.next()), 0u);
  frames.scene.lights[1] = lightAt({60, 25, 0});
  EXPECT_EQ(onlyShadowFace(frames.next()), std::nullopt) << "two lights, two faces";
  EXPECT_EQ(onlyShadowFace(FramePlan()), std::nullopt);
}

// The face below the lamp of a room in which a box may spin beside the one that stands still.
class Layers : public ShadowFrames {
 public:
  explicit Layers(double speed = 90.0) : ShadowFrames(lampRoom()) {
    scene.objects.push_back(objectAt({1.5, -0.5, -5}));
    scene.objects.back().spin.y = speed;
  }
  const Pass& down(double time) {
    next(time);
    return testing_support::faceOf(plan, plan.cubes.at(0), 3);
  }
  // Layer of the face in the last frame; null without one.
  const Pass* layer() const {
    const int index = testing_support::faceOf(plan, plan.cubes.at(0), 3).layer;
    return index < 0 ? nullptr : &plan.passes[static_cast<size_t>(index)];
  }
  // Plans a frame that has a layer and says whether it draws that.
  bool drawsLayer(double time) {
    down(time);
    EXPECT_TRUE(layer());
    return layer() && layer()->drawn();
  }
};

TEST(ShadowLayer, HoldsWhatStandsStill) {
  Layers frames;
  frames.down(0.0);
  EXPECT_FALSE(frames.layer()) << "nothing has moved yet";
  EXPECT_EQ(frames.down(0.1).instances, RecycledVector<int>{2});
  ASSERT_TRUE(frames.layer());
  EXPECT_TRUE(frames.layer()->drawn());
  EXPECT_LT(frames.layer(), &frames.plan.passes[static_cast<size_t>(frames.plan.cubes[0].faces[3])])
      << "it comes first";
  EXPECT_EQ(frames.layer()->instances, (RecycledVector<int>{0, 1}));
  const Pass& next = frames.down(0.2);
  EXPECT_TRUE(next.drawn());
  EXPECT_FALSE(frames.layer()->drawn());
  EXPECT_EQ(next.instances, RecycledVector<int>{2});
  EXPECT_FALSE(frames.down(0.2).drawn()) << "the animation pauses";
  EXPECT_FALSE(frames.drawsLayer(0.3));
  frames.scene.objects[1].position.x -= 0.1;
  EXPECT_TRUE(frames.drawsLayer(0.4));
  frames.settings.reflection.skipUnchanged = false;
  frames.down(0.5);
  EXPECT_FALSE(frames.layer());
  frames.settings.reflection.skipUnchanged = true;
  EXPECT_TRUE(frames.drawsLayer(0.6));
}

TEST(ShadowLayer, NeedsStillAndMovingCasters) {
  const auto hasLayer = [](Layers& frames) {
    frames.down(0.0);
    frames.down(0.1);
    return frames.layer() != nullptr;
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
  EXPECT_TRUE(testing_support::faceOf(mirror.plan, mirror.plan.cubes[0], 3).instances.empty());
}

TEST(ShadowLayer, NeedsALightThatStandsStill) {
  Layers frames;
  frames.scene.lights[0].orbit = Orbit{.center = {0, 2, -5}, .speed = 10.0};
  frames.down(0.0);
  EXPECT_TRUE(frames.down(0.1).drawn());
  EXPECT_FALSE(frames.layer());
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
    std::vector<const Pass*> passes{&frames.plan.main()};
    for (const Pass& pass : frames.plan.drawnMirrors()) {
      passes.push_back(&pass);
    }
    unread += static_cast<int>(std::ranges::count(frames.plan.passes, PassSource::unread, &Pass::source));
    for (int sample = 0; sample < 400; ++sample) {
      const Pass& pass = *passes[random.index(passes.size())];
      if (pass.instances.empty()) {
        continue;
      }
      const int instance = pass.instances[random.index(pass.instances.size())];
      const glm::dvec3 p = state.instances[static_cast<size_t>(instance)].worldFromMesh.point(random.inBox(0.5));
      if (!sphereVisible(pass.view, p, 0.0)) {
        continue;
      }
      for (const Cube& map : testing_support::shadowMapsOf(frames.plan)) {
        const glm::dvec3 d = p - state.lights[static_cast<size_t>(map.light)].position;
        size_t in = 0;
        for (size_t f = 1; f < 6; ++f) {
          in = glm::dot(d, faceAxes()[f].forward) > glm::dot(d, faceAxes()[in].forward) ? f : in;
        }
        EXPECT_EQ(onlyShadowFace(frames.plan).value_or(in), in);
        const Pass& face = testing_support::faceOf(frames.plan, map, in);
        ASSERT_NE(face.source, PassSource::unread) << "trial " << trial;
        const glm::dvec4 clip = face.projection.clip(face.view.worldToView * d);
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

// Says how many texels of the lamp's lower face a pixel spans at a point of the floor.
double texelsOfAPixel(const FramePlan& plan, const glm::dvec3& p) {
  const Cube& map = testing_support::shadowMapsOf(plan)[0];
  const Pass& face = testing_support::faceOf(plan, map, 3);
  const View& main = plan.main().view;
  const double pixel = glm::length(p - main.eye) / (0.5 * plan.projection.focal * main.pictureSize.y);
  return pixel * (face.view.rect.width - 2 * shadowBorder) /
         ((face.window.high.x - face.window.low.x) * (map.center.y - p.y));
}

TEST(ShadowMap, AutomaticSizeFollowsThePixels) {
  ShadowFrames frames(lampRoom());
  frames.settings.effects.shadowMapSize = 0;
  std::vector<int> sizes;
  for (const double back : {0.0, 6.0, 30.0}) {
    frames.scene.camera.position = {0, 0.5, back};
    frames.scene.camera.target = {0, -0.9, -5};
    frames.next();
    const double texels = texelsOfAPixel(frames.plan, {0, -0.9, -5});
    EXPECT_GT(texels, 0.3) << back;
    EXPECT_LT(texels, 3.0) << back;
    sizes.push_back(testing_support::shadowMapsOf(frames.plan)[0].size);
    for (const int face : testing_support::shadowMapsOf(frames.plan)[0].faces) {
      const Pass& pass = frames.plan.passes[static_cast<size_t>(face)];
      EXPECT_TRUE(!pass.drawn() || pass.view.rect.width <= sizes.back());
    }
  }
  EXPECT_GT(sizes[0], sizes[1]);
  EXPECT_GT(sizes[1], sizes[2]);
  EXPECT_TRUE(frames.rendered().empty()) << "nothing changed";
}

TEST(ShadowMap, HybridDrawsMapsAndTraces) {
  ShadowFrames frames(lampRoom());
  const std::vector<int> faces = frames.rendered();
  frames.settings.effects.shadowLookup = ShadowLookup::hybrid;
  EXPECT_EQ(frames.rendered(), faces) << "the maps get marks of edges";
  EXPECT_TRUE(frames.plan.effects.shadowMaps && frames.plan.effects.hybridShadows);
  EXPECT_TRUE(frames.plan.effects.traces());
  EXPECT_TRUE(frames.rendered().empty());
}

TEST(ShadowMap, AutomaticLookupTakesTheFasterOne) {
  const Scene scene = lampRoom();
  const SceneState state = evaluate(scene, 0.0);
  Settings settings;
  settings.effects.shadowLookup = ShadowLookup::automatic;
  const auto chosen = [&](const glm::ivec2& size, bool cpu = true) {
    const FittedPlan fitted =
        planWithin({.budgetBytes = 1ull << 40, .largestSide = 16384, .cpu = cpu}, {scene, state, settings, size});
    EXPECT_EQ(std::string(fitted.plan.effects.shadows.value_or("")),
              "light 0; auto: " + settingValue(fitted.settings, "effects.shadow_lookup"));
    EXPECT_TRUE(fitted.message.empty()) << fitted.message;
    return fitted.settings.effects.shadowLookup;
  };
  EXPECT_EQ(chosen({1280, 720}), ShadowLookup::map);
  EXPECT_EQ(chosen({64, 48}), ShadowLookup::traced) << "fewer rays than texels of the maps";
  EXPECT_EQ(chosen({1280, 720}, false), ShadowLookup::traced);
  EXPECT_EQ(chosen({3840, 2160}, false), ShadowLookup::map);
  settings.view.accumulate = 2;
  EXPECT_EQ(chosen({1280, 720}), ShadowLookup::hybrid) << "maps err alike in all pictures of a mean";
  EXPECT_EQ(chosen({64, 48}), ShadowLookup::traced);
  EXPECT_EQ(chosen({3840, 2160}, false), ShadowLookup::traced);
  settings.view.accumulate = 1;
  settings.effects.shadowLookup = ShadowLookup::hybrid;
  const FittedPlan without = planWithin({.budgetBytes = 1ull << 40, .largestSide = 16384, .hybridShadows = false},
                                        {scene, state, settings, {64, 48}});
  EXPECT_EQ(without.settings.effects.shadowLookup, ShadowLookup::traced);
  EXPECT_NE(without.message.find("effects.shadow_lookup=hybrid"), std::string::npos);
}

// The faster ways that were measured on an H200 at 1280x720, by samples a pixel and size of the maps (0: auto).
TEST(ShadowMap, AutomaticLookupsAreThoseMeasured) {
  constexpr auto map = ShadowLookup::map;
  constexpr auto traced = ShadowLookup::traced;
  const std::vector<std::pair<int, int>> columns{{1, 1024}, {1, 0}, {1, 2048}, {4, 1024}, {4, 0}, {4, 2048}};
  for (const auto& [name, expected] :
       {std::pair("gallery.toml", std::array{map, traced, traced, map, map, map}),
        std::pair("shadows.toml", std::array{traced, traced, traced, traced, map, traced})}) {
    const Scene scene = loadScene(sourceDir() / "scenes" / name);
    const SceneState state = evaluate(scene, 0.0);
    for (size_t i = 0; i < columns.size(); ++i) {
      Settings settings = settingsOf(scene);
      settings.effects.shadowLookup = ShadowLookup::automatic;
      settings.view.samples = settings.reflection.samples = columns[i].first;
      settings.effects.shadowMapSize = columns[i].second;
      const FittedPlan fitted =
          planWithin({.budgetBytes = 1ull << 40, .largestSide = 16384}, {scene, state, settings, {1280, 720}});
      EXPECT_EQ(fitted.settings.effects.shadowLookup, expected[i]) << name << ", column " << i;
    }
  }
}

TEST(ShadowMap, MemoryIncludesItAndLowersIt) {
  ShadowFrames frames(lampRoom());
  frames.next();
  FramePlan without = frames.plan;
  without.cubes.clear();
  const uint64_t bytes = 6ull * 1024 * 1024 * (8 + 4);
  EXPECT_EQ(shadowBytes(frames.plan), bytes);
  Layers layers;
  layers.down(0.0);
  layers.down(0.1);
  EXPECT_EQ(shadowBytes(layers.plan), bytes + 6ull * 1024 * 1024 * 8);
  EXPECT_EQ(targetBytes(frames.plan, frames.settings), targetBytes(without, frames.settings) + bytes);
  const SceneState state = evaluate(frames.scene, 0.0);
  const FittedPlan fitted =
      planWithin({.budgetBytes = 10'000'000, .largestSide = 4096},
                 {frames.scene, state, frames.settings, {testing_support::width, testing_support::height}});
  EXPECT_LT(fitted.settings.effects.shadowMapSize, 1024);
  EXPECT_NE(fitted.message.find("effects.shadow_map_size to 512"), std::string::npos) << fitted.message;
  const FittedPlan narrow =
      planWithin({.budgetBytes = 1ull << 40, .largestSide = 2048},
                 {frames.scene, state, frames.settings, {testing_support::width, testing_support::height}});
  EXPECT_EQ(narrow.settings.effects.shadowMapSize, 512);
}

// A face that gets its first caster moves the faces behind it in the target, so none of these can be reused.
TEST(ShadowMap, FacesWithoutCastersTakeNoRoom) {
  ShadowFrames frames(lampRoom());
  const uint64_t face = 1024ull * 1024 * (8 + 4);
  frames.scene.lights[0].position = {0, 60, -5};
  EXPECT_EQ(frames.rendered(), (std::vector<int>{3})) << "all casters are below the light";
  EXPECT_EQ(shadowBytes(frames.plan), face);
  EXPECT_TRUE(frames.rendered().empty());
  frames.scene.objects.push_back(objectAt({20, 60, -5}));
  frames.rendered();
  EXPECT_EQ(shadowBytes(frames.plan), 2 * face);
  EXPECT_TRUE(testing_support::faceOf(frames.plan, testing_support::shadowMapsOf(frames.plan)[0], 3).drawn());
}

}  // namespace
}  // namespace speculum
