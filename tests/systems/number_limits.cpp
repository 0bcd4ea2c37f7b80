// Scenes at the ends of what is allowed: textures repeated a million times, exposures, mirrors, surfaces that coincide.
#include "geometry/affine.hpp"
#include "image/picture_files.hpp"
#include "made_pictures.hpp"
#include "random.hpp"
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum::number_limits {
namespace {

using namespace testing_support;

constexpr PictureSize size{96, 54};

// A plane of many squares that repeat a checkerboard, with corners that the squares share, seen near a random point of
// it.
std::string repeatedTexture(Random& random, double repeats, int squares, double metresPerRepeat, bool mirrored) {
  std::ostringstream model;
  model << "mtllib checks.mtl\nusemtl a\n";
  const double shift = random.chance(0.5) ? 0.0 : 1000.3;
  for (int i = 0; i <= squares; ++i) {
    for (int k = 0; k <= squares; ++k) {
      const glm::dvec2 at = 2.0 * glm::dvec2(i, k) / static_cast<double>(squares) - 1.0;
      model << "v " << text(at.x) << " 0 " << text(at.y) << "\nvt " << text(0.5 * repeats * at.x + shift) << " "
            << text(0.5 * repeats * (0.3 * at.x - at.y)) << "\nvn 0 1 0\n";
    }
  }
  for (int i = 0; i < squares; ++i) {
    for (int k = 1; k <= squares; ++k) {
      const int corners[] = {i * (squares + 1) + k, i * (squares + 1) + k + 1, (i + 1) * (squares + 1) + k + 1,
                             (i + 1) * (squares + 1) + k};
      model << "f";
      for (const int corner : corners) {
        model << " " << corner << "/" << corner << "/" << corner;
      }
      model << "\n";
    }
  }
  writeModel("checked.obj", model.str());
  const glm::dvec3 rotation = random.inBox(180.0);
  const glm::dmat3 turn = rotationFromDegrees(rotation);
  const double size = 0.5 * repeats * metresPerRepeat;
  const glm::dvec3 position = random.inBox(1e4);
  const glm::dvec3 point =
      position + turn * (size * glm::dvec3(random.uniform(-0.8, 0.8), 0, random.uniform(-0.8, 0.8)));
  const auto near = [&](double x, double y, double z) {
    return point + turn * (metresPerRepeat * glm::dvec3(x, y, z));
  };
  std::ostringstream scene;
  scene << "[environment]\nambient = [0.5, 0.5, 0.5]\n"
        << cameraText(near(0.2, 2, 3), point, turn[1]) << "near = " << text(1e-4 * metresPerRepeat)
        << "\nvertical_fov = 40\n[[object]]\nmodel = 'checked.obj'\nposition = " << text(position)
        << "\nrotation = " << text(rotation) << "\nscale = " << text(size) << "\n";
  const bool lit = repeats < 5e5;  // rounding moves points of a larger plane by a part of the light's distance
  if (lit) {
    scene << "[[light]]\ncasts_shadow = " << (random.chance(0.5) ? "true" : "false")
          << "\nposition = " << text(near(1, 2, 1)) << "\nradius = " << text(0.01 * metresPerRepeat)
          << "\nintensity = " << text(metresPerRepeat * metresPerRepeat) << "\n";
  }
  if (mirrored) {
    scene << "[[mirror]]\n" << polygonText({near(-2, 0.1, -1), near(2, 0.1, -1), near(2, 2, -1), near(-2, 2, -1)});
  }
  return scene.str();
}

TEST(TexturesRepeatedOften, MatchTheTracer) {
  writePng(sceneDirectory() / "checks.png", madePicture(2, 2, [](int x, int y) {
             return x == y ? glm::ivec4(255, 200, 180, 255) : glm::ivec4(60, 30, 0, 255);
           }));
  std::ofstream(sceneDirectory() / "checks.mtl") << "newmtl a\nKd 1 1 1\nmap_Kd checks.png\n";
  Random random(3);
  const double repeats[] = {60, 1e3, 5e3, 1e5, 1e6};
  for (int i = 0; i < 10; ++i) {
    const int squares = i % 3 == 0 ? 1 : i % 3 == 1 ? 5 : 24;
    const auto file = writeScene("repeated_" + std::to_string(i),
                                 repeatedTexture(random, repeats[i % 5], squares, i % 2 == 0 ? 1.0 : 0.02, i % 4 > 1));
    Studio studio(truthOptions(file, {96, 54}, 2));
    studio.settings.effects.rays = RayMethod::software;
    studio.settings.reflection.method = i >= 5 ? ReflectionMethod::rays : ReflectionMethod::automatic;
    expectTruth(studio, file, trace(file, {96, 54}, 2));
  }
}

TEST(TexturesRepeatedOften, LeaveOtherTrianglesAsTheyAre) {
  std::ofstream(sceneDirectory() / "few.mtl") << "newmtl a\nmap_Kd checks.png\nnewmtl b\n";
  writePng(sceneDirectory() / "checks.png",
           madePicture(2, 2, [](int x, int y) { return glm::ivec4(90 * x, 90 * y, 0, 255); }));
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 20 0\nvt 20 9\nvt 0 1e6\n";
  writeModel("few.obj", "mtllib few.mtl\n" + corners + "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n");
  writeModel("many.obj", "mtllib few.mtl\n" + corners + "usemtl a\nf 1/1 3/3 4/4\nf 1/1 2/2 3/3\n");
  const auto meshOf = [&](const char* model) {
    return loadScene(writeScene("few", cameraText({0, 0, 3}, {0, 0, 0}) + "[[object]]\nmodel = '" + model + "'\n"))
        .meshes[0];
  };
  const Mesh few = meshOf("few.obj");
  EXPECT_EQ(few.repeats, 0u) << "without a texture, or with few repeats";
  EXPECT_EQ(few.parts.size(), 2u);
  const Mesh many = meshOf("many.obj");
  EXPECT_EQ(many.repeats, 1u);
  ASSERT_EQ(many.parts.size(), 2u);
  EXPECT_EQ(many.parts[0].material.diffuseTexture, many.parts[1].material.diffuseTexture);
}

// Sources of light of radiance 1 / `exposure`, all in one scene: it looks alike at any exposure.
std::filesystem::path exposedScene(double exposure, const std::string& settings = "") {
  const auto light = [&](double r, double g, double b) { return text(glm::dvec3(r, g, b) / exposure); };
  return writeScene(
      "exposed", "[settings]\n\"view.exposure\" = " + text(exposure) + "\n" + settings +
                     "[environment]\nsky = { zenith = " + light(0.1, 0.2, 0.6) + ", horizon = " + light(0.5, 0.5, 0.4) +
                     ", ground = " + light(0.1, 0.1, 0.1) + " }\nambient = " + light(0.1, 0.1, 0.1) + "\n" +
                     cameraText({0.1, 1.2, 4.0}, {0.2, 0.8, 0.1}) +
                     "[[object]]\nmodel = 'MODELS/sphere.obj'\nposition = [-0.5, 0.9, 0.2]\nscale = 0.5\n"
                     "emission = " +
                     light(0.05, 0.1, 0.2) +
                     "\n[[object]]\nmodel = 'MODELS/sphere.obj'\nposition = [0.9, 0.6, 0.4]\nscale = 0.4\n"
                     "mirror = { reflectance = [0.9, 0.8, 0.7], base_color = [0.1, 0.1, 0.2] }\n"
                     "[[object]]\nmodel = 'lamp.obj'\nposition = [0, 1.6, 0]\nscale = 0.3\n"
                     "[[light]]\nposition = [1, 3, 2]\nradius = 0.2\nglow = 0.7\nintensity = 0.6\ncolor = " +
                     light(8, 9, 10) +
                     "\ncasts_shadow = true\n[[mirror]]\nposition = [0.1, 0, -0.2]\n"
                     "rotation = [-90, 2, 3]\nsize = [4, 3]\nbase_color = [0.1, 0.2, 0.1]\ncasts_light = true\n");
}

TEST(ExposuresOfAnySize, ShowOnePicture) {
  writeModel("lamp.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  for (const char* settings : {"\"effects.shadow_lookup\" = \"map\"\n\"effects.curved_lookup\" = \"environment\"\n",
                               "\"effects.rays\" = \"software\"\n\"reflection.method\" = \"rays\"\n"}) {
    Studio studio(headless(exposedScene(1.0, settings), size));
    const Image8 usual = studio.draw();
    const LinearImage radiance = studio.sceneRenderer.radiance();
    for (const double exposure : {1e-25, 1e-6, 3e-5, 1e-3, 1e3, 7e4, 1e6}) {
      const Scene scene = loadScene(exposedScene(exposure, settings));
      studio.show(scene);
      studio.settings = settingsOf(scene);
      const Image8 picture = studio.draw();  // reuses nothing of another exposure
      const PictureAgreement agreement = difference(picture, usual, 2);
      EXPECT_LE(agreement.share(), 0.003)
          << exposure << ": " << agreement.over << " pixels, up to " << agreement.largest;
      const LinearImage scaled = studio.sceneRenderer.radiance();
      double sum = 0.0;
      double expected = 0.0;
      for (size_t i = 0; i < scaled.pixels.size(); ++i) {
        sum += exposure * scaled.pixels[i].g;
        expected += radiance.pixels[i].g;
      }
      EXPECT_NEAR(sum, expected, 0.002 * expected) << exposure << ": the radiance itself is not exposed";
    }
  }
}

// The exposure alone changes, from picture to picture of one scene.
TEST(ExposuresOfAnySize, ReuseNoImageOfAnotherScale) {
  writeModel("lamp.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto file = exposedScene(1e5, "\"effects.curved_lookup\" = \"environment\"\n");
  Studio studio(headless(file, size));
  studio.reusesMain = true;
  Studio other(headless(file, size));
  for (const double exposure : {1e5, 1.0, 1e6, 2e5, 1e4}) {
    studio.settings.view.exposure = other.settings.view.exposure = exposure;
    EXPECT_EQ(studio.draw().rgba, other.fresh().rgba) << exposure;
    EXPECT_EQ(studio.draw().rgba, other.fresh().rgba) << exposure << ", unchanged";
  }
}

// Cuts of a polygon of 1e15 m are off by decimetres, as are its corners.
TEST(LargeMirrors, ReachTheHorizon) {
  std::vector<std::filesystem::path> files;
  const auto add = [&](const std::string& mirror, bool standing = true) {
    files.push_back(
        writeScene("large_" + std::to_string(files.size()),
                   "[environment]\nambient = [0.2, 0.2, 0.2]\nsky = { zenith = [0.2, 0.4, 0.9], horizon = "
                   "[0.8, 0.85, 0.9], ground = [0.3, 0.28, 0.25] }\n" +
                       cameraText({0.3, 1.2, 4}, {0, 0.6, 0}) +
                       objectText("MODELS/box.obj", {0, 0.01, 0}, {0, 20, 0}, 1.0, {0.7, 0.3, 0.1}) + "[[mirror]]\n" +
                       mirror + (standing ? "[[mirror]]\n" + rectangleText({-1.5, 1, -0.5}, {0, 40, 0}, 1, 1) : "")));
  };
  for (const double metres : {1e11, 1e13, 1e14, 3e14, 7e14, 1e15}) {
    add(rectangleText({0, 0, 0}, {-90, 0, 0}, metres, metres));
    add(rectangleText({0, 0, 0}, {-89, 0.5, 0.3}, metres, 0.7 * metres));
    add(polygonText({{-metres, 0, 0.5 * metres}, {metres, 0, metres}, {0.3 * metres, 0, -metres}}), metres < 1e12);
    add(polygonText({{-metres, 0, metres}, {metres, 0, metres}, {0, 0, -metres}}), metres < 1e12);
    add(polygonText({{-3, 0, 3}, {3, 0, 3}, {0.5 * metres, 0, -metres}, {-0.5 * metres, 0, -metres}}));
  }
  expectTruths(files, {96, 54}, 2);
}

// Quads that lie on one another, turned and far from the origin, under a light that casts shadows, before a mirror.
// Copies of one model in one place have their own colors; others have one color, and sizes of their own.
std::string coincidingQuads(Random& random, bool copies) {
  const glm::dvec3 rotation = random.inBox(180.0);
  const glm::dmat3 turn = rotationFromDegrees(rotation);
  const glm::dvec3 center = random.inBox(random.chance(0.5) ? 1.0 : 1e4);
  const auto at = [&](double x, double y, double z) { return center + turn * glm::dvec3(x, y, z); };
  std::ostringstream scene;
  scene << "[environment]\nambient = [0.1, 0.1, 0.1]\nbackground = [0.1, 0.2, 0.3]\n"
        << cameraText(at(random.uniform(-1, 1), 0.5, 3), at(0.1, 0.1, 0))
        << "[[light]]\nposition = " << text(at(random.uniform(-3, 3), random.uniform(-3, 3), 1.5))
        << "\nintensity = 20\ncasts_shadow = true\n"
        << objectText("MODELS/sphere.obj", at(0.3, 0.2, 0.5), {0, 0, 0}, 0.2, {0.5, 0.7, 0.5});
  for (int i = 0; i < 3; ++i) {
    scene << objectText("quad.obj", copies ? center : at(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0),
                        rotation, copies ? 1.0 : random.uniform(0.4, 1.2),
                        copies ? glm::dvec3(0.2 + 0.3 * i, 0.5, 0.9 - 0.3 * i) : glm::dvec3(0.7, 0.6, 0.3));
  }
  scene << "[[mirror]]\n" << polygonText({at(-1, 1.3, -1), at(1, 1.3, -1), at(1, 1.3, 1), at(-1, 1.3, 1)});
  return scene.str();
}

TEST(ObjectsOfOnePlane, ShadowNoneOfThem) {
  writeQuad();
  Random random(9);
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < 10; ++i) {
    files.push_back(writeScene("one_plane_" + std::to_string(i), coincidingQuads(random, i % 2 == 0)));
  }
  Studio studio(truthOptions(files.front(), size, 2));
  studio.settings.effects.rays = RayMethod::software;  // others leave open which copy is met
  for (const std::filesystem::path& file : files) {
    expectTruth(studio, file, trace(file, size, 2));
  }
}

}  // namespace
}  // namespace speculum::number_limits
