#include "edit/mesh_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "geometry/weld.hpp"

namespace speculum {

namespace {

constexpr size_t mostPoints = 512;
constexpr size_t mostTriangles = 50'000;

std::vector<MeshEdge> edgesOf(const Mesh& mesh) {
  PointWelder welder;                                                    // normals and textures split vertices
  std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> third;  // points beside an edge
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<uint32_t, 3> corner{};
    for (size_t k = 0; k < 3; ++k) {
      corner[k] = welder.weld(mesh.vertices[mesh.indices[i + k]].position);
    }
    const bool flat = corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
    for (size_t k = 0; !flat && k < 3; ++k) {
      third[std::minmax({corner[k], corner[(k + 1) % 3]})].push_back(corner[(k + 2) % 3]);
    }
  }
  const std::vector<glm::dvec3>& at = welder.points();
  std::vector<MeshEdge> edges;
  edges.reserve(third.size());
  for (const auto& [ends, beside] : third) {
    edges.push_back({at[ends.first], at[ends.second], at[beside.front()], at[beside.back()], beside.size() != 2});
  }
  return edges;
}

// Returns all vertices of a small mesh, else the farthest ones in directions on a Fibonacci lattice: Gonzalez,
// "Measurement of Areas on a Sphere Using Fibonacci and Latitude-Longitude Lattices" (2010).
std::vector<glm::dvec3> outlinePoints(const Mesh& mesh) {
  if (mesh.vertices.size() <= mostPoints) {
    std::vector<glm::dvec3> all(mesh.vertices.size());
    std::ranges::transform(mesh.vertices, all.begin(), &Vertex::position);
    return all;
  }
  std::set<size_t> farthest;
  for (size_t i = 0; i < mostPoints; ++i) {
    const double y = 1.0 - (2.0 * i + 1.0) / mostPoints;
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * static_cast<double>(i);
    const glm::dvec3 d(std::sqrt(1.0 - y * y) * std::cos(angle), y, std::sqrt(1.0 - y * y) * std::sin(angle));
    const auto most = std::ranges::max_element(mesh.vertices, [&](const Vertex& a, const Vertex& b) {
      return glm::dot(a.position, d) < glm::dot(b.position, d);
    });
    farthest.insert(static_cast<size_t>(most - mesh.vertices.begin()));
  }
  std::vector<glm::dvec3> points;
  for (const size_t i : farthest) {
    points.push_back(mesh.vertices[i].position);
  }
  return points;
}

}  // namespace

bool MeshEdge::outlines(const glm::dvec3& eye) const {
  const glm::dvec3 normal = glm::cross(b - a, eye - a);
  return border || glm::dot(normal, left - a) * glm::dot(normal, right - a) >= 0.0;
}

MeshOutline meshOutline(const Mesh& mesh) {
  const bool small = mesh.indices.size() <= 3 * mostTriangles;
  return {.points = outlinePoints(mesh), .edges = small ? edgesOf(mesh) : std::vector<MeshEdge>()};
}

}  // namespace speculum
