#include "accuracy/pareto.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "platform/text.hpp"

namespace speculum {

namespace {

std::string timeText(double ms) {
  return ms < 1000.0 ? significant(ms, 3) + " ms" : significant(ms / 1000.0, 3) + " s";
}

// Compares the chosen point with the most accurate one.
std::string comparison(const SweepPoint& chosen, const SweepPoint& best) {
  if (&chosen == &best) {
    return "the most accurate of the measured points";
  }
  return fmt::format("the most accurate is '{}' with {:.3g} in {}", best.name, best.whole.flip, timeText(costMs(best)));
}

// Returns the indices 0 .. count - 1 by ascending rank(index); equal ranks keep their order.
template <typename Rank>
std::vector<int> indicesBy(size_t count, const Rank& rank) {
  std::vector<int> indices(count);
  std::iota(indices.begin(), indices.end(), 0);
  std::ranges::stable_sort(indices, {}, rank);
  return indices;
}

// Returns one point for each error, by ascending error: the first, unless a later one is cheaper beyond the spread.
std::vector<int> onePerError(const std::vector<SweepPoint>& points, const ErrorOf& errorOf) {
  const auto rank = [&](int i) { return std::pair(errorOf(points[i]), points[i].changes.size()); };
  std::vector<int> chosen;
  for (const int index : indicesBy(points.size(), rank)) {
    const std::optional<double> error = errorOf(points[index]);
    if (error && (chosen.empty() || errorOf(points[chosen.back()]) != error)) {
      chosen.push_back(index);
    } else if (error && costSpread(points[index]).upperQuartile < costSpread(points[chosen.back()]).lowerQuartile) {
      chosen.back() = index;
    }
  }
  return chosen;
}

}  // namespace

std::vector<int> paretoFront(const std::vector<SweepPoint>& points, const ErrorOf& errorOf) {
  std::vector<int> front;
  double cheapestMedian = std::numeric_limits<double>::infinity();
  double cheapestQuartile = std::numeric_limits<double>::infinity();
  for (const int index : onePerError(points, errorOf)) {
    const Spread& spread = costSpread(points[index]);
    if (spread.median < cheapestMedian && spread.upperQuartile < cheapestQuartile) {
      front.push_back(index);
      cheapestQuartile = spread.lowerQuartile;
    }
    cheapestMedian = std::min(cheapestMedian, spread.median);
  }
  std::ranges::reverse(front);
  return front;
}

const Spread& costSpread(const SweepPoint& point) {
  return point.gpuMs.repeats > 0 ? point.gpuMs : point.frameMs;
}

double costMs(const SweepPoint& point) {
  return costSpread(point).median;
}

std::vector<int> indicesByCost(const std::vector<SweepPoint>& points) {
  return indicesBy(points.size(), [&](int i) { return costMs(points[i]); });
}

std::optional<BudgetChoice> chooseForBudget(const SweepResults& results, const QualityBudget& budget) {
  const auto& points = results.points;
  if (points.empty() || (budget.ms <= 0.0 && budget.error <= 0.0)) {
    return std::nullopt;
  }
  const auto affordable = [&](int i) { return budget.ms <= 0.0 || costMs(points[i]) <= budget.ms; };
  const auto exact = [&](int i) { return budget.error <= 0.0 || points[i].whole.flip <= budget.error; };
  const auto errorOf = [&](int i) { return points[i].whole.flip; };
  const auto costOf = [&](int i) { return costMs(points[i]); };
  const std::vector<int> byError = indicesBy(points.size(), [&](int i) { return std::pair(errorOf(i), costOf(i)); });
  const std::vector<int> byCost = indicesBy(points.size(), [&](int i) { return std::pair(costOf(i), errorOf(i)); });
  const SweepPoint& best = points[byError.front()];
  const auto orElse = [](const std::vector<int>& order, const auto& fits, int otherwise) {
    const auto found = std::ranges::find_if(order, fits);
    return found == order.end() ? otherwise : *found;
  };
  BudgetChoice choice;
  if (budget.error > 0.0) {
    choice.point = orElse(byCost, exact, byError.front());
  }
  if (budget.ms > 0.0 && (budget.error <= 0.0 || !affordable(choice.point))) {
    choice.point = orElse(byError, affordable, byCost.front());
  }
  choice.met = affordable(choice.point) && exact(choice.point);
  const SweepPoint& chosen = points[choice.point];
  choice.why = fmt::format("'{}', mean FLIP {:.3g} in {}; {}", chosen.name, chosen.whole.flip, timeText(costMs(chosen)),
                           comparison(chosen, best));
  if (!affordable(choice.point)) {
    choice.why += "; no measured point fits " + timeText(budget.ms);
  }
  if (!exact(choice.point)) {
    choice.why += fmt::format("; the error bound {:.3g} is not met", budget.error);
  }
  return choice;
}

}  // namespace speculum
