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

// Finds the instance in an ascending list; null if the list does not have it.
const PartialInstance* partOf(const RecycledVector<PartialInstance>& partial, int instance);

IndexRange allOf(const Mesh& mesh);

// Says whether the view may see a part of the instance's bounding sphere and a part of its mesh's box, which reaches
// `halfExtent` from the centre.
bool boundsVisible(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent);

// Returns the index ranges of the clusters that the view may see: everything in one range unless leaving some out saves
// more than the extra draw calls cost, empty if the view sees nothing. No visible triangle is left out.
RecycledVector<IndexRange> visibleRanges(const View& view, const InstanceState& instance, const Mesh& mesh);
// Says whether the view sees only front faces of the mesh if that is solid: the view's eye is outside the mesh's box,
// and the box lies before the view's clip plane.
bool seesOnlyFronts(const View& view, const InstanceState& instance, const glm::dvec3& halfExtent);
uint32_t indexCount(std::span<const IndexRange> ranges);

}  // namespace speculum
