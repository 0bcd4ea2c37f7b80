#include "scene/camera_text.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "scene/value_range.hpp"

namespace speculum {

namespace {

// Parses lists of numbers. Commas separate numbers, colons separate lists. Returns nothing for any other text.
std::optional<std::vector<std::vector<double>>> parseLists(std::string_view text) {
  std::vector<std::vector<double>> lists(1);
  const char* end = text.data() + text.size();
  for (const char* at = text.data();;) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || (next != end && *next != ',' && *next != ':')) {
      return std::nullopt;
    }
    lists.back().push_back(value);
    if (next == end) {
      return lists;
    }
    if (*next == ':') {
      lists.emplace_back();
    }
    at = next + 1;
  }
}

}  // namespace

bool meansPoints(const std::string& text) {
  const bool number = !text.empty() && std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos;
  return number && text.find(',') != std::string::npos &&
         (text.find(':') != std::string::npos || text.find_first_not_of("+-.,0123456789eE \t") == std::string::npos);
}

Bookmark parseCamera(const std::string& text) {
  const auto lists = parseLists(text).value_or(std::vector<std::vector<double>>());
  const size_t count = lists.size();
  const auto vectors = std::span(lists).first(std::min<size_t>(count, 3));
  const bool points = std::ranges::all_of(vectors, [](const auto& list) { return list.size() == 3; });
  const bool angle = count < 4 || (lists[3].size() == 1 && fieldOfViewRange.contains(lists[3][0]));
  if (count < 2 || count > 4 || !points || !angle) {
    throw std::invalid_argument(
        "'" + text +
        "' is not a camera (position:target, position:target:up or position:target:up:FOV with a vertical "
        "field of view of 1 .. 170 degrees, such as 0,1,4:0,1,0)");
  }
  for (const std::vector<double>& vector : vectors) {
    for (const double value : vector) {
      if (!coordinateRange.contains(value)) {
        throw std::invalid_argument(fmt::format("{} is out of range ({})", value, coordinateRange.text()));
      }
    }
  }
  const auto point = [&](size_t i) { return glm::dvec3(lists[i][0], lists[i][1], lists[i][2]); };
  return {.position = point(0),
          .target = point(1),
          .up = count > 2 ? std::optional(point(2)) : std::nullopt,
          .verticalFov = count > 3 ? std::optional(lists[3][0]) : std::nullopt};
}

}  // namespace speculum
