// What the files of models say about surfaces, drawn against the ray tracer.
#include <fstream>
#include <sstream>

#include "image/picture_files.hpp"
#include "made_gltf.hpp"
#include "made_pictures.hpp"
#include "random.hpp"
#include "sampling.hpp"
#include "scene_text.hpp"
#include "truth_support.hpp"

namespace speculum {
namespace {

using namespace testing_support;
using nlohmann::json;

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

TEST(SmoothedAndColored, FollowsAnotherMesh) {
  columnScene("column_second", 2, lamp);
  const std::filesystem::path file = writeScene("second", R"([environment] ambient = [0.3, 0.3, 0.3]
[camera] position = [0.3, 0.6, 3], target = [0, 0.2, 0]
[[object]] model = "MODELS/sphere.obj", position = [-1.1, 0.3, 0.4], scale = 0.5
[[object]] model = "column_second.obj"
)" + lamp);
  expectTruth(file, size, 3, trace(file, size, 3));
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

// Writes NAME.obj, a box about the origin with texture coordinates of 0 .. 1 on each side, and its material m.
std::string writeBox(const std::string& name, const glm::dvec3& half, const std::string& material) {
  std::ofstream(sceneDirectory() / (name + ".mtl")) << "newmtl m\n" << material;
  std::ostringstream obj;
  obj << "mtllib " << name << ".mtl\nusemtl m\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  for (int i = 0; i < 8; ++i) {
    obj << "v " << ((i & 1) != 0 ? half.x : -half.x) << ' ' << ((i & 2) != 0 ? half.y : -half.y) << ' '
        << ((i & 4) != 0 ? half.z : -half.z) << '\n';
  }
  obj << "f 5/1 6/2 8/3 7/4\nf 2/1 1/2 3/3 4/4\nf 6/1 2/2 4/3 8/4\nf 1/1 5/2 7/3 3/4\nf 7/1 8/2 4/3 3/4\n"
         "f 1/1 2/2 6/3 5/4\n";
  writeModel(name + ".obj", obj.str());
  return name + ".obj";
}

// A leaf with a smoothed outline: a cut-out. A veil: opacity from side to side. A mask without alpha of its own.
void writeOpacities() {
  const auto write = [](const char* name, const auto& color) {
    writePng(sceneDirectory() / name, madePicture(32, 32, color));
  };
  const auto radius = [](int x, int y) { return std::hypot(x - 15.5, y - 15.5); };
  write("leaf.png", [&](int x, int y) {
    return glm::ivec4(40 + 6 * x, 220, 60, std::clamp(static_cast<int>(255 * (13.0 - radius(x, y)) + 127), 0, 255));
  });
  write("veil.png", [](int x, int y) { return glm::ivec4(255, 8 * y, 255 - 8 * x, 8 * x); });
  const auto ring = [&](int x, int y) {
    return glm::ivec4(glm::ivec3(radius(x, y) < 6.0 || radius(x, y) > 12.0 ? 255 : 0), 255);
  };
  std::ofstream(sceneDirectory() / "mask.tga", std::ios::binary) << tgaFile(madePicture(32, 32, ring), 24, 0);
}

const std::string coverView = R"([environment] background = [0.2, 0.3, 0.4], ambient = [0.3, 0.3, 0.3]
[camera] position = [0.4, 0.7, 3.2], target = [0, 0.1, 0]
[[object]] model = "MODELS/torus_knot.obj", position = [0, 0.1, -0.9], scale = 0.4, color = [0.8, 0.3, 0.2]
[[mirror]] name = "back", position = [0, 0, -1.6], size = [5, 3]
[[mirror]] name = "floor", position = [0, -1, 0], rotation = [-90, 0, 0], size = [5, 4], base_color = [0.4, 0.4, 0.4]
)";

TEST(CutOuts, EqualTheTracer) {
  writeOpacities();
  const std::vector<std::string> materials{
      "map_Kd leaf.png\n", "Kd 0.7 0.6 0.2\nKs 0.3 0.3 0.3\nNs 30\nmap_d mask.tga\n",
      "map_Kd -clamp on -s 2 3 -o -0.5 -1 leaf.png\n", "map_Kd -s 30 30 leaf.png\nmap_d leaf.png\n"};
  for (size_t i = 0; i < materials.size(); ++i) {
    const std::string box = "[[object]] rotation = [10, 30, 0], model = \"" +
                            writeBox("cut" + std::to_string(i), {0.6, 0.5, 0.4}, materials[i]) + "\"\n";
    for (const std::string& light : {lamp, shadowLamp + ball}) {
      const std::filesystem::path file =
          writeScene("cut" + std::to_string(i) + (light == lamp ? "" : "_rays"), coverView + box + light);
      expectTruth(file, size, 3, trace(file, size, 3));
    }
  }
}

// Options for a floor in the shadow of a cut-out that stands above the view, from a map.
Options shadowOfALeaf() {
  writeOpacities();
  const std::string leaf = writeBox("leaf_above", {0.3, 0.02, 0.3}, "map_Kd leaf.png\n");
  const std::filesystem::path file = writeScene("leaf_above", R"([environment] ambient = [0.1, 0.1, 0.1]
[camera] position = [0, 1.2, 1.5], target = [0, 0, 0], vertical_fov = 50
[[object]] model = "MODELS/block.obj", position = [0, -0.2, 0], scale = [8, 0.2, 8]
[[object]] model = ")" + leaf + R"(", position = [0, 2, 0]
[[light]] position = [0.1, 4, 0], intensity = 20, glow = 0, casts_shadow = true
)");
  return headless(file, size, {{"effects.shadow_lookup", "map"}});
}

TEST(CutOuts, CastTheirShadowsFromOutOfView) {
  const Options options = shadowOfALeaf();
  QuietSession session(options);
  const Image8 mapped = draw(session);
  EXPECT_TRUE(session.lastFrame().plan.main().instances.size() == 1) << "the leaf is seen";
  set(session, {{"effects.shadow_lookup", "traced"}});
  const Image8 traced = draw(session);
  set(session, {{"effects.transparency", "false"}});
  const int opaque = difference(draw(session), traced, 8).over;
  EXPECT_GT(opaque, size.width * size.height / 50);
  EXPECT_LT(difference(mapped, traced, 8).over, opaque / 2);
}

TEST(CutOuts, ShadowMapsFollowTheSwitchOfTransparency) {
  Options options = shadowOfALeaf();
  QuietSession session(options);
  const Image8 cut = draw(session);
  set(session, {{"effects.transparency", "false"}});
  const Image8 opaque = draw(session);
  EXPECT_GT(difference(opaque, cut, 8).over, 0);
  set(options, {{"effects.transparency", "false"}});
  EXPECT_EQ(opaque.rgba, draw(options).rgba);
  set(session, {{"effects.transparency", "true"}});
  EXPECT_EQ(draw(session).rgba, cut.rgba);
}

// The mean of 64 pictures and the tracer's picture of 64 samples take the same points of each pixel.
double errorOfMean(const std::filesystem::path& file, PictureSize drawnSize, const SettingList& settings = {}) {
  Options options = truthOptions(file, drawnSize, 3);
  set(options, {{"view.accumulate", "64"}});
  set(options, settings);
  QuietSession session(options);
  Tracing tracing = tracingOf(file, drawnSize, 3);
  tracing.options.samples = 64;
  return rootMeanSquare(drawRadiance(session), tracing.result().image);
}

// Writes NAME.glb, a square of `columns` x `columns` fields in the plane z = 0 with the colors of their corners, row by
// row. `picture` lies on it unless it is empty.
std::string writePane(const std::string& name, int columns, float half, const std::vector<float>& colors, json material,
                      const std::string& picture) {
  MadeGltf made;
  std::vector<float> positions;
  std::vector<float> texcoords;
  std::vector<uint32_t> indices;
  for (int i = 0; i < (columns + 1) * (columns + 1); ++i) {
    const glm::ivec2 place(i % (columns + 1), i / (columns + 1));
    const glm::vec2 uv = glm::vec2(place) / static_cast<float>(columns);
    positions.insert(positions.end(), {half * (2.0f * uv.x - 1.0f), half * (2.0f * uv.y - 1.0f), 0.0f});
    texcoords.insert(texcoords.end(), {uv.x, uv.y});
    if (place.x < columns && place.y < columns) {
      const auto first = static_cast<uint32_t>(i);
      const auto above = static_cast<uint32_t>(i + columns + 1);
      indices.insert(indices.end(), {first, first + 1, above + 1, first, above + 1, above});
    }
  }
  json surface = material.value("pbrMetallicRoughness", json::object());
  surface["metallicFactor"] = 0;
  if (!picture.empty()) {
    made.add("images", {{"uri", picture}});
    made.add("textures", {{"source", 0}});
    surface["baseColorTexture"] = {{"index", 0}};
  }
  material["pbrMetallicRoughness"] = surface;
  made.add("materials", material);
  made.addMesh({{"POSITION", made.addNumbers(positions, "VEC3")},
                {"TEXCOORD_0", made.addNumbers(texcoords, "VEC2")},
                {"COLOR_0", made.addNumbers(colors, "VEC4")}},
               {{"indices", made.addNumbers(indices, "SCALAR")}, {"material", 0}});
  made.add("nodes", {{"mesh", 0}});
  writeModel(name + ".glb", made.binary());
  return name + ".glb";
}

TEST(Coverage, IsTheShareOfTheSurface) {
  const std::string wall = writeBox("wall", {5, 5, 1e-3}, "Kd 0 1 0\n");
  std::ofstream(sceneDirectory() / "flat.mtl") << "newmtl m\nKd 1 0 0\nd 0.25\n";
  writeModel("flat.obj", "mtllib flat.mtl\nusemtl m\nv -4 -4 0\nv 4 -4 0\nv 4 4 0\nv -4 4 0\nf 1 2 3 4\n");
  std::vector<float> red;
  for (int corner = 0; corner < 4; ++corner) {
    red.insert(red.end(), {1.0f, 0.0f, 0.0f, 0.5f});
  }
  const std::string ofVertices =
      writePane("flat", 1, 4.0f, red,
                {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.5}}}}}, "");
  // The panes lie so that no diagonal of theirs is seen. Triangles have random numbers of their own, of which the
  // pictures would use a part where two share a pixel, and that part is not spread evenly.
  const std::filesystem::path file = writeScene(
      "panes",
      "[environment] ambient = [1, 1, 1]\n[camera] position = [0, 0, 3], target = [0, 0, 0]\n[[object]] model = "
      "\"flat.obj\", position = [1.9, -1.9, 0]\n[[object]] model = \"" +
          ofVertices + "\", position = [1.9, -1.9, 0.2]\n[[object]] model = \"" + wall + "\", position = [0, 0, -1]\n");
  const Tracing tracing = tracingOf(file, {8, 8}, 3);
  const glm::vec3 traced = tracing.result().image.at(3, 3);
  EXPECT_NEAR(traced.r, 0.25 + 0.75 * 0.25, 1e-6);
  EXPECT_NEAR(traced.g, 0.75 * 0.75, 1e-6);
  for (const int samples : {1, 4}) {
    Options options = truthOptions(file, {8, 8}, 3);
    set(options, {{"view.accumulate", samples == 1 ? "64" : "15"}, {"view.samples", std::to_string(samples)}});
    QuietSession session(options);
    const LinearImage drawn = drawRadiance(session);
    glm::dvec3 mean(0.0);
    for (const glm::vec3& pixel : drawn.pixels) {
      mean += glm::dvec3(pixel) / 64.0;
      EXPECT_NEAR(pixel.r, traced.r, 0.1) << samples;
    }
    EXPECT_NEAR(mean.r, traced.r, 0.01) << samples;
    EXPECT_NEAR(mean.g, traced.g, 0.01) << samples;
  }
}

