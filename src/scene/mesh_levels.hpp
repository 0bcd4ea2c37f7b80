#pragma once

#include <vector>

#include "scene/mesh.hpp"

namespace speculum {

// A mesh with fewer triangles.
struct MeshLevel {
  // In the unit of Vertex::position: the farthest that a vertex of the mesh lies from this level's triangles of the
  // same part, or one of their centroids and edges' midpoints from the mesh's. Normals and texture coordinates are
  // those of the vertices that are left; what they are off by between them is not in it.
  double error = 0.0;
  IndexRange all;                     // of MeshLevels::indices
  std::vector<IndexRange> parts;      // of MeshLevels::indices, in the order of Mesh::parts
  std::vector<MeshCluster> clusters;  // likewise, of all of it; none of a small one
};

// Each has about seven tenths of the triangles of the one before, the first of those of the mesh; errors ascend.
struct MeshLevels {
  // Those of the coarsest level come first, and every level uses the first few: lavapipe, which keeps few vertices,
  // runs the vertex shader on all between the least and the greatest index of a draw.
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;  // into `vertices`
  std::vector<MeshLevel> levels;
};

// Quadric error metrics (Garland and Heckbert 1997), by meshoptimizer. Edges between parts stay as they are, so that no
// gap opens there; uv seams and hard edges stay closed. No levels of a mesh with few triangles or one that cannot be
// simplified.
MeshLevels simplified(const Mesh& mesh);

// Made when it is first asked for, and kept in the mesh; from any thread.
const MeshLevels& levelsOf(const Mesh& mesh);

}  // namespace speculum
