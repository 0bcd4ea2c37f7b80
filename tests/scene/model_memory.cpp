// Memory that loading a large model takes.
#include <spdlog/fmt/fmt.h>

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

// A million triangles take at most 300 MB, or without normals, where each triangle has vertices of its own, 600 MB.
TEST(ModelMemory, GrowsByFewBytesForEachTriangle) {
  const TemporaryFolder folder;
  constexpr int side = 250;
  constexpr size_t triangles = size_t{2} * side * side;
  for (const auto& [normals, most] : {std::pair(true, 300), std::pair(false, 600)}) {
    const std::filesystem::path file = folder.write("sheet.obj", sheetText(side, normals));
    std::vector<Texture> textures;
    fuzz::restartHeapPeak();
    const size_t before = fuzz::heapPeak();
    const Mesh mesh = loadObj(file, textures);
    EXPECT_EQ(mesh.indices.size(), 3 * triangles);
    EXPECT_LT((fuzz::heapPeak() - before) / triangles, most) << (normals ? "with" : "without") << " normals";
    RecordProperty(normals ? "with" : "without", static_cast<int>((fuzz::heapPeak() - before) / triangles));
  }
}

}  // namespace
}  // namespace speculum::test
