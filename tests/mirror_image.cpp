// Mirrors are right, not merely unchanged: a mirror image is the direct picture of the mirrored scene.
#include "geometry/affine.hpp"
#include "geometry/reflection.hpp"
#include "picture_support.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "studio.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{320, 180};

struct Node {
  std::string model;
  glm::dvec3 position;
  glm::dmat3 rotation;
  glm::dvec3 scale;
};

struct World {
  glm::dvec3 eye, target;
  Plane mirror;
  glm::dvec3 mirrorAngles;
  std::vector<Node> nodes;
  std::vector<glm::dvec3> lights;
};

// Pitch, yaw, roll of a rotation R = Ry Rx Rz, in degrees.
glm::dvec3 anglesOf(const glm::dmat3& r) {
  const double pitch = std::asin(std::clamp(-r[2][1], -1.0, 1.0));
  return glm::degrees(glm::dvec3(pitch, std::atan2(r[2][0], r[2][2]), std::atan2(r[0][1], r[1][1])));
}

// A mirror in any orientation, an eye in front of it that looks at it, and objects between and beside them.
World randomWorld(unsigned seed) {
  Random random(seed);
  World world;
  world.mirrorAngles = random.inBox(170.0);
  const glm::dmat3 frame = rotationFromDegrees(world.mirrorAngles);
  world.mirror = {random.inBox(5.0), frame[2]};
  const auto at = [&](double x, double y, double z) { return world.mirror.point + frame * glm::dvec3(x, y, z); };
  world.eye = at(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(2, 4));
  world.target = at(random.uniform(-1, 1), random.uniform(-1, 1), 0.0);
  for (const char* model : {"teapot", "torus_knot", "sphere", "vase", "queen", "torus_knot"}) {
    const double size = random.uniform(0.3, 0.9);
    world.nodes.push_back({model, at(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(1.5, 4.5)),
                           rotationFromDegrees(random.inBox(180.0)), glm::dvec3(size, size, 1.3 * size)});
  }
  for (int i = 0; i < 2; ++i) {
    world.lights.push_back(at(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(1, 5)));
  }
  return world;
}

// Mirrors by H: H R S = (H R diag(-1, 1, 1)) (diag(-1, 1, 1) S) is a rotation and a scale with one negative factor.
World mirrored(World world) {
  const glm::dmat3 h = reflectionLinear(world.mirror.normal);
  for (Node& node : world.nodes) {
    node.position = reflectPoint(node.position, world.mirror);
    node.rotation = h * node.rotation * glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, 1);
    node.scale.x = -node.scale.x;
  }
  for (glm::dvec3& light : world.lights) {
    light = reflectPoint(light, world.mirror);
  }
  return world;
}

std::string toml(const World& world, const std::string& reflectance) {
  std::ostringstream out;
  out << "[environment]\nbackground = [0.3, 0.5, 0.4]\nambient = [0.1, 0.1, 0.1]\n[camera]\nposition = "
      << text(world.eye) << "\ntarget = " << text(world.target) << "\nvertical_fov = 70\n"
      << "[settings]\n\"view.samples\" = 1\n\"reflection.samples\" = 1\n";
  for (const Node& node : world.nodes) {
    out << "[[object]]\nmodel = \"MODELS/" << node.model << ".obj\"\nposition = " << text(node.position)
        << "\nrotation = " << text(anglesOf(node.rotation)) << "\nscale = " << text(node.scale) << "\n";
  }
  for (const glm::dvec3& light : world.lights) {
    out << "[[light]]\nposition = " << text(light) << "\nintensity = 12\n";
  }
  if (!reflectance.empty()) {
    out << "[[mirror]]\nposition = " << text(world.mirror.point) << "\nrotation = " << text(world.mirrorAngles)
        << "\nsize = [8, 8]\nreflectance = " << reflectance << "\n";
  }
  return out.str();
}

// Draws worlds one after the other.
class Worlds {
 public:
  explicit Worlds(const World& first) : studio_(gpu_, headless(write(first, "[1, 1, 1]"), size)) {}

  // Leaves the mirror out if `reflectance` is empty.
  Image8 draw(const World& world, const std::string& reflectance) {
    studio_.show(loadScene(write(world, reflectance)));
    return studio_.fresh();
  }
  Image8 drawNothing() {
    studio_.scene.objects.clear();
    studio_.scene.mirrors.clear();
    studio_.scene.lights.clear();
    return studio_.fresh();
  }

 private:
  static std::filesystem::path write(const World& world, const std::string& reflectance) {
    return writeScene("world", toml(world, reflectance));
  }

  Gpu gpu_{headless("", size)};
  Studio studio_;
};

class MirrorImage : public testing::TestWithParam<unsigned> {};

// Finds the mirror's pixels by drawing a black one: everything else has ambient light and is not black.
TEST_P(MirrorImage, EqualsThePictureOfTheMirroredScene) {
  const World world = randomWorld(GetParam());
  Worlds worlds(world);
  const Image8 seen = worlds.draw(world, "[1, 1, 1]");
  const Image8 direct = worlds.draw(mirrored(world), "");
  const std::vector<bool> mask = blackPixels(worlds.draw(world, "[0, 0, 0]"));
  const size_t covered = static_cast<size_t>(std::count(mask.begin(), mask.end(), true));
  ASSERT_GE(covered, mask.size() * 3 / 10) << "the mirror is too small to judge by";
  expectAlike(seen, direct, 1, "mirror_image_" + std::to_string(GetParam()), mask);
}

INSTANTIATE_TEST_SUITE_P(RandomPlanes, MirrorImage, testing::ValuesIn(sampledSeeds(20, 5)),
                         testing::PrintToStringParamName());

TEST(MirrorImages, HideWhatIsBehindThePlane) {
  Worlds worlds(randomWorld(100));
  for (unsigned seed = 100; seed < (fullTests() ? 105 : 102); ++seed) {
    World world = mirrored(randomWorld(seed));
    // Everything stands behind the mirror now, as near as 1 mm.
    for (Node& node : world.nodes) {
      node.position += world.mirror.normal * (-world.mirror.distance(node.position) - 1.0);
      node.scale *= 0.3;
    }
    const Image8 seen = worlds.draw(world, "[1, 1, 1]");
    const std::vector<bool> mask = blackPixels(worlds.draw(world, "[0, 0, 0]"));
    const Image8 empty = worlds.drawNothing();
    ASSERT_GT(std::count(mask.begin(), mask.end(), true), 0);
    const PictureAgreement d = difference(seen, empty, 0, mask);
    // Nothing of the mirrored scene shows where the mirror is.
    EXPECT_EQ(d.largest, 0) << "something behind the mirror shows, seed " << seed;
  }
}

TEST(MirrorImages, ClippingMethodsAgreeAtModerateDistance) {
  Gpu gpu(headless("", size));
  Studio studio(gpu, headless(writeScene("clips", toml(randomWorld(3), "[1, 1, 1]")), size));
  const Image8 expected = studio.draw();
  studio.settings.reflection.clip = ClipMethod::oblique;
  expectAlike(studio.draw(), expected, 1, "clip_oblique");
}

}  // namespace
}  // namespace speculum
