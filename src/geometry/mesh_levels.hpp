#pragma once

#include <functional>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// A mesh with fewer triangles.
struct MeshLevel {
  // Largest distance between the mesh and this level in either direction, part by part, in the unit of
  // Vertex::position. Measured at vertices and at points between them, in large parts at a fraction of both. Errors of
  // normals and texture coordinates are not included.
  double error = 0.0;
  IndexRange all;                     // of MeshLevels::indices
  std::vector<IndexRange> parts;      // of MeshLevels::indices, in the order of Mesh::parts
  std::vector<MeshCluster> clusters;  // of all parts; none of a small level
  bool solid = false;                 // see isSolid(); false unless the mesh is solid
};

// Levels from fine to coarse. Each has about seven tenths of the triangles of the one before, the first of those of the
// mesh; errors ascend and no part vanishes.
struct MeshLevels {
  // Each level has a range of its own, because lavapipe runs the vertex shader on all vertices between the least and
  // the greatest index of a draw.
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;  // into `vertices`
  std::vector<MeshLevel> levels;
};

// Simplifies by quadric error metrics (Garland and Heckbert 1997) with meshoptimizer. Edges between parts stay as they
// are, hard edges and seams of texture coordinates stay joined, and points in which three or more hard edges meet stay
// in place. A mesh with few triangles, or one that cannot be simplified, such as a box, has no levels. Throws
// std::runtime_error once `cancelled` returns true, which is called before each level.
MeshLevels simplified(const Mesh& mesh, const std::function<bool()>& cancelled = {});

// Says whether simplified() could have levels of a mesh, without making them.
bool mayHaveLevels(const Mesh& mesh);

// The levels of a mesh, made by the first call and kept in the mesh and its copies. May be called from any thread.
// A call that is cancelled throws as simplified() does, and the next one begins anew.
const MeshLevels& levelsOf(const Mesh& mesh, const std::function<bool()>& cancelled = {});

// Says whether levelsOf() returns at once. Copies of the mesh that are made afterwards share its levels.
bool levelsMade(const Mesh& mesh);

}  // namespace speculum
