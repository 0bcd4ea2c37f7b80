#pragma once

#include <span>
#include <vector>

#include "plan/view.hpp"

namespace speculum {

// Sorts the instances that a view shows so that little is shaded and then hidden: nearer ones first, with the instances
// of one mesh together. Instances at equal distances keep their order.
std::vector<int> frontToBack(const View& view, std::span<const int> instances, const SceneState& state);

}  // namespace speculum
