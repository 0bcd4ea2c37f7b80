#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "frame/view.hpp"
#include "geometry/mesh.hpp"

namespace speculum {

// An instance of which a view sees only some of the mesh's clusters.
struct PartialInstance {
  int instance = 0;                // index into SceneState::instances
  std::vector<IndexRange> ranges;  // of the indices of what is drawn of it; ascending, apart from each other
};

// An instance of which a pass draws fewer triangles: reflection.mesh_error.
struct SimplifiedInstance {
  int instance = 0;  // index into SceneState::instances
  int level = 0;     // index into MeshLevels::levels
};

// Of an ascending list, that of the instance; null if there is none.
const PartialInstance* partOf(const std::vector<PartialInstance>& partial, int instance);

IndexRange allOf(const Mesh& mesh);

// The triangles of an instance that the view may see, cluster by cluster: one range of all of them unless that leaves
// out a part that is worth a draw call of its own; none if it sees none. Never leaves out a triangle that it sees.
std::vector<IndexRange> visibleRanges(const View& view, const InstanceState& instance, const Mesh& mesh);
// The same of triangles within the mesh's box that are drawn in its place: `all` of them, in these clusters.
std::vector<IndexRange> visibleRanges(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent,
                                      const IndexRange& all, std::span<const MeshCluster> clusters);
uint32_t indexCount(std::span<const IndexRange> ranges);

}  // namespace speculum
