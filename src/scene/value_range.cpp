#include "scene/value_range.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

namespace speculum {

bool Range::contains(double value) const {
  return std::isfinite(value) && (aboveLow ? value > low : value >= low) && value <= high;
}

std::string Range::text() const {
  const bool bounded = high < std::numeric_limits<double>::max();
  if (bounded) {
    return aboveLow ? fmt::format("a finite number above {:g} and up to {:g} is needed", low, high)
                    : fmt::format("a {}number {:g} .. {:g} is needed", high > 1e6 ? "finite " : "", low, high);
  }
  if (low == -std::numeric_limits<double>::max()) {
    return "a finite number is needed";
  }
  return aboveLow ? fmt::format("a finite number above {} is needed", low)
                  : fmt::format("a finite number of {} or more is needed", low);
}

std::string Range::shortText() const {
  // "1e15", where the standard library writes 1e+15.
  const auto number = [](double value) {
    std::string text = fmt::format("{:g}", value);
    const size_t plus = text.find('+');
    return plus == std::string::npos ? text : text.erase(plus, 1);
  };
  if (high == std::numeric_limits<double>::max()) {
    return low == -high ? "" : (aboveLow ? "> " : ">= ") + number(low);
  }
  return (aboveLow ? "> " : "") + number(low) + " .. " + number(high);
}

}  // namespace speculum
