#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// Returns the GPU milliseconds of a frame or, on a device without timestamps, the milliseconds of the whole frame.
const Spread& costSpread(const SweepPoint& point);
double costMs(const SweepPoint& point);  // median of costSpread()
std::vector<int> indicesByCost(const std::vector<SweepPoint>& points);

using ErrorOf = std::function<std::optional<double>(const SweepPoint&)>;

// Finds the points that are worth their price by an error and costSpread(), as indices, cheapest first. Points without
// that error do not count. Equal errors mostly mean equal pictures: the point with the fewest changes stands for all of
// them, unless another is cheaper by more than the spread. Each point on the front has a lower median than every more
// accurate one, and an upper quartile below the lower quartiles of the more accurate ones on the front. The error is
// mean FLIP of the whole picture unless said otherwise.
std::vector<int> paretoFront(
    const std::vector<SweepPoint>& points,
    const ErrorOf& errorOf = [](const SweepPoint& point) { return point.whole.flip; });

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
