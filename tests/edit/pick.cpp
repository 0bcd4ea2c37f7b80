// The node that a ray finds at a pixel, against the color that the rasteriser drew there.
#include "edit/picture_view.hpp"

#include "random.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "studio.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr int width = 480;
constexpr int height = 270;

glm::dvec3 randomColor(Random& random) {
  const double r = random.uniform(0.05, 1.0);
  const double g = random.uniform(0.05, 1.0);
  return {r, g, random.uniform(0.05, 1.0)};
}

// Gives each node a color of its own, independent of light. A mirror shows half of its reflection and half of its own
// color, so that a pixel's color identifies all the mirrors that it is seen through.
void makeFlat(Scene& scene) {
  Random random(7);
  scene.environment = {.ambient = glm::dvec3(1.0)};
  for (Object& object : scene.objects) {
    object.color = randomColor(random);
    object.specular = glm::dvec3(0.0);
    object.emission = glm::dvec3(0.0);
    object.mirror.reset();
  }
  for (PointLight& light : scene.lights) {
    light.color = randomColor(random);
    light.glow = light.glow > 0.0 ? 1.0 : 0.0;
    light.intensity = 0.0;
    light.castsShadow = false;
  }
  for (Mirror& mirror : scene.mirrors) {
    mirror.reflectance = glm::dvec3(0.5);
    mirror.fresnel = Fresnel::none;
    mirror.baseColor = randomColor(random);
    mirror.backColor = randomColor(random);
    mirror.roughness = 0.0;
    mirror.ripple.reset();
    mirror.castsLight = false;
  }
}

bool showsBack(const Scene& scene, const SceneState& state, const Picked& mirror, const PictureView& picture) {
  const auto seen = picture.through(scene, state, mirror.path);
  const auto index = static_cast<size_t>(mirror.what.index);
  return !scene.mirrors[index].twoSided &&
         glm::dot(state.mirrors[index].normal, seen->eye() - state.mirrors[index].origin) < 0.0;
}

// Returns the color that the nodes found at a pixel would give.
glm::dvec3 flatColor(const Scene& scene, const SceneState& state, const std::vector<Picked>& found,
                     const PictureView& picture) {
  glm::dvec3 color(0.0);
  for (const Picked& picked : found) {
    const auto index = static_cast<size_t>(picked.what.index);
    if (picked.what.kind == Selection::Kind::object) {
      color = *scene.objects[index].color;
    } else if (picked.what.kind == Selection::Kind::light) {
      color = scene.lights[index].color;
    } else if (showsBack(scene, state, picked, picture)) {
      color = scene.mirrors[index].backColor;
    } else {
      color = 0.5 * color + 0.5 * scene.mirrors[index].baseColor;
    }
  }
  return color;
}

class PickedScene : public testing::TestWithParam<const char*> {
 protected:
  PickedScene() {
    makeFlat(studio_.scene);
    studio_.settings.view.samples = studio_.settings.reflection.samples = 1;
    studio_.settings.effects.textures = false;
    studio_.time = 1.0;
  }

  Options options_ = headless(sceneFile(GetParam()), {width, height});
  Studio studio_{options_};
};

double largestDifference(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = glm::abs(a - b);
  return std::max({d.r, d.g, d.b});
}

