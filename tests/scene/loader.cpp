#include <ctime>

#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "scene/scene_state.hpp"
#include "scene/support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

Scene load(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("triangle.obj", triangleObj);
  return loadScene(folder.write("scene.toml", text));
}

// The values are in docs/scene_format.md, which tests/settings/docs_tables.cpp compares with the types.
TEST(SceneDefaults, AreThoseOfTheTypes) {
  const Scene scene =
      load(usualCamera +
           "[[object]]\nmodel = 'triangle.obj'\nmirror = {}\n[[light]]\nposition = [1, 2, 3]\norbit = {}\n"
           "[[mirror]]\nsize = [2, 1.5]\nripple = { amplitude = 0.01 }\n");
  EXPECT_EQ(scene.title, "");
  EXPECT_TRUE(scene.settings.empty() && scene.bookmarks.empty());
  EXPECT_EQ(scene.environment, Environment());
  EXPECT_EQ(scene.camera, (CameraSpec{.position = {0, 0, 4}}));
  EXPECT_EQ(scene.objects.at(0), (Object{.model = "triangle.obj", .mesh = 0, .mirror = ObjectMirror()}));
  EXPECT_EQ(scene.lights.at(0), (PointLight{.position = {1, 2, 3}, .orbit = Orbit()}));
  EXPECT_EQ(scene.mirrors.at(0), (Mirror{.size = {2, 1.5}, .ripple = Ripple{.amplitude = 0.01}}));
}

TEST(SceneDefaults, RippleWithoutAmplitudeIsNone) {
  EXPECT_FALSE(load(usualCamera + "[[mirror]]\nsize = [1, 1]\nripple = { wavelength = 0.1 }\n").mirrors.at(0).ripple);
}

const std::string everythingText =
    "title = 'Gallery'\n"
    "environment = { background = [0.45, 0.55, 0.60], ambient = [0.03, 0.04, 0.05], "
    "sky = { zenith = [0.2, 0.4, 0.9], horizon = [0.8, 0.85, 0.9], ground = [0.3, 0.28, 0.25] } }\n"
    "camera = { position = [0, 1.6, 4], target = [0, 1, 0], up = [0, 1, 1], vertical_fov = 45, near = 0.01, "
    "orbit_speed = -3 }\n"
    "object = [{ name = 'knot', model = 'triangle.obj', position = [0, 1, 0], rotation = [0, 30, 0], "
    "scale = [-1, 2, 3.5], up = 'z', visible = 'mirrors', spin = [0, 20, 0], color = [0.8, 0.2, 0.1], specular = "
    "[0.04, 0.05, 0.06], "
    "shininess = 0.5, emission = [0, 0, 2], copies = { count = 100, step = [1, 0, 0] }, "
    "mirror = { reflectance = [0.5, 0.6, 0.7], fresnel = 'schlick', base_color = [0, 0.1, 0] } }]\n"
    "light = [{ name = 'key', position = [1, 2, 1], color = [1, 0.9, 0.8], intensity = 8, radius = 0.1, glow = 0, "
    "casts_shadow = true, visible = 'eye', orbit = { center = [0, 2, 0], axis = [0, 0, 1], speed = 20 } }]\n"
    "mirror = [{ name = 'left', position = [0, 1, -2], rotation = [0, 90, 0], spin = [0, 10, 0], size = [2, 1.5], "
    "reflectance = [0.9, 0.8, 0.7], fresnel = 'schlick', base_color = [0.1, 0.2, 0.3], roughness = 0.25, "
    "ripple = { amplitude = 0.02, wavelength = 0.4, speed = -0.1 }, two_sided = true, back_color = [0, 1, 2], "
    "casts_light = true }, { polygon = [[0, 0, 0], [1, 0, 0], [0, 1, 0]] }]\n";

