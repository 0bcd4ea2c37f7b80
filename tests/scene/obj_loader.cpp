#include "scene/obj_loader.hpp"

#include <spdlog/fmt/fmt.h>
#include <tiny_obj_loader.h>

#include <ctime>
#include <deque>
#include <random>

#include "geometry/polygon.hpp"
#include "instrumented.hpp"
#include "scene/obj_support.hpp"
#include "test_headers.hpp"

namespace speculum {
namespace {

using ObjLoader = ObjTest;

// The three corners of a triangle in model space.
std::array<glm::dvec3, 3> corners(const Mesh& mesh, size_t triangle) {
  std::array<glm::dvec3, 3> points;
  for (size_t i = 0; i < 3; ++i) {
    points[i] = mesh.center + mesh.vertices[mesh.indices[3 * triangle + i]].position;
  }
  return points;
}

TEST_F(ObjLoader, TriangleWithoutNormalsIsFlat) {
  const Mesh mesh = load(triangleObj);
  EXPECT_EQ(mesh.indices, (std::vector<uint32_t>{0, 1, 2}));
  ASSERT_EQ(mesh.vertices.size(), 3u);
  for (const Vertex& vertex : mesh.vertices) {
    EXPECT_EQ(vertex.normal, glm::dvec3(0, 0, 1));
    EXPECT_EQ(vertex.uv, glm::dvec2(0.0));
  }
  EXPECT_EQ(mesh.source, folder_ / "m.obj");
  EXPECT_EQ(warnings(), "");
}

// A bumpy grid of 180 000 triangles, with colors, texture coordinates and a seam of these along its middle.
TEST_F(ObjLoader, FlatTrianglesOfLargeModelsShareVertices) {
  constexpr int side = 301;
  const auto heightAt = [](int x, int z) { return (x * 7 + z * 13) % 5 * 0.25; };
  std::string text;
  for (int z = 0; z < side; ++z) {
    for (int x = 0; x < side; ++x) {
      text += fmt::format("v {} {} {} {} 0 1\n", x, heightAt(x, z), z, x / 512.0);
    }
  }
  for (int i = 0; i < 2 * side; ++i) {
    text += fmt::format("vt {} 0\n", i / 1024.0);
  }
  for (int z = 0; z + 1 < side; ++z) {
    for (int x = 0; x + 1 < side; ++x) {
      const auto corner = [&](int dx, int dz) {
        return fmt::format(" {}/{}", (z + dz) * side + x + dx + 1, x + dx + 1 + (z >= side / 2 ? side : 0));
      };
      text +=
          "f" + corner(0, 0) + corner(0, 1) + corner(1, 0) + "\nf" + corner(1, 0) + corner(0, 1) + corner(1, 1) + "\n";
    }
  }
  const Mesh mesh = load(text);
  constexpr size_t triangles = size_t{2} * (side - 1) * (side - 1);
  ASSERT_EQ(mesh.indices.size(), 3 * triangles);
  EXPECT_LT(mesh.vertices.size(), triangles * 6 / 5) << "of three times as many corners";
  const ShadedVertices shaded(mesh);
  std::vector<Vertex> vertices;
  shaded.forEach([&](const Vertex& vertex, uint32_t index) {
    EXPECT_EQ(vertex.position, mesh.vertices[index].position);
    vertices.push_back(vertex);
  });
  const std::vector<glm::vec4> colors = shaded.colors();
  ASSERT_EQ(vertices.size(), ShadedVertices::countOf(mesh));
  ASSERT_EQ(colors.size(), vertices.size());
  ASSERT_EQ(shaded.indices().size(), mesh.indices.size());
  std::set<std::array<double, 3>> places;  // of the triangles
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::array<glm::dvec3, 3> points;
    for (size_t k = 0; k < 3; ++k) {
      points[k] = vertices[shaded.indices()[i + k]].position;
      ASSERT_EQ(points[k], mesh.vertices[mesh.indices[i + k]].position);
    }
    const glm::dvec3 normal = glm::normalize(glm::cross(points[1] - points[0], points[2] - points[0]));
    ASSERT_GT(normal.y, 0.0);
    const glm::dvec3 middle = mesh.center + (points[0] + points[1] + points[2]) / 3.0;
    places.insert({middle.x, middle.y, middle.z});
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t index = shaded.indices()[i + k];
      const double x = mesh.center.x + points[k].x;
      ASSERT_LT(glm::distance(vertices[index].normal, normal), 1e-12);
      ASSERT_EQ(cornerNormals(mesh, &mesh.indices[i])[k], vertices[index].normal);
      ASSERT_EQ(vertices[index].uv.x, (x + (middle.z > side / 2 ? side : 0)) / 1024.0);
      ASSERT_EQ(colors[index], glm::vec4(x / 512.0, 0, 1, 1));
    }
  }
  EXPECT_EQ(places.size(), triangles) << "each is there once";
}

// Two squares that meet at a right angle along the edge from (0, 0, 0) to (0, 1, 0), and normals of their corners
// there.
const std::string foldText = "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 0 -1\nv 0 1 -1\n";

std::vector<glm::dvec3> normalsOfFold(const Mesh& mesh) {
  std::vector<glm::dvec3> normals;
  for (const uint32_t index : mesh.indices) {
    const glm::dvec3 p = mesh.center + mesh.vertices[index].position;
    if (p.x == 0.0 && p.z == 0.0) {
      normals.push_back(mesh.vertices[index].normal);
    }
  }
  return normals;
}

