#include "accuracy/plot_axis.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "accuracy/html_text.hpp"

namespace speculum {

namespace {

constexpr double zeroStrip = 26.0;
constexpr double apartStrip = 62.0;
constexpr double padding = 0.06;  // of the range, on both sides

// Zero as exactly that, and a tick on the very end in spite of rounding.
std::vector<double> multiples(double step, double low, double high) {
  std::vector<double> values;
  const double slack = 1e-9 * step;
  for (double n = std::ceil((low - slack) / step); n * step <= high + slack; n += 1.0) {
    values.push_back(n == 0.0 ? 0.0 : step >= 1.0 ? n * step : n / std::round(1.0 / step));
  }
  return values;
}

double powerOfTen(int exponent) {
  return exponent < 0 ? 1.0 / std::pow(10.0, -exponent) : std::pow(10.0, exponent);
}

std::vector<double> decadeTicks(double low, double high, const std::vector<double>& mantissas, int step) {
  std::vector<double> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(high)));
  for (int exponent = first; exponent <= last; ++exponent) {
    if (exponent % step != 0) {
      continue;
    }
    for (const double mantissa : mantissas) {
      const double value = exponent < 0 ? mantissa / powerOfTen(-exponent) : mantissa * powerOfTen(exponent);
      if (value >= low * (1.0 - 1e-9) && value <= high * (1.0 + 1e-9)) {
        ticks.push_back(value);
      }
    }
  }
  return ticks;
}

}  // namespace

std::vector<double> linearTicks(double low, double high, int most) {
  if (!(high > low) || most < 1) {
    return {low};
  }
  const double rough = (high - low) / std::max(1, most);
  int exponent = static_cast<int>(std::floor(std::log10(rough)));
  for (;; ++exponent) {
    for (const double mantissa : {1.0, 2.0, 5.0}) {
      const double step = exponent < 0 ? mantissa / powerOfTen(-exponent) : mantissa * powerOfTen(exponent);
      std::vector<double> ticks = multiples(step, low, high);
      if (static_cast<int>(ticks.size()) <= most) {
        return ticks;
      }
    }
  }
}

std::vector<double> logarithmicTicks(double low, double high, int most) {
  const std::vector<double> steps = decadeTicks(low, high, {1.0, 2.0, 5.0}, 1);
  if (static_cast<int>(steps.size()) <= most) {
    if (steps.size() >= 3) {
      return steps;
    }
    const std::vector<double> linear = linearTicks(low, high, std::min(most, 5));
    return linear.size() > steps.size() ? linear : steps;
  }
  for (int step = 1;; ++step) {
    std::vector<double> decades = decadeTicks(low, high, {1.0}, step);
    if (static_cast<int>(decades.size()) <= most) {
      return decades;
    }
  }
}

std::vector<std::string> tickLabels(const std::vector<double>& ticks) {
  const bool plain = std::all_of(ticks.begin(), ticks.end(), [](double tick) {
    return tick == 0.0 || (std::abs(tick) > 0.99e-4 && std::abs(tick) < 1.01e5);
  });
  std::vector<std::string> labels;
  for (const double tick : ticks) {
    char text[64];
    std::snprintf(text, sizeof(text), "%.6g", tick);
    labels.push_back(plain || tick == 0.0 ? withMinusSign(text) : powerText(tick));
  }
  return labels;
}

PlotScale::PlotScale(const PlotAxis& axis, const std::vector<double>& values, double from, double to) : axis_(axis) {
  const bool logarithmic = axis.scale == AxisScale::logarithmic;
  const double direction = to > from ? 1.0 : -1.0;
  const double limit = logarithmic ? 250.0 : 1e150;  // so that a widened range stays within double
  low_ = std::numeric_limits<double>::infinity();
  high_ = -low_;
  start_ = from;
  end_ = to;
  for (const double value : values) {
    const bool apart = axis.apart && value >= *axis.apart;
    if (logarithmic && value <= 0.0) {
      zero_ = from + direction * 0.4 * zeroStrip;
    } else if (std::isfinite(value) && !apart) {
      low_ = std::min(low_, std::clamp(transformed(value), -limit, limit));
      high_ = std::max(high_, std::clamp(transformed(value), -limit, limit));
    }
  }
  if (low_ > high_) {
    low_ = logarithmic ? -1.0 : 0.0;
    high_ = logarithmic ? 0.0 : 1.0;
  }
  // A single value, or nearly so, stands in the middle of some range.
  const double largest = std::max(std::abs(low_), std::abs(high_));
  const bool single = high_ - low_ <= std::max(1e-9 * largest, 1e-100);
  const double around = logarithmic ? 0.4 : largest > 1e-100 ? 0.1 * largest : 1.0;
  const double widening = single ? around : std::max(padding * (high_ - low_), logarithmic ? 0.05 : 0.0);
  low_ -= widening;
  high_ += widening;
  if (zero_) {
    start_ += direction * zeroStrip;
  }
  if (axis.apart) {
    apart_ = to - direction * 0.4 * apartStrip;
    end_ -= direction * apartStrip;
  }
}

double PlotScale::transformed(double value) const {
  return axis_.scale == AxisScale::logarithmic ? std::log10(value) : value;
}

std::optional<double> PlotScale::unclampedAt(double value) const {
  if (std::isnan(value) || (axis_.scale == AxisScale::logarithmic && value <= 0.0) || std::isinf(value)) {
    return std::nullopt;
  }
  return start_ + (end_ - start_) * (transformed(value) - low_) / (high_ - low_);
}

std::optional<double> PlotScale::at(double value) const {
  if (std::isnan(value)) {
    return std::nullopt;
  }
  if (apart_ && value >= *axis_.apart) {
    return apart_;
  }
  if (axis_.scale == AxisScale::logarithmic && value <= 0.0) {
    return zero_.value_or(start_);
  }
  if (std::isinf(value)) {
    return value > 0.0 ? end_ : start_;
  }
  return std::clamp(*unclampedAt(value), std::min(start_, end_), std::max(start_, end_));
}

std::vector<PlotScale::Tick> PlotScale::ticks(double characterSize, double gap) const {
  const bool logarithmic = axis_.scale == AxisScale::logarithmic;
  const double low = logarithmic ? std::pow(10.0, low_) : low_;
  const double high = logarithmic ? std::pow(10.0, high_) : high_;
  const int most = std::max(2, static_cast<int>(std::abs(end_ - start_) / (4.0 * characterSize + gap)));
  std::vector<double> values = axis_.ticks;
  std::erase_if(values, [&](double v) { return !(v >= low && v <= high); });
  if (values.empty()) {
    values = logarithmic ? logarithmicTicks(low, high, most) : linearTicks(low, high, most);
  }
  const std::vector<std::string> labels = tickLabels(values);
  std::vector<Tick> ticks;
  double occupied = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < values.size(); ++i) {
    const double at = *this->at(values[i]);
    const double along = std::abs(at - start_);
    const double half = 0.5 * (characterSize * characterCount(labels[i]) + gap);
    const bool room = along - half >= occupied;
    occupied = room ? along + half : occupied;
    ticks.push_back({at, room ? labels[i] : std::string(), false});
  }
  if (zero_) {
    ticks.push_back({*zero_, "0", true});
  }
  if (apart_) {
    ticks.push_back({*apart_, numberText(*axis_.apart), true});
  }
  return ticks;
}

}  // namespace speculum
