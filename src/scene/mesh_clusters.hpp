#pragma once

#include <vector>

#include "scene/mesh.hpp"

namespace speculum {

// The mesh's triangles in their order, cut into runs that lie close together. None for a mesh too small to be worth it.
std::vector<MeshCluster> clustersOf(const Mesh& mesh);

}  // namespace speculum