TEST_F(ObjLoader, SmoothingGroupsWeightNormalsByAngles) {
  const Mesh mesh = load("s 1\n" + foldText + "f 1 3 4 2\nf 2 6 5\nf 1 2 5\n");
  ASSERT_EQ(normalsOfFold(mesh).size(), 6u);
  for (const glm::dvec3& normal : normalsOfFold(mesh)) {
    EXPECT_NEAR(glm::distance(normal, glm::normalize(glm::dvec3(-1, 0, 1))), 0.0, 1e-15);
  }
  EXPECT_EQ(mesh.vertices.size(), 6u) << "the corners of a group are shared";
}

TEST_F(ObjLoader, NormalsOfSmoothingGroupsKeepApart) {
  for (const std::string lines : {"s 1\nf 1 3 4 2\ns 2\nf 2 6 5 1\n", "s 1\nf 1 3 4 2\ns off\nf 2 6 5 1\n",
                                  "s 0\nf 1 3 4 2\nf 2 6 5 1\n", "f 1 3 4 2\nf 2 6 5 1\ns 1\n"}) {
    for (const glm::dvec3& normal : normalsOfFold(load(foldText + lines))) {
      EXPECT_EQ(std::abs(normal.x) + std::abs(normal.z), 1.0) << lines;
    }
  }
}

TEST_F(ObjLoader, GivenNormalsAndLaterVerticesGoWithSmoothingGroups) {
  const Mesh given = load(foldText + "vn 0 1 0\ns 1\nf 1//1 3 4 2\nf 2 6 5 1\n");
  EXPECT_EQ(given.vertices[0].normal, glm::dvec3(0, 1, 0));
  const Mesh later = load("s 1\nf 1 3 4 2\nf 2 6 5 1\ns off\n" + foldText);
  for (const glm::dvec3& normal : normalsOfFold(later)) {
    EXPECT_LT(normal.x, -0.3);
  }
}

TEST_F(ObjLoader, OppositeNormalsOfAGroupStayFlat) {
  const Mesh mesh = load("s 1\n" + squareText + "f 1 2 3 4\nf 4 3 2 1\n");
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](size_t k) { return mesh.vertices[mesh.indices[i + k]]; };
    const glm::dvec3 across =
        glm::cross(corner(1).position - corner(0).position, corner(2).position - corner(0).position);
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(corner(k).normal, glm::normalize(across));
    }
  }
}

TEST_F(ObjLoader, VertexColorsAreRead) {
  const Mesh mesh = load("v 0 0 0 1 0.5 0.25\nv 1 0 0 0.5\nv 0 1 0 0 0 1 0.5\nvt 0 0\nf 1 2 3\nf 1/1 2/1 3/1\n");
  ASSERT_EQ(mesh.colors.size(), mesh.vertices.size());
  for (size_t i = 0; i < mesh.indices.size(); i += 3) {
    EXPECT_EQ(mesh.colors[mesh.indices[i]], glm::vec4(1, 0.5, 0.25, 1));
    EXPECT_EQ(mesh.colors[mesh.indices[i + 1]], glm::vec4(1)) << "a single number is a weight";
    EXPECT_EQ(mesh.colors[mesh.indices[i + 2]], glm::vec4(0, 0, 1, 1));
  }
  EXPECT_EQ(warnings(), "");
  EXPECT_EQ(mesh.parts.at(0).material.diffuse, glm::dvec3(1.0)) << "nothing darkens the colors";
  EXPECT_TRUE(load(triangleObj).colors.empty());
  EXPECT_EQ(load(std::string(triangleObj) + "v 9 9 9 1 1 1\n").parts.at(0).material.diffuse, glm::dvec3(0.6))
      << "no face has it";
}

