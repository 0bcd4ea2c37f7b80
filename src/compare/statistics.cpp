#include "compare/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace speculum {

namespace {

double quantile(const std::vector<double>& sorted, double part) {
  const double place = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(std::floor(place));
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
  if (values.empty()) {
    return {};
  }
  std::ranges::sort(values);
  return {.median = quantile(values, 0.5),
          .minimum = values.front(),
          .lowerQuartile = quantile(values, 0.25),
          .upperQuartile = quantile(values, 0.75),
          .repeats = static_cast<int>(values.size())};
}

double nearestRank(std::vector<double> values, double part) {
  const double rank = std::ceil(part * static_cast<double>(values.size()));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::optional<LineFit> fitLine(std::span<const glm::dvec2> samples) {
  const double count = static_cast<double>(samples.size());
  double meanX = 0.0;
  double meanY = 0.0;
  for (const glm::dvec2& s : samples) {
    meanX += s.x / count;
    meanY += s.y / count;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (const glm::dvec2& s : samples) {
    xx += (s.x - meanX) * (s.x - meanX);
    xy += (s.x - meanX) * (s.y - meanY);
  }
  if (!(xx > 0.0)) {
    return std::nullopt;
  }
  return LineFit{.slope = xy / xx, .offset = meanY - xy / xx * meanX};
}

}  // namespace speculum
