#include "scene/mesh_builder.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

#include "geometry/convex_faces.hpp"
#include "geometry/convex_mesh.hpp"
#include "geometry/mesh_clusters.hpp"
#include "geometry/triangulate.hpp"

namespace speculum {

namespace {

double largestComponent(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Whose square need not be within the range of a double.
double length(const glm::dvec3& v) {
  const double scale = largestComponent(v);
  return scale > 0.0 ? scale * glm::length(v / scale) : 0.0;
}

// Unit length whatever the magnitude; zero for zero.
glm::dvec3 unit(const glm::dvec3& v) {
  const double scale = largestComponent(v);
  return scale > 0.0 ? glm::normalize(v / scale) : glm::dvec3(0.0);
}

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

struct TriangleShape {
  glm::dvec3 normal{0.0};  // unit
  double quality = 0.0;    // 2 area / longest edge^2
};

TriangleShape shapeOf(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  // Relative to the largest component, so that neither squares nor products leave the range of a double.
  const double scale = std::max(largestComponent(ab), largestComponent(ac));
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    return {};
  }
  const glm::dvec3 u = ab / scale;
  const glm::dvec3 v = ac / scale;
  const glm::dvec3 area = glm::cross(u, v);
  const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(v - u, v - u)});
  return {unit(area), glm::length(area) / longest};
}

struct CornerHash {
  size_t operator()(const ObjCorner& c) const {
    size_t hash = static_cast<size_t>(c.position);
    hash = hash * 0x9e3779b97f4a7c15u + static_cast<size_t>(c.texcoord + 1);
    return hash * 0x9e3779b97f4a7c15u + static_cast<size_t>(c.normal + 1);
  }
};

struct CornerEqual {
  bool operator()(const ObjCorner& a, const ObjCorner& b) const {
    return a.position == b.position && a.texcoord == b.texcoord && a.normal == b.normal;
  }
};

class MeshBuilder {
 public:
  MeshBuilder(const ObjGeometry& geometry, const ObjScan& scan) : geometry_(geometry), scan_(scan) {
    normals_.reserve(geometry.normals.size());
    for (size_t i = 0; i < geometry.normals.size(); ++i) {
      normals_.push_back(scan.finiteNormal[i] && isFinite(geometry.normals[i]) ? unit(geometry.normals[i])
                                                                               : glm::dvec3(0.0));
    }
  }

  void add(const ObjFace& face) {
    points_.clear();
    for (size_t i = 0; i < face.cornerCount; ++i) {
      const ObjCorner& corner = geometry_.corners[face.firstCorner + i];
      if (!finitePosition(corner.position) || (corner.texcoord >= 0 && !finiteTexcoord(corner.texcoord))) {
        ++nonFinite_;
        return;
      }
      points_.push_back(geometry_.positions[corner.position]);
    }
    for (const std::array<int, 3>& triangle : triangulate(points_)) {
      addTriangle(face, triangle);
    }
  }

  Mesh finish(const std::function<Material(int)>& materialOf) {
    for (const int material : order_) {
      const std::vector<uint32_t>& indices = indices_[material];
      mesh_.parts.push_back({.firstIndex = static_cast<uint32_t>(mesh_.indices.size()),
                             .indexCount = static_cast<uint32_t>(indices.size()),
                             .material = materialOf(material)});
      mesh_.indices.insert(mesh_.indices.end(), indices.begin(), indices.end());
    }
    rebase();
    return std::move(mesh_);
  }

  void warn(const std::filesystem::path& file) const {
    if (nonFinite_ > 0) {
      spdlog::warn("{}: dropped {} faces with vertices that are not finite", file.string(), nonFinite_);
    }
    if (degenerate_ > 0) {
      spdlog::warn("{}: dropped {} degenerate triangles", file.string(), degenerate_);
    }
    if (slivers_ > 0) {
      spdlog::warn("{}: {} triangles are slivers, their normals are inexact", file.string(), slivers_);
    }
  }