TEST_P(PickedScene, IsWhatThePixelShows) {
  studio_.draw();
  const LinearImage drawn = studio_.sceneRenderer.radiance();
  const Scene& scene = studio_.scene;
  const PictureView picture(studio_.state.camera, width, height);
  Picker picker(scene);
  const ReflectionSettings& r = studio_.settings.reflection;
  const PickLimits limits{r.maxDepth, r.minThroughput, studio_.plan.skipped};
  Random random(11);
  constexpr int pixels = 1500;
  int edges = 0;
  std::array<int, 4> byDepth{};
  for (int i = 0; i < pixels; ++i) {
    const int x = static_cast<int>(random.uniform(1, width - 1));
    const int y = static_cast<int>(random.uniform(1, height - 1));
    const auto found = picker.at(studio_.state, picture, {x + 0.5, y + 0.5}, limits);
    const glm::dvec3 expected = flatColor(scene, studio_.state, found, picture);
    const auto at = [&](int dx, int dy) {
      return glm::dvec3(drawn.pixels[static_cast<size_t>(y + dy) * width + static_cast<size_t>(x + dx)]);
    };
    byDepth[found.empty() ? 0 : std::min<size_t>(found[0].path.size(), 3)] += 1;
    if (largestDifference(at(0, 0), expected) < 0.003) {
      continue;
    }
    // A pixel on an edge may show either side of it, because the rasteriser rounds to floats.
    ++edges;
    double nearest = 1.0;
    for (int n = 0; n < 9; ++n) {
      nearest = std::min(nearest, largestDifference(at(n % 3 - 1, n / 3 - 1), expected));
    }
    EXPECT_LT(nearest, 0.003) << "pixel " << x << ", " << y << ": "
                              << (found.empty() ? "nothing" : describe(scene, found[0].what));
  }
  EXPECT_LE(edges, pixels / 500);
  std::printf("%s: %d directly, %d in one mirror, %d in two, %d in more; %d at edges\n", GetParam(), byDepth[0],
              byDepth[1], byDepth[2], byDepth[3], edges);
  RecordProperty("edges", edges);
  EXPECT_TRUE(std::string(GetParam()) == "no_mirror" || byDepth[1] > 20);
}

class PickedPoint : public testing::TestWithParam<const char*> {};

TEST_P(PickedPoint, LiesWhereItIsSeen) {
  Scene scene = loadScene(sceneFile(GetParam()));
  makeFlat(scene);
  const SceneState state = evaluate(scene, 1.0);
  const PictureView picture(state.camera, width, height);
  Picker picker(scene);
  Random random(5);
  int checked = 0;
  for (int i = 0; i < 300; ++i) {
    const double x = random.uniform(0, width);
    const glm::dvec2 pixel(x, random.uniform(0, height));
    for (const Picked& picked : picker.at(state, picture, pixel, {.maxDepth = 3})) {
      const auto seen = picture.through(scene, state, picked.path);
      ASSERT_TRUE(seen);
      const auto back = seen->pixel(picked.point);
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->x, pixel.x, 1e-6);
      EXPECT_NEAR(back->y, pixel.y, 1e-6);
      ++checked;
    }
  }
  EXPECT_GT(checked, 100);
}

const std::vector<const char*> scenes = {"facing_mirrors", "many_mirrors", "outdoors", "pool",        "gallery",
                                         "mirror_maze",    "no_mirror",    "shadows",  "single_plane"};
const auto sceneName = [](const testing::TestParamInfo<const char*>& info) { return std::string(info.param); };
INSTANTIATE_TEST_SUITE_P(Scenes, PickedScene,
                         testing::ValuesIn(scenes.begin(), fullTests() ? scenes.end() : scenes.begin() + 4), sceneName);
INSTANTIATE_TEST_SUITE_P(Scenes, PickedPoint, testing::ValuesIn(scenes), sceneName);

// A column of two balls, a light that is seen and one that is not.
const std::string nodes = R"(
[[object]] name = "ball", model = "MODELS/sphere.obj", position = [0.6, 1, 0.5], scale = 0.2
  copies = { count = 2, step = [0, 5, 0] }
[[light]] position = [-0.5, 1.5, 0], radius = 0.1
[[light]] position = [-0.5, 0.7, 0], radius = 0.1, glow = 0
)";

class Corridor : public testing::Test {
 protected:
  std::vector<Picked> at(const glm::dvec3& world, const PickLimits& limits = {}) {
    return picker_.at(state_, picture_, picture_.pixel(world).value(), limits);
  }
  Scene scene_ = loadScene(writeScene("corridor", corridorScene(nodes)));
  SceneState state_ = evaluate(scene_, 0.0);
  PictureView picture_{state_.camera, 900, 700};
  Picker picker_{scene_};
};

const Selection ball{Selection::Kind::object, 0, 0};
const Selection ahead{Selection::Kind::mirror, 0};
const Selection behind{Selection::Kind::mirror, 1};

