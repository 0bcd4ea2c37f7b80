#pragma once

#include <optional>
#include <string>
#include <vector>

namespace speculum {

enum class AxisScale { logarithmic, linear };

struct PlotAxis {
  std::string label;
  AxisScale scale = AxisScale::logarithmic;
  std::vector<double> ticks;    // values that get a tick where there is room; empty: chosen by the range
  std::optional<double> apart;  // a value far above all others, shown at the axis' end behind a break
};

// Round values within [low, high], `most` at most: steps of 1, 2 or 5 times a power of ten.
std::vector<double> linearTicks(double low, double high, int most);

// The same for 0 < low <= high: 1, 2 and 5 of every decade, or decades, or every so many decades; within less than a
// decade linear steps where these are more.
std::vector<double> logarithmicTicks(double low, double high, int most);

// Texts of the same style for all ticks of an axis: plain, or powers of ten if one is below 0.0001 or above 100000.
std::vector<std::string> tickLabels(const std::vector<double>& ticks);

// Maps values to a coordinate. On a logarithmic axis values that are not positive lie on a strip of their own before
// the axis' lower end. Values that are not numbers have no place, infinite ones lie at the ends.
class PlotScale {
 public:
  struct Tick {
    double at = 0.0;
    std::string label;     // empty where there is no room for it
    bool offAxis = false;  // zero's or the one behind the break
  };

  // `values`: what has to fit. `from`, `to`: coordinates of the lower and the upper end, in either order.
  PlotScale(const PlotAxis& axis, const std::vector<double>& values, double from, double to);

  std::optional<double> at(double value) const;
  // Not clamped, for lines that leave the plot; nothing off the axis.
  std::optional<double> unclampedAt(double value) const;
  // A label takes `gap` along the axis and `characterSize` for each character.
  std::vector<Tick> ticks(double characterSize, double gap) const;

  double axisStart() const { return start_; }  // without the strips
  double axisEnd() const { return end_; }
  bool hasZero() const { return zero_.has_value(); }
  bool hasApart() const { return apart_.has_value(); }

 private:
  double transformed(double value) const;

  PlotAxis axis_;
  double low_ = 0.0;
  double high_ = 1.0;
  double start_ = 0.0;
  double end_ = 1.0;
  std::optional<double> zero_;   // coordinate
  std::optional<double> apart_;  // coordinate
};

}  // namespace speculum
