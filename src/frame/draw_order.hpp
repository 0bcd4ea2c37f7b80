#pragma once

#include <span>
#include <vector>

#include "frame/view.hpp"

namespace speculum {

// The instances that a view shows, in the order that shades the least of what is hidden later: those of one mesh stand
// together, nearer ones first. Instances at equal distances keep their order.
std::vector<int> frontToBack(const View& view, std::span<const int> instances, const SceneState& state);

}  // namespace speculum
