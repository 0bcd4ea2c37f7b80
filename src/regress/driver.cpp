#include "regress/driver.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "platform/text.hpp"

namespace speculum {

namespace {

std::vector<int> parts(const std::string& version) {
  std::vector<int> numbers;
  std::istringstream stream(version);
  for (std::string part; std::getline(stream, part, '.');) {
    numbers.push_back(std::stoi(part));
  }
  return numbers;
}

}  // namespace

bool isOfFamily(const std::string& driver, const std::string& family) {
  const std::string word = lowerCase(family);
  return lowerCase(driver).find(word == "lavapipe" ? "llvmpipe" : word) != std::string::npos;
}

bool isInVersions(const std::string& driver, const std::string& range) {
  static const std::regex number("[0-9]{1,9}(\\.[0-9]{1,9})+");
  static const std::regex comparison(" *(>=|<=|>|<|=) *([0-9]{1,9}(\\.[0-9]{1,9})*) *");
  std::smatch found;
  const std::vector<int> version = std::regex_search(driver, found, number) ? parts(found.str()) : std::vector<int>();
  bool holds = !version.empty();
  std::istringstream stream(range);
  int comparisons = 0;
  for (std::string text; std::getline(stream, text, ',');) {
    std::smatch match;
    if (!std::regex_match(text, match, comparison)) {
      throw std::invalid_argument("'" + range + "' is no range");
    }
    const std::vector<int> bound = parts(match[2]);
    std::vector<int> own = version;
    own.resize(bound.size());
    const std::string sign = match[1];
    holds &= (sign.find('=') != std::string::npos && own == bound) || (sign.front() == '>' && own > bound) ||
             (sign.front() == '<' && own < bound);
    ++comparisons;
  }
  if (comparisons == 0 || range.ends_with(',')) {
    throw std::invalid_argument("'" + range + "' is no range");
  }
  return holds;
}

}  // namespace speculum
