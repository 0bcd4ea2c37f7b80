#include "scene/mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>

#include "geometry/bvh.hpp"
#include "geometry/convex_mesh.hpp"
#include "geometry/solid_mesh.hpp"
#include "geometry/triangulate.hpp"

namespace speculum {

namespace {

// Largest number of times that a texture is repeated along a triangle's edge. More repeats look like noise at any
// distance, and would leave the range of floats.
constexpr double mostRepeats = 1e9;

// Texture coordinates up to this size are exact enough as floats.
constexpr double nearEnough = 16.0;

// Most triangles of a mesh whose texture coordinates are computed anew in each frame (Mesh::repeats).
constexpr size_t mostRepeatingTriangles = 1 << 16;

// Returns the length of a vector, even if its square leaves the range of a double.
double length(const glm::dvec3& v) {
  const double scale = glm::compMax(glm::abs(v));
  return scale > 0.0 ? scale * glm::length(v / scale) : 0.0;
}

// Returns the direction of a vector of any length; zero for zero.
glm::dvec3 unit(const glm::dvec3& v) {
  const double scale = glm::compMax(glm::abs(v));
  return scale > 0.0 ? glm::normalize(v / scale) : glm::dvec3(0.0);
}

struct TriangleShape {
  glm::dvec3 normal{0.0};  // unit
  double quality = 0.0;    // 2 area / longest edge^2
};

TriangleShape shapeOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  // Divides by the largest component, so that neither squares nor products leave the range of a double.
  const double scale = glm::compMax(glm::max(glm::abs(ab), glm::abs(ac)));
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    return {};
  }
  const glm::dvec3 u = ab / scale;
  const glm::dvec3 v = ac / scale;
  const glm::dvec3 area = glm::cross(u, v);
  const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(v - u, v - u)});
  return {unit(area), glm::length(area) / longest};
}

void rebase(Mesh& mesh) {
  if (mesh.vertices.empty()) {
    return;
  }
  Bounds box;
  for (const Vertex& vertex : mesh.vertices) {
    box.add(vertex.position);
  }
  mesh.center = box.center();
  for (Vertex& vertex : mesh.vertices) {
    vertex.position -= mesh.center;
    mesh.radius = std::max(mesh.radius, length(vertex.position));
  }
  // Scales only models of extreme sizes; the bounds leave room for products of floats. Other models keep their numbers.
  constexpr double largestRadius = 1e12;
  if (mesh.radius > largestRadius || mesh.radius < 1.0 / largestRadius) {
    mesh.unit = std::exp2(std::floor(std::log2(mesh.radius)));
  }
  mesh.radius /= mesh.unit;
  for (Vertex& vertex : mesh.vertices) {
    vertex.position /= mesh.unit;
    mesh.halfExtent = glm::max(mesh.halfExtent, glm::abs(vertex.position));
  }
}

// Finds the parts that may hide mirrors, flat faces and a convex mesh, and whether the mesh is solid. Objects that hide
// mirrors, such as walls, doors and cupboards, have few triangles or a few large ones.
void findShape(Mesh& mesh) {
  constexpr size_t mostFaces = 32;
  constexpr size_t mostTriangles = 4096;
  if (mesh.indices.size() > 3 * std::max(mostTriangles, mostSolidTriangles)) {
    return;
  }
  std::vector<glm::dvec3> positions(mesh.vertices.size());
  std::ranges::transform(mesh.vertices, positions.begin(), &Vertex::position);
  mesh.faces = convexFaces(positions, mesh.indices, mostFaces, mostTriangles);
  mesh.convex = convexMesh(positions, mesh.indices, mostTriangles);
  mesh.solid = isSolid(positions, mesh.indices);
}

}  // namespace

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

size_t MeshBuilder::CornerHash::operator()(const FaceCorner& corner) const {
  size_t hash = static_cast<size_t>(corner.position);
  hash = hash * 0x9e3779b97f4a7c15u + static_cast<size_t>(corner.texcoord + 1);
  return hash * 0x9e3779b97f4a7c15u + static_cast<size_t>(corner.normal + 1);
}

void MeshBuilder::addNormal(const glm::dvec3& normal) {
  normals_.push_back(isFinite(normal) ? unit(normal) : glm::dvec3(0.0));
}

void MeshBuilder::setMaterial(int material) {
  material_ = material;
  indices_ = nullptr;
}

void MeshBuilder::addFace(std::span<const FaceCorner> corners, int line) {
  // Triangulation of a polygon that is not convex takes time in the square of its corners.
  constexpr size_t fewCorners = 1000;
  constexpr double mostPairs = 1 << 30;
  points_.clear();
  for (const FaceCorner& corner : corners) {
    if (!isFinite(positions_[corner.position])) {
      defects_.add(file_, line, "f", "has a vertex that is not finite, the face is left out");
      return;
    }
    points_.push_back(positions_[corner.position]);
  }
  if (corners.size() > fewCorners && !isFan(points_)) {
    cornerPairs_ += static_cast<double>(corners.size()) * static_cast<double>(corners.size());
    if (cornerPairs_ > mostPairs) {
      defects_.add(file_, line, "f",
                   "has too many corners for a face that is no fan about its first, the face is left out");
      return;
    }
  }
  uvShift_ = uvShiftOf(corners);
  for (const auto& [a, b, c] : triangulate(points_)) {
    addTriangle(corners[a], corners[b], corners[c], line);
  }
}

