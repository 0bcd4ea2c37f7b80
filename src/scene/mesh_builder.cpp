#include "scene/mesh_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <glm/gtx/component_wise.hpp>
#include <tuple>

#include "geometry/bvh.hpp"
#include "geometry/convex_mesh.hpp"
#include "geometry/mesh.hpp"
#include "geometry/polygon.hpp"

namespace speculum {

namespace {

// Largest number of times that a texture is repeated along a triangle's edge. More repeats look like noise at any
// distance, and would leave the range of floats.
constexpr double mostRepeats = 1e9;

// Texture coordinates up to this size are exact enough as floats.
constexpr double nearEnough = 16.0;

// FaceCorner::normal of a corner with the smooth normal 0; further ones count downwards.
constexpr int firstSmooth = -2;

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

// Says whether two neighbouring corners differ by at most 1.5e-6 times the largest coordinate, the error of numbers
// with six digits and of sums of a dozen floats. Programs that know no better write such faces at the poles of spheres,
// where nobody can mend them.
bool hasEqualCorners(const std::vector<glm::dvec3>& corners) {
  constexpr double precision = 1.5e-6;
  double largest = 0.0;
  for (const glm::dvec3& corner : corners) {
    largest = std::max(largest, glm::compMax(glm::abs(corner)));
  }
  for (size_t i = 0; i < corners.size(); ++i) {
    if (glm::compMax(glm::abs(corners[i] - corners[(i + 1) % corners.size()])) <= precision * largest) {
      return true;
    }
  }
  return false;
}

// Returns whole numbers to subtract from texture coordinates, of which `largest` has the largest sizes: 0 if these are
// exact enough.
glm::dvec2 shiftOf(const glm::dvec2& largest, const glm::dvec2& first) {
  return std::max(largest.x, largest.y) > nearEnough ? nearEnough * glm::floor(first / nearEnough) : glm::dvec2(0.0);
}

// Returns the angle at `a`, radians.
double angleAt(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 u = unit(b - a);
  const glm::dvec3 v = unit(c - a);
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
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

// Finds the parts that may hide mirrors, flat faces and a convex mesh. Objects that hide mirrors, such as walls, doors
// and cupboards, have few triangles or a few large ones.
void findHiders(Mesh& mesh) {
  constexpr size_t mostFaces = 32;
  constexpr size_t mostTriangles = 4096;
  if (mesh.indices.size() > 3 * mostTriangles) {
    return;
  }
  const std::vector<glm::dvec3> positions = mesh.positions();
  for (std::vector<glm::dvec3>& face : convexFaces(positions, mesh.indices, mostFaces, mostTriangles)) {
    mesh.faces.emplace_back(std::move(face));
  }
  mesh.convex = convexMesh(positions, mesh.indices, mostTriangles);
}

// Another thread finds out about a large mesh, which takes as long as sorting it into clusters.
std::future<bool> findSolid(const Mesh& mesh) {
  constexpr size_t fewIndices = 3 * 4096;
  if (mesh.indices.size() > 3 * mostSolidTriangles) {
    return {};
  }
  return std::async(
      mesh.indices.size() > fewIndices ? std::launch::async | std::launch::deferred : std::launch::deferred,
      [positions = mesh.positions(), indices = mesh.indices]() mutable {
        return isSolid(std::move(positions), std::move(indices));
      });
}

}  // namespace

void finishShape(Mesh& mesh) {
  findHiders(mesh);
  std::future<bool> solid = findSolid(mesh);
  sortIntoClusters(mesh);
  mesh.clusters = clustersOf(mesh);
  countFlat(mesh);
  mesh.solid = solid.valid() && solid.get();
}

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

size_t MeshBuilder::CornerHash::operator()(const FaceCorner& corner) const {
  size_t hash = static_cast<size_t>(corner.position);
  hash = hash * 0x9e3779b97f4a7c15u + static_cast<size_t>(corner.texcoord + 1);
  return hash * 0x9e3779b97f4a7c15u + static_cast<size_t>(corner.normal + 1);
}

void MeshBuilder::addPosition(const glm::dvec3& position, const std::optional<glm::vec4>& color) {
  if (color) {
    colors_.resize(positions_.size(), glm::vec4(1.0f));
    colors_.push_back(*color);
  }
  positions_.push_back(position);
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
  constexpr double farthest = 1e300;  // sums and lengths of positions have to be finite too
  points_.clear();
  for (const FaceCorner& corner : corners) {
    const glm::dvec3& position = positions_[corner.position];
    if (!isFinite(position) || glm::compMax(glm::abs(position)) >= farthest) {
      defects_.add(file_, line, faceKey_, "has a vertex that is not finite or beyond 1e300, the face is left out")
          .costsTriangles = true;
      return;
    }
    points_.push_back(position);
  }
  if (corners.size() > fewCorners && !isFan(points_)) {
    cornerPairs_ += static_cast<double>(corners.size()) * static_cast<double>(corners.size());
    if (cornerPairs_ > mostPairs) {
      defects_
          .add(file_, line, faceKey_,
               "has too many corners for a face that is no fan about its first, the face is left out")
          .costsTriangles = true;
      return;
    }
  }
  uvShift_ = uvShiftOf(corners);
  // A face without an area draws nothing, and exporters write them at the poles of spheres. Of a face with more
  // corners, cutting may make slivers.
  double quality = 0.0;
  for (const auto& [a, b, c] : triangulate(points_)) {
    quality = std::max(quality, addTriangle(corners[a], corners[b], corners[c]));
  }
  if (quality > 0.0 && quality < 1e-5 && !hasEqualCorners(points_)) {
    defects_.add(file_, line, faceKey_, "a face is a sliver, its normal is inexact");
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
  return shiftOf(largest, uvOf(corners[0]));
}

// Gives the part's triangles vertices of their own with the texture coordinates that its material means.
void MeshBuilder::transformTexcoords(const PartMaterial& part, std::span<uint32_t> indices, Mesh& mesh) {
  constexpr double finite = 1e300;
  std::map<std::tuple<uint32_t, double, double>, uint32_t> made;  // by vertex and shift
  for (size_t first = 0; first < indices.size(); first += 3) {
    std::array<glm::dvec2, 3> uv;
    glm::dvec2 largest(0.0);
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t vertex = indices[first + k];
      const glm::dvec2 shift = vertex < uvShifts_.size() ? uvShifts_[vertex] : glm::dvec2(0.0);
      const glm::dvec2 named = mesh.vertices[vertex].uv + shift;
      uv[k] = glm::clamp(part.textureScale * named + part.textureOffset, -finite, finite);
      largest = glm::max(largest, glm::abs(uv[k]));
    }
    const glm::dvec2 shift = part.material.clamps ? glm::dvec2(0.0) : shiftOf(largest, uv[0]);
    for (size_t k = 0; k < 3; ++k) {
      uint32_t& vertex = indices[first + k];
      const auto next = static_cast<uint32_t>(mesh.vertices.size());
      const auto [found, isNew] = made.try_emplace({vertex, shift.x, shift.y}, next);
      if (isNew) {
        mesh.vertices.push_back(mesh.vertices[vertex]);
        mesh.vertices.back().uv = glm::clamp(uv[k] - shift, -mostRepeats, mostRepeats);
        if (colored_) {
          vertexColors_.push_back(glm::vec4(vertexColors_[vertex]));
        }
      }
      vertex = found->second;
    }
  }
}

glm::dvec2 MeshBuilder::uvOf(const FaceCorner& corner) const {
  const glm::dvec2 uv = corner.texcoord < 0 ? glm::dvec2(0.0) : texcoords_[corner.texcoord];
  return isFinite(glm::dvec3(uv, 0.0)) ? uv : glm::dvec2(0.0);
}

// Returns the triangle's quality; 0 if it has no area and is left out.
double MeshBuilder::addTriangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c) {
  const TriangleShape shape = shapeOf(positions_[a.position], positions_[b.position], positions_[c.position]);
  if (!(shape.quality >= 1e-10)) {
    return 0.0;
  }
  if (indices_ == nullptr) {
    const auto [found, isNew] = materialIndices_.try_emplace(material_);
    indices_ = &found->second;
    if (isNew) {
      materialOrder_.push_back(material_);
    }
  }
  std::array corners{a, b, c};
  for (size_t i = 0; i < 3; ++i) {
    if (smoothing_ != 0 && !hasNormal(corners[i])) {
      const int position = corners[i].position;
      const double angle = angleAt(positions_[position], positions_[corners[(i + 1) % 3].position],
                                   positions_[corners[(i + 2) % 3].position]);
      corners[i].normal = addToSmoothNormal(position, shape.normal, angle);
    }
    indices_->push_back(vertexOf(corners[i], shape.normal));
  }
  return shape.quality;
}

bool MeshBuilder::hasNormal(const FaceCorner& corner) const {
  return corner.normal >= 0 && normals_[corner.normal] != glm::dvec3(0.0);
}

// Returns the FaceCorner::normal of a corner of the present smoothing group.
int MeshBuilder::addToSmoothNormal(int position, const glm::dvec3& normal, double weight) {
  const uint64_t key = uint64_t{smoothing_} << 32 | static_cast<uint32_t>(position);
  const auto [found, isNew] = smoothIndices_.try_emplace(key, static_cast<int>(smoothNormals_.size()));
  if (isNew) {
    smoothNormals_.emplace_back(0.0);
  }
  smoothNormals_[found->second] += weight * glm::dvec4(normal, 1.0);
  return firstSmooth - found->second;
}

void MeshBuilder::smoothNormals() {
  constexpr double leastShare = 1e-3;  // of the weights, that does not cancel
  std::vector<bool> cancelled(smoothVertices_.empty() ? 0 : vertices_.size());
  for (const auto& [vertex, index] : smoothVertices_) {
    const glm::dvec3 sum(smoothNormals_[index]);
    cancelled[vertex] = !(glm::length(sum) > leastShare * smoothNormals_[index].w);
    vertices_[vertex].normal = cancelled[vertex] ? glm::dvec3(0.0) : glm::normalize(sum);
  }
  if (std::ranges::find(cancelled, true) == cancelled.end()) {
    return;
  }
  for (auto& entry : materialIndices_) {
    std::vector<uint32_t>& indices = entry.second;
    for (size_t first = 0; first < indices.size(); first += 3) {
      const auto position = [&](size_t k) { return vertices_[indices[first + k]].position; };
      const glm::dvec3 own = shapeOf(position(0), position(1), position(2)).normal;
      for (size_t k = first; k < first + 3; ++k) {
        if (indices[k] < cancelled.size() && cancelled[indices[k]]) {
          const bool taken = vertices_[indices[k]].normal != glm::dvec3(0.0);  // by a triangle before
          indices[k] = taken ? copyOf(indices[k]) : indices[k];
          vertices_[indices[k]].normal = own;
        }
      }
    }
  }
}

uint32_t MeshBuilder::copyOf(uint32_t vertex) {
  const auto index = static_cast<uint32_t>(vertices_.size());
  vertices_.push_back(Vertex(vertices_[vertex]));
  if (vertex < uvShifts_.size()) {
    uvShifts_.resize(index, glm::dvec2(0.0));
    uvShifts_.push_back(glm::dvec2(uvShifts_[vertex]));
  }
  if (vertex < vertexColors_.size()) {
    vertexColors_.resize(index, glm::vec4(1.0f));
    vertexColors_.push_back(glm::vec4(vertexColors_[vertex]));
  }
  return index;
}

// Returns where the vertex stands that triangles share at a corner without a normal; null if each gets a vertex of its
// own, with its normal. Small models get these: to share saves them little, and their normals are of the file's
// numbers.
uint32_t* MeshBuilder::flatVertexOf(const FaceCorner& corner) {
  constexpr size_t fewVertices = 1 << 17;
  if (vertices_.size() < fewVertices || uvShift_ != glm::dvec2(0.0)) {
    return nullptr;
  }
  flatVertices_.resize(std::max(flatVertices_.size(), positions_.size()), ~0u);
  return &flatVertices_[corner.position];
}

uint32_t MeshBuilder::vertexOf(const FaceCorner& corner, const glm::dvec3& triangleNormal) {
  const auto index = static_cast<uint32_t>(vertices_.size());
  const bool given = hasNormal(corner);
  const bool smooth = corner.normal <= firstSmooth;
  const glm::dvec2 uv = glm::clamp(uvOf(corner) - uvShift_, -mostRepeats, mostRepeats);
  if (given || smooth) {
    const auto [found, isNew] = sharedVertices_.try_emplace(corner, index);
    if (!isNew && vertices_[found->second].uv == uv) {
      return found->second;
    }
    found->second = index;
  }
  uint32_t* flat = given || smooth ? nullptr : flatVertexOf(corner);
  if (flat) {
    if (*flat != ~0u && vertices_[*flat].uv == uv) {
      return *flat;
    }
    *flat = index;
  }
  const glm::dvec3 own = flat ? glm::dvec3(0.0) : triangleNormal;
  vertices_.push_back(
      {.position = positions_[corner.position], .normal = given ? normals_[corner.normal] : own, .uv = uv});
  if (uvShift_ != glm::dvec2(0.0)) {
    uvShifts_.resize(index, glm::dvec2(0.0));
    uvShifts_.push_back(uvShift_);
  }
  if (smooth) {
    smoothVertices_.emplace_back(index, firstSmooth - corner.normal);
  }
  if (static_cast<size_t>(corner.position) < colors_.size()) {
    vertexColors_.resize(index, glm::vec4(1.0f));
    vertexColors_.push_back(colors_[corner.position]);
  }
  return index;
}

bool MeshBuilder::hasAlpha(int material) const {
  return colored_ && std::ranges::any_of(materialIndices_.at(material),
                                         [&](uint32_t vertex) { return vertexColors_[vertex].a < 1.0f; });
}

glm::dvec3 MeshBuilder::meanColor(int material) const {
  if (!colored_) {
    return glm::dvec3(1.0);
  }
  const std::vector<uint32_t>& indices = materialIndices_.at(material);
  glm::dvec3 sum(0.0);
  for (const uint32_t vertex : indices) {
    sum += glm::dvec3(vertexColors_[vertex]);
  }
  return sum / static_cast<double>(indices.size());
}

Mesh MeshBuilder::finish(const std::function<PartMaterial(int)>& materialOf) {
  smoothNormals();
  colored_ = !vertexColors_.empty();
  vertexColors_.resize(colored_ ? vertices_.size() : 0, glm::vec4(1.0f));
  Mesh mesh{.source = file_, .vertices = std::move(vertices_)};
  std::vector<Material> materials;
  for (const int index : materialOrder_) {
    const PartMaterial part = materialOf(index);
    materials.push_back(part.material);
    if (part.material.clamps || part.textureScale != glm::dvec2(1.0) || part.textureOffset != glm::dvec2(0.0)) {
      transformTexcoords(part, materialIndices_[index], mesh);
    }
  }
  mesh.colors = std::move(vertexColors_);
  const auto repeatsOften = [&](uint32_t vertex) {
    return glm::compMax(glm::abs(mesh.vertices[vertex].uv)) > 2.0 * nearEnough;
  };
  size_t usual = 0;  // indices of triangles that do not repeat their texture often
  for (const bool repeats : {false, true}) {
    for (size_t i = 0; i < materials.size(); ++i) {
      const auto first = static_cast<uint32_t>(mesh.indices.size());
      const std::vector<uint32_t>& indices = materialIndices_[materialOrder_[i]];
      const bool mayRepeat =
          !materials[i].clamps && (materials[i].diffuseTexture >= 0 || materials[i].opacityTexture >= 0);
      for (auto triangle = indices.begin(); triangle != indices.end(); triangle += 3) {
        if (repeats == (mayRepeat && std::any_of(triangle, triangle + 3, repeatsOften))) {
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
  colors_ = {};
  uvShifts_ = {};
  smoothIndices_ = {};
  smoothNormals_ = {};
  smoothVertices_ = {};
  materialIndices_.clear();
  sharedVertices_ = {};
  flatVertices_ = {};
  rebase(mesh);
  finishShape(mesh);
  return mesh;
}

}  // namespace speculum
