#include "regress/driver.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "platform/text.hpp"
#include "scene/text_lines.hpp"

namespace speculum {

namespace {

constexpr std::string_view digitsAndDots = "0123456789.";

// Returns the parts of a dotted number; nothing for any other text.
std::vector<int> partsOf(std::string_view text) {
  std::vector<int> parts;
  const bool plain = text.find_first_not_of(digitsAndDots) == std::string_view::npos;  // from_chars takes a sign too
  for (const char* at = text.data(); plain; ++at) {
    const auto [end, error] = std::from_chars(at, text.data() + text.size(), parts.emplace_back());
    if (error != std::errc()) {
      break;
    }
    if (end == text.data() + text.size()) {
      return parts;
    }
    at = end;
  }
  return {};
}

// Returns the parts of the first number of a driver's text that has a dot.
std::vector<int> versionOf(std::string_view driver) {
  for (size_t at = 0, end = 0; (at = driver.find_first_of(digitsAndDots, end)) != std::string_view::npos;) {
    end = std::min(driver.find_first_not_of(digitsAndDots, at), driver.size());
    if (std::vector<int> parts = partsOf(driver.substr(at, end - at)); parts.size() > 1) {
      return parts;
    }
  }
  return {};
}

}  // namespace

bool isOfFamily(const std::string& driver, const std::string& family) {
  const std::string word = lowerCase(family);
  return lowerCase(driver).find(word == "lavapipe" ? "llvmpipe" : word) != std::string::npos;
}

bool isInVersions(const std::string& driver, const std::string& range) {
  const std::vector<int> version = versionOf(driver);
  bool holds = !version.empty();
  for (size_t at = 0; at <= range.size();) {
    const size_t end = std::min(range.find(',', at), range.size());
    const std::string_view text = trimmed(std::string_view(range).substr(at, end - at));
    at = end + 1;
    const std::string_view sign = text.substr(0, text.starts_with(">=") || text.starts_with("<=") ? 2 : 1);
    const std::vector<int> bound = partsOf(trimmed(text.substr(sign.size())));
    if (sign.find_first_of("<>=") != 0 || bound.empty()) {
      throw std::invalid_argument("'" + range + "' is no range");
    }
    std::vector<int> own = version;
    own.resize(bound.size());
    holds &= (sign.ends_with('=') && own == bound) || (sign.front() == '>' && own > bound) ||
             (sign.front() == '<' && own < bound);
  }
  return holds;
}

}  // namespace speculum