 private:
  // The parser's arithmetic may round the largest doubles, which are finite to the scan, to infinity.
  bool finitePosition(int i) const { return scan_.finitePosition[i] && isFinite(geometry_.positions[i]); }
  bool finiteTexcoord(int i) const {
    return scan_.finiteTexcoord[i] && isFinite(glm::dvec3(geometry_.texcoords[i], 0.0));
  }

  void addTriangle(const ObjFace& face, const std::array<int, 3>& triangle) {
    const TriangleShape shape = shapeOf(points_[triangle[0]], points_[triangle[1]], points_[triangle[2]]);
    if (!(shape.quality >= 1e-10)) {
      ++degenerate_;
      return;
    }
    slivers_ += shape.quality < 1e-5;
    if (indices_.find(face.material) == indices_.end()) {
      order_.push_back(face.material);
    }
    std::vector<uint32_t>& indices = indices_[face.material];
    int flat = -1;
    for (const int i : triangle) {
      ObjCorner corner = geometry_.corners[face.firstCorner + i];
      if (corner.normal < 0 || normals_[corner.normal] == glm::dvec3(0.0)) {
        if (flat < 0) {
          flat = static_cast<int>(normals_.size());
          normals_.push_back(shape.normal);
        }
        corner.normal = flat;
      }
      indices.push_back(vertexOf(corner));
    }
  }

  uint32_t vertexOf(const ObjCorner& corner) {
    const auto [it, isNew] = vertexIndex_.try_emplace(corner, static_cast<uint32_t>(mesh_.vertices.size()));
    if (isNew) {
      mesh_.vertices.push_back({.position = geometry_.positions[corner.position],
                                .normal = normals_[corner.normal],
                                .uv = corner.texcoord < 0 ? glm::dvec2(0.0) : geometry_.texcoords[corner.texcoord]});
    }
    return it->second;
  }

  void rebase() {
    if (mesh_.vertices.empty()) {
      return;
    }
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const Vertex& vertex : mesh_.vertices) {
      low = glm::min(low, vertex.position);
      high = glm::max(high, vertex.position);
    }
    mesh_.center = 0.5 * low + 0.5 * high;
    for (Vertex& vertex : mesh_.vertices) {
      vertex.position -= mesh_.center;
      mesh_.halfExtent = glm::max(mesh_.halfExtent, glm::abs(vertex.position));
      mesh_.radius = std::max(mesh_.radius, length(vertex.position));
    }
  }

  const ObjGeometry& geometry_;
  const ObjScan& scan_;
  std::vector<glm::dvec3> normals_;  // unit or zero; those of the file, then those of flat triangles
  std::vector<glm::dvec3> points_;
  std::map<int, std::vector<uint32_t>> indices_;  // by material
  std::vector<int> order_;                        // of materials
  std::unordered_map<ObjCorner, uint32_t, CornerHash, CornerEqual> vertexIndex_;
  Mesh mesh_;
  size_t nonFinite_ = 0;   // faces
  size_t degenerate_ = 0;  // triangles
  size_t slivers_ = 0;     // triangles
};

// What hides a whole mirror is a wall, a door, a cupboard or a column: few triangles, or few of them large.
void findOccluders(Mesh& mesh) {
  constexpr size_t mostFaces = 32;
  constexpr size_t mostTriangles = 4096;
  std::vector<glm::dvec3> positions;
  positions.reserve(mesh.vertices.size());
  for (const Vertex& vertex : mesh.vertices) {
    positions.push_back(vertex.position);
  }
  mesh.faces = convexFaces(positions, mesh.indices, mostFaces, mostTriangles);
  mesh.convexVertices = convexVertices(positions, mesh.indices, mostTriangles);
}

}  // namespace

Mesh buildMesh(const std::filesystem::path& file, const ObjGeometry& geometry, const ObjScan& scan,
               const std::function<Material(int)>& materialOf) {
  MeshBuilder builder(geometry, scan);
  for (const ObjFace& face : geometry.faces) {
    builder.add(face);
  }
  builder.warn(file);
  Mesh mesh = builder.finish(materialOf);
  mesh.source = file;
  findOccluders(mesh);
  sortIntoClusters(mesh);
  mesh.clusters = clustersOf(mesh);
  return mesh;
}

}  // namespace speculum
