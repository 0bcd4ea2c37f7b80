#include "plan/draw_order.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace speculum {

std::vector<int> frontToBack(const View& view, std::span<const int> instances, const SceneState& state) {
  struct Entry {
    double batch = 0.0;
    int mesh = 0;
    double distance = 0.0;
    int instance = 0;
    auto key() const { return std::tie(batch, mesh, distance, instance); }
  };
  RecycledVector<double> nearest;  // by mesh: distance of its nearest instance, metres
  std::vector<Entry> entries;
  entries.reserve(instances.size());
  for (const int i : instances) {
    const InstanceState& instance = state.instances[i];
    // To the far end of the bounding sphere, in metres. A room begins nearer to the eye than the objects in the room
    // but ends behind them, so the room is drawn after them.
    const double distance = glm::length(instance.center - view.eye) + instance.radius;
    nearest.resize(std::max<size_t>(nearest.size(), instance.mesh + 1), INFINITY);
    nearest[instance.mesh] = std::min(nearest[instance.mesh], distance);
    entries.push_back({.mesh = instance.mesh, .distance = distance, .instance = i});
  }
  for (Entry& entry : entries) {
    entry.batch = nearest[entry.mesh];
  }
  std::ranges::sort(entries, [](const Entry& a, const Entry& b) { return a.key() < b.key(); });
  std::vector<int> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries) {
    order.push_back(entry.instance);
  }
  return order;
}

}  // namespace speculum
