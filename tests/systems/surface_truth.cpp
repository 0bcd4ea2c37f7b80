// What the files of models say about surfaces, drawn against the ray tracer.
#include <fstream>
#include <sstream>

#include "image/picture_files.hpp"
#include "made_pictures.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;

constexpr PictureSize size{160, 120};

// A column in two smoothing groups with vertex colors, before a planar and a curved mirror; its texture repeats up to
// `repeats` times.
std::filesystem::path columnScene(const std::string& name, double repeats, const std::string& rest) {
  writePng(sceneDirectory() / "checker.png",
           madePicture(8, 8, [](int x, int y) { return glm::ivec4(255, 255 * ((x + y) % 2), 60 * (x % 4), 255); }));
  std::ofstream(sceneDirectory() / (name + ".mtl")) << "newmtl m\nKd 0.9 0.8 0.7\nKs 0.2 0.2 0.2\nNs 40\n"
                                                       "map_Kd checker.png\n";
  std::ostringstream obj;
  obj << "mtllib " << name << ".mtl\nusemtl m\n";
  constexpr int sides = 9;
  for (int i = 0; i < sides; ++i) {
    const double a = glm::radians(360.0) * i / sides;
    for (const double y : {-0.8, 0.8}) {
      obj << "v " << 0.5 * std::cos(a) << ' ' << y << ' ' << 0.5 * std::sin(a) << ' ' << 0.5 + 0.5 * std::cos(3 * a)
          << ' ' << 0.5 + 0.5 * y << ' ' << (i % 2) << "\nvt " << repeats * i / sides << ' ' << y << '\n';
    }
  }
  for (int i = 0; i < sides; ++i) {
    const auto corner = [&](int at) { return ' ' + std::to_string(at + 1) + '/' + std::to_string(at + 1); };
    const int next = (i + 1) % sides;
    obj << "s " << 1 + i / 5 << "\nf" << corner(2 * i) << corner(2 * i + 1) << corner(2 * next + 1) << corner(2 * next)
        << '\n';
  }
  writeModel(name + ".obj", obj.str());
  return writeScene(name, R"([environment] background = [0.2, 0.3, 0.4], ambient = [0.3, 0.3, 0.3]
[camera] position = [0.3, 0.6, 3], target = [0, 0.2, 0]
[[object]] model = ")" + name +
                              R"(.obj", rotation = [10, 20, 30], scale = [1, -1, 1.2]
[[mirror]] position = [0, 0, -1.2], size = [4, 3]
[[mirror]] position = [0, -1, 0], rotation = [-90, 0, 0], size = [4, 3]
)" + rest);
}

const std::string lamp = "[[light]] position = [1.5, 2, 2], intensity = 8\n";
const std::string shadowLamp = "[[light]] position = [1.5, 2, 2], intensity = 8, casts_shadow = true\n";
const std::string ball =
    "[[object]] model = \"MODELS/sphere.obj\", position = [-1.1, 0.3, 0.4], scale = 0.5, mirror = {}\n";

TEST(SmoothedAndColored, EqualTheTracer) {
  const std::vector<std::filesystem::path> files{
      columnScene("column_plain", 2, lamp), columnScene("column_shadows", 2, shadowLamp),
      columnScene("column_ball", 2, lamp + ball), columnScene("column_repeats", 400, lamp),
      columnScene("column_repeats_ball", 400, shadowLamp + ball)};
  for (const std::filesystem::path& file : files) {
    expectTruth(file, size, 3, trace(file, size, 3));
  }
}

TEST(SmoothedAndColored, ShadowMapsKeepTheColors) {
  for (const double repeats : {2.0, 400.0}) {
    const std::filesystem::path file = columnScene("column_maps", repeats, shadowLamp);
    Options options = truthOptions(file, size, 3);
    const Image8 traced = draw(options);
    options.settings.push_back({"effects.shadow_lookup", "map"});
    EXPECT_LT(difference(draw(options), traced, 2).share(), 0.03) << repeats;
  }
}

}  // namespace
}  // namespace speculum
