#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/model_files.hpp"

namespace speculum {

bool isFinite(const glm::dvec3& v);

// Corner of a face: indices from 0 into the elements of MeshBuilder added so far; -1: none.
struct FaceCorner {
  int position = -1;
  int texcoord = -1;
  int normal = -1;
  bool operator==(const FaceCorner&) const = default;
};

// Builds a mesh from the elements of a model file in their order.
class MeshBuilder {
 public:
  // `file` and `defects` must outlive the builder. Elements that are dropped or doubtful become defects of `file`.
  MeshBuilder(const std::filesystem::path& file, ModelDefects& defects) : file_(file), defects_(defects) {}

  void addPosition(const glm::dvec3& position) { positions_.push_back(position); }
  void addTexcoord(const glm::dvec2& texcoord) { texcoords_.push_back(texcoord); }
  void addNormal(const glm::dvec3& normal);  // any length
  // Sets the material of the faces that follow; -1: the default material.
  void setMaterial(int material);
  // Triangulates a face of at least three corners, which stands in this line of the file. Corners without a usable
  // normal get the normal of their triangle, corners without a finite texture coordinate get (0, 0). Drops faces with
  // positions that are not finite, triangles without an area, and faces that would take too long to triangulate.
  void addFace(std::span<const FaceCorner> corners, int line);

  size_t positionCount() const { return positions_.size(); }
  size_t texcoordCount() const { return texcoords_.size(); }
  size_t normalCount() const { return normals_.size(); }

  // Returns the mesh: its triangles are grouped by material in the order of first use; it may have none. Call it once,
  // last.
  Mesh finish(const std::function<Material(int)>& materialOf);

 private:
  struct CornerHash {
    size_t operator()(const FaceCorner& corner) const;
  };

  glm::dvec2 uvOf(const FaceCorner& corner) const;
  glm::dvec2 uvShiftOf(std::span<const FaceCorner> corners) const;
  void addTriangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c, int line);
  uint32_t vertexOf(const FaceCorner& corner, const glm::dvec3& triangleNormal);

  const std::filesystem::path& file_;
  ModelDefects& defects_;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::dvec2> texcoords_;
  std::vector<glm::dvec3> normals_;  // unit, or zero: unusable
  std::vector<glm::dvec3> points_;   // of the face being added
  glm::dvec2 uvShift_{0.0};          // subtracted from the texture coordinates of that face
  int material_ = -1;
  std::vector<uint32_t>* indices_ = nullptr;              // of material_; null until its next triangle
  std::map<int, std::vector<uint32_t>> materialIndices_;  // by material
  std::vector<int> materialOrder_;
  std::unordered_map<FaceCorner, uint32_t, CornerHash> sharedVertices_;
  std::vector<Vertex> vertices_;
  double cornerPairs_ = 0.0;  // sum of squared corner counts, over faces with many corners
};

}  // namespace speculum
