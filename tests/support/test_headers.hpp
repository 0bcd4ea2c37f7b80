#pragma once

// Headers that nearly every test needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace speculum {

// Says whether the text has the part. A failed expectation prints the text.
inline ::testing::AssertionResult contains(std::string_view text, std::string_view part) {
  const bool found = text.find(part) != std::string_view::npos;
  return (found ? ::testing::AssertionSuccess() : ::testing::AssertionFailure()) << "in: " << text.substr(0, 4000);
}

inline ::testing::AssertionResult startsWith(std::string_view text, std::string_view start) {
  return (text.starts_with(start) ? ::testing::AssertionSuccess() : ::testing::AssertionFailure())
         << "in: " << text.substr(0, 4000);
}

// Returns the text with one part replaced, which it must have.
inline std::string replaced(std::string text, std::string_view part, std::string_view by) {
  EXPECT_TRUE(contains(text, part)) << part;
  return text.replace(text.find(part), part.size(), by);
}

// Says how often the text has the part.
inline int occurrences(std::string_view text, std::string_view part) {
  int found = 0;
  for (size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

}  // namespace speculum