// A pane before a mirror, whose image covers the whole view, and another mirror behind the eye: what shows through the
// pane and through its images must not depend on each other.
TEST(Coverage, ShowsThroughItsOwnImages) {
  std::ofstream(sceneDirectory() / "pane.mtl") << "newmtl m\nKd 1 0 0\nd 0.5\n";
  writeModel("pane.obj", "mtllib pane.mtl\nusemtl m\nv -40 -40 0\nv 40 -40 0\nv 40 40 0\nv -40 40 0\nf 1 2 3 4\n");
  const std::filesystem::path file = writeScene(
      "pane",
      "[environment] ambient = [1, 1, 1], background = [0, 1, 0]\n[camera] position = [0, 0, 3], target = [0, 0, 0]\n"
      "[[object]] model = \"pane.obj\"\n[[mirror]] position = [0, 0, -1], size = [80, 80], reflectance = [1, 1, 1]\n"
      "[[mirror]] position = [0, 0, 4], rotation = [0, 180, 0], size = [80, 80], reflectance = [1, 1, 1]\n");
  const glm::vec3 traced = tracingOf(file, {8, 8}, 3).result().image.at(3, 3);
  for (const char* method : {"raster", "rays"}) {
    Options options = truthOptions(file, {8, 8}, 3);
    set(options, {{"view.accumulate", "64"}, {"reflection.method", method}});
    QuietSession session(options);
    double mean = 0.0;
    for (const glm::vec3& pixel : drawRadiance(session).pixels) {
      mean += pixel.g / 64.0;
    }
    EXPECT_NEAR(mean, traced.g, 0.01) << method;
  }
}