// Returns whole numbers to subtract from texture coordinates so large that a float would lose more than 1/500 of a
// texel of a texture 2048 texels wide. The texture repeats, so the picture stays the same. Neighbouring faces mostly
// get the same numbers, and so share vertices.
glm::dvec2 MeshBuilder::uvShiftOf(std::span<const FaceCorner> corners) const {
  glm::dvec2 largest(0.0);
  for (const FaceCorner& corner : corners) {
    largest = glm::max(largest, glm::abs(uvOf(corner)));
  }
  return std::max(largest.x, largest.y) > nearEnough ? nearEnough * glm::floor(uvOf(corners[0]) / nearEnough)
                                                     : glm::dvec2(0.0);
}

glm::dvec2 MeshBuilder::uvOf(const FaceCorner& corner) const {
  const glm::dvec2 uv = corner.texcoord < 0 ? glm::dvec2(0.0) : texcoords_[corner.texcoord];
  return isFinite(glm::dvec3(uv, 0.0)) ? uv : glm::dvec2(0.0);
}

void MeshBuilder::addTriangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c, int line) {
  const TriangleShape shape = shapeOf(positions_[a.position], positions_[b.position], positions_[c.position]);
  if (!(shape.quality >= 1e-10)) {
    defects_.add(file_, line, "f", "a triangle without an area is left out");
    return;
  }
  if (shape.quality < 1e-5) {
    defects_.add(file_, line, "f", "a triangle is a sliver, its normal is inexact");
  }
  if (indices_ == nullptr) {
    const auto [found, isNew] = materialIndices_.try_emplace(material_);
    indices_ = &found->second;
    if (isNew) {
      materialOrder_.push_back(material_);
    }
  }
  for (const FaceCorner& corner : {a, b, c}) {
    indices_->push_back(vertexOf(corner, shape.normal));
  }
}

uint32_t MeshBuilder::vertexOf(const FaceCorner& corner, const glm::dvec3& triangleNormal) {
  const auto index = static_cast<uint32_t>(vertices_.size());
  const bool usable = corner.normal >= 0 && normals_[corner.normal] != glm::dvec3(0.0);
  const glm::dvec2 uv = glm::clamp(uvOf(corner) - uvShift_, -mostRepeats, mostRepeats);
  if (usable) {
    const auto [found, isNew] = sharedVertices_.try_emplace(corner, index);
    if (!isNew && vertices_[found->second].uv == uv) {
      return found->second;
    }
    found->second = index;
  }
  vertices_.push_back(
      {.position = positions_[corner.position], .normal = usable ? normals_[corner.normal] : triangleNormal, .uv = uv});
  return index;
}

Mesh MeshBuilder::finish(const std::function<Material(int)>& materialOf) {
  Mesh mesh{.source = file_, .vertices = std::move(vertices_)};
  std::vector<Material> materials;
  std::ranges::transform(materialOrder_, std::back_inserter(materials), materialOf);
  const auto repeatsOften = [&](uint32_t vertex) {
    return glm::compMax(glm::abs(mesh.vertices[vertex].uv)) > 2.0 * nearEnough;
  };
  size_t usual = 0;  // indices of triangles that do not repeat their texture often
  for (const bool repeats : {false, true}) {
    for (size_t i = 0; i < materials.size(); ++i) {
      const auto first = static_cast<uint32_t>(mesh.indices.size());
      const std::vector<uint32_t>& indices = materialIndices_[materialOrder_[i]];
      for (auto triangle = indices.begin(); triangle != indices.end(); triangle += 3) {
        if (repeats == (materials[i].diffuseTexture >= 0 && std::any_of(triangle, triangle + 3, repeatsOften))) {
          mesh.indices.insert(mesh.indices.end(), triangle, triangle + 3);
        }
      }
      if (const auto count = static_cast<uint32_t>(mesh.indices.size()) - first; count > 0) {
        mesh.parts.push_back({.firstIndex = first, .indexCount = count, .material = materials[i]});
      }
    }
    usual = repeats ? usual : mesh.indices.size();
  }
  const size_t repeating = (mesh.indices.size() - usual) / 3;
  mesh.repeats = repeating <= mostRepeatingTriangles ? static_cast<uint32_t>(repeating) : 0;
  // Gives the memory back before the shape of the mesh is looked for.
  positions_ = {};
  texcoords_ = {};
  normals_ = {};
  materialIndices_.clear();
  sharedVertices_ = {};
  rebase(mesh);
  findShape(mesh);
  sortIntoClusters(mesh);
  mesh.clusters = clustersOf(mesh);
  return mesh;
}

}  // namespace speculum
