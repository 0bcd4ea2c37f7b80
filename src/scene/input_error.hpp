#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace speculum {

// Bad input. what() is one line: `FILE:LINE: key: what is wrong (what would be right)`.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws InputError with `FILE:LINE: key: wrong (right)`, made one line.
[[noreturn]] void throwInputError(const std::filesystem::path& file, int line, std::string_view key,
                                  std::string_view wrong, std::string_view right);

// Returns the content of an input file. Throws InputError for line 1 and key `file`; `right` says which file is needed,
// `most` is the largest size in bytes.
std::string readInputText(const std::filesystem::path& file, std::string_view right, uintmax_t most = 1u << 30);

// Returns the advice of an error about an unknown key: "did you mean 'x'?" for the known key with the least edit
// distance (Levenshtein 1966) when that is at most two fifths of the key's length, or 1, else `otherwise`, or the list
// of known keys where that is empty.
std::string nearestKeyAdvice(std::string_view key, std::span<const std::string_view> known,
                             std::string_view otherwise = {});

}  // namespace speculum