TEST(Coverage, CopiesInOnePlaceShowThroughEachOther) {
  std::ofstream(sceneDirectory() / "copied.mtl") << "newmtl m\nKd 1 0 0\nd 0.25\n";
  writeModel("copied.obj", "mtllib copied.mtl\nusemtl m\nv -4 -4 0\nv 5 -4 0\nv 4 4 0\nv -4 4 0\nf 1 2 3 4\n");
  const std::filesystem::path file =
      writeScene("copied",
                 "[environment] ambient = [1, 1, 1]\n[camera] position = [0, 0, 3], target = [0, 0, 0]\n"
                 "[[object]] model = \"copied.obj\", rotation = [10, 20, 0], copies = { count = 3 }\n");
  const double share = 1.0 - 0.75 * 0.75 * 0.75;
  EXPECT_NEAR(tracingOf(file, {8, 8}, 3).result().image.at(3, 3).r, share, 1e-6);
  Options options = truthOptions(file, {8, 8}, 3);
  set(options, {{"view.accumulate", "64"}});
  QuietSession session(options);
  double mean = 0.0;
  for (const glm::vec3& pixel : drawRadiance(session).pixels) {
    mean += pixel.r / 64.0;
  }
  EXPECT_NEAR(mean, share, 0.01);
}

// Rounding of what is interpolated or stored must not take away a surface whose alpha is the cutoff.
TEST(CutOuts, AreThereAtTheCutoff) {
  struct Case {
    float ofVertices;
    double ofMaterial;
    int ofTexture;
    double cutoff;
  };
  const std::vector<Case> cases{{0.5f, 1.0, 255, 0.5},
                                {0.3f, 1.0, 255, 0.3},
                                {1.0f, 0.3, 255, 0.3},
                                {1.0f, 1.0, 51, 0.2},
                                {1.0f, 1.0, 128, 128.0 / 255.0}};
  std::ostringstream out;
  out << coverView;
  for (size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const std::string name = "at_cutoff" + std::to_string(i);
    writePng(sceneDirectory() / (name + ".png"),
             madePicture(4, 4, [&](int, int) { return glm::ivec4(200, 200, 200, c.ofTexture); }));
    std::vector<float> colors;
    for (int corner = 0; corner < 16; ++corner) {
      colors.insert(colors.end(), {0.9f, 0.5f, 0.3f, c.ofVertices});
    }
    const json material{{"alphaMode", "MASK"},
                        {"alphaCutoff", c.cutoff},
                        {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, c.ofMaterial}}}}};
    out << "[[object]]\nmodel = \"" << writePane(name, 3, 0.3f, colors, material, name + ".png") << "\"\nposition = ["
        << 0.7 * static_cast<double>(i) - 1.4 << ", 0.3, 0.4]\nrotation = [13, 17, 5]\n";
  }
  for (const std::string& light : {lamp, shadowLamp + ball}) {
    const std::filesystem::path file = writeScene(light == lamp ? "cutoff" : "cutoff_rays", out.str() + light);
    expectTruth(file, size, 3, trace(file, size, 3));
  }
}

