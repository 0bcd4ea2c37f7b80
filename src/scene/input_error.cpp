#include "scene/input_error.hpp"

#include <spdlog/fmt/ranges.h>
#include <algorithm>
#include <numeric>
#include <vector>

#include "platform/files.hpp"
#include "platform/text.hpp"

namespace speculum {

namespace {

size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < b.size(); ++j) {
      const size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({substituted, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

void throwInputError(const std::filesystem::path& file, int line, std::string_view key, std::string_view wrong,
                     std::string_view right) {
  std::string message = file.string() + ":" + std::to_string(line) + ": ";
  message.append(key).append(": ").append(wrong).append(" (").append(right).append(")");
  throw InputError(oneLine(std::move(message)));
}

std::string readInputText(const std::filesystem::path& file, std::string_view right, uintmax_t most) {
  try {
    return readText(file, most);
  } catch (const FileError& error) {
    throwInputError(file, 1, "file", error.problem(), right);
  }
}

std::string nearestKeyAdvice(std::string_view key, std::span<const std::string_view> known,
                             std::string_view otherwise) {
  // A file may have keys of any length; no known key is near one longer than this.
  constexpr size_t longest = 64;
  size_t least = key.size() > longest ? 0 : std::max<size_t>(1, key.size() * 2 / 5) + 1;
  std::string_view nearest;
  for (const std::string_view candidate : known) {
    const size_t distance = least == 0 ? 1 : editDistance(key, candidate);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  if (!nearest.empty()) {
    return "did you mean '" + std::string(nearest) + "'?";
  }
  return otherwise.empty() ? fmt::format("one of: {}", fmt::join(known, " ")) : std::string(otherwise);
}

}  // namespace speculum
