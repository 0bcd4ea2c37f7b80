#pragma once

#include <cstdint>
#include <span>

#include "geometry/mesh.hpp"
#include "geometry/recycled_memory.hpp"
#include "plan/view.hpp"

namespace speculum {

// An instance that a view sees only in part: some of its mesh's clusters.
struct PartialInstance {
  int instance = 0;                   // index into SceneState::instances
  RecycledVector<IndexRange> ranges;  // indices that are drawn; ascending and disjoint
};

// Finds the instance in an ascending list; null if it is not there.
const PartialInstance* partOf(const RecycledVector<PartialInstance>& partial, int instance);

IndexRange allOf(const Mesh& mesh);

// Says whether the view may see a part of the instance's bounding sphere and of its mesh's box of that half extent.
bool boundsVisible(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent);

// Ranges of the clusters that the view may see: everything in one range unless leaving some out saves more than the
// extra draw calls cost, empty if the view sees nothing. No visible triangle is left out.
RecycledVector<IndexRange> visibleRanges(const View& view, const InstanceState& instance, const Mesh& mesh);
// Says whether the view sees no backs of the mesh's triangles if the mesh is solid: its eye is outside the mesh's box,
// which lies before its clip plane.
bool seesOnlyFronts(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent);
uint32_t indexCount(std::span<const IndexRange> ranges);

}  // namespace speculum
