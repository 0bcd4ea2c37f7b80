#include "scene/value_range.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

namespace speculum {

namespace {

// Writes 1e15, where the standard library writes 1e+15.
std::string number(double value) {
  std::string text = fmt::format("{:g}", value);
  const size_t exponent = text.find('e');
  if (exponent != std::string::npos) {
    const size_t sign = exponent + 1;
    text.erase(sign + 1, text.find_first_not_of('0', sign + 1) - sign - 1);
    if (text[sign] == '+') {
      text.erase(sign, 1);
    }
  }
  return text;
}

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && (aboveLow ? value > low : value >= low) && value <= high &&
         (!powersOfTwo || std::exp2(std::ilogb(value)) == value);
}

std::string Range::text() const {
  if (powersOfTwo) {
    return "one of " + shortText() + " is needed";
  }
  if (high < std::numeric_limits<double>::max()) {
    return aboveLow
               ? fmt::format("a finite number above {} and up to {} is needed", number(low), number(high))
               : fmt::format("a {}number {} .. {} is needed", high > 1e6 ? "finite " : "", number(low), number(high));
  }
  if (low == -std::numeric_limits<double>::max()) {
    return "a finite number is needed";
  }
  return aboveLow ? fmt::format("a finite number above {} is needed", number(low))
                  : fmt::format("a finite number of {} or more is needed", number(low));
}

std::string Range::shortText() const {
  if (powersOfTwo) {
    std::string powers = number(low);
    for (double power = 2.0 * low; power <= high; power *= 2.0) {
      powers += " " + number(power);
    }
    return powers;
  }
  if (high == std::numeric_limits<double>::max()) {
    return low == -high ? "" : (aboveLow ? "> " : ">= ") + number(low);
  }
  return (aboveLow ? "> " : "") + number(low) + " .. " + number(high);
}

}  // namespace speculum