// Writes a square of 3 x 3 fields whose vertices have random colors and alpha.
std::string randomPane(const std::string& name, Random& random, const char* mode) {
  constexpr int columns = 3;
  std::vector<float> colors;
  for (int i = 0; i < (columns + 1) * (columns + 1); ++i) {
    for (int channel = 0; channel < 3; ++channel) {
      colors.push_back(static_cast<float>(random.uniform(0.2, 1)));
    }
    colors.push_back(static_cast<float>(random.chance(0.3) ? random.chance(0.5) : random.uniform(0, 1)));
  }
  const auto half = static_cast<float>(random.uniform(0.4, 0.8));
  const double cutoff = random.uniform(0.2, 0.6);
  const bool textured = random.chance(0.5);
  return writePane(name, columns, half, colors, {{"alphaMode", mode}, {"alphaCutoff", cutoff}},
                   textured ? "veil.png" : "");
}

std::filesystem::path randomPanes(unsigned seed, const char* mode) {
  Random random(seed + 900);
  writeOpacities();
  std::ostringstream out;
  out << coverView;
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::string("pane_") + mode + std::to_string(seed) + "_" + std::to_string(i);
    out << "[[object]]\nmodel = \"" << randomPane(name, random, mode) << "\"\nposition = [" << random.uniform(-1, 1)
        << ", " << random.uniform(-0.5, 0.6) << ", " << random.uniform(-1.2, 1)
        << "]\nrotation = " << random.vec(-180, 180) << "\n";
  }
  out << (random.chance(0.6) ? shadowLamp : lamp) << (random.chance(0.4) ? ball : "");
  return writeScene(std::string("panes_") + mode + std::to_string(seed), out.str());
}

