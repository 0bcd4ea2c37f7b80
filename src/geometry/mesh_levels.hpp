#pragma once

#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// A mesh with fewer triangles.
struct MeshLevel {
  // In the unit of Vertex::position: the farthest that a point of the mesh lies from this level's triangles of the same
  // part, or one of these from the mesh's, measured at vertices and at points between them; in large parts at every so
  // manieth. What normals and texture coordinates are off by is not in it.
  double error = 0.0;
  IndexRange all;                     // of MeshLevels::indices
  std::vector<IndexRange> parts;      // of MeshLevels::indices, in the order of Mesh::parts
  std::vector<MeshCluster> clusters;  // likewise, of all of it; none of a small one
};

// Each has about seven tenths of the triangles of the one before, the first of those of the mesh; errors ascend and no
// part vanishes.
struct MeshLevels {
  // Each level has a run of its own: lavapipe, which keeps few vertices, runs the vertex shader on all between the
  // least and the greatest index of a draw.
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;  // into `vertices`
  std::vector<MeshLevel> levels;
};

// Quadric error metrics (Garland and Heckbert 1997), by meshoptimizer. Edges between parts stay as they are, hard edges
// and seams of texture coordinates stay joined, and what three or more hard edges meet in stays in its place. No levels
// of a mesh with few triangles or one that cannot be simplified, such as a box.
MeshLevels simplified(const Mesh& mesh);

// Made when it is first asked for, and kept in the mesh; from any thread.
const MeshLevels& levelsOf(const Mesh& mesh);

}  // namespace speculum
