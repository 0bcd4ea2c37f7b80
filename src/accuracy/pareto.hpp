#pragma once

#include <optional>
#include <string>
#include <vector>

#include "accuracy/sweep_results.hpp"

namespace speculum {

struct FrontCandidate {
  double error = 0.0;
  Spread cost;
};

// Indices of the candidates that are worth their price, cheapest first. Equal errors mostly mean equal pictures: the
// first candidate stands for all of them, unless another is cheaper by more than the spread. Each candidate on the
// front has a lower median than every more accurate one, and an upper quartile below the lower ones of those on the
// front.
std::vector<int> paretoFront(const std::vector<FrontCandidate>& candidates);

// GPU milliseconds a frame. A device without timestamps leaves gpuMs without repeats; then those of the whole frame.
const Spread& costSpread(const SweepPoint& point);
double costMs(const SweepPoint& point);  // its median

// Mean FLIP of the whole picture against costSpread: indices of points, cheapest first. Of equally accurate points
// those with fewer changes come first.
std::vector<int> paretoFront(const std::vector<SweepPoint>& points);

// The measured point that a budget picks, and what it gives up. Points off the front count too: their median may fit
// where that of the next point of the front does not.
struct BudgetChoice {
  int point = 0;    // index into SweepResults::points
  bool met = true;  // false: no point meets the budget, and this one comes closest
  std::string why;  // one sentence for people
};
struct QualityBudget {
  double ms = 0.0;     // GPU milliseconds a frame; 0: no bound. The most accurate point whose median fits is chosen
  double error = 0.0;  // mean FLIP; 0: no bound. The fastest point within it is chosen, with both only if it fits ms
};
// Returns nothing without a bound or without points.
std::optional<BudgetChoice> chooseForBudget(const SweepResults& results, const QualityBudget& budget);

}  // namespace speculum
