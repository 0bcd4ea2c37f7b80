#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <span>

#include "geometry/recycled_memory.hpp"

namespace speculum {

// Axis-aligned box in double; empty until something is added.
struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};

  static Bounds around(std::span<const glm::dvec3> points);

  void add(const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  void add(const Bounds& b) {
    low = glm::min(low, b.low);
    high = glm::max(high, b.high);
  }
  // Halves the corners before the sum, which could otherwise overflow.
  glm::dvec3 center() const { return 0.5 * low + 0.5 * high; }
  double halfArea() const;             // half the surface area; 0 if empty
  Bounds widened(double share) const;  // on all sides, by a share of its largest coordinate
};

// origin + t * direction for t in (tMin, tMax). The direction need not be of unit length.
struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};
  double tMin = 0.0;
  double tMax = std::numeric_limits<double>::infinity();

  glm::dvec3 at(double t) const { return origin + t * direction; }
};

// A ray prepared for tests against boxes.
struct BoxTester {
  glm::dvec3 origin;
  glm::dvec3 inverse;

  explicit BoxTester(const Ray& ray);
  // Returns the parameter t where the ray enters the box, or infinity if it misses the box within [tMin, tMax]. Never
  // misses because of rounding: the far distance is enlarged as in Ize, "Robust BVH Ray Traversal" (2013).
  double enter(const Bounds& box, double tMin, double tMax) const {
    const glm::dvec3 a = (box.low - origin) * inverse;
    const glm::dvec3 b = (box.high - origin) * inverse;
    const double near = larger(larger(smaller(a.x, b.x), smaller(a.y, b.y)), larger(smaller(a.z, b.z), tMin));
    const double far = smaller(smaller(larger(a.x, b.x), larger(a.y, b.y)), smaller(larger(a.z, b.z), tMax));
    return near <= far * (1.0 + 1e-15) ? near : std::numeric_limits<double>::infinity();
  }

 private:
  // Take values, so that each compiles to one instruction: std::min and std::max, which take references, become
  // branches.
  static double smaller(double x, double y) { return x < y ? x : y; }
  static double larger(double x, double y) { return x > y ? x : y; }
};

// Sorts indices of points so that each run of `size` (at least 1) indices, from the first on, is of points that lie
// close together.
void sortIntoRuns(std::span<int> indices, std::span<const glm::dvec3> points, size_t size);

// Bounding volume hierarchy over boxes: binary, binned surface area heuristic (Wald, "On fast Construction of SAH-based
// Bounding Volume Hierarchies", 2007). The caller keeps the primitives in the order that `order()` gives.
class Bvh {
 public:
  struct Node {
    Bounds box;
    uint32_t first = 0;  // leaf: first primitive; else: left child, the right one follows it
    uint32_t count = 0;  // primitives of a leaf; 0: inner node
  };

  // From this depth on splits halve the primitives, so that 2^32 of them still fit below.
  static constexpr int maxBinnedDepth = 64;
  static constexpr int stackSize = maxBinnedDepth + 40;  // enough for a traversal that visits one child first

  Bvh() = default;
  explicit Bvh(std::span<const Bounds> primitives, int leafSize = 4);

  // The k-th primitive of the leaves is order()[k] of the input.
  const RecycledVector<uint32_t>& order() const { return order_; }
  Bounds bounds() const { return nodes_.empty() ? Bounds{} : nodes_[0].box; }
  std::span<const Node> nodes() const { return nodes_; }  // the root first; none without primitives

  // Calls leaf(first, count, tMax) for every leaf that the ray may meet before tMax, near ones first. `leaf` lowers
  // tMax as it finds hits, and returns true to end the traversal.
  template <typename Leaf>
  void traverse(const Ray& ray, Leaf&& leaf) const;
  // Calls leaf(i) for the i-th primitive of the input unless meets(box) is false for a box around its leaf.
  template <typename Meets, typename Leaf>
  void visit(const Meets& meets, const Leaf& leaf) const;

 private:
  struct Builder;
  RecycledVector<Node> nodes_;
  RecycledVector<uint32_t> order_;
};

template <typename Leaf>
void Bvh::traverse(const Ray& ray, Leaf&& leaf) const {
  struct Entry {
    uint32_t node;
    double enter;
  };
  const BoxTester tester(ray);
  double tMax = ray.tMax;
  std::array<Entry, stackSize> stack;
  int size = 0;
  if (!nodes_.empty()) {
    stack[size++] = {0, tester.enter(nodes_[0].box, ray.tMin, tMax)};
  }
  while (size > 0) {
    const Entry entry = stack[--size];
    if (!(entry.enter <= tMax) || entry.enter == std::numeric_limits<double>::infinity()) {
      continue;
    }
    const Node& node = nodes_[entry.node];
    if (node.count > 0) {
      if (leaf(node.first, node.count, tMax)) {
        return;
      }
      continue;
    }
    Entry near{node.first, tester.enter(nodes_[node.first].box, ray.tMin, tMax)};
    Entry far{node.first + 1, tester.enter(nodes_[node.first + 1].box, ray.tMin, tMax)};
    if (far.enter < near.enter) {
      std::swap(near, far);
    }
    if (far.enter != std::numeric_limits<double>::infinity()) {
      stack[size++] = far;
    }
    if (near.enter != std::numeric_limits<double>::infinity()) {
      stack[size++] = near;
    }
  }
}

template <typename Meets, typename Leaf>
void Bvh::visit(const Meets& meets, const Leaf& leaf) const {
  std::array<uint32_t, stackSize> stack{};  // the root first
  int size = nodes_.empty() ? 0 : 1;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!meets(node.box)) {
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      leaf(order_[i]);
    }
    if (node.count == 0) {
      stack[size++] = node.first + 1;
      stack[size++] = node.first;
    }
  }
}

}  // namespace speculum