// Boxes and panes of random coverage before and beside mirrors.
std::filesystem::path randomCover(unsigned seed) {
  Random random(seed + 700);
  writeOpacities();
  std::ostringstream out;
  out << coverView;
  static constexpr std::array<const char*, 7> opacities{
      "d 0.3\n",          "d 0.8\nKs 0.4 0.4 0.4\nNs 50\n", "map_Kd veil.png\n",       "map_Kd leaf.png\n",
      "map_d mask.tga\n", "map_Kd leaf.png\nd 0.5\n",       "Tr 0.4\nmap_d veil.png\n"};
  for (int i = 0; i < 4; ++i) {
    std::ostringstream material;
    material << "Kd " << random.uniform(0, 1) << ' ' << random.uniform(0, 1) << " 0.5\n" << random.pick(opacities);
    const glm::dvec3 half(random.uniform(0.1, 0.7), random.uniform(0.1, 0.7), random.chance(0.5) ? 0.02 : 0.4);
    const std::string name = "cover" + std::to_string(seed) + "_" + std::to_string(i);
    out << "[[object]]\nmodel = \"" << writeBox(name, half, material.str()) << "\"\nposition = ["
        << random.uniform(-1.2, 1.2) << ", " << random.uniform(-0.6, 0.7) << ", " << random.uniform(-1.2, 1.2)
        << "]\nrotation = " << random.vec(-180, 180) << "\n";
  }
  out << (random.chance(0.6) ? shadowLamp : lamp) << (random.chance(0.4) ? ball : "");
  return writeScene("cover_" + std::to_string(seed), out.str());
}

