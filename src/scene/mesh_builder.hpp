#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "geometry/mesh.hpp"
#include "scene/obj_scan.hpp"

namespace speculum {

// The lines of an OBJ file. Indices are 0-based and in range; -1: none.
struct ObjCorner {
  int position = -1;
  int texcoord = -1;
  int normal = -1;
};

struct ObjFace {
  size_t firstCorner = 0;
  size_t cornerCount = 0;
  int material = -1;
};

struct ObjGeometry {
  std::vector<glm::dvec3> positions;
  std::vector<glm::dvec2> texcoords;
  std::vector<glm::dvec3> normals;  // any length
  std::vector<ObjCorner> corners;
  std::vector<ObjFace> faces;
};

// Triangles of the faces, grouped by material in the order of first use. Drops faces with non-finite vertices and
// triangles without area with a warning that names `file` and their number. The mesh may come out empty.
Mesh buildMesh(const std::filesystem::path& file, const ObjGeometry& geometry, const ObjScan& scan,
               const std::function<Material(int)>& materialOf);

}  // namespace speculum