TEST(SceneLoader, ReadsEveryField) {
  const Scene scene = load(everythingText);
  EXPECT_EQ(scene.title, "Gallery");
  EXPECT_EQ(scene.environment, (Environment{.background = {0.45, 0.55, 0.60},
                                            .sky = Sky{{0.2, 0.4, 0.9}, {0.8, 0.85, 0.9}, {0.3, 0.28, 0.25}},
                                            .ambient = {0.03, 0.04, 0.05}}));
  EXPECT_EQ(scene.camera, (CameraSpec{.position = {0, 1.6, 4},
                                      .target = {0, 1, 0},
                                      .up = {0, 1, 1},
                                      .verticalFov = 45,
                                      .near = 0.01,
                                      .orbitSpeed = -3}));
  EXPECT_EQ(scene.objects.at(0), (Object{.name = "knot",
                                         .model = "triangle.obj",
                                         .mesh = 0,
                                         .position = {0, 1, 0},
                                         .rotation = {0, 30, 0},
                                         .scale = {-1, 2, 3.5},
                                         .up = UpAxis::z,
                                         .spin = {0, 20, 0},
                                         .color = glm::dvec3(0.8, 0.2, 0.1),
                                         .specular = glm::dvec3(0.04, 0.05, 0.06),
                                         .shininess = 1.0,  // below 1 counts as 1
                                         .emission = glm::dvec3(0, 0, 2),
                                         .visible = Visibility::mirrors,
                                         .copies = {100, {1, 0, 0}},
                                         .mirror = ObjectMirror{{0.5, 0.6, 0.7}, Fresnel::schlick, {0, 0.1, 0}}}));
  EXPECT_EQ(scene.lights.at(0), (PointLight{.name = "key",
                                            .position = {1, 2, 1},
                                            .color = {1, 0.9, 0.8},
                                            .intensity = 8,
                                            .radius = 0.1,
                                            .glow = 0,
                                            .castsShadow = true,
                                            .visible = Visibility::eye,
                                            .orbit = Orbit{{0, 2, 0}, {0, 0, 1}, 20}}));
  EXPECT_EQ(scene.mirrors.at(0), (Mirror{.name = "left",
                                         .position = {0, 1, -2},
                                         .rotation = {0, 90, 0},
                                         .spin = {0, 10, 0},
                                         .size = {2, 1.5},
                                         .reflectance = {0.9, 0.8, 0.7},
                                         .fresnel = Fresnel::schlick,
                                         .baseColor = {0.1, 0.2, 0.3},
                                         .roughness = 0.25,
                                         .ripple = Ripple{0.02, 0.4, -0.1},
                                         .twoSided = true,
                                         .backColor = {0, 1, 2},
                                         .castsLight = true}));
  EXPECT_EQ(scene.mirrors.at(1), (Mirror{.polygon = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}));
}

TEST(SceneLoader, ReadsBookmarks) {
  const Scene scene = load(
      "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nup = [0, 2, 0]\nvertical_fov = 40\n"
      "[[bookmark]]\nname = 'door'\nposition = [1, 2, 3]\ntarget = [0, 2, 0]\n"
      "[[bookmark]]\nname = 'Tür'\nposition = [1, 9, 1]\ntarget = [1, 0, 1]\nup = [0, 0, -1]\n"
      "vertical_fov = 90\n");
  ASSERT_EQ(scene.bookmarks.size(), 2u);
  EXPECT_EQ(scene.bookmarks[1].name, "Tür");
  EXPECT_EQ(cameraOf(scene.bookmarks[0], scene.camera),
            (CameraSpec{.position = {1, 2, 3}, .target = {0, 2, 0}, .up = {0, 2, 0}, .verticalFov = 40}));
  EXPECT_EQ(cameraOf(scene.bookmarks[1], scene.camera),
            (CameraSpec{.position = {1, 9, 1}, .target = {1, 0, 1}, .up = {0, 0, -1}, .verticalFov = 90}));
}

TEST(SceneLoader, OneScaleStandsForThree) {
  EXPECT_EQ(load(usualCamera + "[[object]]\nmodel = 'triangle.obj'\nscale = -2\n").objects[0].scale, glm::dvec3(-2.0));
}

