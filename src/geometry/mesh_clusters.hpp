#pragma once

#include <span>
#include <vector>

#include "geometry/mesh.hpp"

namespace speculum {

// Reorders the triangles of each part so that those of a run lie close together on the surface, by meshoptimizer's
// meshlets, and the vertices by their first use: clusters become small, and fewer vertices are shaded twice. A mesh
// that is too small for clusters stays as it is.
void sortIntoClusters(Mesh& mesh);

// The mesh's triangles in their order, cut into runs that lie close together. None for a mesh too small to be worth it.
std::vector<MeshCluster> clustersOf(const Mesh& mesh);
// The same of other triangles; `parts` are ranges of `indices`.
std::vector<MeshCluster> clustersOf(std::span<const Vertex> vertices, std::span<const uint32_t> indices,
                                    std::span<const IndexRange> parts);

}  // namespace speculum
