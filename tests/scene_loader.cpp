#include <gtest/gtest.h>

#include "image/image.hpp"
#include "image/picture_files.hpp"
#include "scene/scene_state.hpp"
#include "scene_support.hpp"

namespace speculum {
namespace {

Scene load(const std::string& text) {
  const TemporaryFolder folder;
  folder.write("triangle.obj", kTriangleObj);
  return loadScene(folder.write("scene.toml", text));
}

TEST(SceneDefaults, OfFileAndCamera) {
  const Scene scene = load(kCamera);
  EXPECT_EQ(scene.title, "");
  EXPECT_EQ(scene.environment.background, glm::dvec3(0.0));
  EXPECT_EQ(scene.environment.ambient, glm::dvec3(0.0));
  EXPECT_FALSE(scene.environment.sky);
  EXPECT_EQ(scene.camera.position, glm::dvec3(0, 0, 4));
  EXPECT_EQ(scene.camera.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(scene.camera.verticalFov, 60.0);
  EXPECT_EQ(scene.camera.near, 0.001);
  EXPECT_EQ(scene.camera.orbitSpeed, 0.0);
  EXPECT_TRUE(scene.settings.empty());
  EXPECT_TRUE(scene.objects.empty() && scene.lights.empty() && scene.mirrors.empty() && scene.meshes.empty());
}

TEST(SceneDefaults, OfObject) {
  const Scene scene = load(kCamera + "[[object]]\nmodel = 'triangle.obj'\n");
  ASSERT_EQ(scene.objects.size(), 1u);
  const Object& object = scene.objects[0];
  EXPECT_EQ(object.name, "");
  EXPECT_EQ(object.mesh, 0);
  EXPECT_EQ(object.position, glm::dvec3(0.0));
  EXPECT_EQ(object.rotation, glm::dvec3(0.0));
  EXPECT_EQ(object.scale, glm::dvec3(1.0));
  EXPECT_EQ(object.spin, glm::dvec3(0.0));
  EXPECT_FALSE(object.color || object.specular || object.shininess);
  EXPECT_EQ(object.copies.count, 1);
  EXPECT_EQ(object.copies.step, glm::dvec3(0.0));
}

TEST(SceneDefaults, OfLight) {
  const Scene scene = load(kCamera + "[[light]]\nposition = [1, 2, 3]\n");
  ASSERT_EQ(scene.lights.size(), 1u);
  const PointLight& light = scene.lights[0];
  EXPECT_EQ(light.position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(light.color, glm::dvec3(1.0));
  EXPECT_EQ(light.intensity, 1.0);
  EXPECT_EQ(light.radius, 0.05);
  EXPECT_EQ(light.glow, 1.0);
  EXPECT_FALSE(light.castsShadow);
  EXPECT_FALSE(light.orbit);
}

TEST(SceneDefaults, OfOrbitAndRipple) {
  const Scene scene = load(kCamera +
                           "[[light]]\nposition = [1, 2, 3]\norbit = {}\n"
                           "[[mirror]]\nsize = [1, 1]\nripple = { amplitude = 0.01 }\n"
                           "[[mirror]]\nsize = [1, 1]\nripple = { wavelength = 0.1 }\n");
  ASSERT_TRUE(scene.lights[0].orbit);
  EXPECT_EQ(scene.lights[0].orbit->center, glm::dvec3(0.0));
  EXPECT_EQ(scene.lights[0].orbit->axis, glm::dvec3(0, 1, 0));
  EXPECT_EQ(scene.lights[0].orbit->speed, 0.0);
  ASSERT_TRUE(scene.mirrors[0].ripple);
  EXPECT_EQ(scene.mirrors[0].ripple->wavelength, 0.5);
  EXPECT_EQ(scene.mirrors[0].ripple->speed, 0.2);
  EXPECT_FALSE(scene.mirrors[1].ripple) << "an amplitude of 0 is no ripple";
}

TEST(SceneDefaults, OfMirror) {
  const Scene scene = load(kCamera + "[[mirror]]\nsize = [2, 1.5]\n");
  ASSERT_EQ(scene.mirrors.size(), 1u);
  const Mirror& mirror = scene.mirrors[0];
  EXPECT_EQ(mirror.position, glm::dvec3(0.0));
  EXPECT_EQ(mirror.rotation, glm::dvec3(0.0));
  EXPECT_EQ(mirror.spin, glm::dvec3(0.0));
  EXPECT_EQ(mirror.size, glm::dvec2(2, 1.5));
  EXPECT_TRUE(mirror.polygon.empty());
  EXPECT_EQ(mirror.reflectance, glm::dvec3(0.95));
  EXPECT_EQ(mirror.fresnel, Fresnel::none);
  EXPECT_EQ(mirror.baseColor, glm::dvec3(0.0));
  EXPECT_EQ(mirror.roughness, 0.0);
  EXPECT_FALSE(mirror.ripple);
  EXPECT_FALSE(mirror.twoSided);
  EXPECT_EQ(mirror.backColor, glm::dvec3(0.1));
  EXPECT_FALSE(mirror.castsLight);
}

constexpr const char* kEverything = R"(title = "Gallery"
[environment]
background = [0.45, 0.55, 0.60]
sky = { zenith = [0.2, 0.4, 0.9], horizon = [0.8, 0.85, 0.9], ground = [0.3, 0.28, 0.25] }
ambient = [0.03, 0.04, 0.05]
[camera]
position = [0, 1.6, 4]
target = [0, 1, 0]
up = [0, 1, 1]
vertical_fov = 45
near = 0.01
orbit_speed = -3
[[object]]
name = "knot"
model = "triangle.obj"
position = [0, 1, 0]
rotation = [0, 30, 0]
scale = [-1, 2, 3.5]
spin = [0, 20, 0]
color = [0.8, 0.2, 0.1]
specular = [0.04, 0.05, 0.06]
shininess = 0.5
copies = { count = 100, step = [1, 0, 0] }
[[light]]
name = "key"
position = [1, 2, 1]
color = [1, 0.9, 0.8]
intensity = 8
radius = 0.1
glow = 0
casts_shadow = true
orbit = { center = [0, 2, 0], axis = [0, 0, 1], speed = 20 }
[[mirror]]
name = "left"
position = [0, 1, -2]
rotation = [0, 90, 0]
spin = [0, 10, 0]
size = [2, 1.5]
reflectance = [0.9, 0.8, 0.7]
fresnel = "schlick"
base_color = [0.1, 0.2, 0.3]
roughness = 0.25
ripple = { amplitude = 0.02, wavelength = 0.4, speed = -0.1 }
two_sided = true
back_color = [0, 1, 2]
casts_light = true
[[mirror]]
polygon = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
)";

TEST(SceneLoader, ReadsEnvironmentAndCamera) {
  const Scene scene = load(kEverything);
  EXPECT_EQ(scene.title, "Gallery");
  EXPECT_EQ(scene.environment.background, glm::dvec3(0.45, 0.55, 0.60));
  EXPECT_EQ(scene.environment.ambient, glm::dvec3(0.03, 0.04, 0.05));
  ASSERT_TRUE(scene.environment.sky);
  EXPECT_EQ(scene.environment.sky->zenith, glm::dvec3(0.2, 0.4, 0.9));
  EXPECT_EQ(scene.environment.sky->horizon, glm::dvec3(0.8, 0.85, 0.9));
  EXPECT_EQ(scene.environment.sky->ground, glm::dvec3(0.3, 0.28, 0.25));
  EXPECT_EQ(scene.camera.target, glm::dvec3(0, 1, 0));
  EXPECT_EQ(scene.camera.up, glm::dvec3(0, 1, 1));
  EXPECT_EQ(scene.camera.verticalFov, 45.0);
  EXPECT_EQ(scene.camera.near, 0.01);
  EXPECT_EQ(scene.camera.orbitSpeed, -3.0);
}

TEST(SceneLoader, ReadsObject) {
  const Object object = load(kEverything).objects.at(0);
  EXPECT_EQ(object.name, "knot");
  EXPECT_EQ(object.position, glm::dvec3(0, 1, 0));
  EXPECT_EQ(object.rotation, glm::dvec3(0, 30, 0));
  EXPECT_EQ(object.scale, glm::dvec3(-1, 2, 3.5));
  EXPECT_EQ(object.spin, glm::dvec3(0, 20, 0));
  EXPECT_EQ(object.color, glm::dvec3(0.8, 0.2, 0.1));
  EXPECT_EQ(object.specular, glm::dvec3(0.04, 0.05, 0.06));
  EXPECT_EQ(object.shininess, 1.0) << "below 1 counts as 1";
  EXPECT_EQ(object.copies.count, 100);
  EXPECT_EQ(object.copies.step, glm::dvec3(1, 0, 0));
}

TEST(SceneLoader, ReadsLight) {
  const PointLight light = load(kEverything).lights.at(0);
  EXPECT_EQ(light.name, "key");
  EXPECT_EQ(light.color, glm::dvec3(1, 0.9, 0.8));
  EXPECT_EQ(light.intensity, 8.0);
  EXPECT_EQ(light.radius, 0.1);
  EXPECT_EQ(light.glow, 0.0);
  EXPECT_TRUE(light.castsShadow);
  ASSERT_TRUE(light.orbit);
  EXPECT_EQ(light.orbit->center, glm::dvec3(0, 2, 0));
  EXPECT_EQ(light.orbit->axis, glm::dvec3(0, 0, 1));
  EXPECT_EQ(light.orbit->speed, 20.0);
}

TEST(SceneLoader, ReadsMirrors) {
  const Scene scene = load(kEverything);
  ASSERT_EQ(scene.mirrors.size(), 2u);
  const Mirror& mirror = scene.mirrors[0];
  EXPECT_EQ(mirror.name, "left");
  EXPECT_EQ(mirror.position, glm::dvec3(0, 1, -2));
  EXPECT_EQ(mirror.rotation, glm::dvec3(0, 90, 0));
  EXPECT_EQ(mirror.spin, glm::dvec3(0, 10, 0));
  EXPECT_EQ(mirror.reflectance, glm::dvec3(0.9, 0.8, 0.7));
  EXPECT_EQ(mirror.fresnel, Fresnel::schlick);
  EXPECT_EQ(mirror.baseColor, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(mirror.roughness, 0.25);
  ASSERT_TRUE(mirror.ripple);
  EXPECT_EQ(mirror.ripple->amplitude, 0.02);
  EXPECT_EQ(mirror.ripple->wavelength, 0.4);
  EXPECT_EQ(mirror.ripple->speed, -0.1);
  EXPECT_TRUE(mirror.twoSided);
  EXPECT_EQ(mirror.backColor, glm::dvec3(0, 1, 2));
  EXPECT_TRUE(mirror.castsLight);
  EXPECT_EQ(scene.mirrors[1].polygon, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(SceneLoader, ReadsBookmarks) {
  const Scene scene = load(
      "[camera]\nposition = [0, 0, 4]\ntarget = [0, 0, 0]\nup = [0, 2, 0]\nvertical_fov = 40\n"
      "[[bookmark]]\nname = 'door'\nposition = [1, 2, 3]\ntarget = [0, 2, 0]\n"
      "[[bookmark]]\nname = 'Tür'\nposition = [1, 9, 1]\ntarget = [1, 0, 1]\nup = [0, 0, -1]\n"
      "vertical_fov = 90\n");
  ASSERT_EQ(scene.bookmarks.size(), 2u);
  EXPECT_EQ(scene.bookmarks[1].name, "Tür");
  const CameraSpec door = cameraOf(scene.bookmarks[0], scene.camera);
  EXPECT_EQ(door.position, glm::dvec3(1, 2, 3));
  EXPECT_EQ(door.target, glm::dvec3(0, 2, 0));
  EXPECT_EQ(door.up, glm::dvec3(0, 2, 0));
  EXPECT_EQ(door.verticalFov, 40.0);
  const CameraSpec above = cameraOf(scene.bookmarks[1], scene.camera);
  EXPECT_EQ(above.up, glm::dvec3(0, 0, -1));
  EXPECT_EQ(above.verticalFov, 90.0);
}

TEST(SceneLoader, OneScaleStandsForThree) {
  const Scene scene = load(kCamera + "[[object]]\nmodel = 'triangle.obj'\nscale = -2\n");
  EXPECT_EQ(scene.objects[0].scale, glm::dvec3(-2.0));
}

TEST(SceneLoader, NamesMayRepeat) {
  const Scene scene = load(kCamera + "[[mirror]]\nname = 'a'\nsize = [1, 1]\n[[mirror]]\nname = 'a'\nsize = [1, 1]\n");
  EXPECT_EQ(scene.mirrors.size(), 2u);
}

TEST(SceneLoader, SettingsAreFlattenedWithTheirLines) {
  const Scene scene = load(kCamera +
                           "[settings]\n\"reflection.scale\" = 1\nreflection.samples = 4.5\n\n"
                           "view = { wireframe = true, tone_map = 'aces' }\nview2.clear_color = [1, 0.5, 0]\n"
                           "[settings.quality]\nshadow = 2\n");
  ASSERT_EQ(scene.settings.size(), 6u);
  const auto is = [&](size_t i, const std::string& key, int line, const auto& value) {
    EXPECT_EQ(scene.settings[i].key, key);
    EXPECT_EQ(scene.settings[i].line, line);
    EXPECT_EQ(scene.settings[i].value, decltype(SettingEntry::value)(value));
  };
  is(0, "reflection.scale", 5, int64_t{1});
  is(1, "reflection.samples", 6, 4.5);
  is(2, "view.tone_map", 8, std::string("aces"));
  is(3, "view.wireframe", 8, true);
  is(4, "view2.clear_color", 9, std::vector<double>{1, 0.5, 0});
  is(5, "quality.shadow", 11, int64_t{2});
}

TEST(SceneLoader, EachModelAndTextureIsLoadedOnce) {
  const TemporaryFolder folder;
  folder.write("models/a.obj", std::string("mtllib m.mtl\nusemtl m\n") + kTriangleObj);
  folder.write("models/b.obj", std::string("mtllib m.mtl\nusemtl m\n") + kTriangleObj);
  folder.write("models/m.mtl", "newmtl m\nmap_Kd t.png\n");
  writePng(folder / "models/t.png", Image8(2, 2));
  const Scene scene =
      loadScene(folder.write("scenes/s.toml", kCamera + "[[object]]\nmodel = '../models/a.obj'\n"
                                                        "[[object]]\nmodel = '../models/b.obj'\n"
                                                        "[[object]]\nmodel = '../scenes/../models/a.obj'\n"));
  EXPECT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.objects[0].mesh, 0);
  EXPECT_EQ(scene.objects[1].mesh, 1);
  EXPECT_EQ(scene.objects[2].mesh, 0);
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.meshes[1].parts[0].material.diffuseTexture, 0);
}

}  // namespace
}  // namespace speculum
