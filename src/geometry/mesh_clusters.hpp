#pragma once

#include <span>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// Reorders the triangles of each part so that consecutive ones lie close together on the surface, by meshoptimizer's
// meshlets, and the vertices by their first use: clusters become small, and fewer vertices are shaded twice. A mesh
// that is too small for clusters stays as it is.
void sortIntoClusters(Mesh& mesh);

// Cuts the mesh's triangles in their order into clusters of 64. None for a mesh that is too small to gain by it.
std::vector<MeshCluster> clustersOf(const Mesh& mesh);
// Does the same for triangles that are not a Mesh; `parts` are ranges of `indices`.
std::vector<MeshCluster> clustersOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices,
                                    std::span<const IndexRange> parts);

}  // namespace speculum