class RandomCoverage : public testing::TestWithParam<unsigned> {
 protected:
  const PictureSize meanSize_ = fullTests() ? PictureSize{64, 48} : PictureSize{40, 30};
};

TEST_P(RandomCoverage, ConvergesToTheTracer) {
  const std::filesystem::path file = randomCover(GetParam());
  const double error = errorOfMean(file, meanSize_);
  EXPECT_LT(error, 0.02);
  EXPECT_GT(errorOfMean(file, meanSize_, {{"effects.transparency", "false"}}), 2.0 * error)
      << "the scene shows no coverage";
}

TEST_P(RandomCoverage, ShadowMapsConvergeToTraced) {
  EXPECT_LT(errorOfMean(randomCover(GetParam()), meanSize_, {{"effects.shadow_lookup", "map"}}), 0.05);
}

TEST_P(RandomCoverage, SkippingChangesNothing) {
  for (const char* samples : {"1", "4"}) {
    Options options = truthOptions(randomCover(GetParam()), size, 3);
    set(options, {{"view.samples", samples}, {"reflection.samples", samples}});
    QuietSession session(options);
    const Image8 skipped = draw(session);
    EXPECT_EQ(draw(session).rgba, skipped.rgba) << "images are used again";
    set(session, {{"debug.skip_hidden", "false"}, {"reflection.skip_unchanged", "false"}});
    EXPECT_EQ(draw(session).rgba, skipped.rgba);
    set(session, {{"debug.cull_clusters", "false"}});
    expectAlike(draw(session), skipped, 2, "cover_whole");  // outlines may differ
  }
}

TEST_P(RandomCoverage, AlphaOfVerticesConverges) {
  const std::filesystem::path file = randomPanes(GetParam(), "BLEND");
  EXPECT_LT(errorOfMean(file, meanSize_), 0.02);
  EXPECT_GT(errorOfMean(file, meanSize_, {{"effects.transparency", "false"}}), 0.025) << "the scene shows no coverage";
  EXPECT_LT(errorOfMean(file, meanSize_, {{"effects.shadow_lookup", "map"}}), 0.05);
}

TEST_P(RandomCoverage, AlphaOfVerticesCutsOut) {
  const std::filesystem::path file = randomPanes(GetParam(), "MASK");
  expectTruth(file, size, 3, trace(file, size, 3));
  Options options = truthOptions(file, size, 3);
  const Image8 drawn = draw(options);
  options.settings.push_back({"effects.transparency", "false"});
  EXPECT_GT(difference(draw(options), drawn, 8).share(), 0.005) << "the scene shows no cut-out";
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomCoverage, testing::ValuesIn(sampledSeeds(20, 10)),
                         testing::PrintToStringParamName());

// A closed box before a mirror hides it, unless it is glass.
TEST(Coverage, HidesNothing) {
  const auto reasons = [](const std::string& material) {
    const std::string box = writeBox("crate", {2, 2, 0.5}, material);
    const std::filesystem::path file = writeScene("crate", R"([environment] background = [0.2, 0.3, 0.4]
[camera] position = [0, 0, 4], target = [0, 0, 0]
[[object]] model = ")" + box + R"("
[[object]] model = "MODELS/sphere.obj", position = [0, 0, 5]
[[mirror]] position = [0, 0, -2], size = [1, 1]
)");
    const Scene scene = loadScene(file);
    return planFrame({scene, evaluate(scene, 0.0), Settings(), {size.width, size.height}}).skipped.size();
  };
  EXPECT_EQ(reasons("Kd 1 0 0\n"), 1u);
  EXPECT_EQ(reasons("Kd 1 0 0\nd 0.5\n"), 0u);
}

}  // namespace
}  // namespace speculum