TEST(SceneLoader, SharedMaterialFilesWarnOnce) {
  const TemporaryFolder folder;
  const LogCapture log;
  folder.write("shared.mtl", "newmtl a\nmap_Kd none.png\n");
  std::string text = usualCamera;
  for (const std::string name : {"a.obj", "b.obj", "c.obj"}) {
    folder.write(name, "mtllib shared.mtl\nusemtl a\n" + std::string(triangleObj));
    text += "[[object]]\nmodel = '" + name + "'\n";
  }
  const Scene scene = loadScene(folder.write("scene.toml", text));
  EXPECT_EQ(occurrences(log.text(), "shared.mtl:2: map_Kd: there is no file"), 1) << log.text();
  for (const Mesh& mesh : scene.meshes) {
    EXPECT_EQ(mesh.defects.size(), 1u) << "each is refused by --strict";
  }
}

TEST(SceneLoader, NamesMayRepeat) {
  const Scene scene =
      load(usualCamera + "[[mirror]]\nname = 'a'\nsize = [1, 1]\n[[mirror]]\nname = 'a'\nsize = [1, 1]\n");
  EXPECT_EQ(scene.mirrors.size(), 2u);
}

TEST(SceneLoader, SettingsAreFlattenedWithTheirLines) {
  const Scene scene = load(usualCamera +
                           "[settings]\n\"reflection.scale\" = 1\nreflection.samples = 4.5\n\n"
                           "view = { wireframe = true, tone_map = 'aces' }\nview2.clear_color = [1, 0.5, 0]\n"
                           "[settings.quality]\nshadow = 2\n");
  ASSERT_EQ(scene.settings.size(), 6u);
  const auto is = [&](size_t i, const std::string& key, int line, const std::string& value) {
    EXPECT_EQ(scene.settings[i].key, key);
    EXPECT_EQ(scene.settings[i].line, line);
    EXPECT_EQ(scene.settings[i].value, value);
    EXPECT_EQ(scene.settings[i].quoted, key == "view.tone_map");
  };
  is(0, "reflection.scale", 5, "1");
  is(1, "reflection.samples", 6, "4.5");
  is(2, "view.tone_map", 8, "aces");
  is(3, "view.wireframe", 8, "true");
  is(4, "view2.clear_color", 9, "[1.0,0.5,0.0]");
  is(5, "quality.shadow", 11, "2");
}

TEST(SceneLoader, EachModelAndTextureIsLoadedOnce) {
  const TemporaryFolder folder;
  folder.write("models/a.obj", std::string("mtllib m.mtl\nusemtl m\n") + triangleObj);
  folder.write("models/b.obj", std::string("mtllib m.mtl\nusemtl m\n") + triangleObj);
  folder.write("models/m.mtl", "newmtl m\nmap_Kd t.png\n");
  writePng(folder / "models/t.png", Image8(2, 2));
  const Scene scene =
      loadScene(folder.write("scenes/s.toml", usualCamera + "[[object]]\nmodel = '../models/a.obj'\n"
                                                            "[[object]]\nmodel = '../models/b.obj'\n"
                                                            "[[object]]\nmodel = '../scenes/../models/a.obj'\n"));
  EXPECT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.objects[0].mesh, 0);
  EXPECT_EQ(scene.objects[1].mesh, 1);
  EXPECT_EQ(scene.objects[2].mesh, 0);
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.meshes[1].parts[0].material.diffuseTexture, 0);
}

TEST(SceneLoader, ManyModelsAreReadInShortTime) {
  constexpr int count = 4000;
  const TemporaryFolder folder;
  std::string text = usualCamera;
  for (int i = 0; i < count; ++i) {
    const std::string name = std::to_string(i) + ".obj";
    folder.write(name, triangleObj);
    text.append("[[object]]\nmodel = '").append(name).append("'\n");
  }
  const auto file = folder.write("scene.toml", text);
  const std::clock_t start = std::clock();
  EXPECT_EQ(loadScene(file).meshes.size(), count);
  EXPECT_LT(std::clock() - start, 5 * CLOCKS_PER_SEC);
}

}  // namespace
}  // namespace speculum
