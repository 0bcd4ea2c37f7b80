#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "accuracy/sweep_results.hpp"

namespace speculum {

// Safe between tags and inside double or single quotes: &, <, > and both quotes become references, and what is neither
// valid UTF-8 nor allowed in HTML (control characters) becomes U+FFFD.
std::string escapeHtml(std::string_view text);

// RFC 4648, with padding, without line breaks.
std::string base64(std::span<const uint8_t> bytes);

// For people, UTF-8: so many significant digits, powers of ten below 0.0001 and from a million on, "0", "∞" and "–" for
// what is not a number.
std::string numberText(double value, int significant = 3);

// "10⁻⁵" or "2×10⁻⁵", for round values other than zero.
std::string powerText(double value);

// A leading hyphen becomes a minus sign.
std::string withMinusSign(std::string number);

// Code points of valid UTF-8.
int characterCount(std::string_view text);

// Always so many decimals, for columns; "∞" and "–" as above.
std::string fixedText(double value, int decimals);

// As few decimals as keep three significant digits of the smallest value that is neither zero nor infinite, 6 at most.
int columnDecimals(const std::vector<double>& values);

// The shortest text that reads back as the same number.
std::string exactText(double value);

// One word of a POSIX shell, in quotes only where they are needed.
std::string shellWord(std::string_view text);

// "--set key=value --set key=value", to be put on a command line.
std::string setOptions(const std::vector<SettingChange>& changes);

}  // namespace speculum
