#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/model_files.hpp"

namespace speculum {

bool isFinite(const glm::dvec3& v);

// Completes a mesh that has its vertices, triangles and bounds: finds occluders and clusters, sorts triangles and
// counts flat vertices.
void finishShape(Mesh& mesh);

// Corner of a face: indices from 0 into the elements of MeshBuilder added so far; -1: none.
struct FaceCorner {
  int position = -1;
  int texcoord = -1;
  int normal = -1;
  bool operator==(const FaceCorner&) const = default;
};

// A material, and how it takes texture coordinates of the file: scale * (u, v) + offset.
struct PartMaterial {
  PartMaterial(Material ofPart, const glm::dvec2& scale = glm::dvec2(1.0), const glm::dvec2& offset = glm::dvec2(0.0))
      : material(std::move(ofPart)), textureScale(scale), textureOffset(offset) {}

  Material material;
  glm::dvec2 textureScale;
  glm::dvec2 textureOffset;
};

// Builds a mesh from the elements of a model file in their order.
class MeshBuilder {
 public:
  // `file`, `defects` and `faceKey` must outlive the builder. Faces that are dropped or doubtful become defects of
  // `file` with that key.
  MeshBuilder(const std::filesystem::path& file, ModelDefects& defects, std::string_view faceKey)
      : file_(file), defects_(defects), faceKey_(faceKey) {}

  // `color`: of the vertex, linear RGB and alpha. Positions without one are white if any has one.
  void addPosition(const glm::dvec3& position, const std::optional<glm::vec4>& color = {});
  void addTexcoord(const glm::dvec2& texcoord) { texcoords_.push_back(texcoord); }
  void addNormal(const glm::dvec3& normal);  // any length
  // Sets the material of the faces that follow; -1: the default material.
  void setMaterial(int material);
  // Sets the smoothing group of the faces that follow; 0: none. Corners of a group without a usable normal get the mean
  // of the normals of the triangles to which such corners at the position belong, weighted by the angles there. Where
  // the normals cancel, as on sheets with two sides, each triangle keeps its own.
  void setSmoothing(uint32_t group) { smoothing_ = group; }
  // Triangulates a face of at least three corners, which stands in this line of the file. Corners that have
  // neither a usable normal nor a smoothing group get the normal of their triangle, corners without a finite texture
  // coordinate get (0, 0). Drops faces with positions that are not finite or beyond 1e300, triangles without an area,
  // and faces that would take too long to triangulate.
  void addFace(std::span<const FaceCorner> corners, int line);

  size_t positionCount() const { return positions_.size(); }
  size_t texcoordCount() const { return texcoords_.size(); }
  size_t normalCount() const { return normals_.size(); }
  // For the function that finish() calls: say whether a triangle has vertex colors, and whether one of this material
  // has vertex colors with alpha below 1; return the mean color of this material's vertices, white without colors.
  bool hasColors() const { return colored_; }
  bool hasAlpha(int material) const;
  glm::dvec3 meanColor(int material) const;

  // Returns the mesh: its triangles are grouped by material in the order of first use; it may have none. Call it once,
  // last.
  Mesh finish(const std::function<PartMaterial(int)>& materialOf);

 private:
  struct CornerHash {
    size_t operator()(const FaceCorner& corner) const;
  };

  glm::dvec2 uvOf(const FaceCorner& corner) const;
  glm::dvec2 uvShiftOf(std::span<const FaceCorner> corners) const;
  void transformTexcoords(const PartMaterial& part, std::span<uint32_t> indices, Mesh& mesh);
  double addTriangle(const FaceCorner& a, const FaceCorner& b, const FaceCorner& c);
  uint32_t vertexOf(const FaceCorner& corner, const glm::dvec3& triangleNormal);
  uint32_t* flatVertexOf(const FaceCorner& corner);
  bool hasNormal(const FaceCorner& corner) const;
  int addToSmoothNormal(int position, const glm::dvec3& normal, double weight);
  void smoothNormals();
  uint32_t copyOf(uint32_t vertex);

  const std::filesystem::path& file_;
  ModelDefects& defects_;
  std::string_view faceKey_;
  std::vector<glm::dvec3> positions_;
  std::vector<glm::dvec2> texcoords_;
  std::vector<glm::dvec3> normals_;   // unit, or zero: unusable
  std::vector<glm::dvec3> points_;    // of the face being added
  glm::dvec2 uvShift_{0.0};           // subtracted from the texture coordinates of that face
  std::vector<glm::dvec2> uvShifts_;  // by vertex; may end before the last
  int material_ = -1;
  std::vector<uint32_t>* indices_ = nullptr;              // of material_; null until its next triangle
  std::map<int, std::vector<uint32_t>> materialIndices_;  // by material
  std::vector<int> materialOrder_;
  std::unordered_map<FaceCorner, uint32_t, CornerHash> sharedVertices_;
  std::vector<uint32_t> flatVertices_;  // by position: last vertex there without a normal, or ~0u; may end early
  std::vector<Vertex> vertices_;
  std::vector<glm::vec4> colors_;        // by position; may end before the last; empty: none
  std::vector<glm::vec4> vertexColors_;  // by vertex, as colors_
  bool colored_ = false;
  uint32_t smoothing_ = 0;
  std::unordered_map<uint64_t, int> smoothIndices_;       // by position and group: index into smoothNormals_
  std::vector<glm::dvec4> smoothNormals_;                 // sums, and in w the sum of the weights
  std::vector<std::pair<uint32_t, int>> smoothVertices_;  // vertices with an index into smoothNormals_
  double cornerPairs_ = 0.0;                              // sum of squared corner counts, over faces with many corners
};

}  // namespace speculum