TEST_F(ObjLoader, DamagedVertexColorsAreMended) {
  const Mesh mesh = load("v 0 0 0 255 0 -1\nv 1 0 0 a b c\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.colors, (std::vector<glm::vec4>{{1, 0, 0, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}));
  EXPECT_EQ(warnings(),
            "warning: m.obj:1: v: has a color outside 0 .. 1, the nearest one is used\n"
            "warning: m.obj:2: v: has a color that is not three finite numbers, it counts as white\n");
  const Mesh white = load("v 0 0 0 nan nan nan\nv 1 0 0 nan nan nan\nv 0 1 0 nan nan nan\nf 1 2 3\n");
  EXPECT_EQ(white.parts.at(0).material.diffuse, glm::dvec3(1.0)) << "no color is left";
}

TEST_F(ObjLoader, IsRebasedToItsBoxCentre) {
  const Mesh mesh = load("v 10000000.25 0 0\nv 10000001.25 0 0\nv 10000000.25 3 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.center, glm::dvec3(10000000.75, 1.5, 0));
  EXPECT_EQ(mesh.halfExtent, glm::dvec3(0.5, 1.5, 0));
  EXPECT_NEAR(mesh.radius, std::sqrt(2.5), 1e-15);
  EXPECT_EQ(mesh.vertices[0].position, glm::dvec3(-0.5, -1.5, 0));
}

TEST_F(ObjLoader, UnusedVerticesDoNotWidenTheBox) {
  const Mesh mesh = load(std::string("v 100 100 100\n") + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
  EXPECT_EQ(mesh.halfExtent, glm::dvec3(0.5, 0.5, 0));
}

TEST_F(ObjLoader, NumbersAreTheNearestDoubles) {
  const Mesh mesh = load(
      "v 0.1234567890123456 0 0\nv -.1234567890123456e0 0 0\nv 0 +1. -0\nvn 0 0 1\nvt 0.3 0.7\nf 1/1/1 2/1/1 3/1/1\n");
  EXPECT_EQ(corners(mesh, 0)[0].x, 0.1234567890123456);
  EXPECT_EQ(corners(mesh, 0)[1].x, -0.1234567890123456);
  EXPECT_EQ(corners(mesh, 0)[2], glm::dvec3(0, 1, 0));
  EXPECT_EQ(mesh.vertices[0].uv, glm::dvec2(0.3, 0.7));
}

TEST_F(ObjLoader, CornersAreSharedByIndexTriple) {
  const Mesh mesh = load(
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 2\n"
      "f 1/1/1 2/2/1 3/3/1 4/4/1\nf 1/2/1 2/2/1 3/3/1\n");
  EXPECT_EQ(mesh.indices.size(), 9u);
  EXPECT_EQ(mesh.vertices.size(), 5u) << "only the first corner of the second face differs";
  EXPECT_EQ(mesh.vertices[3].uv, glm::dvec2(1, 1));
  EXPECT_EQ(mesh.vertices[3].normal, glm::dvec3(0, 0, 1));
}

TEST_F(ObjLoader, RelativeIndicesCountBackwards) {
  const Mesh mesh = load("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0\nvn 0 1 0\nf -3//-1 -2//-1 -1//-2\nv 5 5 5\n");
  EXPECT_EQ(corners(mesh, 0)[0], glm::dvec3(0, 0, 0));
  EXPECT_EQ(corners(mesh, 0)[2], glm::dvec3(0, 1, 0));
  EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(0, 1, 0));
  EXPECT_EQ(mesh.vertices[2].normal, glm::dvec3(1, 0, 0));
}

TEST_F(ObjLoader, LeftOutIndicesMayKeepTheirSlashes) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5 0.25\nf 1/ 2// 3/1/\n");
  EXPECT_EQ(mesh.indices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0].uv, glm::dvec2(0.0));
  EXPECT_EQ(mesh.vertices[2].uv, glm::dvec2(0.5, 0.25));
  EXPECT_EQ(mesh.vertices[2].normal, glm::dvec3(0, 0, 1));
}

TEST_F(ObjLoader, ConcavePolygonKeepsItsArea) {
  const Mesh mesh = load("v 0 0 0\nv 2 0 0\nv 0.5 0.5 0\nv 0 2 0\nf 1 2 3 4\n");
  ASSERT_EQ(mesh.indices.size(), 6u);
  EXPECT_NEAR(polygonArea(corners(mesh, 0)) + polygonArea(corners(mesh, 1)), 1.0, 1e-12);
}

TEST_F(ObjLoader, BadNormalsBecomeTheFacesOwn) {
  const Mesh mesh = load(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn nan 1 0\nvn 0 -1e-200 0\n"
      "f 1//1 2//2 3//3\n");
  EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(0, 0, 1));
  EXPECT_EQ(mesh.vertices[1].normal, glm::dvec3(0, 0, 1));
  EXPECT_EQ(mesh.vertices[2].normal, glm::dvec3(0, -1, 0)) << "short is not zero";
}

TEST_F(ObjLoader, FacesWithNonFiniteVerticesAreDropped) {
  const Mesh mesh = load(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nv 0 inf 0\nv 0 0 1e999\nv -1 nan 0\nv -1 0 nan\n"
      "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 2 6 3\nf 1 2 3 7\nf 1 2 3 8\n");
  EXPECT_EQ(mesh.indices.size(), 3u);
  EXPECT_EQ(
      warnings(),
      "warning: m.obj:4: v: is not a point of three finite numbers, faces with it are left out (and 4 more)\n"
      "warning: m.obj:10: f: has a vertex that is not finite or beyond 1e300, the face is left out (and 4 more)\n");
}

TEST_F(ObjLoader, DegenerateTrianglesAreDropped) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0.5 0.9e-10 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\nf 1 2 5\n");
  EXPECT_EQ(mesh.indices.size(), 3u);
  EXPECT_EQ(warnings(), "") << "they draw nothing, and exporters write them at the poles of spheres";
}

// The second face has a vertex in the middle of an edge, the third repeats one: their corners are all drawn.
TEST_F(ObjLoader, CutsOfFacesAreNoDefects) {
  const Mesh mesh =
      load("v 0 0 0\nv 2 0 0\nv 0 2 0\nv 1 1 0\nv 1 0 0\nv 3 0 0\nf 1 2 3\nf 1 2 4 3\nf 1 1 2 3\nf 1 5 2 6\n");
  EXPECT_EQ(mesh.indices.size(), 3u + 6u + 3u);
  EXPECT_EQ(warnings(), "");
}

