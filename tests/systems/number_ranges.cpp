// Every number of a scene file, from 0 to beyond a float's range: refused by its key, or drawn as the tracer draws it.
#include <toml++/toml.h>

#include "image/picture_files.hpp"
#include "log_capture.hpp"
#include "made_pictures.hpp"
#include "picture_support.hpp"
#include "plan/frame_plan.hpp"
#include "sampling.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_fields.hpp"
#include "scene_text.hpp"
#include "settings/setting_fields.hpp"
#include "studio.hpp"
#include "truth_support.hpp"

namespace speculum::number_ranges {
namespace {

using namespace testing_support;

constexpr PictureSize size{48, 27};

// A scene with every key that takes numbers.
const char* const everyNumber = R"([environment] background = [0.2, 0.3, 0.4]
  sky = { zenith = [0.2, 0.3, 0.8], horizon = [0.7, 0.7, 0.6], ground = [0.2, 0.2, 0.1] }
  ambient = [0.1, 0.1, 0.1]
[camera] position = [0.1, 1.2, 4.0], target = [0.2, 0.8, 0.1], up = [0.1, 1.0, 0.2], vertical_fov = 50.0
  near = 0.001, orbit_speed = 3.0
[[object]] model = "MODELS/sphere.obj", position = [-0.5, 0.9, 0.2], rotation = [10.0, 20.0, 30.0]
  scale = [0.5, 0.6, 0.7], spin = [5.0, 6.0, 7.0], color = [0.7, 0.3, 0.2], specular = [0.3, 0.3, 0.3]
  shininess = 30.0, emission = [0.05, 0.0, 0.0], copies = { count = 2, step = [0.3, 0.1, 0.2] }
[[object]] model = "MODELS/sphere.obj", position = [0.9, 0.6, 0.4], scale = 0.4
  mirror = { reflectance = [0.9, 0.8, 0.7], base_color = [0.1, 0.1, 0.2] }
[[light]] position = [1.0, 3.0, 2.0], color = [1.0, 0.9, 0.8], intensity = 8.0, radius = 0.2, glow = 1.0
  orbit = { center = [0.1, 2.0, 0.2], axis = [0.1, 1.0, 0.1], speed = 4.0 }
[[mirror]] position = [0.1, 0.0, -0.2], rotation = [-90.0, 2.0, 3.0], size = [4.0, 3.0], spin = [0.1, 0.2, 0.3]
  reflectance = [0.8, 0.7, 0.9], base_color = [0.1, 0.2, 0.1], back_color = [0.1, 0.1, 0.1], roughness = 0.0
[[mirror]] polygon = [[-2.0, 0.0, -2.0], [2.0, 0.0, -2.0], [2.0, 2.5, -2.0], [-2.0, 2.5, -2.0]]
  reflectance = [0.6, 0.6, 0.6], ripple = { amplitude = 0.002, wavelength = 0.5, speed = 0.2 }
[[bookmark]] name = "side", position = [2.0, 1.0, 2.0], target = [0.0, 1.0, 0.0], up = [0.0, 1.0, 0.0]
  vertical_fov = 40.0
)";

const double values[] = {0.0,   -0.0, 1e-300, -1e-300, 1e-45,  -1e-45,  1e-30,    -1e-30,    1e-12,
                         1e9,   -1e9, 1e15,   1e20,    -1e20,  1e30,    -1e30,    1e36,      1e38,
                         -1e38, 1e39, -1e39,  1e300,   -1e300, 1.7e308, INFINITY, -INFINITY, NAN};

// Calls `visit` with the path of each number below the node; of an array, with the first unless `all`.
void forEachNumber(toml::node& node, const std::string& path, bool all,
                   const std::function<void(toml::node&, const std::string&)>& visit) {
  if (node.is_number()) {
    visit(node, path);
  } else if (toml::table* table = node.as_table()) {
    for (auto&& [key, value] : *table) {
      forEachNumber(value, path + (path.empty() ? "" : ".") + std::string(key.str()), all, visit);
    }
  } else if (toml::array* array = node.as_array()) {
    const size_t count = all || array->is_array_of_tables() ? array->size() : std::min<size_t>(array->size(), 1);
    for (size_t i = 0; i < count; ++i) {
      forEachNumber((*array)[i], path + "[" + std::to_string(i) + "]", all, visit);
    }
  }
}

// Draws scenes that differ in numbers only, one after the other.
class NumberRanges : public testing::Test {
 protected:
  Image8 draw(const Scene& scene, double time) {
    studio_.show(scene);
    studio_.time = time;
    studio_.settings = settingsOf(scene);
    studio_.settings.view.samples = studio_.settings.reflection.samples = 1;
    studio_.settings.reflection.maxDepth = 2;
    studio_.settings.debug.checkFinite = true;
    return studio_.fresh();
  }

