#include "geometry/bvh.hpp"

#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <numeric>

namespace speculum {

namespace {

constexpr int binCount = 16;
constexpr double traversalCost = 1.0;  // in units of one primitive's intersection

struct Bin {
  Bounds box;
  uint32_t count = 0;
};

struct Split {
  int axis = -1;
  int bin = 0;  // primitives of bins <= this go left
  double cost = std::numeric_limits<double>::infinity();
};

double safeInverse(double d) {
  // A component of zero would give 0 * infinity, which is not a number, for a ray that lies in a face of the box.
  return 1.0 / (std::abs(d) < 1e-300 ? std::copysign(1e-300, d) : d);
}

int binOf(double center, double low, double extent) {
  return std::clamp(static_cast<int>((center - low) / extent * binCount), 0, binCount - 1);
}

Split bestOfAxis(const std::array<Bin, binCount>& bins, int axis) {
  std::array<double, binCount> rightCost{};
  Bin right;
  for (int i = binCount - 1; i > 0; --i) {
    right.box.add(bins[i].box);
    right.count += bins[i].count;
    rightCost[i] = right.box.halfArea() * right.count;
  }
  Split best;
  Bin left;
  for (int i = 0; i + 1 < binCount; ++i) {
    left.box.add(bins[i].box);
    left.count += bins[i].count;
    const double cost = left.box.halfArea() * left.count + rightCost[i + 1];
    if (cost < best.cost) {
      best = {axis, i, cost};
    }
  }
  return best;
}

}  // namespace

Bounds Bounds::around(std::span<const glm::dvec3> points) {
  Bounds box;
  for (const glm::dvec3& p : points) {
    box.add(p);
  }
  return box;
}

Bounds Bounds::widened(double share) const {
  const double margin = share * glm::compMax(glm::max(glm::abs(low), glm::abs(high)));
  return {low - margin, high + margin};
}

double Bounds::halfArea() const {
  const glm::dvec3 e = high - low;
  return e.x < 0.0 ? 0.0 : e.x * e.y + e.y * e.z + e.z * e.x;
}

void sortIntoRuns(std::span<int> indices, std::span<const glm::dvec3> points, size_t size) {
  if (indices.size() <= size) {
    return;
  }
  Bounds box;
  for (const int i : indices) {
    box.add(points[i]);
  }
  const glm::dvec3 extent = box.high - box.low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const size_t half = (indices.size() + size - 1) / size / 2 * size;
  std::nth_element(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(half), indices.end(),
                   [&](int a, int b) { return points[a][axis] < points[b][axis]; });
  sortIntoRuns(indices.first(half), points, size);
  sortIntoRuns(indices.subspan(half), points, size);
}

BoxTester::BoxTester(const Ray& ray)
    : origin(ray.origin),
      inverse(safeInverse(ray.direction.x), safeInverse(ray.direction.y), safeInverse(ray.direction.z)) {}

struct Bvh::Builder {
  std::span<const Bounds> primitives;
  Bvh& bvh;
  uint32_t leafSize;
  RecycledVector<uint32_t> right{};  // primitives that partition() moves to the end

  Split findSplit(uint32_t first, uint32_t count, const Bounds& centers) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = centers.low[axis];
      const double extent = centers.high[axis] - low;
      if (!(extent > 0.0)) {
        continue;
      }
      std::array<Bin, binCount> bins;
      for (uint32_t i = first; i < first + count; ++i) {
        const Bounds& box = primitives[bvh.order_[i]];
        Bin& bin = bins[binOf(box.center()[axis], low, extent)];
        bin.box.add(box);
        ++bin.count;
      }
      const Split split = bestOfAxis(bins, axis);
      best = split.cost < best.cost ? split : best;
    }
    return best;
  }

  // Returns the number of primitives moved to the front of the range; 0 or `count` if the split separates nothing.
  uint32_t partition(uint32_t first, uint32_t count, const Bounds& centers, const Split& split) {
    if (split.axis < 0) {
      return 0;
    }
    const double low = centers.low[split.axis];
    const double extent = centers.high[split.axis] - low;
    const auto begin = bvh.order_.begin() + first;
    auto left = begin;
    right.clear();
    for (auto i = begin; i != begin + count; ++i) {
      const bool goesLeft = binOf(primitives[*i].center()[split.axis], low, extent) <= split.bin;
      goesLeft ? void(*left++ = *i) : right.push_back(*i);
    }
    std::ranges::copy(right, left);
    return static_cast<uint32_t>(left - begin);
  }

  void build(uint32_t nodeIndex, uint32_t first, uint32_t count, int depth) {
    Bounds box;
    Bounds centers;
    for (uint32_t i = first; i < first + count; ++i) {
      box.add(primitives[bvh.order_[i]]);
      centers.add(primitives[bvh.order_[i]].center());
    }
    // Widens the box, so that a ray within one of its faces is inside.
    bvh.nodes_[nodeIndex].box = box.widened(1e-15);
    const Split split = depth < maxBinnedDepth && count > 1 ? findSplit(first, count, centers) : Split{};
    const bool leafIsCheaper = !(split.cost + traversalCost * box.halfArea() < box.halfArea() * count);
    if (count == 1 || (count <= leafSize && leafIsCheaper)) {
      bvh.nodes_[nodeIndex].first = first;
      bvh.nodes_[nodeIndex].count = count;
      return;
    }
    uint32_t left = partition(first, count, centers, split);
    if (left == 0 || left == count) {
      left = count / 2;
    }
    const auto child = static_cast<uint32_t>(bvh.nodes_.size());
    bvh.nodes_.resize(bvh.nodes_.size() + 2);
    bvh.nodes_[nodeIndex].first = child;
    build(child, first, left, depth + 1);
    build(child + 1, first + left, count - left, depth + 1);
  }
};

Bvh::Bvh(std::span<const Bounds> primitives, int leafSize) {
  if (primitives.empty()) {
    return;
  }
  order_.resize(primitives.size());
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(2 * primitives.size());
  nodes_.resize(1);
  Builder{primitives, *this, static_cast<uint32_t>(leafSize)}.build(0, 0, static_cast<uint32_t>(primitives.size()), 0);
}

}  // namespace speculum
