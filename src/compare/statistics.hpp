#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace speculum {

// Repeated measurements of one quantity, in the unit of the values.
struct Spread {
  double median = 0.0;
  double minimum = 0.0;
  double lowerQuartile = 0.0;
  double upperQuartile = 0.0;
  int repeats = 0;
};

// Returns median, minimum and quartiles by linear interpolation between order statistics (type 7 of Hyndman and Fan,
// "Sample Quantiles in Statistical Packages", 1996). All zero without values.
Spread spreadOf(std::vector<double> values);

// Returns the least value that `part` of the values, of which there is one at least, do not exceed (nearest rank).
double nearestRank(std::vector<double> values, double part);

// The line y = offset + slope * x.
struct LineFit {
  double slope = 0.0;
  double offset = 0.0;
};
// Fits a line by least squares. Returns nothing without two different x.
std::optional<LineFit> fitLine(std::span<const glm::dvec2> samples);

}  // namespace speculum