  std::filesystem::path file_ = writeScene("numbers", everyNumber);
  Studio studio_{headless(file_, size)};
};

TEST_F(NumberRanges, NumbersAreRefusedByKeyOrDrawn) {
  toml::table root = toml::parse_file(file_.string());
  int drawn = 0;
  size_t key = 0;
  forEachNumber(root, "", fullTests(), [&](toml::node& node, const std::string& path) {
    const double value = node.value<double>().value();
    ++key;
    for (size_t i = 0; i < std::size(values); ++i) {
      const double other = values[i];
      const bool always =
          std::abs(other) == 1e-300 || other == 1e39;  // small and large as a double, 0 and infinite as a float
      if (!fullTests() && !always && (i + key) % 7 != 0) {
        continue;
      }
      node.is_integer() ? void(node.as_integer()->get() = static_cast<int64_t>(std::clamp(other, -1e18, 1e18)))
                        : void(node.as_floating_point()->get() = other);
      std::stringstream text;
      text << toml::toml_formatter(root);
      const std::filesystem::path file = writeScene("varied", text.str());
      const std::string what = path + " = " + testing_support::text(other);
      std::optional<Scene> scene;
      try {
        scene = loadScene(file);
      } catch (const InputError& error) {
        EXPECT_FALSE(contains(std::string(error.what()), "\n")) << what;
        const std::string key = path.substr(path.rfind('.') + 1);
        EXPECT_TRUE(contains(std::string(error.what()), key.substr(0, key.find('[')))) << what << ": " << error.what();
        continue;
      }
      ++drawn;
      const double time = 1.5;
      const Image8 picture = draw(*scene, time);
      const PictureAgreement agreement = difference(picture, trace(file, size, 2, time).picture, 3);
      EXPECT_LE(agreement.share(), 0.03) << what << ": " << agreement.over << " pixels, up to " << agreement.largest;
    }
    node.is_integer() ? void(node.as_integer()->get() = static_cast<int64_t>(value))
                      : void(node.as_floating_point()->get() = value);
  });
  EXPECT_GE(drawn, 70);
}

TEST_F(NumberRanges, SettingsAreRefusedByKeyOrDrawn) {
  const Scene scene = loadScene(file_);
  int drawn = 0;
  for (const SettingField& field : settingFields()) {
    for (const char* value : {"0", "-0", "-1", "2", "0.3", "1e-300", "1e-45", "1e30", "1e39", "1e300", "nan", "-inf"}) {
      const std::string what = std::string(field.key) + " = " + value;
      Settings settings = settingsOf(scene);
      if (const std::optional<std::string> refused = setSetting(settings, field.key, value)) {
        EXPECT_TRUE(contains(*refused, std::string(field.key)) && !contains(*refused, "\n"))
            << what << ": " << *refused;
        continue;
      }
      ++drawn;
      studio_.show(scene);
      studio_.settings = settings;
      studio_.settings.debug.checkFinite = true;
      const uint64_t before = studio_.sceneRenderer.finiteWatch().count();
      studio_.fresh();
      EXPECT_EQ(studio_.sceneRenderer.finiteWatch().count(), before) << what;
    }
  }
  EXPECT_GE(drawn, 50);
}

// Draws the scene in metres, then in each other unit; a `share` of the pixels may differ by more than `tolerance`.
void expectOnePicture(const std::function<std::filesystem::path(double)>& sceneIn, std::initializer_list<double> units,
                      int tolerance, double share) {
  Studio studio(headless(sceneIn(1.0), size));
  const Image8 usual = studio.draw();
  for (const double metres : units) {
    studio.show(loadScene(sceneIn(metres)));
    const PictureAgreement agreement = difference(studio.fresh(), usual, tolerance);
    EXPECT_LE(agreement.share(), share) << metres << " m: " << agreement.over << " pixels, up to " << agreement.largest;
  }
}

// One scene in units of other lengths. Of a small unit, squares and products of lengths leave the range of floats,
// which devices flush to zero.
TEST(ScenesOfAnySize, ShowOnePicture) {
  const auto sceneIn = [](double metres) {
    const auto at = [&](double x, double y, double z) { return text(metres * glm::dvec3(x, y, z)); };
    return writeScene(
        "any_size",
        "[environment]\nambient = [0.1, 0.1, 0.1]\n[camera]\nposition = " + at(0.4, 1.2, 4) + "\ntarget = " +
            at(0.2, 0.8, 0.1) + "\n[[object]]\nmodel = 'MODELS/sphere.obj'\nposition = " + at(-0.5, 0.9, 0.2) +
            "\nscale = " + at(0.5, 0.6, 0.7) + "\nspecular = [0.3, 0.3, 0.3]" +
            "\n[[object]]\nmodel = 'MODELS/box.obj'\nposition = " + at(1.1, 0, 0.9) + "\nscale = " + text(metres) +
            "\nrotation = [0, 30, 0]\n[[light]]\nposition = " + at(1, 3, 2) +
            "\ncasts_shadow = true\nradius = " + text(0.2 * metres) + "\nintensity = " + text(12.0 * metres * metres) +
            "\n[[mirror]]\nposition = " + at(0, 0, -0.2) +
            "\nrotation = [-90, 2, 3]\nbase_color = [0.1, 0.2, 0.1]\nreflectance = [0.8, 0.7, 0.9]\nsize = [" +
            text(4.0 * metres) + ", " + text(3.0 * metres) + "]\n");
  };
  expectOnePicture(sceneIn, {1e-18, 1e-16, 1e-14, 1e-10, 1e-5, 1e5, 1e10, 1e14}, 2, 0.01);
}

// In large units half floats cannot tell a mirror's distance from that of what it reflects, which is far beyond it.
TEST(ScenesOfAnySize, BlurAlikeWhatIsFar) {
  const auto sceneIn = [](double metres) {
    const auto at = [&](double x, double y, double z) { return text(metres * glm::dvec3(x, y, z)); };
    return writeScene("any_size_rough",
                      "[environment]\nbackground = [0.1, 0.1, 0.1]\nambient = [1, 1, 1]\n[camera]\nposition = " +
                          at(0, 1, 2) + "\ntarget = [0, 0, 0]\n[settings]\n\"effects.rough_lookup\" = \"image\"\n" +
                          "[[object]]\nmodel = 'MODELS/sphere.obj'\nposition = " + at(-50, 180, -260) +
                          "\nscale = " + text(80.0 * metres) + "\ncolor = [0.9, 0.2, 0.1]\n" +
                          "[[object]]\nmodel = 'MODELS/sphere.obj'\nposition = " + at(60, 130, -280) +
                          "\nscale = " + text(60.0 * metres) + "\ncolor = [0.1, 0.4, 0.9]\n" +
                          "[[mirror]]\nrotation = [-90, 0, 0]\nroughness = 0.3\nsize = [" + text(8.0 * metres) + ", " +
                          text(8.0 * metres) + "]\n");
  };
  expectOnePicture(sceneIn, {1e6, 1e7, 1e12}, 8, 0.02);
}

TEST(LargeTextures, AreDrawnSmaller) {
  for (const bool wide : {true, false}) {
    writePng(sceneDirectory() / "wide.png", madePicture(wide ? 20'000 : 2, wide ? 2 : 20'000, [&](int x, int y) {
               const int along = wide ? x : y;
               return glm::ivec4(128 + 100 * std::sin(along * 0.001), 90, along / 100, 255);
             }));
    std::ofstream(sceneDirectory() / "wide.mtl") << "newmtl a\nmap_Kd wide.png\n";
    writeModel("wide.obj",
               "mtllib wide.mtl\nusemtl a\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    const auto file = writeScene("wide",
                                 "[environment]\nambient = [1, 1, 1]\n[camera]\nposition = [0, 0, 2]\n"
                                 "target = [0, 0, 0]\n[[object]]\nmodel = 'wide.obj'\n");
    const LogCapture log;
    expectTruth(file, {64, 36}, 1, trace(file, {64, 36}, 1));
    EXPECT_TRUE(contains(log.text(), "wide.png")) << log.text();
  }
}

// A model's lengths and its object's scale may leave the range of floats, their products may not.
TEST(ModelsOfAnySize, ShowOnePicture) {
  const auto sceneIn = [](double metres) {
    std::string corners;
    for (const glm::dvec3& corner : {glm::dvec3(-1, -1, 0), glm::dvec3(1, -1, 0.5), glm::dvec3(0, 1, 0)}) {
      const glm::dvec3 p = metres * corner;
      corners += "v " + text(p.x) + " " + text(p.y) + " " + text(p.z) + "\n";
    }
    writeModel("scaled.obj", corners + "f 1 2 3\n");
    return writeScene("scaled", "[environment]\nambient = [0.3, 0.3, 0.3]\n" + cameraText({0, 0, 3}, {0, 0, 0}) +
                                    "[[light]]\nposition = [1, 2, 3]\nintensity = 10\n" +
                                    objectText("scaled.obj", {0, 0, 0}, {0, 20, 0}, 1.0 / metres, {0.9, 0.5, 0.2}) +
                                    "[[mirror]]\n" + rectangleText({0, 0, -1}, {0, 10, 0}, 5, 5));
  };
  const Image8 usual = Studio(headless(sceneIn(1.0), size)).draw();
  for (const double metres : {1e-40, 1e-30, 1e-10, 1e10, 1e30, 1e40}) {
    const Image8 picture = Studio(headless(sceneIn(metres), size)).draw();
    EXPECT_LE(difference(picture, usual, 2).share(), 0.002) << metres;
  }
}

// The eye is at a vertex, or nearer to it than the precision of floats.
TEST(EyeAtAVertex, FillsNothing) {
  writeModel("cube.obj",
             "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
             "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 1 5 8 4\n");
  Random random(4);
  for (int i = 0; i < 24; ++i) {
    const glm::dvec3 corner(random.chance(0.5) ? 1 : -1, random.chance(0.5) ? 1 : -1, random.chance(0.5) ? 1 : -1);
    const glm::dvec3 position = i % 3 == 0 ? glm::dvec3(0.0) : random.inBox(3.0);
    const double offset = i % 4 == 0 ? 0.0 : i % 4 == 1 ? 1e-12 : i % 4 == 2 ? 1e-8 : 1e-5;
    const glm::dvec3 eye = position + 0.7 * corner + offset * glm::normalize(corner);
    const std::string objects = "[environment]\nbackground = [0.2, 0.4, 0.6]\nambient = [1, 1, 1]\n" +
                                objectText("cube.obj", position, {0, 0, 0}, 0.7, {1, 0, 0}) +
                                objectText("cube.obj", position + 2.0 * corner, {20, 30, 40}, 0.5, {0, 1, 0});
    // In the second half the eye's image in a mirror is at the vertex, and the cube is behind that mirror.
    const bool mirrored = i >= 12;
    const glm::dvec3 seenFrom(eye.x, eye.y, eye.z + 8.0);
    const auto file =
        writeScene("corner" + std::to_string(i),
                   objects + (mirrored ? cameraText(seenFrom, seenFrom + glm::dvec3(0.1, 0.2, -1.0)) + "[[mirror]]\n" +
                                             rectangleText({eye.x, eye.y, eye.z + 4.0}, {0, 0, 0}, 6, 6)
                                       : cameraText(eye, eye + random.direction())));
    const Truth truth = trace(file, {64, 36}, 1);
    const PictureAgreement agreement = difference(draw(truthOptions(file, {64, 36}, 1)), truth.picture, 2);
    EXPECT_LE(agreement.share(), 0.02) << i << ": " << agreement.over << " pixels";
  }
}

}  // namespace
}  // namespace speculum::number_ranges