TEST_F(ObjLoader, RepeatedTexturesShareVertices) {
  const Mesh mesh = load(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvn 0 0 1\nvt 20 0\nvt 21 0\nvt 20 1\nvt 21 1\n"
      "f 1/1/1 2/2/1 3/3/1\nf 2/2/1 4/4/1 3/3/1\n");
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

TEST_F(ObjLoader, VertexContinuesAfterABackslash) {
  EXPECT_EQ(load("v 0 0 \\\n4\nv 2 0 4\\\n\nv 0 2 4\nf 1 2 3\n").center, glm::dvec3(1.0, 1.0, 4.0));
}

TEST_F(ObjLoader, LinesAndNumbersHaveManyForms) {
  for (const auto& [text, triangles] : std::vector<std::pair<std::string, size_t>>{
           {squareText + "f 1 2 \\\n3 \\\n4\n", 2},
           {squareText + "f 1 2 \\\r\n3 \\\r\n4\r\n", 2},
           {squareText + "f 1 2\\\n3\n", 1},
           {squareText + "f 1 2 \\ \t\n3 4\n", 2},
           {squareText + "f +1 +2 +3\nf +1//+1 +3//+1 -1\nvn 0 0 1\n", 2},
           {squareText + "f 1 2 3 \\", 1},
           {squareText + "# C:\\models\\\nf 1 2 3\nf 1 3 4 # half \\\nf 1 2 4\n", 3},
           {"\xef\xbb\xbfv 0 0 0 # first\nv 1 0 0\nv 0 1 0\nf 1 2 3 # 1 2 3\nf 3 2 1#x", 2},
           {"\xef\xbb\xbf\xef\xbb\xbf" + std::string("x 99 99 99\n") + squareText + "f 1 2 3\n", 1},
           {"v 1e-999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 1}}) {
    EXPECT_EQ(load(text).indices.size(), 3 * triangles) << text;
  }
  EXPECT_EQ(warnings(), "");
}

// In Shift-JIS and Big5 the second byte of a character may be that of a backslash.
TEST_F(ObjLoader, NamesEndWithTheirLines) {
  for (const std::string line :
       {"o \x95\x5c", "g a \xa5\x5c", "usemtl \x95\x5c", "mtllib \x95\x5c", "O C:\\a\\", "g a\\", "usemtl a\\"}) {
    EXPECT_EQ(load(line + "\n" + squareText + "f 1 2 3 4\n").indices.size(), 6u) << line;
  }
  folder_.write("m.mtl", "newmtl \x95\x5c\nKd 1 0 0\nnewmtl b\n");
  EXPECT_EQ(load("mtllib none.mtl \\\nm.mtl\n" + squareText + "usemtl \x95\x5c\nf 1 2 3\nusemtl b\n")
                .parts[0]
                .material.diffuse,
            glm::dvec3(1, 0, 0));
}

TEST_F(ObjLoader, ArbitraryBytesAreRefused) {
  std::string bytes;
  for (int i = 0; i < 4096; ++i) {
    bytes.push_back(static_cast<char>(1 + (i * 131 + i / 7) % 255));
  }
  for (const std::string& text :
       {std::string(), bytes, bytes + '\0', std::string(100, '\\'), std::string("\\\n\\\n")}) {
    const std::string fault = faultOf(text);
    EXPECT_TRUE(startsWith(fault, "m.obj:"));
    EXPECT_FALSE(contains(fault, "\n"));
  }
}

// Positions on a circle, or with every second one at half the radius, a star.
std::string roundFace(int corners, bool star) {
  std::string obj;
  std::string face = "f";
  for (int i = 0; i < corners; ++i) {
    const double angle = 6.283185307179586 * i / corners;
    const double radius = star && i % 2 == 1 ? 0.5 : 1.0;
    obj += fmt::format("v {} {} 0\n", radius * std::cos(angle), radius * std::sin(angle));
    face += fmt::format(" {}", i + 1);
  }
  return obj + face + "\n";
}

double areaOf(const Mesh& mesh) {
  double area = 0.0;
  for (size_t i = 0; i < mesh.indices.size() / 3; ++i) {
    area += polygonArea(corners(mesh, i));
  }
  return area;
}

TEST_F(ObjLoader, FacesOfAnyNumberOfCornersAreCovered) {
  for (const int count : {5, 999, 1001, 1200, 100'000}) {
    const double angle = 6.283185307179586 / count;
    EXPECT_NEAR(areaOf(load(roundFace(count, false))), 0.5 * count * std::sin(angle), 1e-9) << count;
  }
  for (const int count : {10, 1000, 1200, 5000}) {
    const double angle = 6.283185307179586 / count;
    EXPECT_NEAR(areaOf(load(roundFace(count, true))), 0.25 * count * std::sin(angle), 1e-6) << count;
  }
}

TEST_F(ObjLoader, LargeStarsAreLeftOutInTime) {
  // AddressSanitizer reads a line to its end for each number in it.
  const int corners = testing_support::instrumented > 1 ? 40'000 : 100'000;
  const std::clock_t start = std::clock();
  EXPECT_EQ(load(roundFace(corners, true) + "v 0 0 1\nv 1 0 1\nv 1 1 1\nf -1 -2 -3\n").indices.size(), 3u);
  EXPECT_LT(std::clock() - start, testing_support::instrumented * 5 * CLOCKS_PER_SEC);
  EXPECT_TRUE(contains(warnings(), "f: has too many corners for a face that is no fan about its first"));
}

TEST_F(ObjLoader, NumbersMayHaveManyDigits) {
  const std::string one = "1" + std::string(400, '0') + "e-400";
  EXPECT_EQ(load(squareText + "v " + one + " 1 2\nf 1 2 5\n").halfExtent, glm::dvec3(0.5, 0.5, 1.0));
  const Mesh mesh = load(squareText + "vn " + one + " 0 0\nvt " + one + " 0\nf 1/1/1 2/1/1 3/1/1\n");
  EXPECT_EQ(mesh.vertices[0].normal, glm::dvec3(1, 0, 0));
  EXPECT_EQ(mesh.vertices[0].uv, glm::dvec2(1, 0));
}

TEST_F(ObjLoader, ExponentsOfAnySize) {
  const Mesh mesh = load(squareText + "v 1e2147483648 0 0\nv 2 0e99999999999 1e-2147483649\nf 1 2 5\nf 1 6 3\n");
  ASSERT_EQ(mesh.indices.size(), 3u);
  EXPECT_EQ(mesh.center + mesh.vertices[1].position, glm::dvec3(2, 0, 0));
}

TEST_F(ObjLoader, MissingFilesAndFoldersAreRefused) {
  for (const auto& [file, problem] :
       {std::pair("none.obj", "cannot be read: No such file or directory"), std::pair("", "is a folder")}) {
    const std::filesystem::path path = folder_ / file;
    EXPECT_EQ(messageOf<InputError>([&] { loadObj(path, textures_); }),
              path.string() + ":1: file: " + problem + " (a Wavefront OBJ file is needed)");
  }
}

struct Defect {
  const char* name;
  std::string text;      // of an OBJ file
  size_t triangles = 1;  // that are left
  const char* warning = "";
};

class ObjDefects : public ObjTest, public testing::WithParamInterface<Defect> {};

TEST_P(ObjDefects, CostWhatTheyTouch) {
  const Mesh mesh = load(GetParam().text);
  EXPECT_EQ(mesh.indices.size(), 3 * GetParam().triangles);
  EXPECT_EQ(warnings(), std::string("warning: m.obj:") + GetParam().warning + "\n");
  ASSERT_EQ(mesh.defects.size(), 1u);
  EXPECT_TRUE(contains(mesh.defects[0], GetParam().warning));
}

const std::string triangleText = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";  // and a face of them
const char* const noVertex = "has a vertex that is not there, the face is left out";
const char* const noTexcoord = "has a texture coordinate that is not there, it counts as missing";
const char* const noNormal = "has a normal that is not there, it counts as missing";

std::string at(int line, const char* text) {
  return fmt::format("{}: f: {}", line, text);
}

Defect faceDefect(const char* name, const std::string& more, size_t triangles, int line, const char* text) {
  static std::deque<std::string> texts;
  return {name, triangleText + more, triangles, texts.emplace_back(at(line, text)).c_str()};
}

INSTANTIATE_TEST_SUITE_P(
    Lines, ObjDefects,
    testing::Values(Defect{"WordInPosition", "v 1 abc 2\n" + squareText + "f 2 3 4\n", 1,
                           "1: v: is not a point of three finite numbers, faces with it are left out"},
                    Defect{"TwoCoordinates", "v 1 2\n" + squareText + "f 2 3 4\n", 1,
                           "1: v: is not a point of three finite numbers, faces with it are left out"},
                    Defect{"NoCoordinates", "v\n" + squareText + "f 2 3 4\n", 1,
                           "1: v: is not a point of three finite numbers, faces with it are left out"},
                    Defect{"OldCompilersNan", "v 1.#QNAN 0 0\n" + squareText + "f 2 3 4\n", 1,
                           "1: v: is not a point of three finite numbers, faces with it are left out"},
                    Defect{"NormalOfWords", squareText + "vn a b c\nf 1//1 2//1 3//1\n", 1,
                           "5: vn: is not a vector of three finite numbers, it counts as missing"},
                    Defect{"EmptyTexcoord", squareText + "vt\nf 1/1 2/1 3/1\n", 1,
                           "5: vt: is not one to three finite numbers, it counts as missing"},
                    faceDefect("IndexTooLarge", "f 1 2 4\n", 1, 5, noVertex),
                    faceDefect("IndexZero", "f 0 1 2\n", 1, 5, noVertex),
                    faceDefect("RelativeIndexTooFar", "f -4 1 2\n", 1, 5, noVertex),
                    faceDefect("IndexBeyondIntegers", "f 1 2 99999999999999999999\n", 1, 5, noVertex),
                    faceDefect("IndexAtTheLargestInteger", "f 1 2 2147483648\n", 1, 5, noVertex),
                    faceDefect("TexcoordTooLarge", "vt 0 0\nf 1/1 2/2 3/1\n", 2, 6, noTexcoord),
                    faceDefect("NoTexcoords", "f 1/1 2 3\n", 2, 5, noTexcoord),
                    faceDefect("NormalTooLarge", "vn 0 0 1\nf 1//1 2//1 3//2\n", 2, 6, noNormal),
                    faceDefect("RelativeNormalTooFar", "vn 0 0 1\nf 1//1 2//-2 3//1\n", 2, 6, noNormal),
                    faceDefect("IndexIsWord", "f 1 2 x\n", 1, 5,
                               "'x' is no corner (v, v/vt, v//vn or v/vt/vn), the face is left out"),
                    faceDefect("IndexHasALetter", "f 1 2 3x\n", 1, 5,
                               "'3x' is no corner (v, v/vt, v//vn or v/vt/vn), the face is left out"),
                    faceDefect("IndexIsEmpty", "f 1 2 /3\n", 1, 5,
                               "'/3' is no corner (v, v/vt, v//vn or v/vt/vn), the face is left out"),
                    faceDefect("IndexOfFour", "f 1/1/1/1 2 3\n", 1, 5,
                               "'1/1/1/1' is no corner (v, v/vt, v//vn or v/vt/vn), the face is left out"),
                    faceDefect("FaceOfTwo", "f 1 2\n", 1, 5, "has fewer than three corners, the face is left out"),
                    faceDefect("FaceOfNone", "\nf\n", 1, 6, "has fewer than three corners, the face is left out"),
                    faceDefect("LinesOfOldMacs", "f 1 2 9\r", 1, 5, noVertex),
                    faceDefect("LinesOfWindows", "f 1 2 9\r\n", 1, 5, noVertex),
                    faceDefect("ContinuedLine", "f 1 2 \\\n\\\n9\n", 1, 5, noVertex),
                    faceDefect("AfterContinuedLines", "f 1 2 \\\n3\n\n# comment\nf 1 2 9\n", 2, 9, noVertex)),
    [](const auto& info) { return std::string(info.param.name); });

class ObjRefusals : public ObjTest, public testing::WithParamInterface<Fault> {};

TEST_P(ObjRefusals, SayWhatTheFileIs) {
  const std::string fault = faultOf(GetParam().text);
  EXPECT_TRUE(startsWith(fault, "m.obj:" + std::string(GetParam().place) + " "));
  EXPECT_TRUE(contains(fault, GetParam().message)) << fault;
  EXPECT_FALSE(contains(fault, "\n"));
}

const std::string pointsText = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

INSTANTIATE_TEST_SUITE_P(
    Files, ObjRefusals,
    testing::Values(
        Fault{"Empty", "", "1: file:", "is empty"}, Fault{"Blank", " \n\n", "1: file:", "is empty"},
        Fault{"OnlyVertices", pointsText, "1: f:", "has no face"},
        Fault{"Lines", pointsText + "l 1 2 3\n", "1: f:", "has lines or points, but no face"},
        Fault{"Points", pointsText + "p 1 2 3\n", "1: f:", "has lines or points, but no face"},
        Fault{"FreeForm", pointsText + "cstype bezier\nsurf 0 1 0 1 1 2 3\n",
              "1: f:", "has free-form curves or surfaces"},
        Fault{"OnlyDegenerateFaces", pointsText + "f 1 1 2\n",
              "4: f:", "has no area, like every other face (at least one face with an area"},
        Fault{"DecimalCommas", "v 0,5 0 0\nv 1,5 0 0\nv 0,5 1,5 0\nf 1 2 3\n",
              "1: v:", "is not a point of three finite numbers"},
        Fault{"OnlyDamagedFaces", pointsText + "f 1 2 9\n", "4: f:", "has a vertex that is not there"},
        Fault{"GitLfs", "version https://git-lfs.github.com/spec/v1\noid sha256:4d\nsize 12\n",
              "1: file:", "is a Git LFS pointer"},
        Fault{"FreeFormInCapitals", pointsText + "SURF 0 1 0 1 1 2 3\n", "1: f:", "has free-form curves or surfaces"},
        Fault{"LinesInCapitals", pointsText + "L 1 2 3\n", "1: f:", "has lines or points, but no face"},
        Fault{"Utf16LowFirst", std::string("v\0 \0001\0\n\0", 8), "1: file:", "is UTF-16 text"},
        Fault{"Utf16HighFirst", std::string("\0v\0 \0001\0\n", 8), "1: file:", "is UTF-16 text"},
        Fault{"Utf16", std::string("\xff\xfev\0 \0", 6), "1: file:", "is UTF-16 text"},
        Fault{"Stl", "solid cube\nfacet normal 0 0 1\n", "1: file:", "is an STL file"},
        Fault{"BinaryStl", std::string(80, 'x') + std::string("\1\0\0\0", 4) + std::string(50, '\1'),
              "1: file:", "is an STL file"},
        Fault{"Ply", "ply\nformat ascii 1.0\n", "1: file:", "is a PLY file"},
        Fault{"Gltf", "{ \"asset\": { \"version\": \"2.0\" } }", "1: file:", "is a glTF file"},
        Fault{"BinaryGltf", "glTF\x02", "1: file:", "is a glTF file (let its name end with .glb)"},
        Fault{"PlyWithAFace", "ply\nend_header\nf 1 2 3\n", "1: file:", "is a PLY file"},
        Fault{"Fbx", "Kaydara FBX Binary  \x1a", "1: file:", "is an FBX file"},
        Fault{"Max", "MM\x4d", "1: file:", "is a 3DS file"},
        Fault{"Collada", "<?xml version='1.0'?>\n<COLLADA>", "1: file:", "is a COLLADA file"},
        Fault{"Usd", "#usda 1.0\n", "1: file:", "is a USD file"},
        Fault{"Blender", "BLENDER-v402", "1: file:", "is a Blender file"},
        Fault{"NewBlender", "\x28\xb5\x2f\xfd v", "1: file:", "as Blender files are (unpack it)"},
        Fault{"Zip", "PK\x03\x04", "1: file:", "is a ZIP archive"},
        Fault{"Archive", "7z\xbc\xaf", "1: file:", "is a 7z archive (unpack it)"},
        Fault{"Page", "<!DOCTYPE html><html>", "1: file:", "is a web page"},
        Fault{"LoudPage", "<HTML><body>", "1: file:", "is a web page"},
        Fault{"MarkedPage", "\xef\xbb\xbf<!Doctype html><html>", "1: file:", "is a web page"},
        Fault{"PageAfterABlankLine", "\r\n<!doctype html><html>", "1: file:", "is a web page"},
        Fault{"Binary", std::string("\x7f\x45LF\0\0\1v 1\n", 10), "1: file:", "is not a text file"},
        Fault{"Materials", "# Blender\n\nnewmtl m\nKd 1 1 1\n", "1: file:", "is a material file"},
        Fault{"MaterialBehindAFace", pointsText + "f 1 2 9\nnewmtl m\n", "4: f:", "has a vertex that is not there"},
        Fault{"ZerosBehindAFace", pointsText + "f 1 2 9\n" + std::string(7, '\0'),
              "4: f:", "has a vertex that is not there"},
        Fault{"DegenerateFacesWithoutNormals", pointsText + "f 1//3 1//3 2//3\n",
              "4: f:", "has no area, like every other face"},
        Fault{"Text", "once upon a time\nthere was no model\n", "1: f:", "has no face"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_F(ObjLoader, FacesMayStandBeforeTheirVertices) {
  const std::string vertices = squareText + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n";
  const std::string face = "f 1/1/1 2/2/1 3/3/1\n";
  const Mesh after = load(vertices + face);
  const Mesh before = load(face + vertices);
  ASSERT_EQ(before.indices, after.indices);
  for (size_t i = 0; i < after.vertices.size(); ++i) {
    EXPECT_EQ(before.vertices[i].position, after.vertices[i].position);
    EXPECT_EQ(before.vertices[i].normal, after.vertices[i].normal);
    EXPECT_EQ(before.vertices[i].uv, after.vertices[i].uv);
  }
  EXPECT_EQ(warnings(), "");
}

// Each damaged line among good ones costs itself and nothing else.
TEST_F(ObjLoader, RandomDefectsLeaveTheOtherFaces) {
  std::mt19937 random(9);
  const auto pick = [&](const auto& items) { return items[random() % std::size(items)]; };
  const std::array<const char*, 12> bad{"f 1 2\n",     "f 1 2 99\n", "f 0 1 2\n",     "f 1 2 x\n",
                                        "f -9 1 2\n",  "f\n",        "f 1/ / 2 3\n",  "f 1.5 2 3\n",
                                        "f 1 2 1e9\n", "f a/b/c\n",  "f 2 2 3 1 7\n", "g\n"};
  const std::array<const char*, 5> good{"f 1 2 3\n", "f 1/9 2/9 3/9\n", "f 1//9 2//9 3//9\n", "F 1 2 3\n",
                                        "f 4/ 3// 1\n"};
  for (int i = 0; i < 200; ++i) {
    std::string obj = squareText;
    size_t count = 1;
    for (int line = 0; line < 12; ++line) {
      const bool isGood = random() % 2 == 0;
      obj += isGood ? pick(good) : pick(bad);
      count += isGood ? 1 : 0;
    }
    EXPECT_EQ(load(obj + "f 2 3 4\n").indices.size(), 3 * count) << obj;
  }
}

// Corners of the triangles by their positions, whatever corner each begins with.
std::vector<std::array<int, 3>> sorted(std::vector<std::array<int, 3>> triangles) {
  for (std::array<int, 3>& t : triangles) {
    std::rotate(t.begin(), std::ranges::min_element(t), t.end());
  }
  std::ranges::sort(triangles);
  return triangles;
}

TEST_F(ObjLoader, QuadsAreCutAsByTinyobjloader) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    // Draws in turn a square, whose diagonals are equally long, and a convex quad bent out of its plane.
    std::string obj;
    for (int corner = 0; corner < 4; ++corner) {
      const double angle = 1.5707963 * corner + (i % 2 == 0 ? 0.0 : 0.6 * number(random));
      const double radius = i % 2 == 0 ? 1.0 + i : std::exp(0.3 * number(random));
      obj += fmt::format("v {} {} {}\n", i % 2 == 0 ? corner % 3 == 0 ? 0.0 : radius : radius * std::cos(angle),
                         i % 2 == 0 ? corner < 2 ? 0.0 : radius : radius * std::sin(angle),
                         i % 2 == 0 ? 0.0 : 0.2 * number(random));
    }
    obj += "f 1 2 3 4\n";
    tinyobj::ObjReader other;
    ASSERT_TRUE(other.ParseFromString(obj, "", {}));
    std::vector<std::array<int, 3>> expected;
    const auto& indices = other.GetShapes().at(0).mesh.indices;
    for (size_t k = 0; k < indices.size(); k += 3) {
      expected.push_back({indices[k].vertex_index, indices[k + 1].vertex_index, indices[k + 2].vertex_index});
    }
    std::vector<glm::dvec3> corners;
    for (size_t k = 0; k < 12; k += 3) {
      const auto& v = other.GetAttrib().vertices;
      corners.emplace_back(v[k], v[k + 1], v[k + 2]);
    }
    const Mesh mesh = load(obj);
    std::vector<std::array<int, 3>> actual(mesh.indices.size() / 3);
    for (size_t k = 0; k < mesh.indices.size(); ++k) {
      const glm::dvec3 p = mesh.vertices[mesh.indices[k]].position + mesh.center;
      const auto nearest = std::ranges::min_element(
          corners, [&](const auto& a, const auto& b) { return glm::distance(a, p) < glm::distance(b, p); });
      actual[k / 3][k % 3] = static_cast<int>(nearest - corners.begin());
    }
    ASSERT_EQ(sorted(actual), sorted(expected)) << obj;
  }
}

TEST_F(ObjLoader, ModelsOfAnySizeKeepTheirShape) {
  const Mesh usual = load(squareText + "f 1 2 3 4\n");
  for (const int exponent : {-300, -170, -100, -40, -20, -13, -3, 3, 13, 40, 100, 170, 290}) {
    std::string obj;
    for (const char* corner : {"0 0", "1 0", "1 1", "0 1"}) {
      obj += fmt::format("v {}e{} {}e{} 0\n", corner[0], exponent, corner[2], exponent);
    }
    const Mesh mesh = load(obj + "f 1 2 3 4\n");
    ASSERT_EQ(mesh.indices, usual.indices) << exponent;
    const double size = std::pow(10.0, exponent);
    EXPECT_NEAR(mesh.radius * mesh.unit / size, usual.radius, 1e-12);
    EXPECT_TRUE(mesh.radius > 1e-13 && mesh.radius < 1e13) << exponent;
    for (size_t i = 0; i < mesh.vertices.size(); ++i) {
      const glm::dvec3 p = mesh.vertices[i].position * mesh.unit / size;
      EXPECT_NEAR(glm::distance(p, usual.vertices[i].position), 0.0, 1e-12) << exponent;
      EXPECT_EQ(mesh.vertices[i].normal, usual.vertices[i].normal) << exponent;
      EXPECT_TRUE(std::isnormal(static_cast<float>(mesh.vertices[i].position.x))) << exponent;
    }
  }
}

// Programs compute spheres as floats or doubles, and write some of the digits.
TEST_F(ObjLoader, PolesOfSpheresAreNoSlivers) {
  constexpr int rings = 12;
  constexpr int segments = 24;
  const auto coordinates = [](auto radius, auto pi, bool sums) {
    using T = decltype(radius);
    std::vector<std::array<double, 3>> points;
    T polar = 0;
    for (int ring = 0; ring <= rings; ++ring) {
      for (int i = 0; i <= segments; ++i) {
        const T turn = 2 * pi * static_cast<T>(i) / segments;
        points.push_back({radius * std::cos(turn) * std::sin(polar), radius * std::cos(polar),
                          radius * std::sin(turn) * std::sin(polar)});
      }
      polar = sums ? polar + pi / rings : pi * static_cast<T>(ring + 1) / rings;
    }
    return points;
  };
  for (const double radius : {0.01, 1.0, 7.0, 250.0}) {
    for (const bool sums : {false, true}) {
      for (const auto& points : {coordinates(static_cast<float>(radius), std::numbers::pi_v<float>, sums),
                                 coordinates(radius, std::numbers::pi, sums)}) {
        for (const char* format : {"{:.4f}", "{:.6f}", "{:.6g}", "{:.8f}", "{:.9g}", "{}"}) {
          for (const double height : {0.0, radius, 12.345}) {
            std::string obj;
            for (const auto& [x, y, z] : points) {
              const auto written = [&](double number) { return " " + fmt::format(fmt::runtime(format), number); };
              obj += "v" + written(x) + written(y + height) + written(z + 0.3 * height) + "\n";
            }
            for (int ring = 0; ring < rings; ++ring) {
              for (int i = 1; i <= segments; ++i) {
                const int a = ring * (segments + 1) + i;
                const int b = a + segments + 1;
                obj += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, b, a + 1, b + 1, b);
              }
            }
            EXPECT_EQ(load(obj).defects, std::vector<std::string>()) << radius << sums << format << height;
          }
        }
      }
    }
  }
}

TEST_F(ObjLoader, CornersThatDifferAreSlivers) {
  const auto defectsOf = [&](double apart, double size) {
    return load(fmt::format("v 0 0 0\nv {} 0 0\nv {} {} 0\nf 1 2 3\n", size, size, apart)).defects.size();
  };
  for (const double size : {1e-3, 1.0, 2.0, 700.0}) {
    EXPECT_EQ(defectsOf(1.52e-6 * size, size), 1u);
    EXPECT_EQ(defectsOf(1.48e-6 * size, size), 0u);
  }
  EXPECT_EQ(defectsOf(4e-6, 2.0), 1u);
}

TEST_F(ObjLoader, FacesByTheirOldKeywordAreRead) {
  EXPECT_EQ(load(squareText + "fo 1 2 3\nFO 1 3 4\n").indices.size(), 6u);
  EXPECT_TRUE(contains(faultOf(std::string("v 0 0 0\nfo 1 1 1\n")), "m.obj:2: f: has no area"));
}

// Floats hold the place in a texture whichever of its repetitions is named.
TEST_F(ObjLoader, TextureCoordinatesKeepTheirFraction) {
  for (const double far : {0.0, 20.0, 1e4, -1e6, 1e9, -1e12, 1e300}) {
    std::string obj = squareText;
    for (const double u : {0.25, 1.25, 1.75, 0.5}) {
      obj += fmt::format("vt {} {}\n", far + u, 0.5 * u - far);
    }
    const Mesh mesh = load(obj + "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
    for (const Vertex& vertex : mesh.vertices) {
      EXPECT_LT(std::max(std::abs(vertex.uv.x), std::abs(vertex.uv.y)), 16.0) << far;
      const glm::dvec3 corner = vertex.position + mesh.center;
      const double u = corner.x == 0.0 ? (corner.y == 0.0 ? 0.25 : 0.5) : (corner.y == 0.0 ? 1.25 : 1.75);
      const double expected = far == 1e300 ? 0.0 : u;
      EXPECT_NEAR(std::remainder(vertex.uv.x - expected, 1.0), 0.0, 1e-3) << far;
    }
  }
}

}  // namespace
}  // namespace speculum
