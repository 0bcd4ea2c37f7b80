// Memory that loading a large model takes.
#include <spdlog/fmt/fmt.h>

#include <array>
#include <numbers>

#include "fuzz/heap_watch.hpp"
#include "scene/obj_loader.hpp"
#include "temporary_folder.hpp"
#include "test_headers.hpp"

namespace speculum::test {
namespace {

// Returns an OBJ file of a wavy sheet of 2 * side^2 triangles, with or without normals.
std::string sheetText(int side, bool normals) {
  std::string text;
  const int row = side + 1;
  for (int i = 0; i < row * row; ++i) {
    const double x = static_cast<double>(i % row) / side;
    const double z = static_cast<double>(i / row) / side;
    text += fmt::format("v {:.6f} {:.6f} {:.6f}\nvt {:.6f} {:.6f}\n", x, 0.1 * std::sin(9.0 * x), z, x, z);
    text += normals ? fmt::format("vn {:.4f} 1.0000 0.0000\n", -0.9 * std::cos(9.0 * x)) : "";
  }
  const auto corner = [&](int i) { return normals ? fmt::format("{0}/{0}/{0}", i) : fmt::format("{0}/{0}", i); };
  for (int i = 0; i < side * side; ++i) {
    const int a = i / side * row + i % side + 1;
    text += fmt::format("f {} {} {}\nf {} {} {}\n", corner(a), corner(a + row), corner(a + 1), corner(a + 1),
                        corner(a + row), corner(a + row + 1));
  }
  return text;
}

// Returns an OBJ file of a torus of 2 * side^2 triangles.
std::string torusText(int side) {
  std::string text;
  for (int i = 0; i < side * side; ++i) {
    const double along = 2.0 * std::numbers::pi * (i / side) / side;
    const double around = 2.0 * std::numbers::pi * (i % side) / side;
    const double radius = 1.0 + 0.4 * std::cos(around);
    text += fmt::format("v {:.6f} {:.6f} {:.6f}\nvn {:.4f} {:.4f} {:.4f}\n", radius * std::cos(along),
                        0.4 * std::sin(around), radius * std::sin(along), std::cos(around) * std::cos(along),
                        std::sin(around), std::cos(around) * std::sin(along));
  }
  for (int i = 0; i < side * side; ++i) {
    const int next = (i / side + 1) % side * side;
    const std::array corners{i / side * side + i % side + 1, i / side * side + (i + 1) % side + 1, next + i % side + 1,
                             next + (i + 1) % side + 1};
    text += fmt::format("f {0}//{0} {1}//{1} {2}//{2}\nf {2}//{2} {1}//{1} {3}//{3}\n", corners[0], corners[1],
                        corners[2], corners[3]);
  }
  return text;
}

// A million triangles take at most 300 MB, or without normals, where each triangle has vertices of its own, 600 MB.
TEST(ModelMemory, GrowsByFewBytesForEachTriangle) {
  const TemporaryFolder folder;
  constexpr int side = 250;
  constexpr size_t triangles = size_t{2} * side * side;
  struct Case {
    const char* name;
    std::string text;
    bool solid;
    size_t most;
  };
  for (const Case& model :
       {Case{"with", sheetText(side, true), false, 300}, Case{"without", sheetText(side, false), false, 600},
        Case{"solid", torusText(side), true, 300}}) {
    const std::filesystem::path file = folder.write("model.obj", model.text);
    std::vector<Texture> textures;
    fuzz::restartHeapPeak();
    const size_t before = fuzz::heapPeak();
    const Mesh mesh = loadObj(file, textures);
    EXPECT_EQ(mesh.indices.size(), 3 * triangles);
    EXPECT_EQ(mesh.solid, model.solid);
    const size_t bytes = (fuzz::heapPeak() - before) / triangles;
    EXPECT_LT(bytes, model.most) << model.name;
    RecordProperty(model.name, static_cast<int>(bytes));
  }
}

}  // namespace
}  // namespace speculum::test
