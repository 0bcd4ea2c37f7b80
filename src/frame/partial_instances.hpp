#pragma once

#include <cstdint>
#include <vector>

#include "frame/view.hpp"
#include "scene/mesh.hpp"

namespace speculum {

// Of Mesh::indices.
struct IndexRange {
  uint32_t first = 0;
  uint32_t count = 0;
  bool operator==(const IndexRange&) const = default;
};

// An instance of which a view sees only some of the mesh's clusters.
struct PartialInstance {
  int instance = 0;                // index into SceneState::instances
  std::vector<IndexRange> ranges;  // ascending, apart from each other
};

IndexRange allOf(const Mesh& mesh);

// The triangles of an instance that the view may see, cluster by cluster: one range of all of them unless that leaves
// out a part that is worth a draw call of its own; none if it sees none. Never leaves out a triangle that it sees.
std::vector<IndexRange> visibleRanges(const View& view, const InstanceState& instance, const Mesh& mesh);

}  // namespace speculum
