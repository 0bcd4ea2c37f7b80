#pragma once

#include <span>
#include <string>
#include <string_view>

namespace speculum {

// Returns the advice of an error about an unknown key: "did you mean 'x'?" for the known key with the least edit
// distance (Levenshtein 1966) when that is at most two fifths of the key's length, or 1, else the list of known keys.
std::string nearestKeyAdvice(std::string_view key, std::span<const std::string_view> known);

}  // namespace speculum