TEST_F(Corridor, IsPickedDirectlyAndThroughMirrors) {
  const glm::dvec3 center(0.6, 1.0, 0.5);
  const auto direct = at(center);
  ASSERT_EQ(direct.size(), 1u);
  EXPECT_EQ(direct[0].what, ball);
  EXPECT_NEAR(glm::distance(direct[0].point, center), 0.1, 0.01);

  // The image in a mirror at z = -2, and that of the image in a mirror at z = 2.
  const auto once = at({0.6, 1.0, -4.5});
  ASSERT_EQ(once.size(), 2u);
  EXPECT_EQ(once[0].what, ball);
  EXPECT_EQ(once[0].path, MirrorPath({0}));
  EXPECT_NEAR(glm::distance(once[0].point, center), 0.1, 0.01) << "the thing's own place, not its image's";
  EXPECT_LT(once[0].point.z, center.z) << "its far side is seen";
  EXPECT_EQ(once[1], (Picked{ahead, {}, once[1].point}));

  const auto twice = at({0.6, 1.0, -7.5});
  ASSERT_EQ(twice.size(), 3u);
  EXPECT_EQ(twice[0].what, ball);
  EXPECT_EQ(twice[0].path, MirrorPath({0, 1}));
  EXPECT_EQ(twice[1].what, behind);
  EXPECT_EQ(twice[1].path, MirrorPath({0}));
  EXPECT_EQ(twice[2].what, ahead);
}

TEST_F(Corridor, FollowsMirrorsAsDeepAsDrawn) {
  EXPECT_EQ(at({0.6, 1.0, -7.5}, {.maxDepth = 1})[0].what, behind) << "it shows the background";
  EXPECT_EQ(at({0.6, 1.0, -7.5}, {.maxDepth = 0})[0].what, ahead);
  EXPECT_EQ(at({0.6, 1.0, -7.5}, {.minThroughput = 0.93})[0].what, behind) << "0.95 squared is below";
  const RecycledVector<SkippedMirror> skipped{{{0, 1}, SkipReason::maxPasses, ""}};
  EXPECT_EQ(at({0.6, 1.0, -7.5}, {.skipped = skipped})[0].what, behind);
  const RecycledVector<SkippedMirror> held{{{0, 1}, SkipReason::unchanged, ""}};
  EXPECT_EQ(at({0.6, 1.0, -7.5}, {.skipped = held})[0].what, ball);
}

TEST_F(Corridor, LightsArePickedByTheirGlow) {
  EXPECT_EQ(at({-0.5, 1.5, 0})[0].what, (Selection{Selection::Kind::light, 0}));
  EXPECT_EQ(at({-0.5, 1.5, -4.0})[0].path, MirrorPath({0}));
  EXPECT_NE(at({-0.5, 0.7, 0})[0].what.kind, Selection::Kind::light) << "without a glow it is not drawn";
  EXPECT_TRUE(picker_.at(state_, picture_, {2.0, 2.0}, {}).empty()) << "the background";
}

// A triangle whose material says mirror is a part of its object, and shows what it reflects.
TEST(PickedMaterial, IsTheObjectAndReflects) {
  writeModel("pane.mtl", "newmtl m\nKs 1 1 1\nNs 1000\nillum 3\n");
  writeModel("pane.obj", "mtllib pane.mtl\nv -2 -2 0\nv 2 -2 0\nv 0 3 0\nusemtl m\nf 1 2 3\n");
  const Scene scene = loadScene(writeScene("pane", R"([camera] position = [0, 0, 2], target = [0, 0, 0]
[[object]] model = "pane.obj", copies = { count = 2, step = [0, 0, -9] }
[[object]] model = "MODELS/sphere.obj", position = [0, 0, 4], visible = "mirrors"
)"));
  const SceneState state = evaluate(scene, 0.0);
  const std::vector<Picked> found = Picker(scene).at(state, {state.camera, 90, 90}, {45, 45}, {});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].what, (Selection{Selection::Kind::object, 1}));
  EXPECT_EQ(found[0].path, MirrorPath({0}));
  EXPECT_EQ(found[1].what, (Selection{Selection::Kind::object, 0, 0}));
}

TEST_F(Corridor, MirrorsReflectOnTheirFrontOnly) {
  EXPECT_TRUE(picture_.through(scene_, state_, std::vector<int>{0, 1, 0}));
  EXPECT_FALSE(picture_.through(scene_, state_, std::vector<int>{1})) << "behind the eye";
  EXPECT_FALSE(picture_.through(scene_, state_, std::vector<int>{0, 7}));
  Scene turned = scene_;
  turned.mirrors[0].rotation.y = 180.0;
  EXPECT_FALSE(picture_.through(turned, evaluate(turned, 0.0), std::vector<int>{0})) << "its back";
}

}  // namespace
}  // namespace speculum
