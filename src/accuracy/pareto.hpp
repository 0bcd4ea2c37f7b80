#pragma once

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// Returns the indices 0 .. count - 1 by ascending rank(index); equal ranks keep their order.
template <typename Rank>
std::vector<int> indicesBy(size_t count, const Rank& rank) {
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  std::ranges::stable_sort(indices, {}, rank);
  return indices;
}

struct FrontCandidate {
  double error = 0.0;
  Spread cost;
};

// Finds the candidates that are worth their price, as indices, cheapest first. Equal errors mostly mean equal pictures:
// the first candidate stands for all of them, unless another is cheaper by more than the spread. Each candidate on the
// front has a lower median than every more accurate one, and an upper quartile below the lower quartiles of the more
// accurate ones on the front.
std::vector<int> paretoFront(const std::vector<FrontCandidate>& candidates);

// Returns the GPU milliseconds of a frame or, on a device without timestamps, the milliseconds of the whole frame.
const Spread& costSpread(const SweepPoint& point);
double costMs(const SweepPoint& point);  // median of costSpread()
std::vector<int> indicesByCost(const std::vector<SweepPoint>& points);

// Finds the Pareto front of the error errorOf(point) against costSpread() among the points that `order` lists, as
// indices of points, cheapest first. Of equally accurate points the first in `order` comes first.
template <typename Error>
std::vector<int> paretoFront(const std::vector<SweepPoint>& points, const std::vector<int>& order,
                             const Error& errorOf) {
  std::vector<FrontCandidate> candidates;
  for (const int index : order) {
    candidates.push_back({errorOf(points[index]), costSpread(points[index])});
  }
  std::vector<int> front = paretoFront(candidates);
  std::ranges::transform(front, front.begin(), [&](int index) { return order[index]; });
  return front;
}

// Finds the front of mean FLIP of the whole picture. Of equally accurate points those with fewer changes come first.
std::vector<int> paretoFront(const std::vector<SweepPoint>& points);

// The measured point that a budget chooses. Points off the front count too, because their median may fit where that of
// the next point of the front does not.
struct BudgetChoice {
  int point = 0;    // index into SweepResults::points
  bool met = true;  // false: no point meets the budget, and `point` comes closest
  std::string why;  // one sentence for users
};
struct QualityBudget {
  double ms = 0.0;  // GPU milliseconds a frame; 0: no bound. The most accurate point whose median fits is chosen
  // Mean FLIP; 0: no bound. The fastest point within the bound is chosen, but if `ms` is set too, only if it fits `ms`.
  double error = 0.0;

  bool bounds() const { return ms > 0.0 || error > 0.0; }
  bool operator==(const QualityBudget&) const = default;
};
// Chooses a point for a budget. Returns nothing without a bound or without points.
std::optional<BudgetChoice> chooseForBudget(const SweepResults& results, const QualityBudget& budget);

}  // namespace speculum
