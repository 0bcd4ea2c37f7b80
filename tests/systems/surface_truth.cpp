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

// A panel with a ring, two squares and a triangle as mirrors, and a smooth ball, turned about and inside out.
std::filesystem::path dressingTable(const std::string& name, const std::string& keys, const std::string& rest) {
  std::ofstream(sceneDirectory() / "dressing.mtl")
      << "newmtl wood\nKd 0.6 0.4 0.2\nnewmtl mirror\nKd 0.3 0.3 0.2\nKs 0.8 0.9 0.7\nNs 1000\nillum 3\n";
  std::ostringstream obj;
  obj << "mtllib dressing.mtl\nv -2 -1 0\nv 1 -1 0\nv 1 2 0\nv -2 2 0\nv -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\n"
         "v 1.2 -1 0\nv 1.9 -1 0\nv 1.9 0 0\nv 1.2 0 0\nv 1.2 0.5 0.2\nv 2.2 0.5 0.9\nv 1.2 1.9 0.2\n"
         "v -2 -1.2 0\nv 2 -1.2 0\nv 2 -1.2 2\nv -2 -1.2 2\nusemtl mirror\n"
         "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 9 10 11 12\nf 13 14 15\nusemtl wood\nf 19 18 17 16\n"
         "usemtl mirror\ns 1\n";
  constexpr int sides = 12;
  for (int i = 0; i < sides; ++i) {
    for (int j = 0; j <= sides / 2; ++j) {
      const double a = glm::radians(360.0) * i / sides;
      const double b = glm::radians(360.0) * j / sides;
      obj << "v " << -0.5 + 0.45 * std::sin(b) * std::cos(a) << ' ' << -0.6 + 0.45 * std::cos(b) << ' '
          << 1.2 + 0.45 * std::sin(b) * std::sin(a) << '\n';
    }
  }
  constexpr int rows = sides / 2 + 1;
  for (int i = 0; i < sides; ++i) {
    for (int j = 0; j + 1 < rows; ++j) {
      const auto corner = [&](int x, int y) { return " " + std::to_string(20 + x % sides * rows + y); };
      obj << "f" << corner(i, j) << corner(i + 1, j) << corner(i + 1, j + 1) << corner(i, j + 1) << '\n';
    }
  }
  writeModel("dressing.obj", obj.str());
  return writeScene(name, R"([environment] background = [0.2, 0.3, 0.4], ambient = [0.3, 0.3, 0.3]
[camera] position = [0.4, 0.9, 5], target = [0, 0.3, 0]
[[object]] model = "dressing.obj", )" +
                              keys + R"(
[[object]] model = "MODELS/teapot.obj", position = [1, -0.6, 1.6], scale = 0.5
[[object]] model = "MODELS/box.obj", position = [-0.5, 0.5, -0.8], scale = 0.4, color = [0.2, 0.7, 0.3]
[[mirror]] position = [0, 0.5, 7], rotation = [0, 180, 0], size = [6, 5]
)" + rest);
}

TEST(MirrorsFromMaterials, EqualTheTracer) {
  const std::vector<std::filesystem::path> files{
      dressingTable("dressing", "rotation = [0, 5, 0]", lamp),
      dressingTable("dressing_shadows", "rotation = [0, 5, 0], scale = [-1, 1, 1]", shadowLamp),
      dressingTable("dressing_behind", "rotation = [0, 165, 0]", shadowLamp),
      dressingTable("dressing_copies", "scale = 0.5, copies = { count = 2, step = [1.2, 0.4, -0.6] }", lamp),
      dressingTable("dressing_eye", "visible = \"eye\"", lamp),
      dressingTable("dressing_rays", "rotation = [0, 5, 0]",
                    shadowLamp + "[settings]\n\"reflection.method\" = \"rays\"\n")};
  for (const std::filesystem::path& file : files) {
    expectTruth(file, size, 3, trace(file, size, 3));
  }
}

TEST(MirrorsFromMaterials, PiecesOfOnePlaneShareAnImage) {
  const std::filesystem::path file = dressingTable("dressing_passes", "rotation = [0, 5, 0]", "");
  Studio studio(truthOptions(file, size, 1));
  studio.draw();
  EXPECT_EQ(studio.plan.drawnMirrors().size(), 2u) << "ring and square in one plane, and the triangle";
}

}  // namespace
}  // namespace speculum
